"""The parameters of a method: those that a caller must give, and its def without them."""

from __future__ import annotations

import ast
import re

from grader.package.edit.text import SourceText, Splice
from grader.package.source.code_only import code_only
from grader.package.source.module import Function

OPEN, CLOSE = "([{", ")]}"


def only_self(text: SourceText, method: Function) -> Splice | None:
    """Return the change after which a method needs nothing but self; None if it is not simple."""
    arguments = method.args
    if arguments.posonlyargs or None in arguments.kw_defaults:
        return None
    if not arguments.args:
        open_at = code_only(text.text).find("(", text.span(method)[0])
        empty = not arguments.vararg and not arguments.kwonlyargs and not arguments.kwarg
        return Splice(open_at + 1, open_at + 1, "self") if empty and open_at >= 0 else None
    needed = needed_besides_self(method)
    if not needed:
        return None
    return Splice(text.span(arguments.args[0])[1], text.span(needed[-1])[1], "")


def needed_besides_self(method: Function) -> list[ast.arg]:
    """Return the parameters after self that have no default."""
    arguments = method.args
    return arguments.args[1 : len(arguments.args) - len(arguments.defaults)]


def uses_of(method: Function, names: set[str]) -> list[ast.Name]:
    """Return where the body uses the values of parameters; not after it assigns to them first."""
    for statement in method.body:
        found = [n for n in ast.walk(statement) if isinstance(n, ast.Name) and n.id in names]
        if isinstance(statement, ast.Assign) and all(n in statement.targets for n in found):
            names = names - {n.id for n in found}
        elif found:
            return [
                n
                for s in method.body
                for n in ast.walk(s)
                if isinstance(n, ast.Name) and n.id in names
            ]
    return []


def def_after(text: SourceText, method: Function, change: Splice, *, has_body: bool = True) -> str:
    """Return the line of a def after a change of its parameters, with a body on the same line.

    Without the body, … stands for it.
    """
    start = text.span(method)[0]
    code = code_only(text.text)
    at, depth = start, 0
    while at < len(code) and (depth or code[at] != ":"):
        depth += (code[at] in OPEN) - (code[at] in CLOSE)
        at += 1
    end = at + 1
    if not re.search(r"[\r\n]", code[at : text.span(method.body[0])[0]]):
        first = method.body[0].lineno
        end = text.start_of(first) + len(code[text.start_of(first) : text.end_of(first)].rstrip())
    ending = ""
    if end > at + 1 and not has_body:
        end, ending = at + 1, " …"
    row = text.text[start : change.start] + change.new + text.text[change.end : end]
    return re.sub(r"[ \t]*[\r\n]+[ \t]*", " ", row) + ending
