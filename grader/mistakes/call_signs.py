"""Mistakes in how Python's own signs are used in a call: [] for (), % for format(), super(…)."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.names import dotted
from grader.package.source.place import statement_at

NO_LIST = (
    r"TypeError: (?:'(?:method|function|builtin_function_or_method)' object|type '\w{1,60}')"
    r" is not subscriptable"
)
NOT_CONVERTED = r"TypeError: not all arguments converted during string formatting"
PLACE = re.compile(r"%[-+ #0]{0,3}\d{0,3}(?:\.\d{1,3})?[a-zA-Z%]")
FIELD = re.compile(r"(?<!\{)\{\d?\}(?!\})")


def _parts(raised: Raised) -> Iterator[ast.AST]:
    statement = statement_at(raised.module, raised.line)
    yield from ast.walk(statement) if statement is not None else ()


def _subscript(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A function has square brackets behind its name."""
    del match
    found = [n for n in _parts(raised) if isinstance(n, ast.Subscript) and dotted(n.value)]
    if len(found) != 1:
        return None
    text = raised.module.text
    code, function = text.code(found[0]), text.code(found[0].value)
    inside = code.removeprefix(function).strip()
    if "\n" in code or not inside.startswith("[") or not inside.endswith("]"):
        return None
    written = f"{function}({inside[1:-1].strip()})"
    return raised.finding("square_brackets", at=found[0], name=code, written=written)


def _percent(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The text before % has no place for the value: none, or braces as for format()."""
    del match
    text = raised.module.text
    for part in _parts(raised):
        if not isinstance(part, ast.BinOp) or not isinstance(part.op, ast.Mod):
            continue
        left, code = text.plain_string(part.left), text.code(part)
        if left is None or PLACE.search(left) or "\n" in code:
            continue
        before, given = text.code(part.left), text.code(part.right)
        count = len(FIELD.findall(left))
        values = len(part.right.elts) if isinstance(part.right, ast.Tuple) else 1
        inside = given[1:-1] if isinstance(part.right, ast.Tuple) and given[:1] == "(" else given
        if count == values:
            written = f"{before}.format({inside})"
            return raised.finding("percent_without_place", at=part, name=code, written=written)
        if count == 0 and values == 1 and not isinstance(part.right, ast.Tuple) and "%" not in left:
            written = f"{before[:-1]}%d{before[-1]} % {given}"
            found = raised.finding("percent_without_place", at=part, name=code, written=written)
            return replace(found, variant="none")
    return None


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "square_brackets",
        "callback",
        msg("A function is called with square brackets"),
        msg("A function is called with round brackets, (). Square brackets [] read from a list."),
        msg("Write {written} instead of {name}"),
        raised={NO_LIST: _subscript},
        fixed_by=(lines.written,),
        examples=(
            example(
                "info_in_square_brackets",
                Replace(
                    NODE,
                    ".info('Hello time: ' + str(self.counter_))",
                    ".info['Hello time: ' + str(self.counter_)]",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "timer_in_square_brackets",
                Replace(
                    NODE,
                    "create_timer(1.0, self.timer_callback)",
                    "create_timer[1.0, self.timer_callback]",
                ),
                fails="run.starts",
            ),
            example(
                "str_in_square_brackets",
                Replace(NODE, "str(self.counter_)", "str[self.counter_]"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "percent_without_place",
        "text",
        msg("The text before % has no place for the value"),
        msg("% puts a value where the text has %d or %s. Braces are the places of format()."),
        msg("Write {written} instead of {name}"),
        links.PYTHON_STRINGS,
        whys={"none": msg("% puts a value where the text has %d or %s. This text has neither.")},
        raised={NOT_CONVERTED: _percent},
        fixed_by=(lines.written,),
        examples=(
            example(
                "percent_with_braces",
                Replace(
                    NODE, "'Hello time: ' + str(self.counter_)", "'Hello time: {}' % self.counter_"
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "percent_without_place",
                Replace(
                    NODE, "'Hello time: ' + str(self.counter_)", "'Hello time: ' % self.counter_"
                ),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
