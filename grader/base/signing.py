"""Ed25519 signatures (RFC 8032) with the instructor's key, if there is one.

The keys are PEM files (PKCS 8 and SubjectPublicKeyInfo, RFC 8410), as OpenSSL reads them:
`openssl pkeyutl -verify -rawin -pubin -inkey KEY -sigfile SIGNATURE -in FILE` checks a signature.
"""

from __future__ import annotations

import base64
import contextlib
import hashlib
import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from grader.base.errors import SurroundingsError, UsageError
from grader.base.folder import Folder
from grader.base.state import state_folder

if TYPE_CHECKING:
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey

PRIVATE_FILE = "signing_key.pem"
PUBLIC_FILE = "signing_key.pub.pem"
OF_OTHERS = 0o077  # permission bits of group and others


@dataclass(frozen=True)
class PublicKey:
    """A public key; `raw` are its 32 bytes."""

    raw: bytes

    @property
    def fingerprint(self) -> str:
        """A short name for people: base64 of the SHA-256 of the 32 bytes, without padding."""
        digest = hashlib.sha256(self.raw).digest()
        return f"SHA256:{base64.b64encode(digest).decode().rstrip('=')}"

    def verifies(self, signature: bytes, content: bytes) -> bool:
        """Return whether the owner of the key signed exactly this content."""
        from cryptography.exceptions import InvalidSignature  # noqa: PLC0415 - slow, rarely needed
        from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey  # noqa: PLC0415

        try:
            Ed25519PublicKey.from_public_bytes(self.raw).verify(signature, content)
        except InvalidSignature:
            return False
        return True


class SigningKey:
    """A private key; it is never printed and never leaves this process."""

    def __init__(self, private: Ed25519PrivateKey) -> None:
        self._private = private
        self.public = PublicKey(private.public_key().public_bytes_raw())

    def sign(self, content: bytes) -> bytes:
        """Return the signature: 64 bytes."""
        return self._private.sign(content)


def make_key(folder: Path | None = None) -> PublicKey:
    """Make the key of this installation and return its public part.

    Writes both files to `folder` (default: that of this installation); only the owner can read
    the private one. Raises UsageError if there is a key already, SurroundingsError if it cannot be
    written.
    """
    from cryptography.hazmat.primitives import serialization as form  # noqa: PLC0415
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey  # noqa: PLC0415

    place = folder or state_folder()
    private = Ed25519PrivateKey.generate()
    secret = private.private_bytes(form.Encoding.PEM, form.PrivateFormat.PKCS8, form.NoEncryption())
    public = private.public_key().public_bytes(
        form.Encoding.PEM, form.PublicFormat.SubjectPublicKeyInfo
    )
    try:
        place.mkdir(mode=0o700, parents=True, exist_ok=True)
        with Folder.open(place) as opened:
            opened.lock()
            if opened.kind(PRIVATE_FILE):
                raise UsageError(
                    f"there is a key already: {place / PRIVATE_FILE}",
                    remedy="It is kept: what it signed could not be verified without it. To use "
                    "another one, move both files away first.",
                )
            opened.replace(PUBLIC_FILE, public)
            opened.replace(PRIVATE_FILE, secret)
    except OSError as error:
        raise SurroundingsError(
            f"the key could not be written to {place}: {error.strerror or error}",
            remedy="Name another folder with the variable GRADER_STATE.",
        ) from error
    return PublicKey(private.public_key().public_bytes_raw())


def own_key(folder: Path | None = None) -> SigningKey | None:
    """Return the key of this installation, None if there is none in a folder of this user's.

    Raises SurroundingsError if it cannot be read, is not an Ed25519 key, or others could read it.
    """
    file = (folder or state_folder()) / PRIVATE_FILE
    try:
        with file.open("rb") as opened:
            content, mode = opened.read(), os.fstat(opened.fileno()).st_mode
    except FileNotFoundError:
        return None
    except OSError as error:
        if not os.access(file.parent, os.X_OK):
            return None  # (the folder of another user: it cannot be known what is in it)
        raise SurroundingsError(f"the key {file} cannot be read: {error.strerror}") from error
    if mode & OF_OTHERS:
        raise SurroundingsError(
            f"other users can read the key {file}", remedy=f"Close it to them: chmod 600 {file}"
        )
    from cryptography.hazmat.primitives import serialization as form  # noqa: PLC0415
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey  # noqa: PLC0415

    private = None
    with contextlib.suppress(ValueError, TypeError):  # TypeError: it is encrypted
        private = form.load_pem_private_key(content, password=None)
    if not isinstance(private, Ed25519PrivateKey):
        raise SurroundingsError(
            f"{file} is not an Ed25519 key without a passphrase",
            remedy="Move it away and make one with: grader keygen",
        )
    return SigningKey(private)


def read_public_key(file: Path) -> PublicKey:
    """Read a public key; raise UsageError for anything else."""
    from cryptography.hazmat.primitives import serialization as form  # noqa: PLC0415
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey  # noqa: PLC0415

    public = None
    try:
        content = file.read_bytes()
    except OSError as error:
        raise UsageError(f"{file} cannot be read: {error.strerror}") from None
    with contextlib.suppress(ValueError):
        public = form.load_pem_public_key(content)
    if not isinstance(public, Ed25519PublicKey):
        raise UsageError(
            f"{file} is not a public Ed25519 key in PEM form",
            remedy=f"`grader keygen` writes one: {PUBLIC_FILE}",
        )
    return PublicKey(public.public_bytes_raw())
