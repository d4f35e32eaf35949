"""Runs variants of a node, each in a process of its own: a program for the sandbox.

ROS is imported once, and each variant runs in a fork. There ROS time steps from one timer to the
next one while the node waits, so that a run of many periods takes some milliseconds. The standard
input is one JSON object: `module` and `function` to call, and `variants`, each the new texts of
modules by their names; `until` is in nanoseconds of ROS time, `lines` the most lines, `each` and
`seconds` the most time for one variant and for all, without waiting for a core, `jobs` how many run at once. `watched` has
null for each variant, or the `file`, `first` and `last` line of a statement, and pieces of `code`
whose values are asked for. `traced` has the files whose lines are followed, and `conditions` are
watched in them as well. The output is a JSON line for each variant that was run: its index, the
`lines` (instant, logger, text), how it `ended`, the number of `steps` that ROS time made, whether the
code `slept`, for each piece of code its first `values`, and the `trace` (see Traced). What it says is
no proof: the student's code runs in the same process.
"""

from __future__ import annotations

import ast
import builtins
import contextlib
import functools
import importlib
import importlib.abc
import importlib.util
import inspect
import json
import os
import select
import signal
import sys
import threading
import time
from collections.abc import Mapping, Sequence
from importlib.machinery import ModuleSpec
from types import CodeType, FrameType, ModuleType
from typing import Any, NoReturn

SECOND = 10**9
SHOWN = 20  # the level of info()
LONGEST = 300  # characters of a line
MOST_VALUES = 3
MOST_WAITED = 50  # steps in which a timer is due, and is not called
MOST_PLACES = 6  # of a call stack
LONGEST_VALUE = 30
CPU_SECONDS = 0.4
"""The most CPU time of a variant: a run of many periods takes a quarter of it."""
WATCHED_CPU_SECONDS = 1.2
"""The same, of a variant that is watched: each call in it takes longer."""
PLAIN = (bool, int, float, str, type(None))
PRELOADED = (
    *("rcl_interfaces.msg", "rcl_interfaces.srv", "rosgraph_msgs.msg"),
    *("type_description_interfaces.srv", "std_msgs.msg"),
)
READY = ("timer", "guard_condition", "subscription", "client", "service")


class Sources(importlib.abc.MetaPathFinder, importlib.abc.InspectLoader):
    """Imports the modules of a variant from their new texts."""

    def __init__(self, texts: Mapping[str, str]) -> None:
        self._texts = texts

    def find_spec(self, fullname: str, *_: Any) -> ModuleSpec | None:
        """Return how to import a module; None if the variant does not change it."""
        if fullname not in self._texts:
            return None
        return importlib.util.spec_from_loader(fullname, self, origin=fullname)

    def get_source(self, fullname: str) -> str:
        """Return the text of a module."""
        return self._texts[fullname]

    def get_code(self, fullname: str) -> CodeType:
        """Return the code of a module; its file name ends as that of the installed module does."""
        return compile(self._texts[fullname], f"{fullname.replace('.', '/')}.py", "exec")


class _Known(ast.NodeTransformer):
    """Puts the values of names and attributes of a frame into code; LookupError if one is not plain.

    No code of the student runs for it: properties are left alone.
    """

    def __init__(self, frame: FrameType) -> None:
        self._frame = frame

    def _object(self, node: ast.AST) -> Any:
        if isinstance(node, ast.Name):
            names = {**self._frame.f_globals, **self._frame.f_locals}
            return names[node.id]
        if not isinstance(node, ast.Attribute):
            raise LookupError
        owner = self._object(node.value)
        own = getattr(owner, "__dict__", {})
        found = own[node.attr] if node.attr in own else inspect.getattr_static(owner, node.attr)
        if hasattr(type(found), "__get__"):
            raise LookupError
        return found

    def _value(self, node: ast.expr) -> ast.AST:
        found = self._object(node)
        if type(found) not in PLAIN:
            raise LookupError
        return ast.Constant(found)

    visit_Name = visit_Attribute = _value  # noqa: N815 - the names that ast calls


class Watched:
    """Takes the values that code has each time just before a statement runs."""

    def __init__(self, file: str, first: int, last: int, code: Sequence[str]) -> None:
        self.file, self.first, self._code = file, first, code
        self._lines = range(first, last + 1)
        self.values: list[list[str]] = [[] for _ in code]

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
        for code, values in zip(self._code, self.values):
            if len(values) < MOST_VALUES:
                with contextlib.suppress(
                    Exception
                ):  # (a name without a value, or a value of another kind)
                    tree = _Known(frame).visit(ast.parse(code, mode="eval"))
                    now = ast.fix_missing_locations(tree)
                    value = eval(compile(now, "code", "eval"), {"__builtins__": {}})  # noqa: S307 - in the sandbox, of plain values
                    if type(value) in PLAIN and len(repr(value)) <= LONGEST_VALUE:
                        values.append(repr(value))


class Traced:
    """Follows which lines of some files run, and what becomes of the timers.

    A place is a file and a line; those of a call stack begin with the innermost one.
    """

    def __init__(self, files: Sequence[str], conditions: Sequence[Watched]) -> None:
        self._files = files
        self._conditions = conditions
        self._by_line = {(each.file, each.first): each for each in conditions}
        self._lines: dict[str, dict[int, int]] = {file: {} for file in files}
        self._timers: list[dict[str, Any]] = []
        self._numbers: dict[int, int] = {}  # of timers, by their id()
        self._kept: list[Any] = []  # timers, so that no other object gets the id of one
        self._spun: set[int] = set()
        self._active = threading.local()
        self._logged: list[tuple[list[tuple[str, int]], int]] = []

    def _file(self, frame: FrameType) -> str:
        name = frame.f_code.co_filename
        return next((file for file in self._files if name.endswith(f"/{file}") or name == file), "")

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

        Node.create_timer = create_timer
        Node.destroy_timer = destroy_timer
        Executor.add_node = add_node
        threading.settrace(self._called)
        sys.settrace(self._called)

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
        lines, by_line = self._lines[file], self._by_line

        def line(frame: FrameType, event: str, _: Any) -> Any:
            if event == "line":
                lines[frame.f_lineno] = lines.get(frame.f_lineno, 0) + 1
                if watched := by_line.get((file, frame.f_lineno)):
                    watched.take(frame)
            return line

        return line

    def logs(self, frame: FrameType) -> None:
        """Note that a line is logged, and by which timer's callback."""
        self._logged.append((self._places(frame), getattr(self._active, "timer", -1)))

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
        }


class ShortRun:
    """One run of a variant, in a fork; `until` and `most` end it."""

    def __init__(
        self,
        report: int,
        until: int,
        most: int,
        watched: Watched | None,
        traced: Traced | None = None,
    ) -> None:
        self._report, self._until, self._most = report, until, most
        self._watched, self._traced = watched, traced
        self._begin = self._now = SECOND
        self._idle = False
        self._waited = 0  # steps since a timer is due
        self._nodes: list[Any] = []
        self._lines: list[tuple[int, str, str]] = []
        self._steps = 0
        self._slept = False

    def install(self) -> None:
        """Put ROS time, the logger and what waits under control."""
        from rclpy.impl.implementation_singleton import rclpy_implementation as ros  # noqa: PLC0415 - of the fork alone
        from rclpy.node import Node  # noqa: PLC0415
        from rclpy.timer import Rate  # noqa: PLC0415

        make, write, run = Node.__init__, ros.rclpy_logging_rcutils_log, self

        def make_node(node: Any, *args: Any, **named: Any) -> None:
            make(node, *args, **named)
            node.get_clock()._set_ros_time_is_active(True)
            run._nodes.append(node)
            run._set_clocks()

        def log(severity: Any, name: Any, message: Any, *rest: Any) -> None:
            write(severity, name, message, *rest)
            if int(severity) >= SHOWN:
                if run._traced is not None:
                    run._traced.logs(sys._getframe(1))
                run._lines.append((run._now - run._begin, str(name), str(message)[:LONGEST]))
            if len(run._lines) >= run._most:
                run.end("lines")

        class WaitSet(ros.WaitSet):  # type: ignore[misc]
            """Waits without wall time."""

            def wait(self, nanoseconds: int) -> None:
                if run._idle:
                    run._step(nanoseconds)
                super().wait(0)
                run._idle = not any(self.get_ready_entities(kind) for kind in READY)

        Node.__init__ = make_node
        ros.rclpy_logging_rcutils_log = log
        ros.WaitSet = WaitSet
        Rate.sleep = lambda _: run.end("waits")
        time.sleep = lambda seconds: run._sleep(float(seconds))
        builtins.input = lambda *_: run.end("waits")

    def _step(self, most: int) -> None:
        """Let ROS time go on to the next timer, by `most` at most if that is not negative.

        A timer that stays due is one that nothing calls: its node is not spun.
        """
        left = []
        for timer in (timer for node in self._nodes for timer in list(node.timers)):
            with contextlib.suppress(Exception):  # (the node may have destroyed it)
                if not timer.is_canceled():
                    left.append(max(0, timer.time_until_next_call()))
        is_due = 0 in left and self._waited < MOST_WAITED
        self._waited = self._waited + 1 if is_due else 0
        due = [*([most] if most >= 0 else []), *(each for each in left if each or is_due)]
        if not due:
            self.end("waits")
        self._steps += 1
        self._pass(min(due))

    def _pass(self, nanoseconds: int) -> None:
        self._now += max(0, nanoseconds)
        if self._now - self._begin > self._until:
            self.end("time")
        self._set_clocks()

    def _sleep(self, seconds: float) -> None:
        self._slept = True
        self._pass(int(seconds * SECOND))

    def _set_clocks(self) -> None:
        from rclpy.time import Time  # noqa: PLC0415

        for node in self._nodes:
            with contextlib.suppress(Exception):  # (the node may be gone)
                clock = node.get_clock()
                now = Time(nanoseconds=self._now, clock_type=clock.clock_type)
                clock.set_ros_time_override(now)

    def end(self, how: str) -> NoReturn:
        """Report what was seen, and end the process."""
        said = {
            "lines": self._lines,
            "ended": how,
            "steps": self._steps,
            "slept": self._slept,
            "values": self._watched.values if self._watched is not None else [],
            "trace": self._traced.found() if self._traced is not None else None,
        }
        with os.fdopen(self._report, "wb", closefd=False) as pipe:
            pipe.write(json.dumps(said).encode())
        os._exit(0)

    def play(self, module: str, function: str) -> NoReturn:
        """Call the function of the module."""
        signal.signal(signal.SIGPROF, lambda *_: self.end("killed"))
        is_plain = self._watched is None and self._traced is None
        seconds = CPU_SECONDS if is_plain else WATCHED_CPU_SECONDS
        signal.setitimer(signal.ITIMER_PROF, seconds)
        if self._watched is not None:
            self._watched.install()
        if self._traced is not None:
            self._traced.install()
        try:
            found: Any = importlib.import_module(module)
            for part in function.split("."):
                found = getattr(found, part)
            found()
        except SystemExit:
            self.end("exit")
        except BaseException as error:
            trace, line = error.__traceback__, 0
            while trace is not None:
                line, trace = trace.tb_lineno, trace.tb_next
            self.end(f"{type(error).__name__} {line}")
        self.end("returned")


def preload() -> None:
    """Import what every node needs, so that no fork has to."""
    import rclpy  # noqa: PLC0415
    import rclpy.executors  # noqa: F401, PLC0415
    from rclpy.type_support import check_for_type_support  # noqa: PLC0415

    for name in PRELOADED:
        try:
            module: ModuleType = importlib.import_module(name)
        except ImportError:  # (a distro without it)
            continue
        for kind in vars(module).values():
            if isinstance(kind, type):
                check_for_type_support(kind)
    inspect.getmodule(inspect.currentframe())  # (the logger does this; the first call is slow)


def waited(child: int) -> float:
    """Return the seconds for which a process has waited for a core: it cannot help that."""
    try:
        with open(f"/proc/{child}/schedstat", encoding="ascii") as file:  # noqa: PTH123 - fast
            return int(file.read().split()[1]) / SECOND
    except (OSError, IndexError, ValueError):
        return 0.0


def main() -> None:
    """Run the variants that the standard input asks for."""
    asked = json.load(sys.stdin)
    out, nothing = os.dup(1), os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1, 2):
        os.dup2(nothing, stream)
    preload()
    sys.argv = ["node"]
    waiting = list(enumerate(asked["variants"]))[::-1]
    running: dict[int, tuple[int, int, float, list[bytes]]] = {}
    left = asked["seconds"]
    while running or (waiting and left > 0):
        while waiting and len(running) < asked["jobs"] and left > 0:
            index, texts = waiting.pop()
            read, write = os.pipe()
            child = os.fork()
            if child == 0:
                os.setsid()
                os.close(out)
                sys.meta_path.insert(0, Sources(texts))
                watched = Watched(**asked["watched"][index]) if asked["watched"][index] else None
                conditions = [Watched(**each) for each in asked["conditions"]]
                traced = Traced(asked["traced"], conditions) if asked["traced"] else None
                run = ShortRun(write, asked["until"], asked["lines"], watched, traced)
                run.install()
                run.play(asked["module"], asked["function"])
            os.close(write)
            running[read] = (index, child, time.monotonic(), [])
        ready, _, _ = select.select(list(running), [], [], 0.05)
        for pipe in list(running):
            index, child, began, parts = running[pipe]
            spent = time.monotonic() - began - waited(child)
            data = os.read(pipe, 100_000) if pipe in ready else b""
            if data:
                parts.append(data)
            elif pipe in ready or spent > asked["each"]:
                left -= spent / asked["jobs"]
                with contextlib.suppress(OSError):  # (it has ended)
                    os.killpg(child, signal.SIGKILL)
                os.waitpid(child, 0)
                os.close(pipe)
                del running[pipe]
                said = b"".join(parts).decode("utf-8", "replace")
                os.write(out, f'{{"index": {index}, "seen": {said or "null"}}}\n'.encode())


if __name__ == "__main__":
    main()
