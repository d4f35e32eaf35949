"""What a node did in one followed run, and which of its lines are near to what a check asks for."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from functools import cached_property

from grader.base.i18n.message import Value
from grader.base.shown import shown
from grader.course.assignment import CheckUse
from grader.explain.parts import read_in, rows_of
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted
from grader.package.source.node import NodeSource
from grader.package.source.place import statement_at
from grader.run.run import Run
from grader.run.variants import Place, Trace, TracedDone

Answer = tuple[Place, Mapping[str, Value]]
"""Where it is, and the values of the text's places."""
DOERS = {"published": ("publish",), "asked": ("call_async", "call")}
LOGS = ("info", "warn", "warning", "error")
MOST_STEPS = 4  # from a value to where it was made
ELSEWHERE = 3
LEAST_TRIES = 2  # of a condition, before it counts as one that is always the same
LEAVES = ast.Return | ast.Continue | ast.Break | ast.Pass


class Ran:
    """What a node did in a run in which a check failed: `use` is that of the check.

    `field` is the field of a message or a request that has another value (`came`) than the `wanted` one,
    "" if it is not that.
    """

    def __init__(self, source: NodeSource, trace: Trace, run: Run, use: CheckUse) -> None:
        self.source, self.trace, self.run, self.use = source, trace, run, use
        self.field = self.wanted = self.came = ""

    @property
    def topic(self) -> str:
        """The topic that the check is about; "" if it is about none."""
        return str(self.use.with_.get("topic", ""))

    @property
    def service(self) -> str:
        """The service that the check is about; "" if it is about none."""
        return str(self.use.with_.get("service", ""))

    @property
    def _how(self) -> str:
        """What the check is about: something published, answered or logged; "" if none of these."""
        if self.use.kind == "world.event" and self.field:
            return "asked"
        if self.topic or self.use.kind.startswith("world."):
            return "published"
        if self.service:
            return "answered"
        return "logged" if self.use.kind.startswith("log.") else ""

    @cached_property
    def done(self) -> list[TracedDone]:
        """What the node did of the kind that the check is about: published, answered, logged."""
        how, what = self._how, self.topic or self.service
        same = [one for one in self.trace.done if one.how == how]
        return [one for one in same if one.what.strip("/") == what.strip("/") or not what]

    @cached_property
    def _functions(self) -> list[tuple[Module, Function]]:
        return [
            (module, node)
            for module in self.source.known_modules
            for node in module.nodes
            if isinstance(node, Function)
        ]

    def function_at(self, place: Place) -> Function | None:
        """Return the innermost function with a place."""
        found = [
            node
            for module, node in self._functions
            if module.path == place[0]
            and node.lineno <= place[1] <= (node.end_lineno or node.lineno)
        ]
        return max(found, key=lambda node: node.lineno, default=None)

    @cached_property
    def _near(self) -> dict[tuple[str, int], int]:
        """How far each line is from what failed: 0 in the function that did it or should have."""
        near: dict[tuple[str, int], int] = {}
        read: set[str] = set()
        parts: list[ast.stmt] = [*self._doing, *self._idle]
        for part in dict.fromkeys(parts):
            path = self.source.module_of(part).path
            near |= {(path, row): 0 for row in rows_of(part)}
            read |= set(read_in(part))
        for step in range(1, MOST_STEPS):
            more: set[str] = set()
            local = {name.removeprefix("self.") for name in read}  # (a line without its self.)
            for module, part in (*self._writers(read | local), *self._named(read)):
                rows = [row for row in rows_of(part) if (module.path, row) not in near]
                near |= {(module.path, row): min(step, 2) for row in rows}
                more |= set(read_in(part)) if rows else set()
            if not more - read:
                break
            read |= more
        return near

    @property
    def _idle(self) -> list[ast.stmt]:
        """The lines that made timers and subscriptions which then called nothing."""
        made = [(one.made, one.calls) for one in self.trace.timers]
        made += [(one.made, one.calls) for one in self.trace.callbacks]
        places = [places[0] for places, calls in made if places and not calls]
        found = [statement_at(self.source.module_at(path), row) for path, row in places]
        return [one for one in found if one is not None]

    @property
    def _doing(self) -> list[Function]:
        """The functions that did what failed, or could have done it."""
        functions = [self.function_at(one.places[0]) for one in self.done if one.places]
        names = {c.function for c in self.trace.callbacks if self._is_asked(c.how, c.name)}
        functions += [node for _, node in self._functions if node.name in names]
        found = [one for one in functions if one is not None]
        return found or [node for _, node in self._functions if self._could_do(node)]

    def _named(self, names: set[str]) -> list[tuple[Module, Function]]:
        return [
            (self.source.module_of(function), function)
            for _, function in self._functions
            if {function.name, f"self.{function.name}"} & names
        ]

    def _is_asked(self, how: str, name: str) -> bool:
        asked = self.service if how == "service" else ""
        return bool(asked) and name.strip("/") == asked.strip("/")

    def _could_do(self, function: Function) -> bool:
        """Whether a function has a call of the kind that should have been made."""
        calls = [n for n in ast.walk(function) if isinstance(n, ast.Call)]
        names = {dotted(call.func).rpartition(".")[2] for call in calls}
        wanted = DOERS.get(self._how)
        if wanted is not None:
            return bool(names.intersection(wanted))
        return bool(names.intersection(LOGS)) or function.name != "__init__"

    def _writers(self, names: set[str]) -> Iterator[tuple[Module, ast.stmt]]:
        for module in self.source.known_modules:
            for node in module.nodes:
                targets: list[ast.expr] = []
                if isinstance(node, ast.Assign):
                    targets = node.targets
                elif isinstance(node, ast.AugAssign | ast.AnnAssign):
                    targets = [node.target]
                parts = [p for t in targets for p in (t.elts if isinstance(t, ast.Tuple) else [t])]
                if isinstance(node, ast.stmt) and any(dotted(p) in names for p in parts):
                    yield module, node

    def with_values(self, module: Module, at: ast.If | ast.stmt) -> str:
        """Return a condition, or a line, with the values that its names had: `x > 11.0; x = 3.2 ... 9.4`."""
        place = (module.path, at.lineno)
        seen = []
        for code, (low, high) in self.trace.ranges.get(place, {}).items():
            seen.append(f"{code} = {low:.4g}" + (f" ... {high:.4g}" if low != high else ""))
        for code, values in self.trace.kinds.get(place, {}).items():
            seen.append(f"{code} = {', '.join(values)}")
        if not isinstance(at, ast.If):
            return shown("; ".join([module.line(at.lineno), *seen]))
        names = {dotted(n.func) for n in ast.walk(at.test) if isinstance(n, ast.Call)}
        for name in dict.fromkeys(read_in(at.test)):
            if name.partition(".")[2] in self.source.methods and name not in names:
                seen.append(f"{name} = <bound method>")
        return shown("; ".join([module.text.code(at.test), *seen]))

    def distance(self, path: str, first: int, last: int | None) -> int:
        """Return how far a place is from what failed: 0 is the function that did it."""
        return min(
            self._near.get((path, row), ELSEWHERE) for row in range(first, (last or first) + 1)
        )
