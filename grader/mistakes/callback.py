"""The mistake of a function that does not return, so that ROS can call nothing else."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.ends import ends
from grader.mistakes.example import NODE, example
from grader.mistakes.kind import Family
from grader.mistakes.recognised import FromSource, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.endless import Loop, endless_loop, methods_run_by, sleeps_in
from grader.package.source.module import Function
from grader.package.source.names import SPINS, calls_in, dotted, last_part
from grader.package.source.node import NodeSource


def _called_by_ros(source: NodeSource) -> Iterator[Function]:
    """Yield the callbacks of the node, __init__, and the methods that these call."""
    names = [timer.method for timer in source.timers] + [end.method for end in ends(source)]
    for name in dict.fromkeys([*names, "__init__"]):
        method = source.methods.get(name)
        if method is not None:
            yield method
            yield from methods_run_by(source, method)


def _waiting_call(source: NodeSource, method: Function) -> ast.Call | None:
    """Return the call in a method that waits for what only spinning brings, or for the keyboard."""
    init = source.methods.get("__init__")
    at_start = init is not None and method in (init, *methods_run_by(source, init))
    for call, name in calls_in(method):
        owner, _, last = name.rpartition(".")
        rate = last == "sleep" and (owner.endswith("create_rate()") or owner.startswith("self."))
        of_client = last == "call" and owner.startswith("self.")
        spins = last in SPINS and bool(owner) and not at_start
        if name == "input" or spins or rate or of_client:
            return call
    return None


def _waits(*, sleeps: bool = False) -> FromSource:
    """Return a function that looks for what keeps a function from returning."""

    def found(suspect: Suspect) -> RecognisedMistake | None:
        source = suspect.source
        for method in _called_by_ros(source):
            at = _waiting_call(source, method) or _loop(source, method)
            slept = sleeps_in(source, method) if sleeps else []
            if at is None and not slept:
                continue
            at = at if at is not None else slept[0]
            name = f"{dotted(at.func)}()" if isinstance(at, ast.Call) else _word(at)
            asks = name.endswith(".call()")
            written = name.replace(".call()", ".call_async()") if asks else ""
            found = suspect.finding("waits_inside", at, name=name, written=written)
            words = {**found.words, "method": method.name}
            return replace(found, words=words, variant="asks" if asks else "")
        return None

    return found


def _loop(source: NodeSource, method: Function) -> Loop | None:
    """Return the loop of a method without an end, or one that waits until a future is done."""
    loop = endless_loop(source, method)
    if loop is not None and (isinstance(loop, ast.While) or source.logs(loop)):
        return loop
    loops = (n for n in ast.walk(method) if isinstance(n, ast.While))
    done = (n for n in loops if any(last_part(name) == "done" for _, name in calls_in(n.test)))
    return next(done, None)


def _word(loop: ast.AST) -> str:
    return "while" if isinstance(loop, ast.While) else "for"


_node = Family("node", links.EXECUTORS)
KINDS = (
    _node(
        "waits_inside",
        "callback",
        msg("A function does not return, so ROS calls no other"),
        msg(
            "A node runs one callback at a time. While {method} waits at this {name}, nothing else of the "
            "node runs: no timer, no subscription, no answer to a call, and nothing spins it."
        ),
        msg(
            "Remove {name} from {method}. Let a timer do the repeating and the waiting. If the program needs "
            "the answer to a call there, give add_done_callback() a function that gets it."
        ),
        fixes={
            "asks": msg(
                "Write {written} instead of {name}: it sends the request and does not wait. If the program "
                "needs the answer, give add_done_callback() a function that gets it."
            )
        },
        behind={
            "run.stuck": _waits(sleeps=True),
            **dict.fromkeys(
                ("run.never_spins", "run.no_lines", "run.stops", "run.no_node", "run.twice"),
                _waits(),
            ),
        },
        examples=(
            example(
                "asks_in_callback",
                Replace(NODE, "self.counter_ += 1", "self.counter_ += 1\n        input('more?')"),
                fails="run.output",
                blocks=("run.period",),
            ),
            example(
                "rate_in_callback",
                Replace(
                    NODE,
                    "self.counter_ += 1",
                    "self.counter_ += 1\n        self.create_rate(1.0).sleep()",
                ),
                fails="run.output",
                blocks=("run.period",),
            ),
            example(
                "while_in_constructor",
                Replace(NODE, "import rclpy\nfrom", "import rclpy\nfrom time import sleep\nfrom"),
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "        while True:\n            self.timer_callback()\n"
                    "            sleep(1.0)\n",
                ),
                fails="run.spins",
            ),
        ),
    ),
)
