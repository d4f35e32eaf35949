"""Fixes of a timer whose wrong period is hidden: by an option of the logger, or by a sleep."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.lines import own_lines
from grader.mistakes.fixes.node_timer import value_of
from grader.mistakes.fixes.node_words import OPTIONS, option_of
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.source.measured import measured
from grader.package.source.module import Module
from grader.package.source.names import dotted
from grader.package.source.node import NodeSource
from grader.package.source.period import is_right, number_in, seconds_of
from grader.package.source.place import block_of
from grader.package.source.real_time import THROTTLE
from grader.package.source.sleeps import longest_sleep, sleeps_of


def period_of(source: NodeSource) -> tuple[ast.expr, float] | None:
    """Return where the period of the node's only timer is written, and its seconds."""
    periods = [timer.period for timer in source.timers]
    written = value_of(source, periods[0]) if len(periods) == 1 and periods[0] else None
    seconds = number_in(written)
    return (written, seconds) if written is not None and seconds else None


def throttled(source: NodeSource) -> ast.keyword | None:
    """Return the option with which a line of the node's log is written at most so often."""
    for call in source.own_logs:
        option = option_of(call)
        if option is not None and option.arg == THROTTLE:
            return option
    return None


def unthrottled(case: Case) -> Files | None:
    """Set the timer's period, and remove the option of the logger that leaves out lines."""
    node = case.node
    found = period_of(node) if node is not None else None
    calls = [c for c in node.own_logs if option_of(c) is not None] if node is not None else []
    if node is None or found is None or len(calls) != 1 or not calls[0].args:
        return None
    call, module = calls[0], node.module_of(calls[0])
    known = (*OPTIONS, "throttle_time_source_type")
    if module is not node.module_of(found[0]) or any(k.arg not in known for k in call.keywords):
        return None
    start, end = module.text.span(call.args[-1])[1], module.text.span(call)[1] - 1
    return case.changed(module, _right(case, module, found[0]), Splice(start, end, ""))


def _right(case: Case, module: Module, written: ast.expr) -> Splice:
    return module.text.swap(written, case.assignment.seconds)


def without_sleep(case: Case) -> Files | None:
    """Set the timer's period, and delete the callback's sleep and the import that it needed."""
    node = case.node
    found = period_of(node) if node is not None else None
    slept = longest_sleep(node) if node is not None else None
    if node is None or found is None or slept is None or len(sleeps_of(node)) != 1:
        return None
    call, module = slept[0], node.module_of(slept[0])
    statement = module.parents.get(call)
    if not isinstance(statement, ast.Expr) or module is not node.module_of(found[0]):
        return None
    lines = own_lines(module, statement)
    if lines is None or len(block_of(module, statement)) == 1:
        return None
    gone = [module.text.without(n) for n in (*lines, *_import_of(module, call))]
    return case.changed(module, _right(case, module, found[0]), *gone)


def unmeasured(case: Case) -> Files | None:
    """Set the timer's period, and delete the if that compares times, with what only it needs."""
    node = case.node
    found = measured(node) if node is not None else None
    given = node.timers[0].period if node is not None and len(node.timers) == 1 else None
    if node is None or found is None or given is None:
        return None
    block, module = found.block, node.module_of(found.block)
    text = module.text
    whole = [own_lines(module, statement) for statement in found.needed]
    if any(rows is None for rows in whole) or any(not module.has(s) for s in found.needed):
        return None
    gone = {number for rows in whole for number in rows or ()}
    first, last = block.body[0].lineno, block.end_lineno or block.lineno
    if first == block.lineno:
        return None
    gone |= set(range(block.lineno, last + 1 if found.returns else first))
    splices = [text.without(number) for number in sorted(gone)]
    old, new = indent_of(text.line(first)), indent_of(text.line(block.lineno))
    for number in range(first, last + 1):
        row = text.line(number)
        if number in gone or not row.strip():
            continue
        if not row.startswith(old):
            return None
        start = text.start_of(number)
        splices.append(Splice(start, start + len(old), new))
    if not is_right(seconds_of(node, given), case.assignment.period or 0.0):
        written = value_of(node, given) or given
        if node.module_of(written) is not module:
            return None
        splices.append(_right(case, module, written))
    return case.changed(module, *splices)


def _import_of(module: Module, call: ast.Call) -> list[int]:
    """Return the line that imports what only this call uses."""
    name = dotted(call.func).partition(".")[0]
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    for statement in module.tree.body:
        if not isinstance(statement, ast.Import | ast.ImportFrom) or len(statement.names) != 1:
            continue
        alias = statement.names[0]
        alone = own_lines(module, statement)
        if (alias.asname or alias.name) == name and len(uses) == 1 and alone is not None:
            return list(alone)
    return []
