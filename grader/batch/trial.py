"""A task on its way: our own faults are tried again, a student's never."""

from __future__ import annotations

from dataclasses import dataclass, replace

from grader.batch.work import TRIES, Answer, Done, Task


@dataclass(eq=False)
class Trial:
    """How often a task was tried, and the best that came of it.

    `most` is how many seconds one try takes at the longest: when the tries together have taken more,
    there is no other.
    """

    task: Task
    most: float
    tries: int = 0
    spent: float = 0
    best: Answer | None = None

    def hear(self, answer: Answer) -> Done | None:
        """Take in an answer; return what is done with it, None if another try may tell more."""
        self.best = answer.better(self.best)
        self.spent += answer.seconds
        if self.best.doubtful and self.tries < TRIES and self.spent <= self.most:
            return None
        return Done(self.task, self._counted(self.best), self.tries)

    def _counted(self, best: Answer) -> Answer:
        """Return the answer with the number of tries in its report."""
        if best.report is None:
            return best
        return replace(best, report=best.report.model_copy(update={"attempts": self.tries}))
