"""What the checks may look at: the assignment, the submission, and, made when first asked for, the
build and the run.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

from grader.course.assignment import Assignment
from grader.package.submission import Submission
from grader.report.model import CheckResult
from grader.run.run import Run
from grader.run.session import Unobserved
from grader.run.workspace import Build
from grader.verdict.outcome import Inconclusive


class Evidence:
    """The evidence of one verdict; `results` holds the checks that are decided."""

    def __init__(
        self,
        assignment: Assignment,
        submission: Submission,
        *,
        build: Callable[[], Build],
        run: Callable[[], Run],
    ) -> None:
        self.assignment = assignment
        self.submission = submission
        self.results: dict[str, CheckResult] = {}
        self._make_build = build
        self._make_run = run
        self._run: Run | None = None
        self.run_failed: Inconclusive | None = None

    @cached_property
    def build(self) -> Build:
        """The build; made now if nobody has asked before."""
        return self._make_build()

    @property
    def run(self) -> Run:
        """The run; made now if nobody has asked before. Raises Inconclusive where it failed us."""
        if self._run is None:
            if self.run_failed is not None:
                raise self.run_failed
            try:
                _ = self.build  # also where no check asks how it went
                self._run = self._make_run()
            except Unobserved as failure:
                self.run_failed = Inconclusive(str(failure))
                raise self.run_failed from failure
        return self._run

    @property
    def has_run(self) -> bool:
        """Whether there is a run to look at."""
        return self._run is not None

    @property
    def was_built(self) -> bool:
        """Whether somebody has asked for the build."""
        return "build" in self.__dict__

    def is_hidden(self, check_id: str) -> bool:
        """Whether students do not see a check."""
        uses = {use.id: use.visibility for use in self.assignment.checks}
        return uses.get(check_id, "visible") != "visible"

    def has_failed(self, check_id: str) -> bool:
        """Whether a check was decided and failed."""
        result = self.results.get(check_id)
        return result is not None and result.status == "failed"

    def has_mistake(self, check_id: str, *mistakes: str) -> bool:
        """Whether a check failed for one of these mistakes."""
        result = self.results.get(check_id)
        return result is not None and any(m.id in mistakes for m in result.mistakes)
