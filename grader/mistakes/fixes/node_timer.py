"""Fixes of the timer and its callback."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.base.nearest import nearest
from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.source.counter import starts_of, targets_of
from grader.package.source.declared import declared, read
from grader.package.source.module import Function
from grader.package.source.names import dotted, last_part, own_name
from grader.package.source.node import NodeSource
from grader.package.source.parameters import needed_besides_self, only_self, uses_of
from grader.package.source.period import is_right, number_in, timers_of_lines
from grader.package.source.timer import Timer, timer_of

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


@dataclass(frozen=True)
class Completed:
    """A call of create_timer with its missing arguments: its code, and how it changes."""

    written: str
    splice: Splice
    is_certain: bool


def completed(source: NodeSource, timer: Timer, seconds: str) -> Completed | None:
    """Return a call of create_timer with the period and the callback that it lacks."""
    call, function = timer.call, timer.call.func
    names = {"timer_period_sec": timer.period, "callback": timer.callback}
    given = [k.arg for k in call.keywords]
    if not isinstance(function, ast.Attribute) or any(
        isinstance(a, ast.Starred) for a in call.args
    ):
        return None
    if None in given or len(call.args) > 1:
        return None
    text = source.module_of(call).text
    first = call.args[0] if call.args else None
    alone = first is not None and names["callback"] is None and _is_callback(source, first)
    period = None if alone else names["timer_period_sec"]
    callback = first if alone else names["callback"]
    owner = text.code(function.value)
    owner = "self" if owner == "super()" else owner
    name, certain = ("", True) if callback is not None else _free_method(source)
    if callback is None and not name:
        return None
    of_period = _period_of(source, call) or seconds
    sign = "callback=" if given and period is not None else ""
    given_parts: list[ast.expr | ast.keyword] = [*call.args, *call.keywords]
    missing_period = [] if period is not None else [of_period]
    missing_callback = [] if callback is not None else [f"{sign}{owner}.{name}"]
    middle = [" ".join(text.code(part).split()) for part in given_parts]
    written = ", ".join([*missing_period, *middle, *missing_callback])
    written = f"{text.code(function)}({written})"
    parts = [*call.args, *(k.value for k in call.keywords)]
    if not parts:
        end = text.span(call)[1] - 1
        return Completed(
            written, Splice(end, end, ", ".join([*missing_period, *missing_callback])), certain
        )
    if missing_period and missing_callback:
        return None  # (a clock or a group alone)
    if missing_period:
        start = text.span(given_parts[0])[0]
        return Completed(written, Splice(start, start, f"{of_period}, "), certain)
    end = text.span(parts[-1])[1]
    return Completed(written, Splice(end, end, f", {missing_callback[0]}"), certain)


def _is_callback(source: NodeSource, given: ast.expr) -> bool:
    """Whether an argument is what a timer can call, and no number of seconds."""
    if isinstance(given, ast.Lambda):
        return True
    if isinstance(given, ast.Call):
        return last_part(dotted(given.func)) == "partial" or dotted(given.func) in {
            f"self.{name}" for name in source.methods
        }
    name = last_part(dotted(given))
    functions = {n.name for n in source.all_nodes if isinstance(n, Function)}
    return bool(name) and name in functions


def _free_method(source: NodeSource) -> tuple[str, bool]:
    """Return the method that the timer has to call, and whether no other can be meant."""
    own = [m for m in source.own_methods if len(m.args.args) == 1 and not m.decorator_list]
    own = [m for m in own if not m.name.endswith("__")]
    used = {n.attr for n in source.all_nodes if isinstance(n, ast.Attribute)}
    free = [m for m in own if m.name not in used]
    logging = [m for m in free if source.logs(m)] or free
    if len(logging) == 1:
        return logging[0].name, True
    callback = source.callback
    known = callback.name if isinstance(callback, ast.FunctionDef) and callback in own else ""
    return (logging[0].name if logging else known), False


def _period_of(source: NodeSource, call: ast.Call) -> str:
    """Return how the source names a period that nothing uses yet; "" if it has none."""
    read_already = {parameter.name for parameter in read(source)}
    around = source.function_around(call)
    for parameter in declared(source):
        is_period = parameter.name not in read_already and _names_period(parameter.name)
        if is_period and isinstance(call.func, ast.Attribute):
            text = source.module_of(parameter.call).text
            owner = text.code(call.func.value)
            return f"{owner}.get_parameter({text.code(parameter.written)}).value"
    used = {dotted(n) for n in source.all_nodes if isinstance(getattr(n, "ctx", None), ast.Load)}
    for node in source.own_nodes:
        value = node.value if isinstance(node, ast.Assign) else None
        inside = source.function_around(node) if isinstance(node, ast.Assign) else None
        for name in targets_of(node) if value is not None else ():
            local = "." in name or inside is None or inside is around
            if local and name not in used and _names_period(name) and number_in(value):
                return name
    return ""


def _names_period(name: str) -> bool:
    words = ("period", "interval", "seconds", "delay", "dauer", "periode")
    return any(word in name.lower() for word in words)


def arguments(case: Case) -> Files | None:
    """Pass the period first and the callback second to create_timer."""
    node = case.node
    timer = node.timer_call if node else None
    if node is None or timer is None:
        return None
    module = node.module_of(timer)
    text = module.text
    found = completed(node, timer_of(timer, None), case.assignment.seconds)
    if found is not None:
        return case.changed(module, found.splice) if found.is_certain else None
    if timer.keywords:
        return None
    if len(timer.args) != 2 or not own_name(timer.args[0]) or not _number(timer.args[1]):
        return None
    first, second = timer.args
    return case.changed(
        module, text.swap(first, text.code(second)), text.swap(second, text.code(first))
    )


def _number(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and type(node.value) in (int, float)


def callback(case: Case) -> Files | None:
    """Pass the callback itself to create_timer: with self., without (), by its right name."""
    node = case.node
    timer = node.timer_call if node else None
    if node is None or timer is None or len(timer.args) < 2:
        return None
    given, module = timer.args[1], node.module_of(timer)
    text = module.text
    names = {m.name for m in node.own_methods}
    if isinstance(given, ast.Call) and not given.args and not given.keywords:
        if own_name(given.func) in names or _is_function(node, given.func):
            return case.changed(module, text.swap(given, text.code(given.func)))
        return None
    if isinstance(given, ast.Name) and given.id in names and not _is_bound(node, given.id):
        start = text.span(given)[0]
        return case.changed(module, Splice(start, start, "self."))
    written = own_name(given)
    if not written or written in names or f"self.{written}" in starts_of(node):
        return None
    near = nearest(written, names - {"__init__"}, cutoff=0.8)
    if not near:
        return None
    end = text.span(given)[1]
    return case.changed(module, Splice(end - len(written), end, near))


def value_of(node: NodeSource, named: ast.expr) -> ast.expr | None:
    """Return the value of a variable or an attribute that gets one once; another value itself."""
    name = dotted(named)
    if not name:
        return named
    kinds = ast.Assign | ast.AnnAssign
    sets = [s for s in node.own_nodes if isinstance(s, kinds) and name in targets_of(s)]
    return sets[0].value if len(sets) == 1 else None


def number_of(value: ast.expr | None) -> str:
    """Return the number that a tuple was meant to be: `1.0,` and `1,0` are 1.0; "" if unknown."""
    if not isinstance(value, ast.Tuple) or not all(map(_number, value.elts)):
        return ""
    parts = [ast.unparse(part) for part in value.elts]
    whole = len(parts) == 2 and all(part.isdigit() for part in parts)
    return parts[0] if len(parts) == 1 else ".".join(parts) if whole else ""


def _is_function(node: NodeSource, named: ast.expr) -> bool:
    """Whether it names the callback, a function that is no method."""
    callback = node.callback
    return callback is not None and isinstance(named, ast.Name) and named.id == callback.name


def _is_bound(node: NodeSource, name: str) -> bool:
    """Whether a name is bound outside of the class, or assigned anywhere."""
    for part in node.own_nodes:
        if isinstance(part, ast.FunctionDef) and part.name == name and part not in node.class_body:
            return True
        if isinstance(part, ast.Name) and part.id == name and isinstance(part.ctx, ast.Store):
            return True
    return False


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


def by_hand(case: Case) -> Files | None:
    """Remove the call of the callback in __init__."""
    node = case.node
    method, init = (_timer_method(node), node.method("__init__")) if node else (None, None)
    if node is None or method is None or init is None:
        return None
    if all(node.function_around(timer.call) is method for timer in node.timers):
        return None
    text = node.module.text
    calls = [
        s
        for s in init.body
        if isinstance(s, ast.Expr)
        and isinstance(s.value, ast.Call)
        and own_name(s.value.func) == method.name
    ]
    if len(calls) != 1 or text.line(calls[0].lineno).strip() != text.code(calls[0]):
        return None
    return case.changed(node.module, text.without(calls[0].lineno))


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
