"""Fixes of a variable that hides the class of the object that it gets."""

from __future__ import annotations

import ast
import builtins
import keyword
import re
from dataclasses import dataclass

from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.uses import places_of
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.source.counter import targets_of
from grader.package.source.module import Function, Module
from grader.package.source.place import function_at

VARIABLES = ("node", "my_node")
"""Names for the variable of a node; the first one that the file does not use is proposed."""


@dataclass(frozen=True)
class Hidden:
    """A class, and the statement `name = name()` of a function that hides it."""

    made_by: ast.ClassDef
    made: ast.Assign
    call: ast.Call
    function: Function


def hidden_class(module: Module, line: int | None, name: str) -> Hidden | None:
    """Return the class of the file whose name the statement on a line gives to a variable."""
    classes = [c for c in module.tree.body if isinstance(c, ast.ClassDef) and c.name == name]
    function = function_at(module, line)
    for made in ast.walk(function) if function is not None else ():
        value = made.value if isinstance(made, ast.Assign) else None
        if not isinstance(made, ast.Assign) or name not in targets_of(made):
            continue
        calls = isinstance(value, ast.Call) and isinstance(value.func, ast.Name)
        if function is None or not calls or len(classes) != 1 or made.lineno != line:
            continue
        if isinstance(value, ast.Call) and getattr(value.func, "id", "") == name:
            return Hidden(classes[0], made, value, function)
    return None


def capital_name(module: Module, name: str, *others: str) -> str:
    """Return a name in capital letters for a class; "" if its own name has them already."""
    if name[:1].isupper():
        return ""
    taken = {*module.names, *dir(builtins)}
    known = [_joined(written) for written in (name, *others)]
    tries = [*known, f"My{known[0]}", f"My{known[0]}Class"]
    return next((t for t in tries if t.isidentifier() and t not in taken), "")


def _joined(name: str) -> str:
    return "".join(part[:1].upper() + part[1:] for part in re.split(r"[_\W]+", name))


def free_variable(module: Module, name: str) -> str:
    """Return a name for a variable that the file does not use yet; "" if there is none."""
    small = "_".join(re.findall(r"[A-Z]+[a-z0-9]*|[a-z0-9]+", name)).lower()
    tries = [*VARIABLES, small]
    taken = {*module.names, *keyword.kwlist}
    return next((t for t in tries if t.isidentifier() and t not in taken), "")


def other_uses(module: Module, hidden: Hidden) -> list[ast.AST]:
    """Return what else of the file means the class: not the function whose variable hides it."""
    around = [hidden.function, *(f for f in module.around(hidden.function) if _is_function(f))]
    left_out = set(ast.walk(around[-1]))
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == hidden.made_by.name]
    return [n for n in uses if n not in left_out]


def _is_function(node: ast.AST) -> bool:
    return isinstance(node, Function)


def apart(case: Case) -> Files | None:
    """Give the class, or else the variable, the name that the finding gives."""
    module, params = case.module, case.finding.params
    name, new = str(params.get("name", "")), str(params.get("written", ""))
    found = hidden_class(module, case.finding.line, name) if module is not None else None
    if module is None or found is None or not new.isidentifier() or new in module.names:
        return None
    if new[:1].isupper():
        return _class_renamed(case, module, found, new)
    places = places_of(module, [found.function], name)
    made = module.text.span(found.call.func)[0]
    if places is None or made not in places or _declared(found.function, name):
        return None
    splices = [Splice(at, at + len(name), new) for at in places if at != made]
    return case.changed(module, *splices)


def _declared(function: Function, name: str) -> bool:
    words = [n for n in ast.walk(function) if isinstance(n, ast.Global | ast.Nonlocal)]
    return any(name in word.names for word in words)


def _class_renamed(case: Case, module: Module, found: Hidden, new: str) -> Files | None:
    name = found.made_by.name
    row = module.text.line(found.made_by.lineno)
    head = re.match(rf"\s*class\s+(?={re.escape(name)}\b)", row)
    uses = other_uses(module, found)
    others = [n for n in uses if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Load)]
    places = places_of(module, [*others, found.call.func], name)
    if head is None or places is None or len(others) != len(uses):
        return None
    start = module.text.start_of(found.made_by.lineno) + head.end()
    splices = [Splice(at, at + len(name), new) for at in (start, *places)]
    return case.changed(module, *splices)
