"""Mistakes in what a name stands for: a number as a string, a variable with the name of a function."""

from __future__ import annotations

import ast
import builtins
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, LOG, NODE, example
from grader.mistakes.fixes import node_values
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect, always, on_line
from grader.package.edit.tree import Replace
from grader.package.source.counter import adds_to, logged_counter, starts_of
from grader.package.source.module import Module
from grader.package.source.names import dotted
from grader.package.source.place import function_at, statement_at

ADDED = (
    r"can only concatenate str \(not \"(?:int|float)\"\) to str"
    r"|unsupported operand type\(s\) for \+=?: '(?:int|float)' and 'str'"
)


def _start_is_text(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line that fails adds to a counter that starts with a number in quotes."""
    del match
    statement = statement_at(raised.module, raised.line)
    value = statement.value if isinstance(statement, ast.Assign) else None
    if isinstance(value, ast.Call) and dotted(value.func) == "str":
        return None  # (the counter is kept as a text)
    starts = starts_of(raised.source, str)
    for part in ast.walk(statement) if statement is not None else ():
        start = starts.get(dotted(part))
        if start is None or statement is None or not _is_added(statement, dotted(part)):
            continue
        if node_values.number_in(start):
            number = node_values.number_in(start)
            return raised.finding("start_is_text", at=start, name=dotted(part), value=number)
    return None


def _is_added(statement: ast.stmt, name: str) -> bool:
    """Whether a statement adds to a name, or has a sum of it alone and of another value."""
    sums = [n for n in ast.walk(statement) if isinstance(n, ast.BinOp)]
    first = any(dotted(n.left) == name for n in sums)
    last = any(dotted(n.right) == name and not _has_text(n.left) for n in sums)
    return adds_to(statement, name) or first or last


def _has_text(value: ast.expr) -> bool:
    return any(isinstance(n, ast.Constant) and isinstance(n.value, str) for n in ast.walk(value))


def _joined(suspect: Suspect) -> RecognisedMistake | None:
    """The counter starts with a number in quotes, and the callback appends to it."""
    logged = logged_counter(suspect.source)
    start = starts_of(suspect.source, str).get(logged[1]) if logged is not None else None
    value = node_values.number_in(start) if start is not None else ""
    if start is None or logged is None or not value:
        return None
    found = suspect.finding("start_is_text", start, name=logged[1], value=value)
    module = suspect.source.module_of(start)
    grows = node_values.appended(module, logged[1]) or node_values.joined(module, logged[1])
    return replace(found, variant="joined") if grows else found


def _hidden(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line that fails calls one of Python's functions whose name the file uses otherwise."""
    named = match.groupdict().get("name")
    statement = statement_at(raised.module, raised.line)
    for call in ast.walk(statement) if statement is not None else ():
        name = dotted(call.func) if isinstance(call, ast.Call) else ""
        if name in dir(builtins) and named in (None, name):
            at = _assigned(raised, name)
            if at is not None:
                return raised.finding("name_hides_function", at=at, name=name)
    return None


def _assigned(raised: Raised, name: str) -> ast.Name | None:
    """Return where a name gets a value: in the function that fails, else in the module."""
    module, function = raised.module, function_at(raised.module, raised.line)
    stores = [n for n in module.nodes if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)]
    for scope in (function, None):
        for found in stores:
            if found.id != name or raised.source.function_around(found) is not scope:
                continue
            if scope is not None or not _in_class(module, found):
                return found
    return None


def _in_class(module: Module, part: ast.AST) -> bool:
    return any(isinstance(around, ast.ClassDef) for around in module.around(part))


_node = Family("node", links.PYTHON_STRINGS)
KINDS = (
    _node(
        "start_is_text",
        "counter",
        msg("The counter starts as a string"),
        msg("A number in quotes is a string, and Python cannot add a string to a number."),
        msg("Write {name} = {value}, without quotes."),
        whys={
            "joined": msg(
                "A number in quotes is a string. Adding to a string makes it longer: '0' + '1' is '01'."
            )
        },
        fixes={
            "joined": msg(
                "Write {name} = {value}, and {name} += {step} where it grows, without quotes. Where + "
                "joins it to a text, write str({name})."
            )
        },
        raised={ADDED: _start_is_text},
        behind={"run.wrong_text": _joined, "run.wrong_step": _joined},
        fixed_by=(node_values.number,),
        examples=(
            example(
                "counter_grows_as_text",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = '0'"),
                Replace(NODE, "str(self.counter_)", "self.counter_"),
                Replace(NODE, "self.counter_ += 1", "self.counter_ += '1'"),
                fails="run.output",
                blocks=("run.period",),
            ),
            example(
                "counter_is_text",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = '0'"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "text_not_a_number",
        "start",
        msg("float() gets a text that is no number"),
        msg(
            "float() reads only a number: digits, a sign, a point and an exponent. It cannot read {text}."
        ),
        msg(
            "Look at how this line gets {text}: follow it from the value with which it begins. What "
            "reaches float() has to be a number only, without a unit."
        ),
        raised={
            r"could not convert string to float: (?P<text>'[^'\n]{0,60}')": on_line(
                always("text_not_a_number")
            )
        },
        examples=(
            example(
                "unit_left_in_a_period",
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        period = float('1.0s')\n        self.create_timer(period,",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "name_hides_function",
        "callback",
        msg("A variable has the name of one of Python's own functions"),
        msg(
            "After {name} = … the name {name} means this value, and {name}(…) does not call "
            "Python's function any more."
        ),
        msg("Give the variable another name than {name}."),
        links.PYTHON_ERRORS,
        raised={
            r"TypeError: '\w{1,120}' object is not callable": _hidden,
            r"UnboundLocalError: .{0,60}'(?P<name>\w{1,120})'": _hidden,
        },
        fixed_by=(node_values.other_name,),
        examples=(
            example(
                "variable_named_str",
                Replace(
                    NODE,
                    LOG,
                    "str = 'Hello time: '\n"
                    "        self.get_logger().info(str + str(self.counter_))",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
