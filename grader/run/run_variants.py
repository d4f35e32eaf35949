"""Runs variants of a node, each in a process of its own: a program for the sandbox.

ROS is imported once, and each variant runs in a fork. There ROS time steps from one timer to the
next one while the node waits, so that a run of many periods takes some milliseconds. The standard
input is one JSON object: `module` and `function` to call, and `variants`, each the new texts of
modules by their names; `until` is in nanoseconds of ROS time, `lines` the most lines, `each` and
`seconds` the most wall time for one variant and for all, `jobs` how many run at once. The output is
a JSON line for each variant that was run: its index, the `lines` (instant, logger, text), how it
`ended`, the number of `steps` that ROS time made, and whether the code `slept`. What it says is no proof: the student's code
runs in the same process.
"""

from __future__ import annotations

import builtins
import contextlib
import importlib
import importlib.abc
import importlib.util
import inspect
import json
import os
import select
import signal
import sys
import time
from collections.abc import Mapping
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any, NoReturn

SECOND = 10**9
SHOWN = 20  # the level of info()
LONGEST = 300  # characters of a line
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


class ShortRun:
    """One run of a variant, in a fork; `until` and `most` end it."""

    def __init__(self, report: int, until: int, most: int) -> None:
        self._report, self._until, self._most = report, until, most
        self._begin = self._now = SECOND
        self._idle = False
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
        """Let ROS time go on to the next timer, by `most` at most if that is not negative."""
        due = [most] if most >= 0 else []
        for timer in (timer for node in self._nodes for timer in list(node.timers)):
            with contextlib.suppress(Exception):  # (the node may have destroyed it)
                if not timer.is_canceled():
                    due.append(max(0, timer.time_until_next_call()))
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
        }
        with os.fdopen(self._report, "wb", closefd=False) as pipe:
            pipe.write(json.dumps(said).encode())
        os._exit(0)

    def play(self, module: str, function: str) -> NoReturn:
        """Call the function of the module."""
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
    until = time.monotonic() + asked["seconds"]
    while running or (waiting and time.monotonic() < until):
        while waiting and len(running) < asked["jobs"] and time.monotonic() < until:
            index, texts = waiting.pop()
            read, write = os.pipe()
            child = os.fork()
            if child == 0:
                os.setsid()
                os.close(out)
                sys.meta_path.insert(0, Sources(texts))
                run = ShortRun(write, asked["until"], asked["lines"])
                run.install()
                run.play(asked["module"], asked["function"])
            os.close(write)
            running[read] = (index, child, time.monotonic() + asked["each"], [])
        ready, _, _ = select.select(list(running), [], [], 0.05)
        for pipe in list(running):
            index, child, limit, parts = running[pipe]
            data = os.read(pipe, 100_000) if pipe in ready else b""
            if data:
                parts.append(data)
            elif pipe in ready or time.monotonic() > limit:
                with contextlib.suppress(OSError):  # (it has ended)
                    os.killpg(child, signal.SIGKILL)
                os.waitpid(child, 0)
                os.close(pipe)
                del running[pipe]
                said = b"".join(parts).decode("utf-8", "replace")
                os.write(out, f'{{"index": {index}, "seen": {said or "null"}}}\n'.encode())


if __name__ == "__main__":
    main()
