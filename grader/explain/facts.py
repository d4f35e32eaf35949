"""Facts of one followed run of a node, and the questions that rules may ask about them."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from functools import cached_property

from grader.base.i18n.message import Value
from grader.base.shown import shown
from grader.course.assignment import CheckUse
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted
from grader.package.source.node import NodeSource
from grader.run.run import Run
from grader.run.variants import Place, Trace, TracedDone

Answer = tuple[Place, Mapping[str, Value]]
"""Where it is, and the values of the text's places."""
MOST_STEPS = 4  # from a value to where it was made
ELSEWHERE = 3


class Facts:
    """What a node did in a run in which a check failed: `use` is that of the check.

    `field` is the field of a message that has another value than the `wanted` one, "" if it is not that.
    """

    def __init__(self, source: NodeSource, trace: Trace, run: Run, use: CheckUse) -> None:
        self.source, self.trace, self.run, self.use = source, trace, run, use
        self.field = self.wanted = ""

    @property
    def topic(self) -> str:
        """The topic that the check is about; "" if it is about none."""
        return str(self.use.with_.get("topic", ""))

    @property
    def service(self) -> str:
        """The service that the check is about; "" if it is about none."""
        return str(self.use.with_.get("service", ""))

    @cached_property
    def done(self) -> list[TracedDone]:
        """What the node did of the kind that the check is about: published, answered, logged."""
        if self.topic:
            how, what = "published", self.topic
        elif self.service:
            how, what = "answered", self.service
        elif self.use.kind.startswith("log."):
            how, what = "logged", ""
        else:
            return []
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
        functions = [self.function_at(one.places[0]) for one in self.done if one.places]
        names = {c.function for c in self.trace.callbacks if self._is_asked(c.how, c.name)}
        functions += [node for _, node in self._functions if node.name in names]
        if not any(functions):
            functions += [node for _, node in self._functions if self._could_do(node)]
        read: set[str] = set()
        for function in dict.fromkeys(f for f in functions if f is not None):
            module = self.source.module_of(function)
            for row in range(function.lineno, (function.end_lineno or function.lineno) + 1):
                near[module.path, row] = 0
            read |= set(_read(function))
        for step in range(1, MOST_STEPS):
            more: set[str] = set()
            for module, statement in self._writers(read):
                rows = range(statement.lineno, (statement.end_lineno or statement.lineno) + 1)
                for row in rows:
                    if (module.path, row) not in near:
                        near[module.path, row] = min(step, 2)
                        more |= set(_read(statement))
            if not more - read:
                break
            read |= more
        return near

    def _is_asked(self, how: str, name: str) -> bool:
        asked = self.service if how == "service" else ""
        return bool(asked) and name.strip("/") == asked.strip("/")

    def _could_do(self, function: Function) -> bool:
        """Whether a function has a call of the kind that should have been made."""
        calls = [n for n in ast.walk(function) if isinstance(n, ast.Call)]
        names = {dotted(call.func).rpartition(".")[2] for call in calls}
        wanted = {"publish"} if self.topic else {"info", "warn", "warning", "error"}
        return bool(names & wanted) or (function.name != "__init__" and not self.topic)

    def _writers(self, names: set[str]) -> Iterator[tuple[Module, ast.stmt]]:
        for module in self.source.known_modules:
            for node in module.nodes:
                targets: list[ast.expr] = []
                if isinstance(node, ast.Assign):
                    targets = node.targets
                elif isinstance(node, ast.AugAssign | ast.AnnAssign):
                    targets = [node.target]
                if isinstance(node, ast.stmt) and any(dotted(t) in names for t in targets):
                    yield module, node

    def distance(self, path: str, first: int, last: int | None) -> int:
        """Return how far a place is from what failed: 0 is the function that did it."""
        return min(
            self._near.get((path, row), ELSEWHERE) for row in range(first, (last or first) + 1)
        )

    # the questions of the rules: each returns a place and the values of a text, or None --------------

    def stands(self) -> Answer | None:
        """Return the line in which the node waits for ever."""
        if self.trace.ended not in ("hangs", "killed"):
            return None
        for places in self.trace.stand:
            code = self._code(places[0])
            if "spin" not in code:
                return places[0], {"line": places[0][1], "code": code}
        return None

    def raises(self) -> Answer | None:
        """Return the line that raises what ends the node."""
        if self.trace.raised is None or not self.trace.raised[1]:
            return None
        error, places = self.trace.raised
        place = places[0]
        return place, {"line": place[1], "error": shown(error), "code": self._code(place)}

    def idle_timer(self) -> Answer | None:
        """Return a timer whose callback was never called."""
        for timer in self.trace.timers:
            if not timer.calls and timer.made and timer.spun:
                seen = self.run.seen
                seconds = seen.instants[-1] if seen is not None and seen.instants else 0
                place = timer.made[0]
                code = self._code(place)
                return place, {"line": place[1], "name": code, "seconds": f"{seconds:g}"}
        return None

    def deaf_callback(self) -> Answer | None:
        """Return a subscription whose callback was never called, if it is the only way to the deed."""
        callbacks = [one for one in self.trace.callbacks if one.how == "subscription"]
        deaf = [one for one in callbacks if not one.calls and one.made]
        if len(deaf) != 1 or self.done:
            return None
        function = next((f for _, f in self._functions if f.name == deaf[0].function), None)
        if function is None or not self._doers_in(function):
            return None
        place = deaf[0].made[0]
        values: dict[str, Value] = {
            "line": place[1],
            "topic": deaf[0].name,
            "name": deaf[0].function,
        }
        return place, values

    def uncalled_doer(self) -> Answer | None:
        """Return a function that has the deed and that no line names."""
        for module, function in self._functions:
            named = any(
                isinstance(n, ast.Name | ast.Attribute)
                and dotted(n).rpartition(".")[2] == function.name
                for each in self.source.known_modules
                for n in each.nodes
            )
            if not named and not function.name.startswith("__") and self._doers_in(function):
                values: dict[str, Value] = {"name": f"{function.name}()", "line": function.lineno}
                return (module.path, function.lineno), values
        return None

    def guarded_doer(self) -> Answer | None:
        """Return a deed that no call of its function came to, because of a condition."""
        for module, function in self._functions:
            count = max((self.trace.count(module.path, s.lineno) for s in function.body), default=0)
            for doer in self._doers_in(function) if count else ():
                if self.trace.count(module.path, doer.lineno):
                    continue
                guard = self._guard(module, function, doer)
                if guard is not None:
                    values: dict[str, Value] = {
                        "name": f"{function.name}()",
                        "count": count,
                        "line": doer.lineno,
                        "row": guard.lineno,
                        "guard": shown(module.text.code(guard.test)),
                    }
                    return (module.path, guard.lineno), values
        return None

    def repeated_doer(self) -> Answer | None:
        """Return the line of what is done too often."""
        place = next((one.places[0] for one in self.done if one.places), None)
        function = self.function_at(place) if place is not None else None
        if place is None or function is None:
            return None
        calls = self.trace.count(place[0], function.body[-1].lineno)
        calls = max([calls, *(self.trace.count(place[0], s.lineno) for s in function.body)])
        count = self.trace.count(*place)
        if count < 2:
            return None
        values: dict[str, Value] = {
            "line": place[1],
            "count": count,
            "name": f"{function.name}()",
            "calls": calls,
        }
        return place, values

    def unset_field(self) -> Answer | None:
        """Return the function that leaves the wrong field as it is in a new message."""
        message = self._message()
        if not self.field or message is None or self._setters(*message):
            return None
        name, function, row = message
        module = self.source.module_of(function)
        code = module.text.code(function)
        if f"{name}.{self.field.partition('.')[0]} =" in code or f"({self.field}=" in code:
            return None
        values: dict[str, Value] = {"name": f"{function.name}()", "field": self.field, "line": row}
        return (module.path, row), values

    def writer_of_field(self) -> Answer | None:
        """Return the line that made the wrong value of a field."""
        message = self._message()
        setters = self._setters(*message) if message is not None and self.field else []
        if message is None or not setters:
            return None
        last = self._order()
        module = self.source.module_of(message[1])
        at = max(setters, key=lambda s: last.get((module.path, s.lineno), -1))
        if (module.path, at.lineno) not in last:
            return None
        module, at = self._made(module, at, last)
        values: dict[str, Value] = {
            "row": message[2],
            "field": self.field,
            "value": self._value(),
            "line": at.lineno,
            "code": shown(module.line(at.lineno)),
            "wanted": self.wanted,
        }
        return (module.path, at.lineno), values

    # what they need ----------------------------------------------------------------------------------

    def _code(self, place: Place) -> str:
        return shown(self.source.module_at(place[0]).line(place[1]))

    def _doers_in(self, function: Function) -> list[ast.Call]:
        wanted = ("publish",) if self.topic else ("info", "warn", "warning", "error")
        if self.service:
            return []
        calls = [n for n in ast.walk(function) if isinstance(n, ast.Call)]
        return [c for c in calls if dotted(c.func).rpartition(".")[2] in wanted]

    def _guard(self, module: Module, function: Function, doer: ast.AST) -> ast.If | None:
        """Return the condition that kept a call from running: around it, or one that leaves before it."""
        for around in module.around(doer):
            if isinstance(around, ast.If) and self.trace.count(module.path, around.lineno):
                return around
            if around is function:
                break
        for statement in function.body:
            last = statement.body[-1] if isinstance(statement, ast.If) else None
            left = isinstance(last, ast.Return) and self.trace.count(module.path, last.lineno)
            if isinstance(statement, ast.If) and left:
                return statement
        return None

    @cached_property
    def _wrong(self) -> TracedDone | None:
        """What was done first in the time that the check judges."""
        seen, begin = self.run.seen, 0.0
        done = seen.stimulus(self.use.after) if seen is not None and self.use.after else None
        begin = done.at if done is not None else 0.0
        if self.use.during is not None:
            begin += self.use.during[0]
        later = [one for one in self.done if one.at / 1e9 >= begin - 1e-6]
        return (later or self.done or [None])[0]  # type: ignore[list-item]

    def _message(self) -> tuple[str, Function, int] | None:
        """Return the variable of the message, its function and the line from which it goes out."""
        wrong = self._wrong
        if self.service:
            names = {c.function for c in self.trace.callbacks if self._is_asked(c.how, c.name)}
            found = [f for _, f in self._functions if f.name in names]
            if len(found) != 1 or len(found[0].args.args) < 2:
                return None
            return found[0].args.args[-1].arg, found[0], found[0].lineno
        if wrong is None or not wrong.places:
            return None
        function = self.function_at(wrong.places[0])
        for call in self._doers_in(function) if function is not None else ():
            if call.lineno <= wrong.places[0][1] <= (call.end_lineno or call.lineno) and call.args:
                name = dotted(call.args[0])
                if name and function is not None:
                    return name, function, call.lineno
        return None

    def _setters(self, name: str, function: Function, row: int) -> list[ast.stmt]:
        del row
        module = self.source.module_of(function)
        target = f"{name}.{self.field}"
        return [s for each, s in self._writers({target}) if each is module]

    def _order(self) -> dict[tuple[str, int], int]:
        wrong = self._wrong
        if wrong is None:
            return {}
        return {(path, row): n for path, rows in wrong.last.items() for row, n in rows.items()}

    def _made(
        self, module: Module, at: ast.stmt, last: dict[tuple[str, int], int]
    ) -> tuple[Module, ast.stmt]:
        """Follow a value that is only handed on to the line that made it."""
        for _ in range(MOST_STEPS):
            value = getattr(at, "value", None)
            name = dotted(value) if isinstance(value, ast.Name | ast.Attribute) else ""
            writers = [
                (each, s) for each, s in self._writers({name}) if (each.path, s.lineno) in last
            ]
            if not name or not writers:
                break
            module, at = max(writers, key=lambda pair: last[pair[0].path, pair[1].lineno])
        return module, at

    def _value(self) -> str:
        seen, wrong = self.run.seen, self._wrong
        found: object = None
        if seen is not None and wrong is not None:
            if self.service:
                done = seen.stimulus(self.use.after)
                found = done.reply if done is not None else None
            else:
                same = [m for m in seen.of_topic(self.topic) if abs(m.at - wrong.at / 1e9) < 1e-6]
                found = same[0].values if same else None
        for part in self.field.split("."):
            found = found.get(part) if isinstance(found, dict) else None
        return shown(str(found))


def _read(node: ast.AST) -> Iterator[str]:
    """Yield the names that a part of a program reads: those of attributes of self, and plain ones."""
    for part in ast.walk(node):
        if isinstance(part, ast.Name | ast.Attribute) and isinstance(part.ctx, ast.Load):
            name = dotted(part)
            if name:
                yield name
