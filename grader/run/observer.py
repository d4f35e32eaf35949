"""The output of a run: lines of the terminal and ROS log records, merged into events."""

from __future__ import annotations

import re
import time
from collections import Counter
from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

from grader.course.assignment import Output
from grader.run.probe_link import LEVELS, Answer, LogRecord, NodeSeen, ProbeLink
from grader.run.terminal import Line, Terminal, without_codes

SECOND = 1_000_000_000
GRACE = 0.1  # seconds of wall time within which a log record follows its line on the terminal
LATE_GRACE = 1.0  # the same for records from before the probe had discovered the node
NUMBER = re.compile(r"\d+")
BELOW_RCLPY = re.compile(r"(?:rcl|rcutils|rmw)(?:[._][\w.]{0,80})?")  # names of their loggers
FLOOD = 200  # lines per second of the run's time, above which a program does not wait between them
MOST_SLOWED = 8  # times as many lines as it has had wall time for may be due to a busy machine
COMPARED = 1_000  # characters of a log line and its record; both are cut later than that
PREFIX = 60  # bytes, about, that a log line on the terminal has in front of its text

Source = Literal["logger", "print", "faked"]


@dataclass(frozen=True)
class Event:
    """One line of the node's output: when it came, and its log record if ROS saw it.

    `virtual` and `wall` are in seconds; `n` is the number in a line of the expected form, else
    None; `due` is the index of the due instant at which it came, None if it came at another time.
    """

    text: str
    wall: float
    virtual: float
    source: Source
    n: int | None
    due: int | None = None
    record: LogRecord | None = None
    logger: str = ""

    @property
    def kind(self) -> Hashable:
        """Equal for the lines of one log call, or of one text with different numbers in it."""
        if self.record is not None and self.record.line > 0:
            return self.record.file, self.record.line
        return NUMBER.sub("#", self.text)


@dataclass
class Watch:
    """The events of a run in order, and the timing of its count.

    `while_still` is whether lines came although ROS time stood still, None if this is unknown.
    `still_answers` is whether the node answered at the end of a watch on `/clock`, None if unknown.
    `silent` is the time in seconds of the run's clock without a line of the count at the end of a
    watch on the wall clock. `held` has the seconds for which the node held up each step by itself, not by the machine's load.
    """

    clock: Literal["virtual", "wall"] | None = None
    events: list[Event] = field(default_factory=list)
    dues: list[float] = field(default_factory=list)
    early: list[Event] = field(default_factory=list)
    before_start: list[Event] = field(default_factory=list)
    missing: list[int] = field(default_factory=list)
    period: float | None = None
    settled: bool = False
    note: str = ""
    while_still: bool | None = None
    still_answers: bool | None = None
    silent: float = 0.0
    held: list[float] = field(default_factory=list)

    @property
    def counted(self) -> list[Event]:
        """The events of the count: lines of the expected form, else those that recur, else any."""
        own = [event for event in self.events if event.n is not None]
        if own:
            shapes = {_shape(event.text) for event in own}
            alike = [event for event in self.events if _shape(event.text) in shapes]
            # 00, 01, …, 09 have another form than 10, but they are one count
            return own if alike[0].n is not None or len(alike) < 2 * len(own) else alike
        before = {id(event) for event in self.before_start}
        others = [e for e in without_tracebacks(self.events) if id(e) not in before]
        repeated = recurring(others, on_wall=self.clock != "virtual")
        if repeated:
            return repeated
        moments = {event.due if self.clock == "virtual" else event.wall for event in others}
        # lines at one moment only are a message or a traceback, not a count
        return others if len(moments - {None}) > 1 else []


def _shape(text: str) -> str:
    """Return a line without its numbers, and without what fills them up to a width."""
    return re.sub(r"[ \t]+#", " #", NUMBER.sub("#", text))


def recurring(events: Iterable[Event], *, on_wall: bool) -> list[Event]:
    """Return the lines of the kind that came at most moments; [] if none came at two."""
    kinds: dict[Hashable, list[Event]] = {}
    for event in events:
        kinds.setdefault(event.kind, []).append(event)

    def moments(found: list[Event]) -> int:
        return len({event.wall if on_wall else event.virtual for event in found})

    most = max(kinds.values(), key=moments, default=[])
    return most if moments(most) > 1 else []


def without_tracebacks(events: Iterable[Event]) -> Iterator[Event]:
    """Yield the events before the first traceback, and the logged ones after it.

    A traceback reaches the terminal in pieces, at several moments, and would look like a count.
    """
    broke = False
    for event in events:
        broke = broke or (event.source == "print" and event.text.startswith("Traceback (most"))
        if not broke or event.source != "print":
            yield event


def _logged_at(record: LogRecord) -> int:
    """Return when a record was logged (ns): the sender's stamp if the time of reading agrees.

    The stamp is the more exact one on a busy machine, but a sender can write anything into it.
    """
    return record.stamp if record.agrees or not record.read else record.read


def _is_of_a_node(line: Line) -> bool:
    """Whether a line looks like a log record, and not of the libraries below rclpy.

    These libraries have log lines without records.
    """
    return line.log is not None and BELOW_RCLPY.fullmatch(line.log[2]) is None


def number_reader(output: Output) -> Callable[[str], int | None]:
    """Return a function: the number in a line of the expected form, None for any other line."""
    head, tail = output.text.split("{n}")
    pattern = re.compile(re.escape(head) + r"(-?\d{1,18})" + re.escape(tail))

    def number(text: str) -> int | None:
        match = pattern.fullmatch(text)
        if match is None or str(int(match.group(1))) != match.group(1):
            return None  # 007 is not 7
        return int(match.group(1))

    return number


@dataclass(frozen=True)
class _Unmatched:
    """A line that looks like a log record, which has not come yet.

    `came` is when it was read (`RunClock.fair`), `virtual` in ROS time; `lacks` is whether it may
    have none although it was logged: DDS loses what is sent while two are getting to know one
    another, and the publisher of a program that ends may be gone before.
    """

    line: Line
    came: float
    virtual: float
    lacks: bool


class Observer:
    """Merges the lines of the terminal with the log records of ROS.

    `others` are the terminals of more nodes.
    """

    def __init__(
        self,
        terminal: Terminal,
        probe: ProbeLink,
        output: Output,
        others: Sequence[Terminal] = (),
    ) -> None:
        self.terminal = terminal
        self.others = others
        self.probe = probe
        self.output = output
        self.number = number_reader(output)
        self.run_clock = terminal.run_clock
        self._unmatched: list[_Unmatched] = []
        self.records: list[LogRecord] = []
        self._shown: set[int] = set()  # the stamps of the records that a terminal showed
        self.now = 0.0  # virtual seconds
        self.slack = (
            0.0  # seconds of a watch on the wall clock: the node's wait for a core, by line
        )
        self._linked: float | None = None
        self.lossy = False  # whether log records may be lost without anybody's fault
        self._mirrored = True  # whether log records appear on the terminal
        self.logged = 0  # bytes that the log records would take on a terminal
        self._flooding = False  # whether lines came without a pause
        self._doubled: Counter[str] = Counter()  # answers in which a node had two log publishers

    @property
    def flooded(self) -> bool:
        """Whether the output exceeds the limit, on the terminal or on /rosout alone.

        Also if lines came without a pause: how much there is until a run ends is chance.
        """
        return self._flooding or self.terminal.flooded or self.logged >= self.terminal.most

    @property
    def doubled(self) -> str:
        """A node that had two publishers on /rosout in several answers, "" if there was none."""
        found = [name for name, count in self._doubled.items() if count > 1]
        return found[0] if found else ""

    @property
    def over(self) -> bool:
        """Whether no more output is read: the command has ended or exceeded the limit."""
        return self.terminal.ended or self.flooded

    def linked(self, nodes: Sequence[NodeSeen]) -> None:
        """Note when the probe first saw a node's /rosout publisher: older records come late."""
        if self._linked is None and any(node.rosout for node in nodes):
            self._linked = self.run_clock.fair

    def take(self, answer: Answer | None = None, *, seconds: float = 0) -> list[Event]:
        """Return the new events of a probe answer and of the terminal, in order."""
        events = [self._of_record(record) for record in (answer.logs if answer else ())]
        self._doubled.update(answer.doubled if answer else ())
        now = self.run_clock.fair
        came = [*self.terminal.read(seconds), *(line for one in self.others for line in one.read())]
        for line in came:
            for part in line.parts():
                if _is_of_a_node(part):
                    self._unmatched.append(self._unmatched_line(part, now))
                elif part.log is None and part.text.strip():
                    events.append(self._event(part.text, part.wall, "print", None))
        return events + self._match()

    def _unmatched_line(self, line: Line, came: float) -> _Unmatched:
        return _Unmatched(line, came, self.now, self.lossy)

    def _of_record(self, record: LogRecord) -> Event:
        self.records.append(record)
        self.logged += len(record.text.encode()) + PREFIX
        return self._event(record.text, _logged_at(record) / SECOND, "logger", record)

    def _event(self, text: str, wall: float, source: Source, record: LogRecord | None) -> Event:
        return Event(text, wall, self.now, source, self.number(text), record=record)

    def _match(self) -> list[Event]:
        """Return the lines that look like log records but have had none for the grace time.

        Those that may lack one are logged lines, the others are faked.
        """
        known = {
            (r.stamp, r.name, without_codes(r.text.split("\n")[0])[:COMPARED])
            for r in self.records[-4000:]
        }
        found, waiting = [], []
        for one in self._unmatched:
            assert one.line.log is not None
            level, stamp, name, text = one.line.log
            if (stamp, name, text[:COMPARED]) in known:
                self._shown.add(stamp)
            elif not self._is_overdue(one.came):
                waiting.append(one)
            elif one.lacks:
                self._shown.add(stamp)
                record = LogRecord(LEVELS.get(level.lower(), 20), name, text, "", "", 0, stamp)
                event = self._event(text, one.line.wall, "logger", record)
                found.append(replace(event, virtual=one.virtual))
            else:
                found.append(replace(self._event(text, one.line.wall, "faked", None), logger=name))
        self._unmatched = waiting
        return found

    def visible(self, events: Iterable[Event]) -> list[Event]:
        """Return the events that a terminal showed."""
        return [e for e in events if e.record is None or e.record.stamp in self._shown]

    def _is_overdue(self, came: float) -> bool:
        """Whether the log record of a line that came then should have come by now."""
        now = self.run_clock.fair
        if self._linked is None:
            return now - came > LATE_GRACE
        if came < self._linked:
            return now - self._linked > LATE_GRACE
        return now - came > GRACE

    def catch_up(self, records: Sequence[LogRecord]) -> list[Event]:
        """Wait for the records' lines on the terminal; return the events that come with them.

        A container's terminal is slower than its network. What was printed before a record comes
        before its line; what was printed after it may take as long again.
        """
        began = self.run_clock.now()
        events: list[Event] = []
        while self._mirrored and self._has_unshown(records):
            late = self.run_clock.now() - began
            self._mirrored = late < LATE_GRACE
            events += self.take(seconds=GRACE / 4)
            if not self._has_unshown(records):
                events += self.take(seconds=max(late, GRACE / 4))
        return events

    def watch_for(self, seconds: float) -> list[Event]:
        """Return the new events of a time on the wall clock."""
        deadline = time.monotonic() + seconds
        events: list[Event] = []
        while not self.over and (left := deadline - time.monotonic()) > 0:
            events += self.take(self.probe.ask("wait", seconds=min(left, 0.1)))
        return events

    def watch_still(self, seconds: float, *, decides: bool = False) -> list[Event]:
        """Do the same while ROS time stands still, when no timer of the node has lines to make.

        The seconds are of the run's clock: a node that follows the wall clock has had a core. `decides`
        is whether it means something that no line comes.
        """
        before, began = self.terminal.lines, time.monotonic()
        own = self.run_clock.now()
        limit, events = self.run_clock.limit(seconds, decides=False), list[Event]()
        while not self.over and not limit.over:
            events += self.take(self.probe.ask("wait", seconds=min(limit.slice, 0.1)))
        if decides and not events:  # (what has come needs no more time)
            limit.decide()
        slowed = (time.monotonic() - began) / MOST_SLOWED
        passed = max(self.run_clock.now() - own, slowed)
        rate = (self.terminal.lines - before) / passed
        self._flooding = self._flooding or (rate > FLOOD and not self.terminal.ended)
        return events

    def settle(self) -> list[Event]:
        """Wait until each log line has its record and each record its line, or is overdue.

        A container's terminal is slower than its network.
        """
        events: list[Event] = []
        limit = self.run_clock.limit(2 * LATE_GRACE)
        while (
            (self._unmatched or self._has_unshown(self.records[-4000:]))
            and not self.flooded
            and not limit.over
        ):
            events += self.take(self.probe.ask("wait", seconds=GRACE / 4))
        return events

    def take_last(self) -> list[Event]:
        """Return what was printed after Ctrl+C; how far a count gets until a node ends is chance.

        So is what it logs then: records of a node that is shutting down do not come on /rosout.
        """
        return [e for e in self.take() if e.source == "print" and e.n is None]

    def _has_unshown(self, records: Sequence[LogRecord]) -> bool:
        """Whether a record's line may still come on the terminal."""
        return not self.over and any(record.stamp not in self._shown for record in records)
