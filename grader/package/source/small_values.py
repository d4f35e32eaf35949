"""Small changes of an expression: another number, operator, name, argument, or a part of it."""

from __future__ import annotations

import ast
import builtins
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from grader.base.nearest import nearest
from grader.package.edit.text import Splice
from grader.package.source.change import Change, of_piece
from grader.package.source.module import Function, Module, code_of
from grader.package.source.names import called_name, calls_in, dotted, last_part, own_name
from grader.package.source.node import LOG_METHODS, NodeSource

SHOWN = ("info", "warn", "warning", "error", "fatal")
HIDDEN = ("debug", "DEBUG")
OF_C = re.compile(r"%(?:z|l|ll|h)?[ud](?<!%d)")
"""Formats of a number that printf has and Python does not."""
NUMBER = re.compile(r"-?\d{1,9}(?:\.\d{1,9})?")
"""A text that is a number."""
FIELDS = ("integer_value", "double_value", "string_value", "bool_value")
"""The fields of a ParameterValue: one has the value, and the others are 0, empty or false."""
TYPES = ("INTEGER", "DOUBLE", "STRING", "BOOL")
"""The types that the value of a parameter can have, as Parameter.Type names them."""
MOST_NAMES = 6  # other names that are tried in the place of one
SIGNS: dict[type[ast.AST], str] = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Eq: "==",
    ast.NotEq: "!=",
    ast.Lt: "<",
    ast.LtE: "<=",
    ast.Gt: ">",
    ast.GtE: ">=",
}
OF_TEXT = ("replace", "strip", "lstrip", "rstrip", "upper", "lower", "title", "capitalize", "zfill")
"""Methods of a text that return another text."""
BITS = ast.LShift | ast.RShift | ast.Pow
SUMS: tuple[type[ast.AST], ...] = (ast.Add, ast.Sub)
SUMMED = ast.Add | ast.Sub | ast.Mult | ast.Div
COMPARED: tuple[type[ast.AST], ...] = (ast.Lt, ast.LtE, ast.Gt, ast.GtE, ast.Eq, ast.NotEq)
EQUAL: tuple[type[ast.AST], ...] = (ast.Eq, ast.NotEq)
OTHER: dict[type[ast.AST], str] = {
    ast.In: "not in",
    ast.NotIn: "in",
    ast.Is: "==",
    ast.IsNot: "!=",
}
NEAR = ({ast.Lt, ast.LtE}, {ast.Gt, ast.GtE}, {ast.Lt, ast.Gt}, {ast.LtE, ast.GtE})
BUILTINS = frozenset(dir(builtins))
UNIT = 2  # the cost of a number in another unit
UNITS = (1000, 10**6, 10**9)
"""The parts of a second that a clock's time is given in."""
SCALES = (60, 1000, 3600, 10**6, 10**9)
"""A period in another unit is so many times the required one, or so small a part of it."""


@dataclass(frozen=True)
class Goal:
    """What the node has to log: the text before and after the number, its start, step and period."""

    before: str
    after: str
    start: int
    step: int
    period: float


Found = Iterator[tuple[int, Change]]
Sort = Callable[[Module, NodeSource, Goal], Found]


def _numbers(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield other numbers, truth values and names in the place of the constants."""
    del source
    for node in module.nodes:
        around = module.parents.get(node)
        if not isinstance(node, ast.Constant) or isinstance(around, ast.Expr):
            continue
        if isinstance(around, ast.BinOp) and isinstance(around.op, BITS):
            continue  # (another number of bits hides what is wrong)
        value = node.value
        if isinstance(value, bool):
            yield 3, of_piece(module, "value", node, str(not value))
        elif value is None:
            for number in (goal.start, goal.period):
                yield 4, of_piece(module, "value", node, str(number))
        elif isinstance(value, int | float):
            near: list[float] = [value + 1, value - 1] if isinstance(value, int) else []
            wanted = dict.fromkeys([goal.start, goal.step, goal.period, *near])
            for number in (n for n in wanted if n != value and n >= 0):
                cost = _cost(value, number, goal)
                sort = "seconds" if cost == UNIT else "value"
                yield cost, of_piece(module, sort, node, str(number))
        elif isinstance(value, str):
            yield from _other_words(module, node, value)


def _other_words(module: Module, node: ast.Constant, value: str) -> Found:
    """Yield numbers, levels and names in the place of a text that is one."""
    around = module.parents.get(node)
    if NUMBER.fullmatch(value):
        yield 1, of_piece(module, "digits", node, value)
    elif value in HIDDEN:
        yield 2, of_piece(module, "value", node, repr(SHOWN[0]))
    elif isinstance(around, ast.Dict) and node in around.keys:
        return  # (another key could replace one that is there)
    elif value.isidentifier():
        for other in dict.fromkeys(_words(module)):
            close = bool(nearest(value, [other]))
            sort = "value" if close else "word"
            yield 4 if close else 6, of_piece(module, sort, node, repr(other))


def _of_units(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield other units in conversions, and the fields that a parameter of another type has."""
    del source, goal
    for node in module.nodes:
        if isinstance(node, ast.Constant) and isinstance(module.parents.get(node), ast.BinOp):
            value = node.value
            if isinstance(value, int | float) and value in UNITS:
                for other in (unit for unit in UNITS if unit != value):
                    yield UNIT, of_piece(module, "unit", node, str(type(value)(other)))
        elif isinstance(node, ast.Attribute) and node.attr in FIELDS:
            for field in FIELDS:
                if field != node.attr:
                    new = f"{module.text.code(node.value)}.{field}"
                    swap = (module.text.swap(node, new),)
                    yield 1, Change("field", node, node.attr, field, swap)


def _cost(value: float, number: float, goal: Goal) -> int:
    """Return how far another number is from the one that is written."""
    if number == goal.period and value > 0:
        times = max(value / number, number / value)
        if any(abs(times - scale) < 1e-9 * scale for scale in SCALES):
            return UNIT
    return 4 if number in (goal.start, goal.step) else 5


def _words(module: Module) -> Iterator[str]:
    """Yield the strings that are names, such as those of parameters and keys."""
    for node in module.nodes:
        value = node.value if isinstance(node, ast.Constant) else None
        if isinstance(value, str) and value.isidentifier() and value != "__main__":
            yield value


def _of_objects(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield the value of a parameter, and the seconds of a duration, instead of the whole."""
    del source, goal
    for node in module.nodes:
        around, code = module.parents.get(node), ""
        if isinstance(node, ast.Call) and called_name(node) == "get_parameter":
            code = f"{module.text.code(node)}.value"
        elif isinstance(node, ast.Attribute) and node.attr == "nanoseconds":
            code = f"{module.text.code(node)} / 1e9"
        elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.Sub):
            code = f"({module.text.code(node)}).nanoseconds / 1e9"
        elif isinstance(node, ast.Attribute) and last_part(dotted(node.value)) == "Type":
            for other in TYPES:
                if other != node.attr:
                    new = f"{module.text.code(node.value)}.{other}"
                    yield 2, of_piece(module, "value", node, new)
        if code and isinstance(node, ast.expr) and not isinstance(around, ast.Attribute):
            sort = "value" if isinstance(node, ast.Call) else "seconds"
            yield 1, of_piece(module, sort, node, code)


def _timers(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield the required period and other callbacks in the calls of create_timer."""
    for call in calls_of(module):
        if called_name(call) != "create_timer":
            continue
        given = {keyword.arg: keyword.value for keyword in call.keywords}
        period = call.args[0] if call.args else given.get("timer_period_sec")
        if period is not None:
            if not any(isinstance(n, ast.Name | ast.Call) for n in ast.walk(period)):
                yield 3, of_piece(module, "value", period, str(goal.period))
            for unit in UNITS if not isinstance(period, ast.Constant) else ():
                new = f"{_operand(module, period)} / {unit}"
                yield 1, of_piece(module, "seconds", period, new)
        callback = call.args[1] if len(call.args) > 1 else given.get("callback")
        given_method = source.method(own_name(callback)) if callback is not None else None
        if callback is not None and not (given_method and _does_something(given_method)):
            for name in source.methods:
                if not name.startswith("__"):
                    yield 3, of_piece(module, "value", callback, f"self.{name}")


def _does_something(function: Function) -> bool:
    """Whether a function has more than a text and pass."""
    return any(not isinstance(statement, ast.Pass) for statement in code_of(function))


def _operand(module: Module, node: ast.expr) -> str:
    """Return code that can be an operand."""
    code = module.text.code(node)
    return code if isinstance(node, ast.Name | ast.Attribute | ast.Call) else f"({code})"


def _operators(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield other operators in the place of those that are written."""
    del source, goal
    text = module.text
    for node in module.nodes:
        if isinstance(node, ast.BinOp):
            for kind in SUMS if isinstance(node.op, SUMMED) or _is_text(node.left) else ():
                if not isinstance(node.op, kind):
                    yield 2, between(module, node, node.left, node.right, SIGNS[kind])
        elif isinstance(node, ast.Compare) and len(node.ops) == 1:
            yield from _compared(module, node)
        elif isinstance(node, ast.BoolOp) and len(node.values) == 2:
            sign = "or" if isinstance(node.op, ast.And) else "and"
            yield 4, between(module, node, node.values[0], node.values[1], sign)
        elif isinstance(node, ast.AugAssign) and not isinstance(node.op, ast.Add):
            new = f"{text.code(node.target)} += {text.code(node.value)}"
            yield 2, of_piece(module, "value", node, new)
        elif isinstance(node, ast.Assign) and len(node.targets) == 1 and is_name(node.targets[0]):
            sum_of = node.value.left if isinstance(node.value, ast.BinOp) else None
            if sum_of is not None and is_name(sum_of) and dotted(sum_of) != dotted(node.targets[0]):
                kept = f"{text.code(sum_of)} = {text.code(node.value)}"
                yield 1, of_piece(module, "value", node, kept)
            new = f"{text.code(node.targets[0])} += {text.code(node.value)}"
            nothing = isinstance(node.value, ast.Constant) and not node.value.value
            if module.parents.get(node) is not module.tree and not nothing:
                yield 3, of_piece(module, "value", node, new)


def _is_text(node: ast.AST) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


def _compared(module: Module, node: ast.Compare) -> Found:
    """Yield other comparisons of the same operands."""
    if dotted(node.left) == "__name__":
        return
    written, right = type(node.ops[0]), node.comparators[0]
    if dotted(node.left).endswith("ok()"):  # (what ok() returns is a condition already)
        yield 1, of_piece(module, "value", node, module.text.code(node.left))
    if written in OTHER:
        yield 3, between(module, node, node.left, right, OTHER[written])
        return
    for kind in COMPARED:
        loses = written not in EQUAL and kind in EQUAL  # (an order says more)
        if kind is not written and not loses:
            cost = 2 if {written, kind} in NEAR else 4
            yield cost, between(module, node, node.left, right, SIGNS[kind])


def _counting(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield statements that add to a name instead of those that set it, in functions that log."""
    del source
    text = module.text
    for function in (n for n in module.nodes if isinstance(n, Function)):
        if any(called_name(call) in LOG_METHODS for call in (c for c, _ in calls_in(function))):
            for node in ast.walk(function):
                if isinstance(node, ast.Assign) and is_name(node.targets[0]):
                    new = f"{text.code(node.targets[0])} += {goal.step}"
                    yield 4, of_piece(module, "value", node, new)


def _unkept(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield statements that keep the sum which a statement works out, and that ++ and -- mean."""
    del source
    text = module.text
    for node in module.nodes:
        value = node.value if isinstance(node, ast.Expr) else None
        if isinstance(value, ast.Call) and isinstance(value.func, ast.Attribute):
            owner = value.func.value
            if value.func.attr in OF_TEXT and is_name(owner):
                new = f"{text.code(owner)} = {text.code(value)}"
                yield 1, of_piece(module, "unkept", value, new)
        elif isinstance(value, ast.BinOp) and is_name(value.left) and isinstance(value.op, SUMS):
            new = f"{text.code(value.left)} = {text.code(value)}"
            yield 1, of_piece(module, "unkept", value, new)
        elif isinstance(value, ast.UnaryOp) and isinstance(value.operand, ast.UnaryOp):
            inner = value.operand.operand
            if is_name(inner) and isinstance(value.op, ast.UAdd):
                new = f"{text.code(inner)} += {goal.step}"
                yield 1, of_piece(module, "unkept", value, new)


def _bases(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield the classes with rclpy's Node as their base, and its import."""
    del source, goal
    text = module.text
    line = imported(module, "from rclpy.node import Node")
    for found in module.classes:
        for base in found.bases if line is not None else ():
            if text.code(base) != "Node" and line is not None:
                splices = (line, text.swap(base, "Node"))
                yield 4, Change("base", base, text.code(base), "Node", splices)


def imported(module: Module, row: str) -> Splice | None:
    """Return the splice that puts an import above the first one; None if a file has none."""
    imports = [s for s in module.tree.body if isinstance(s, ast.Import | ast.ImportFrom)]
    first = [s.lineno for s in imports if getattr(s, "module", "") != "__future__"]
    return module.text.before(first[0], row) if first else None


def between(module: Module, whole: ast.expr, left: ast.expr, right: ast.expr, sign: str) -> Change:
    """Return the change of the operator between two operands."""
    text = module.text
    (begin, stop), first, last = text.span(whole), text.span(left)[1], text.span(right)[0]
    middle = text.text[first:last]
    closed = middle[: middle.rfind(")") + 1]
    opened = middle[middle.find("(") :] if "(" in middle else ""
    new = f"{closed} {sign} {opened}"
    written = text.text[begin:first] + new + text.text[last:stop]
    return Change("value", whole, text.code(whole), written, (Splice(first, last, new),))


def _called(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield calls of what is only named, and names of what is called."""
    del source, goal
    uses = ast.Expr | ast.Return | ast.If | ast.While | ast.Assign
    inner = ast.Call | ast.BinOp | ast.UnaryOp | ast.FormattedValue
    for node in module.nodes:
        around = module.parents.get(node)
        if isinstance(node, ast.Name | ast.Attribute) and dotted(node):
            function = isinstance(around, ast.Call) and around.func is node
            if isinstance(node.ctx, ast.Load) and isinstance(around, uses | inner) and not function:
                yield 2, of_piece(module, "called", node, f"{module.text.code(node)}()")
        elif isinstance(node, ast.Call) and isinstance(around, ast.Call | ast.keyword):
            if node.args and dotted(node.func) in BUILTINS:
                continue  # (its result is meant)
            yield 3, of_piece(module, "not_called", node, module.text.code(node.func))
        elif isinstance(node, ast.Dict | ast.List | ast.Tuple):
            yield from _none_called(module, node)


def _none_called(module: Module, node: ast.Dict | ast.List | ast.Tuple) -> Found:
    """Yield a collection whose calls without arguments become the functions that they call."""
    items = node.values if isinstance(node, ast.Dict) else node.elts
    calls = [n for n in items if isinstance(n, ast.Call) and not n.args and not n.keywords]
    if calls and not isinstance(getattr(node, "ctx", None), ast.Store):
        text = module.text
        swaps = tuple(text.swap(call, text.code(call.func)) for call in calls)
        name, new = text.code(calls[0]), text.code(calls[0].func)
        yield 2, Change("not_called", calls[0], name, new, swaps)


def _arguments(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield calls without one of their arguments, and with two of them the other way round."""
    del source, goal
    text = module.text
    for call in calls_of(module):
        given: list[ast.expr | ast.keyword] = [*call.args, *call.keywords]
        function = text.code(call.func)
        for gone in given if len(given) > 1 or dotted(call.func) not in BUILTINS else ():
            rest = ", ".join(text.code(one) for one in given if one is not gone)
            yield 3, of_piece(module, "argument", call, f"{function}({rest})", text.code(gone))
        for keyword in call.keywords[:1] if not call.args else ():
            rest = "".join(f", {text.code(one)}" for one in call.keywords[1:])
            new = f"{function}({text.code(keyword.value)}{rest})"
            yield 2, of_piece(module, "value", call, new)
        if len(call.args) == 2 and not call.keywords:
            first, second = (text.code(one) for one in call.args)
            yield 2, of_piece(module, "value", call, f"{function}({second}, {first})")
        if called_name(call) in LOG_METHODS and len(call.args) > 1:
            form, rest = text.code(call.args[0]), ", ".join(text.code(a) for a in call.args[1:])
            star = len(call.args) == 2 and isinstance(call.args[1], ast.Starred)
            for new in (
                f"{form} % {rest[1:] if star else f'({rest},)'}",
                f"{form}.format({rest})",
                f"{form} + str({rest})",
            ):
                yield 2, of_piece(module, "value", call, f"{function}({new})")


def _logged(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield a method of the logger whose lines are shown, and another text for a line."""
    text = goal.before + goal.after
    for call in calls_of(module):
        method, function = called_name(call), call.func
        if method not in (*LOG_METHODS, "log") or not call.args:
            continue
        if isinstance(function, ast.Attribute) and method not in SHOWN:
            code = module.text.code(function.value)
            yield 1, of_piece(module, "value", function, f"{code}.info")
            continue
        names = {dotted(n) for n in ast.walk(call.args[0]) if is_name(n)}
        if not _is_like(call.args[0], goal) or names - {*counters_of(source), *BUILTINS, "self"}:
            continue  # (a text that is worked out is meant to be)
        for name in counters_of(source):
            if not set(text) & set("'{}\\"):
                new = f"f'{goal.before}{{{name}}}{goal.after}'"
                yield 4, of_piece(module, "value", call.args[0], new)


def _is_like(logged: ast.expr, goal: Goal) -> bool:
    """Whether a logged text is meant to be the line of the count: it has some of its words, or no words."""
    parts = [n.value for n in ast.walk(logged) if _is_text(n) and isinstance(n, ast.Constant)]
    words = set(re.findall(r"\w+", " ".join(map(str, parts)).lower()))
    return not words or bool(words & set(re.findall(r"\w+", (goal.before + goal.after).lower())))


def _braces(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield f-strings with single braces, and strings with braces as f-strings."""
    del source, goal
    for node in module.nodes:
        code = module.text.code(node) if isinstance(node, ast.JoinedStr | ast.Constant) else ""
        percent = OF_C.sub("%d", code)
        if percent != code and isinstance(node, ast.Constant):
            yield 1, of_piece(module, "value", node, percent)
        if isinstance(node, ast.JoinedStr) and "{{" in code:
            yield 1, of_piece(module, "value", node, code.replace("{{", "{").replace("}}", "}"))
        elif isinstance(node, ast.Constant) and code[:1] in ("'", '"') and "{" in code:
            yield 2, of_piece(module, "value", node, f"f{code}")
            single = re.sub(r"\{\{\s*(\w*)\s*\}\}|\{\s*(\w*)\s*\}", r"{\1\2}", code)
            if single != code:
                yield 1, of_piece(module, "value", node, single)


def _parts(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield a part of an expression in the place of the whole."""
    del source, goal
    code = module.text.code
    for node in module.nodes:
        if isinstance(node, ast.expr):
            around = module.parents.get(node)
            for part in _parts_of(node, around):
                if isinstance(around, ast.Expr) and not isinstance(part, ast.Call):
                    continue  # (a statement that only names a value does nothing)
                if not isinstance(part, ast.Starred):
                    yield _cost_of_part(node, part), of_piece(module, "value", node, code(part))


def _cost_of_part(node: ast.expr, part: ast.expr) -> int:
    """Return how far a part is from the whole: a mask or a modulo may be too much in it."""
    if not isinstance(node, ast.BinOp):
        return 3
    if isinstance(node.op, ast.Mod | ast.BitAnd) and part is node.left:
        return 2
    return 3 if any(isinstance(p, ast.Constant) for p in (node.left, node.right)) else 5


def _parts_of(node: ast.expr, around: ast.AST | None) -> list[ast.expr]:
    """Return the parts that can stand for the whole; a call of a function of its own is kept."""
    if isinstance(node, ast.Call):
        if isinstance(around, ast.stmt) and dotted(node.func) not in BUILTINS:
            return []
        on = [node.func.value] if isinstance(node.func, ast.Attribute) else []
        return [*node.args[:2], *(keyword.value for keyword in node.keywords[:1]), *on]
    if isinstance(node, ast.BinOp):
        return [node.left, node.right]
    if isinstance(node, ast.BoolOp):
        return node.values
    if isinstance(node, ast.IfExp):
        return [node.body, node.orelse]
    if isinstance(node, ast.List | ast.Tuple | ast.Set) and len(node.elts) == 1:
        return [node.elts[0]]
    if isinstance(node, ast.UnaryOp):
        switch = isinstance(node.op, ast.Not) and is_name(node.operand)
        return [] if switch else [node.operand]  # (what sets a switch is the mistake)
    if isinstance(node, ast.Subscript):
        return [node.value, *([] if isinstance(node.slice, ast.Slice) else [node.slice])]
    if isinstance(node, ast.Starred | ast.Await):
        return [node.value]
    if isinstance(node, ast.Yield) and node.value is not None:
        return [node.value]
    return []


def _names(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield other names of the same function or class in the place of a name."""
    del goal
    own = [name for name in dict.fromkeys(_own_names(module)) if name not in source.methods]
    classes = {found.name for found in module.classes}
    for node in module.nodes:
        if isinstance(node, ast.Attribute) and node.attr in own and dotted(node.value) in classes:
            yield 2, of_piece(module, "value", node, f"self.{node.attr}")
    for function in (n for n in module.nodes if isinstance(n, Function)):
        local = [name for name in dict.fromkeys(_local_names(function)) if name != "self"]
        for node in ast.walk(function):
            if isinstance(node, ast.Attribute) and own_name(node) in own:
                if not isinstance(node.ctx, ast.Load):
                    continue  # (another attribute would lose its value)
                for name in (*(f"self.{name}" for name in own[:MOST_NAMES]), *local[:MOST_NAMES]):
                    yield 3, of_piece(module, "value", node, name)
            elif isinstance(node, ast.Name) and node.id in local:
                if node.id in own or isinstance(node.ctx, ast.Store):
                    yield 2, of_piece(module, "value", node, f"self.{node.id}")
                for name in local[:MOST_NAMES] if isinstance(node.ctx, ast.Load) else ():
                    yield 3, of_piece(module, "value", node, name)


def _renamed(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield an attribute under another name everywhere, and local names as attributes."""
    del source, goal
    text = module.text
    for name in dict.fromkeys(_own_names(module)):
        found = [n for n in module.nodes if isinstance(n, ast.Attribute) and own_name(n) == name]
        new = f"self.own_{name.strip('_')}"
        first = min(found, key=lambda n: n.lineno)
        splices = tuple(text.swap(node, new) for node in found)
        yield 5, Change("renamed", first, f"self.{name}", new, splices)
    blocks: list[Function | ast.ClassDef] = [n for n in module.nodes if isinstance(n, Function)]
    for block in (*blocks, *module.classes):
        functions = [n for n in ast.walk(block) if isinstance(n, Function)]
        given = {a.arg for f in functions for a in f.args.args}
        for name in dict.fromkeys(n for f in functions for n in _local_names(f)):
            uses = [n for n in ast.walk(block) if isinstance(n, ast.Name) and n.id == name]
            if name in given or not uses:
                continue
            outside = [n for n in ast.walk(block) if isinstance(n, ast.Global | ast.Nonlocal)]
            gone = [text.without(n.lineno) for n in outside if n.names == [name]]
            splices = (*gone, *(text.swap(node, f"self.{name}") for node in uses))
            at = min(uses, key=lambda n: n.lineno)
            yield 3, Change("own", at, name, f"self.{name}", splices)


def counters_of(source: NodeSource) -> list[str]:
    """Return the names that the files add to, and the attributes that they set."""
    added: dict[str, None] = {}
    for module in source.known_modules:
        for node in module.nodes:
            if isinstance(node, ast.AugAssign) and is_name(node.target):
                added[module.text.code(node.target)] = None
    for module in source.known_modules:
        added |= {f"self.{name}": None for name in _own_names(module)}
    return list(added)[:MOST_NAMES]


def _own_names(module: Module) -> Iterator[str]:
    for node in module.nodes:
        if isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store) and own_name(node):
            yield node.attr


def _local_names(function: Function) -> Iterator[str]:
    for argument in (*function.args.posonlyargs, *function.args.args, *function.args.kwonlyargs):
        yield argument.arg
    for node in ast.walk(function):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id


def calls_of(module: Module) -> Iterator[ast.Call]:
    """Yield all calls of a file."""
    return (node for node in module.nodes if isinstance(node, ast.Call))


def is_name(node: ast.AST) -> bool:
    """Whether an expression is a name, such as x or self.x."""
    return isinstance(node, ast.Name | ast.Attribute) and bool(dotted(node))


SORTS: tuple[Sort, ...] = (
    *(
        _braces,
        _of_objects,
        _logged,
        _called,
        _timers,
        _of_units,
        _numbers,
        _operators,
        _arguments,
        _names,
        _parts,
        _renamed,
    ),
    *(_counting, _unkept, _bases),
)
