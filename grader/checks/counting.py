"""The running stage, second part: does the node count, in the right words and through its logger?"""

from __future__ import annotations

import difflib
from typing import TYPE_CHECKING

from grader.checks.faults import SPIN
from grader.checks.faults import flood
from grader.checks.faults import line_of
from grader.checks.faults import node_file
from grader.checks.faults import resource
from grader.checks.faults import traceback_of
from grader.checks.registry import Blocked
from grader.checks.registry import Failed
from grader.checks.registry import Passed
from grader.checks.registry import check

if TYPE_CHECKING:
    from grader.evidence import Evidence

INFO = 20
LOST = 1.0  # seconds before the last line of a node that ended, whose records may be lost with it
LEVELS = {10: "DEBUG", 20: "INFO", 30: "WARN", 40: "ERROR", 50: "FATAL"}


@check("run.output", depends=["run.starts"])
def output(evidence: Evidence) -> Passed:
    """The node counts: the right text, in the right order, one line each time."""
    run, wanted = evidence.run, evidence.assignment.output
    events = run.watch.counted
    expected = f"{wanted.line(0)}, {wanted.line(1)}, {wanted.line(2)}, …"
    if run.flooded:
        raise flood(evidence, expected)
    if not events:
        raise resource(evidence, expected) if run.resource else _silent(evidence, expected)
    shown = ", ".join(event.text[:80] for event in events[:4])
    where = line_of(evidence, events[0].record)
    numbers = [event.n for event in events if event.n is not None]
    if not numbers:
        raise Failed(
            expected=expected,
            actual=_difference(wanted.line(0), events[0].text),
            where=where,
            rationale="The text is compared to the letter: capitals, spaces and punctuation count.",
            fix=f"Log exactly {wanted.line(0)!r}, with the counter in place of the number.",
            mistake="run.wrong_text",
            params={"text": events[0].text[:200]},
        )
    fault = _count_fault(evidence, numbers)
    if fault:
        mistake, text, fix = fault
        raise Failed(
            expected=expected,
            actual=f"{text}: {shown}",
            where=where,
            rationale="The counter starts once, in __init__, and grows by one in each callback.",
            fix=fix,
            mistake=mistake,
        )
    _must_go_on(evidence, expected)
    advice = []
    if any(event.n is None for event in events + run.watch.events if event.due is not None):
        advice.append("Other lines come beside the count; they were not asked for.")
    return Passed(actual=f"{len(numbers)} lines: {shown}, …", advice=advice)


def _silent(evidence: Evidence, expected: str) -> Failed:
    run = evidence.run
    error, where = traceback_of(evidence, run)
    if run.ended_by_itself:
        return Failed(
            expected=expected,
            actual=f"no line came: the node stopped with {error or f'status {run.status}'}",
            where=where or node_file(evidence),
            rationale="A callback that raises an exception ends the node.",
            fix="Mend the line that the traceback shows, and run the node again.",
            mistake="run.ended_early",
            params={"error": error.partition(":")[0]},
        )
    return Failed(
        expected=expected,
        actual="no line came at all",
        where=node_file(evidence),
        rationale="Lines come from the timer's callback: create_timer(1.0, self.timer_callback) "
        "in __init__, with the callback's name and no brackets behind it.",
        fix="Make the timer in __init__ and log in its callback.",
        mistake="run.no_lines",
    )


def _count_fault(evidence: Evidence, numbers: list[int]) -> tuple[str, str, str] | None:
    """Return mistake, what is wrong and the fix, if the numbers are not start, start + step, …."""
    wanted, run = evidence.assignment.output, evidence.run
    dues = [event.due for event in run.watch.counted if event.due is not None]
    if len(dues) != len(set(dues)):
        return (
            "run.twice",
            "more than one line came at a time",
            "Make one timer only, and log once in its callback.",
        )
    if len(numbers) > 1 and len(set(numbers)) == 1:
        return (
            "run.constant_counter",
            "the number never changes",
            "Add self.counter_ += 1 to the callback, and set it to 0 only in __init__.",
        )
    steps = {b - a for a, b in zip(numbers, numbers[1:])}
    if numbers[0] != wanted.start:
        return (
            "run.wrong_start",
            f"the count starts at {numbers[0]}, not at {wanted.start}",
            f"Set the counter to {wanted.start} in __init__, and add to it after logging.",
        )
    if steps - {wanted.step}:
        return (
            "run.wrong_step",
            f"the count does not go up by {wanted.step} each time",
            f"Add {wanted.step} to the counter once in each callback, and nowhere else.",
        )
    return None


def _must_go_on(evidence: Evidence, expected: str) -> None:
    run = evidence.run
    watch = run.watch
    events = watch.counted
    last = max(event.virtual for event in events)
    silent = bool(watch.missing) and last < watch.dues[watch.missing[0]]
    few = watch.clock == "wall" and len(events) < 3
    if not run.ended_by_itself and not silent and not few:
        return
    error, where = traceback_of(evidence, run)
    if run.ended_by_itself:
        end = f"then the node ended by itself ({error or f'status {run.status}'})"
    else:
        end = "then no more came"
    raise Failed(
        expected=expected + " until Ctrl+C",
        actual=f"{len(events)} lines, {end}",
        where=where or node_file(evidence),
        rationale=SPIN,
        fix="Let the timer run on: no limit on the count, no exit in the callback.",
        mistake="run.ended_early" if run.ended_by_itself else "run.stops",
    )


def _difference(expected: str, actual: str) -> str:
    """Return the actual text with where it first differs from what was expected."""
    text = repr(actual[:200])
    if difflib.SequenceMatcher(None, expected, actual).ratio() > 0.6:
        at = next(
            (i for i, (a, b) in enumerate(zip(expected, actual)) if a != b),
            min(len(expected), len(actual)),
        )
        found, wanted = actual[at : at + 1] or "the end", expected[at : at + 1] or "the end"
        return f"{text}: at character {at + 1}, {found!r} instead of {wanted!r}"
    return text


@check("run.logger", depends=["run.starts"])
def logger(evidence: Evidence) -> Passed:
    """The lines go through the node's own logger."""
    run = evidence.run
    events = run.watch.counted
    if not events:
        raise Blocked(by="run.output")
    names = {node.name.strip("/").replace("/", ".") for node in run.nodes}
    fix = "Write self.get_logger().info(…) in the callback."
    why = (
        "A record of the logger carries level, time and the node's name, and goes to /rosout, "
        "where other programs can read it; print() only writes text on this terminal."
    )
    for event in events:
        if run.ended_by_itself and event.source == "faked" and event.wall > events[-1].wall - LOST:
            continue  # a node that ends at once can take its last records with it
        where = line_of(evidence, event.record)
        expected = "log records of the node on /rosout, level INFO"
        if event.source == "print":
            raise Failed(
                expected=expected,
                actual=f"a line that ROS never saw: {event.text[:80]!r} (print?)",
                where=where,
                rationale=why,
                fix=fix,
                mistake="run.print_not_logger",
            )
        if event.source == "faked" and event.logger not in names:
            raise _other_logger(expected, event.logger, why, fix)
        if event.source == "faked":
            raise Failed(
                expected=expected,
                actual="a line in the form of a log record that ROS never logged",
                where=where,
                rationale=why,
                fix=fix,
                mistake="run.faked_log",
            )
        if event.record is not None and event.record.name not in names:
            raise _other_logger(expected, event.record.name, why, fix)
        if event.record is not None and event.record.level != INFO:
            raise Failed(
                expected=expected,
                actual=f"level {LEVELS.get(event.record.level, event.record.level)}",
                where=where,
                rationale="Levels say how urgent a record is; a count is information.",
                fix=fix,
                mistake="run.wrong_level",
            )
    return Passed(actual=f"{len(events)} records of [{sorted(names)[0] if names else ''}], INFO")


def _other_logger(expected: str, name: str, why: str, fix: str) -> Failed:
    return Failed(
        expected=expected,
        actual=f"records of the logger [{name}], which is not the node's",
        rationale=why,
        fix=fix,
        mistake="run.other_logger",
        params={"name": name},
    )
