"""Shared by the checks of a run: places, tracebacks, and the failures on limits."""

from __future__ import annotations

import ast
import re
from typing import TYPE_CHECKING

from grader.base.i18n.message import Value, say
from grader.base.shown import shown
from grader.mistakes.placeholders import placeholder_values
from grader.package.source.remarks import remarks_on
from grader.package.source.telling import telling
from grader.report.model import Where
from grader.verdict.checks.actual_node import actual_path
from grader.verdict.checks.build_log import python_error
from grader.verdict.node_files import source_of_node
from grader.verdict.outcome import Failed

if TYPE_CHECKING:
    from grader.run.probe_link import LogRecord
    from grader.run.run import Run
    from grader.verdict.evidence import Evidence

HANDLING = "During handling of the above exception, another exception occurred:"
MOST_CAUSES = 5
SUGGESTION = re.compile(r"\. Did you (?:mean|forget)\b.*")
ABORTED = re.compile(r"Assertion `\w+\(field\)' failed")
FRAME = re.compile(r'File "[^"\n]*/([^"/\n]+/[^"/\n]+\.py)", line (\d+)')
CALL = re.compile(r'^ +File "([^"\n]+)", line (\d+)(?:, in (.+))?$', re.MULTILINE)
EXCEPT = re.compile(
    r'^ +File "[^"\n]+", line \d+.*\n +except\b.*\n(?: +[~^]+\n)?\w*Error: ', re.MULTILINE
)
"""The end of a traceback that was raised in an `except` line itself."""
TRACEBACK = "Traceback (most recent call last):"
CHAINED = (HANDLING, "The above exception was the direct cause of the following exception:")


def node_file(evidence: Evidence) -> Where:
    """Return the node's file as the place of a fault without a line."""
    return Where(file=shown(actual_path(evidence)))


def call_in(evidence: Evidence, *names: str, mentions: str = "") -> Where:
    """Return the line of the node's first call of one of these names, else the node's file.

    A call with the text `mentions` among its arguments comes before the others.
    """
    source = source_of_node(evidence)
    found = source.calls_of(*names) if source is not None else []
    if source is None or not found:
        return node_file(evidence)
    wanted = mentions.strip("/")
    best = next((one for one in found if wanted and wanted in ast.unparse(one)), found[0])
    return Where(file=source.module_of(best).path, line=best.lineno)


def only_here(evidence: Evidence) -> Where:
    """Return where the source could tell that it is marked."""
    found = [
        *telling(evidence.submission.files),
        *(one for one in remarks_on(evidence.submission.files) if one.kind == "hides"),
    ]
    return Where(file=found[0].path, line=found[0].line) if found else node_file(evidence)


def line_of(evidence: Evidence, record: LogRecord | None) -> Where:
    """Return the line of the source that logged a record; only the node's file if it is unknown."""
    place = node_file(evidence)
    if record is None or record.line <= 0:
        return place
    source = source_of_node(evidence)
    for path in (place.file, *(source.paths if source is not None else ())):
        if record.file.endswith(path):
            return Where(file=path, line=record.line)
    for package in evidence.submission.packages:
        for file in package.files:
            if record.file.endswith(f"/{file.path}"):
                return Where(file=f"{package.name}/{file.path}", line=record.line)
    return place


def traceback_of(evidence: Evidence, run: Run) -> tuple[str, Where | None]:
    """Return the last error that a program printed, and the line of the student's code, if any.

    Python's own suggestion ("Did you mean") is left out: the diagnosis suggests what fits.
    """
    error, where = raised_in(evidence, run)
    return SUGGESTION.sub("", error), where


def raised_in(evidence: Evidence, run: Run) -> tuple[str, Where | None]:
    """Return the last error as Python printed it, and the line of the student's code, if any."""
    text = _with_cause(_without_ignored(run.transcript))
    aborted = ABORTED.search(text)
    if aborted:  # C code of an interface ends the process, without a traceback
        return aborted[0], None
    error, _ = python_error(text, evidence.assignment.node_file)
    folder = evidence.assignment.folder
    mine = [m for m in FRAME.findall(_last_report(text)) if m[0].startswith(f"{folder}/")]
    if not mine:
        return error, None
    return error, Where(file=mine[-1][0], line=int(mine[-1][1]))


def raised_inside(evidence: Evidence, run: Run) -> str:
    """Return the library whose code raised the last error; "" if the student's own line did."""
    text = _with_cause(_without_ignored(run.transcript))
    calls = CALL.findall(text.rpartition(TRACEBACK)[2])
    folder = evidence.assignment.folder
    path = calls[-1][0] if calls else ""
    if not path or (f"/{folder}/" in path and path.endswith(".py")):
        return ""
    return "rclpy" if "/rclpy/" in path else "Python"


def calls_to(evidence: Evidence, run: Run) -> list[tuple[str, int]]:
    """Return the student's functions, and the line of each, through which the last error came."""
    text = _with_cause(_without_ignored(run.transcript))
    folder = evidence.assignment.folder
    calls = CALL.findall(text.rpartition(TRACEBACK)[2])
    return [
        (function, int(line))
        for path, line, function in calls
        if function and f"/{folder}/" in path and path.endswith(".py")
    ]


def _last_report(text: str) -> str:
    """Return the last traceback of a transcript, with those of the exceptions that led to it.

    An earlier one can be of another thread, or of an exception that the program caught.
    """
    before, found, last = text.rpartition(TRACEBACK)
    while found and before.rstrip().endswith(CHAINED):
        before, found, cause = before.rpartition(TRACEBACK)
        last = cause + last
    return last


def _without_ignored(text: str) -> str:
    """Return a transcript without exceptions that Python only reports, as those of `__del__`."""
    kept, ignored = [], False
    for line in text.splitlines():
        if line.startswith("Exception ignored "):
            ignored = True
        elif not ignored:
            kept.append(line)
        elif not line.startswith((" ", "\t", "Traceback ")):
            ignored = False  # (this line is the exception, the last of the report)
    return "\n".join(kept)


def _with_cause(text: str) -> str:
    """Return a transcript up to the exception that made a later one.

    If creating the node fails, a `finally` that uses the variable of the node raises
    UnboundLocalError as well; if nothing sets the variable, it raises the same NameError again. A
    misspelt name in an `except` is looked up, and raises NameError, only after an exception.
    """
    for _ in range(MOST_CAUSES):
        before, handling, after = text.rpartition(HANDLING)
        cause, _ = python_error(before, "")
        stopped = cause.rpartition(".")[2].startswith(("KeyboardInterrupt", "ExternalShutdown"))
        second, _ = python_error(after, "")
        follows = second.startswith("UnboundLocalError") or second == cause
        follows |= EXCEPT.search(after) is not None
        if not handling or not cause or stopped or not follows:
            break
        text = before
    return text


def words(evidence: Evidence) -> dict[str, Value]:
    """Return the values of assignment and node source for the texts of a mistake."""
    return placeholder_values(evidence.assignment, source_of_node(evidence))


def going_on(evidence: Evidence) -> str:
    """Return the check that says why a run did not go on to its end."""
    return "run.stays" if evidence.assignment.runs else evidence.id_of("log.counts")


def flood(evidence: Evidence, expected: str) -> Failed:
    """Return the failure of a node that printed more than the limit."""
    run = evidence.run
    size = f"{max(len(run.transcript.encode()), run.logged) / 1e6:.1f}"
    lines = run.transcript.count("\n")
    after = say("so much output that the run was stopped after {size} MB", size=size)
    if size == "0.0":  # MB
        after = say("so much output that the run was stopped after {count} lines", count=lines)
    return Failed(
        "run.too_much_output",
        expected=expected,
        actual=after,
        where=node_file(evidence),
    )


def resource(evidence: Evidence, expected: str) -> Failed:
    """Return the failure of a node that reached a limit, for example on memory or processes."""
    limit = evidence.run.resource
    return Failed(
        "run.resource",
        expected=expected,
        actual=say("it reached the limit on {limit} and was stopped", limit=limit_name(limit)),
        where=node_file(evidence),
        params={"limit": limit},
    )


def limit_name(limit: str) -> str:
    """Return the translatable name of a limit."""
    names = {
        "wall time": say("wall time"),
        "memory": say("memory"),
        "processes": say("processes"),
        "output": say("output"),
    }
    return names.get(limit, limit)
