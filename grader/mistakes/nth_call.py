"""The mistake of a callback that logs at each n-th call, with a wrong n for the timer's period."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import Value, msg
from grader.mistakes import links
from grader.mistakes.example import LOG_LINE, NODE, STEP_LINE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.counter import adds_to, logged_counter
from grader.package.source.names import dotted
from grader.package.source.period import is_right, seconds_of


def _each_nth(suspect: Suspect) -> RecognisedMistake | None:
    """One condition of the callback lets each n-th call log, and n periods are not the wanted one."""
    source, callback = suspect.source, suspect.source.callback
    period = source.timers[0].period if len(source.timers) == 1 else None
    seconds = seconds_of(source, period) if period is not None else None
    blocks = [n for n in ast.walk(callback) if isinstance(n, ast.If)] if callback else []
    if callback is None or not seconds or len(blocks) != 1 or blocks[0].orelse:
        return None
    block, logged = blocks[0], logged_counter(source)
    told = _remainder(block.test)
    if told is None or logged is None or len(source.logs(block)) != len(source.logs(callback)):
        return None
    counter, number, many = told
    steps = [n for n in ast.walk(callback) if adds_to(n, counter)]
    if counter == logged[1] or len(steps) != 1 or getattr(steps[0], "lineno", 0) > block.lineno:
        return None
    wanted = suspect.period
    right = round(wanted / seconds)
    if right in (0, many) or not is_right(right * seconds, wanted):
        return None
    code = source.module_of(block).text.code
    name = code(block.test)
    written = name.replace(code(number), str(right)) if name.count(code(number)) == 1 else ""
    if not written:
        return None
    found = suspect.finding("nth_call", block, name=name, written=written)
    words: dict[str, Value] = {
        "many": many,
        "seconds": f"{seconds:g}",
        "total": f"{seconds * many:g}",
    }
    return replace(found, words={**found.words, **words})


def _remainder(test: ast.expr) -> tuple[str, ast.Constant, int] | None:
    """Return the counter and the number of `counter % number == 0`."""
    if not isinstance(test, ast.Compare) or len(test.ops) != 1:
        return None
    left, zero = test.left, test.comparators[0]
    if not isinstance(test.ops[0], ast.Eq) or not isinstance(zero, ast.Constant) or zero.value != 0:
        return None
    if not isinstance(left, ast.BinOp) or not isinstance(left.op, ast.Mod):
        return None
    number, counter = left.right, dotted(left.left)
    if not isinstance(number, ast.Constant) or type(number.value) is not int or not counter:
        return None
    return counter, number, number.value


_node = Family("node", links.EXECUTORS)
KINDS = (
    _node(
        "nth_call",
        "timer",
        msg("The callback logs at each n-th call, and n does not fit the timer's period"),
        msg(
            "The timer calls the callback every {seconds} s, and the condition {name} lets one of "
            "{many} calls log: a line comes every {total} s."
        ),
        msg("Write {written} instead of {name}: a line comes every {period} s then."),
        behind=dict.fromkeys(("run.stops", "run.no_lines", "run.wrong_period"), _each_nth),
        fixed_by=(lines.written,),
        examples=(
            example(
                "each_twentieth_call_logs",
                Replace(NODE, "(1.0,", "(0.1,"),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.calls_ = 0"),
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    "        self.calls_ += 1\n        if self.calls_ % 20 == 0:\n"
                    f"    {LOG_LINE}    {STEP_LINE}",
                ),
                fails="run.period",
            ),
        ),
    ),
)
