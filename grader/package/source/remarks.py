"""What in a package's source a person should look at, and what asks for a closer observation.

A node may end, or stop to count, by itself; it may hide what it does, or make log records itself. All
have honest uses: nothing here costs points. A node that could end is watched for longer. (What could
tell it that it is marked is in telling.py.)
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

from grader.package.intake.model import SourceFile
from grader.package.source.kept import keep_small
from grader.package.source.module import Module, parse_module
from grader.package.source.names import calls_in, last_part
from grader.package.source.python import PythonFault

Kind = Literal["asks", "ends", "hides", "rosout"]
MOST_REMARKS = 8  # of one kind
MOST_BYTES = 60_000
"""Of a file that is read; a larger one cannot be looked through, which is a remark itself."""

ROSOUT = re.compile(r"rosout")
ENDS_ANYWHERE = {
    "_exit",
    "abort",
    "kill",
    "killpg",
    "alarm",
    "setitimer",
    "raise_signal",
    "Timer",
    "Thread",
    "Process",
    "Popen",
    "fork",
    "system",
    "dump_traceback_later",
    "execv",
    "execve",
}
ENDS_IN_A_CLASS = {
    "exit",
    "quit",
    "shutdown",
    "try_shutdown",
    "cancel",
    "destroy_timer",
    "destroy_node",
    "destroy_publisher",
    "monotonic",
    "time",
    "perf_counter",
}
HIDES = {"exec", "eval", "__import__", "import_module", "CDLL", "PyDLL", "loads"}
COMPILED = (".so", ".pyc", ".pyd", ".pyo")
NOT_THE_NODE = re.compile(r"(^|/)(setup\.py|test/.*|tests/.*|launch/.*|conftest\.py)$")


@dataclass(frozen=True)
class Remark:
    """A place in the source; `what` is the name or the text that was found there."""

    kind: Kind
    path: str
    line: int | None
    what: str


def remarks_on(files: Sequence[SourceFile]) -> list[Remark]:
    """Return the remarks on a package's files, at most MOST_REMARKS of each kind."""
    found: list[Remark] = []
    for file in files:
        if file.kind != "file" or NOT_THE_NODE.search(file.path):
            continue
        if file.path.endswith(COMPILED):
            found.append(Remark("hides", file.path, None, file.path.rpartition(".")[2]))
        elif file.path.endswith(".py"):
            found += _in_file(file.path, file.data)
    kept: list[Remark] = []
    for remark in dict.fromkeys(found):
        if sum(other.kind == remark.kind for other in kept) < MOST_REMARKS:
            kept.append(remark)
    return kept


@keep_small
def _in_file(path: str, found: bytes) -> tuple[Remark, ...]:
    """Return the remarks on one file; the session, a check and the report ask for them."""
    if len(found) > MOST_BYTES:
        return (Remark("hides", path, None, f"{len(found)} bytes"),)
    try:
        module = parse_module(path, found)
    except PythonFault:
        return ()
    return (*_texts(module), *_calls(module))


def _texts(module: Module) -> Iterator[Remark]:
    for node in module.nodes:
        if not isinstance(node, ast.Constant) or not isinstance(node.value, str):
            continue
        if isinstance(module.parents.get(node), ast.Expr):
            continue  # a docstring
        if ROSOUT.search(node.value):
            yield Remark("rosout", module.path, node.lineno, node.value[:60])
    for node in module.nodes:
        if isinstance(node, ast.keyword) and node.arg == "enable_rosout":
            yield Remark("rosout", module.path, node.value.lineno, "enable_rosout")


def _calls(module: Module) -> Iterator[Remark]:
    for call, name in calls_in(module.tree):
        last = last_part(name)
        if name == "compile" or last in HIDES or (last == "getattr" and _is_made_up(call)):
            yield Remark("hides", module.path, call.lineno, name)
        if last in ENDS_ANYWHERE or (last in ENDS_IN_A_CLASS and _is_in_a_class(module, call)):
            yield Remark("ends", module.path, call.lineno, name)
    for node in module.nodes:
        if isinstance(node, ast.Raise) and _is_in_a_class(module, node):
            yield Remark("ends", module.path, node.lineno, "raise")


def _is_made_up(call: ast.Call) -> bool:
    """Whether the name that getattr gets is not written in the source as it is."""
    return len(call.args) > 1 and not isinstance(call.args[1], ast.Constant)


def _is_in_a_class(module: Module, node: ast.AST) -> bool:
    return any(isinstance(outer, ast.ClassDef) for outer in module.around(node))
