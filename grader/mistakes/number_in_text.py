"""Mistakes in how the number gets into the text: + with a number, and the f of an f-string."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.names import called_name
from grader.package.source.place import statement_at
from grader.package.source.readable import is_readable

MOST_CODE = 80  # characters of a piece of code that a text shows
ADDED = (
    r"can only concatenate str \(not \"(?:int|float|bool|complex)\""
    r"|unsupported operand type\(s\) for \+: '(?:int|float)' and 'str'"
)


def _concatenated(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """One + of the line has a text on one side, and no text on the other."""
    number_first = match[0].startswith("unsupported")
    statement = statement_at(raised.module, raised.line)
    if statement is None or isinstance(statement, ast.AugAssign):
        return None  # (what is added to may be the text)
    code, kept = raised.module.text.code, set(targets_of(statement))
    sums = [
        n for n in ast.walk(statement) if isinstance(n, ast.BinOp) and isinstance(n.op, ast.Add)
    ]
    sides = [(n.left, n.right) if number_first else (n.right, n.left) for n in sums]
    if any({code(number), code(text)} & kept for number, text in sides):
        return None
    found = [n for n, text in sides if (has_text(text) or len(sides) == 1) and _is_one(n, text)]
    operand = min(found, key=lambda n: (n.lineno, n.col_offset), default=None)
    if operand is None:
        return None
    written = f"str({code(_converted(operand))})"
    return raised.finding("str_plus_int", name=code(operand), written=written)


def _converted(value: ast.expr) -> ast.expr:
    """Return what int() or float() gets; other values as they are."""
    if not isinstance(value, ast.Call) or not value.args:
        return value
    return value.args[0] if called_name(value) in ("int", "float") else value


def _is_one(number: ast.expr, text: ast.expr) -> bool:
    """Whether a side of + can be the number: one behind a text with a value belongs to the value."""
    late = isinstance(number, ast.Constant) and isinstance(text, ast.BinOp | ast.Call)
    return not late and not has_text(number) and not isinstance(number, ast.BinOp)


def has_text(value: ast.expr) -> bool:
    """Whether one of the parts of a sum is a text for certain."""
    if isinstance(value, ast.BinOp) and isinstance(value.op, ast.Add | ast.Mod):
        added = isinstance(value.op, ast.Add)
        return has_text(value.left) or (added and has_text(value.right))
    made = isinstance(value, ast.Call) and called_name(value) in ("str", "format", "join")
    plain = isinstance(value, ast.Constant) and isinstance(value.value, str)
    return made or plain or isinstance(value, ast.JoinedStr)


def _f_prefix(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only string that is the logged text, whose braces hold what can be read there."""
    source = suspect.source
    texts = [n for n in source.all_nodes if isinstance(n, ast.Constant) and n.value == suspect.text]
    values = re.findall(r"\{([^{}!:=]{1,80})[!:=]?[^{}]{0,20}\}", suspect.text)
    if len(texts) != 1 or not values or re.match(r"[fF]['\"]", suspect.text):
        return None  # (a whole f-string may be in the quotes)
    string = texts[0]
    module, around = source.module_of(string), source.function_around(string)
    plain = module.text.plain_string(string) is not None
    code = module.text.code(string)
    named = all(value.strip()[:1].isalpha() or value.startswith("_") for value in values)
    if not named or not plain or not all(is_readable(source, module, around, v) for v in values):
        return None
    found = suspect.finding("f_prefix", string, name=code, written=f"f{code}")
    return replace(found, variant="written" if len(code) <= MOST_CODE else "")


_node = Family("node", links.PYTHON_STRINGS)
KINDS = (
    _node(
        "str_plus_int",
        "text",
        msg("A string and a number are added"),
        msg("Python's + joins a string only with another string."),
        msg("Write {written} instead of {name}: str() makes a string of a number."),
        seen=r'TypeError: can only concatenate str \(not "(?P<type>int|float|bool|complex)"\) to str'
        r"|TypeError: unsupported operand type\(s\) for \+: '(?:int|float)' and 'str'",
        raised={ADDED: _concatenated},
        fixed_by=(lines.written,),
        examples=(
            example(
                "int_for_str",
                Replace(NODE, "str(self.counter_)", "int(self.counter_)"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "str_missing",
                Replace(NODE, "str(self.counter_)", "self.counter_"),
                fails="run.output",
                blocks=DEAD,
                note='can only concatenate str (not "int") to str',
            ),
        ),
    ),
    _node(
        "f_prefix",
        "text",
        msg("The f before the string is missing"),
        msg("Python replaces {{…}} with a value only in a string that begins with f."),
        msg("Write an f before the first quote: {f_string}"),
        fixes={"written": msg("Write an f before the first quote: {written}")},
        seen=r"^\[[A-Z]{4,5}\] \[\d{1,12}\.\d{9}\] \[[^\]\n]{1,100}\]: [^\n{]{0,200}\{self\.\w{1,60}\}",
        behind={"run.wrong_text": _f_prefix},
        fixed_by=(lines.written,),
        examples=(
            example(
                "f_prefix_missing",
                Replace(
                    NODE, "'Hello time: ' + str(self.counter_)", "'Hello time: {self.counter_}'"
                ),
                fails="run.output",
            ),
        ),
    ),
)
