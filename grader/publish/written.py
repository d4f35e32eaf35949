"""What was written, and what could not be: one output that fails does not stop the others."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from grader.base.errors import GraderError, SurroundingsError, UsageError


@dataclass
class Written:
    """The files that are there now, and the errors of those that are not."""

    files: list[Path] = field(default_factory=list)
    failures: list[Exception] = field(default_factory=list)

    @contextlib.contextmanager
    def going_on(self) -> Iterator[None]:
        """Keep an error of what is written inside, whatever it is, and go on."""
        try:
            yield
        except Exception as error:  # a fault of ours in one output must not cost the others
            self.failures.append(error)


def raise_failures(failures: Sequence[Exception]) -> None:
    """Raise what went wrong, all in one error; nothing if there is nothing.

    An error of ours comes first, with its traceback. SurroundingsError (exit status 3) if the
    folder could not be written, else UsageError (2): one of the teacher's files cannot be used.
    """
    for failure in failures:
        if not isinstance(failure, GraderError):
            raise failure
    known = [failure for failure in failures if isinstance(failure, GraderError)]
    if not known:
        return
    told = list(dict.fromkeys(str(failure) for failure in known))
    ours = any(isinstance(failure, SurroundingsError) for failure in known)
    kind = SurroundingsError if ours else UsageError
    raise kind("\n".join(told), remedy="All other files were written; the verdicts are kept.")
