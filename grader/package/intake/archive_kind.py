"""The kind of an archive, recognised by its first bytes and not by its name."""

from __future__ import annotations

import re
import tarfile
from dataclasses import dataclass
from typing import Literal

from grader.base.i18n.message import say

HEAD = 512
"""How many bytes determine the kind: a tar's first header."""

Packing = Literal["", "gzip", "xz", "bzip2"]

NAMED = re.compile(
    r"(?P<stem>.+?)(?:\.tar)?\.(?:zip|tar|tgz|txz|tbz2?|gz|xz|bz2|tar\.\w{1,4}|7z|rar)",
    re.IGNORECASE,
)
UNSUPPORTED = (
    (b"Rar!\x1a\x07", say("a RAR archive")),
    (b"7z\xbc\xaf\x27\x1c", say("a 7z archive")),
    (b"\x28\xb5\x2f\xfd", say("packed with Zstandard")),
    (b"MSCF", say("a Windows cabinet")),
    (b"\x1f\x9d", say("packed with compress")),
    (b"LZIP", say("packed with lzip")),
    (b"\x04\x22\x4d\x18", say("packed with LZ4")),
    (b"xar!", say("a xar archive")),
)
PACKED: tuple[tuple[bytes, Packing], ...] = (
    (b"\x1f\x8b\x08", "gzip"),
    (b"\xfd7zXZ\x00", "xz"),
    (b"BZh", "bzip2"),
)
ZIPS = (b"PK\x03\x04", b"PK\x05\x06", b"PK\x07\x08")


@dataclass(frozen=True)
class Kind:
    """A zip, a tar with its compression, or the description of an unsupported kind."""

    form: Literal["zip", "tar", "unsupported"]
    packing: Packing = ""
    words: str = ""


def kind_of(head: bytes) -> Kind | None:
    """Return the kind by the first `HEAD` bytes; None if it is not an archive.

    A file packed with gzip, xz or bzip2 counts as a tar until it is read.
    """
    if head.startswith(ZIPS):
        return Kind("zip")
    for magic, packing in PACKED:
        if head.startswith(magic):
            return Kind("tar", packing)
    for magic, words in UNSUPPORTED:
        if head.startswith(magic):
            return Kind("unsupported", words=words)
    return Kind("tar") if is_tar(head) else None


def is_tar(head: bytes) -> bool:
    """Whether a file begins with a tar header (valid checksum), or with tar's end, all zeros."""
    block = head[:HEAD]
    if len(block) < HEAD:
        return False
    if not any(block):
        return True
    try:
        tarfile.TarInfo.frombuf(block, "utf-8", "surrogateescape")
    except (tarfile.HeaderError, ValueError):
        return False
    return True


def is_named_archive(name: str) -> bool:
    """Whether a name is that of an archive."""
    return NAMED.fullmatch(name) is not None


def without_ending(name: str) -> str:
    """Return an archive's name without its endings: `jane.tar.gz` is `jane`."""
    match = NAMED.fullmatch(name)
    return match["stem"] if match else name
