"""The command that marks a student's own package."""

from __future__ import annotations

from pathlib import Path

import click

from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import Translator, errors_in
from grader.cli import options


@click.command(
    help=msg(
        "Check your own package before you submit it: the same verdict, by the visible checks.\n\n"
        "PATH is your package or workspace (default: the package in ~/ros2_ws, else the current "
        "folder). It is your own code: if no sandbox is available it runs without one, and says so."
    )
)
@click.argument("path", type=click.Path(path_type=Path), required=False)
@options.assignment
@options.distros
@options.sandbox
@options.limits
@options.lang
@options.verbose
def check(
    path: Path | None,
    assignment: str | None,
    distro: str,
    sandbox: str,
    limits: tuple[str, ...],
    lang: str | None,
    verbose: bool,
) -> int:
    """Mark a student's own package, without the hidden checks."""
    from grader.cli.mark_orders import mark_orders  # noqa: PLC0415 - keeps --help fast
    from grader.verdict.order import default_path, make_orders  # noqa: PLC0415

    with errors_in(lang):
        place = path or default_path()
        orders = make_orders(place, assignment, distro, sandbox, limits, own_code=True, lang=lang)
        if path is None:
            click.echo(
                Translator(orders[0].lang)(say("checking {path}", path=str(place))), err=True
            )
        return mark_orders(orders, None, verbose=verbose, show_hidden=False)
