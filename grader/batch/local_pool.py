"""Worker processes on this machine, kept busy, watched and replaced.

One thread, no locks: a worker that has answered gets its next task before its answer is processed,
so that no worker waits for the ledger.
"""

from __future__ import annotations

import contextlib
import os
import selectors
import subprocess
import sys
import tempfile
import time
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from dataclasses import dataclass, field
from typing import IO

from grader.base.project import CHECKOUT
from grader.batch.idleness import Idleness
from grader.batch.sandbox_proof import prove
from grader.batch.work import Answer, Done, Job, Task, Trial
from grader.sandbox.scheduling import Limit, RunClock, family

END_SECONDS = 10.0  # for a worker to end, with its sandbox, before it is killed
CHUNK = 1 << 20
IDLE_SECONDS = 0.5  # over which idle cores are measured
IDLE_CORES = 0.5
# `-m` would put the current folder first, which may be a student's
START_WORKER = """import sys
sys.path.remove("")
from grader.batch.worker import main
raise SystemExit(main(sys.argv[1:]))
"""
MOST_STDERR = 2_000  # bytes of what a crashed worker wrote


@dataclass
class Worker:
    """A worker process and the task that it is busy with."""

    process: subprocess.Popen[bytes]
    errors: IO[bytes]
    trial: Trial | None = None
    limit: Limit | None = None
    buffer: bytearray = field(default_factory=bytearray)

    @property
    def stderr_tail(self) -> str:
        """The end of what it wrote to stderr."""
        self.errors.seek(0, os.SEEK_END)
        self.errors.seek(max(0, self.errors.tell() - MOST_STDERR))
        return self.errors.read().decode(errors="replace").strip()


class LocalPool:
    """Marks submissions with worker processes on this machine."""

    def __init__(
        self,
        job: Job,
        workers: int,
        *,
        most: int = 0,
        command: tuple[str, ...] = (),
        seconds: float | None = None,
    ) -> None:
        """Keep `workers` processes, and up to `most` while cores are idle.

        `command` replaces the worker program, `seconds` the time limit of a task.
        """
        self._job = job
        self._count = workers
        self._most = max(workers, most)
        self._idleness = Idleness(IDLE_SECONDS)
        self._command = command or (sys.executable, "-c", START_WORKER)
        self._seconds = job.seconds if seconds is None else seconds
        self._workers: list[Worker] = []
        self._again: deque[Trial] = deque()
        self._alone: deque[Trial] = deque()  # what the machine's load may have left undecided

    def run(
        self, tasks: Iterable[Task], *, started: Callable[[Task], None]
    ) -> Generator[Done, None, None]:
        """Mark the tasks and yield each when it is done; closing the generator ends the workers."""
        waiting = iter(tasks)
        selector = selectors.DefaultSelector()
        try:
            while True:
                self._feed(waiting, selector, started)
                busy = [worker for worker in self._workers if worker.trial is not None]
                if not busy:
                    return
                yield from self._next_done(busy, selector, waiting, started)
        finally:
            self._end()
            selector.close()

    def prove(self) -> None:
        """Open the sandbox once more and try it; raise SurroundingsError if it does not work."""
        prove(self._job)

    def _feed(
        self,
        waiting: Iterator[Task],
        selector: selectors.BaseSelector,
        started: Callable[[Task], None],
    ) -> None:
        """Give every idle worker a task, and start more workers while tasks are left."""
        while True:
            busy = sum(worker.trial is not None for worker in self._workers)
            if busy >= self._count and not self._may_add_worker(busy):
                return
            idle = next((worker for worker in self._workers if worker.trial is None), None)
            trial = self._next_trial(waiting, busy)
            if trial is None:
                return
            worker = idle or self._start(selector)
            if trial.tries == 0:
                started(trial.task)
            self._give(worker, trial)

    def _next_trial(self, waiting: Iterator[Task], busy: int) -> Trial | None:
        """Return what to mark next beside `busy` others, None if nothing can be.

        What was left undecided is tried again at the end, with nothing beside it.
        """
        if any(worker.trial is not None and worker.trial.undecided for worker in self._workers):
            return None
        if self._again:
            return self._again.popleft()
        task = next(waiting, None)
        if task is not None:
            return Trial(task, self._seconds)
        return self._alone.popleft() if self._alone and not busy else None

    def _may_add_worker(self, busy: int) -> bool:
        """Whether a core is idle: a node on the wall clock, or one that hangs, only waits."""
        return busy < self._most and self._idleness.cores() > IDLE_CORES

    def _start(self, selector: selectors.BaseSelector) -> Worker:
        errors = tempfile.TemporaryFile()  # noqa: SIM115 - closed with its worker
        process = subprocess.Popen(
            [*self._command, str(os.getpid())],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=errors,
            start_new_session=True,
            env={**os.environ, "PYTHONPATH": os.pathsep.join(_python_path())},
        )
        worker = Worker(process, errors)
        self._workers.append(worker)
        assert process.stdout is not None
        selector.register(process.stdout, selectors.EVENT_READ, worker)
        _send(worker, self._job.to_text())
        return worker

    def _give(self, worker: Worker, trial: Trial) -> None:
        worker.trial = trial
        pid = worker.process.pid
        worker.limit = RunClock(lambda: family(pid)).limit(self._seconds)
        trial.tries += 1
        _send(worker, trial.task.to_text())

    def _next_done(
        self,
        busy: list[Worker],
        selector: selectors.BaseSelector,
        waiting: Iterator[Task],
        started: Callable[[Task], None],
    ) -> Iterator[Done]:
        """Wait for the next answer, crash or deadline, and yield the finished tasks."""
        until = min(worker.limit.slice for worker in busy if worker.limit is not None)
        ready = [key.data for key, _ in selector.select(until)]
        for worker in ready:
            answer = self._read(worker, selector)
            if answer is None:
                continue
            trial, worker.trial = worker.trial, None
            self._feed(waiting, selector, started)
            if trial is not None:
                yield from self._done(trial, answer)
        for worker in busy:
            if worker.trial is not None and worker.limit is not None and worker.limit.over:
                trial = worker.trial
                self._remove(worker, selector)
                why = f"it was not done within {self._seconds:.0f} s, so its worker was killed"
                yield from self._done(trial, Answer(fault=why, seconds=self._seconds))

    def _read(self, worker: Worker, selector: selectors.BaseSelector) -> Answer | None:
        """Return a complete answer, or the worker's crash as one; None while more is to come."""
        assert worker.process.stdout is not None
        data = os.read(worker.process.stdout.fileno(), CHUNK)
        worker.buffer += data
        if data and not worker.buffer.endswith(b"\n"):
            return None
        if not data:
            stderr = worker.stderr_tail
            self._remove(worker, selector)
            return Answer(fault=f"the worker process crashed{f': {stderr}' if stderr else ''}")
        try:
            found = Answer.from_text(worker.buffer.decode())
        except ValueError as error:
            self._remove(worker, selector)
            return Answer(fault=f"the worker process sent an invalid answer: {error}")
        worker.buffer.clear()
        return found

    def _done(self, trial: Trial, answer: Answer) -> Iterator[Done]:
        """Yield the task if it is done; put it aside if another try may yield more."""
        done = trial.add(answer)
        if done is None:
            (self._alone if trial.undecided else self._again).append(trial)
        else:
            yield done

    def _remove(self, worker: Worker, selector: selectors.BaseSelector) -> None:
        """Kill a worker; its sandbox ends with it."""
        assert worker.process.stdout is not None
        selector.unregister(worker.process.stdout)
        self._workers.remove(worker)
        worker.process.kill()
        _close(worker)

    def _end(self) -> None:
        """End all workers: an idle one ends with its input, a busy one gets SIGTERM."""
        for worker in self._workers:
            if worker.trial is not None:
                worker.process.terminate()
            assert worker.process.stdin is not None
            with contextlib.suppress(OSError):
                worker.process.stdin.close()
        deadline = time.monotonic() + END_SECONDS
        for worker in self._workers:
            try:
                worker.process.wait(max(0.0, deadline - time.monotonic()))
            except subprocess.TimeoutExpired:
                worker.process.kill()
            _close(worker)
        self._workers.clear()


def _send(worker: Worker, text: str) -> None:
    """Write one line; a crashed worker is noticed when its output is read."""
    assert worker.process.stdin is not None
    with contextlib.suppress(OSError):
        worker.process.stdin.write(text.encode() + b"\n")
        worker.process.stdin.flush()


def _close(worker: Worker) -> None:
    worker.process.wait()
    for stream in (worker.process.stdin, worker.process.stdout, worker.errors):
        if stream is not None:
            with contextlib.suppress(OSError):
                stream.close()


def _python_path() -> list[str]:
    """Return where a worker finds this grader: the current folder may be another one."""
    return [str(CHECKOUT), *filter(None, [os.environ.get("PYTHONPATH", "")])]
