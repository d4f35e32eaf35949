"""Writes the members of a class archive to the disk, with a remark for each that is left out."""

from __future__ import annotations

import errno
import shutil
from collections import Counter
from pathlib import Path
from typing import IO

from grader.base.safe_open import create_file
from grader.base.shown import shown
from grader.package.intake.archive import TWICE
from grader.package.intake.archive_limits import ArchiveLimits
from grader.package.intake.archive_member import Member, inside
from grader.package.intake.archive_problems import ENCRYPTED, ArchiveError, too_large
from grader.package.intake.reading import MEGABYTE

MOST_REMARKS = 2_000
DISK_ERRORS = (errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EACCES, errno.EPERM, errno.EIO)
CLASS_LIMITS = ArchiveLimits(
    packed=50_000 * MEGABYTE,
    unpacked=50_000 * MEGABYTE,
    # (a zip of text can be very small; each student's share is limited below)
    ratio=1_000,
    ratio_from=2_000 * MEGABYTE,
    members=1_000_000,
    directory=400 * MEGABYTE,
    headers=2_000 * MEGABYTE,
    seconds=3_600,
)
ONE_STUDENT = ArchiveLimits()
NOT_UNPACKED = "not unpacked"
LEADS_OUT = f"{NOT_UNPACKED}: its name leads out of the archive"
IS_LINK = f"{NOT_UNPACKED}: it is a link"
SPECIAL = f"{NOT_UNPACKED}: it is neither a file nor a folder"
TOO_LARGE = f"{NOT_UNPACKED}: it is larger than {ONE_STUDENT.packed // MEGABYTE} MB"
TOO_MUCH = (
    f"{NOT_UNPACKED}: its folder has more than {ONE_STUDENT.unpacked // MEGABYTE} MB or "
    f"{ONE_STUDENT.members:,} files"
)
NO_SOURCE = f"{NOT_UNPACKED}: it is a hard link to a file that does not precede it"
NO_PLACE = f"{NOT_UNPACKED}: its name is too long, or in conflict with another one"
LOCKED = f"{NOT_UNPACKED}: it is locked with a password"
DAMAGED = f"{NOT_UNPACKED}: it is damaged"


class ClassWriter:
    """Fills the class folder and collects remarks."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.remarks: list[tuple[str, str]] = []
        self.modes_recorded = True
        self.locked: ArchiveError | None = None
        """The error of the first locked file, None once a file that is not locked was written."""
        self._filled = False
        self._total = 0
        self._folders: set[Path] = set()
        self._bytes: Counter[str] = Counter()
        self._files: Counter[str] = Counter()

    def add(self, member: Member) -> None:
        """Write one member, or add a remark why not."""
        path = inside(member.name.replace("\0", "\ufffd"))
        if path is None:
            self._remark(member.name, LEADS_OUT)
        elif path == ".":
            return
        elif member.kind == "link":
            self._remark(path, IS_LINK)
        elif member.kind == "special":
            self._remark(path, SPECIAL)
        elif member.size > ONE_STUDENT.packed:
            self._remark(path, TOO_LARGE)
        elif self._is_too_much(path, member.size):
            self._remark(path, TOO_MUCH)
        else:
            self._write_checked(path, member)

    def _remark(self, path: str, what: str) -> None:
        if len(self.remarks) < MOST_REMARKS:
            self.remarks.append((path, what))

    def _is_too_much(self, path: str, size: int) -> bool:
        """Count a member; a student's folder is at the top level, or one below."""
        self._total += size
        if self._total > CLASS_LIMITS.unpacked:
            most = f"{CLASS_LIMITS.unpacked / 1e9:g} GB"
            raise ArchiveError(too_large("of the class", f"unpacked it has more than {most}"))
        part = "/".join(path.split("/")[:2])
        self._bytes[part] += size
        self._files[part] += 1
        too_many = self._files[part] > ONE_STUDENT.members
        return too_many or self._bytes[part] > ONE_STUDENT.unpacked

    def _write_checked(self, path: str, member: Member) -> None:
        if member.remark:
            self._remark(path, member.remark)
        try:
            self._write(path, member)
        except OSError as error:
            if error.errno in DISK_ERRORS:
                raise
            self._remark(path, NO_PLACE)
        except UnicodeEncodeError:
            self._remark(path, NO_PLACE)

    def _write(self, path: str, member: Member) -> None:
        place = self.root / path
        if member.kind == "folder":
            place.mkdir(parents=True, exist_ok=True)
            return
        if place.parent not in self._folders:
            place.parent.mkdir(parents=True, exist_ok=True)
            self._folders.add(place.parent)
        if place.is_file():
            self._remark(path, TWICE)
            place.unlink()
        if member.kind == "hard link":
            self._copy(path, member.target)
            return
        if member.mode is None:
            self.modes_recorded = False
        executable = bool((member.mode or 0) & 0o100)
        with create_file(place, 0o700 if executable else 0o600) as out:
            why = self._fill(out, member)
        if why:
            place.unlink()
            self._remark(path, why)

    def _fill(self, out: IO[bytes], member: Member) -> str:
        """Write a file's bytes; return a remark if that fails, or ""."""
        try:
            for chunk in member.chunks():
                out.write(chunk)
        except ArchiveError as error:
            if error.problem.mistake == ENCRYPTED:
                self.locked = None if self._filled else error
                return LOCKED
            return f"{NOT_UNPACKED}. {error.problem.text}"
        except OSError:
            raise
        except Exception as error:  # whatever a parser raises for untrusted bytes
            return f"{DAMAGED} ({shown(str(error))})"
        self._filled, self.locked = True, None
        return ""

    def _copy(self, path: str, target: str) -> None:
        goal = inside(target)
        source = None if goal is None else self.root / goal
        if source is None or not source.is_file():
            self._remark(path, f"{NO_SOURCE} ({shown(target)})")
            return
        if self._is_too_much(path, source.stat().st_size):
            self._remark(path, TOO_MUCH)
            return
        shutil.copyfile(source, self.root / path)
        (self.root / path).chmod(source.stat().st_mode & 0o700)
