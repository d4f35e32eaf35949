"""The running stage: does the node start, under its name, and what does it put out, when?"""

from __future__ import annotations

import difflib
import re
from typing import TYPE_CHECKING

from grader.checks.build import python_error
from grader.checks.registry import Blocked
from grader.checks.registry import Failed
from grader.checks.registry import Inconclusive
from grader.checks.registry import Passed
from grader.checks.registry import check
from grader.report.model import Where

if TYPE_CHECKING:
    from grader.evidence import Evidence
    from grader.running import Run

INFO = 20
SPIN = "rclpy.spin(node) is what keeps a node alive: it waits, and calls your callbacks when due."
WALL_TOLERANCE, WALL_SLACK = 0.05, 0.02  # of the period, and seconds
FRAME = re.compile(r'File "[^"\n]*/([^"/\n]+/[^"/\n]+\.py)", line (\d+)')


@check("run.starts", depends=["entry_point.executable"])
def starts(evidence: Evidence) -> Passed:
    """`ros2 run` starts the node and it stays."""
    run = evidence.run
    if run.started:
        return Passed(actual=f"the node was on the ROS graph {run.node_seconds or 0:.1f} s later")
    if run.resource:
        raise resource(evidence, "the node starts within the limits of the sandbox")
    if run.flooded:
        raise flood(evidence, "the node starts")
    if run.ended_by_itself:
        for cause in ("source.node_file", "entry_point.mapping"):
            if evidence.has_failed(cause) and run.status:
                raise Blocked(by=cause)
        error, where = traceback_of(evidence, run)
        if error:
            raise Failed(
                expected="the node starts and runs until Ctrl+C",
                actual=f"it stopped at its start with {error}",
                where=where,
                rationale="An exception that nobody catches ends the program; the last line of "
                "the traceback names it, the line above shows where it came from.",
                fix="Mend the line shown; then colcon build is not needed again (--symlink-install)"
                ", just run it again.",
                mistake="run.died_at_start",
                params={"error": error.partition(":")[0], "text": error},
            )
        raise Failed(
            expected="the node runs until Ctrl+C",
            actual=f"it ended by itself at once, with status {run.status}",
            where=node_file(evidence),
            rationale=SPIN,
            fix="Call rclpy.spin(node) in main, after making the node (not spin_once).",
            mistake="run.exits_at_once",
        )
    raise Failed(
        expected=f"a node {evidence.assignment.node_name} on the ROS graph",
        actual="the program runs, but no node of it was seen within "
        f"{run.seconds - (run.stop_seconds or 0):.0f} s",
        where=node_file(evidence),
        rationale="A node comes into being when its class (a Node) is made, after rclpy.init().",
        fix="See that main makes the node, and that nothing before it waits (input(), a loop).",
        mistake="run.no_node",
    )


@check("run.node_name", depends=["run.starts"])
def node_name(evidence: Evidence) -> Passed:
    """The node has the name that was asked for."""
    wanted = evidence.assignment.node_name
    names = [node.name for node in evidence.run.nodes]
    if f"/{wanted}" in names:
        return Passed(actual=f"/{wanted}")
    if not names:
        raise Inconclusive("the ROS graph could not be read")
    raise Failed(
        expected=f"/{wanted}",
        actual=", ".join(names),
        where=node_file(evidence),
        rationale="The name under which ros2 node list, topics and logs show a node is the one "
        "given to super().__init__(), not that of the file or the class.",
        fix=f"Write super().__init__('{wanted}').",
        mistake="run.wrong_node_name",
        params={"name": names[0].lstrip("/")},
    )


@check("run.output", depends=["run.starts"])
def output(evidence: Evidence) -> Passed:
    """The node counts: the right text, in the right order, one line each time."""
    run, wanted = evidence.run, evidence.assignment.output
    events = run.watch.counted
    expected = f"{wanted.line(0)}, {wanted.line(1)}, {wanted.line(2)}, …"
    if run.flooded:
        raise flood(evidence, expected)
    if run.resource:
        raise resource(evidence, expected)
    if not events:
        raise _silent(evidence, expected)
    shown = ", ".join(event.text[:80] for event in events[:4])
    where = _line_of(evidence, events[0].record)
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
        where = _line_of(evidence, event.record)
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


LEVELS = {10: "DEBUG", 20: "INFO", 30: "WARN", 40: "ERROR", 50: "FATAL"}


def _other_logger(expected: str, name: str, why: str, fix: str) -> Failed:
    return Failed(
        expected=expected,
        actual=f"records of the logger [{name}], which is not the node's",
        rationale=why,
        fix=fix,
        mistake="run.other_logger",
        params={"name": name},
    )


@check("run.period", depends=["run.starts"])
def period(evidence: Evidence) -> Passed:
    """A line comes once in each period, at the right instants."""
    run, wanted = evidence.run, evidence.assignment.output
    watch = run.watch
    events = watch.counted
    if not events:
        raise Blocked(by="run.output")
    expected = f"one line every {wanted.period:g} s, the first after {wanted.period:g} s"
    if watch.clock == "wall":
        return _wall_period(evidence, expected)
    if any(event.n is not None for event in watch.before_start):
        raise Failed(
            expected=expected,
            actual="a line came before any time had passed",
            where=_line_of(evidence, watch.before_start[0].record),
            rationale="The timer calls the callback when its time has come. A call by hand "
            "(self.timer_callback() in __init__) is one too many.",
            fix="Take the call out; give create_timer the callback's name and let it call.",
            mistake="run.by_hand",
        )
    on_time = [event for event in events if event.due is not None]
    if not watch.early and (not watch.missing or (len(on_time) > 1 and watch.period is None)):
        return Passed(
            actual=f"{len(on_time)} lines, each at its instant (to 1 ms of ROS time), none between"
        )
    if watch.period is None:
        if len(events) < 2:
            raise Blocked(by="run.output")
        actual = "lines came at other instants"
    else:
        actual = f"a line about every {watch.period:.2f} s"
    raise Failed(
        expected=expected,
        actual=actual,
        where=_line_of(evidence, events[0].record),
        rationale="The first argument of create_timer is the period in seconds.",
        fix=f"Write create_timer({wanted.period!r}, self.timer_callback), once.",
        mistake="run.wrong_period",
        params={"period": round(watch.period or 0.0, 3)},
    )


def _wall_period(evidence: Evidence, expected: str) -> Passed:
    watch, wanted = evidence.run.watch, evidence.assignment.output
    if watch.period is None:
        raise Blocked(by="run.output")
    slack = wanted.period * WALL_TOLERANCE + WALL_SLACK
    actual = f"a line every {watch.period:.3f} s of wall time (median)"
    if abs(watch.period - wanted.period) <= slack:
        advice = (
            f"Judged on the wall clock, since {watch.note}. A timer made with create_timer follows "
            "ROS time, in simulation too; a loop with sleep does not."
        )
        return Passed(actual=actual, advice=[advice])
    if evidence.run.inconsistent:
        raise Inconclusive(f"{actual}, but another run differed: the machine is too busy to tell")
    raise Failed(
        expected=expected,
        actual=actual,
        where=_line_of(evidence, watch.counted[0].record),
        rationale="The first argument of create_timer is the period in seconds.",
        fix=f"Write create_timer({wanted.period!r}, self.timer_callback), once.",
        mistake="run.wrong_period",
        params={"period": round(watch.period, 3)},
    )


@check("run.interrupt", depends=["run.starts"])
def interrupt(evidence: Evidence) -> Passed:
    """Ctrl+C ends the node."""
    run = evidence.run
    if not run.interrupted:
        raise Blocked(by="run.output")
    expected = "the node ends soon after Ctrl+C"
    if run.stop_seconds is None:
        raise Failed(
            expected=expected,
            actual="it was still there and had to be killed",
            where=node_file(evidence),
            rationale="Ctrl+C sends SIGINT; Python turns it into KeyboardInterrupt, which ends "
            "rclpy.spin. Catching it and going on, or ignoring the signal, leaves the node behind.",
            fix="Catch KeyboardInterrupt around rclpy.spin only, and let main end after it.",
            mistake="run.ignores_interrupt",
        )
    last = run.transcript.rstrip()[-3000:]
    actual = f"ended {run.stop_seconds:.1f} s after Ctrl+C with status {run.status}"
    if run.status in (0, 130, 254) or run.signal == 2:
        advice = []
        if run.status == 254:
            advice = ["try: … except KeyboardInterrupt: around rclpy.spin spares the traceback."]
        return Passed(actual=actual, advice=advice)
    if "rcl_shutdown already called" in last:
        return Passed(
            actual=actual,
            advice=[
                "The traceback after Ctrl+C is known: ROS has shut down already when your "
                "rclpy.shutdown() is called. rclpy.try_shutdown() does it without."
            ],
        )
    if "ExternalShutdownException" in last or "KeyboardInterrupt" in last:
        return Passed(actual=actual)
    error, where = traceback_of(evidence, run)
    raise Failed(
        expected=expected + ", without an error of its own",
        actual=actual + (f": {error}" if error else ""),
        where=where,
        rationale="What runs after rclpy.spin is your clean-up; an error there hides the end.",
        fix="Mend the line shown, or leave it away.",
        mistake="run.error_at_stop",
        params={"error": error.partition(":")[0]},
    )


def node_file(evidence: Evidence) -> Where:
    """Return the node's file as the place of a fault that has no line."""
    return Where(file=f"{evidence.assignment.package}/{evidence.assignment.node_file}")


def _line_of(evidence: Evidence, record: object) -> Where:
    line = getattr(record, "line", None)
    file = str(getattr(record, "file", ""))
    place = node_file(evidence)
    if isinstance(line, int) and line > 0 and file.endswith(place.file):
        return Where(file=place.file, line=line)
    return place


def traceback_of(evidence: Evidence, run: Run) -> tuple[str, Where | None]:
    """Return the last error that the run printed, and the student's own line it came from."""
    error, _ = python_error(run.transcript, evidence.assignment.node_file)
    package = evidence.assignment.package
    mine = [m for m in FRAME.findall(run.transcript) if m[0].startswith(f"{package}/")]
    if not mine:
        return error, None
    return error, Where(file=mine[-1][0], line=int(mine[-1][1]))


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


def flood(evidence: Evidence, expected: str) -> Failed:
    """Return the verdict on a node that printed more than the limit."""
    return Failed(
        expected=expected,
        actual="so much output that the run was stopped after "
        f"{len(evidence.run.transcript.encode()) / 1e6:.1f} MB",
        where=node_file(evidence),
        rationale="A loop that prints without waiting fills terminals, logs and disks.",
        fix="Log in the timer's callback only, once each time.",
        mistake="run.too_much_output",
    )


def resource(evidence: Evidence, expected: str) -> Failed:
    """Return the verdict on a node that met a limit on memory or processes."""
    return Failed(
        expected=expected,
        actual=f"it met the limit on {evidence.run.resource} and was stopped",
        where=node_file(evidence),
        rationale="A node that counts needs about 60 MB of memory and one process.",
        fix="Look for a list that only grows, or for programs and threads started in a loop.",
        mistake="run.resource",
        params={"limit": evidence.run.resource},
    )
