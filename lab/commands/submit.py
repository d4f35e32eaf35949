"""`lab submit`: makes the archive to hand in and reads it back as the grader will."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.base.errors import UsageError
from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import errors_in
from grader.base.shown import shown
from grader.cli import options

if TYPE_CHECKING:
    from grader.package.submission import SourceFile, Submission
    from lab.guide.opened import OpenedLab

FOLDER = "submit"
STUDENT = "{student}"  # in the name that the instructor wants
NAME = re.compile(r"[\w-][\w.-]{0,59}")
FIRST_TIME = (1980, 1, 1, 0, 0, 0)  # the earliest that a zip can have: equal files, equal archive


@click.command(
    help=msg(
        "Make the archive to hand in: your package without what a build makes, with the executable "
        "bits. It is written to ~/ros2_ws/submit and read back as your instructor's grader will."
    )
)
@click.option(
    "--name",
    metavar="NAME",
    help=msg("Your name in the archive's name, if your instructor wants it there. It is kept."),
)
@options.lang
def submit(name: str | None, lang: str | None) -> None:
    """Write the archive and print its path on the student's machine."""
    import os  # noqa: PLC0415

    from lab.guide.opened import opened_lab  # noqa: PLC0415 - keeps --help fast
    from lab.guide.progress import now  # noqa: PLC0415

    with errors_in(lang):
        lab = opened_lab(lang)
        student = lab.progress().student if name is None else name
        file = write_archive(lab, student)
        lab.keep(submitted=f"{FOLDER}/{file.name} {now()}", student=student)
        outside = os.environ.get("LAB_WORKSPACE")
        place = Path(outside) / FOLDER / file.name if outside else file
        click.echo(lab.translate(say("Hand in this file: {path}", path=shown(str(place)))))
        kept = lab.progress()
        if not kept.passed:
            click.echo(
                lab.translate(
                    say("`check` has not passed yet. You can hand it in all the same.")
                    if kept.checked
                    else say("`check` has not run yet. Run it first if you can.")
                )
            )


def write_archive(lab: OpenedLab, student: str = "") -> Path:
    """Write the archive of the lab's lesson; return its path.

    UsageError if there is no package, or the student's name is needed and is none.
    SurroundingsError if the archive, read back, is not what is in the workspace.
    """
    from grader.base.errors import SurroundingsError  # noqa: PLC0415
    from grader.base.folder import Folder  # noqa: PLC0415
    from grader.verdict.take_in import take_in_for  # noqa: PLC0415

    found = take_in_for(lab.assignment, lab.workspace)
    if found.root is None:
        raise UsageError(found.problem, remedy=found.problem_fix)
    name = _name(lab, student)
    with Folder.open(lab.workspace) as root:
        if root.kind(FOLDER) == "":
            (lab.workspace / FOLDER).mkdir()
        with root.sub(FOLDER) as folder:
            folder.replace(name, _zipped(found))
    file = lab.workspace / FOLDER / name
    again = take_in_for(lab.assignment, file)
    if again.sha256 != found.sha256:
        raise SurroundingsError(
            say("the archive {path} is not what is in the workspace", path=shown(str(file))),
            remedy=say("Save your files, and run `lab submit` again."),
        )
    return file


def _name(lab: OpenedLab, student: str) -> str:
    """Return the archive's name, as the instructor wants it."""
    name = lab.assignment.archive or f"{lab.assignment.id}.zip"
    if STUDENT not in name:
        return name
    again = say("Run: {command}", command="lab submit --name ada-lovelace")
    if not student:
        raise UsageError(say("your instructor wants your name in the archive's name"), remedy=again)
    if NAME.fullmatch(student) is None:
        raise UsageError(
            say("--name takes letters, digits, '_', '-' and '.', not {name}", name=shown(student)),
            remedy=again,
        )
    return name.replace(STUDENT, student)


def _zipped(found: Submission) -> bytes:
    import io  # noqa: PLC0415

    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, file in _members(found):
            info = zipfile.ZipInfo(path, FIRST_TIME)
            info.create_system = 3  # Unix: the next field has the mode
            kind = {"file": 0o100000, "folder": 0o040000, "link": 0o120000}[file.kind]
            info.external_attr = (kind | file.mode & 0o777) << 16
            info.compress_type = zipfile.ZIP_DEFLATED
            data = file.target.encode() if file.kind == "link" else file.data
            archive.writestr(info, b"" if file.kind == "folder" else data)
    return packed.getvalue()


def _members(found: Submission) -> Iterator[tuple[str, SourceFile]]:
    """Yield the files with their paths in the archive: one folder for each package."""
    name = (found.root or ".").rpartition("/")[2]
    own = found.path.name if name == "." else name
    packages = [(own, found.files), *((one.name, one.files) for one in found.packages)]
    for folder, files in packages:
        for file in files:
            end = "/" if file.kind == "folder" else ""
            yield f"{folder}/{file.path}{end}", file
