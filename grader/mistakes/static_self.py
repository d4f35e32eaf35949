"""The mistake of self in a method that @staticmethod or @classmethod gives no object."""

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
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted
from grader.package.source.place import function_at
from grader.package.source.scopes import class_of, has_self

WITHOUT_OBJECT = ("staticmethod", "classmethod")


def _self_in_static(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The method of the line that reads self has a decorator that gives it no object."""
    method = function_at(raised.module, raised.line)
    owner = class_of(raised.module, method)
    if match["name"] != "self" or method is None or owner is None or owner[1] is not method:
        return None
    found = _decorator(method)
    if found is None:
        return _without_parameter(raised, method)
    given = [a.arg for a in method.args.args]
    kept = given[1:] if dotted(found) == "classmethod" else given
    params = {"name": dotted(found), "written": ", ".join(["self", *kept])}
    mistake = raised.finding("static_self", at=found, params=params)
    uses = _through_class(raised.module, owner[0], method)
    words = {**mistake.words, "method": method.name, "type": owner[0].name}
    if uses:
        words["lines"] = ", ".join(map(str, sorted({n.lineno for n in uses})))
    if any(not _knows_self(raised.module, use, owner[0]) for use in uses):
        return replace(mistake, words=words, variant="class_outside")
    return replace(mistake, words=words, variant="class" if uses else "")


def _knows_self(module: Module, use: ast.Attribute, owner: ast.ClassDef) -> bool:
    """Whether a part of the file is in a method of the class that has self."""
    found = class_of(module, function_at(module, use.lineno))
    return found is not None and found[0] is owner and has_self(found[1])


def _without_parameter(raised: Raised, method: Function) -> RecognisedMistake | None:
    """The def has empty brackets, and is called by the name of the class."""
    row, empty = raised.module.line(method.lineno).strip(), f"def {method.name}()"
    if method.decorator_list or empty not in row:
        return None
    written = row.replace(empty, f"def {method.name}(self)", 1)
    found = raised.finding("static_self", at=method, name=method.name, written=written)
    return replace(found, variant="called")


def _decorator(method: Function) -> ast.expr | None:
    found = [d for d in method.decorator_list if dotted(d) in WITHOUT_OBJECT]
    return found[0] if len(found) == 1 else None


def _through_class(module: Module, owner: ast.ClassDef, method: Function) -> list[ast.Attribute]:
    """Return where the method is read from the class, and not from an object."""
    return [
        n
        for n in module.nodes
        if isinstance(n, ast.Attribute)
        and n.attr == method.name
        and dotted(n.value) in (owner.name, "cls")
    ]


def _with_self(case: Case) -> Files | None:
    """Delete the decorator, write self into the head, and read the method from self."""
    module = case.module
    rows = [
        n
        for n in (module.nodes if module is not None else ())
        if isinstance(n, Function)
        and (found := _decorator(n)) is not None
        and found.lineno == case.finding.line
    ]
    method = rows[0] if len(rows) == 1 else None
    owner = class_of(module, method) if module is not None else None
    if module is None or method is None or owner is None or _is_class_method(method):
        return None
    text, uses = module.text, _through_class(module, owner[0], method)
    if not all(_knows_self(module, use, owner[0]) for use in uses):
        return None
    start = text.text.find(f"def {method.name}(", text.start_of(method.lineno))
    if start < 0 or module.line(case.finding.line) != "@staticmethod":
        return None
    at = start + len(f"def {method.name}(")
    first = Splice(at, at, "self, " if method.args.args else "self")
    swaps = [text.swap(use.value, "self") for use in uses]
    return case.changed(module, text.without(case.finding.line or 0), first, *swaps)


def _is_class_method(method: Function) -> bool:
    found = _decorator(method)
    return found is None or dotted(found) != "staticmethod"


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "static_self",
        "class",
        msg("A method without an object uses self"),
        msg(
            "@{name} gives {method} no object of the class, so there is no self in it. In a method "
            "without this decorator, the first parameter gets the object."
        ),
        msg("Delete the line @{name}, and write def {method}({written}):"),
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
            ),
            "class_outside": msg(
                "Delete the line @{name}, and write def {method}({written}): Then write the object "
                "instead of {type} before .{method} (lines: {lines}): self in the methods of the class, and "
                "elsewhere the variable that has the object."
            ),
            "class": msg(
                "Delete the line @{name}, and write def {method}({written}): Then write "
                "self.{method} instead of {type}.{method} (lines: {lines})."
            ),
        },
        raised={NAME_ERROR: _self_in_static},
        fixed_by=(_with_self,),
        examples=(
            example(
                "static_callback_uses_self",
                Replace(
                    NODE,
                    "    def timer_callback(self)",
                    "    @staticmethod\n    def timer_callback()",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "static_callback_of_the_class",
                Replace(
                    NODE,
                    "    def timer_callback(self)",
                    "    @staticmethod\n    def timer_callback()",
                ),
                Replace(NODE, "1.0, self.timer_callback", "1.0, MyFirstNode.timer_callback"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
