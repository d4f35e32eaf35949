"""Mistakes in a text that is logged on another line than the one that sets it."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from difflib import SequenceMatcher

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import INNER, LOG, NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import INSTEAD, Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace, Write

ALIKE = 0.7


def _elsewhere(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only string that is nearly the required text, on a line that does not log.

    With the required one in its place, the line that came has to be right.
    """
    before, _, after = suspect.output.text.partition("{n}")
    if after or not before.strip():
        return None
    found = list(_near(suspect, before))
    logged = {n for call in suspect.source.own_logs for n in ast.walk(call)}
    if len(found) != 1 or found[0] in logged:
        return None
    module = suspect.source.module_of(found[0])
    code, value = module.text.code(found[0]), str(found[0].value)
    if module.text.plain_string(found[0]) is None or not _is_right(suspect, value, before):
        return None
    written = f"{code[0]}{before}{code[0]}"
    return suspect.finding("text_elsewhere", found[0], name=code, written=written)


def _is_right(suspect: Suspect, value: str, wanted: str) -> bool:
    """Whether the line has the required form with another text in the place of this one."""
    head, tail = map(re.escape, suspect.output.text.split("{n}"))
    came = suspect.text.replace(value, wanted)
    return suspect.text.count(value) == 1 and bool(re.fullmatch(rf"{head}-?\d+{tail}", came))


def _near(suspect: Suspect, wanted: str) -> Iterator[ast.Constant]:
    beside = (node for module in suspect.source.beside for node in module.nodes)
    for node in (*suspect.source.own_nodes, *beside):
        if not isinstance(node, ast.Constant) or not isinstance(node.value, str):
            continue
        around = suspect.source.module_of(node).parents.get(node)
        if isinstance(around, ast.JoinedStr | ast.Expr) or node.value == wanted:
            continue
        value = node.value.lower()
        alike = SequenceMatcher(None, value, wanted.lower(), autojunk=False).ratio()
        if alike >= ALIKE and len(value) <= 2 * len(wanted):
            yield node


_node = Family("node", links.PYTHON_STRINGS)
KINDS = (
    _node(
        "text_elsewhere",
        "text",
        msg("A string that is logged differs from the required text"),
        msg("The text is compared character by character: case, spaces and punctuation count."),
        INSTEAD,
        behind={"run.wrong_text": _elsewhere},
        fixed_by=(lines.written,),
        examples=(
            example(
                "text_of_an_imported_constant",
                Write(f"{INNER}/words.py", "HELLO = 'Hello time:'\n"),
                Replace(
                    NODE,
                    "import rclpy\n",
                    "import rclpy\nfrom my_robot_controller.words import HELLO\n",
                ),
                Replace(NODE, "'Hello time: ' +", "HELLO +"),
                fails="run.output",
            ),
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
