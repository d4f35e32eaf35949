"""The kind of check for a count: does the node write the right lines in the right order?"""

from __future__ import annotations

import re
from collections import Counter
from itertools import pairwise
from typing import TYPE_CHECKING

from pydantic import Field, field_validator

from grader.base.i18n.message import Message, joined, say, say_plural
from grader.base.nearest import compared, with_difference
from grader.base.shown import shown as shown_code
from grader.base.yaml_model import broken
from grader.course.assignment import Count
from grader.mistakes.made_by import lines_that_make
from grader.run.observer import without_tracebacks
from grader.verdict.checks.declare import kind
from grader.verdict.checks.faults import (
    flood,
    line_of,
    node_file,
    only_here,
    resource,
    traceback_of,
    words,
)
from grader.verdict.checks.lines import CALLS, numbered, records, such_lines
from grader.verdict.checks.parameters import Parameters
from grader.verdict.node_files import source_of_node
from grader.verdict.outcome import Blocked, Failed, Passed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from grader.run.observer import Event, Watch
    from grader.run.run import Run
    from grader.verdict.evidence import Evidence
    from grader.verdict.use import Use

SILENT = 2.5  # of the longest time between two lines, after which none is to come
FOLLOWED = ("run.constant_counter", "run.wrong_start", "run.wrong_step")
MISSED = 1.5  # periods after the last line, when the next one should have come
NUMBER = re.compile(r"-?\d+(?:[.,:]\d+)*")
MOST_DIGITS = 20  # of a number that is compared; int() refuses more than 4,300


class Counts(Parameters, Count):
    """A line that counts: `text` has {n} once; the numbers go up from `start` by `step`."""

    at_least: int = Field(default=2, ge=2)

    @field_validator("text")
    @classmethod
    def _has_number(cls, text: str) -> str:
        if text.count("{n}") != 1:
            raise broken("text must contain {n} exactly once")
        return text


@kind("log.counts", Counts, depends=["run.starts"], after=["graph.node_name"])
def counts(use: Use[Counts]) -> Passed:
    """The node counts: the right text, in the right order, one line each time."""
    wanted = use.given
    expected = f"{wanted.line(0)}, {wanted.line(1)}, {wanted.line(2)}, …"
    if use.in_scenario:
        return _in_scenario(use, expected)
    return _line_by_line(use.evidence, wanted, expected)


def _in_scenario(use: Use[Counts], expected: str) -> Passed:
    use.require_window()
    found = records(use, numbered(use.given.text))
    if len(found) < use.given.at_least:
        where = use.call(*CALLS)
        actual = such_lines(len(found))
        raise Failed("log.missing", expected=expected, actual=actual, where=where)
    for k, event in enumerate(found):
        due = use.given.line(k)
        if event.text != due:
            raise Failed(
                "log.wrong_count",
                expected=due,
                actual=with_difference(event.text, event.text, due),
                where=line_of(use.evidence, event.record),
            )
    return Passed(actual=such_lines(len(found)))


def _line_by_line(evidence: Evidence, wanted: Count, expected: str) -> Passed:
    run = evidence.run
    events = run.watch.counted
    if run.flooded:
        raise flood(evidence, expected)
    if run.erased:
        raise Failed(
            "run.erased",
            expected=expected,
            actual=say("the lines were erased or hidden as soon as they were printed"),
            where=node_file(evidence),
            variant="logs" if _logs(evidence) else "",
            words=words(evidence),
        )
    if not events:
        if evidence.has_failed("run.spins") and not run.resource:
            raise Blocked(by="run.spins")
        raise resource(evidence, expected) if run.resource else _silent(evidence, expected)
    first = _first_wrong(events, wanted.step)
    shown = ", ".join(event.text[:80] for event in events[first : first + 4])
    numbers = [event.n for event in events if event.n is not None]
    other = events[0] if events[0].n is None else _in_other_form(evidence, wanted)
    if not numbers or other is not None:
        other = other or events[0]
        made = _made_by(evidence, only_texts=True)
        raise Failed(
            "run.wrong_text",
            expected=expected,
            actual=_difference(wanted.line(0), other.text),
            where=line_of(evidence, other.record),
            params={"text": other.text[:200]},
            variant="lines" if made else "",
            words={**words(evidence), "lines": made} if made else words(evidence),
            advice=_other_start(events, wanted),
        )
    mistake, text = _count_fault(run, wanted, numbers)
    if mistake == "run.twice":
        shown = ", ".join(event.text[:80] for event in _at_one_time(events)[:4])
    if mistake:
        made = _made_by(evidence) if mistake in FOLLOWED else None
        raise Failed(
            mistake,
            expected=expected,
            actual=joined(text, shown, by=": "),
            where=line_of(evidence, events[0].record),
            variant="lines" if made else "",
            words={**words(evidence), "lines": made} if made else words(evidence),
        )
    _must_stay_a_count(evidence, wanted, expected)
    _must_go_on(evidence, expected)
    if run.confirmed is False:
        raise _only_when_marked(evidence, expected)
    advice = []
    if any(event.n is None for event in events + run.watch.events if event.due is not None):
        advice.append(
            say("There are other lines besides the count; the exercise does not ask for them.")
        )
    lines = say("{count} lines: {shown}, …", count=len(numbers), shown=shown)
    return Passed(actual=lines, advice=advice)


def _in_other_form(evidence: Evidence, wanted: Count) -> Event | None:
    """Return the first line of the count if only its later numbers have the required form.

    A number with blanks before it has the right form when it is long enough.
    """
    watch = evidence.run.watch
    first = watch.counted[0]
    if first.n is None or first.n == wanted.start:
        return None
    before = [
        event
        for event in without_tracebacks(watch.events)
        if event.n is None and event.wall < first.wall and event.kind == first.kind
    ]
    if wanted.start + len(before) * wanted.step != first.n:
        return None
    return before[0] if compared(before[0].text, wanted.line(0)) else None


def _other_start(events: list[Event], wanted: Count) -> list[Message]:
    """Return advice on the first number of lines that have another text, if that is wrong too."""
    numbers = NUMBER.findall(events[0].text)
    if events[0].n is not None or len(numbers) != 1 or not numbers[0].isdecimal():
        return []
    if len(numbers[0]) > MOST_DIGITS or int(numbers[0]) == wanted.start:
        return []
    return [
        say(
            "The number of the first line is wrong too: it has to be {start}, and it is {n}. Look at "
            "the counter's first value, and at whether it changes before or after the log line.",
            start=wanted.start,
            n=numbers[0],
        )
    ]


def _first_wrong(events: list[Event], step: int) -> int:
    """Return the index of the line before the first one that does not follow it; 0 if all do."""
    for at, (before, after) in enumerate(zip(events, events[1:])):
        if before.n is None or after.n is None or after.n - before.n == step:
            continue
        return max(0, at - 1)
    return 0


def _silent(evidence: Evidence, expected: str) -> Failed:
    run = evidence.run
    error, where = traceback_of(evidence, run)
    if run.ended_by_itself:
        error_or_status = error or _status(evidence)
        ended = say("no line came: the node stopped with {error}", error=error_or_status)
        before = len(list(without_tracebacks(run.watch.events)))
        if before:
            ended = _ended_after(before, error_or_status)
        return Failed(
            "run.ended_early",
            expected=expected,
            actual=ended,
            where=where or node_file(evidence),
            variant="callback" if error else "",
            params={"error": error.partition(":")[0]},
            words=words(evidence),
        )
    source = source_of_node(evidence)
    events = without_tracebacks(run.watch.events)
    others = [e for e in events if e.record is not None and e.record.file.endswith(".py")]
    nothing = say("no line came at all")
    if others:
        nothing = say("no line of the count came, only: {line}", line=others[0].text[:80])
    return Failed(
        "run.no_lines",
        expected=expected,
        actual=nothing,
        where=node_file(evidence),
        variant="timer" if source is not None and source.timers else "",
        words=words(evidence),
    )


def _ended_after(lines: int, error: str) -> Message:
    return say_plural(
        "1 line, then the node ended by itself ({error})",
        "{count} lines, then the node ended by itself ({error})",
        lines,
        error=error,
    )


def _status(evidence: Evidence) -> str:
    return say("status {status}", status=str(evidence.run.status))


def _count_fault(run: Run, wanted: Count, numbers: list[int]) -> tuple[str, str]:
    """Return the mistake and what was found if the numbers are not start, start + step, ….

    Both are empty if the numbers are right.
    """
    if _at_one_time(run.watch.counted):
        return "run.twice", say("several lines came at the same time")
    if len(numbers) > 1 and len(set(numbers)) == 1:
        return "run.constant_counter", say("the number never changes")
    steps = {b - a for a, b in zip(numbers, numbers[1:])}
    if numbers[0] != wanted.start:
        first, start = str(numbers[0]), wanted.start
        said = say("the count starts at {first}, not at {start}", first=first, start=start)
        if steps - {wanted.step}:
            more = say("it does not go up by {step} each time", step=wanted.step)
            said = joined(said, more, by="; ")
        return "run.wrong_start", said
    if steps - {wanted.step}:
        said = say("the count does not go up by {step} each time", step=wanted.step)
        return "run.wrong_step", said
    return "", ""


def _at_one_time(events: Sequence[Event]) -> list[Event]:
    """Return the events of the first instant at which there are several, [] if there is none."""
    lines = Counter(event.due for event in events if event.due is not None)
    due = next((due for due, count in lines.items() if count > 1), -1)
    return [event for event in events if event.due == due]


def _must_stay_a_count(evidence: Evidence, wanted: Count, expected: str) -> None:
    """Raise Failed if other lines come in place of the count after some of its lines."""
    watch = evidence.run.watch
    other = _in_place_of_the_next(watch, evidence.assignment.output.period)
    if other is None:
        return
    own = [event for event in watch.counted if event.n is not None]
    count = sum(event.wall < other.wall for event in own)
    due = wanted.line(count)
    if compared(other.text, due) or _is_called_again(other, own[-1]):
        raise Failed(
            "run.wrong_text",
            expected=expected,
            actual=_difference(due, other.text),
            where=line_of(evidence, other.record),
            params={"text": other.text[:200]},
            variant="later",
            words={**words(evidence), "line": due, "count": count},
        )
    raise Failed(
        "run.stops",
        expected=say("{lines} until Ctrl+C", lines=expected),
        actual=say_plural(
            "1 line of the count, then another text came: {text}",
            "{count} lines of the count, then another text came: {text}",
            count,
            text=shown_code(other.text[:80]),
        ),
        where=line_of(evidence, other.record),
        words=words(evidence),
    )


def _in_place_of_the_next(watch: Watch, period: float) -> Event | None:
    """Return the first line that came when the count should have gone on, None if it did."""
    own = [event for event in watch.counted if event.n is not None]
    events = list(without_tracebacks(watch.events))
    # (of another period: no line is at a due instant, but the same call logged it)
    late = [event for event in events if _is_called_again(event, own[-1])]
    if watch.clock == "virtual":
        last = max((event.due for event in own if event.due is not None), default=len(watch.dues))
        late += [event for event in events if event.due is not None and event.due > last]
    else:
        end = max(event.wall for event in own) + MISSED * period
        late += [event for event in events if event.wall > end]
    return late[0] if late else None


def _is_called_again(event: Event, last: Event) -> bool:
    """Whether the log call of the last line of the count logged another text after it."""
    called = event.record is not None and event.record.line > 0
    return called and event.n is None and event.kind == last.kind and event.wall > last.wall


def _must_go_on(evidence: Evidence, expected: str) -> None:
    run = evidence.run
    watch = run.watch
    events = watch.counted
    silent = _is_silent(evidence)
    few = watch.clock == "wall" and len(events) < 3
    if not run.ended_by_itself and not silent and not few:
        return
    error, where = traceback_of(evidence, run)
    until = say("{lines} until Ctrl+C", lines=expected)
    if run.ended_by_itself:
        raise Failed(
            "run.ended_early",
            expected=until,
            actual=_ended_after(len(events), error or _status(evidence)),
            where=where or node_file(evidence),
            variant="callback" if error else "",
            words=words(evidence),
        )
    raise _stopped(evidence, until, len(events))


def _stopped(evidence: Evidence, expected: str, lines: int) -> Failed:
    """Return the failure of a node that goes on without lines, with whether it still answers."""
    answers = evidence.run.watch.still_answers
    actual = _no_more(lines)
    if answers is not None:
        answered = say("the node still answers") if answers else say("the node no longer answers")
        actual = joined(actual, answered, by="; ")
    source = source_of_node(evidence)
    timer = source is not None and bool(source.timers)
    return Failed(
        "run.stops",
        expected=expected,
        actual=actual,
        where=line_of(evidence, evidence.run.watch.counted[-1].record),
        variant="stuck" if answers is False else "answers" if answers and timer else "",
        words=words(evidence),
    )


def _no_more(count: int) -> Message:
    return say_plural("1 line, then no more came", "{count} lines, then no more came", count)


def _logs(evidence: Evidence) -> bool:
    """Whether the node's source calls a logger."""
    source = source_of_node(evidence)
    return source is not None and bool(source.own_logs)


def _made_by(evidence: Evidence, *, only_texts: bool = False) -> Message | None:
    """Return the lines that make or change what the first line of the count shows, with their code.

    None if they are not known, or if they are too many.
    """
    source = source_of_node(evidence)
    where = line_of(evidence, evidence.run.watch.counted[0].record)
    if source is None:
        return None
    return lines_that_make(source, where, only_texts=only_texts)


def _is_silent(evidence: Evidence) -> bool:
    """Whether no line came after a due instant at which one was missing.

    A single line is the last one: the clock went on until its timer would have made another one.
    On the wall clock: whether none came for much longer than between the lines before.
    """
    watch = evidence.run.watch
    if watch.clock == "wall":
        walls = [event.wall for event in watch.counted]
        gaps = [after - before for before, after in pairwise(walls)]
        return watch.silent > SILENT * max([evidence.assignment.output.period, *gaps])
    if not watch.missing:
        return False
    events, missing = watch.counted, watch.dues[watch.missing[0]]
    last = max(event.virtual for event in events)
    return last < missing or (len(events) == 1 and watch.period is None)


def _only_when_marked(evidence: Evidence, expected: str) -> Failed:
    where = only_here(evidence)
    source = source_of_node(evidence)
    module = source.module_at(where.file) if source is not None else None
    row = module.line(where.line) if module is not None else ""
    simulated = "use_sim_time" in row and not row.startswith(("if ", "elif ", "while "))
    return Failed(
        "run.only_when_marked",
        expected=expected,
        actual=say("the right lines under simulated time, but not in a plain ros2 run"),
        where=where,
        variant="sim_time" if simulated else "",
        words=words(evidence),
    )


def _difference(wanted: str, found: str) -> str:
    """Return what was found, with the difference marked if it is similar to what was wanted."""
    return compared(found, wanted) or repr(found[:200])
