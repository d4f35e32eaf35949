"""The mistake of a type before the name, as in C: `int: counter = 0` gives the value to `int`."""

from __future__ import annotations

import ast
import re

from grader.base.i18n.message import msg
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import NAME_ERROR, OWN_ATTRIBUTE, Raised, RecognisedMistake, of_self
from grader.package.edit.tree import Replace
from grader.package.source.names import dotted

TYPES = ("int", "float", "str", "bool", "list", "dict", "double", "string", "var", "let", "const")
CALLED = r"TypeError: '(?:int|float|str|bool|list|dict)' object is not callable"


def _of_attribute(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    return _found(raised, f"self.{match['name']}") if of_self(raised, match) else None


def _of_name(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    return _found(raised, match["name"])


def _of_type(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line calls the type, which is a variable of this name now."""
    del match
    row = raised.module.line(raised.line)
    called = [name for name in TYPES if re.search(rf"(?<![\w.]){name}\(", row)]
    return _found(raised, None, *called) if called else None


def _found(raised: Raised, name: str | None, *types: str) -> RecognisedMistake | None:
    """Return the line that has the type before a name, and gives the value to the type."""
    for module in raised.source.modules:
        for node in module.nodes:
            if not isinstance(node, ast.AnnAssign) or node.value is None:
                continue
            kind, meant = dotted(node.target), dotted(node.annotation)
            if kind not in (types or TYPES) or not meant or (name or meant) != meant:
                continue
            used = [n for n in module.nodes if dotted(n) == meant and n is not node.annotation]
            if not used or (name is None and meant in TYPES):
                continue
            code = shown(module.text.code(node))
            new = shown(f"{meant} = {module.text.code(node.value)}")
            params = {"name": code, "written": new, "type": kind, "attribute": meant}
            return raised.finding("type_first", at=node, params=params)
    return None


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "type_first",
        "counter",
        msg("The type is before the name"),
        msg(
            "In Python the name comes first. Here {type} is the variable that gets the value, and "
            "{attribute} gets none."
        ),
        msg("Write {written} instead of {name}."),
        raised={OWN_ATTRIBUTE: _of_attribute, NAME_ERROR: _of_name, CALLED: _of_type},
        fixed_by=(lines.written,),
        examples=(
            example(
                "type_before_attribute",
                Replace(NODE, "self.counter_ = 0", "int: self.counter_ = 0"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "type_before_constant",
                Replace(NODE, "class MyFirstNode", "float: PERIOD = 1.0\n\n\nclass MyFirstNode"),
                Replace(NODE, "(1.0,", "(PERIOD,"),
                fails="run.starts",
            ),
        ),
    ),
)
