"""Lines of a node that clear the terminal, or go back on it over what was written."""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass

from grader.package.source.module import Function
from grader.package.source.names import called_name, calls_in, last_part
from grader.package.source.node import NodeSource

PROGRAM = re.compile(r"(?:^|[;&|])\s*(?:clear|cls|reset|tput)\b")
STARTS = ("os.system", "os.popen", "system", "popen", "run", "call", "check_call", "Popen")
ALONE = ast.Expr | ast.Assign
WRITES = ("print", "write")
COLOUR = re.compile(r"\x1b\[[0-9;:]{0,40}m")
CONTROL = re.compile(r"\x1b\[[0-9;?]{0,20}[A-HJKSTfhlsu]|\x1b[c78M]|[\r\b\f]")
LONGEST = 200  # characters of a text that is looked at


@dataclass(frozen=True)
class Clearing:
    """A statement that clears, and the function that it is in; `only` if it does nothing else."""

    statement: ast.Expr | ast.Assign
    function: Function
    only: bool


def clearing(source: NodeSource) -> list[Clearing]:
    """Return the statements that clear in the callback and in the functions that it may call."""
    left_out = (source.main, source.methods.get("__init__"))
    found: list[Clearing] = []
    for call, name in source.calls:
        function = source.function_around(call)
        around = source.module_of(call).around(call)
        statement = next((part for part in around if isinstance(part, ast.stmt)), None)
        if function is None or function in left_out or not isinstance(statement, ALONE):
            continue
        if _starts_clear(call, name):
            found.append(Clearing(statement, function, only=True))
        elif _writes_control(call, name):
            found.append(Clearing(statement, function, only=not _has_text(call)))
    return sorted(found, key=lambda each: not each.only)


def _starts_clear(call: ast.Call, name: str) -> bool:
    """Whether a call starts a program that clears the terminal."""
    if not name.startswith(("os.", "subprocess.")) and name not in STARTS:
        return False
    if last_part(name) not in {last_part(each) for each in STARTS} or not call.args:
        return False
    texts = (str(n.value) for n in ast.walk(call.args[0]) if isinstance(n, ast.Constant))
    return any(PROGRAM.search(text[:LONGEST]) for text in texts)


def _texts(call: ast.Call) -> list[str]:
    return [
        n.value[:LONGEST]
        for part in (*call.args, *(keyword.value for keyword in call.keywords))
        for n in ast.walk(part)
        if isinstance(n, ast.Constant) and isinstance(n.value, str)
    ]


def _writes_control(call: ast.Call, name: str) -> bool:
    """Whether a call writes a text that moves on the terminal, or erases what is on it."""
    writes = last_part(name) in WRITES and (name == "print" or "std" in name)
    return writes and any(CONTROL.search(COLOUR.sub("", text)) for text in _texts(call))


def _has_text(call: ast.Call) -> bool:
    """Whether a call writes something else too."""
    rest = "".join(COLOUR.sub("", CONTROL.sub("", text)) for text in _texts(call))
    named = [n for part in call.args for n in ast.walk(part) if isinstance(n, ast.Name)]
    return bool(rest.strip()) or bool(named)


def calls_of_function(source: NodeSource, function: Function) -> list[ast.Expr]:
    """Return the statements of the callback that only call a function."""
    callback = source.callback
    found: list[ast.Expr] = []
    for call, _ in calls_in(callback) if callback is not None else ():
        statement = source.module_of(call).parents.get(call)
        if called_name(call) == function.name and isinstance(statement, ast.Expr):
            found.append(statement)
    return found
