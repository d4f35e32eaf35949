"""What a check may find: `Passed`, or an `Outcome` that it raises."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from grader.base.i18n.message import Value
from grader.report.model import Mistake, Where


@dataclass(frozen=True, kw_only=True)
class Passed:
    """The check holds; `actual` is what was found, `advice` what could still be better."""

    actual: str = ""
    advice: Sequence[str] = ()


class Outcome(Exception):  # noqa: N818 - what a check says is not an error
    """Anything but a pass."""


class Failed(Outcome):
    """The check does not hold: which mistake it is, what was expected, what was found, and where.

    The catalogue entry supplies the rationale and the fix (`variant` chooses among its texts;
    `params`, which the report has, and `words`, which it has not, fill them). `fix` replaces the
    entry's if only the check knows what to do.
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
        self.mistake = Mistake(id=mistake, params=dict(params or {}))
        self.expected = expected
        self.actual = actual
        self.words = dict(words or {})
        self.variant = variant
        self.fix = fix
        self.where = where
        self.advice = tuple(advice)


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
