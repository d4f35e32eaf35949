"""Unpacks the archive of a whole class once, below the grader's own folder.

Its content is untrusted: no name leads out of the folder, no link, device or pipe is created, and
the size of each student's files is limited. A member that breaks a rule is left out with a remark
and affects no other student. The students' own archives are not unpacked.
"""

from __future__ import annotations

import hashlib
import json
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from grader.base.errors import SurroundingsError, UsageError
from grader.base.lock import locked
from grader.base.shown import shown
from grader.batch.unpack_members import CLASS_LIMITS, ClassWriter
from grader.package.intake.archive import members_of, parsing
from grader.package.intake.archive_kind import HEAD, kind_of
from grader.package.intake.archive_limits import Spent
from grader.package.intake.archive_problems import ArchiveError
from grader.package.intake.reading import Unread, open_file

FORM = 1  # of unpacked.json; a folder with another form is unpacked again
CHUNK = 1_000_000


@dataclass(frozen=True)
class Unpacked:
    """The unpacked class; `remarks` are pairs of a path in it and a remark."""

    folder: Path
    remarks: tuple[tuple[str, str], ...] = ()
    modes_recorded: bool = True


def unpack_class(path: Path, root: Path) -> Unpacked:
    """Unpack an archive below `root` into a folder named by its hash, unless that exists.

    Raises UsageError if it is not an archive or is damaged as a whole, SurroundingsError if the
    folder cannot be written.
    """
    opened = open_file(path)
    if isinstance(opened, Unread):
        raise UsageError(f"{shown(str(path))}: {opened.reason}")
    with opened as file:
        digest = _digest(file)
        target = root / digest
        try:
            root.mkdir(parents=True, exist_ok=True, mode=0o700)
            with locked(root / f".{digest}.lock"):
                return _existing(target) or _unpacked(file, path, target)
        except OSError as error:
            raise SurroundingsError(
                f"the class cannot be unpacked into {shown(str(root))}: {error.strerror}",
                remedy="Free some space, or choose another folder with --out.",
            ) from None


def _digest(file: IO[bytes]) -> str:
    digest = hashlib.sha256()
    while chunk := file.read(CHUNK):
        digest.update(chunk)
    file.seek(0)
    return digest.hexdigest()


def _existing(target: Path) -> Unpacked | None:
    try:
        found = json.loads((target / "unpacked.json").read_text())
        if found["form"] != FORM or not (target / "class").is_dir():
            return None
        remarks = tuple((str(where), str(what)) for where, what in found["remarks"])
        return Unpacked(target / "class", remarks, bool(found["modes_recorded"]))
    except (OSError, ValueError, KeyError, TypeError):
        return None


def _unpacked(file: IO[bytes], path: Path, target: Path) -> Unpacked:
    """Unpack into a temporary folder, and rename it to the target when it is complete."""
    building = target.with_name(f".{target.name}.part")
    for left in (building, target):  # from a run that was killed, or of an older form
        shutil.rmtree(left, ignore_errors=True)
    building.mkdir(mode=0o700)  # the files are for the instructor only
    (building / "class").mkdir()
    try:
        writer = ClassWriter(building / "class")
        _read_into(writer, file, path)
        description = {
            "form": FORM,
            "remarks": writer.remarks,
            "modes_recorded": writer.modes_recorded,
        }
        (building / "unpacked.json").write_text(json.dumps(description))
        building.rename(target)
    finally:
        shutil.rmtree(building, ignore_errors=True)
    return Unpacked(target / "class", tuple(writer.remarks), writer.modes_recorded)


def _read_into(writer: ClassWriter, file: IO[bytes], path: Path) -> None:
    kind = kind_of(file.read(HEAD))
    file.seek(0)
    name = shown(path.name)
    if kind is None:
        raise UsageError(
            f"{shown(str(path))} is neither a folder nor an archive",
            remedy="Give the folder of all submissions, or the archive that was downloaded.",
        )
    try:
        with parsing(path.name):
            for member in members_of(file, kind, path.name, Spent(CLASS_LIMITS)):
                writer.add(member)
        if writer.locked is not None:
            raise writer.locked
    except ArchiveError as error:
        raise UsageError(
            f"the class archive cannot be unpacked. {error.problem.text}",
            remedy=f"Download {name} again, or unpack it yourself and give the folder.",
        ) from None
