"""A method that reads self, and that a decorator or its empty brackets keep from getting it."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.edit.tree import Replace
from grader.package.source.module import Module
from grader.package.source.names import dotted
from grader.package.source.place import function_at

STATIC = ("staticmethod", "classmethod")
HEAD = re.compile(r"def[ \t]+\w+[ \t]*\((?P<given>[^()]*)\)")


def _without_self(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The def around the line is in a class, and self is none of its parameters."""
    function = function_at(raised.module, raised.line)
    if match["name"] != "self" or function is None:
        return None
    if not isinstance(raised.module.parents.get(function), ast.ClassDef):
        return None
    decorators = [d for d in function.decorator_list if dotted(d) in STATIC]
    head = HEAD.search(raised.module.line(function.lineno))
    given = [arg.arg for arg in (*function.args.posonlyargs, *function.args.args)]
    if head is None or "self" in given or (given and not decorators):
        return None
    row = raised.module.line(function.lineno).strip()
    of_class = bool(decorators) and dotted(decorators[0]) == "classmethod"
    kept = given[1:] if of_class else given
    written = row.replace(f"({head['given']})", f"({', '.join(['self', *kept])})", 1)
    found = raised.finding("self_of_static", at=function, written=written)
    if not decorators:
        return replace(found, variant="called")
    words = {"name": dotted(decorators[0]), "line": str(decorators[0].lineno)}
    return replace(found, words={**found.words, **words})


def _with_self(case: Case) -> Files | None:
    """Delete the decorator, and write the def with self."""
    module, line = case.module, case.finding.line
    function = function_at(module, line + 1) if module is not None and line else None
    if module is None or function is None or not line or function.lineno != line:
        return None
    decorators = [d for d in function.decorator_list if dotted(d) in STATIC]
    if (
        len(decorators) != 1
        or module.line(decorators[0].lineno).strip() != f"@{dotted(decorators[0])}"
    ):
        return None
    row, written = module.line(line), str(case.finding.params.get("written", ""))
    head = _head(module, line, row.strip(), written)
    return case.changed(module, module.text.without(decorators[0].lineno), head)


def _head(module: Module, line: int, old: str, new: str) -> Splice:
    start = module.text.start_of(line) + module.line(line).index(old)
    return Splice(start, start + len(old), new)


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "self_of_static",
        "callback",
        msg("A method that uses self does not get it"),
        msg("@{name} (line {line}) makes a def that gets no object, so self is unknown in it."),
        msg("Delete the line @{name} above this def, and write the def so: {written}"),
        whys={
            "called": msg(
                "self is the first parameter of a method. This def has no parameter, so self is "
                "unknown in it."
            )
        },
        fixes={
            "called": msg(
                "Write: {written} Then call it with the node and a dot before its name: self.… in a "
                "method of the class."
            )
        },
        raised={NAME_ERROR: _without_self},
        fixed_by=(_with_self,),
        examples=(
            example(
                "static_method_reads_self",
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "self.label()"),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    @staticmethod\n    def label():\n"
                    "        return 'Hello time: ' + str(self.counter_)\n\n    def timer_callback",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
