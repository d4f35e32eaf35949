"""Why an archive that was handed in cannot be marked: the student's mistakes, one by one."""

from __future__ import annotations

from grader.intake.notes import shown
from grader.intake.problems import Problem

AGAIN = (
    "Pack the package's folder anew, with nothing else in it: "
    "cd ~/ros2_ws/src && tar -czf my_package.tar.gz my_package (with your package's name)."
)


class ArchiveError(Exception):
    """An archive that is not taken in; `problem` is for the student."""

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem.text)
        self.problem = problem


def corrupt(what: str, reason: str) -> Problem:
    """It cannot be read to its end."""
    return Problem(
        "package.archive_corrupt",
        f"The archive {shown(what)} is damaged or was cut short: {shown(reason)}.",
        "Pack it again, open it once to see that all is in it, and hand it in again.",
    )


def no_archive(what: str) -> Problem:
    """It is called an archive and is something else."""
    return Problem(
        "package.archive_corrupt",
        f"{shown(what)} is called an archive, but what is in it is none.",
        "A new name does not make an archive. " + AGAIN,
    )


def encrypted(what: str) -> Problem:
    """It asks for a password."""
    return Problem(
        "package.archive_encrypted",
        f"The archive {shown(what)} is locked with a password.",
        "Pack it again without a password.",
    )


def unsupported(what: str, kind: str) -> Problem:
    """It is of a kind that is not read."""
    return Problem(
        "package.archive_unsupported",
        f"{shown(what)} is {kind}, which is not opened here.",
        "Hand in a zip or a tar.gz. " + AGAIN,
    )


def unsafe(what: str, name: str) -> Problem:
    """A name in it leads out of the folder that it is unpacked in."""
    return Problem(
        "package.archive_unsafe",
        f"The archive {shown(what)} holds a name that leads out of it: {shown(name)}. "
        "Nothing of it was unpacked.",
        "Names in an archive are relative and go down only. " + AGAIN,
    )


def bomb(what: str, *, packed: str, unpacked: str) -> Problem:
    """What comes out of it is out of all proportion."""
    return Problem(
        "package.archive_bomb",
        f"The archive {shown(what)} has {packed}, and more than {unpacked} come out of it: "
        "reading was stopped.",
        "Hand in only what you wrote. " + AGAIN,
    )


def too_large(what: str, reason: str) -> Problem:
    """It is beyond a limit of size or number."""
    return Problem(
        "package.archive_too_large",
        f"The archive {shown(what)} is too large to be marked: {reason}.",
        "Hand in only what you wrote: no recordings, data sets or virtual environments. " + AGAIN,
    )


def too_deep(what: str, depth: int) -> Problem:
    """Archives in archives in archives."""
    return Problem(
        "package.archive_nested",
        f"{shown(what)} is an archive in more than {depth} others, and was not opened.",
        "Pack the package once. " + AGAIN,
    )


def empty(what: str) -> Problem:
    """Nothing is in it."""
    return Problem(
        "package.archive_empty",
        f"There is nothing in the archive {shown(what)}.",
        "See that the package is in it before you hand it in. " + AGAIN,
    )
