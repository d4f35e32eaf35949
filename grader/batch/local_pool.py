"""Workers on this machine: processes that are kept, fed, watched and replaced.

One thread, no locks: whoever has an answer is heard, and gets its next task before the answer is
looked at, so that nobody waits for the ledger.
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
from grader.batch.proof import prove
from grader.batch.trial import Trial
from grader.batch.work import Answer, Done, Job, Task

END_SECONDS = 10.0  # in which a worker that is asked to ends, with its sandbox
CHUNK = 1 << 20
LOOK_SECONDS = 0.5  # over which a core must be idle
IDLE_CORES = 0.5
MOST_SAID = 2_000  # characters of a dead worker's last words


@dataclass
class Worker:
    """A worker process, and what it is busy with."""

    process: subprocess.Popen[bytes]
    errors: IO[bytes]
    trial: Trial | None = None
    deadline: float = 0
    buffer: bytearray = field(default_factory=bytearray)

    @property
    def last_words(self) -> str:
        """What it said on stderr at the end."""
        self.errors.seek(0, os.SEEK_END)
        self.errors.seek(max(0, self.errors.tell() - MOST_SAID))
        return self.errors.read().decode(errors="replace").strip()


class LocalPool:
    """So many workers on this machine."""

    def __init__(
        self,
        job: Job,
        workers: int,
        *,
        most: int = 0,
        command: tuple[str, ...] = (),
        seconds: float | None = None,
    ) -> None:
        """`most` is up to how many workers there may be while cores have nothing to do, `command`
        another program that speaks as a worker does, `seconds` another time limit.
        """
        self._job = job
        self._count = workers
        self._most = max(workers, most)
        self._idleness = Idleness(LOOK_SECONDS)
        self._command = command or (sys.executable, "-m", "grader.batch.worker")
        self._seconds = job.seconds if seconds is None else seconds
        self._workers: list[Worker] = []
        self._again: deque[Trial] = deque()

    def run(
        self, tasks: Iterable[Task], *, started: Callable[[Task], None]
    ) -> Generator[Done, None, None]:
        """Mark them and yield each when it is done; leaving it early ends the workers."""
        waiting = iter(tasks)
        selector = selectors.DefaultSelector()
        try:
            while True:
                self._feed(waiting, selector, started)
                busy = [worker for worker in self._workers if worker.trial is not None]
                if not busy:
                    return
                yield from self._hear(busy, selector, waiting, started)
        finally:
            self._end()
            selector.close()

    def prove(self) -> None:
        """Open the sandbox once more and try it; SurroundingsError if it does not work."""
        prove(self._job)

    def _feed(
        self,
        waiting: Iterator[Task],
        selector: selectors.BaseSelector,
        started: Callable[[Task], None],
    ) -> None:
        """Give every idle worker something to do, and start workers while there is more to do."""
        while True:
            busy = sum(worker.trial is not None for worker in self._workers)
            if busy >= self._count and not self._may_one_more(busy):
                return
            idle = next((worker for worker in self._workers if worker.trial is None), None)
            trial = self._again.popleft() if self._again else None
            if trial is None:
                task = next(waiting, None)
                if task is None:
                    return
                trial = Trial(task, self._seconds)
            worker = idle or self._start(selector)
            if trial.tries == 0:
                started(trial.task)
            self._give(worker, trial)

    def _may_one_more(self, busy: int) -> bool:
        """Whether a core has nothing to do: a node on the wall clock, or one that hangs, waits."""
        return busy < self._most and self._idleness.cores() > IDLE_CORES

    def _start(self, selector: selectors.BaseSelector) -> Worker:
        errors = tempfile.TemporaryFile()  # noqa: SIM115 - it is closed with its worker
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
        worker.deadline = time.monotonic() + self._seconds
        trial.tries += 1
        _send(worker, trial.task.to_text())

    def _hear(
        self,
        busy: list[Worker],
        selector: selectors.BaseSelector,
        waiting: Iterator[Task],
        started: Callable[[Task], None],
    ) -> Iterator[Done]:
        """Wait for the next answer, death or deadline, and yield what is done with it."""
        until = min(worker.deadline for worker in busy) - time.monotonic()
        until = min(until, LOOK_SECONDS) if self._most > self._count else until
        ready = [key.data for key, _ in selector.select(max(0.0, until))]
        for worker in ready:
            heard = self._read(worker, selector)
            if heard is None:
                continue
            trial, worker.trial = worker.trial, None
            self._feed(waiting, selector, started)
            if trial is not None:
                yield from self._judge(trial, heard)
        for worker in busy:
            if worker.trial is not None and time.monotonic() > worker.deadline:
                trial = worker.trial
                self._lose(worker, selector)
                why = f"it was not done within {self._seconds:.0f} s, and its worker was ended"
                yield from self._judge(trial, Answer(fault=why, seconds=self._seconds))

    def _read(self, worker: Worker, selector: selectors.BaseSelector) -> Answer | None:
        """Return a whole answer, or that the worker has died; None while more is to come."""
        assert worker.process.stdout is not None
        data = os.read(worker.process.stdout.fileno(), CHUNK)
        worker.buffer += data
        if data and not worker.buffer.endswith(b"\n"):
            return None
        if not data:
            said = worker.last_words
            self._lose(worker, selector)
            return Answer(fault=f"the process that marked it has died{f': {said}' if said else ''}")
        try:
            found = Answer.from_text(worker.buffer.decode())
        except ValueError as error:
            self._lose(worker, selector)
            return Answer(fault=f"the process that marked it said something else: {error}")
        worker.buffer.clear()
        return found

    def _judge(self, trial: Trial, heard: Answer) -> Iterator[Done]:
        """Yield what is done; what another try may tell more of is put back."""
        done = trial.hear(heard)
        if done is None:
            self._again.append(trial)
        else:
            yield done

    def _lose(self, worker: Worker, selector: selectors.BaseSelector) -> None:
        """End a worker for good: the sandbox in it ends with it."""
        assert worker.process.stdout is not None
        selector.unregister(worker.process.stdout)
        self._workers.remove(worker)
        worker.process.kill()
        _close(worker)

    def _end(self) -> None:
        """End all workers: who is idle ends with its input, who is busy is asked to stop."""
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
    """Write one line; that its reader has died is heard when it is read from."""
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
    """Return where a worker finds this grader: a checkout need not be the current folder."""
    return [str(CHECKOUT), *filter(None, [os.environ.get("PYTHONPATH", "")])]
