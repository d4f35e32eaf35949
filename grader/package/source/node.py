"""The class, timers, callbacks, log lines and functions in a node's source.

Read from the syntax tree (the file is never run); a file that Python cannot read has no facts.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from grader.package.source.python import PythonFault, PythonFile, parse_python

LOG_METHODS = ("debug", "info", "warn", "warning", "error", "fatal")
LONGEST_NAME = 20  # names, dots and calls; longer ones are ignored
MOST_BYTES = 20_000
"""A larger file is not a first node, and a hostile one would take seconds to analyse."""
Function = ast.FunctionDef | ast.AsyncFunctionDef


def dotted(named: ast.AST) -> str:
    """Return a name as written: `rclpy.spin`, `self.get_logger().info`; "" for anything else."""
    node: ast.AST = named
    after = ""
    for _ in range(LONGEST_NAME):
        if isinstance(node, ast.Name):
            return node.id + after
        if isinstance(node, ast.Attribute):
            after = f".{node.attr}{after}"
            node = node.value
        elif isinstance(node, ast.Call):
            after = f"(){after}"
            node = node.func
        else:
            break
    return ""


def calls_in(node: ast.AST) -> Iterator[tuple[ast.Call, str]]:
    """Yield every call in a part of the source, in order, with the called name."""
    for found in sorted(
        (n for n in ast.walk(node) if isinstance(n, ast.Call)),
        key=lambda n: (n.lineno, n.col_offset),
    ):
        yield found, dotted(found.func)


def is_log(name: str) -> bool:
    """Return whether a call of that name logs a line."""
    before, _, method = name.rpartition(".")
    return method in LOG_METHODS and ("log" in before.lower() or before.endswith("get_logger()"))


@dataclass(frozen=True)
class Timer:
    """A call of create_timer: its arguments, and the function that contains it."""

    call: ast.Call
    period: ast.expr | None
    callback: ast.expr | None
    function: Function | None

    @property
    def line(self) -> int:
        """The line of the call."""
        return self.call.lineno

    @property
    def method(self) -> str:
        """The name of the callback; "" if it has none."""
        given = self.callback.func if isinstance(self.callback, ast.Call) else self.callback
        return dotted(given).rpartition(".")[2] if given is not None else ""

    @property
    def called(self) -> bool:
        """Whether the callback is called instead of passed by name."""
        called = isinstance(self.callback, ast.Call) and dotted(self.callback)
        return bool(called) and not str(called).endswith("partial()")

    @property
    def seconds(self) -> float | None:
        """The period, if it is written as a number."""
        if isinstance(self.period, ast.Constant) and isinstance(self.period.value, int | float):
            return float(self.period.value)
        return None


class NodeSource:
    """The facts of one file."""

    def __init__(self, file: PythonFile) -> None:
        self.tree = file.tree
        self.lines = file.text.splitlines()

    def line(self, number: int | None) -> str:
        """Return a line of the file without its indentation; "" if there is none."""
        if number is None or not 1 <= number <= len(self.lines):
            return ""
        return self.lines[number - 1].strip()

    @cached_property
    def calls(self) -> list[tuple[ast.Call, str]]:
        """All calls of the file."""
        return list(calls_in(self.tree))

    @cached_property
    def classes(self) -> list[ast.ClassDef]:
        """All classes of the file."""
        return [node for node in ast.walk(self.tree) if isinstance(node, ast.ClassDef)]

    @cached_property
    def node_class(self) -> ast.ClassDef | None:
        """The class that is the node, or was meant to be."""
        for found in self.classes:
            if any(dotted(base).rpartition(".")[2].endswith("Node") for base in found.bases):
                return found
        return self.classes[0] if self.classes else None

    @cached_property
    def methods(self) -> dict[str, Function]:
        """The node's own methods."""
        body = self.node_class.body if self.node_class else []
        return {node.name: node for node in body if isinstance(node, Function)}

    @cached_property
    def functions(self) -> dict[str, Function]:
        """The functions at module level."""
        return {node.name: node for node in self.tree.body if isinstance(node, Function)}

    @cached_property
    def parents(self) -> dict[ast.AST, ast.AST]:
        """The parent of each node of the tree."""
        return {child: node for node in ast.walk(self.tree) for child in ast.iter_child_nodes(node)}

    def function_around(self, node: ast.AST) -> Function | None:
        """Return the innermost function that contains a part of the source."""
        around = self.parents.get(node)
        while around is not None and not isinstance(around, Function):
            around = self.parents.get(around)
        return around

    @cached_property
    def timers(self) -> list[Timer]:
        """The calls of create_timer."""
        found = []
        for call, name in self.calls:
            if name.rpartition(".")[2] == "create_timer":
                given = {keyword.arg: keyword.value for keyword in call.keywords}
                period, callback = (*call.args[:2], None, None)[:2]
                found.append(
                    Timer(
                        call,
                        period or given.get("timer_period_sec"),
                        callback or given.get("callback"),
                        self.function_around(call),
                    )
                )
        return found

    @cached_property
    def callback(self) -> Function | None:
        """The method that the first timer calls, else the one that logs."""
        for timer in self.timers:
            if timer.method in self.methods:
                return self.methods[timer.method]
        logging = [m for n, m in self.methods.items() if n != "__init__" and self.logs(m)]
        return logging[0] if logging else None

    def logs(self, part: ast.AST) -> list[ast.Call]:
        """Return the calls of a logger in a part of the source."""
        return [call for call, name in calls_in(part) if is_log(name)]

    def prints(self, part: ast.AST) -> list[ast.Call]:
        """Return the calls of print in a part of the source."""
        return [call for call, name in calls_in(part) if name == "print"]

    @cached_property
    def super_init(self) -> ast.Call | None:
        """The call of the base class's __init__ in the node's __init__."""
        init = self.methods.get("__init__")
        for call, name in calls_in(init) if init else ():
            if name == "super().__init__" or (name.endswith("Node.__init__")):
                return call
        return None

    @cached_property
    def imports(self) -> set[str]:
        """The names that imports bind, and the modules that they name."""
        names: set[str] = set()
        for node in ast.walk(self.tree):
            if isinstance(node, ast.Import | ast.ImportFrom):
                module = getattr(node, "module", None)
                names |= {module} if module else set()
                names |= {alias.asname or alias.name for alias in node.names}
        return names

    def imports_of(self, package: str) -> bool:
        """Return whether the file imports modules of its own package."""
        for node in ast.walk(self.tree):
            if isinstance(node, ast.ImportFrom):
                named = [package if node.level else str(node.module)]
            else:
                named = [a.name for a in node.names] if isinstance(node, ast.Import) else []
            if any(name.partition(".")[0] == package for name in named):
                return True
        return False

    @property
    def uses_ros(self) -> bool:
        """Whether the file imports rclpy."""
        return any(name.partition(".")[0] == "rclpy" for name in self.imports)

    @cached_property
    def attributes(self) -> set[str]:
        """The names that are set on self."""
        return {
            node.attr
            for node in ast.walk(self.tree)
            if isinstance(node, ast.Attribute)
            and isinstance(node.ctx, ast.Store)
            and dotted(node.value) == "self"
        }

    @cached_property
    def names(self) -> set[str]:
        """Every name that the file binds or defines."""
        stored = {
            node.id
            for node in ast.walk(self.tree)
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
        }
        made = {n.name for n in ast.walk(self.tree) if isinstance(n, Function | ast.ClassDef)}
        arguments = {node.arg for node in ast.walk(self.tree) if isinstance(node, ast.arg)}
        return stored | made | arguments | self.imports

    def makes_node(self) -> bool:
        """Return whether the node's class is called anywhere in the file."""
        name = self.node_class.name if self.node_class else ""
        return any(called == name for _, called in self.calls)


def read_node(found: bytes) -> NodeSource | None:
    """Return the facts of a file; None if Python cannot read it, or if it is too large."""
    if len(found) > MOST_BYTES:
        return None
    try:
        return NodeSource(parse_python(found))
    except (PythonFault, RecursionError, MemoryError):
        return None
