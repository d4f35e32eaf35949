"""`grader` whose classes are marked in its own process, without workers.

A task and its answer are still the text that a worker reads and writes.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Generator, Iterable
from functools import partial
from unittest import mock

from grader.batch.sandbox_proof import prove
from grader.batch.work import Answer, Done, Job, Task
from grader.cli.main import main
from grader.publish import class_run

Mark = Callable[[Job, Task], Answer]


class InProcessPool:
    """Marks one submission after the other."""

    def __init__(self, mark: Mark, job: Job, workers: int, *, most: int = 0) -> None:
        self._mark = mark
        self._job = Job.from_text(job.to_text())

    def run(
        self, tasks: Iterable[Task], *, started: Callable[[Task], None]
    ) -> Generator[Done, None, None]:
        """Mark the tasks and yield each when it is done."""
        for task in tasks:
            started(task)
            answer = self._mark(self._job, Task.from_text(task.to_text()))
            yield Done(task, Answer.from_text(answer.to_text()))

    def prove(self) -> None:
        """Raise SurroundingsError if the sandbox fails without any submission."""
        prove(self._job)


def run(mark: Mark) -> int:
    """Run the command line of this process."""
    with mock.patch.object(class_run, "LocalPool", partial(InProcessPool, mark)):
        return main(sys.argv[1:])
