"""Where reports are kept: `<out>/<student>/<distro>/report.json` and `<out>/<student>/matrix.json`.

The evidence of a report is beside it, in `evidence.json`, with its signature if there is a key.
Two submissions never share a folder: the reports in it name the submission. The second one's is
`<student>-<8 hex digits of its path's SHA-256>`, the same in each run.
"""

from __future__ import annotations

import contextlib
import errno
import hashlib
import json
import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from pydantic import ValidationError

from grader.base.errors import SurroundingsError, UsageError
from grader.base.folder import Folder
from grader.base.i18n.message import say
from grader.base.signing import own_key
from grader.report.matrix import matrix_of
from grader.report.model import Report

REPORT = "report.json"
MATRIX = "matrix.json"
EVIDENCE = "evidence.json"
SIGNATURE = "evidence.json.sig"
NAME_BYTES = 255  # the longest file name on Linux and macOS
FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
FORBIDDEN = (errno.EACCES, errno.EPERM, errno.EROFS)
IN_THE_WAY = (errno.ELOOP, errno.ENOTDIR, errno.EISDIR)


def report_json(report: Report) -> str:
    """Return a report in its published form, which `report.schema.json` describes."""
    return report.model_dump_json(by_alias=True, indent=2) + "\n"


def read_report(file: Path) -> Report:
    """Read a report; raise UsageError for anything else."""
    try:
        return Report.model_validate_json(file.read_bytes())
    except OSError as error:
        raise UsageError(f"{file} cannot be read: {error.strerror}") from None
    except ValidationError as error:
        first = error.errors()[0]
        raise UsageError(f"{file} is not a report of this grader: {first['msg']}") from None


def write_report(
    report: Report, out: Path, student: str, *, durable: bool = True, evidence: bytes = b""
) -> Path:
    """Write a report below `out` (created if it is missing) and return the path of its file.

    `evidence` is the content of its evidence file, b"" for none. If the grader is killed, the file is the old report or the new one. Only its owner can read
    it; a link in its place or in that of its folders is not followed. ValueError if a name is not
    a file name; SurroundingsError if it cannot be written. `durable` as for a Folder.
    """
    distro = _file_name(report.environment.distro)
    path = report.submission.path
    with _student_folder(out, student, path, durable=durable) as (folder, locked):
        with folder.private(distro) as place:
            if locked:
                place.sweep()
            _replace_evidence(place, evidence)
            place.replace(REPORT, report_json(report).encode())
        return folder.path / distro / REPORT


def _replace_evidence(place: Folder, evidence: bytes) -> None:
    """Replace the evidence of the earlier report; a signature is never beside what it is not of."""
    place.remove(SIGNATURE)
    if not evidence:
        place.remove(EVIDENCE)
        return
    key = own_key()
    place.replace(EVIDENCE, evidence)
    if key is not None:
        place.replace(SIGNATURE, key.sign(evidence))


def write_matrix(reports: Sequence[Report], out: Path, student: str) -> Path:
    """Write the comparison of one submission's reports on several distros beside them.

    Otherwise like `write_report`; also ValueError for reports that do not belong together.
    """
    matrix = matrix_of(reports)
    with _student_folder(out, student, matrix.submission.path) as (folder, locked):
        if locked:
            folder.sweep()
        folder.replace(MATRIX, (matrix.model_dump_json(by_alias=True, indent=2) + "\n").encode())
        return folder.path / MATRIX


@contextlib.contextmanager
def _student_folder(
    out: Path, student: str, submission: str, *, durable: bool = True
) -> Iterator[tuple[Folder, bool]]:
    """Open the submission's folder, locked against other writers, if the file system can."""
    names = _folder_names(_file_name(student), submission)
    try:
        with _open_out(out, durable=durable) as top:
            locked = top.lock()
            name = _choose(top, names, submission)
            with top.private(name) as folder:
                yield folder, locked
    except OSError as error:
        raise could_not_write(error, out) from error


def _open_out(out: Path, *, durable: bool) -> Folder:
    """Open the folder of all reports; if it is created here, it is private and ignored by git."""
    out.parent.mkdir(parents=True, exist_ok=True)
    try:
        out.mkdir(mode=0o700)
    except FileExistsError:
        return Folder.open(out, durable=durable)
    folder = Folder.open(out, durable=durable)
    folder.replace(".gitignore", b"*\n")
    return folder


def _folder_names(student: str, submission: str) -> list[str]:
    """Return the names that the folder may have, the best first."""
    digest = hashlib.sha256(os.fsencode(os.path.realpath(submission))).hexdigest()
    names = [student]
    for digits in (8, 64):
        room = NAME_BYTES - digits - 1
        start = student.encode()[:room].decode(errors="ignore")
        names.append(f"{start}-{digest[:digits]}")
    return names


def _choose(top: Folder, names: Sequence[str], submission: str) -> str:
    """Return the first name whose folder is already this submission's, else the first free one."""
    own = os.path.realpath(submission)
    free = []
    for name in names:
        owner = _owner(top, name, own)
        if owner == own:
            return name
        if owner is None:
            free.append(name)
    if not free:
        raise FileExistsError(
            errno.EEXIST, say("every name for it is taken"), str(top.path / names[0])
        )
    return free[0]


def _owner(top: Folder, name: str, own: str) -> str | None:
    """Return the path of the submission to which a folder belongs; None if the name is free.

    Return "" if it is not a folder (a link, a file), contains reports that cannot be read or are
    of several submissions, or is the submission itself.
    """
    kind = top.kind(name)
    if kind != "folder":
        return None if kind == "" else ""
    if os.path.realpath(top.path / name) == own:
        return ""
    owners = set()
    with top.sub(name) as folder:
        for distro in folder.names():
            if folder.kind(distro) != "folder":
                continue
            with folder.sub(distro) as place:
                if place.kind(REPORT):
                    owners.add(_submission_path(place.read(REPORT)))
    if not owners:
        return None
    return owners.pop() if len(owners) == 1 else ""


def _submission_path(content: bytes | None) -> str:
    try:
        return os.path.realpath(str(json.loads(content or b"")["submission"]["path"]))
    except (ValueError, KeyError, TypeError, RecursionError):
        return ""


def _file_name(name: str) -> str:
    if name in ("", ".", "..") or "/" in name or "\0" in name:
        raise ValueError(f"not a file name: {name!r}")
    return name


def could_not_write(error: OSError, out: Path, *, what: str = "") -> SurroundingsError:
    """Return the error to show if `what` (default: the report) could not be written below `out`."""
    if error.errno in FULL:
        remedy = say(
            "The disk (or a quota) is full. Free some space, or choose another folder with --out."
        )
    elif error.errno in FORBIDDEN:
        remedy = say("You have no write permission for this folder. Choose another one with --out.")
    elif error.errno in IN_THE_WAY:
        remedy = say(
            "A link or file is in the place of a folder. Check and remove it, or choose another "
            "folder with --out."
        )
    else:
        remedy = say("Choose another folder with --out.")
    message = say(
        "{what} could not be written below {out}: {where}: {reason}",
        what=what or say("the report"),
        out=str(out),
        where=error.filename if isinstance(error.filename, str) else str(out),
        reason=error.strerror or str(error),
    )
    return SurroundingsError(message, remedy=remedy)
