"""Fixes of an except: it hides an error, or lets a loop go on after Ctrl+C."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import SourceText, Splice, indent_of
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource

ENDS = ("KeyboardInterrupt", "ExternalShutdownException", "SystemExit")
"""Exceptions that end a node as it should end."""


def can_go(source: NodeSource, tried: ast.Try) -> bool:
    """Whether a try can be deleted with its except, and all its other lines stay right."""
    if len(tried.handlers) != 1 or tried.orelse or tried.finalbody:
        return False
    return tried.body[0].lineno != tried.lineno and source.function_around(tried) is not source.main


def header(text: SourceText, handler: ast.ExceptHandler) -> str:
    """Return the line of an except up to its colon."""
    start, end = _header(text, handler)
    return text.text[start:end]


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


def narrowed(case: Case) -> Files | None:
    """Let the except of the finding catch only what ends a node as it should end."""
    module = case.module
    found = [
        n
        for n in (module.nodes if module is not None else ())
        if isinstance(n, ast.ExceptHandler) and n.lineno == case.finding.line
    ]
    if module is None or len(found) != 1:
        return None
    start, end = _header(module.text, found[0])
    return case.changed(module, Splice(start, end, narrower(found[0])))


def without_try(case: Case) -> Files | None:
    """Delete the except of the finding and its try, and keep the lines of the try.

    In the entry function the except may be what catches Ctrl+C: it stays there.
    """
    node, module = case.node, case.module
    found = [
        n
        for n in (module.nodes if module is not None else ())
        if isinstance(n, ast.Try) and any(h.lineno == case.finding.line for h in n.handlers)
    ]
    if node is None or module is None or len(found) != 1:
        return None
    (tried,) = found
    first, handler = tried.body[0], tried.handlers[0]
    if not can_go(node, tried):
        return None
    text = module.text
    old, new = indent_of(text.line(first.lineno)), indent_of(text.line(tried.lineno))
    last = handler.end_lineno or handler.lineno
    splices = [text.without(tried.lineno)]
    splices += [text.without(row) for row in range(handler.lineno, last + 1)]
    for row in range(tried.lineno + 1, handler.lineno):
        if text.line(row).strip() and not text.line(row).startswith(old):
            return None
        start = text.start_of(row)
        splices += [Splice(start, start + len(old), new)] if text.line(row).strip() else []
    return case.changed(module, *splices)


def break_in_except(case: Case) -> Files | None:
    """End the loop in the except that catches Ctrl+C."""
    module, line = case.module, case.finding.line
    nodes = module.nodes if module is not None else []
    found = [n for n in nodes if isinstance(n, ast.ExceptHandler) and n.lineno == line]
    if module is None or len(found) != 1 or found[0].body[0].lineno == line:
        return None
    text, last = module.text, found[0].body[-1]
    row = indent_of(text.line(last.lineno)) + "break"
    splices = [text.before((last.end_lineno or last.lineno) + 1, row)]
    if isinstance(last, ast.Continue):
        splices = [text.swap(last, "break")]
    if found[0].type is None:
        at = text.start_of(found[0].lineno) + text.line(found[0].lineno).index("except") + 6
        splices.append(Splice(at, at, " KeyboardInterrupt"))
    return case.changed(module, *splices)
