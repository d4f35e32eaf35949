"""Workers on other machines: a Dask cluster, each worker checked before it is used.

Submissions are sent with their contents and verdicts come back, both as text: nothing is read from
a worker's disk. A worker must have this grader, with the same source.
"""

from __future__ import annotations

import asyncio
import concurrent.futures
import contextlib
import json
import logging
import time
from collections import Counter, deque
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from grader.base.errors import GraderError, SurroundingsError
from grader.base.project import PACKAGE
from grader.batch.cluster_worker import Checked, check_here, mark_here
from grader.batch.verdict_key import NOT_MARKING, source_digest
from grader.batch.work import Answer, Done, Job, Task, Trial

if TYPE_CHECKING:
    from distributed import Client, Future

CONNECT_SECONDS = 20.0
CHECK_SECONDS = 600.0  # a worker may have to make its ROS prefix first
LOOK_SECONDS = 5.0  # between two checks for new workers
LOST = (asyncio.CancelledError, concurrent.futures.CancelledError, OSError)
ALONE_SECONDS = 60.0  # without any worker, before the run ends


class Cluster:
    """A Dask cluster, used as a context manager; only workers of equal surroundings are used."""

    def __init__(self, scheduler: str, job: Job, *, notify: Callable[[str], None]) -> None:
        """Connect and check every worker.

        Raises SurroundingsError if the scheduler does not answer or no worker can be used.
        """
        self._scheduler = scheduler
        self._job = job
        self._notify = notify
        self._checked: dict[str, Checked] = {}
        self._sent: dict[object, set[str]] = {}
        self._client = _connect(scheduler)
        self.surroundings = ""
        """The workers' surroundings key (see `verdict_key`)."""
        self.sandbox = ""

    def __enter__(self) -> Cluster:
        try:
            with self._scheduler_there():
                self._look()
        except BaseException:
            self._client.close()
            raise
        usable = Counter(c.surroundings for c in self._checked.values() if not c.problem)
        if not usable:
            self._client.close()
            problems = dict.fromkeys(c.problem for c in self._checked.values())
            raise SurroundingsError(
                f"no worker of {self._scheduler} can mark: "
                + ("\n".join(problems) or "there is none"),
                remedy="Start workers in an environment with this grader (docs/cluster.md).",
            )
        self.surroundings = usable.most_common(1)[0][0]
        self.sandbox = next(
            c.sandbox for c in self._checked.values() if c.surroundings == self.surroundings
        )
        for address in self._checked:
            self._report(address)
        return self

    def __exit__(self, *_: object) -> None:
        self._client.close()

    def run(
        self, tasks: Iterable[Task], *, started: Callable[[Task], None]
    ) -> Generator[Done, None, None]:
        """Mark the tasks and yield each when it is done; closing the generator cancels the rest.

        Raises SurroundingsError if the scheduler is gone, or every worker for a while.
        """
        waiting = iter(tasks)
        again: deque[Trial] = deque()
        running: dict[Future[str], Trial] = {}
        try:
            while True:
                with self._scheduler_there():
                    again.extend(self._without_workers(running))
                    free = self._capacity() - len(running)
                for trial in _next(waiting, again, free, self._job.seconds, started):
                    with self._scheduler_there():
                        running[self._submit(trial)] = trial
                if not running:
                    return
                with self._scheduler_there():
                    answers = [(future, _answer(future)) for future in self._wait(list(running))]
                for future, answer in answers:
                    trial = running.pop(future)
                    finished = trial.add(answer)
                    if finished is None:
                        again.append(trial)
                    else:
                        yield finished
        finally:
            if self._client.status == "running":
                with contextlib.suppress(*LOST):
                    self._client.cancel(list(running))

    def _wait(self, futures: list[Future[str]]) -> list[Future[str]]:
        """Return the futures that are done; [] after a while, so that new workers are noticed."""
        from distributed import wait  # noqa: PLC0415

        try:
            with self._client.as_current():
                done = wait(futures, timeout=LOOK_SECONDS, return_when="FIRST_COMPLETED").done
        except asyncio.TimeoutError:  # not the built-in TimeoutError before Python 3.11
            done = set()
        self._need_scheduler()  # without it, every future counts as done
        return list(done)

    def _without_workers(self, running: dict[Future[str], Trial]) -> list[Trial]:
        """Cancel and return the tasks whose workers are all gone."""
        here = set(self._workers())
        gone = [future for future in running if not self._sent[future.key] & here]
        if gone:
            self._client.cancel(gone)
        return [running.pop(future) for future in gone]

    @contextmanager
    def _scheduler_there(self) -> Iterator[None]:
        """Raise SurroundingsError instead of Dask's own errors if the scheduler is gone.

        (Dask's client cancels every future, and tries to reconnect for a while.)
        """
        try:
            yield
        except GraderError:
            raise
        except LOST:
            raise self._gone() from None
        except Exception:
            if self._client.status != "running":
                raise self._gone() from None
            raise

    def _need_scheduler(self) -> None:
        if self._client.status != "running" or not self._client.scheduler_info().get("id"):
            raise self._gone()

    def _gone(self) -> SurroundingsError:
        return SurroundingsError(
            f"the scheduler {self._scheduler} is gone",
            remedy="What was marked is kept. Start it and run the same command again.",
        )

    def prove(self) -> None:
        """Check every worker again; raise SurroundingsError if none can be used any more."""
        self._checked.clear()
        with self._scheduler_there():
            self._look()
        if not self._usable():
            problems = dict.fromkeys(c.problem for c in self._checked.values() if c.problem)
            raise SurroundingsError("no worker can mark any more: " + "\n".join(problems))

    def _submit(self, trial: Trial) -> Future[str]:
        trial.tries += 1
        workers = set(self._usable())
        future = self._client.submit(
            mark_here,
            self._job.to_text(),
            trial.task.to_text(),
            pure=False,
            workers=list(workers),
            allow_other_workers=False,
        )
        self._sent[future.key] = workers
        return future

    def _capacity(self) -> int:
        """Return how many tasks to have at the workers: one per thread, and one queued per worker.

        Waits up to `ALONE_SECONDS` if no worker is left.
        """
        deadline = time.monotonic() + ALONE_SECONDS
        while True:
            self._need_scheduler()
            self._look()
            usable = self._usable()
            if usable:
                return sum(threads + 1 for threads in usable.values())
            if time.monotonic() > deadline:
                raise SurroundingsError(
                    f"every worker of {self._scheduler} is gone",
                    remedy="What was marked is kept. Start workers and run the same command again.",
                )
            self._client.sync(_sleep, LOOK_SECONDS)

    def _usable(self) -> Mapping[str, int]:
        """Return the number of threads of each usable worker, by its address."""
        return {
            address: int(info["nthreads"])
            for address, info in self._workers().items()
            if (found := self._checked.get(address)) is not None
            and not found.problem
            and found.surroundings == self.surroundings
        }

    def _workers(self) -> Mapping[str, Mapping[str, Any]]:
        found: Mapping[str, Mapping[str, Any]] = self._client.scheduler_info(n_workers=-1).get(
            "workers", {}
        )
        return found

    def _look(self) -> None:
        """Check the workers that have joined since the last call."""
        fresh = [address for address in self._workers() if address not in self._checked]
        if not fresh:
            return
        results = self._client.run(
            check_here, self._job.to_text(), workers=fresh, on_error="return"
        )
        for address in fresh:
            text = results.get(address)
            if isinstance(text, str):
                self._checked[address] = Checked(**json.loads(text))
            else:
                self._checked[address] = Checked(problem=f"it cannot run this grader: {text!r}")
            if self.surroundings:
                self._report(address)

    def _report(self, address: str) -> None:
        found = self._checked[address]
        if found.problem:
            self._notify(f"{address} is not used: {found.problem}")
        elif found.surroundings != self.surroundings:
            same = found.grader == source_digest(PACKAGE, NOT_MARKING)
            why = f"it has another ROS ({found.ros})" if same else "it has another grader"
            self._notify(f"{address} is not used: {why}")
        else:
            self._notify(f"{address} marks in {found.sandbox} ({found.ros})")


def _connect(scheduler: str) -> Client:
    try:
        from distributed import Client  # noqa: PLC0415 - takes half a second
    except ImportError:
        raise SurroundingsError(
            "Dask is not installed, and --scheduler needs it",
            remedy="pip install 'distributed' into the grader's environment (docs/cluster.md).",
        ) from None
    for name in (
        "distributed",
        "distributed.client",
    ):  # their errors are raised as SurroundingsError
        logging.getLogger(name).setLevel(logging.CRITICAL)
    try:
        return Client(scheduler, timeout=CONNECT_SECONDS, set_as_default=False)
    except (OSError, ValueError) as error:
        raise SurroundingsError(
            f"the scheduler {scheduler} does not answer: {error}",
            remedy="Start one with `dask scheduler`; it prints the address to give: tcp://host:8786.",
        ) from None


def _next(
    waiting: Iterable[Task],
    again: deque[Trial],
    free: int,
    seconds: float,
    started: Callable[[Task], None],
) -> Iterator[Trial]:
    """Yield up to `free` tasks, those that are tried again first."""
    for _ in range(free):
        if again:
            yield again.popleft()
        else:
            task = next(iter(waiting), None)
            if task is None:
                return
            started(task)
            yield Trial(task, seconds)


def _answer(future: Future[str]) -> Answer:
    if future.status != "finished":
        return Answer(fault=f"the worker was lost: {future.exception()!r}")
    try:
        return Answer.from_text(future.result())
    except ValueError as error:
        return Answer(fault=f"the worker sent an invalid answer: {error}")


async def _sleep(seconds: float) -> None:
    await asyncio.sleep(seconds)
