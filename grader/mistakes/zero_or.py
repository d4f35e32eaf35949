"""The number 0 counts as false, so that `or` puts another value in its place."""

from __future__ import annotations

import ast

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.mistakes.worked_out import INSTEAD
from grader.package.edit.tree import Replace
from grader.package.source.counter import starts_of
from grader.package.source.names import dotted

PARTS = 2  # of `counter or something`


def _or_other(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the counter, or something else in place of it where it is 0."""
    names = set(starts_of(suspect.source))
    for node in suspect.source.all_nodes:
        if not isinstance(node, ast.BoolOp) or not isinstance(node.op, ast.Or):
            continue
        code = suspect.source.module_of(node).text.code(node)
        if dotted(node.values[0]) in names and len(node.values) == PARTS and "\n" not in code:
            written = dotted(node.values[0])
            return suspect.finding("zero_is_false", node, name=code, written=written)
    return None


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "zero_is_false",
        "counter",
        msg("Where the number is 0, another value takes its place"),
        msg(
            "or gives its second part if the first one counts as false, and the number 0 counts as "
            "false. So {name} is not 0 where {written} is 0."
        ),
        INSTEAD,
        behind=dict.fromkeys(("run.wrong_text", "run.wrong_start"), _or_other),
        fixed_by=(lines.written,),
        examples=(
            example(
                "zero_or_an_empty_text",
                Replace(NODE, "str(self.counter_)", "str(self.counter_ or '')"),
                fails="run.output",
            ),
        ),
    ),
)
