"""The slip of a `from __future__` import that is not the first statement of the file."""

from __future__ import annotations

import ast

from grader.package.edit.text import Splice
from grader.package.source.broken_python import Broken, Slip

LATE = "from __future__ imports must occur at the beginning"


def _late(text: Broken) -> Slip | None:
    """Return the import, and the line above which it belongs."""
    if LATE not in text.fault.text:
        return None
    written = text.source.line(text.number)
    code = written.strip()
    found = Slip("signs", "future_late", text.number, code, code)
    first = _first_line(text)
    alone = code.startswith("from") and written == code and not code.endswith(("(", "\\"))
    if first is None or not alone or first >= text.number:
        return found
    start = text.source.start_of(first)
    new = text.source.spliced(
        [Splice(start, start, code + text.source.newline), text.source.without(text.number)]
    )
    return Slip("signs", "future_late", text.number, code, code, new, first)


def _first_line(text: Broken) -> int | None:
    """Return the line of the first statement that is not the docstring of the file."""
    try:
        body = ast.parse(text.source.text).body
    except (SyntaxError, ValueError, RecursionError):
        return None
    for statement in body:
        value = statement.value if isinstance(statement, ast.Expr) else None
        if not isinstance(value, ast.Constant) or not isinstance(value.value, str):
            return statement.lineno
    return None


FUTURE_LOOKS = (_late,)
