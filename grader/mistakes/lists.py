"""Mistakes with numbers and lists: len() of a number, and what else is used as the counter."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import Value, msg, say
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines, node_lists
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.mistakes.worked_out import INSTEAD
from grader.package.edit.tree import Replace
from grader.package.source.names import dotted
from grader.package.source.other_values import OtherValue, other_value


def _len_of_number(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    call = node_lists.len_call(raised.module, raised.line)
    if call is None:
        return None
    name, written = dotted(call.args[0]), node_lists.without_len(raised.module, call)
    return raised.finding("len_of_number", at=call, name=name, written=written)


def _is_list(suspect: Suspect) -> RecognisedMistake | None:
    """The text shows the brackets of a list that the callback logs."""
    found = node_lists.list_counter(suspect.source)
    if found is None or "[" not in suspect.text:
        return None
    mistake = suspect.finding("counter_is_list", found.start, name=found.name)
    if len(found.changes) != 1:
        return mistake
    words = {**mistake.words, "line": str(found.changes[0].lineno)}
    return replace(mistake, variant="line", words=words)


def _other_value(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a counter that is something else than a number, by the form of the text."""
    head, tail = suspect.output.text.split("{n}")
    text = suspect.text
    if not text.startswith(head) or not text.endswith(tail):
        return None
    source = suspect.source
    found = other_value(source, text[len(head) : len(text) - len(tail)])
    if found is None:
        return None
    code, start = found.module.text.code, suspect.output.start
    words: dict[str, Value] = {"what": WHAT[found.sort], "line": str(found.start.lineno)}
    words["attribute"] = found.name
    if found.element is not None:
        name = source.module_of(found.element).text.code(found.element)
        mistake = suspect.finding(
            "counter_other_value", found.element, name=name, written=f"int({name})"
        )
        return replace(mistake, words={**mistake.words, **words}, variant="element")
    item = _item(suspect, found)
    if item:
        mistake = suspect.finding(
            "counter_other_value", suspect.place, name=found.name, written=item
        )
        return replace(mistake, words={**mistake.words, **words}, variant="item")
    written = f"{found.name} = {start}"
    if found.others:  # (more than one line has to change: no line to write for the other)
        mistake = suspect.finding("counter_other_value", found.start, name=code(found.start))
        words["written"] = written
    else:
        mistake = suspect.finding(
            "counter_other_value", found.start, name=code(found.start), written=written
        )
    words["others"] = ", ".join(str(node.lineno) for node in found.others)
    variant = "changes" if found.others else ""
    return replace(mistake, words={**mistake.words, **words}, variant=variant)


def _item(suspect: Suspect, found: OtherValue) -> str:
    """Return the code of the item that the only other line adds to, for the line that is logged."""
    change = found.others[0] if len(found.others) == 1 else None
    target = change.target if isinstance(change, ast.AugAssign) else None
    line = suspect.place.line if suspect.place is not None else None
    if change is None or line is None or not isinstance(target, ast.Subscript):
        return ""
    code = found.module.text.code(target)
    row = suspect.source.module_at(suspect.place.file if suspect.place else "").line(line)
    if dotted(target.value) != found.name or row.count(found.name) != 1:
        return ""
    if re.search(r"\bf'", row):
        code = code.replace("'", '"')
    return code if not re.search(r'\bf"', row) or '"' not in code else ""


WHAT = {
    "array": say("an array of numpy"),
    "list": say("a list"),
    "tuple": say("a tuple"),
    "dict": say("a dictionary"),
    "set": say("a set"),
    "complex": say("a complex number"),
    "time": say("a time"),
    "decimal": say("a number with its own form"),
}
_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "len_of_number",
        "text",
        msg("len() gets a number"),
        msg(
            "len() counts the elements of a list, or the characters of a text. {name} is a number."
        ),
        msg("Write {written} instead of len({name})."),
        seen=r"TypeError: object of type '(?:int|float)' has no len\(\)",
        raised={r"object of type '(?:int|float)' has no len\(\)": _len_of_number},
        fixed_by=(node_lists.name_alone,),
        examples=(
            example(
                "len_of_counter",
                Replace(NODE, "str(self.counter_)", "str(len(self.counter_))"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "counter_is_list",
        "counter",
        msg("The counter is a list"),
        msg(
            "{name} is a list. The text shows the list itself, with its brackets and elements, and "
            "not a number."
        ),
        msg(
            "Let the counter be a number: write {name} = {start} on this line, and "
            "{name} += {step} in the callback."
        ),
        fixes={
            "line": msg(
                "Let the counter be a number: write {name} = {start} on this line, and "
                "{name} += {step} instead of line {line}."
            )
        },
        behind={"run.wrong_text": _is_list},
        fixed_by=(node_lists.number_for_list,),
        examples=(
            example(
                "counter_is_list",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = []"),
                Replace(NODE, "self.counter_ += 1", "self.counter_.append(1)"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "counter_other_value",
        "counter",
        msg("The counter is not a plain number"),
        msg(
            "{attribute} is {what}, made in line {line}. A text shows it in the form of its type, "
            "with other signs than digits. An integer is shown as the plain number."
        ),
        INSTEAD,
        links.PYTHON_CLASSES,
        whys={
            "element": msg(
                "{attribute} is {what}, made in line {line}. Its elements are numbers with a "
                "decimal point, if nothing else is said."
            )
        },
        fixes={
            "item": msg("Write {written} instead of {name} in this line: only the item is logged."),
            "changes": msg(
                "Write {written} instead of {name}, and {attribute} += {step} instead of what "
                "changes it (line {others})."
            ),
        },
        behind={"run.wrong_text": _other_value},
        fixed_by=(node_lists.plain_start, lines.written),
        examples=(
            example(
                "counter_is_array",
                Replace(NODE, "import rclpy\nfrom", "import numpy as np\nimport rclpy\nfrom"),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = np.zeros(1)"),
                Replace(NODE, "self.counter_ += 1", "self.counter_ = self.counter_ + 1"),
                fails="run.output",
            ),
            example(
                "whole_dict_in_text",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = {'count': 0}"),
                Replace(NODE, "self.counter_ += 1", "self.counter_['count'] += 1"),
                fails="run.output",
            ),
            example(
                "counter_is_complex",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0j"),
                fails="run.output",
            ),
        ),
    ),
)
