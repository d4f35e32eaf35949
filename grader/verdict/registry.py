"""How a check is declared and what it may say.

A check is a function of a `Verdict`'s evidence. It returns `Passed` (or None, which is the same)
or raises `Failed`, `Blocked` or `Inconclusive`; it prints nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from collections.abc import Mapping
from collections.abc import Sequence
from dataclasses import dataclass
from dataclasses import field
from typing import TYPE_CHECKING

from grader.base.i18n.message import Message
from grader.base.i18n.message import Value
from grader.mistakes.catalogue import CATALOGUE
from grader.report.model import Mistake
from grader.report.model import Where

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence


@dataclass(frozen=True, kw_only=True)
class Passed:
    """The check holds; `actual` is what was found, `advice` what could still be better."""

    actual: str = ""
    advice: Sequence[str] = ()


class Outcome(Exception):  # noqa: N818 - what a check says is not an error
    """Anything but a pass."""


class Failed(Outcome):
    """The check does not hold: which mistake it is, what was expected, what was found, and where.

    Why it matters and what to do say the catalogue's entry (its `variant`, filled with `params`,
    which the report has, and `words`, which it has not); `fix` stands for the entry's where only
    who looked knows what to do.
    """

    def __init__(
        self,
        mistake: str,
        *,
        expected: str,
        actual: str,
        params: Mapping[str, str | int | float] | None = None,
        words: Mapping[str, Value] | None = None,
        variant: str = "",
        fix: str = "",
        where: Where | None = None,
        advice: Sequence[str] = (),
    ) -> None:
        super().__init__(actual)
        kind = CATALOGUE[mistake]
        values = {**(params or {}), **(words or {})}
        self.expected = expected
        self.actual = actual
        self.rationale: str = kind.rationale(values, variant)
        self.fix: str = fix or kind.mend(values, variant)
        self.mistakes = [Mistake(id=mistake, params=dict(params or {}))]
        self.where = where
        self.advice = list(advice)


class Blocked(Outcome):
    """The check cannot be asked because another one failed: it is skipped, never failed."""

    def __init__(self, *, by: str) -> None:
        super().__init__(by)
        self.by = by


class Inconclusive(Outcome):
    """Our side, or the load of the machine, kept us from knowing."""

    def __init__(self, reason: str) -> None:
        super().__init__(reason)
        self.reason = reason


CheckFunction = Callable[["Evidence"], "Passed | None"]


@dataclass(frozen=True)
class Check:
    """A declared check; `title` is the first line of the function's docstring."""

    id: str
    title: str
    depends: tuple[str, ...]
    function: CheckFunction = field(repr=False)

    def ask(self, evidence: Evidence) -> Passed | Failed | Blocked | Inconclusive:
        """Return what it says of this evidence. What else it raises is a fault of ours."""
        try:
            return self.function(evidence) or Passed()
        except (Failed, Blocked, Inconclusive) as outcome:
            return outcome


def check(check_id: str, *, depends: Sequence[str] = ()) -> Callable[[CheckFunction], Check]:
    """Declare a check: its id, and the checks without which it makes no sense to ask."""

    def declare(function: CheckFunction) -> Check:
        title = (function.__doc__ or check_id).strip().splitlines()[0].rstrip(".")
        return Check(check_id, Message(title), tuple(depends), function)

    return declare
