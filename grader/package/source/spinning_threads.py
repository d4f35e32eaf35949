"""Threads of Python that spin a node: `Thread(target=rclpy.spin, args=(node,))` and its forms."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.package.source.module import Function
from grader.package.source.names import SPINS, calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.threads import argument, is_daemon, variables_of


@dataclass(frozen=True)
class SpinningThread:
    """A call of Thread, and what it runs: spin itself, or a function or a lambda that spins."""

    call: ast.Call
    target: ast.expr
    function: Function | None
    daemon: bool

    @property
    def parts(self) -> set[ast.AST]:
        """The parts of the source that the thread runs."""
        return {part for whole in (self.function, self.target) if whole for part in ast.walk(whole)}

    @property
    def given(self) -> str:
        """The name of the only thing that is passed to what the thread runs; "" if unknown."""
        if isinstance(self.target, ast.Lambda):
            spins = [c for c, name in calls_in(self.target) if last_part(name) in SPINS]
            return dotted(spins[0].args[0]) if spins and spins[0].args else ""
        given = argument(self.call, "args")
        alone = isinstance(given, ast.Tuple | ast.List) and len(given.elts) == 1
        return dotted(given.elts[0]) if alone and isinstance(given, ast.Tuple | ast.List) else ""

    def written(self, source: NodeSource) -> str:
        """Return the call that does without a thread what it does; "" if it is unknown."""
        code, given = source.module_of(self.call).text.code, argument(self.call, "args")
        if isinstance(self.target, ast.Lambda):
            return " ".join(code(self.target.body).split())
        if any(word.arg == "kwargs" for word in self.call.keywords):
            return ""
        if given is not None and not isinstance(given, ast.Tuple | ast.List):
            return ""
        if isinstance(self.target, ast.Call):
            return ""
        return f"{dotted(self.target)}({', '.join(map(code, given.elts if given else ()))})"


def spinning_threads(source: NodeSource) -> list[SpinningThread]:
    """Return the threads that spin a node."""
    found: list[SpinningThread] = []
    if not any(name.endswith("start") for _, name in source.calls):
        return found  # (no thread is started)
    for call in source.calls_of("Thread"):
        target = argument(call, "target")
        if target is None:
            continue
        function = function_named(source, target)
        if _spins(target) or (function is not None and _calls_spin(function)):
            found.append(SpinningThread(call, target, function, is_daemon(source, call)))
    return found


def lines_of(source: NodeSource, thread: ast.Call) -> set[int]:
    """Return the line that makes a thread, and the others that use its variable."""
    names = variables_of(source, thread)
    function = source.function_around(thread) or source.module_of(thread).tree
    uses = [n for n in ast.walk(function) if isinstance(n, ast.expr) and dotted(n) in names]
    return {thread.lineno, *(use.lineno for use in uses)}


def function_named(source: NodeSource, target: ast.expr) -> Function | None:
    """Return the only function or method of the files that a thread runs."""
    name = last_part(dotted(target))
    named = [n for n in source.all_nodes if isinstance(n, Function) and n.name == name]
    return named[0] if len(named) == 1 else None


def _spins(target: ast.expr) -> bool:
    if isinstance(target, ast.Lambda):
        return _calls_spin(target)
    if isinstance(target, ast.Call) and last_part(dotted(target.func)) == "partial":
        return bool(target.args) and _spins(target.args[0])
    return last_part(dotted(target)) in SPINS


def _calls_spin(part: ast.AST) -> bool:
    return any(last_part(name) in SPINS for _, name in calls_in(part))
