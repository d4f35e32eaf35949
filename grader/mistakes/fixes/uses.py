"""The places in the text at which a piece of code reads or sets a variable."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable

from grader.package.source.module import Module

FIELD = re.compile(r"\{\{|\}\}|\{([^{}]*)")
"""In an f-string: a shown brace, or an opening one and the code after it."""


def places_of(module: Module, parts: Iterable[ast.AST], name: str) -> list[int] | None:
    """Return the offsets of a variable in parts of a file; None if one is not found for certain.

    Before Python 3.12 the parser does not know the places of what is in an f-string.
    """
    used = {
        n
        for part in parts
        for n in ast.walk(part)
        if isinstance(n, ast.Name) and n.id == name and module.has(n)
    }
    places: set[int] = set()
    texts: dict[ast.JoinedStr, int] = {}
    for use in used:
        around = [a for a in module.around(use) if isinstance(a, ast.JoinedStr)]
        if around:
            texts[around[-1]] = texts.get(around[-1], 0) + 1
        elif module.text.code(use) == name:
            places.add(module.text.span(use)[0])
        else:
            return None
    for text, count in texts.items():
        found = _in_text(module, text, name)
        if len(found) != count:
            return None
        places |= set(found)
    return sorted(places)


def _in_text(module: Module, text: ast.JoinedStr, name: str) -> list[int]:
    """Return the offsets of a variable in the braces of an f-string."""
    start, code = module.text.span(text)[0], module.text.code(text)
    pattern = re.compile(rf"(?<![\w.'\"]){re.escape(name)}(?![\w'\"])")
    return [
        start + field.start(1) + use.start()
        for field in FIELD.finditer(code)
        if field[1]
        for use in pattern.finditer(field[1])
    ]
