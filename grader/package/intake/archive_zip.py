"""Zip archives, read member by member by the rules of PKWARE's APPNOTE 6.3."""

from __future__ import annotations

import re
import stat
import zipfile
from collections.abc import Iterator
from datetime import datetime
from typing import IO

from grader.base.i18n.message import say
from grader.package.intake.archive_limits import Spent
from grader.package.intake.archive_member import CHUNK, LimitedFile, Member
from grader.package.intake.archive_problems import ArchiveError, encrypted, too_large, unsupported

UNIX = (3, 19)  # "version made by": Unix, and macOS (APPNOTE 4.4.2)
ENCRYPTED, UTF8 = 0x1, 0x800  # general purpose flags (APPNOTE 4.4.4)
READABLE = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
COMMIT = re.compile(rb"[0-9a-f]{40}(?:[0-9a-f]{24})?")
NOT_UTF8 = say("a name that is not UTF-8: read as code page 437, the default of zip")
BACKSLASHES = say("a name with backslashes: read as folders, as on Windows")
LONGEST_LINK = 4_096  # PATH_MAX


class _ReadLimit(LimitedFile):
    """A file that refuses one large read, such as the directory of a hostile zip."""

    def __init__(self, file: IO[bytes], most: int, what: str) -> None:
        super().__init__(file)
        self._most = most
        self._what = what

    def read(self, size: int = -1) -> bytes:
        found = self.file.read(min(size, self._most + 1) if size >= 0 else self._most + 1)
        if len(found) > self._most:
            raise ArchiveError(too_large(self._what, say("its table of contents is too long")))
        return found


def read_zip(file: IO[bytes], what: str, spent: Spent) -> Iterator[Member]:
    """Yield a zip's members in their order; ArchiveError if it is refused.

    Any other exception of zipfile means that the archive is damaged.
    """
    guarded = _ReadLimit(file, max(spent.limits.directory, 2 * CHUNK), what)
    with zipfile.ZipFile(guarded) as archive:
        members = archive.infolist()
        spent.foresee(what, sum(member.file_size for member in members))
        # git archive writes the commit as comment, and system 0 for plain files (archive-zip.c)
        by_git = COMMIT.fullmatch(archive.comment) is not None
        for member in members:
            spent.member(what)
            yield _member(archive, member, what, spent, by_git=by_git)


def _member(
    archive: zipfile.ZipFile, info: zipfile.ZipInfo, what: str, spent: Spent, *, by_git: bool
) -> Member:
    name, remark = _name(info)
    bits = info.external_attr >> 16 if info.create_system in UNIX else 0
    mode = stat.S_IMODE(bits) if bits else (0o644 if by_git else None)

    locked = bool(info.flag_bits & ENCRYPTED)

    def chunks() -> Iterator[bytes]:
        if locked:
            raise ArchiveError(encrypted(what))
        if info.compress_type not in READABLE:
            kind = say(
                "a zip with an unsupported compression method ({method})", method=info.compress_type
            )
            raise ArchiveError(unsupported(what, kind))
        with archive.open(info) as file:
            while chunk := file.read(CHUNK):
                spent.unpack(what, len(chunk))
                yield chunk

    if name.endswith("/") or stat.S_ISDIR(bits):
        return Member(name, "folder", mode, remark=remark)
    if stat.S_ISLNK(bits) and not locked:
        target = b"".join(chunks()) if info.file_size <= LONGEST_LINK else b"/"
        return Member(
            name, "link", mode, target=target.decode("utf-8", "surrogateescape"), remark=remark
        )
    special = stat.S_IFMT(bits) not in (0, stat.S_IFREG) and not locked
    return Member(
        name,
        "special" if special else "file",
        mode,
        size=info.file_size,
        modified=_time(info),
        remark=remark,
        chunks=chunks,
    )


def _name(info: zipfile.ZipInfo) -> tuple[str, str]:
    """Return a member's name and a remark about it.

    Without the flag for UTF-8 a name is in code page 437, but macOS and Linux write UTF-8 anyway;
    bytes of 437 that are valid UTF-8 by accident are not a word of any language.
    """
    name, remark = info.filename, ""
    if not info.flag_bits & UTF8 and not name.isascii():
        try:
            name = name.encode("cp437").decode("utf-8")
        except UnicodeError:
            remark = NOT_UTF8
    if "\\" in name:
        name, remark = name.replace("\\", "/"), remark or BACKSLASHES
    return name, remark


def _time(info: zipfile.ZipInfo) -> datetime | None:
    try:
        return datetime(*info.date_time)
    except ValueError:
        return None
