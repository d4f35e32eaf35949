"""Mistakes in where a period comes from: a parameter that is read as another type, a tiny number."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines, node_timer
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.names import called_name, dotted, own_name
from grader.package.source.node import NodeSource
from grader.package.source.period import seconds_of
from grader.report.model import Where

FIELDS = {"double_value": float, "integer_value": int, "string_value": str, "bool_value": bool}
RIGHT = {kind: field for field, kind in FIELDS.items()}
ROS_TYPES = {float: "double", int: "integer", str: "string", bool: "bool"}
UNSET = {float: "0.0", int: "0", str: "''", bool: "False"}
"""What the fields of a ParameterValue hold that are not of the parameter's type."""
NUMBER = re.compile(r"\d{1,6}(?:\.\d{1,6})?")
TINY = 0.05  # seconds; with a longer period a node does not flood the terminal
MOST_STEPS = 6


@dataclass(frozen=True)
class _Read:
    """A field that is read of a parameter, and the default with which it is declared."""

    field: ast.Attribute
    default: ast.Constant
    parameter: str


def _reads(source: NodeSource) -> Iterator[_Read]:
    declared = [c for c in source.calls_of("declare_parameter") if len(c.args) > 1]
    for part in source.own_nodes:
        if not isinstance(part, ast.Attribute) or part.attr not in FIELDS:
            continue
        found = _parameter(source, part.value)
        if found is None:
            continue
        name = found.args[0] if found.args else None
        if not isinstance(name, ast.Constant) or not isinstance(name.value, str):
            continue
        same = [
            c.args[1]
            for c in declared
            if isinstance(c.args[0], ast.Constant) and c.args[0].value == name.value
        ]
        if len(same) == 1 and isinstance(same[0], ast.Constant):
            yield _Read(part, same[0], name.value)


def _parameter(source: NodeSource, value: ast.expr) -> ast.Call | None:
    """Return the call that gets or declares the parameter of a get_parameter_value()."""
    for _ in range(MOST_STEPS):
        if isinstance(value, ast.Call) and called_name(value) in (
            "get_parameter",
            "declare_parameter",
        ):
            return value
        if isinstance(value, ast.Call) and called_name(value) == "get_parameter_value":
            if not isinstance(value.func, ast.Attribute):
                return None
            value = value.func.value
        elif dotted(value):
            found = node_timer.value_of(source, value)
            if found is None or found is value:
                return None
            value = found
        else:
            return None
    return None


def _in_period(source: NodeSource, part: ast.expr) -> bool:
    """Whether a timer's period is calculated with a part of the source."""
    waiting = [timer.period for timer in source.timers if timer.period is not None]
    for _ in range(MOST_STEPS):
        parts = [n for value in waiting for n in ast.walk(value)]
        if part in parts:
            return True
        named = [n for n in parts if isinstance(n, ast.Name | ast.Attribute)]
        values = [node_timer.value_of(source, n) for n in named]
        waiting = [v for n, v in zip(named, values, strict=True) if v is not None and v is not n]
    return False


def _in_callback(source: NodeSource, part: ast.expr) -> bool:
    """Whether the callback reads what a field of a parameter is assigned to."""
    callback, around = source.callback, source.module_of(part).parents.get(part)
    names = map(dotted, around.targets) if isinstance(around, ast.Assign) else []
    used = {dotted(n) for n in ast.walk(callback)} if callback is not None else set()
    return bool({name for name in names if name} & used) or source.function_around(part) is callback


def _other_type(suspect: Suspect) -> RecognisedMistake | None:
    source = suspect.source
    if source.calls_of("set_parameters"):
        return None
    for read in _reads(source):
        kind, wanted = type(read.default.value), FIELDS[read.field.attr]
        if kind not in RIGHT or kind is wanted:
            continue
        if not _in_period(source, read.field) and not _in_callback(source, read.field):
            continue
        return _told(suspect, read, kind, wanted)
    return None


def _told(suspect: Suspect, read: _Read, kind: type, wanted: type) -> RecognisedMistake:
    field, default = read.field, read.default
    text = suspect.source.module_of(default).text
    params = {"name": field.attr, "written": RIGHT[kind], "parameter": read.parameter}
    at: ast.expr = field
    variant = ""
    if (kind, wanted) == (int, float):
        params |= {"name": text.code(default), "written": repr(float(int(str(default.value))))}
        at, variant = default, "default"
    elif kind is str and wanted in (int, float) and NUMBER.fullmatch(str(default.value)):
        params |= {"name": text.code(default), "written": repr(wanted(float(str(default.value))))}
        at = default
    found = suspect.finding("parameter_field", at, **params)
    types = {"type": ROS_TYPES[kind], "field": field.attr, "value": UNSET[wanted]}
    line = field.end_lineno or field.lineno
    place = Where(file=suspect.source.module_of(at).path, line=line if at is field else at.lineno)
    return replace(found, variant=variant, words={**found.words, **types}, where=place)


def _tiny(suspect: Suspect) -> RecognisedMistake | None:
    """Only the callback of the only timer logs, and the output is a flood."""
    source, callback = suspect.source, suspect.source.callback
    timer = source.timers[0] if len(source.timers) == 1 else None
    if timer is None or timer.period is None or callback is None or own_name(timer.callback) == "":
        return None
    inside = set(ast.walk(callback))
    logged = [c for c, name in source.calls if source.is_log(c) or name == "print"]
    if source.method(timer.method) is not callback or not any(c in inside for c in logged):
        return None
    loops = [n for n in inside if isinstance(n, ast.While | ast.For | ast.ListComp)]
    always = [s.value for s in callback.body if isinstance(s, ast.Expr)]
    leaves = any(isinstance(n, ast.Return | ast.Raise) for n in inside)
    if leaves or not any(call in always for call in logged):
        return None  # (not each call logs)
    if loops or any(call not in inside for call in logged):
        return None
    seconds = seconds_of(source, timer.period)
    if seconds is not None and not 0 <= seconds < TINY:
        return None
    value = node_timer.value_of(source, timer.period) or timer.period
    code = source.module_of(value).text.code(value)
    if "\n" in code:
        return None
    if seconds is None and (part := _part_of_a_span(suspect)) is not None:
        return part
    found = suspect.finding("period_tiny", value, name=code, written=suspect.assignment.seconds)
    return found if seconds is not None else replace(found, variant="unknown")


def _part_of_a_span(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only microseconds of a timedelta: they are the part below a second."""
    source = suspect.source
    nodes = [n for module in source.known_modules for n in module.nodes]
    parts = [n for n in nodes if isinstance(n, ast.Attribute) and n.attr == "microseconds"]
    if len(parts) != 1:
        return None
    module = source.module_of(parts[0])
    around = module.parents.get(parts[0])
    divided = isinstance(around, ast.BinOp) and isinstance(around.op, ast.Div)
    whole = around if isinstance(around, ast.BinOp) and divided else parts[0]
    name = module.text.code(whole)
    written = f"{module.text.code(parts[0].value)}.total_seconds()"
    found = suspect.finding("period_tiny", whole, name=name, written=written)
    return replace(found, variant="part") if "\n" not in name else None


def _known(suspect: Suspect) -> RecognisedMistake | None:
    """The same with a period that the source shows: it is too short for any clock."""
    found = _tiny(suspect)
    return found if found is not None and found.variant == "" else None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "parameter_field",
        "parameter",
        msg("The parameter is read as another type than it has"),
        msg(
            "The parameter {parameter} is declared with a value of the type {type}. "
            "get_parameter_value() has one field for each type, and only that of the parameter's "
            "type is set: {field} is {value}."
        ),
        msg("Write {written} instead of {name} on this line."),
        fixes={
            "default": msg(
                "Write {written} instead of {name} on this line: with a point it is a double."
            )
        },
        behind=dict.fromkeys(
            (
                *("run.too_much_output", "run.wrong_period", "run.no_lines", "run.wrong_text"),
                *("run.wrong_start", "run.wrong_step", "run.constant_counter"),
            ),
            _other_type,
        ),
        fixed_by=(lines.written,),
        examples=(
            example(
                "integer_read_as_double",
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        self.declare_parameter('period', 1)\n"
                    "        period = self.get_parameter('period').get_parameter_value()"
                    ".double_value\n"
                    "        self.create_timer(period,",
                ),
                fails="run.output",
                blocks=("run.spins", *DEAD),
            ),
            example(
                "double_read_as_integer",
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        self.declare_parameter('period', 1.0)\n"
                    "        value = self.get_parameter('period').get_parameter_value()\n"
                    "        self.create_timer(value.integer_value,",
                ),
                fails="run.output",
                blocks=("run.spins", *DEAD),
            ),
        ),
    ),
    _node(
        "period_tiny",
        "timer",
        msg("The timer calls the callback without a pause"),
        msg(
            "The period is given in seconds. With {name} the timer is due again at once, and each "
            "call of the callback logs a line."
        ),
        msg("Write {written} instead of {name} on this line."),
        whys={
            "part": msg(
                "microseconds of a timedelta is only the part below a whole second, and 0 for one second. "
                "total_seconds() is the whole. With a period of 0 the timer calls {callback} without a pause."
            ),
            "unknown": msg(
                "Only {callback} logs, and the timer calls it. Lines without a pause come from a "
                "period of 0 or nearly 0. The timer's period is {name}, which has such a value when "
                "the node runs."
            ),
        },
        behind={
            "run.too_much_output": _tiny,
            **dict.fromkeys(("run.by_hand", "run.wrong_period", "run.twice"), _known),
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "period_nearly_zero",
                Replace(NODE, "create_timer(1.0,", "create_timer(1e-6,"),
                fails="run.period",
            ),
            example(
                "microseconds_of_a_timedelta",
                Replace(NODE, "import rclpy\n", "from datetime import timedelta\n\nimport rclpy\n"),
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "def seconds(span):\n    return span.microseconds / 1e6\n\n\nclass MyFirstNode",
                ),
                Replace(NODE, "create_timer(1.0,", "create_timer(seconds(timedelta(seconds=1)),"),
                fails="run.output",
                blocks=("run.spins", *DEAD),
            ),
            example(
                "period_of_division",
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        period = len(self.get_name()) // 100\n        self.create_timer(period,",
                ),
                fails="run.output",
                blocks=("run.spins", *DEAD),
            ),
        ),
    ),
)
