"""The mistake of a line of the count that no timer logs: it stands in __init__ or in main."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG, LOG_LINE, NODE, STEP_LINE, example
from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.place import function_at, statement_at


def _before_spin(suspect: Suspect) -> RecognisedMistake | None:
    """Look at the line that was logged: it is a log call of its own, outside of the callback."""
    place, source = suspect.place, suspect.source
    if place is None or not place.line or source.callback is None:
        return None
    module = source.module_at(place.file)
    statement, function = statement_at(module, place.line), function_at(module, place.line)
    if function is None or function not in (source.methods.get("__init__"), source.main):
        return None
    if not isinstance(statement, ast.Expr) or statement.value not in source.logs(function):
        return None
    if not source.timers or not source.logs(source.callback):
        return None
    found = suspect.finding("logs_before_timer", statement, function=function.name)
    if len(set(suspect.lines[:2])) < 2:  # the callback begins with the same number
        return found
    later = suspect.finding("logs_before_timer", statement, function=function.name, counts="on")
    return replace(later, variant="counts_on")


def _deleted(case: Case) -> Files | None:
    """Delete the line, if the callback then logs the count from its start."""
    return lines.deleted(case) if "counts" not in case.finding.params else None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "logs_before_timer",
        "timer",
        msg("A line of the count is logged outside of the callback"),
        msg(
            "This line of {function} runs once, before any time has passed. The timer's callback "
            "{callback} logs the same text for the first time after {period} s, so the count has one "
            "line too many."
        ),
        msg("Delete this line: only {callback} logs the count."),
        behind=dict.fromkeys(("run.by_hand", "run.wrong_step", "run.wrong_start"), _before_spin),
        whys={
            "counts_on": msg(
                "This line of {function} runs once, before any time has passed: the count begins one "
                "period too early. {callback} goes on with the next number."
            )
        },
        fixes={
            "counts_on": msg(
                "Delete this line, and let {callback} log before it adds to the counter: its first line "
                "then has {start}."
            )
        },
        fixed_by=(_deleted,),
        deletes=("", "counts_on"),
        examples=(
            example(
                "first_line_in_init",
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    f"        self.create_timer(1.0, self.timer_callback)\n        {LOG}\n",
                ),
                fails="run.output",
                also={"run.period": "node.logs_before_timer"},
            ),
            example(
                "count_begins_in_init",
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    f"        self.create_timer(1.0, self.timer_callback)\n        {LOG}\n",
                ),
                Replace(NODE, f"{LOG_LINE}{STEP_LINE}", f"{STEP_LINE}{LOG_LINE}"),
                fails="run.period",
            ),
        ),
    ),
)
