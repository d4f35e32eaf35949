"""Why an archive that was handed in cannot be marked: the student's mistakes, one by one."""

from __future__ import annotations

from grader.base.i18n.message import Message
from grader.base.i18n.message import say
from grader.base.shown import shown
from grader.package.intake.problems import Problem

ENCRYPTED = "package.archive_encrypted"
AGAIN = say(
    "Pack the package's folder anew, with nothing else in it: cd ~/ros2_ws/src && "
    "tar -czf my_package.tar.gz my_package (with your package's name)."
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
        say(
            "The archive {what} is damaged or was cut short: {reason}.",
            what=shown(what),
            reason=reason if isinstance(reason, Message) else shown(reason),
        ),
        say("Pack it again, open it once to see that all is in it, and hand it in again."),
    )


def no_archive(what: str) -> Problem:
    """It is called an archive and is something else."""
    return Problem(
        "package.archive_corrupt",
        say("{what} is called an archive, but what is in it is none.", what=shown(what)),
        say("A new name does not make an archive. {again}", again=AGAIN),
    )


def encrypted(what: str) -> Problem:
    """It asks for a password."""
    return Problem(
        ENCRYPTED,
        say("The archive {what} is locked with a password.", what=shown(what)),
        say("Pack it again without a password."),
    )


def unsupported(what: str, kind: str) -> Problem:
    """It is of a kind that is not read."""
    return Problem(
        "package.archive_unsupported",
        say("{what} is {kind}, which is not opened here.", what=shown(what), kind=kind),
        say("Hand in a zip or a tar.gz. {again}", again=AGAIN),
    )


def unsafe(what: str, name: str) -> Problem:
    """A name in it leads out of the folder that it is unpacked in."""
    return Problem(
        "package.archive_unsafe",
        say(
            "The archive {what} holds a name that leads out of it: {name}. Nothing of it was "
            "unpacked.",
            what=shown(what),
            name=shown(name),
        ),
        say("Names in an archive are relative and go down only. {again}", again=AGAIN),
    )


def bomb(what: str, *, packed: str, unpacked: str) -> Problem:
    """What comes out of it is out of all proportion."""
    return Problem(
        "package.archive_bomb",
        say(
            "The archive {what} has {packed}, and more than {unpacked} come out of it: "
            "reading was stopped.",
            what=shown(what),
            packed=packed,
            unpacked=unpacked,
        ),
        say("Hand in only what you wrote. {again}", again=AGAIN),
    )


def too_large(what: str, reason: str) -> Problem:
    """It is beyond a limit of size or number."""
    return Problem(
        "package.archive_too_large",
        say(
            "The archive {what} is too large to be marked: {reason}.",
            what=shown(what),
            reason=reason,
        ),
        say(
            "Hand in only what you wrote: no recordings, data sets or virtual environments. "
            "{again}",
            again=AGAIN,
        ),
    )


def too_deep(what: str, depth: int) -> Problem:
    """Archives in archives in archives."""
    return Problem(
        "package.archive_nested",
        say(
            "{what} is an archive in more than {depth} others, and was not opened.",
            what=shown(what),
            depth=depth,
        ),
        say("Pack the package once. {again}", again=AGAIN),
    )


def empty(what: str) -> Problem:
    """Nothing is in it."""
    return Problem(
        "package.archive_empty",
        say("There is nothing in the archive {what}.", what=shown(what)),
        say("See that the package is in it before you hand it in. {again}", again=AGAIN),
    )
