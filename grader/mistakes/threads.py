"""Mistakes in which Python's threads or its asyncio do what a timer of ROS does."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.example import LOG_LINE, NODE, STEP_LINE, example
from grader.mistakes.fixes import node_threads
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.mistakes.timer import cancel_in
from grader.package.edit.tree import Replace
from grader.package.source.imported import full_name
from grader.package.source.module import Module
from grader.package.source.names import SPINS, calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import function_at, statement_at
from grader.package.source.threads import own_threads


def _thread(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a thread that runs a method of the node which logs in a loop."""
    source = suspect.source
    if not _reaches_spin(source):
        return None
    for thread in own_threads(source):
        if source.methods.get(thread.target.name) is thread.target and thread.logs(source):
            loop = "while" if isinstance(thread.loop, ast.While) else "for"
            found = suspect.finding("thread_for_timer", thread.call, name=thread.target.name)
            words = {**found.words, "loop": loop, "line": thread.loop.lineno}
            variant = "daemon" if thread.daemon or _may_end(thread.loop) else ""
            return replace(found, variant=variant, words=words)
    return None


def _reaches_spin(source: NodeSource) -> bool:
    """Whether the program spins, and waits in __init__ for no thread that has no end."""
    init = source.methods.get("__init__")
    joins = source.calls_of("join", within=init) if init is not None else []
    waits = [join for join in joins if not join.args and not join.keywords]
    return bool(source.calls_of(*SPINS)) and not waits


def _thread_alone(suspect: Suspect) -> RecognisedMistake | None:
    """The same in a node that has no timer."""
    return _thread(suspect) if not suspect.source.timers else None


def _may_end(loop: ast.While | ast.For) -> bool:
    """Whether Ctrl+C can end a loop: its condition is not always true, as that of rclpy.ok()."""
    return not isinstance(loop, ast.While) or not isinstance(loop.test, ast.Constant)


def _lasts(suspect: Suspect) -> RecognisedMistake | None:
    """The same where Ctrl+C did not end the program."""
    found = _thread(suspect)
    line = found.where.line if found is not None and found.where is not None else None
    threads = [t for t in own_threads(suspect.source) if t.call.lineno == line]
    ends = any(thread.daemon for thread in threads)
    return found if found is None or ends else replace(found, variant="")


def _goes_on(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a thread that keeps the program running."""
    reaches = _reaches_spin(suspect.source)
    for thread in own_threads(suspect.source) if reaches else []:
        if not thread.daemon:
            return suspect.finding("thread_goes_on", thread.call, name=thread.target.name)
    return None


def _asyncio(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for asyncio in the line that needs an event loop."""
    del match
    module, line = raised.module, raised.line
    statement, function = statement_at(module, line), function_at(module, line)
    if statement is None or function is None:
        return None
    for call, _ in calls_in(statement):
        if full_name(module, call.func).startswith("asyncio."):
            written = f"{ast.unparse(call.func)}(…)"
            found = raised.finding("asyncio_used", at=statement, name=written)
            loops = [n for n in module.around(statement) if isinstance(n, ast.While | ast.For)]
            looped = bool(loops)
            sleeps = full_name(module, call.func) == "asyncio.sleep"
            variant = ("loop" if looped else "") if sleeps else "other"
            words = {**found.words, "method": function.name}
            uses = _awaited(module, function.name)
            if uses and variant in ("", "loop"):
                code = [s for s in function.body if not _is_docstring(s)]
                alone = len(loops) == 1 and loops[0].body == [statement]
                whole: ast.stmt = loops[0] if alone else statement
                other = "loop_awaited" if variant else "awaited"
                variant = "only" if code == [whole] else other
                words["lines"] = ", ".join(map(str, uses))
            elsewhere = set(ast.walk(function)) - set(ast.walk(statement))
            if not variant and any(isinstance(n, ast.Await) for n in elsewhere):
                variant = "kept"
            stop = cancel_in(raised.source, function) if variant == "loop" else None
            if stop is not None:
                words |= {"code": shown(ast.unparse(stop)), "line": stop.lineno}
                variant = "loop_cancelled"
            return replace(found, variant=variant, words=words)
    return None


def _awaited(module: Module, name: str) -> list[int]:
    """Return the lines that await a call of a function of the student's."""
    return sorted(
        n.lineno
        for n in module.nodes
        if isinstance(n, ast.Await)
        and isinstance(n.value, ast.Call)
        and last_part(dotted(n.value.func)) == name
    )


def _is_docstring(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)


IMPORT = Replace(NODE, "import rclpy\nfrom", "import threading\nimport time\nimport rclpy\nfrom")
TIMER = "        self.create_timer(1.0, self.timer_callback)\n"
LOOP = f"        while True:\n    {LOG_LINE}    {STEP_LINE}            time.sleep(1.0)\n"
THREAD = """\
        self.thread = threading.Thread(target=self.timer_callback)
        self.thread.start()
"""
_node = Family("node", links.EXECUTORS)
KINDS = (
    _node(
        "thread_for_timer",
        "spin",
        msg("A thread of your own does the work of a timer"),
        msg(
            "The thread that this line creates runs {name}() beside rclpy.spin. It does not follow "
            "ROS time: in a simulation or a replay it runs at the wrong speed. Ctrl+C ends "
            "rclpy.spin, but not this thread, and Python waits for it."
        ),
        msg(
            "Write self.create_timer({period}, self.{name}) instead of what makes and starts the "
            "thread. In {name}, delete the {loop} on line {line} and the sleep in it, "
            "and indent its other lines as far as the {loop} is indented now."
        ),
        whys={
            "daemon": msg(
                "The thread that this line creates runs {name}() beside rclpy.spin. It does not "
                "follow ROS time: in a simulation or a replay it runs at the wrong speed, and it "
                "does not stop when time stops."
            )
        },
        behind={
            "run.never_spins": _thread,
            "run.ignores_interrupt": _lasts,
            "run.by_hand": _thread,
            "run.twice": _thread_alone,
            "run.wrong_period": _thread,
        },
        fixed_by=(node_threads.timer,),
        examples=(
            example(
                "thread_logs_in_loop",
                IMPORT,
                Replace(NODE, TIMER, THREAD),
                Replace(NODE, LOG_LINE + STEP_LINE, LOOP),
                fails="run.spins",
                also={"run.interrupt": "node.thread_for_timer"},
            ),
            example(
                "daemon_thread_logs_in_loop",
                IMPORT,
                Replace(
                    NODE,
                    TIMER,
                    "        threading.Thread(target=self.timer_callback, daemon=True).start()\n",
                ),
                Replace(NODE, LOG_LINE + STEP_LINE, LOOP),
                fails="run.spins",
            ),
        ),
    ),
    _node(
        "thread_goes_on",
        "shutdown",
        msg("A thread goes on after Ctrl+C"),
        msg(
            "Ctrl+C ends rclpy.spin, but not the thread that runs {name}. Python ends only when all "
            "threads have ended, unless they are daemon threads."
        ),
        msg("Write daemon=True as the last argument of Thread."),
        behind={"run.ignores_interrupt": _goes_on},
        fixed_by=(node_threads.daemon,),
        examples=(
            example(
                "thread_beside_timer",
                IMPORT,
                Replace(
                    NODE,
                    TIMER,
                    f"{TIMER}        self.thread = threading.Thread(target=self.wait)\n"
                    "        self.thread.start()\n",
                ),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def wait(self):\n"
                    "        while True:\n"
                    "            time.sleep(1.0)\n\n"
                    "    def timer_callback",
                ),
                fails="run.interrupt",
            ),
        ),
    ),
    _node(
        "asyncio_used",
        "callback",
        msg("rclpy does not run asyncio"),
        msg(
            "{name} needs an event loop of asyncio. rclpy.spin is none: it calls an async callback, "
            "but it runs nothing of asyncio. The timer waits from one call to the next."
        ),
        msg(
            "Delete this line, and write def {method} without async. import asyncio is not needed "
            "any more."
        ),
        whys={
            "loop_cancelled": msg(
                "{name} needs an event loop of asyncio. rclpy.spin is none: it calls an async callback, "
                "but it runs nothing of asyncio. A timer that is not cancelled waits from one call to the "
                "next."
            ),
        },
        fixes={
            "loop_cancelled": msg(
                "Delete the loop around this line, this line, and {code} (line {line}). Write def {method} "
                "without async. Then the timer calls {method} again and again."
            ),
            "loop": msg(
                "Delete the loop around this line and this line, and write def {method} without "
                "async. A timer calls a method again and again: self.create_timer({period}, "
                "self.{callback})"
            ),
            "loop_awaited": msg(
                "Delete the loop around this line and this line, and write def {method} without async. "
                "Delete the word await before each call of {method} (lines: {lines}). A timer calls a "
                "method again and again: self.create_timer({period}, self.{callback})"
            ),
            "awaited": msg(
                "Delete this line, and write def {method} without async. Delete the word await before "
                "each call of {method} (lines: {lines}). import asyncio is not needed any more."
            ),
            "kept": msg("Delete this line. {method} stays async: another line in it has await."),
            "only": msg(
                "Delete {method} with its lines, and what calls it (lines: {lines}). import asyncio is not "
                "needed any more."
            ),
            "other": msg(
                "Do without asyncio: write def without async, and call the functions directly, "
                "without await and without asyncio. Delete what only waits. What must come later "
                "belongs in the callback of a timer."
            ),
        },
        raised={r"RuntimeError: no running event loop": _asyncio},
        fixed_by=(node_threads.without_asyncio,),
        examples=(
            example(
                "asyncio_sleep_after_the_timer_is_stopped",
                Replace(NODE, "import rclpy\nfrom", "import asyncio\nimport rclpy\nfrom"),
                Replace(
                    NODE, "        self.create_timer(", "        self.timer_ = self.create_timer("
                ),
                Replace(NODE, "    def timer_callback", "    async def timer_callback"),
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    "        self.timer_.cancel()\n"
                    f"        while rclpy.ok():\n    {LOG_LINE}    {STEP_LINE}"
                    "            await asyncio.sleep(1.0)\n",
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "asyncio_sleep_beside_another_await",
                Replace(NODE, "import rclpy\nfrom", "import asyncio\nimport rclpy\nfrom"),
                Replace(NODE, "    def timer_callback", "    async def write"),
                Replace(
                    NODE,
                    "    async def write",
                    "    async def timer_callback(self):\n        await self.write()\n"
                    "        await asyncio.sleep(0.1)\n\n    async def write",
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "asyncio_sleep_in_callback",
                Replace(NODE, "import rclpy\nfrom", "import asyncio\nimport rclpy\nfrom"),
                Replace(NODE, "    def timer_callback", "    async def timer_callback"),
                Replace(NODE, STEP_LINE, f"{STEP_LINE}        await asyncio.sleep(0.1)\n"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "asyncio_task_in_callback",
                Replace(NODE, "import rclpy\nfrom", "import asyncio\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "    def timer_callback(self):\n",
                    "    def timer_callback(self):\n"
                    "        asyncio.create_task(self.hello())\n\n"
                    "    async def hello(self):\n",
                ),
                fails="run.output",
                blocks=("run.logger", "run.period", "run.interrupt"),
            ),
        ),
    ),
)
