"""Mistakes in a text that is logged on another line than the one that sets it."""

from __future__ import annotations

import ast
import difflib
import re
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import INNER, LOG, NODE, example
from grader.mistakes.fixes import lines, node_log, node_worked_out
from grader.mistakes.kind import Family
from grader.mistakes.made_by import statements_that_make
from grader.mistakes.recognised import RecognisedMistake, Suspect, first_of
from grader.mistakes.worked_out import worked_out
from grader.package.edit.tree import Replace, Write
from grader.package.source.names import dotted
from grader.package.source.one_change import SEVERAL, logged_lines

ALIKE = 0.7


def _elsewhere(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only string that is nearly the required text, on a line that does not log.

    With the required one in its place, the line that came has to be right.
    """
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


def _appended(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only string on another line that is all of what follows the required text."""
    head, tail = map(re.escape, suspect.output.text.split("{n}"))
    match = re.fullmatch(rf"{head}-?\d+{tail}(?P<more>.*\D)", suspect.text)
    if match is None or not match["more"].strip():
        return None
    found = {
        part
        for n in statements_that_make(suspect.source, suspect.place)
        for part in ast.walk(n)
        if isinstance(part, ast.Constant) and part.value == match["more"]
    }
    if len(found) != 1:
        return None
    part = found.pop()
    module = suspect.source.module_of(part)
    if module.text.plain_string(part) is None:
        return None
    if isinstance(module.parents.get(part), ast.JoinedStr | ast.keyword):
        return None
    quote = module.text.code(part)[0]
    found_at = suspect.finding(
        "text_elsewhere", part, name=module.text.code(part), written=quote * 2
    )
    return replace(found_at, variant="appended")


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
    name = str(found.params["name"]) if found is not None else ""
    if "\\n" in name or SEVERAL.fullmatch(name):
        return found
    return None if plain and call is not None and at == call.lineno else found


def _kept(suspect: Suspect) -> RecognisedMistake | None:
    """The second line has the whole text of the first one in front of its own."""
    first, second = (suspect.output.line(k) for k in range(2))
    if not suspect.text.startswith(first) or second not in suspect.text[len(first) :]:
        return None
    found = suspect.finding("text_kept", suspect.place)
    line = suspect.place.line if suspect.place is not None else None
    return replace(found, words={**found.words, "line": str(line)}, variant="line" if line else "")


def _made_anew(suspect: Suspect) -> RecognisedMistake | None:
    """Write the whole text anew where more than the text around one plain value is wrong."""
    call = suspect.source.log_call
    given = call.args[0] if call is not None else None
    tail = suspect.output.text.split("{n}")[-1]
    if given is None or not _has_other_parts(given, tail):
        return None
    return worked_out("line_made_anew", "whole")(suspect)


def _has_other_parts(given: ast.expr, tail: str) -> bool:
    """Whether a text is made of more than a string, one value, and a string for the wanted tail."""
    if isinstance(given, ast.JoinedStr):
        values = [part for part in given.values if isinstance(part, ast.FormattedValue)]
        last = bool(tail) or (bool(values) and values[0] is given.values[-1])
        return not (len(values) == 1 and dotted(values[0].value) and last)
    if not isinstance(given, ast.BinOp):
        return False
    parts = list(ast.walk(given))
    made = [n for n in parts if isinstance(n, ast.Call) and dotted(n.func) == "str"]
    return len(made) > 1 or any(isinstance(n, ast.Mult) for n in parts)


def _near(suspect: Suspect, wanted: str) -> Iterator[ast.Constant]:
    beside = (node for module in suspect.source.beside for node in module.nodes)
    for node in (*suspect.source.own_nodes, *beside):
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
        "text_kept",
        "text",
        msg("Each line also has the text of the lines before it"),
        msg(
            "What the text is appended to keeps it until the next callback, which appends again: a "
            "text, a list or an object that is made only once."
        ),
        msg("Make what the text is appended to anew in each callback, or log only the new text."),
        fixes={
            "line": msg(
                "Follow what line {line} logs back to what the text is appended to. Make that anew in "
                "each callback, or log only the new text."
            )
        },
        behind={"run.wrong_text": _kept},
        examples=(
            example(
                "list_of_lines",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.lines_ = []"),
                Replace(
                    NODE,
                    LOG,
                    "self.lines_.append(f'Hello time: {self.counter_}')\n"
                    "        self.get_logger().info(' '.join(self.lines_))",
                ),
                fails="run.output",
                blocks=("run.period",),
            ),
        ),
    ),
    _node(
        "text_elsewhere",
        "text",
        msg("A string that is logged differs from the required text"),
        msg("The text is compared character by character: case, spaces and punctuation count."),
        msg("Write {written} instead of {name}."),
        fixes={
            "appended": msg("Write {written} instead of {name}: the required text ends before it.")
        },
        behind={"run.wrong_text": first_of(_worked_out, _elsewhere, _appended)},
        fixed_by=(node_log.right_text(lines.written), node_worked_out.change("text")),
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
                "unit_of_an_imported_constant",
                Write(f"{INNER}/words.py", "UNIT = ' s'\n"),
                Replace(
                    NODE, "import rclpy\n", "import rclpy\nfrom my_robot_controller import words\n"
                ),
                Replace(NODE, "str(self.counter_)", "str(self.counter_) + words.UNIT"),
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
    _node(
        "line_made_anew",
        "text",
        msg("The text that is logged has other parts than the required ones"),
        msg("The required line has one number, and no other part that changes."),
        msg("Write {written} instead of {name}."),
        behind=dict.fromkeys(
            ("run.wrong_text", "run.wrong_start", "run.wrong_step"),
            _made_anew,
        ),
        fixed_by=(node_worked_out.change("whole"),),
        examples=(
            example(
                "two_numbers_in_line",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "f'Hello time: {self.counter_} {self.counter_ + 1}'",
                ),
                fails="run.output",
            ),
        ),
    ),
)
