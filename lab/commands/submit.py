"""`lab submit`: makes the archive to hand in and reads it back as the grader will."""

from __future__ import annotations

import re
import sys
import zipfile
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.base.errors import UsageError
from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import errors_in
from grader.base.shown import shown
from grader.cli import options

if TYPE_CHECKING:
    from lab.guide.opened import OpenedLab
    from lab.packing import Member, Packing

FOLDER = "submit"
STUDENT = "{student}"  # in the name that the instructor wants
NAME = re.compile(r"[\w-][\w.-]{0,59}")
NEEDED = ("package.xml", "setup.py", "CMakeLists.txt")  # without them there is no package
AGAIN = say("Correct that, and run `lab submit` again.")
FIRST_TIME = (1980, 1, 1, 0, 0, 0)  # the earliest that a zip can have: equal files, equal archive


@click.command(
    help=msg(
        "Make the archive to hand in: your package without what a build makes, with the executable "
        "bits. Files that may be private (.env, .ssh, private keys) and links to files outside of "
        "the package are left out and named. The archive is written to ~/ros2_ws/submit and read "
        "back as your instructor's grader will."
    )
)
@click.option(
    "--name",
    metavar="NAME",
    help=msg("Your name in the archive's name, if your instructor wants it there. It is kept."),
)
@click.option(
    "--with",
    "wanted",
    metavar="FILE",
    multiple=True,
    type=click.Path(path_type=Path),
    help=msg("Take along a file that would be left out. Can be given more than once."),
)
@options.lang
def submit(name: str | None, wanted: tuple[Path, ...], lang: str | None) -> None:
    """Write the archive and print its path on the student's machine."""
    import os  # noqa: PLC0415

    from grader.report.notice import notice  # noqa: PLC0415
    from lab.guide.opened import opened_lab  # noqa: PLC0415 - keeps --help fast
    from lab.guide.progress import now  # noqa: PLC0415

    with errors_in(lang):
        lab = opened_lab(lang)
        student = lab.progress().student if name is None else name
        file, packed = write_archive(lab, student, wanted)
        lab.keep(submitted=f"{FOLDER}/{file.name} {now()}", student=student)
        outside = os.environ.get("LAB_WORKSPACE")
        place = Path(outside) / FOLDER / file.name if outside else file
        click.echo(lab.translate(say("Hand in this file: {path}", path=shown(str(place)))))
        for line in packed.said():
            notice(lab.translate(line), sys.stdout)
        task = lab.task(os.environ)
        if not task.passed:
            unknown = say("`check` has not run yet. Run it first if you can.")
            if lab.progress().checked:
                unknown = say(
                    "Your files have changed since the last `check`. Run it again if you can."
                )
            failed = say("`check` has not passed yet. You can hand it in all the same.")
            notice(lab.translate(failed if task.is_checked else unknown), sys.stdout)


def write_archive(
    lab: OpenedLab, student: str = "", wanted: Sequence[Path] = ()
) -> tuple[Path, Packing]:
    """Write the archive of the lab's lesson; return its path and what is in it.

    UsageError if there is no package, the student's name is needed and is none, a file of `wanted`
    cannot be packed, or the archive cannot be written. SurroundingsError if the archive, read back, is not what is in the workspace.
    """
    from grader.base.errors import SurroundingsError  # noqa: PLC0415
    from grader.verdict.take_in import take_in_for  # noqa: PLC0415
    from lab.packing import members, packing  # noqa: PLC0415

    found = take_in_for(lab.assignment, lab.workspace, at_work=True)
    if found.root is None:
        raise UsageError(found.problem, remedy=found.problem_fix)
    name = _name(lab, student)
    packed = packing(found, wanted)
    _check_needed(packed)
    _write(lab.workspace, name, _zipped(packed.packed))
    file = lab.workspace / FOLDER / name
    if _content(members(take_in_for(lab.assignment, file))) != _content(packed.packed):
        raise SurroundingsError(
            say("the archive {path} is not what is in the workspace", path=shown(str(file))),
            remedy=say("Save your files, and run `lab submit` again."),
        )
    return file, packed


def _check_needed(packed: Packing) -> None:
    """Raise UsageError if a file without which there is no package is left out."""
    for one in packed.left_out:
        if one.file.path in NEEDED:
            command = f"lab submit --with {shown(one.name)}"
            raise UsageError(
                say(
                    "{file} would be left out, but a package needs it ({reason})",
                    file=shown(one.name),
                    reason=one.reason,
                ),
                remedy=AGAIN if one.never else say("Run: {command}", command=command),
            )


def _write(workspace: Path, name: str, content: bytes) -> None:
    """Write the archive. UsageError if that is not possible."""
    from grader.base.folder import Folder  # noqa: PLC0415 - keeps --help fast

    place = f"~/ros2_ws/{FOLDER}"
    try:
        with Folder.open(workspace) as root:
            kind = root.kind(FOLDER)
            if kind not in ("", "folder"):
                raise _in_the_way(place, kind)
            if not kind:
                (workspace / FOLDER).mkdir()
            with root.sub(FOLDER) as folder:
                if folder.kind(name) == "folder":
                    raise _in_the_way(f"{place}/{name}", "folder")
                folder.replace(name, content)
    except OSError as error:
        raise UsageError(
            say(
                "the archive cannot be written to {place}: {problem}",
                place=place,
                problem=error.strerror or str(error),
            ),
            remedy=AGAIN,
        ) from None


def _in_the_way(place: str, kind: str) -> UsageError:
    is_there = {
        "link": say(
            "{place} is a link, and the archive is not written through a link", place=place
        ),
        "folder": say("{place} is a folder, and the archive must have this name", place=place),
    }
    return UsageError(
        is_there.get(kind, say("{place} is not a folder", place=place)),
        remedy=say("Give it another name: {command}", command=f"mv {place} {place}.old"),
    )


def _content(members: Iterable[Member]) -> set[tuple[str, str, int, bytes, str]]:
    """Return what two equal archives have in common: a folder counts only by what is in it."""
    files = ((member.name, member.file) for member in members if member.file.kind != "folder")
    return {
        (name, file.kind, file.mode & 0o100 if file.kind == "file" else 0, file.data, file.target)
        for name, file in files
    }


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


def _zipped(members: Iterable[Member]) -> bytes:
    import io  # noqa: PLC0415

    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for member in members:
            file = member.file
            end = "/" if file.kind == "folder" else ""
            info = zipfile.ZipInfo(f"{member.name}{end}", FIRST_TIME)
            info.create_system = 3  # Unix: the next field has the mode
            kind = {"file": 0o100000, "folder": 0o040000, "link": 0o120000}[file.kind]
            info.external_attr = (kind | file.mode & 0o777) << 16
            info.compress_type = zipfile.ZIP_DEFLATED
            data = file.target.encode() if file.kind == "link" else file.data
            archive.writestr(info, b"" if file.kind == "folder" else data)
    return packed.getvalue()
