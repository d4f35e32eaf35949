"""Fixes of the counter."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.source.counter import (
    declares,
    logged_counter,
    outer_word,
    starts_of,
    targets_of,
)
from grader.package.source.place import statement_of


def step(case: Case) -> Files | None:
    """Increment the counter below the line that logs it."""
    node, name = case.node, str(case.finding.params.get("name", ""))
    logged = logged_counter(node) if node is not None else None
    if node is None or logged is None or logged[1] != name:
        return None
    module = node.module_of(logged[0])
    line = statement_of(module, logged[0])
    row = f"{indent_of(module.text.line(line.lineno))}{name} += {case.assignment.output.step}"
    return case.changed(module, module.text.before((line.end_lineno or line.lineno) + 1, row))


def self_dot(case: Case) -> Files | None:
    """Put the missing self. before the counter."""
    node = case.node
    starts = starts_of(node) if node else {}
    own = {name.removeprefix("self.") for name in starts if name.startswith("self.")}
    if node is None or not own:
        return None
    bound = {a.arg for n in node.own_nodes if isinstance(n, ast.arguments) for a in n.args}
    splices = []
    for method in node.own_methods:
        for part in ast.walk(method):
            if isinstance(part, ast.Name) and part.id in own and part.id not in bound:
                has_self = [a.arg for a in method.args.args[:1]] == ["self"]
                if method.name == "__init__" or node.module.text.code(part) != part.id:
                    return None
                if not has_self:
                    return None
                at = node.module.text.span(part)[0]
                splices.append(Splice(at, at, "self."))
    return case.changed(node.module, *splices)


def outer(case: Case) -> Files | None:
    """Declare a variable of outside in the callback that adds to it."""
    node = case.node
    callback = node.callback if node else None
    name = str(case.finding.params.get("name", ""))
    if node is None or callback is None or name in node.attributes or declares(callback, name):
        return None
    word, module = outer_word(node, callback, name), node.module_of(callback)
    if not word or not any(name in targets_of(part) for part in ast.walk(callback)):
        return None
    first = callback.body[0]
    documented = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant)
    line = (first.end_lineno or first.lineno) + 1 if documented else first.lineno
    indent = indent_of(module.text.line(first.lineno))
    return case.changed(module, module.text.before(line, f"{indent}{word} {name}"))
