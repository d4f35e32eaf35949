"""Declares checks.

A check is a function of a verdict's evidence. It returns `Passed` (or None, which means the same)
or raises `Failed`, `Blocked` or `Inconclusive`; it prints nothing. All that the grader knows about
a check is in its declaration; `all.py` finds the declarations of the modules beside this one.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

from grader.base.i18n.message import Message, say
from grader.report.model import Quote
from grader.verdict.outcome import Blocked, Failed, Inconclusive, Passed

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence


CheckFunction = Callable[["Evidence"], "Passed | None"]
Needs = Literal["files", "build", "run"]


@dataclass(frozen=True)
class Stage:
    """A stage of marking: `rank` is its place in the order, `needs` what most of its checks need."""

    rank: int
    name: str
    title: str
    needs: Needs


INTAKE = Stage(0, "intake", say("looking at the package"), "files")
BUILD = Stage(1, "build", say("building with colcon"), "build")
RUN = Stage(2, "run", say("running the node"), "run")


@dataclass(frozen=True, kw_only=True)
class Check:
    """A declared check; `title` is the first line of the function's docstring.

    It is skipped unless the checks in `depends` passed. It is evaluated after those in `after`,
    because it uses their results, or because they name the cause of a mistake that both find.
    `needs` is what usually decides it, `quotes` what of the evidence shows why it failed.
    """

    id: str
    title: str
    stage: Stage
    needs: Needs
    depends: tuple[str, ...]
    after: tuple[str, ...]
    quotes: Quote | None
    function: CheckFunction = field(repr=False)

    def evaluate(self, evidence: Evidence) -> Passed | Failed | Blocked | Inconclusive:
        """Return the outcome for this evidence. Any other exception is a bug of ours."""
        try:
            return self.function(evidence) or Passed()
        except (Failed, Blocked, Inconclusive) as outcome:
            return outcome


def check(
    check_id: str,
    *,
    stage: Stage,
    needs: Needs | None = None,
    depends: Sequence[str] = (),
    after: Sequence[str] = (),
    quotes: Quote | None = None,
) -> Callable[[CheckFunction], Check]:
    """Declare a check, as `Check` describes it; `needs` is the stage's unless it is given."""

    def declare(function: CheckFunction) -> Check:
        title = (function.__doc__ or check_id).strip().splitlines()[0].rstrip(".")
        return Check(
            id=check_id,
            title=Message(title),
            stage=stage,
            needs=needs or stage.needs,
            depends=tuple(depends),
            after=tuple(after),
            quotes=quotes,
            function=function,
        )

    return declare
