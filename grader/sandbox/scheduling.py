"""The time of a run: it stands still while one of the run's processes waits for a core.

No wall-clock limit decides a point. On a busy machine everything takes longer, and what a limit ends
may only have had no core. So every limit on a build, a run or a part of it is measured by a
`RunClock`: what it ends has been given that much time in which no process of the run waited for a
core, whatever the load. On a machine that is so busy that there is hardly any such time, the clock
goes on at a fortieth of the wall clock nevertheless, so that everything comes to an end; a limit
that is reached in that way is no evidence (`RunClock.starved`).

A program that keeps every core busy makes the others wait, and that time is its own: waiting counts
at most as much as the processes of others ran.

Sources: the kernel's documentation, scheduler/sched-stats ("/proc/<pid>/schedstat": nanoseconds on a
core, nanoseconds waiting on a run queue, time slices); proc_stat(5) (steal: a core that the virtual
machine did not get).
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass

from grader.base.errors import SurroundingsError

SECOND = 1_000_000_000
STRETCH = 40.0
"""How many times its limit of wall time something may take at most, on however busy a machine."""
SAMPLE_SECONDS = 0.02  # of wall time between two looks at the processes
LOOKS_COST = 20  # times its own duration until the next look, so that it takes 5 % of a core
PACE_SECONDS = 1.0  # of wall time over which the pace is measured
SLICE_SECONDS = 0.25  # of wall time for which one may wait without asking the clock
MOST_OWED = 0.5  # seconds of a wait that the kernel counts when it is over
MOST_SPARE = 0.5  # seconds that others had a core, and for which one may wait later
FADE_SECONDS = 1.0  # in which what is known of threads side by side counts half
SHORT_SECONDS = 0.3  # of a limit for which the clock is read anew each time
NO_EVIDENCE = 0.5  # of a limit: what may pass although processes wait, before it is no evidence
CORES = os.cpu_count() or 1
TICKS = os.sysconf("SC_CLK_TCK")


def seconds_waited(pids: Collection[int]) -> float:
    """Return the seconds that the threads of these processes have waited for a core, in sum.

    Threads wait side by side, so this is at least as long as any of them was held up. Processes
    that have ended count no more.
    """
    return sum(waited for _, waited in _threads(pids).values()) / SECOND


def family(pid: int) -> set[int]:
    """Return a process and its descendants, as far as the first threads of these started them."""
    found, todo = {pid}, [pid]
    while todo:
        parent = todo.pop()
        tasks = _names(f"/proc/{parent}/task") if parent == pid else [str(parent)]
        for task in tasks:
            for word in _read(f"/proc/{parent}/task/{task}/children").split():
                if int(word) not in found:
                    found.add(int(word))
                    todo.append(int(word))
    return found


def own_family() -> set[int]:
    """Return this process and its descendants."""
    return family(os.getpid())


@dataclass(frozen=True)
class _Look:
    """What was seen at once: wall time (s), the machine's busy and stolen seconds, the threads."""

    at: float
    busy: float
    stolen: float
    threads: dict[tuple[int, str], tuple[int, int]]


class RunClock:
    """The seconds in which no process of a run waited for a core; begins at `time.monotonic`.

    `processes` returns the ids of the run's processes, the grader's own and the probe's among them.
    """

    def __init__(self, processes: Callable[[], Collection[int]] = own_family) -> None:
        self._processes = processes
        self._latest = self._look()
        self._now = self._latest.at
        self._next = self._latest.at + SAMPLE_SECONDS
        self._by_others = 0.0  # seconds that others had a core, and nobody has waited for
        self._owed = 0.0  # seconds by which it is ahead: of waits that began before they were seen
        self._passed = self._wanted = FADE_SECONDS
        self.forced = 0.0
        """Seconds by which it went on although processes waited."""
        self.starved = False
        """Whether a limit was reached only so."""
        self.pace = 1.0
        """How many seconds of wall time a second has taken lately, from 1 to STRETCH."""
        self._paced = (self._now, self._now)

    def now(self, *, at_once: bool = False) -> float:
        """Return the time; it goes on in small steps, `at_once` too, and never faster than wall time."""
        if at_once or time.monotonic() >= self._next:
            before, self._latest = self._latest, self._look()
            passed = self._latest.at - before.at
            own = passed - self._starved(before, self._latest) - self._owed
            least = passed / STRETCH
            self._owed = min(max(0.0, least - own), MOST_OWED)
            self.forced += max(0.0, least - max(own, 0.0))
            self._now += max(own, least)
            wall, passed = self._latest.at - self._paced[0], self._now - self._paced[1]
            if wall > PACE_SECONDS:
                self.pace = max(1.0, min(STRETCH, wall / max(passed, wall / STRETCH)))
                self._paced = (self._latest.at, self._now)
            cost = time.monotonic() - self._latest.at
            self._next = time.monotonic() + max(SAMPLE_SECONDS, LOOKS_COST * cost)
        return self._now

    @property
    def fair(self) -> float:
        """The time without what it went on by force: what is late by this one is late by itself."""
        return self.now() - self.forced

    def _starved(self, before: _Look, after: _Look) -> float:
        """Return the seconds since a look in which a process waited for a core of others, at most.

        The kernel counts a wait when it is over, so that it may have begun before that look: that
        part is owed to the looks that follow. Others' time on a core counts for a while.
        """
        passed = after.at - before.at
        waited = ran = 0.0
        for key, (on_core, waiting) in after.threads.items():
            ran_before, waited_before = before.threads.get(key, (0, 0))
            ran += on_core - ran_before
            waited += waiting - waited_before
        others = max(0.0, after.busy - before.busy - ran / SECOND)
        self._by_others = min(self._by_others, MOST_SPARE) + others + 2 / TICKS
        starved = min(
            waited / SECOND / self._side_by_side(passed, (ran + waited) / SECOND), self._by_others
        )
        self._by_others -= starved
        return starved + (after.stolen - before.stolen) / CORES

    def _side_by_side(self, passed: float, wanted: float) -> float:
        """Return how many threads wanted a core at once lately, at least 1.

        Threads that wait for one another wait one after the other, and what each waits holds the run
        up. Threads that compute side by side wait at the same time.
        """
        fades = 2 ** (-passed / FADE_SECONDS)
        self._passed, self._wanted = self._passed * fades + passed, self._wanted * fades + wanted
        return max(1.0, min(self._wanted / self._passed, wanted / max(passed, 1e-9)))

    def limit(self, seconds: float, *, decides: bool = True) -> Limit:
        """Return a limit that begins now; `decides` is whether its end alone is taken as evidence."""
        return Limit(self, seconds, decides=decides)

    def _look(self) -> _Look:
        at = time.monotonic()
        words = _read("/proc/stat", 400).partition("\n")[0].split()[1:9] or ["0"] * 8
        user, nice, system, _, _, irq, soft, steal = (int(word) / TICKS for word in words)
        return _Look(at, user + nice + system + irq + soft, steal, _threads(self._processes()))


class Limit:
    """A limit on something that goes on: over when so many seconds of a run's clock have passed."""

    def __init__(self, clock: RunClock, seconds: float, *, decides: bool) -> None:
        self._clock, self._seconds, self._decides = clock, seconds, decides
        self._begin = time.monotonic()
        self._end, self._forced = clock.now(at_once=seconds < SHORT_SECONDS) + seconds, clock.forced

    @property
    def left(self) -> float:
        """The seconds that are left, at least 0."""
        return max(0.0, self._end - self._clock.now())

    @property
    def slice(self) -> float:
        """The seconds of wall time to wait before the limit is looked at again."""
        return min(self.left, SLICE_SECONDS)

    @property
    def rest(self) -> float:
        """The seconds for which something is tried again: what is left, at least for a look."""
        return max(self.left, SLICE_SECONDS)

    @property
    def over(self) -> bool:
        """Whether the time is over; notes in the clock if it only seems so."""
        if time.monotonic() < self._begin + self._seconds:  # (it is never faster)
            return False
        over = self._clock.now(at_once=self._seconds < SHORT_SECONDS) >= self._end
        self._clock.starved |= over and self._decides and self._is_starved
        return over

    def decide(self) -> None:
        """Take its end as evidence after all: note in the clock if it is none."""
        self._clock.starved |= self._is_starved

    @property
    def name(self) -> str:
        """What ended something, once it is over: "wall time", or "load" if that is no evidence."""
        return "load" if self._is_starved else "wall time"

    @property
    def _is_starved(self) -> bool:
        return self._clock.forced - self._forced > NO_EVIDENCE * self._seconds


class StarvedError(SurroundingsError):
    """The machine was too busy: what a limit ended had hardly had a core."""


def _threads(pids: Collection[int]) -> dict[tuple[int, str], tuple[int, int]]:
    return {key: times for pid in pids for key, times in _threads_of(pid)}


def _threads_of(pid: int) -> Iterator[tuple[tuple[int, str], tuple[int, int]]]:
    """Yield for each thread of a process its nanoseconds on a core and waiting for one."""
    for task in _names(f"/proc/{pid}/task"):
        words = _read(f"/proc/{pid}/task/{task}/schedstat").split()
        if len(words) > 1:
            yield (pid, task), (int(words[0]), int(words[1]))


def _names(folder: str) -> list[str]:
    try:
        return os.listdir(folder)  # noqa: PTH208 - twice as fast, and asked a hundred times a second
    except OSError:
        return []


def _read(path: str, size: int = 4096) -> str:
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC)
    except OSError:
        return ""
    try:
        return os.read(descriptor, size).decode()
    except OSError:
        return ""
    finally:
        os.close(descriptor)
