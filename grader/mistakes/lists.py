"""Mistakes with numbers and lists: len() of a number, and a list as the counter."""

from __future__ import annotations

import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import node_lists
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.names import dotted


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
)
