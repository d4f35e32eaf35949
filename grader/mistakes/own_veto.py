"""The mistake of a callback for parameters that is added before the parameters are declared."""

from __future__ import annotations

import ast
import re

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.lines import own_lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.names import called_name, calls_in
from grader.package.source.place import block_of, statement_at

ADDS = ("add_on_set_parameters_callback", "add_pre_set_parameters_callback")
DECLARES = ("declare_parameter", "declare_parameters")


def _asked_early(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line that adds the callback is above one that declares a parameter, in one block."""
    for call, _ in raised.source.calls:
        if called_name(call) not in ADDS:
            continue
        module = raised.source.module_of(call)
        statement = statement_at(module, call.lineno)
        below = _declares_below(block_of(module, statement), statement) if statement else []
        given = [module.text.code(argument) for argument in call.args]
        if below and len(given) == 1:
            params = {"name": given[0], "line": str(below[-1].lineno), "text": match["text"]}
            return raised.finding("parameter_refused", at=call, params=params)
    return None


def _declares_below(block: list[ast.stmt], statement: ast.stmt) -> list[ast.stmt]:
    """Return the statements of a block below one that declare parameters."""
    below = block[block.index(statement) + 1 :] if statement in block else []
    return [s for s in below if any(called_name(call) in DECLARES for call, _ in calls_in(s))]


def _added_below(case: Case) -> Files | None:
    """Add the callback below the last statement that declares a parameter."""
    module, line = case.module, case.finding.line
    statement = statement_at(module, line) if module is not None else None
    if module is None or statement is None:
        return None
    below = _declares_below(block_of(module, statement), statement)
    rows = own_lines(module, statement)
    if not below or rows is None:
        return None
    code = [module.text.line(row) for row in rows]
    put = module.text.before((below[-1].end_lineno or below[-1].lineno) + 1, *code)
    return case.changed(module, *(module.text.without(row) for row in rows), put)


_node = Family("node", links.PARAMETERS)
KINDS = (
    _node(
        "parameter_refused",
        "parameter",
        msg("The node refuses the default value of its own parameter"),
        msg(
            "From this line on, ROS asks {name} before it sets a parameter, also when one is declared. It "
            "does not accept {text}, which a line below declares as the default value."
        ),
        msg("Move this line below line {line}, the last one that declares a parameter."),
        raised={
            r"InvalidParameterValueException: Invalid parameter value \((?P<text>.{0,60}?)\) for": _asked_early
        },
        fixed_by=(_added_below,),
        examples=(
            example(
                "parameter_declared_below_its_callback",
                Replace(
                    NODE,
                    "from rclpy.node import Node\n",
                    "from rcl_interfaces.msg import SetParametersResult\nfrom rclpy.node import Node\n",
                ),
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        self.add_on_set_parameters_callback(self.judge)\n"
                    "        self.declare_parameter('text', 'Hello time: ')\n"
                    "        self.create_timer(1.0,",
                ),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def judge(self, parameters):\n"
                    "        known = all(p.name == 'period' for p in parameters)\n"
                    "        return SetParametersResult(successful=known)\n\n"
                    "    def timer_callback",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
