"""The mistake of a parameter that is declared a second time, as use_sim_time of each node."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.constructor import lines_of
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace

DECLARED = r"ParameterAlreadyDeclaredException: .{0,60}\['(?P<name>[\w./-]{1,120})'\]"
OF_EACH = ("use_sim_time", "start_type_description_service")
"""Parameters that rclpy declares in each node."""


def _again(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name, module = match["name"], raised.module
    calls = [
        c
        for c in raised.source.calls_of("declare_parameter")
        if c.args and isinstance(c.args[0], ast.Constant) and c.args[0].value == name
    ]
    here = [c for c in calls if raised.line in lines_of(c)]
    listed = [n for n in module.nodes if isinstance(n, ast.Constant) and n.value == name]
    if not calls and name in OF_EACH and len(listed) == 1:
        params = {"name": name, "line": str(listed[0].lineno)}
        found = raised.finding("declared_twice", params=params)
        return replace(found, words={**found.words, "parameter": name}, variant="each_listed")
    if len(here) != 1 or not module.has(here[0]):
        return None
    if name not in OF_EACH and len(calls) < 2:
        return None
    others = [c for c in calls if c is not here[0]]
    first = min(others or here, key=lambda c: c.lineno)
    params = {"name": name, "line": str(first.lineno)}
    alone = isinstance(module.parents.get(here[0]), ast.Expr)
    written = f"self.get_parameter('{name}')"
    if not alone:
        params |= {"name": module.text.code(here[0]), "written": written}
    found = raised.finding("declared_twice", at=here[0], params=params)
    words = {**found.words, "parameter": name}
    kind = "each" if name in OF_EACH else ""
    variant = kind if alone else f"{kind}_used".lstrip("_")
    return replace(found, words=words, variant=variant)


EACH = msg("Each node has the parameter {parameter}: rclpy declares it when the node is made.")
READ = msg("Write {written} instead of {name} on this line.")
_node = Family("node", links.PARAMETERS)
KINDS = (
    _node(
        "declared_twice",
        "parameter",
        msg("A parameter is declared that the node has already"),
        msg("Line {line} has declared {parameter} already. A parameter is declared once."),
        msg("Delete this line."),
        whys={"each": EACH, "each_used": EACH, "each_listed": EACH},
        fixes={
            "each": msg(
                "Delete this line. The value of {parameter} is given when the node is started: "
                "--ros-args -p {parameter}:=true"
            ),
            "each_listed": msg(
                "Take {parameter} out of what this line declares: delete it in line {line}."
            ),
            "used": READ,
            "each_used": READ,
        },
        raised={DECLARED: _again},
        fixed_by=(lines.written, lines.deleted),
        examples=(
            example(
                "declares_use_sim_time",
                Replace(
                    NODE,
                    "        self.counter_ = 0\n",
                    "        self.declare_parameter('use_sim_time', False)\n        self.counter_ = 0\n",
                ),
                fails="run.starts",
            ),
            example(
                "parameter_declared_twice",
                Replace(
                    NODE,
                    "        self.counter_ = 0\n",
                    "        self.declare_parameter('period', 1.0)\n"
                    "        period = self.declare_parameter('period', 1.0)\n"
                    "        self.counter_ = 0\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
