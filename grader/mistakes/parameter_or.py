"""The mistake of a plain value as the alternative of get_parameter_or()."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.names import calls_in, last_part
from grader.package.source.place import statement_at

PLAIN = r"AttributeError: '(?:int|float|str|bool|list|NoneType)' object has no attribute 'value'"


def _plain(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for a get_parameter_or() of a name and a plain value in the line."""
    del match
    statement = statement_at(raised.module, raised.line)
    for call, name in calls_in(statement) if statement is not None else ():
        if last_part(name) != "get_parameter_or" or len(call.args) != 2 or call.keywords:
            continue
        if not isinstance(call.func, ast.Attribute):
            continue
        text = raised.module.text
        owner, given = text.code(call.func.value), ", ".join(map(text.code, call.args))
        found = raised.finding(
            "plain_alternative",
            at=call,
            name=text.code(call),
            written=f"{owner}.declare_parameter({given})",
        )
        return replace(found, words={**found.words, "code": text.code(call.args[1])})
    return None


_node = Family("node", links.PARAMETERS)
KINDS = (
    _node(
        "plain_alternative",
        "parameter",
        msg("get_parameter_or() gets a plain value"),
        msg(
            "The node has not declared this parameter, so get_parameter_or() returns its second argument as "
            "it is: {code}. That is no parameter, and has no .value."
        ),
        msg(
            "Write {written} instead of {name}: it declares the parameter with this default, and returns it."
        ),
        raised={PLAIN: _plain},
        fixed_by=(lines.written,),
        examples=(
            example(
                "get_parameter_or_with_a_number",
                Replace(
                    NODE,
                    "self.create_timer(1.0,",
                    "self.create_timer(self.get_parameter_or('period', 1.0).value,",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
