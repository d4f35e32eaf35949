"""Mistakes in a text that is logged on another line than the one that sets it."""

from __future__ import annotations

import ast
import difflib
from collections.abc import Iterator

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG, NODE, example
from grader.mistakes.fixes import lines, node_worked_out
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.mistakes.worked_out import first_of, worked_out
from grader.package.edit.tree import Replace
from grader.package.source.one_change import logged_lines

ALIKE = 0.7


def _elsewhere(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only string that is nearly the required text, on a line that does not log."""
    before, _, after = suspect.output.text.partition("{n}")
    if after or not before.strip():
        return None
    if suspect.lines and logged_lines(suspect.source) is not None:
        return None  # (no other text of a string gives the required lines)
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


def _worked_out(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the string to change; not in a sum or an f-string that the only log call gets."""
    call = suspect.source.log_call
    given = call.args[0] if call is not None else None
    plain = isinstance(given, ast.JoinedStr | ast.Constant)
    if isinstance(given, ast.BinOp) and isinstance(given.op, ast.Add):
        ends = [p for p in (given.left, given.right) if isinstance(p, ast.Constant)]
        plain = isinstance(given.left, ast.Constant | ast.BinOp) and bool(ends)
    found = worked_out("text_elsewhere", "text")(suspect)
    at = found.where.line if found is not None and found.where is not None else None
    if found is not None and "\\n" in str(found.params["name"]):
        return found
    return None if plain and call is not None and at == call.lineno else found


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
        behind={"run.wrong_text": first_of(_worked_out, _elsewhere)},
        fixed_by=(lines.written, node_worked_out.change("text")),
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
