"""What to write instead of a print() that is in a function without a self of the node."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.source.module import Function
from grader.package.source.printed import LONGEST, as_log
from grader.package.source.printed_outside import Outside, node_at, outside

FIXES = {
    "of_node": msg("Write {written}.get_logger().info(…) instead of print(…)."),
    "caller": msg(
        "In {name}, self is not the node. Write self.get_logger().info(…) in line {line}, where the "
        "node calls it, instead of {called}."
    ),
    "callers": msg(
        "In {name}, self is not the node. Write self.get_logger().info(…) where the node calls it "
        "(line {line}), instead of these calls."
    ),
    "given": msg(
        "In {name}, self is not the node. Give it the node's logger as an argument, and write "
        "logger.info(…) there instead of print(…)."
    ),
}


def printed_outside(suspect: Suspect, call: ast.Call) -> RecognisedMistake | None:
    """Return what to say of a print() in a function that is no method of the node."""
    source = suspect.source
    found = outside(source, call)
    if found is None:
        return None
    node = node_at(source, call)
    if node:
        return _by_name(suspect, call, node)
    if not found.calls:
        is_function = isinstance(found.function, Function)
        mistake = suspect.finding("print_used", call, name=found.name)
        return replace(mistake, variant="given") if is_function else None
    if len(found.calls) > 1:
        rows = ", ".join(str(each.lineno) for each in found.calls)
        mistake = suspect.finding("print_used", call, name=found.name, line=rows)
        return replace(mistake, variant="callers")
    return _at_caller(suspect, call, found)


def _by_name(suspect: Suspect, call: ast.Call, node: str) -> RecognisedMistake:
    """The function has the node under another name than self."""
    written = as_log(suspect.source, call, node)
    if written is None:
        return replace(suspect.finding("print_used", call, written=node), variant="of_node")
    code = suspect.source.module_of(call).text.code(call)
    mistake = suspect.finding("print_used", call, name=code, written=written)
    return replace(mistake, variant="written")


def _at_caller(suspect: Suspect, call: ast.Call, found: Outside) -> RecognisedMistake:
    """The node's only call of the function is to log instead."""
    caller = found.calls[0]
    text = suspect.source.module_of(caller).text
    code = " ".join(text.code(caller).split())
    plain = not caller.keywords and not any(isinstance(a, ast.Starred) for a in caller.args)
    if plain and 0 <= found.passed < len(caller.args):
        written = f"self.get_logger().info({text.code(caller.args[found.passed])})"
        if len(written) <= LONGEST and code == text.code(caller):
            mistake = suspect.finding("print_used", caller, name=code, written=written)
            return replace(mistake, variant="written")
    mistake = suspect.finding(
        "print_used", call, name=found.name, line=caller.lineno, called=code[:LONGEST]
    )
    return replace(mistake, variant="caller")
