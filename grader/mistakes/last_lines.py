"""Mistakes below spin: lines that wait, so that the program does not end after Ctrl+C."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import last_lines, lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.endless import goes_on, sleeps_in
from grader.package.source.module import Function
from grader.package.source.names import SPINS, called_name, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of
from grader.package.source.thread_timers import row_ranges
from grader.package.source.until_ctrl_c import after_spin, parts_until_ctrl_c

LONG = 3.0  # seconds; after a shorter sleep the program has ended when it is looked at
FOREVER = ("wait", "pause")
ASKS = ("input", "sys.stdin.readline", "sys.stdin.read")


def _waits(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a line that waits when spin has ended: it keeps the program from ending."""
    source = suspect.source
    for node in _late_nodes(source):
        waits = _what_waits(source, node)
        if waits:
            return _told(suspect, node, waits)
    return None


def _late_nodes(source: NodeSource) -> Iterator[ast.AST]:
    """Yield the parts of the lines after spin, and of the functions that only they call."""
    early = parts_until_ctrl_c(source)
    functions = {n.name: n for n in source.own_nodes if isinstance(n, Function)}
    for statement in after_spin(source):
        for node in ast.walk(statement):
            yield node
            called = functions.get(called_name(node)) if isinstance(node, ast.Call) else None
            if called is not None and not early.intersection(called.body):
                yield from (part for line in called.body for part in ast.walk(line))


def _what_waits(source: NodeSource, node: ast.AST) -> str:
    """Return the name of what waits in a part of the source; "" if it does not wait for long."""
    if isinstance(node, ast.While):
        spins = [n for n in ast.walk(node) if isinstance(n, ast.Call) and called_name(n) in SPINS]
        return "while" if goes_on(node) and dotted(node.test) != "rclpy.ok()" and not spins else ""
    if not isinstance(node, ast.Call):
        return ""
    name = dotted(node.func)
    if name in ASKS or (called_name(node) in FOREVER and not (node.args or node.keywords)):
        return f"{called_name(node)}()"
    if node in sleeps_in(source, node) and node.args:
        seconds = node.args[0].value if isinstance(node.args[0], ast.Constant) else None
        long = isinstance(seconds, int | float) and seconds >= LONG
        looped = any(isinstance(n, ast.For) for n in source.module_of(node).around(node))
        return f"{name}()" if long or looped else ""
    return ""


def _told(suspect: Suspect, node: ast.AST, waits: str) -> RecognisedMistake | None:
    """Say what is to be deleted: a line, its loop, or the line and those with its variable."""
    source = suspect.source
    module = source.module_of(node)
    around = [node, *module.around(node)]
    statement = next((n for n in around if isinstance(n, ast.stmt)), None)
    function = next((n for n in around if isinstance(n, Function)), None)
    if statement is None:
        return None
    late = {n for line in after_spin(source) for n in ast.walk(line)}
    own = [part for part in around if part in late or function is not source.main]
    loops = [part for part in own if isinstance(part, ast.While | ast.For)]
    found = suspect.finding("waits_at_end", statement, name=waits)
    if loops:
        last = loops[-1].end_lineno or loops[-1].lineno
        word = "while" if isinstance(loops[-1], ast.While) else "for"
        words = {**found.words, "loop": word, "line": f"{loops[-1].lineno}-{last}"}
        alone = len(block_of(module, loops[-1])) == 1
        return replace(found, words=words, variant="loop_alone" if alone else "loop")
    names = {name.partition(".")[0] for name in targets_of(statement)}
    uses = sorted(
        {
            n.lineno
            for n in ast.walk(function or module.tree)
            if isinstance(n, ast.Name) and n.id in names and n.lineno != statement.lineno
        }
    )
    if isinstance(statement, ast.Expr | ast.Assign) and not uses:
        alone = len(block_of(module, statement)) == 1
        return replace(found, variant="alone" if alone else "")
    words = {**found.words, "line": ", ".join(map(str, uses))}
    return replace(found, words=words, variant="used" if uses else "part")


LOOP = msg(
    "Ctrl+C ends the call that spins. Then the lines below it run, and the {loop} (line {line}) "
    "waits: the program goes on."
)


def _started_again(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for the call of the entry function in its own lines below spin."""
    del match
    call = _own_call(raised.source)
    if call is None:
        return None
    found = raised.finding("starts_again", at=call)
    return replace(found, variant="alone" if _is_alone(raised.source, call) else "")


def _starts_again(suspect: Suspect) -> RecognisedMistake | None:
    call = _own_call(suspect.source)
    if call is None:
        return None
    found = suspect.finding("starts_again", call)
    return replace(found, variant="alone" if _is_alone(suspect.source, call) else "")


def _is_alone(source: NodeSource, call: ast.Call) -> bool:
    """Whether a block has nothing but the line of a call."""
    module = source.module_of(call)
    statement = next((n for n in module.around(call) if isinstance(n, ast.stmt)), None)
    return statement is not None and len(block_of(module, statement)) == 1


def _own_call(source: NodeSource) -> ast.Call | None:
    main = source.main
    for node in (n for line in after_spin(source) for n in ast.walk(line)):
        if isinstance(node, ast.Call) and main is not None and dotted(node.func) == main.name:
            return node
    return None


def _needs_ros(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for a line below spin that asks something of ROS, which Ctrl+C has shut down."""
    del match
    source = raised.source
    late = {n for line in after_spin(source) for n in ast.walk(line)}
    for call, name in source.calls:
        if call in late and call.lineno == raised.line and last_part(name) in OF_ROS:
            statement = next(
                (n for n in source.module_of(call).around(call) if isinstance(n, ast.stmt)), None
            )
            if statement is None:
                return None
            found = raised.finding("needs_ros", at=call, name=f"{name}()")
            rows = _uses(source, statement)
            words = {**found.words, "line": row_ranges(tuple(rows))}
            return replace(found, words=words, variant="used" if rows else "")
    return None


def _uses(source: NodeSource, statement: ast.stmt) -> list[int]:
    """Return the lines that use what a statement assigns, with a loop that does nothing else."""
    module, function = source.module_of(statement), source.function_around(statement)
    names = {name.partition(".")[0] for name in targets_of(statement)} - {"self"}
    rows: set[int] = set()
    for node in ast.walk(function or module.tree):
        used = isinstance(node, ast.Name) and node.id in names
        if not used or not isinstance(node, ast.Name) or node.lineno == statement.lineno:
            continue
        own = next((n for n in module.around(node) if isinstance(n, ast.stmt)), None)
        loop = module.parents.get(own) if own is not None else None
        if isinstance(loop, ast.While | ast.For) and len(loop.body) == 1:
            own = loop
        if own is not None:
            rows |= set(range(own.lineno, (own.end_lineno or own.lineno) + 1))
    return sorted(rows)


OF_ROS = (
    *("create_rate", "create_publisher", "create_subscription", "create_service"),
    *("create_client", "create_node", "Node"),
)
_node = Family("node", links.EXECUTORS)
KINDS = (
    _node(
        "starts_again",
        "shutdown",
        msg("The program starts again after Ctrl+C"),
        msg(
            "Ctrl+C ends the call that spins. Then the lines below it run, and this line calls "
            "{function} again."
        ),
        msg("Delete this line."),
        links.EXECUTORS,
        fixes={"alone": msg("Write pass instead of this line.")},
        raised={"RecursionError": _started_again},
        behind={"run.ignores_interrupt": _starts_again},
        fixed_by=(lines.deleted,),
        examples=(
            example(
                "main_calls_itself",
                Replace(
                    NODE,
                    "        rclpy.try_shutdown()\n",
                    "        rclpy.try_shutdown()\n        main()  # start again\n",
                ),
                fails="run.interrupt",
            ),
        ),
    ),
    _node(
        "needs_ros",
        "shutdown",
        msg("A line below spin needs ROS, which Ctrl+C has shut down"),
        msg(
            "Ctrl+C ends the call that spins and shuts ROS down. The lines below it run only "
            "after that, and then {name} raises an error."
        ),
        msg("Delete this line."),
        links.EXECUTORS,
        fixes={"used": msg("Delete this line, and what uses its value (line {line}).")},
        raised={"the given context is not valid": _needs_ros},
        deletes=("", "used"),
        examples=(
            example(
                "rate_after_spin",
                Replace(
                    NODE,
                    "    finally:\n",
                    "    rate = node.create_rate(1)\n"
                    "    while rclpy.ok():\n"
                    "        rate.sleep()\n"
                    "    try:\n"
                    "        pass\n"
                    "    finally:\n",
                ),
                fails="run.interrupt",
            ),
        ),
    ),
    _node(
        "waits_at_end",
        "shutdown",
        msg("A line below spin waits, so the program does not end"),
        msg(
            "Ctrl+C ends the call that spins. Then the lines below it run, and {name} in this line "
            "waits: the program goes on."
        ),
        msg("Delete this line."),
        links.EXECUTORS,
        whys={"loop": LOOP, "loop_alone": LOOP},
        fixes={
            "alone": msg("Write pass instead of this line."),
            "loop": msg("Delete the whole {loop} (line {line})."),
            "loop_alone": msg("Write pass instead of the whole {loop} (line {line})."),
            "used": msg("Delete this line, and what uses its value (line {line})."),
            "part": msg("Remove {name} from this line."),
        },
        behind={"run.ignores_interrupt": _waits},
        fixed_by=(last_lines.without_wait,),
        examples=(
            example(
                "asks_after_spin",
                Replace(
                    NODE,
                    "        rclpy.try_shutdown()\n",
                    "        rclpy.try_shutdown()\n        input('Press Enter to close ...')\n",
                ),
                fails="run.interrupt",
            ),
            example(
                "sleeps_on_after_spin",
                Replace(NODE, "import rclpy\nfrom", "import time\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "        rclpy.try_shutdown()\n",
                    "        rclpy.try_shutdown()\n"
                    "    while True:\n"
                    "        time.sleep(0.5)  # stay open\n",
                ),
                fails="run.interrupt",
            ),
        ),
    ),
)
