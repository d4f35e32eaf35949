"""Mistakes in a text that is logged on another line than the one that sets it."""

from __future__ import annotations

import ast
import difflib
from collections.abc import Iterator

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG, NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace

ALIKE = 0.7


def _elsewhere(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only string that is nearly the required text, on a line that does not log."""
    before, _, after = suspect.output.text.partition("{n}")
    if after or not before.strip():
        return None
    found = list(_near(suspect, before))
    logged = {n for call in suspect.source.own_logs for n in ast.walk(call)}
    if len(found) != 1 or found[0] in logged:
        return None
    module = suspect.source.module_of(found[0])
    code = module.text.code(found[0])
    if module.text.plain_string(found[0]) is None:
        return None
    written = f"{code[0]}{before}{code[0]}"
    return suspect.finding("text_elsewhere", found[0], name=code, written=written)


def _near(suspect: Suspect, wanted: str) -> Iterator[ast.Constant]:
    for node in suspect.source.own_nodes:
        if not isinstance(node, ast.Constant) or not isinstance(node.value, str):
            continue
        around = suspect.source.module_of(node).parents.get(node)
        if isinstance(around, ast.JoinedStr | ast.Expr) or node.value == wanted:
            continue
        value = node.value.lower()
        alike = difflib.SequenceMatcher(None, value, wanted.lower(), autojunk=False).ratio()
        if alike >= ALIKE and len(value) <= 2 * len(wanted):
            yield node


_node = Family("node", links.PYTHON_STRINGS)
KINDS = (
    _node(
        "text_elsewhere",
        "text",
        msg("A string that is logged differs from the required text"),
        msg("The text is compared character by character: case, spaces and punctuation count."),
        msg("Write {written} instead of {name}."),
        behind={"run.wrong_text": _elsewhere},
        fixed_by=(lines.written,),
        examples=(
            example(
                "text_in_attribute",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = 0\n        self.prefix_ = 'Hello time:'",
                ),
                Replace(NODE, LOG, "self.get_logger().info(self.prefix_ + str(self.counter_))"),
                fails="run.output",
            ),
        ),
    ),
)
