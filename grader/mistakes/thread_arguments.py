"""The mistake of a thread that gets the arguments of its function without a tuple."""

from __future__ import annotations

import ast
import re

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.names import called_name, dotted, last_part

STARTS = ("Thread", "Timer", "Process")
NO_ITEMS = (
    r"TypeError: (?P<function>[\w.]{1,200})(?:\(\))? argument after \* must be an iterable, not "
    r"(?P<type>[\w.]{1,120})"
)


def _no_tuple(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The only args= of a thread that is no tuple is an object without items."""
    if raised.where is not None and raised.where.line and not raised.inside:
        return None  # (the line itself has the *)
    found = [
        (call, keyword)
        for call, _ in raised.source.calls
        if called_name(call) in STARTS
        for keyword in call.keywords
        if keyword.arg == "args"
        and isinstance(keyword.value, ast.Name | ast.Attribute | ast.Call | ast.Constant)
    ]
    target = last_part(match["function"])
    named = [(c, k) for c, k in found if any(last_part(dotted(p)) == target for p in _parts(c))]
    found = named or found
    if len(found) != 1:
        return None
    call, keyword = found[0]
    text = raised.source.module_of(call).text
    name, inner = text.code(keyword), text.code(keyword.value)
    if "\n" in name:
        return None
    params = {"name": name, "written": f"args=({inner},)", "type": last_part(match["type"])}
    return raised.finding("thread_arguments", at=keyword.value, params=params)


def _parts(call: ast.Call) -> list[ast.expr]:
    return [*call.args, *(keyword.value for keyword in call.keywords if keyword.arg == "target")]


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "thread_arguments",
        "start",
        msg("A thread gets its arguments without a tuple"),
        msg(
            "A thread calls its target with the items of args. {name} is one object of the type {type}, "
            "which has no items: a tuple of one item needs a comma behind it."
        ),
        msg("Write {written} instead of {name}."),
        raised={NO_ITEMS: _no_tuple},
        fixed_by=(lines.written,),
        examples=(
            example(
                "thread_arguments_without_comma",
                Replace(NODE, "import rclpy\nfrom", "import threading\n\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        thread = threading.Thread(target=rclpy.spin, args=(node))\n"
                    "        thread.start()\n"
                    "        thread.join()\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
