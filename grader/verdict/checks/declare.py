"""Declares checks.

A check is a function of a verdict's evidence. It returns `Passed` (or None, which means the same)
or raises `Failed`, `Blocked` or `Inconclusive`; it prints nothing. All that the grader knows about
a check is in its declaration; `all.py` finds the declarations of the modules beside this one.

A kind of check with parameters is a function of its use in the assignment (`grader.verdict.use.Use`,
which has the evidence): one assignment may use it several times, under different ids.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Literal

from grader.base.i18n.message import Message, Template, say
from grader.course.values import Form
from grader.report.model import Quote
from grader.verdict.checks.parameters import Parameters
from grader.verdict.outcome import Blocked, Failed, Inconclusive, Passed
from grader.verdict.use import Use

if TYPE_CHECKING:
    from grader.course.assignment import CheckUse
    from grader.verdict.evidence import Evidence


CheckFunction = Callable[["Evidence"], "Passed | None"]
Needs = Literal["files", "build", "run"]
Covers = Literal["", "files", "runs"]


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
STARTED = ("run.starts", "run.spins")
ANSWERS = (
    "service.answers",
    "parameter.accepts",
    "action.accepts",
    "action.result",
    "action.cancels",
)
"""What comes of a stimulus first: everything else that it causes follows from that."""


@dataclass(frozen=True, kw_only=True)
class Check:
    """A declared check; `title` is the first line of the function's docstring.

    For a kind with `parameters`, the title may have their names as placeholders.

    It is skipped unless the checks in `depends` passed. It is evaluated after those in `after`,
    because it uses their results, or because they name the cause of a mistake that both find.
    `needs` is what usually decides it, `quotes` what of the evidence shows why it failed. One that
    `covers` something is evaluated for each node of the assignment: its "files" and what was built
    of them, or all "runs" that start it. A use with `of:` is about that node alone.
    The stimulus that its use names after `after:` must do one of `stimulus`, if there are any.
    """

    id: str
    title: Template
    stage: Stage
    needs: Needs
    depends: tuple[str, ...]
    after: tuple[str, ...]
    quotes: Quote | None
    function: Callable[..., Passed | None] = field(repr=False)
    parameters: type[Parameters] | None = None
    stimulus: tuple[str, ...] = ()
    covers: Covers = ""

    @property
    def is_of_run(self) -> bool:
        """Whether it judges one run, with parameters of its own."""
        return self.stage == RUN and self.parameters is not None

    def title_of(self, use: CheckUse) -> Message:
        """Return the title of a use: its own, or the kind's with the values of its parameters."""
        if use.title:
            return Message("{title}", {"title": use.title})
        if self.parameters is None:
            return Message(self.title)
        given = self.parameters.model_validate(use.with_)
        values = {name: _as_word(getattr(given, name)) for name in self.parameters.model_fields}
        return Message(self.title, {**values, "node": use.of})

    def evaluate(
        self, evidence: Evidence, use: CheckUse
    ) -> Passed | Failed | Blocked | Inconclusive:
        """Return the outcome for this evidence. Any other exception is a bug of ours."""
        try:
            found = self._passed(evidence, use)
        except (Failed, Blocked, Inconclusive) as outcome:
            return outcome
        if found is not None and not isinstance(found, Passed):
            raise TypeError(f"{self.id} returned {found!r}: it must return Passed or raise Failed")
        return found or Passed()

    def _passed(self, evidence: Evidence, use: CheckUse) -> Passed | None:
        if self.parameters is None:
            return self.function(evidence)
        return self.function(Use(use, self.parameters.model_validate(use.with_), evidence))


def check(
    check_id: str,
    *,
    stage: Stage,
    needs: Needs | None = None,
    depends: Sequence[str] = (),
    after: Sequence[str] = (),
    quotes: Quote | None = None,
    covers: Covers = "",
) -> Callable[[CheckFunction], Check]:
    """Declare a check, as `Check` describes it; `needs` is the stage's unless it is given."""
    return _declare(check_id, stage, needs, depends, after, quotes, None, covers)


def kind(
    check_id: str,
    parameters: type[Parameters],
    *,
    stage: Stage | None = None,
    depends: Sequence[str] = STARTED,
    after: Sequence[str] = (),
    stimulus: Sequence[str] = (),
    covers: Covers = "",
) -> Callable[[Callable[[Use[Any]], Passed | None]], Check]:
    """Declare a kind of check with parameters, as `Check` describes it.

    It judges a run whose nodes start and spin, unless `stage` and `depends` say otherwise.
    """
    quotes: Quote | None = "before_ctrl_c" if stage is None else None
    declare = _declare(check_id, stage or RUN, None, depends, after, quotes, parameters, covers)
    return lambda function: replace(declare(function), stimulus=tuple(stimulus))


def _as_word(value: object) -> str | int | float:
    if isinstance(value, tuple):
        return ", ".join(str(one) for one in value)
    if isinstance(value, Form):
        return value.words
    return value if isinstance(value, str | int | float) else str(value)


def _declare(
    check_id: str,
    stage: Stage,
    needs: Needs | None,
    depends: Sequence[str],
    after: Sequence[str],
    quotes: Quote | None,
    parameters: type[Parameters] | None,
    covers: Covers,
) -> Callable[[Callable[..., Passed | None]], Check]:
    def declare(function: Callable[..., Passed | None]) -> Check:
        title = Template((function.__doc__ or check_id).strip().splitlines()[0].rstrip("."))
        return Check(
            id=check_id,
            parameters=parameters,
            title=title,
            stage=stage,
            needs=needs or stage.needs,
            depends=tuple(depends),
            after=tuple(after),
            quotes=quotes,
            function=function,
            covers=covers,
        )

    return declare
