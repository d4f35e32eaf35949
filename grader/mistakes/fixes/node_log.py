"""Fixes of what the node logs."""

from __future__ import annotations

import ast
import re
from difflib import SequenceMatcher

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.source.names import called_name

ALIKE = 0.7


def text(case: Case) -> Files | None:
    """Correct the only string that is nearly the required text before the number."""
    node, wanted = case.node, case.assignment.output.text.partition("{n}")[0]
    if node is None or "'" in wanted or '"' in wanted or not wanted.strip():
        return None
    strings = [n for n in node.own_nodes if isinstance(n, ast.Constant)]
    heads = [(n, _head(node.module_of(n).text.plain_string(n) or "")) for n in strings]
    found = [(n, head) for n, head in heads if _near(head, wanted)]
    if len(found) != 1:
        return None
    (string, head), code = found[0], node.module_of(found[0][0]).text
    old = code.code(string)
    if old.count(head) != 1:
        return None  # (it is written with an escape)
    return case.changed(node.module_of(string), code.swap(string, old.replace(head, wanted)))


def _head(found: str) -> str:
    """Return a text up to its first place for a value."""
    return re.split(r"[{%]", found)[0]


def _near(found: str, wanted: str) -> bool:
    ratio = SequenceMatcher(None, found.lower(), wanted.lower(), autojunk=False).ratio()
    return found != wanted and len(found) <= 2 * len(wanted) and ratio >= ALIKE


def level(case: Case) -> Files | None:
    """Log at level INFO."""
    node = case.node
    call = node.log_call if node else None
    if node is None or call is None or called_name(call) == "info":
        return None
    module = node.module_of(call)
    end = module.text.span(call.func)[1]
    return case.changed(module, Splice(end - len(called_name(call)), end, "info"))
