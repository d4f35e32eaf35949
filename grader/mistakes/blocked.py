"""Mistakes in which a callback waits for ever: for a lock that is held, for another thread, for input."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass, replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG_LINE, NODE, STEP_LINE, example
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.endless import methods_run_by
from grader.package.source.imported import full_name
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import NodeSource

LOCK = "threading.Lock"
QUEUES = ("queue.Queue", "queue.LifoQueue", "queue.PriorityQueue", "queue.SimpleQueue")
WAITS = {
    "get": QUEUES,
    "join": ("threading.Thread", "queue.Queue"),
    "wait": ("threading.Event", "threading.Condition", "threading.Barrier"),
    "accept": ("socket.socket", "socket.create_server"),
    "recv": ("socket.socket",),
}
"""By the name of a method that waits: what has it. With an argument it can end by itself."""


def _made(source: NodeSource, *kinds: str) -> dict[str, ast.Call]:
    """Return the names that once get an object of these kinds, with the call that makes it."""
    sets: dict[str, list[ast.expr | None]] = {}
    for node in source.all_nodes:
        if isinstance(node, ast.Assign | ast.AnnAssign):
            for target in node.targets if isinstance(node, ast.Assign) else [node.target]:
                sets.setdefault(dotted(target), []).append(node.value)
    return {
        name: values[0]
        for name, values in sets.items()
        if len(values) == 1
        and isinstance(values[0], ast.Call)
        and name
        and full_name(source.module_of(values[0]), values[0].func) in kinds
    }


def _callbacks(source: NodeSource) -> list[Function]:
    """Return the methods that the timers call, and those that these call."""
    called = [source.methods[t.method] for t in source.timers if t.method in source.methods]
    inner = [method for each in called for method in methods_run_by(source, each)]
    return list(dict.fromkeys([*called, *inner]))


@dataclass(frozen=True)
class _Taken:
    """A place that takes a lock; `block` has the lines that hold it, none after acquire()."""

    lock: str
    at: ast.expr
    block: list[ast.stmt]


def _taken(part: ast.AST, locks: dict[str, ast.Call]) -> Iterator[_Taken]:
    """Yield the places that take a lock, and wait for it as long as it is held."""
    for node in ast.walk(part):
        if isinstance(node, ast.With):
            for item in node.items:
                if dotted(item.context_expr) in locks:
                    yield _Taken(dotted(item.context_expr), item.context_expr, node.body)
        elif isinstance(node, ast.Call) and not node.args and not node.keywords:
            owner, _, method = dotted(node.func).rpartition(".")
            if method == "acquire" and owner in locks:
                yield _Taken(owner, node, [])


def _locked_twice(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a lock that is taken again by what runs while the same thread holds it."""
    source, locks = suspect.source, _made(suspect.source, LOCK)
    for callback in _callbacks(source) if locks and suspect.stuck else ():
        for outer in _taken(callback, locks):
            held = [*outer.block, *(m for s in outer.block for m in methods_run_by(source, s))]
            inner = [t for part in held for t in _taken(part, locks) if t.lock == outer.lock]
            if inner and not _releases(outer):
                return _twice(suspect, outer, inner[0], locks[outer.lock])
    return None


def _releases(taken: _Taken) -> bool:
    calls = [name for statement in taken.block for _, name in calls_in(statement)]
    return f"{taken.lock}.release" in calls


def _twice(suspect: Suspect, outer: _Taken, inner: _Taken, made: ast.Call) -> RecognisedMistake:
    module = suspect.source.module_of(made)
    name = module.text.code(made.func)
    found = suspect.finding(
        "lock_twice",
        inner.at,
        name=outer.lock,
        line=outer.at.lineno,
        old=name,
        written=name.removesuffix("Lock") + "RLock",
    )
    words = {**found.words, "at": made.lineno}
    return replace(found, words=words, variant="" if "." in name else "imported")


def _kept(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a lock that a callback takes in each call, and that nothing releases."""
    source, locks = suspect.source, _made(suspect.source, LOCK)
    released = {name.rpartition(".")[0] for _, name in source.calls if name.endswith(".release")}
    for callback in _callbacks(source) if locks and suspect.stuck else ():
        for taken in _taken(callback, locks):
            ends = isinstance(callback.body[-1], ast.Return)
            if not taken.block and taken.lock not in released and not ends:
                words = {"name": taken.lock, "method": callback.name}
                return suspect.finding("lock_kept", taken.at, **words)
    return None


def _waits(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a call in a callback that waits without a limit."""
    source = suspect.source
    for callback in _callbacks(source) if suspect.stuck else ():
        for call, name in calls_in(callback):
            owner, _, method = name.rpartition(".")
            endless = method in WAITS and (method == "recv" or not call.args + call.keywords)
            if endless and owner in _made(source, *WAITS[method]):
                found = suspect.finding("callback_waits", call, name=f"{name}()")
                words = {**found.words, "written": f"{owner}.get_nowait()"}
                return replace(found, words=words, variant="queue" if method == "get" else "")
            if name == "input" or full_name(source.module_of(call), call.func) == "signal.pause":
                return suspect.finding("callback_waits", call, name=f"{last_part(name)}()")
    return None


IMPORT = Replace(NODE, "import rclpy\nfrom", "import queue\nimport threading\nimport rclpy\nfrom")
START = "        self.counter_ = 0\n"
WITH = "        with self.lock:\n"
_node = Family("node", links.EXECUTORS)
KINDS = (
    _node(
        "lock_twice",
        "callback",
        msg("The callback waits for a lock that it holds itself"),
        msg(
            "Line {line} takes {name}, and this line takes it again before it is released. A Lock can "
            "be taken only once, also by the same thread: the callback waits here for ever."
        ),
        msg(
            "Write {written} instead of {old} in line {at}: a thread can take an RLock that it holds "
            "already."
        ),
        fixes={
            "imported": msg(
                "Write {written} instead of {old} in line {at} and in the import: a thread can take "
                "an RLock that it holds already."
            )
        },
        behind=dict.fromkeys(("run.stops", "run.no_lines"), _locked_twice),
        examples=(
            example(
                "lock_taken_twice",
                IMPORT,
                Replace(NODE, START, f"{START}        self.lock = threading.Lock()\n"),
                Replace(
                    NODE,
                    f"{LOG_LINE}{STEP_LINE}",
                    f"{WITH}    {LOG_LINE}            self.step()\n\n    def step(self):\n"
                    f"{WITH}    {STEP_LINE}",
                ),
                fails="run.output",
                blocks=("run.period",),
            ),
        ),
    ),
    _node(
        "lock_kept",
        "callback",
        msg("A lock is taken in each call of the callback, and never released"),
        msg(
            "This line takes {name}, and nothing releases it. In the next call, the callback waits "
            "here for ever."
        ),
        msg("Write {name}.release() as the last line of {method}."),
        behind=dict.fromkeys(("run.stops", "run.no_lines"), _kept),
        examples=(
            example(
                "lock_not_released",
                IMPORT,
                Replace(NODE, START, f"{START}        self.lock = threading.Lock()\n"),
                Replace(NODE, LOG_LINE, f"        self.lock.acquire()\n{LOG_LINE}"),
                fails="run.output",
                blocks=("run.period",),
            ),
        ),
    ),
    _node(
        "callback_waits",
        "callback",
        msg("A callback waits, and does not return"),
        msg(
            "{name} waits here until something comes, without a limit. As long as the callback does "
            "not return, ROS can call no other one, and the timer cannot call this one again."
        ),
        msg(
            "Delete this line: a callback must return without waiting, and the timer calls it again. If a "
            "line below needs what this line waits for, log the counter there instead."
        ),
        fixes={
            "queue": msg(
                "Write {written} instead of {name}, in a try with except queue.Empty: return. Then the "
                "callback uses what is there, and does not wait."
            )
        },
        behind=dict.fromkeys(("run.stops", "run.no_lines"), _waits),
        deletes=("",),
        examples=(
            example(
                "queue_in_callback",
                IMPORT,
                Replace(NODE, START, f"{START}        self.jobs = queue.Queue()\n"),
                Replace(NODE, STEP_LINE, f"{STEP_LINE}        self.jobs.get()\n"),
                fails="run.output",
                blocks=("run.period",),
            ),
        ),
    ),
)
