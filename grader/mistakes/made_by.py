"""Texts about the lines of a file that make or change the value that a log call shows."""

from __future__ import annotations

import ast

from grader.base.i18n.message import Message, joined, say
from grader.base.shown import shown
from grader.package.source.counter import parts_of_callback
from grader.package.source.node import NodeSource
from grader.package.source.traced import traced
from grader.report.model import Where

MOST_LINES = 6


def lines_that_make(
    source: NodeSource, where: Where | None, *, only_texts: bool = False
) -> Message | None:
    """Return the lines, with their code, that make or change what is logged at a place.

    If no log call is there, that of the callback is looked at. None if there is none, if no such
    line is known, or if they are too many for a text. With `only_texts`, those without a piece of
    text are left out.
    """
    statements = statements_that_make(source, where)
    if only_texts:
        statements = [n for n in statements if any(map(_is_text, ast.walk(n)))]
    places = list(dict.fromkeys((source.module_of(n), n.lineno) for n in statements))
    if not 0 < len(places) <= MOST_LINES:
        return None
    several = len({module.path for module, _ in places}) > 1
    texts = []
    for module, line in places:
        code = shown(module.line(line))
        text = say("line {line}: {code}", line=line, code=code)
        if several:
            text = say("{path}, line {line}: {code}", path=module.path, line=line, code=code)
        texts.append(text)
    return joined(*texts, by="; ")


def statements_that_make(source: NodeSource, where: Where | None) -> list[ast.stmt]:
    """Return the statements that make or change what is logged at a place, or by the callback."""
    calls = [call for part in parts_of_callback(source) for call in source.logs(part)]
    if where is not None and where.line:
        module = source.module_at(where.file)
        there = [call for call in source.logs(module.tree) if call.lineno == where.line]
        calls = there or calls
    return traced(source, calls[0]) if calls else []


def _is_text(node: ast.AST) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str)
