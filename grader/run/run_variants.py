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
import types
from collections.abc import Mapping, Sequence
from importlib.machinery import ModuleSpec
from types import CodeType, ModuleType
from typing import Any, NoReturn

SECOND = 10**9
SHOWN = 20  # the level of info()
LONGEST = 300  # characters of a line
MOST_WAITED = 50  # steps in which a timer is due, and is not called
CPU_SECONDS = 0.4
"""The most CPU time of a variant: a run of many periods takes a quarter of it."""
WATCHED_CPU_SECONDS = 1.2
"""The same, of a variant that is watched: each call in it takes longer."""
SCENE_CPU_SECONDS = 2.5
"""The same, of a variant that runs through a scenario: a world moves with it."""
WATCHED_SCENE_CPU_SECONDS = 8.0
HANGS_SECONDS = 0.4
"""A run that uses no processor time for so long waits for what never comes."""
DOMAINS = 90
TRACE, SCENE = "grader.run.in_probe.short_trace", "grader.run.in_probe.short_scene"
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


class ShortRun:
    """One run of a variant, in a fork; `until` and `most` end it."""

    def __init__(
        self,
        report: int,
        until: int,
        most: int,
        watched: Any = None,
        traced: Any = None,
        scene: Any = None,
    ) -> None:
        self._report, self._until, self._most = report, until, most
        self._watched, self._traced, self._scene = watched, traced, scene
        self._begin = self._now = SECOND
        self._idle = False
        self._waited = 0  # steps since a timer is due
        self._nodes: list[Any] = []
        self._lines: list[tuple[int, str, str]] = []
        self._steps = 0
        self._slept = False
        self._used = 0.0  # s of processor time, and of waiting for it, at the last look

    def install(self) -> None:
        """Put ROS time, the logger and what waits under control."""
        from rclpy.impl.implementation_singleton import rclpy_implementation as ros  # noqa: PLC0415 - of the fork alone
        from rclpy.node import Node  # noqa: PLC0415
        from rclpy.timer import Rate  # noqa: PLC0415

        make, write, run = Node.__init__, ros.rclpy_logging_rcutils_log, self

        def make_node(node: Any, *args: Any, **named: Any) -> None:
            make(node, *args, **named)
            if run._is_at_work():
                return
            node.get_clock()._set_ros_time_is_active(True)
            run._nodes.append(node)
            run._set_clocks()
            if run._scene is not None:
                run._scene.made(node)

        def log(severity: Any, name: Any, message: Any, *rest: Any) -> None:
            write(severity, name, message, *rest)
            if run._is_at_work():
                return
            if run._scene is not None:
                run._scene.logged(int(severity), str(name), str(message))
            if int(severity) >= SHOWN:
                if run._traced is not None:
                    run._traced.logs(sys._getframe(1))
                run._lines.append((run._now - run._begin, str(name), str(message)[:LONGEST]))
            if len(run._lines) >= run._most:
                run.end("lines")

        class WaitSet(ros.WaitSet):  # type: ignore[misc]
            """Waits without wall time."""

            def wait(self, nanoseconds: int) -> None:
                if run._is_at_work():
                    super().wait(0)
                    return
                if run._idle:
                    run._step(nanoseconds)
                super().wait(run._patience())
                run._idle = not any(self.get_ready_entities(kind) for kind in READY)

        Node.__init__ = make_node
        ros.rclpy_logging_rcutils_log = log
        ros.WaitSet = WaitSet
        Rate.sleep = lambda _: run.end("waits")
        time.sleep = lambda seconds: run._sleep(float(seconds))
        builtins.input = lambda *_: run.end("waits")

    def _is_at_work(self) -> bool:
        """Whether it is the scene that uses ROS, and not the student's code."""
        return self._scene is not None and self._scene.is_working

    def _patience(self) -> int:
        """Return how long (ns) to wait for what the scene has sent."""
        if self._scene is None:
            return 0
        patience, self._scene.patience = self._scene.patience, 0
        return int(patience)

    def _step(self, most: int) -> None:
        """Let ROS time go on to the next timer, by `most` at most if that is not negative.

        A timer that stays due is one that nothing calls: its node is not spun.
        """
        while not self._acts():
            left = self._timers_left()
            is_due = 0 in left and self._waited < MOST_WAITED
            self._waited = self._waited + 1 if is_due else 0
            due = [*([most] if most >= 0 else []), *(each for each in left if each or is_due)]
            timer = min(due, default=None)
            if self._scene is not None:
                due += [max(0, at + self._begin - self._now) for at in self._scene.next()]
            if not due:
                self.end("waits")
            self._steps += 1
            self._pass(min(due))
            is_for_node = timer is not None and timer <= min(due)
            if self._scene is None or not self._scene.is_plain or is_for_node:
                return

    def _acts(self) -> bool:
        """Let the scene do what is due; return whether the node may have something to do then."""
        if self._scene is None:
            return False
        acted = bool(self._scene.act())
        if not acted and self._now - self._begin >= self._scene.limit:
            self.end("time")
        return acted

    def _timers_left(self) -> list[int]:
        """Return how long (ns) it takes until each timer is due."""
        left = []
        for timer in (timer for node in self._nodes for timer in list(node.timers)):
            with contextlib.suppress(Exception):  # (the node may have destroyed it)
                if not timer.is_canceled():
                    left.append(max(0, timer.time_until_next_call()))
        return left

    def _pass(self, nanoseconds: int) -> None:
        self._now += max(0, nanoseconds)
        if self._scene is not None:
            self._scene.now = self._now - self._begin
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
            "scene": self._scene.found() if self._scene is not None else None,
        }
        with os.fdopen(self._report, "wb", closefd=False) as pipe:
            pipe.write(json.dumps(said).encode())
        os._exit(0)

    def _look_whether_it_hangs(self) -> None:
        """End a run that has used no processor time, and waited for none, since the last look."""
        used = time.process_time() + waited(os.getpid())
        if used - self._used < HANGS_SECONDS / 20:
            self.end("hangs")
        self._used = used

    def play(self, module: str, function: str) -> NoReturn:
        """Call the function of the module."""
        signal.signal(signal.SIGPROF, lambda *_: self.end("killed"))
        is_plain = self._watched is None and self._traced is None
        seconds = CPU_SECONDS if is_plain else WATCHED_CPU_SECONDS
        if self._scene is not None:
            seconds = SCENE_CPU_SECONDS if is_plain else WATCHED_SCENE_CPU_SECONDS
            self._scene.install(self._traced)
        signal.setitimer(signal.ITIMER_PROF, seconds)
        signal.signal(signal.SIGALRM, lambda *_: self._look_whether_it_hangs())
        signal.setitimer(signal.ITIMER_REAL, HANGS_SECONDS, HANGS_SECONDS)
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
            if self._traced is not None:
                self._traced.raised(error)
            trace, line = error.__traceback__, 0
            while trace is not None:
                line, trace = trace.tb_lineno, trace.tb_next
            self.end(f"{type(error).__name__} {line}")
        self.end("returned")


def preload(*, checked: bool) -> None:
    """Import what every node needs, so that no fork has to.

    If it is `checked`, a field of a message that gets a value of another type raises an exception.
    """
    os.environ["ROS_PYTHON_CHECK_FIELDS"] = "1" if checked else ""
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


def load(modules: Sequence[Sequence[str]]) -> None:
    """Make modules of their names and texts; others import them by their names."""
    for name, text in modules:
        module = types.ModuleType(name)
        sys.modules[name] = module
        exec(compile(text, name, "exec"), module.__dict__)  # noqa: S102 - the grader's own text


def run_of(asked: dict[str, Any], index: int, report: int) -> ShortRun:
    """Return the run of a variant, with what it is watched by."""
    trace = sys.modules[TRACE]
    watched = asked["watched"][index]
    conditions = [trace.Watched(**each) for each in asked["conditions"]]
    traced = trace.Traced(asked["traced"], conditions) if asked["traced"] else None
    plan, scene, until = asked.get("scene"), None, asked["until"]
    if plan:
        world = sys.modules[plan["world"]].World if plan["world"] else None
        plan = {**plan, **(plan["others"][index] if plan["others"] else {})}
        scene, until = sys.modules[SCENE].Scene(plan, world), plan["end"]
    return ShortRun(
        report, until, asked["lines"], trace.Watched(**watched) if watched else None, traced, scene
    )


def main() -> None:
    """Run the variants that the standard input asks for."""
    asked = json.load(sys.stdin)
    out, nothing = os.dup(1), os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1, 2):
        os.dup2(nothing, stream)
    preload(checked=bool(asked.get("checked")))
    load(asked["modules"])
    sys.argv = ["node", *asked.get("words", ())]
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
                # (else two runs at the same time hear each other)
                os.environ["ROS_DOMAIN_ID"] = str(1 + index % DOMAINS)
                sys.meta_path.insert(0, Sources(texts))
                run = run_of(asked, index, write)
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
                with contextlib.suppress(OSError):  # (it has ended)
                    os.killpg(child, signal.SIGKILL)
                _, _, usage = os.wait4(child, 0)
                used = usage.ru_utime + usage.ru_stime
                left -= used if pipe in ready else max(used, asked["each"])
                os.close(pipe)
                del running[pipe]
                said = b"".join(parts).decode("utf-8", "replace")
                answer = f'{{"index": {index}, "seen": {said or "null"}, "used": {used:.3f}}}\n'
                os.write(out, answer.encode())


if __name__ == "__main__":
    main()
