"""The command that makes the signing key of this installation."""

from __future__ import annotations

import click


@click.command("keygen")
def keygen() -> int:
    """Make the key with which this installation signs the evidence of its verdicts.

    From then on each report's evidence.json has a signature (Ed25519) beside it, and so has each
    row of a class' ledger. Give the public key to whoever verifies them: grader verify --key FILE.
    An existing key is kept.
    """
    from grader.base import signing  # noqa: PLC0415 - keeps --help fast
    from grader.base.state import state_folder  # noqa: PLC0415

    public = signing.make_key()
    click.echo(f"private key  {state_folder() / signing.PRIVATE_FILE} (keep it secret, back it up)")
    click.echo(f"public key   {state_folder() / signing.PUBLIC_FILE}")
    click.echo(f"fingerprint  {public.fingerprint}")
    return 0
