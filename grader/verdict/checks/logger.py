"""The kind of check for a logger: do the lines go through the node's own, with the right level?"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from grader.base.i18n.message import say
from grader.run.probe_link import LEVELS
from grader.verdict.checks.declare import kind
from grader.verdict.checks.faults import line_of
from grader.verdict.checks.lines import CALLS, level_of, lines, logger_of, numbered, such_lines
from grader.verdict.checks.parameters import Parameters
from grader.verdict.outcome import Blocked, Failed, Passed

if TYPE_CHECKING:
    from grader.report.model import Where
    from grader.run.observer import Event
    from grader.verdict.use import Use

LOST = 1.0  # seconds before a node ended, whose log records may be lost


class Logged(Parameters):
    """The lines of a text, in which {n} stands for any number, and the level of their records."""

    text: str
    level: Literal["debug", "info", "warn", "error", "fatal"] = "info"


@kind("log.logger", Logged, depends=["run.starts"], after=["log.counts"])
def logger(use: Use[Logged]) -> Passed:
    """The lines go through the node's own logger."""
    run, level = use.evidence.run, use.given.level
    expected = say("log records of the node on /rosout, level {level}", level=level.upper())
    events = _in_scenario(use, expected) if use.in_scenario else _counted(use)
    names = {logger_of(use)} if use.in_scenario else {node.logger for node in run.nodes}
    if run.doubled:
        raise Failed(
            "run.faked_log",
            expected=expected,
            actual=say(
                "{node} has a second publisher on /rosout: who made the records cannot be told",
                node=run.doubled,
            ),
            variant="published",
            where=line_of(use.evidence, events[0].record),
        )
    records = [event.record for event in events if event.record is not None]
    forged = [record for record in records if record.is_forged(run.began)]
    if len(forged) > 1:  # (one can be due to a clock that was set)
        raise Failed(
            "run.faked_log",
            expected=expected,
            actual=say(
                "{count} records have a time at which no logger can have made them",
                count=len(forged),
            ),
            variant="stamped",
            where=line_of(use.evidence, forged[0]),
        )
    gone = run.ended_by_itself or bool(run.watch.missing)
    for event in events:
        if gone and event.source == "faked" and event.wall > events[-1].wall - LOST:
            continue  # the last records of a node that ends or is destroyed may be lost
        _judge_record(event, names, level, expected, line_of(use.evidence, event.record))
    node = run.counting_node
    name = node.logger if node is not None else min(names, default="")
    said = say(
        "{count} records of [{name}], {level}", count=len(events), name=name, level=level.upper()
    )
    return Passed(actual=said)


def _counted(use: Use[Logged]) -> list[Event]:
    """Return the lines of the count of a run that is driven line by line."""
    run = use.evidence.run
    events = run.watch.counted
    if not events or run.confirmed is False or run.flooded:
        raise Blocked(by=use.evidence.id_of("log.counts"))
    return events


def _in_scenario(use: Use[Logged], expected: str) -> list[Event]:
    """Return the lines of a scenario, without those of other nodes."""
    use.require_window()
    others = {node.logger for node in use.run.nodes} - {logger_of(use)}
    found = [
        event
        for event in lines(use, numbered(use.given.text))
        if event.record is None or event.record.name not in others
    ]
    if not found:
        use.blocked_by("log.counts", text=use.given.text)
        raise Failed("log.missing", expected=expected, actual=such_lines(0), where=use.call(*CALLS))
    return found


def _judge_record(event: Event, names: set[str], level: str, expected: str, where: Where) -> None:
    """Raise Failed unless the line is a record of the node's own logger, with this level."""
    if event.source == "print":
        text = event.text[:80]
        raise Failed(
            "run.print_not_logger",
            expected=expected,
            actual=say("a line that ROS never saw: '{text}' (print?)", text=text),
            where=where,
        )
    if event.source == "faked" and event.logger not in names:
        raise _other_logger(expected, event.logger, where)
    if event.source == "faked":
        raise Failed(
            "run.faked_log",
            expected=expected,
            actual=say("a line that looks like a log record, but did not come on /rosout"),
            where=where,
        )
    if event.record is not None and event.record.name not in names:
        raise _other_logger(expected, event.record.name, where)
    if event.record is not None and event.record.level != LEVELS[level]:
        raise Failed(
            "run.wrong_level" if level == "info" else "log.wrong_level",
            expected=expected,
            actual=say("level {level}", level=level_of(event.record)),
            where=where,
            words={"level": level},
        )


def _other_logger(expected: str, name: str, where: Where) -> Failed:
    return Failed(
        "run.other_logger",
        expected=expected,
        actual=say("records of the logger [{name}], which is not the node's", name=name),
        params={"name": name},
        where=where,
    )
