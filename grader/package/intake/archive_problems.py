"""Why a submitted archive cannot be graded: one function for each of the student's mistakes."""

from __future__ import annotations

from grader.base.i18n.message import Message, msg, say
from grader.base.shown import shown
from grader.package.intake.problems import Problem

ENCRYPTED = "package.archive_encrypted"
AGAIN = msg(
    "Pack the package's folder again, with nothing else in it: cd ~/ros2_ws/src && "
    "tar -czf my_package.tar.gz my_package (with your package's name)."
)
NO_PASSWORD = msg("Pack it again without a password.")


class ArchiveError(Exception):
    """A refused archive; `problem` is for the student."""

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem.text)
        self.problem = problem


def corrupt(what: str, reason: str) -> Problem:
    """It cannot be read to its end."""
    return Problem(
        "package.archive_corrupt",
        say(
            "The archive {what} is damaged or incomplete: {reason}.",
            what=shown(what),
            reason=reason if isinstance(reason, Message) else shown(reason),
        ),
        say("Pack it again, open it once to check that everything is in it, and hand it in again."),
    )


def no_archive(what: str) -> Problem:
    """It is named like an archive but is not one."""
    return Problem(
        "package.archive_corrupt",
        say("{what} is named like an archive but is not one.", what=shown(what)),
        say("Renaming a file does not make it an archive. {again}", again=Message(AGAIN)),
    )


def encrypted(what: str) -> Problem:
    """It needs a password."""
    return Problem(
        ENCRYPTED,
        say("The archive {what} is locked with a password.", what=shown(what)),
        Message(NO_PASSWORD),
    )


def unsupported(what: str, kind: str) -> Problem:
    """Its kind is not supported."""
    return Problem(
        "package.archive_unsupported",
        say("{what} is {kind}, which the grader cannot open.", what=shown(what), kind=kind),
        say("Hand in a zip or a tar.gz. {again}", again=Message(AGAIN)),
    )


def unsafe(what: str, name: str) -> Problem:
    """A path in it leads out of the folder in which it is unpacked."""
    return Problem(
        "package.archive_unsafe",
        say(
            "The archive {what} contains a path that leads out of it: {name}. Nothing was "
            "unpacked.",
            what=shown(what),
            name=shown(name),
        ),
        say(
            "Paths in an archive must be relative and contain no '..'. {again}",
            again=Message(AGAIN),
        ),
    )


def bomb(what: str, *, packed: str, unpacked: str) -> Problem:
    """It unpacks to many times its size."""
    return Problem(
        "package.archive_bomb",
        say(
            "The archive {what} has {packed} but unpacks to more than {unpacked}: "
            "reading was stopped.",
            what=shown(what),
            packed=packed,
            unpacked=unpacked,
        ),
        say("Hand in only what you wrote. {again}", again=Message(AGAIN)),
    )


def too_large(what: str, reason: str) -> Problem:
    """It exceeds a limit of size or number."""
    return Problem(
        "package.archive_too_large",
        say(
            "The archive {what} is too large to grade: {reason}.",
            what=shown(what),
            reason=reason,
        ),
        say(
            "Hand in only what you wrote: no recordings, data sets or virtual environments. "
            "{again}",
            again=Message(AGAIN),
        ),
    )


def too_deep(what: str, depth: int) -> Problem:
    """Archives in archives in archives."""
    return Problem(
        "package.archive_nested",
        say(
            "{what} is nested in more than {depth} archives and was not opened.",
            what=shown(what),
            depth=depth,
        ),
        say("Pack the package once. {again}", again=Message(AGAIN)),
    )


def empty(what: str) -> Problem:
    """Nothing is in it."""
    return Problem(
        "package.archive_empty",
        say("The archive {what} is empty.", what=shown(what)),
        say("Check that the package is in it before you hand it in. {again}", again=Message(AGAIN)),
    )
