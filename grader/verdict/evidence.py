"""The evidence for the checks: the assignment, the submission, the build and the run."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from functools import cached_property
from typing import TYPE_CHECKING

from grader.base.errors import GraderError
from grader.base.i18n.message import say
from grader.course.assignment import Assignment
from grader.course.scenario import RunPlan, Start
from grader.package.submission import Submission
from grader.report.model import CheckResult
from grader.ros.distro import Distro
from grader.run.run import Run
from grader.run.session import Unobserved
from grader.run.workspace import Build
from grader.verdict.outcome import Inconclusive, Outcome
from grader.verdict.own_names import with_own_executables, with_own_names

if TYPE_CHECKING:
    from grader.run.variants import Trace
    from grader.verdict.found_change import FoundChange, Sought

OUR_FAULT = say("not known, because of a fault of the grader in another check")
Search = Callable[["Evidence"], "list[FoundChange]"]
"""Looks for small changes of a package after which its node counts."""
Follow = Callable[["Evidence"], "Trace | None"]
"""Follows a short run of a package's node."""
Seek = Callable[["Evidence", CheckResult], "Sought"]
"""Looks for facts of a run that explain a failed check, and for changes with which it passes."""
WithFix = Callable[[str, Submission], "AbstractContextManager[Evidence | None]"]
"""Opens the evidence of a fixed package; the text is the fix's SHA-256."""


class Evidence:
    """The evidence of one verdict; `results` has the results of the checks evaluated so far.

    `asked` is the assignment as it is, `assignment` the same with the package's own names.
    `not_blocking` has the failed checks that prevent no other check, `distro` is the ROS that the
    package is for (None: unknown). The build and the run are made on first access. `with_fix` opens
    the evidence of the package as it is after a fix, or of None; `tried` has what that showed, by
    the fix's SHA-256, and `untried` all results without a fix, once a fix was compared with them.
    `search` looks for small changes after which the node counts; `found_changes` has them (None: not
    looked for). `follow` follows a short run of the node. `seek` does both for a check of a scenario's
    run, and `sought` has what it found, by the check's id. `parts` has the results of a check for
    each node that it covers, by the check's id; see `grader.verdict.of_node`.
    """

    node, run_name, start = "", "", 0
    """The node, the run and its program that all is about, if it is about one."""

    @property
    def begin(self) -> Start | None:
        """How the run that all is about starts the node; None if it is about no run."""
        plans = self.assignment.runs if self.run_name else ()
        return next((p.start[self.start] for p in plans if p.name == self.run_name), None)

    def __init__(
        self,
        assignment: Assignment,
        submission: Submission,
        *,
        build: Callable[[], Build],
        run: Callable[[], Run],
        run_of: Callable[[RunPlan], Run] | None = None,
        with_fix: WithFix | None = None,
        search: Search | None = None,
        follow: Follow | None = None,
        seek: Seek | None = None,
    ) -> None:
        self.asked = assignment
        self.assignment = with_own_names(assignment, submission)
        self.submission = submission
        self.results: dict[str, CheckResult] = {}
        self._build_failed = False
        self.parts: dict[str, list[CheckResult]] = {}
        self.not_blocking: set[str] = set()
        self.distro: Distro | None = None
        self._make_build = build
        self._make_run = run
        self._make_run_of = run_of
        self._run: Run | None = None
        self._runs: dict[str, Run] = {}
        self._runs_failed: dict[str, Inconclusive] = {}
        self.run_failed: Inconclusive | None = None
        self.with_fix = with_fix
        self.search = search
        self.follow = follow
        self.seek = seek
        self.sought: dict[str, Sought] = {}
        self.found_changes: list[FoundChange] | None = None
        self.tried: dict[str, Evidence] = {}
        self.untried: dict[str, CheckResult] = {}

    @cached_property
    def build(self) -> Build:
        """The build; made on first access. Raises Inconclusive after a fault of ours in it."""
        if self._build_failed:
            raise Inconclusive(OUR_FAULT)
        try:
            return self._make_build()
        except (GraderError, Outcome):
            raise
        except Exception:
            self._build_failed = True
            raise

    @cached_property
    def trace(self) -> Trace | None:
        """What a followed run shows; made on first access. None if there is none."""
        return self.follow(self) if self.follow is not None else None

    @property
    def was_followed(self) -> bool:
        """Whether the followed run was asked for."""
        return "trace" in self.__dict__

    @property
    def named(self) -> Assignment:
        """The assignment with all names that the built package has, the executables' included."""
        return with_own_executables(self.assignment, self.build)

    @property
    def run(self) -> Run:
        """The run; made on first access. Raises Inconclusive if our own side failed."""
        if self.assignment.runs:
            return self.run_of(self.assignment.runs[0].name)
        if self._run is None:
            if self.run_failed is not None:
                raise self.run_failed
            try:
                _ = self.build  # (a run needs a build, even if no check uses its result)
                self._run = self._make_run()
            except Unobserved as failure:
                self.run_failed = Inconclusive(str(failure))
                raise self.run_failed from failure
            except (GraderError, Outcome):
                raise
            except Exception:
                self.run_failed = Inconclusive(OUR_FAULT)
                raise
        return self._run

    def run_of(self, name: str) -> Run:
        """Return a run of a scenario; made on first access. Raises Inconclusive as `run` does."""
        if name in self._runs_failed:
            raise self._runs_failed[name]
        if name not in self._runs:
            assert self._make_run_of is not None
            try:
                _ = self.build
                self._runs[name] = self._make_run_of(self.assignment.plan(name))
            except Unobserved as failure:
                self._runs_failed[name] = Inconclusive(str(failure))
                raise self._runs_failed[name] from failure
            except (GraderError, Outcome):
                raise
            except Exception:
                self._runs_failed[name] = Inconclusive(OUR_FAULT)
                raise
        return self._runs[name]

    @property
    def runs(self) -> tuple[Run, ...]:
        """The runs of scenarios that were made, in the order of the assignment."""
        names = [plan.name for plan in self.assignment.runs]
        return tuple(self._runs[name] for name in names if name in self._runs)

    @property
    def unobserved(self) -> dict[str, str]:
        """Why runs of scenarios could not be observed, by the run's name."""
        return {name: failed.reason for name, failed in self._runs_failed.items()}

    @property
    def has_run(self) -> bool:
        """Whether the run was made; of a scenario, the first one."""
        if self.assignment.runs:
            return self.assignment.runs[0].name in self._runs
        return self._run is not None

    @property
    def was_built(self) -> bool:
        """Whether the build was made."""
        return "build" in self.__dict__

    def is_hidden(self, check_id: str) -> bool:
        """Whether a check is hidden from students."""
        uses = {use.id: use.visibility for use in self.assignment.checks}
        return uses.get(check_id, "visible") != "visible"

    def id_of(self, kind: str) -> str:
        """Return the id of the assignment's first check of a kind; the kind if there is none."""
        return next((use.id for use in self.assignment.checks if use.kind == kind), kind)

    def has_failed(self, check_id: str) -> bool:
        """Whether a check was evaluated and failed."""
        result = self.results.get(check_id)
        return result is not None and result.status == "failed"

    def has_mistake(self, check_id: str, *mistakes: str) -> bool:
        """Whether a check failed because of one of these mistakes."""
        result = self.results.get(check_id)
        return result is not None and any(m.id in mistakes for m in result.mistakes)
