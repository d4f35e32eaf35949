"""Fixes of the timer and its callback."""

from __future__ import annotations

import ast

from grader.base.nearest import nearest
from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.source.counter import targets_of
from grader.package.source.names import dotted, own_name
from grader.package.source.node import NodeSource
from grader.package.source.parameters import needed_besides_self, only_self, uses_of
from grader.package.source.period import is_right, number_in, timers_of_lines

NAMES = ("create_timer", "get_logger")


def misspelt(case: Case) -> Files | None:
    """Correct misspelt create_timer and get_logger."""
    node = case.node
    if node is None:
        return None
    known = {*node.methods, *node.attributes, *NAMES}
    splices = []
    for part in ast.walk(node.node_class) if node.node_class else ():
        written = own_name(part)
        if not written or written in known or not isinstance(part, ast.Attribute):
            continue
        right = nearest(written, NAMES, cutoff=0.85)
        if right and isinstance(part.ctx, ast.Load):
            end = node.module.text.span(part)[1]
            splices.append(Splice(end - len(written), end, right))
    return case.changed(node.module, *splices)


def value_of(node: NodeSource, named: ast.expr) -> ast.expr | None:
    """Return the value of a variable or an attribute that gets one once; another value itself."""
    name = dotted(named)
    if not name:
        return named
    kinds = ast.Assign | ast.AnnAssign
    sets = [s for s in node.own_nodes if isinstance(s, kinds) and name in targets_of(s)]
    return sets[0].value if len(sets) == 1 else None


def _timer_method(node: NodeSource) -> ast.FunctionDef | None:
    """Return the method that the timer calls."""
    timer = node.timer_call
    given = timer.args[1] if timer is not None and len(timer.args) > 1 else None
    return node.method(own_name(given)) if own_name(given) else None


def callback_self(case: Case) -> Files | None:
    """Give the callback the single parameter self."""
    node = case.node
    if node is None:
        return None
    module = node.module_at(case.finding.file)
    functions = node.own_methods
    if module is not node.module:
        functions = [n for n in module.nodes if isinstance(n, ast.FunctionDef)]
    at = [m for m in functions if m.lineno == case.finding.line]
    own = _timer_method(node) if module is node.module else None
    method = at[0] if len(at) == 1 else own
    if method is None or method.decorator_list:
        return None
    if uses_of(method, {argument.arg for argument in needed_besides_self(method)}):
        return None
    change = only_self(module.text, method)
    return case.changed(module, change) if change is not None else None


def period(case: Case) -> Files | None:
    """Set the timer's period to the required one."""
    node = case.node
    timers = timers_of_lines(node) if node is not None else []
    period = timers[0].period if len(timers) == 1 else None
    wanted = case.assignment.period
    if node is None or period is None or wanted is None:
        return None
    given = value_of(node, period)
    seconds = number_in(given)
    text = isinstance(given, ast.Constant) and isinstance(given.value, str)
    if given is None or is_right(seconds, wanted) or not (seconds is not None or text):
        return None
    module = node.module_of(given)
    return case.changed(module, module.text.swap(given, repr(wanted)))


def made(case: Case) -> Files | None:
    """Create the missing timer, if exactly one method can be its callback."""
    node = case.node
    init = node.method("__init__") if node else None
    if node is None or init is None or node.calls_of("create_timer", "create_rate", "sleep"):
        return None
    log = node.log_call
    found = [m for m in node.own_methods if log is not None and log in list(ast.walk(m))]
    if len(found) != 1 or found[0] is init or ast.unparse(found[0].args) != "self":
        return None
    used = {own_name(part) for part in node.own_nodes}
    last = init.body[-1]
    if found[0].name in used or last.lineno == init.lineno or isinstance(last, ast.Return):
        return None
    text = node.module.text
    indent = indent_of(text.line(init.body[-1].lineno))
    seconds = case.assignment.seconds
    row = f"{indent}{node.held_node or 'self'}.create_timer({seconds}, self.{found[0].name})"
    return case.changed(node.module, text.before((last.end_lineno or last.lineno) + 1, row))
