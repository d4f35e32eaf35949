"""Declares checks.

A check is a function of a verdict's evidence. It returns `Passed` (or None, which means the same)
or raises `Failed`, `Blocked` or `Inconclusive`; it prints nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from grader.base.i18n.message import Message
from grader.verdict.outcome import Blocked, Failed, Inconclusive, Passed

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence


CheckFunction = Callable[["Evidence"], "Passed | None"]


@dataclass(frozen=True)
class Check:
    """A declared check; `title` is the first line of the function's docstring."""

    id: str
    title: str
    depends: tuple[str, ...]
    function: CheckFunction = field(repr=False)

    def evaluate(self, evidence: Evidence) -> Passed | Failed | Blocked | Inconclusive:
        """Return the outcome for this evidence. Any other exception is a bug of ours."""
        try:
            return self.function(evidence) or Passed()
        except (Failed, Blocked, Inconclusive) as outcome:
            return outcome


def check(check_id: str, *, depends: Sequence[str] = ()) -> Callable[[CheckFunction], Check]:
    """Declare a check: its id, and the checks that must pass before it is evaluated."""

    def declare(function: CheckFunction) -> Check:
        title = (function.__doc__ or check_id).strip().splitlines()[0].rstrip(".")
        return Check(check_id, Message(title), tuple(depends), function)

    return declare
