"""The run stage, part 1: does the node start, keep running, and end on Ctrl+C?"""

from __future__ import annotations

import ast
import re
from typing import TYPE_CHECKING

from grader.base.i18n.message import joined, say
from grader.base.shown import shown
from grader.package.source.command_line import reads_command_line
from grader.package.source.names import SPINS, calls_in, dotted, last_part
from grader.package.source.newer_python import with_older_quotes
from grader.package.source.node import NodeSource
from grader.package.source.place import place_of
from grader.package.source.python import PythonFault, parse_python
from grader.verdict.checks.actual_node import actual_path
from grader.verdict.checks.declare import RUN, check
from grader.verdict.checks.faults import (
    FRAME,
    flood,
    going_on,
    node_file,
    resource,
    traceback_of,
    words,
)
from grader.verdict.checks.given_file import given_file_must_be_installed
from grader.verdict.checks.installed import executable_must_be_there
from grader.verdict.checks.missing_node_file import node_file_must_be_there
from grader.verdict.checks.own_interface import fault_in_traceback
from grader.verdict.node_files import source_of_node
from grader.verdict.outcome import Blocked, Failed, Inconclusive, Outcome, Passed

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

OWN_ERROR = re.compile(r"^(?:Name|UnboundLocal|Attribute|Type)Error\b", re.MULTILINE)
OF_SPIN = re.compile(r", line \d+, in _?spin")
NO_EXECUTABLE = "No executable found"  # what `ros2 run` says
SIGNALLED = 240  # ros2 run exits with minus the signal that ended the node, modulo 256


@check(
    "run.starts",
    stage=RUN,
    depends=["entry_point.executable"],
    after=["package.manifest", "source.node_file", "entry_point.mapping"],
    quotes="transcript",
    covers="runs",
)
def starts(evidence: Evidence) -> Passed:
    """ros2 run starts the node, and the node keeps running."""
    given_file_must_be_installed(evidence)
    run = evidence.run
    if run.instead:
        raise Failed(
            "entry_point.other_installed",
            variant="program",
            expected=say("the node is of the program that ros2 run starts"),
            actual=say("the node is of another program: {command}", command=shown(run.instead)),
        )
    if run.started and not _died_first(evidence):
        seconds = f"{run.node_seconds or 0:.1f}"
        said = say("the node was on the ROS graph after {seconds} s", seconds=seconds)
        return Passed(actual=said, advice=_refused_arguments(evidence))
    if run.resource:
        raise resource(evidence, say("the node starts within the limits of the sandbox"))
    if run.flooded:
        raise flood(evidence, say("the node starts"))
    if run.ended_by_itself:
        raise _ended(evidence)
    seconds = f"{run.seconds - (run.stop_seconds or 0):.0f}"
    said = say("the program runs, but no node was seen within {seconds} s", seconds=seconds)
    raise _no_node(evidence, said)


def _refused_arguments(evidence: Evidence) -> list[str]:
    """Return that the node works without ROS arguments only, if it was marked without them."""
    if not evidence.run.plain or not reads_command_line(evidence.submission.files):
        return []
    return [
        say(
            "Your program reads the command line itself and does not work with the arguments of ROS, "
            "so it was marked without them. With ros2 run … --ros-args and in launch files it gets them "
            "too. Read the list that rclpy.utilities.remove_ros_args(sys.argv) returns instead of sys.argv; with "
            "argparse, write parse_known_args()[0] instead of parse_args()."
        )
    ]


def _died_first(evidence: Evidence) -> bool:
    """Whether an error ended the program before anything was spun.

    Whether its node is seen before that is chance, so it does not count as one that has started.
    """
    run = evidence.run
    answered = run.watch.settled or any(node.answers for node in run.nodes)
    if not run.ended_by_itself or answered or len(run.watch.counted) > 1:
        return False
    error, _ = traceback_of(evidence, run)
    return bool(error) and OF_SPIN.search(run.transcript) is None


def _ended(evidence: Evidence) -> Outcome:
    """Return the outcome of a program that ended before its node was seen."""
    run = evidence.run
    if not run.command or NO_EXECUTABLE in run.transcript:
        executable_must_be_there(evidence)
    for cause in ("source.node_file", "entry_point.mapping"):
        if evidence.has_failed(cause):
            return Blocked(by=cause)
    if f"Package '{evidence.assignment.package}' not found" in run.transcript:
        for use in evidence.assignment.checks:
            is_this = use.with_.get("package") == evidence.assignment.package
            if use.kind == "package.beside" and is_this and evidence.has_failed(use.id):
                return Blocked(by=use.id)
        manifest = evidence.has_failed("package.manifest")
        return Blocked(by="package.manifest" if manifest else "build.colcon")
    error, where = traceback_of(evidence, run)
    if error.startswith("ModuleNotFoundError"):
        node_file_must_be_there(evidence)
    if error.startswith("SyntaxError"):
        python_must_be_new_enough(evidence)
    interface = fault_in_traceback(evidence, run.transcript) if error else None
    if interface is not None:
        return interface
    if error:
        return Failed(
            "run.died_at_start",
            expected=say("the node starts and runs until Ctrl+C"),
            actual=say("it stopped on startup with {error}", error=error),
            where=where,
            params={"error": error.partition(":")[0], "text": error},
        )
    if run.watch.counted and not run.nodes:
        return _no_node(evidence, say("lines came, but no node was ever on the graph"))
    source = source_of_node(evidence)
    named = source.calls if source is not None else ()
    spins = [call for call, name in named if last_part(name) == "spin"]
    own = [call for call in spins if source and _is_line(source.module_of(call).parents.get(call))]
    return Failed(
        "run.exits_at_once",
        expected=say("the node runs until Ctrl+C"),
        actual=say("it ended by itself, with status {status}", status=str(run.status)),
        where=place_of(source, own[0]) if source and own else node_file(evidence),
        variant="spins" if own else "elsewhere" if spins else "",
        words=words(evidence),
    )


def _is_line(around: ast.AST | None) -> bool:
    """Whether what is around a call is a line of its own, as it is not in a lambda."""
    return isinstance(around, ast.Expr | ast.Assign)


def python_must_be_new_enough(evidence: Evidence) -> None:
    """Raise Inconclusive if a line of the node's file needs a newer Python than this one."""
    newer, older = _newer_line(evidence)
    if newer and evidence.distro is not None:
        raise Inconclusive(
            say(
                "the f-string in line {line} of the node's file contains, in a value, the quotes that are "
                "around it. Only Python {version} and later can read that: ROS {distro} has it, but this "
                "grader runs with an older Python. Write that line so that every Python 3 can read it, "
                "and grade again: {code} (Or run the grader with that Python, make setup "
                "PYTHON=python{version}, or mark in a container.)",
                line=str(newer),
                code=shown(older),
                version=evidence.distro.python,
                distro=evidence.distro.name,
            )
        )


def _newer_line(evidence: Evidence) -> tuple[int, str]:
    """Return the line of the node's file that needs a newer Python than this one (0 if none does),
    and how it is written for every Python 3.
    """
    file = evidence.submission.file(actual_path(evidence))
    if file is None or file.kind != "file":
        return 0, ""
    try:
        parsed = parse_python(file.data)
    except PythonFault:
        return 0, ""
    older = with_older_quotes(parsed.text) if parsed.newer else None
    return parsed.newer, older.splitlines()[parsed.newer - 1].strip() if older else ""


def _no_node(evidence: Evidence, actual: str) -> Failed:
    return Failed(
        "run.no_node",
        expected=say("a node {name} on the ROS graph", name=evidence.assignment.node_name),
        actual=actual,
        where=node_file(evidence),
        words=words(evidence),
    )


def _handler_fails(last: str) -> bool:
    """Whether the last error came from the student's own handling of Ctrl+C."""
    _, handling, after = last.rpartition("During handling of the above exception")
    return bool(handling) and OWN_ERROR.search(after) is not None


def _catches_interrupt(evidence: Evidence) -> bool:
    """Whether the source has an except for Ctrl+C."""
    source = source_of_node(evidence)
    handlers = source.all_nodes if source is not None else []
    types = [n.type for n in handlers if isinstance(n, ast.ExceptHandler) and n.type is not None]
    return any("KeyboardInterrupt" in ast.unparse(named) for named in types)


def _too_narrow(source: NodeSource) -> int | None:
    """Return the line of an `except Exception` around rclpy.spin."""
    for tried in source.all_nodes:
        if not isinstance(tried, ast.Try):
            continue
        calls = [name for statement in tried.body for _, name in calls_in(statement)]
        for handler in tried.handlers if any(last_part(n) in SPINS for n in calls) else ():
            if handler.type is not None and dotted(handler.type) == "Exception":
                return handler.lineno
    return None


def _uncaught(source: NodeSource | None) -> list[str]:
    """Return what avoids the traceback of a node that does not catch Ctrl+C."""
    line = _too_narrow(source) if source is not None else None
    advice = (
        say("try: … except KeyboardInterrupt: pass around rclpy.spin avoids the traceback.")
        if line is None
        else say(
            "except Exception in line {line} does not catch Ctrl+C: in Python, KeyboardInterrupt is "
            "not an Exception. Write except KeyboardInterrupt: there to avoid the traceback.",
            line=line,
        )
    )
    if source is None or all(name != "rclpy.shutdown" for _, name in source.calls):
        return [advice]
    other = say(
        "After Ctrl+C, ROS has already shut down: with except KeyboardInterrupt, write "
        "rclpy.try_shutdown() instead of rclpy.shutdown()."
    )
    return [advice, other]


def _outside_of_try(evidence: Evidence) -> list[str]:
    """Return why Ctrl+C ends a node that does not spin with a traceback, in spite of its except."""
    _, found, trace = evidence.run.transcript.rpartition("Traceback (most recent call last):")
    source = source_of_node(evidence)
    frames = FRAME.findall(trace) if found and evidence.has_failed("run.spins") else []
    lines = [int(n) for path, n in frames if source is not None and path in source.paths]
    if not lines or "\nKeyboardInterrupt" not in trace:
        return []
    return [
        say(
            "The traceback after Ctrl+C comes from line {line}: the except KeyboardInterrupt is not "
            "around it, but around rclpy.spin, which this node does not reach.",
            line=lines[-1],
        )
    ]


@check(
    "run.interrupt",
    stage=RUN,
    depends=["run.starts"],
    after=["log.period"],
    quotes="transcript",
    covers="runs",
)
def interrupt(evidence: Evidence) -> Passed:
    """Ctrl+C ends the node."""
    run = evidence.run
    if run.done:
        return Passed(actual=say("it ended by itself, as it must"))
    if not run.interrupted:
        raise Blocked(by=going_on(evidence))
    expected = say("the node ends soon after Ctrl+C")
    if run.stop_seconds is None:
        raise Failed(
            "run.ignores_interrupt",
            expected=expected,
            actual=say("it was still running and had to be killed"),
            where=node_file(evidence),
            words=words(evidence),
        )
    last = run.transcript.rstrip()[-3000:]
    actual = say(
        "ended {seconds} s after Ctrl+C with status {status}",
        seconds=f"{run.stop_seconds:.1f}",
        status=str(run.status),
    )
    if run.status in (0, 130, 254) or run.signal == 2:
        bare = run.status == 254 and not _catches_interrupt(evidence)
        advice = _uncaught(source_of_node(evidence)) if bare else _outside_of_try(evidence)
        return Passed(actual=actual, advice=advice)
    if run.status is not None and run.status > SIGNALLED:
        crashed = say(
            "The program crashed in ROS's own clean-up after Ctrl+C: do not leave a thread "
            "spinning when {function} ends.",
            function=evidence.assignment.function,
        )
        return Passed(actual=actual, advice=[crashed])
    if "rcl_shutdown already called" in last:
        known = say(
            "The traceback after Ctrl+C is a common one: ROS has already shut down when your "
            "rclpy.shutdown() is called. rclpy.try_shutdown() avoids it."
        )
        return Passed(actual=actual, advice=[known])
    interrupted = "ExternalShutdownException" in last or "KeyboardInterrupt" in last
    if interrupted and not _handler_fails(last):
        return Passed(actual=actual)
    error, where = traceback_of(evidence, run)
    raise Failed(
        "run.error_at_stop",
        expected=say("the node ends soon after Ctrl+C, without an error of its own"),
        actual=joined(actual, error, by=": "),
        where=where,
        params={"error": error.partition(":")[0]},
        variant="" if error else "status",
        words=words(evidence),
    )
