"""partial() gets what a method gives back, and not the method."""

from __future__ import annotations

import ast
import re

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.constructor import lines_of
from grader.mistakes.example import NODE, PARTIAL_IMPORTED, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.names import called_name

NOT_CALLABLE = r"TypeError: the first argument must be callable"


def _called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The first argument of partial is a call of a function with its arguments."""
    del match
    for call in raised.module.nodes:
        if not isinstance(call, ast.Call) or called_name(call) != "partial":
            continue
        inner = call.args[0] if call.args else None
        if not isinstance(inner, ast.Call) or raised.line not in lines_of(call):
            continue
        code = raised.module.text.code
        given = [code(part) for part in inner.args] + [code(part) for part in inner.keywords]
        given += [code(part) for part in call.args[1:]] + [code(part) for part in call.keywords]
        parts = ", ".join([code(inner.func), *given])
        params = {"name": code(call), "written": f"{code(call.func)}({parts})"}
        if "\n" not in params["name"]:
            return raised.finding("partial_called", at=call, params=params)
    return None


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "partial_called",
        "callback",
        msg("partial gets the result of a call"),
        msg(
            "The brackets behind the function call it at once, and partial gets what it gives back. "
            "partial takes the function itself first, and then the values with which it is called later."
        ),
        msg("Write {written} instead of {name}."),
        raised={NOT_CALLABLE: _called},
        fixed_by=(lines.written,),
        examples=(
            example(
                "partial_of_a_call",
                PARTIAL_IMPORTED,
                Replace(NODE, "self.timer_callback)", "partial(self.timer_callback(5)))"),
                Replace(NODE, "timer_callback(self)", "timer_callback(self, step)"),
                fails="run.starts",
            ),
        ),
    ),
)
