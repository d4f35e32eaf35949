"""Mistakes in what a logger gets: a list, a message or a number instead of a text."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.constructor import lines_of
from grader.mistakes.example import DEAD, LOG_LINE, NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.init_returns import parts_of
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.counter import starts_of, targets_of
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part, own_name
from grader.package.source.node import LOG_METHODS
from grader.package.source.place import function_at

NO_TEXT = r"TypeError: rclpy_logging_rcutils_log\(\): incompatible function arguments"
PERCENT = r"%[-+ 0#]*\d*(?:\.\d+)?[diufFeEgGxXosrc]"
TEXT = "'Hello time: ' + str(self.counter_)"


def _no_text(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The call of the logger on the line gets something else than a text."""
    del match
    found = [
        call
        for call, name in calls_in(raised.module.tree)
        if last_part(name) in LOG_METHODS and raised.line in lines_of(call) and len(call.args) == 1
    ]
    given = found[0].args[0] if len(found) == 1 else None
    code = raised.module.text.code(given) if given is not None else ""
    if given is None or "\n" in code or isinstance(given, ast.Starred):
        return None
    own = own_name(given) in {*raised.source.methods} - raised.source.attributes
    if own or _is_method(raised, given):
        return _finding(raised, given, code, f"{code}()", "method")
    value = _value_of(raised, given)
    known = _message(raised, given, value) or _number(raised, given, value)
    known = known or (_of_value(raised, value) if value is not None else None)
    return known or _finding(raised, given, code, f"str({code})", "unknown")


def _is_method(raised: Raised, given: ast.expr) -> bool:
    """Whether an attribute of a helper object is a method that the file defines."""
    if not isinstance(given, ast.Attribute) or dotted(given.value) == "self":
        return False
    parents = raised.module.parents
    found = [
        n for n in raised.module.nodes if isinstance(n, ast.FunctionDef) and n.name == given.attr
    ]
    set_too = any(
        isinstance(n, ast.Attribute) and n.attr == given.attr and isinstance(n.ctx, ast.Store)
        for n in raised.module.nodes
    )
    plain = [f for f in found if not f.decorator_list and isinstance(parents.get(f), ast.ClassDef)]
    return bool(found) and plain == found and not set_too


def _finding(
    raised: Raised, at: ast.expr, name: str, written: str, variant: str
) -> RecognisedMistake | None:
    if "\n" in name + written:
        return None
    params = {"name": shown(name), "written": shown(written)}
    found = raised.finding("logged_no_text", at=at, params=params)
    words = {**found.words, "line": str(raised.line or 0)}
    return replace(found, words=words, variant=variant)


def _value_of(raised: Raised, given: ast.expr) -> ast.expr | None:
    """Return the value that a variable or an attribute got before, else the expression itself."""
    name, module = dotted(given), raised.module
    if not isinstance(given, ast.Name | ast.Attribute):
        method = raised.source.method(own_name(given.func)) if isinstance(given, ast.Call) else None
        return _returned(method) if method is not None else given
    function = function_at(module, raised.line)
    inside = list(parts_of(function)) if function is not None else []
    for nodes in (inside, raised.source.own_nodes, module.tree.body):
        values = [
            (n.lineno, n.value)
            for n in nodes
            if isinstance(n, ast.Assign | ast.AnnAssign) and name in targets_of(n)
        ]
        if nodes is inside:
            values = [v for v in values if v[0] <= (raised.line or 0)][-1:]
        if values:
            value = values[0][1]
            return value if len(values) == 1 and value is not None else None
    return None


def _returned(method: Function) -> ast.expr | None:
    """Return what a method returns, if it has one return."""
    returns = [p for p in parts_of(method) if isinstance(p, ast.Return)]
    if any(isinstance(p, ast.Yield | ast.YieldFrom) for p in parts_of(method)):
        return None
    return returns[0].value if len(returns) == 1 else None


def _message(raised: Raised, given: ast.expr, value: ast.expr | None) -> RecognisedMistake | None:
    """A message of ROS is logged instead of its field."""
    module, name = raised.module, dotted(given)
    kind, field = "", ""
    if isinstance(value, ast.Call) and dotted(value.func) in raised.interfaces:
        kind = dotted(value.func)
        fields = {k.arg for k in value.keywords if k.arg}
        fields |= {
            n.attr
            for n in module.nodes
            if isinstance(n, ast.Attribute)
            and isinstance(n.ctx, ast.Store)
            and dotted(n.value) == name
        }
        field = fields.pop() if len(fields) == 1 else ""
    elif isinstance(given, ast.Name) and value is None:
        kind = _subscribed(raised, given.id)
        imported = [n.module for n in module.nodes if isinstance(n, ast.ImportFrom)
                    and kind in [a.asname or a.name for a in n.names]]  # fmt: skip
        field = "data" if imported == ["std_msgs.msg"] else ""
    if not kind or not name:
        return None
    code = f"{name}.{field}" if field else f"{name}.…"
    written = code if kind == "String" else f"str({code})"
    found = _finding(raised, given, name, written, "message" if field else "message_open")
    return replace(found, words={**found.words, "type": kind}) if found is not None else None


def _subscribed(raised: Raised, name: str) -> str:
    """Return the type of the message that a subscription passes to the function of the line."""
    function = function_at(raised.module, raised.line)
    parameters = [a.arg for a in function.args.args] if function is not None else []
    for call in raised.source.calls_of("create_subscription"):
        callback = last_part(dotted(call.args[2])) if len(call.args) > 2 else ""
        if function is not None and callback == function.name and name in parameters:
            return dotted(call.args[0]) if isinstance(call.args[0], ast.Name) else ""
    return ""


def _number(raised: Raised, given: ast.expr, value: ast.expr | None) -> RecognisedMistake | None:
    """A number is logged: the counter itself, or another one."""
    name, code = dotted(given), raised.module.text.code(given)
    literal = isinstance(value, ast.Constant) and type(value.value) in (int, float, bool)
    if not literal and name not in starts_of(raised.source):
        return None
    counts = name == raised.words["counter"]
    written = str(raised.words["f_string"]) if counts else f"str({code})"
    return _finding(raised, given, code, written, "counter" if counts else "number")


def _of_value(raised: Raised, value: ast.expr) -> RecognisedMistake | None:
    """What was logged, by the code that makes it: its place is the line to change."""
    if not raised.source.modules or not any(m.has(value) for m in raised.source.modules):
        return None
    text = raised.source.module_of(value).text
    code = text.code(value)
    if isinstance(value, ast.List | ast.Tuple | ast.Set) and value.elts:
        if any(isinstance(part, ast.Starred) for part in value.elts) or not _is_line(raised, value):
            return None
        if _has_places(value.elts[0]):
            return _with_places(raised, value)
        written = " + ".join(_as_text(text.code(part), part) for part in value.elts)
        kind = type(value).__name__.lower()
        return _finding(raised, value, code, written, kind)
    return None


def _has_places(part: ast.expr) -> bool:
    """Whether a text has places for values: %d or {}."""
    text = part.value if isinstance(part, ast.Constant) else ""
    return isinstance(text, str) and bool(re.search(PERCENT, text) or "{" in text)


def _with_places(raised: Raised, value: ast.List | ast.Tuple | ast.Set) -> RecognisedMistake | None:
    """The values for the places of a text stand behind a comma, as those of printf do."""
    first, *rest = value.elts
    text, module = getattr(first, "value", ""), raised.source.module_of(value)
    codes = ", ".join(module.text.code(part) for part in rest)
    percent, braces = re.findall(PERCENT, text), text.count("{}")
    plain = len(rest) == 1 and isinstance(rest[0], ast.Name | ast.Attribute | ast.Call)
    if not rest or (bool(percent) == bool(braces)) or len(rest) != (len(percent) or braces):
        return None
    behind = f" % {codes}" if plain else f" % ({codes})"
    written = module.text.code(first) + (behind if percent else f".format({codes})")
    return _finding(raised, value, module.text.code(value), written, "places")


def _is_line(raised: Raised, value: ast.List | ast.Tuple | ast.Set) -> bool:
    """Whether values stand for one line: one of them is a text, and nothing else uses them."""
    parts = [n for n in value.elts if isinstance(n, ast.JoinedStr) or _as_text("", n) == ""]
    assigned = raised.source.module_of(value).parents.get(value)
    names = [*targets_of(assigned)] if assigned is not None else []
    used = [n for n in raised.source.all_nodes if dotted(n) in names]
    return bool(parts) and len(used) <= 2 * len(names)


def _as_text(code: str, part: ast.expr) -> str:
    """Return a piece of a text as code that makes a text."""
    text = isinstance(part, ast.Constant) and isinstance(part.value, str)
    made = isinstance(part, ast.Call) and dotted(part.func) in ("str", "repr")
    return code if text or made or isinstance(part, ast.JoinedStr) else f"str({code})"


_node = Family("node", links.PYTHON_STRINGS)
KINDS = (
    _node(
        "logged_no_text",
        "logger",
        msg("The logger gets something else than a text"),
        msg("The methods of the logger log a text, and nothing else."),
        msg("Write {written} instead of {name}."),
        links.LOGGING,
        whys={
            "list": msg(
                "Square brackets make a list, and no text. Line {line} logs it. In Python, + joins "
                "texts."
            ),
            "tuple": msg(
                "Values with a comma between them are a tuple, and no text. Line {line} logs it. In "
                "Python, + joins texts."
            ),
            "set": msg(
                "Values in braces are a set, and no text. Line {line} logs it. In Python, + joins "
                "texts."
            ),
            "places": msg(
                "Values with a comma between them are several values, and no text. Line {line} logs them. "
                "A comma does not put a value into the text before it."
            ),
            "method": msg("{name} is a method, and no text: with (), Python calls it."),
            "message": msg(
                "{name} is a message of the type {type}, and no text. The logger needs the text that "
                "is in the message."
            ),
            "message_open": msg(
                "{name} is a message of the type {type}, and no text. The logger needs the text that "
                "is in the message."
            ),
            "number": msg("{name} is a number, and no text. str() makes a text of a number."),
            "counter": msg("{name} is a number, and no text."),
        },
        fixes={
            "message_open": msg(
                "Write {written} instead of {name}, with the name of the field in the place of …"
            ),
            "unknown": msg(
                "Give a text to the logger. If the value of {name} is what you want to log, write "
                "{written} instead of {name}: str() makes a text of it."
            ),
        },
        raised={NO_TEXT: _no_text},
        fixed_by=(lines.written,),
        examples=(
            example(
                "logged_list",
                Replace(
                    NODE,
                    LOG_LINE,
                    "        text = ['Hello time: ', str(self.counter_)]\n"
                    "        self.get_logger().info(text)\n",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "logged_tuple",
                Replace(NODE, TEXT, "('Hello time: ', self.counter_)"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "logged_tuple_as_of_printf",
                Replace(NODE, TEXT, "('Hello time: %d', self.counter_)"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "logged_number",
                Replace(NODE, TEXT, "self.counter_"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
