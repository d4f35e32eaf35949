"""A parameter that is declared with a type and no value, and read."""

from __future__ import annotations

import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.declared import declared
from grader.package.source.names import dotted
from grader.package.source.place import place_of

UNSET = (
    r"ParameterUninitializedException: The parameter '(?P<name>[\w./]{1,100})' is not initialized"
)
VALUES = {"INTEGER": "0", "DOUBLE": "1.0", "STRING": "''", "BOOL": "False"}
"""A value of each type of parameters, as Python writes it."""


def _no_value(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    """A parameter is read that was declared with its type alone."""
    name = match["name"]
    words = {**raised.words, "name": name}
    found = RecognisedMistake(
        kind="parameter.no_value", params={"name": name}, words=words, where=raised.where
    )
    known = [p for p in declared(raised.source) if p.name == name]
    given = known[0].default if len(known) == 1 else None
    kind = dotted(given).rpartition(".Type.")[2] if given is not None else ""
    if given is None or kind not in VALUES:
        return found
    code = raised.source.module_of(given).text.code(given)
    shown = {"name": code, "written": VALUES[kind]}
    words |= {**shown, "parameter": name}
    where = place_of(raised.source, given)
    return replace(found, params=shown, words=words, variant="typed", where=where)


_parameter = Family("parameter", links.PARAMETERS)
KINDS = (
    _parameter(
        "no_value",
        "parameter",
        msg("A parameter is read that has no value"),
        msg(
            "{name} is declared with a type and without a default value. Until somebody sets it, it has "
            "no value, and get_parameter() raises an error."
        ),
        msg(
            "Give declare_parameter() a default value of this type as its second argument, in the place "
            "of the type."
        ),
        whys={
            "typed": msg(
                "The second argument of declare_parameter() is the default value, and {name} is only a type. "
                "Until somebody sets the parameter {parameter}, it has no value, and get_parameter() raises "
                "an error."
            ),
        },
        fixes={
            "typed": msg(
                "Write a default value, for example {written}, instead of {name}: ROS takes the type from it."
            ),
        },
        raised={UNSET: _no_value},
        fixed_by=(lines.written,),
        examples=(
            example(
                "parameter_with_a_type_alone",
                Replace(
                    NODE,
                    "import rclpy\n",
                    "import rclpy\nfrom rclpy.parameter import Parameter\n",
                ),
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.declare_parameter('start', Parameter.Type.INTEGER)\n"
                    "        self.counter_ = self.get_parameter('start').value",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
