"""A sign or a def in another place than was meant, where Python reads it as something else."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import OWN_ATTRIBUTE, Raised, RecognisedMistake, of_self, on_line
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.edit.tree import Replace
from grader.package.source.module import Function
from grader.package.source.scopes import has_self, scope_of

# a dot for another sign


# a def inside of another one


def _def_inside(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The method that is missing stands in another method, indented too far."""
    name, module = match["name"], raised.module
    made = [n for n in module.nodes if isinstance(n, Function) and n.name == name]
    if not of_self(raised, match) or len(made) != 1 or not has_self(made[0]):
        return None
    outer = scope_of(module, made[0])
    if not isinstance(outer, Function) or made[0] not in outer.body:
        return None
    if not isinstance(scope_of(module, outer), ast.ClassDef):
        return None
    if outer.name == "__init__" and name in [timer.method for timer in raised.source.timers]:
        return None  # (node.callback_in_init)
    at = outer.body.index(made[0])
    if at == 0 or not all(isinstance(s, Function) and has_self(s) for s in outer.body[at:]):
        return None
    last = outer.end_lineno or outer.lineno
    params = {
        "name": name,
        "line": str(made[0].lineno),
        "last": str(last),
        "columns": str(made[0].col_offset - outer.col_offset),
    }
    found = raised.finding("def_inside", at=made[0], params=params)
    return replace(found, words={**found.words, "function": outer.name})


def _dedented(case: Case) -> Files | None:
    """Indent the lines of the def, and of those below it in the same block, less."""
    module, params = case.module, case.finding.params
    if module is None:
        return None
    first, last, columns = (int(params.get(key, 0)) for key in ("line", "last", "columns"))
    rows = [n for n in range(first, last + 1) if module.text.line(n).strip()]
    if any(len(indent_of(module.text.line(n))) < columns for n in rows):
        return None
    starts = [module.text.start_of(n) for n in rows]
    return case.changed(module, *(Splice(at, at + columns, "") for at in starts))


# a value that another part of the file sets


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "def_inside",
        "class",
        msg("A method is inside of another method"),
        msg(
            "def {name} (line {line}) is indented further than def {function}, so it is a part of "
            "{function}, and no method of the class."
        ),
        msg("Delete {columns} spaces at the start of each line from line {line} to line {last}."),
        links.PYTHON_CLASSES,
        raised={OWN_ATTRIBUTE: on_line(_def_inside)},
        fixed_by=(_dedented,),
        examples=(
            example(
                "helper_inside_of_init",
                Replace(
                    NODE,
                    "    def timer_callback",
                    "        def count_one(self):\n            self.counter_ += 1\n\n"
                    "    def timer_callback",
                ),
                Replace(NODE, "        self.counter_ += 1\n\n\n", "        self.count_one()\n\n\n"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
)
