"""The evidence for the checks: the assignment, the submission, the build and the run."""

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
    """The evidence of one verdict; `results` has the results of the checks evaluated so far.

    The build and the run are made on first access.
    """

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
        """The build; made on first access."""
        return self._make_build()

    @property
    def run(self) -> Run:
        """The run; made on first access. Raises Inconclusive if our own side failed."""
        if self._run is None:
            if self.run_failed is not None:
                raise self.run_failed
            try:
                _ = self.build  # (a run needs a build, even if no check uses its result)
                self._run = self._make_run()
            except Unobserved as failure:
                self.run_failed = Inconclusive(str(failure))
                raise self.run_failed from failure
        return self._run

    @property
    def has_run(self) -> bool:
        """Whether the run was made."""
        return self._run is not None

    @property
    def was_built(self) -> bool:
        """Whether the build was made."""
        return "build" in self.__dict__

    def is_hidden(self, check_id: str) -> bool:
        """Whether a check is hidden from students."""
        uses = {use.id: use.visibility for use in self.assignment.checks}
        return uses.get(check_id, "visible") != "visible"

    def has_failed(self, check_id: str) -> bool:
        """Whether a check was evaluated and failed."""
        result = self.results.get(check_id)
        return result is not None and result.status == "failed"

    def has_mistake(self, check_id: str, *mistakes: str) -> bool:
        """Whether a check failed because of one of these mistakes."""
        result = self.results.get(check_id)
        return result is not None and any(m.id in mistakes for m in result.mistakes)
