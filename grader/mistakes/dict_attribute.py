"""The mistake of a dict that is used like a struct: with a dot instead of square brackets."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.example import NODE, STEP_LINE, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.module import Module
from grader.package.source.names import dotted
from grader.package.source.place import statement_at

OF_DICT = r"AttributeError: 'dict' object has no attribute '(?P<name>\w{1,120})'"
METHODS = frozenset(dir(dict))


def _uses(module: Module, name: str) -> list[ast.Attribute]:
    """Return where the file reads or sets an attribute of a dict that a dict does not have.

    What is called is no entry: such a method may be one of a list.
    """
    return [
        n
        for n in module.nodes
        if isinstance(n, ast.Attribute)
        and dotted(n.value) == name
        and n.attr not in METHODS
        and not _is_called(module, n)
    ]


def _is_called(module: Module, part: ast.expr) -> bool:
    around = module.parents.get(part)
    return isinstance(around, ast.Call) and around.func is part


def _is_dict(module: Module, name: str) -> bool:
    """Whether each line that gives the name a value makes a dict."""
    values = [
        n.value
        for n in module.nodes
        if isinstance(n, ast.Assign | ast.AnnAssign) and name in targets_of(n)
    ]
    return bool(values) and all(
        isinstance(v, ast.Dict) or (isinstance(v, ast.Call) and dotted(v.func) == "dict")
        for v in values
    )


def _as_struct(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    module, statement = raised.module, statement_at(raised.module, raised.line)
    for part in ast.walk(statement) if statement is not None else ():
        if not isinstance(part, ast.Attribute) or part.attr != match["name"]:
            continue
        name = dotted(part.value)
        if not name or not _is_dict(module, name) or _is_called(module, part):
            continue
        uses = _uses(module, name)
        params = {"name": f"{name}.{part.attr}", "written": _entry(module, name, part.attr)}
        found = raised.finding("dict_attribute", at=part, params={**params, "object": name})
        lines = sorted({use.lineno for use in uses if use.attr == part.attr} - {part.lineno})
        others = sorted({use.attr for use in uses} - {part.attr})
        words = {
            **found.words,
            "lines": ", ".join(map(str, lines)),
            "others": shown(", ".join(others)),
        }
        variant = "other_names" if others else "lines" if lines else ""
        return replace(found, words=words, variant=variant)
    return None


def _entry(module: Module, name: str, attribute: str) -> str:
    return f"{name}[{module.text.quote}{attribute}{module.text.quote}]"


def _entries(case: Case) -> Files | None:
    """Write square brackets for each name of the dict."""
    module, name = case.module, str(case.finding.params.get("object", ""))
    if module is None or not name or not _is_dict(module, name):
        return None
    rows = {use.lineno: module.text.line(use.lineno) for use in _uses(module, name)}
    if any(re.search(r"[fF]['\"]", row) for row in rows.values()):
        return None  # (quotes in an f-string)
    uses = _uses(module, name)
    return case.changed(
        module, *(module.text.swap(use, _entry(module, name, use.attr)) for use in uses)
    )


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "dict_attribute",
        "callback",
        msg("An entry of a dict is read with a dot"),
        msg("{object} is a dict. Its entries have their names in square brackets, and in quotes."),
        msg("Write {written} instead of {name}."),
        fixes={
            "lines": msg(
                "Write {written} instead of {name}. Do the same in the other lines: {lines}."
            ),
            "other_names": msg(
                "Write {written} instead of {name} in all lines. Do the same for the other names "
                "after {object} and a dot: {others}."
            ),
        },
        raised={OF_DICT: _as_struct},
        fixed_by=(_entries,),
        examples=(
            example(
                "dict_as_struct",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.state_ = {}\n        self.state_.counter = 0",
                ),
                Replace(NODE, "str(self.counter_)", "str(self.state_.counter)"),
                Replace(NODE, STEP_LINE, "        self.state_.counter += 1\n"),
                fails="run.starts",
            ),
        ),
    ),
)
