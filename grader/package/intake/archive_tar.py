"""Tar archives, plain or packed with gzip, xz or bzip2, read member by member."""

from __future__ import annotations

import bz2
import gzip
import lzma
import tarfile
import tempfile
from collections.abc import Iterator
from datetime import datetime, timezone
from typing import IO

from grader.base.errors import SurroundingsError
from grader.base.i18n.message import say
from grader.package.intake.archive_kind import HEAD, Packing, is_tar
from grader.package.intake.archive_limits import Spent
from grader.package.intake.archive_member import CHUNK, LimitedFile, Member
from grader.package.intake.archive_problems import ArchiveError, corrupt, unsupported

IN_MEMORY = 8_000_000  # bytes; larger unpacked data goes to an unnamed file on disk
XZ_MEMORY = 100_000_000  # bytes; xz -9 needs 65 MB


class _HeaderLimit(LimitedFile):
    """A file of which only the allowed bytes can be read: a hostile header asks for gigabytes."""

    def __init__(self, file: IO[bytes], what: str) -> None:
        super().__init__(file)
        self._what = what
        self.allowed = 0

    def read(self, size: int = -1) -> bytes:
        if not 0 <= size <= self.allowed:
            raise ArchiveError(corrupt(self._what, say("one of its headers is too long")))
        self.allowed -= size
        return self.file.read(size)


def read_tar(file: IO[bytes], packing: Packing, what: str, spent: Spent) -> Iterator[Member]:
    """Yield a tar's members in their order; ArchiveError if it is refused.

    Any other exception of tarfile means that the archive is damaged.
    """
    if not packing:
        yield from _members(file, what, spent)
        return
    with tempfile.SpooledTemporaryFile(max_size=IN_MEMORY) as unpacked:
        for chunk in _unpacked(file, packing):
            spent.unpack(what, len(chunk))
            _write(unpacked, chunk)
        unpacked.seek(0)
        if not is_tar(unpacked.read(HEAD)):
            kind = say("a single file packed with {packing}", packing=packing)
            raise ArchiveError(unsupported(what, kind))
        unpacked.seek(0)
        yield from _members(unpacked, what, spent)


def _write(unpacked: tempfile.SpooledTemporaryFile[bytes], chunk: bytes) -> None:
    try:
        unpacked.write(chunk)
    except OSError as error:
        raise SurroundingsError(
            say(
                "there is no space to unpack an archive in {folder}: {reason}",
                folder=tempfile.gettempdir(),
                reason=error.strerror or str(error),
            ),
            remedy=say("Free some space there, or set TMPDIR to another folder."),
        ) from None


def _unpacked(file: IO[bytes], packing: Packing) -> Iterator[bytes]:
    """Yield the unpacked bytes, in pieces of bounded size for any input."""
    if packing == "gzip":
        with gzip.GzipFile(fileobj=file) as unpacking:
            while chunk := unpacking.read(CHUNK):
                yield chunk
        return
    decoder: lzma.LZMADecompressor | bz2.BZ2Decompressor
    more = file.read(CHUNK)
    while more:  # one stream after the other: `cat a.xz b.xz` is a valid xz
        new = lzma.LZMADecompressor(memlimit=XZ_MEMORY) if packing == "xz" else None
        decoder = new or bz2.BZ2Decompressor()
        while not decoder.eof:
            if decoder.needs_input and not more:
                more = file.read(CHUNK)
                if not more:
                    raise EOFError(say("it ends in the middle"))
            yield decoder.decompress(more, max_length=CHUNK)
            more = b""
        more = (decoder.unused_data or file.read(CHUNK)).lstrip(b"\0")


def _members(file: IO[bytes], what: str, spent: Spent) -> Iterator[Member]:
    guarded = _HeaderLimit(file, what)
    guarded.allowed = spent.limits.header
    headers = spent.limits.headers
    with tarfile.open(
        fileobj=guarded, mode="r:", encoding="utf-8", errors="surrogateescape"
    ) as archive:
        before = -1
        while True:
            guarded.allowed = allowed = min(spent.limits.header, headers)
            info = archive.next()
            headers -= allowed - guarded.allowed
            if info is None:
                break
            archive.members = []  # type: ignore[attr-defined] # it would keep them all
            # a negative size makes tarfile read the same header forever (CVE-2025-8194)
            if info.offset <= before or info.size < 0 or archive.offset <= info.offset:
                raise ArchiveError(corrupt(what, say("its headers form a loop")))
            before = info.offset
            spent.member(what)
            yield _member(archive, info, guarded)
        _check_end(file, archive.offset, what)


def _check_end(file: IO[bytes], offset: int, what: str) -> None:
    """Refuse data after the last readable header, which tarfile takes for the end."""
    file.seek(offset)
    if file.read(HEAD).strip(b"\0"):
        raise ArchiveError(corrupt(what, say("the data after its last readable file is invalid")))


def _member(archive: tarfile.TarFile, info: tarfile.TarInfo, guarded: _HeaderLimit) -> Member:
    def chunks() -> Iterator[bytes]:
        guarded.allowed = info.size + CHUNK
        file = archive.extractfile(info)
        left = info.size
        while file is not None and left and (chunk := file.read(min(CHUNK, left))):
            left -= len(chunk)
            yield chunk
        if left:
            raise EOFError(say("it ends in the middle of a file"))

    mode = info.mode & 0o7777
    if info.isdir():
        return Member(info.name, "folder", mode)
    if info.issym():
        return Member(info.name, "link", mode, target=info.linkname)
    if info.islnk():
        return Member(info.name, "hard link", mode, target=info.linkname)
    # a sparse file is read by a table that the student controls; no source file is sparse
    if not info.isreg() or info.issparse():
        return Member(info.name, "special", mode)
    return Member(info.name, "file", mode, info.size, _time(info), chunks=chunks)


def _time(info: tarfile.TarInfo) -> datetime | None:
    try:
        return datetime.fromtimestamp(info.mtime, timezone.utc)
    except (ValueError, OverflowError, OSError):
        return None
