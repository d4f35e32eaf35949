"""The files that were written and the errors of the others: one failure does not stop the rest."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from grader.base.errors import GraderError, SurroundingsError, UsageError


@dataclass
class Written:
    """The files that were written, and the errors of those that could not be."""

    files: list[Path] = field(default_factory=list)
    failures: list[Exception] = field(default_factory=list)

    @contextlib.contextmanager
    def collecting_errors(self) -> Iterator[None]:
        """Collect any error raised in the block, and continue after it."""
        try:
            yield
        except Exception as error:  # a bug in one output must not prevent the others
            self.failures.append(error)


def raise_failures(failures: Sequence[Exception]) -> None:
    """Raise one error for all failures; return if there are none.

    A bug (any other exception than GraderError) is raised first, with its traceback. Otherwise
    SurroundingsError (exit status 3) if the folder could not be written, else UsageError (2): one
    of the instructor's files cannot be used.
    """
    for failure in failures:
        if not isinstance(failure, GraderError):
            raise failure
    known = [failure for failure in failures if isinstance(failure, GraderError)]
    if not known:
        return
    messages = list(dict.fromkeys(str(failure) for failure in known))
    ours = any(isinstance(failure, SurroundingsError) for failure in known)
    kind = SurroundingsError if ours else UsageError
    raise kind("\n".join(messages), remedy="All other files were written; the verdicts are kept.")
