"""Fixes of an except: it hides an error, or lets a loop go on after Ctrl+C."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of


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
    if len(tried.handlers) != 1 or tried.orelse or tried.finalbody:
        return None
    if first.lineno == tried.lineno or node.function_around(tried) is node.main:
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
    if found[0].type is None:
        at = text.start_of(found[0].lineno) + text.line(found[0].lineno).index("except") + 6
        splices.append(Splice(at, at, " KeyboardInterrupt"))
    return case.changed(module, *splices)
