"""Mistakes in the places of a text for format(): names and numbers for which no value is given."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.names import called_name
from grader.package.source.place import function_at, statement_at
from grader.package.source.readable import is_readable

NO_KEY = r"KeyError: (?P<name>'[^'\n]{1,120}'|\"[^\"\n]{1,120}\")"
NO_INDEX = r"IndexError: Replacement index \d{1,9} out of range"
FIELD = re.compile(r"\{([A-Za-z_][\w.]{0,80})")
TEXT = "'Hello time: ' + str(self.counter_)"


def _calls(raised: Raised) -> list[ast.Call]:
    """Return the calls of format on the line."""
    statement = statement_at(raised.module, raised.line)
    parts = ast.walk(statement) if statement is not None else ()
    return [n for n in parts if isinstance(n, ast.Call) and called_name(n) == "format"]


def _named(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A place of the text has a name for which the call of format gives no value."""
    name, calls, text = match["name"][1:-1], _calls(raised), raised.module.text
    call = calls[0] if len(calls) == 1 else None
    made = call.func.value if call is not None and isinstance(call.func, ast.Attribute) else None
    if call is None or not isinstance(made, ast.Constant | ast.Name | ast.Attribute):
        return None
    if isinstance(made, ast.Constant) and f"{{{name}" not in str(made.value):
        return None
    fields = FIELD.findall(text.plain_string(made) or "")
    place = next((field for field in fields if field.partition(".")[0] == name), name)
    found = raised.finding("format_value_missing", at=call)
    words = {**found.words, "place": shown(f"{{{place}}}")}
    code = text.code(call)
    if call.args or call.keywords or not _are_known(raised, fields) or "\n" in code:
        return replace(found, words=words)
    params = {"name": code, "written": f"f{code.removesuffix('()').removesuffix('.format')}"}
    found = raised.finding("format_value_missing", at=call, params=params)
    return replace(found, words={**words, **params}, variant="f_string")


def _are_known(raised: Raised, fields: list[str]) -> bool:
    """Whether the code at this place can read what all places of the text name."""
    function = function_at(raised.module, raised.line)
    known = [is_readable(raised.source, raised.module, function, field) for field in fields]
    return bool(known) and all(known)


def _numbered(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The text has more places than values, or a place has a number for which there is no value."""
    del match
    calls = _calls(raised)
    if len(calls) != 1:
        return None
    func, count = calls[0].func, len(calls[0].args)
    made = func.value if isinstance(func, ast.Attribute) else None
    text = raised.module.text.plain_string(made)
    found = raised.finding("format_value_missing", at=calls[0])
    if text is None or made is None or not count or not re.search(r"\{\d", text):
        return replace(found, variant="too_many")
    words = {"name": shown(raised.module.text.code(made)), "written": str(count - 1)}
    return replace(found, words={**found.words, **words}, variant="highest")


_node = Family("node", links.PYTHON_STRINGS)
KINDS = (
    _node(
        "format_value_missing",
        "text",
        msg("A place of the text gets no value"),
        msg(
            "format() puts the values of its () in the places of the text. A place with a name needs "
            "name=value in the (), and {{}} takes the next value."
        ),
        msg("Give a value for this place in the () of format: {place}"),
        whys={
            "f_string": msg(
                "format() does not know {place}: it only has the values of its (). An f-string reads "
                "the variables themselves."
            ),
            "highest": msg("format() counts its values from 0: {{0}} is the first one."),
            "too_many": msg("Each {{}} of the text takes one value of the () of format."),
        },
        fixes={
            "f_string": msg("Write an f-string: {written} instead of {name}"),
            "highest": msg(
                "No place of {name} may have a higher number than {written}: the last value of the () "
                "has this number. Write a lower number, or give more values."
            ),
            "too_many": msg(
                "The text has more places {{}} than format has values. Write a value in the () of "
                "format for each place, or delete the places that are too many."
            ),
        },
        raised={NO_KEY: _named, NO_INDEX: _numbered},
        fixed_by=(lines.written,),
        examples=(
            example(
                "format_without_values",
                Replace(NODE, TEXT, "'Hello time: {self.counter_}'.format()"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "format_counts_from_one",
                Replace(NODE, TEXT, "'Hello time: {1}'.format(self.counter_)"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "format_of_other_name",
                Replace(NODE, TEXT, "'Hello time: {n}'.format(m=self.counter_)"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
