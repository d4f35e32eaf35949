"""Whether something else than spin_once, or the loop around it, ends a program."""

from __future__ import annotations

import ast

from grader.mistakes.fixes import node_order
from grader.package.source.counter import targets_of
from grader.package.source.endless import Loop
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.spinning_loop import loop_around
from grader.package.source.unreached import unreached
from grader.package.source.until_ctrl_c import parts_until_ctrl_c

ENDED_BY = ("SystemExit", "KeyboardInterrupt")
EXITS = ("exit", "quit", "sys.exit", "os._exit")


def ends_before(source: NodeSource) -> bool:
    """Whether the entry function always ends above the line with spin_once."""
    calls, main = source.calls_of("spin_once"), source.main
    found = unreached(source, calls)
    if found is not None and found.obstacle == "exits":
        return True
    returns = node_order.early_returns(main) if main is not None else []
    inside = [call for call in calls if source.function_around(call) is main]
    return bool(inside) and any(one.lineno < inside[0].lineno for one in returns)


def spins_below(source: NodeSource) -> bool:
    """Whether the function with spin_once, in no loop, also has spin below it."""
    once = source.calls_of("spin_once")
    if not once or loop_around(source, once[0]) is not None:
        return False
    around = source.function_around(once[0])
    return any(
        source.function_around(spin) is around and spin.lineno > once[0].lineno
        for spin in source.calls_of("spin")
    )


def stays_true(source: NodeSource, loop: Loop) -> bool:
    """Whether a loop goes on as long as a name is true that gets only a value which is true."""
    name = dotted(loop.test) if isinstance(loop, ast.While) else ""
    left = any(isinstance(n, ast.Break | ast.Return | ast.Raise) for n in ast.walk(loop))
    sets = [n for n in source.all_nodes if last_part(name) in map(last_part, targets_of(n))]
    values = [n.value for n in sets if isinstance(n, ast.Assign | ast.AnnAssign)]
    true = [v for v in values if isinstance(v, ast.Constant) and v.value]
    return bool(name and sets) and len(true) == len(sets) and not left


def ends_elsewhere(source: NodeSource) -> bool:
    """Whether something that runs before Ctrl+C shuts ROS down or ends the program."""
    early = parts_until_ctrl_c(source)
    raised = [n.exc for n in early if isinstance(n, ast.Raise) and n.exc is not None]
    return any(dotted(error).startswith(ENDED_BY) for error in raised) or any(
        call in early and (name in EXITS or last_part(name) in node_order.CLEANUP)
        for call, name in source.calls
    )
