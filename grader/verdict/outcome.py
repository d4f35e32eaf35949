"""The outcomes of a check: it returns `Passed` or raises another `Outcome`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from grader.base.i18n.message import Value
from grader.report.model import Mistake, Where


@dataclass(frozen=True, kw_only=True)
class Passed:
    """The check passed; `actual` is what was found, `advice` what could be better."""

    actual: str = ""
    advice: Sequence[str] = ()


class Outcome(Exception):  # noqa: N818 - an outcome is not an error
    """Any outcome except a pass."""


class Failed(Outcome):
    """The check failed: the mistake, what was expected, what was found, and where.

    The catalogue entry supplies the rationale and the fix: `variant` selects one of its texts,
    `params` and `words` fill the placeholders (only `params` are in the report). `fix` replaces
    the entry's fix if only the check knows what to do. If not `blocks`, the checks that depend on
    this one are evaluated all the same. `follows` is the earlier check whose mistake is the cause of
    this one, if nothing else is recognised.

    An instructor's own check may name a mistake of its own (`own.…`): it has no entry, so that
    `rationale` and `fix` are all that students read.
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
        rationale: str = "",
        fix: str = "",
        where: Where | None = None,
        advice: Sequence[str] = (),
        blocks: bool = True,
        follows: str = "",
    ) -> None:
        super().__init__(actual)
        self.mistake = Mistake(id=mistake, params=dict(params or {}))
        self.expected = expected
        self.actual = actual
        self.words = dict(words or {})
        self.variant = variant
        self.rationale = rationale
        self.fix = fix
        self.where = where
        self.advice = tuple(advice)
        self.blocks = blocks
        self.follows = follows


class Blocked(Outcome):
    """The check cannot be evaluated because another one failed: it is skipped, never failed."""

    def __init__(self, *, by: str) -> None:
        super().__init__(by)
        self.by = by


class Inconclusive(Outcome):
    """The check could not be decided, because of our own side or the load of the machine."""

    def __init__(self, reason: str) -> None:
        super().__init__(reason)
        self.reason = reason
