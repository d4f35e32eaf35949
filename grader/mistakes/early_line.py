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
from grader.package.source.counter import adds_to, logged_counter
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
    logged = logged_counter(source)
    steps = [
        n.lineno
        for n in ast.walk(function)
        if isinstance(n, ast.stmt) and logged is not None and adds_to(n, logged[1])
    ]
    if steps:
        words = {**later.words, "line": ", ".join(map(str, steps))}
        params = {**later.params, **({"step": steps[0]} if len(steps) == 1 else {})}
        return replace(later, variant="counts_too", words=words, params=params)
    return replace(later, variant="counts_on")


def _deleted(case: Case) -> Files | None:
    """Delete the line, and what counts beside it, if the callback then logs the count from its start."""
    if "counts" not in case.finding.params:
        return lines.deleted(case)
    module, step = case.module, case.finding.params.get("step")
    rows = [int(row) for row in (case.finding.line, step) if row]
    found = [statement_at(module, row) for row in rows] if module is not None else []
    alone = [s for s in found if module is not None and s and lines.own_lines(module, s)]
    if module is None or len(alone) != 2 or any(s.lineno != s.end_lineno for s in alone):
        return None
    return case.changed(module, *(module.text.without(s.lineno) for s in alone))


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
        whys=dict.fromkeys(
            ("counts_on", "counts_too"),
            msg(
                "This line of {function} runs once, before any time has passed: the count begins one "
                "period too early. {callback} goes on with the next number."
            ),
        ),
        fixes={
            "counts_too": msg(
                "Delete this line, and what adds to the counter in {function} (line {line}): only "
                "{callback} logs and counts."
            ),
            "counts_on": msg(
                "Delete this line, and let {callback} log before it adds to the counter: its first line "
                "then has {start}."
            ),
        },
        fixed_by=(_deleted,),
        deletes=("", "counts_on", "counts_too"),
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
