"""Fixes of an except: it hides an error, or lets a loop go on after Ctrl+C."""

from __future__ import annotations

import ast

from grader.package.edit.text import SourceText, indent_of
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource

ENDS = ("KeyboardInterrupt", "ExternalShutdownException", "SystemExit")
"""Exceptions that end a node as it should end."""


def can_go(source: NodeSource, tried: ast.Try) -> bool:
    """Whether a try can be deleted with its except, and all its other lines stay right."""
    if len(tried.handlers) != 1 or tried.orelse or tried.finalbody:
        return False
    return tried.body[0].lineno != tried.lineno and source.function_around(tried) is not source.main


def _header(text: SourceText, handler: ast.ExceptHandler) -> tuple[int, int]:
    start = text.start_of(handler.lineno) + len(indent_of(text.line(handler.lineno)))
    after = text.span(handler.type)[1] if handler.type is not None else start
    return start, text.text.index(":", after) + 1


def narrower(handler: ast.ExceptHandler) -> str:
    """Return an except that catches only what ends a node as it should end."""
    caught = handler.type.elts if isinstance(handler.type, ast.Tuple) else [handler.type]
    names = [dotted(part) for part in caught if part is not None]
    kept = [name for name in names if last_part(name) in ENDS]
    if "KeyboardInterrupt" not in kept:
        kept.insert(0, "KeyboardInterrupt")
    return f"except {kept[0]}:" if len(kept) == 1 else f"except ({', '.join(kept)}):"
