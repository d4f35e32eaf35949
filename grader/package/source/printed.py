"""The call of the logger that a call of print() stands for."""

from __future__ import annotations

import ast

from grader.package.source.node import NodeSource

LONGEST = 80  # characters of a piece of code that a text shows
QUIET = ("flush", "file")  # arguments of print that the logger does not need


def as_log(source: NodeSource, call: ast.Call) -> str | None:
    """Return the call of the logger with the same text, in a method of the node.

    None if it is long, or if it is not certain which text print() writes.
    """
    code = source.module_of(call).text.code
    text, logger = _text_of(call, code(call), list(map(code, call.args))), _logger_at(source, call)
    written = f"{logger}.info({text})"
    return written if text and logger and len(written) <= LONGEST else None


def _logger_at(source: NodeSource, call: ast.Call) -> str:
    """Return how the node's logger is called at a place; "" if the place has no self."""
    kept = source.loggers_at(call)
    around = source.function_around(call)
    own = around is not None and around in source.own_methods
    first = around.args.args[:1] if around is not None else []
    here = own and [a.arg for a in first] == ["self"]
    return kept[0] if kept else f"{source.held_node or 'self'}.get_logger()" if here else ""


def _text_of(call: ast.Call, code: str, given: list[str]) -> str:
    """Return the only value of print(), or an f-string of several; "" if it is not certain."""
    others = [k for k in call.keywords if k.arg not in QUIET]
    if others or not given or "\n" in code or any(isinstance(a, ast.Starred) for a in call.args):
        return ""
    if len(given) == 1:
        plain = isinstance(call.args[0], ast.Constant) and not isinstance(call.args[0].value, str)
        return "" if plain else given[0]
    parts = []
    for value, written in zip(call.args, given):
        is_text = isinstance(value, ast.Constant) and isinstance(value.value, str)
        part = str(value.value) if isinstance(value, ast.Constant) and is_text else written
        if set(part) & set("'\"{}\\!:=" if not is_text else "'{}\\") or not part.isprintable():
            return ""
        parts.append(part if is_text else f"{{{part}}}")
    return f"f'{' '.join(parts)}'"
