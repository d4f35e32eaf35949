"""Follows which lines of a node run, and what values code has there: for the sandbox.

`Watched` takes the values that code has just before a statement; `Traced` follows the lines of some
files, the callbacks, and what comes of them: what is published, answered and logged.
"""

from __future__ import annotations

import ast
import contextlib
import copy
import functools
import inspect
import linecache
import re
import sys
import threading
from collections.abc import Sequence
from types import FrameType
from typing import Any

MOST_VALUES = 3
MOST_PLACES = 6  # of a call stack
MOST_DONE = 60  # messages, answers and lines of the log of which the way is kept
MOST_ALIKE = 25  # of one topic, of one service, and of the log
MOST_CALLBACKS = 40
LONGEST = 300  # characters
ENDS = {"subscription": "create_subscription", "service": "create_service"}
"""The methods that make an end with a callback, by what it is."""
PLACE_OF_CALLBACK = {"subscription": 0, "service": 0}
"""Which of the arguments after type and name the callback is."""
LONGEST_VALUE = 30
NO_ATTRIBUTE = re.compile(
    r"'(?P<type>\w{1,120})' object has no attribute '(?P<name>\w{1,120})'.{0,200}"
)
PLAIN = (bool, int, float, str, type(None))


class _Known(ast.NodeTransformer):
    """Puts the values of names and attributes of a frame into code; LookupError if one is not plain.

    No code of the student runs for it: properties are left alone.
    """

    def __init__(self, frame: FrameType) -> None:
        self._frame = frame

    def value_of(self, node: ast.AST) -> Any:
        """Return what a name or an attribute is."""
        if isinstance(node, ast.Name):
            names = {**self._frame.f_globals, **self._frame.f_locals}
            return names[node.id]
        if not isinstance(node, ast.Attribute):
            raise LookupError
        owner = self.value_of(node.value)
        if hasattr(type(owner), "get_fields_and_field_types"):
            return getattr(owner, node.attr)  # (a message: its fields are made by ROS)
        own = getattr(owner, "__dict__", {})
        found = own[node.attr] if node.attr in own else inspect.getattr_static(owner, node.attr)
        if hasattr(type(found), "__get__"):
            raise LookupError
        return found

    def _value(self, node: ast.expr) -> ast.AST:
        found = self.value_of(node)
        if type(found) not in PLAIN:
            raise LookupError
        return ast.Constant(found)

    visit_Name = visit_Attribute = _value  # noqa: N815 - the names that ast calls


class Watched:
    """Takes the values that code has each time just before a statement runs.

    `values` are the first ones of each piece of code. Of a name, `kinds` are the different ones that are
    no numbers, and `ranges` the least and the greatest number.
    """

    def __init__(self, file: str, first: int, last: int, code: Sequence[str]) -> None:
        self.file, self.first, self._code = file, first, code
        self._lines = range(first, last + 1)
        self._trees = [ast.parse(one, mode="eval") for one in code]
        self.values: list[list[str]] = [[] for _ in code]
        self.kinds: list[list[str]] = [[] for _ in code]
        self.ranges: list[list[float]] = [[] for _ in code]

    def install(self) -> None:
        """Watch all threads."""
        threading.settrace(self._called)
        sys.settrace(self._called)

    def _called(self, frame: FrameType, event: str, _: Any) -> Any:
        if event != "call" or not frame.f_code.co_filename.endswith(self.file):
            return None
        inside = False

        def line(frame: FrameType, event: str, _: Any) -> Any:
            nonlocal inside
            if event == "line":
                here = frame.f_lineno in self._lines
                if here and not inside:
                    self.take(frame)
                inside = here
            return line

        return line

    def take(self, frame: FrameType) -> None:
        """Take the values that the code has in a frame."""
        for n, tree in enumerate(self._trees):
            with contextlib.suppress(Exception):  # (a name without a value, or one of another kind)
                if len(self.values[n]) < MOST_VALUES:
                    now = ast.fix_missing_locations(_Known(frame).visit(copy.deepcopy(tree)))
                    value = eval(compile(now, "code", "eval"), {"__builtins__": {}})  # noqa: S307 - in the sandbox, of plain values
                    if type(value) in PLAIN and len(repr(value)) <= LONGEST_VALUE:
                        self.values[n].append(repr(value))
                if isinstance(tree.body, ast.Name | ast.Attribute):
                    self._keep(_Known(frame).value_of(tree.body), self.kinds[n], self.ranges[n])

    @staticmethod
    def _keep(value: object, kinds: list[str], spread: list[float]) -> None:
        if isinstance(value, int | float) and not isinstance(value, bool):
            spread[:] = min([value, *spread[:1]]), max([value, *spread[1:]])
        elif type(value) in PLAIN and len(kinds) < MOST_VALUES:
            seen = repr(value)
            if len(seen) <= LONGEST_VALUE and seen not in kinds:
                kinds.append(seen)


def _fields_beside(error: BaseException) -> list[str]:
    """Return the fields of the message that has no such attribute; none if it is no message."""
    missed = NO_ATTRIBUTE.fullmatch(str(error)) if isinstance(error, AttributeError) else None
    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    if missed is None or trace is None:
        return []
    line = linecache.getline(trace.tb_frame.f_code.co_filename, trace.tb_lineno)
    for owner in re.findall(rf"([A-Za-z_][\w.]*)\.{missed['name']}\b", line):
        with contextlib.suppress(Exception):  # (a name without a value, or one of another kind)
            kind = type(_Known(trace.tb_frame).value_of(ast.parse(owner, mode="eval").body))
            if kind.__name__ == missed["type"]:
                return [*kind.get_fields_and_field_types()]
    return []


class Traced:
    """Follows which lines of some files run, and what becomes of the timers.

    A place is a file and a line; those of a call stack begin with the innermost one.
    """

    def __init__(self, files: Sequence[str], conditions: Sequence[Watched]) -> None:
        self.now = 0  # ns since the start, if a scenario says it
        self._files = files
        self._known: dict[str, str] = {}  # which of them a code's file name is, "" if none
        self._conditions = conditions
        self._by_line = {(each.file, each.first): each for each in conditions}
        self._lines: dict[str, dict[int, int]] = {file: {} for file in files}
        self._timers: list[dict[str, Any]] = []
        self._numbers: dict[int, int] = {}  # of timers, by their id()
        self._kept: list[Any] = []  # timers, so that no other object gets the id of one
        self._spun: set[int] = set()
        self._active = threading.local()
        self._logged: list[tuple[list[tuple[str, int]], int]] = []
        self._steps = 0  # lines that ran
        self._last: dict[str, dict[int, int]] = {file: {} for file in files}  # when a line ran last
        self._callbacks: list[dict[str, Any]] = []
        self._done: list[dict[str, Any]] = []
        self._raised: dict[str, Any] | None = None

    def _file(self, frame: FrameType) -> str:
        name = frame.f_code.co_filename
        if name not in self._known:
            mine = (file for file in self._files if name.endswith(f"/{file}") or name == file)
            self._known[name] = next(mine, "")
        return self._known[name]

    def _places(self, frame: FrameType | None) -> list[tuple[str, int]]:
        found: list[tuple[str, int]] = []
        while frame is not None and len(found) < MOST_PLACES:
            if file := self._file(frame):
                found.append((file, frame.f_lineno))
            frame = frame.f_back
        return found

    def install(self) -> None:
        """Follow all threads."""
        from rclpy.executors import Executor  # noqa: PLC0415 - of the fork alone
        from rclpy.node import Node  # noqa: PLC0415

        create, destroy, add, traced = (
            Node.create_timer,
            Node.destroy_timer,
            Executor.add_node,
            self,
        )

        def create_timer(node: Any, period: Any, callback: Any, *args: Any, **named: Any) -> Any:
            number = len(traced._timers)
            seen = {
                "made": traced._places(sys._getframe(1)),
                "node": id(node),
                "calls": 0,
                "stopped": [],
            }
            traced._timers.append(seen)
            timer = create(node, period, traced._counted(callback, number), *args, **named)
            traced._numbers[id(timer)] = number
            traced._kept.append(timer)
            cancel = timer.cancel

            def stopped() -> None:
                traced._stopped(timer, sys._getframe(1))
                cancel()

            with contextlib.suppress(AttributeError):
                timer.cancel = stopped
            return timer

        def destroy_timer(node: Any, timer: Any) -> Any:
            traced._stopped(timer, sys._getframe(1))
            return destroy(node, timer)

        def add_node(executor: Any, node: Any) -> Any:
            traced._spun.add(id(node))
            return add(executor, node)

        for how, name in ENDS.items():
            setattr(Node, name, self._following(getattr(Node, name), how))
        Node.create_timer = create_timer
        Node.destroy_timer = destroy_timer
        Executor.add_node = add_node
        threading.settrace(self._called)
        sys.settrace(self._called)

    def _following(self, create: Any, how: str) -> Any:
        """Return a method that makes an end, whose callback is followed."""
        place = PLACE_OF_CALLBACK[how]

        @functools.wraps(create)
        def made(node: Any, kind: Any, name: Any, *args: Any, **named: Any) -> Any:
            callback = args[place] if len(args) > place else named.get("callback")
            places = self._places(sys._getframe(1))
            if not inspect.isroutine(callback) or inspect.iscoroutinefunction(callback):
                return create(node, kind, name, *args, **named)
            own = self._file(sys._getframe(1))  # (rclpy makes services for each node)
            if not own or len(self._callbacks) >= MOST_CALLBACKS:
                return create(node, kind, name, *args, **named)
            seen: dict[str, Any] = {
                "how": how,
                "name": str(name),
                "made": places,
                "function": getattr(callback, "__name__", ""),
                "calls": 0,
            }
            self._callbacks.append(seen)

            @functools.wraps(callback)
            def called(*given: Any) -> Any:
                seen["calls"] += 1
                result = callback(*given)
                if how == "service":
                    self._note("answered", str(name), self.now, [])
                return result

            args = tuple(called if n == place else one for n, one in enumerate(args))
            if "callback" in named:
                named["callback"] = called
            return create(node, kind, name, *args, **named)

        return made

    def _note(self, how: str, what: str, at: int, places: list[tuple[str, int]]) -> None:
        """Note what a node does, with when each line ran last before that."""
        alike = sum(one["how"] == how and one["what"] == what for one in self._done)
        if len(self._done) < MOST_DONE and alike < MOST_ALIKE:
            last = {file: dict(each) for file, each in self._last.items()}
            one = {"how": how, "what": what[:LONGEST], "at": at, "places": places, "last": last}
            self._done.append(one)

    def published(self, topic: str, at: int, frame: Any) -> None:
        """Note that a message goes out."""
        self.now = at
        self._note("published", topic, at, self._places(frame))

    def asked(self, service: str, at: int, frame: Any) -> None:
        """Note that a request goes out."""
        self._note("asked", service, at, self._places(frame))

    def raised(self, error: BaseException) -> None:
        """Note the exception that ended the node, and the lines that led to it."""
        trace, places = error.__traceback__, []
        while trace is not None:
            if file := self._file(trace.tb_frame):
                places.append((file, trace.tb_lineno))
            trace = trace.tb_next
        text = f"{type(error).__name__}: {error}"[:LONGEST]
        places = places[-MOST_PLACES:][::-1]
        self._raised = {"text": text, "places": places, "fields": _fields_beside(error)}

    def _counted(self, callback: Any, number: int) -> Any:
        """Return the callback as one whose calls are counted; itself if it is of an unusual form."""
        if not inspect.isroutine(callback) or inspect.iscoroutinefunction(callback):
            return callback

        @functools.wraps(callback)
        def called(*args: Any, **named: Any) -> Any:
            self._timers[number]["calls"] += 1
            before = getattr(self._active, "timer", -1)
            self._active.timer = number
            try:
                return callback(*args, **named)
            finally:
                self._active.timer = before

        return called

    def _stopped(self, timer: Any, frame: FrameType) -> None:
        number = self._numbers.get(id(timer), -1)
        if number >= 0 and not self._timers[number]["stopped"]:
            self._timers[number]["stopped"] = self._places(frame)

    def _called(self, frame: FrameType, event: str, _: Any) -> Any:
        file = self._file(frame) if event == "call" else ""
        if not file:
            return None
        lines, by_line, last = self._lines[file], self._by_line, self._last[file]

        def line(frame: FrameType, event: str, _: Any) -> Any:
            if event == "line":
                row = frame.f_lineno
                lines[row] = lines.get(row, 0) + 1
                self._steps += 1
                last[row] = self._steps
                if watched := by_line.get((file, frame.f_lineno)):
                    watched.take(frame)
            return line

        return line

    def logs(self, frame: FrameType) -> None:
        """Note that a line is logged, and by which timer's callback."""
        places = self._places(frame)
        self._logged.append((places, getattr(self._active, "timer", -1)))
        self._note("logged", "", self.now, places)

    def found(self) -> dict[str, Any]:
        """Return what was seen: `lines` by file, `timers`, what was `logged`, where threads `stand`."""
        frames = sys._current_frames().values()
        timers = [{**seen, "spun": seen["node"] in self._spun} for seen in self._timers]
        return {
            "lines": self._lines,
            "timers": timers,
            "logged": self._logged,
            "stand": [places for frame in frames if (places := self._places(frame))],
            "values": [each.values for each in self._conditions],
            "ranges": [each.ranges for each in self._conditions],
            "kinds": [each.kinds for each in self._conditions],
            "callbacks": self._callbacks,
            "done": self._done,
            "raised": self._raised,
        }
