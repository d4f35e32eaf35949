"""The errors that a user of the grader can meet, each with its exit status."""


class GraderError(Exception):
    """An error that is shown as one message and never as a traceback.

    `message` says what is wrong, `remedy` what to do next.
    """

    exit_status = 3

    def __init__(self, message: str, *, remedy: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.remedy = remedy

    def __str__(self) -> str:
        return f"{self.message}\n{self.remedy}" if self.remedy else self.message


class UsageError(GraderError):
    """Wrong usage, or a path that does not exist or cannot be read: exit status 2."""

    exit_status = 2


class SurroundingsError(GraderError):
    """The grader's own surroundings failed (no sandbox, no prefix): exit status 3."""


class AssignmentError(UsageError):
    """An assignment that cannot be used; the message has file and line."""
