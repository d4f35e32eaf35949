"""Mistakes in spinning the node, and in how it ends."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, SILENT, example
from grader.mistakes.fixes import lines, node_life
from grader.mistakes.fixes.node_executor import executors_of
from grader.mistakes.kind import Family
from grader.mistakes.placeholders import placeholder_values
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Edit, Replace
from grader.package.source.counter import parts_of_callback
from grader.package.source.endless import Loop
from grader.package.source.module import Function, Module
from grader.package.source.names import SPINS as SPIN_CALLS
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import NodeSource

ENDED_BY = ("SystemExit", "KeyboardInterrupt")
EXITS = (
    *("exit", "quit", "sys.exit", "os._exit"),
    *("rclpy.shutdown", "rclpy.try_shutdown", "self.destroy_node"),
)
PAUSES = ("sleep", "sleep_for", "sleep_until")


def executors(suspect: Suspect) -> set[str]:
    """Return the variables of executors."""
    return executors_of(suspect.source)


def _missing(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a node without spin: none at all, one without (), or spin_once in no loop."""
    source, node = suspect.source, placeholder_values(suspect.assignment, suspect.source)["node"]
    spins = _spins(source)
    if any(_does_spin(source.module_of(n), n) for n in spins):
        return None
    added = [name.rpartition(".")[0] for _, name in source.calls if name.endswith(".add_node")]
    owner = next((name for name in added if name in executors(suspect)), "")
    wanted = f"{owner}.spin()" if owner else f"rclpy.spin({node})"
    if not spins:
        return suspect.finding("spin_missing", suspect.place_of_function, wanted=wanted)
    module = source.module_of(spins[0])
    around = module.parents.get(spins[0])
    at = around if isinstance(around, ast.Call) else spins[0]
    found = suspect.finding("spin_missing", at, name=module.text.code(at), written=wanted)
    return replace(found, variant="written")


def _spins(source: NodeSource) -> list[ast.Attribute | ast.Name]:
    every = [n for module in source.known_modules for n in module.nodes]
    named = [n for n in every if isinstance(n, ast.Attribute | ast.Name)]
    return [n for n in named if last_part(dotted(n)) in SPIN_CALLS]


def _does_spin(module: Module, name: ast.expr) -> bool:
    """Whether it may spin: in a loop, or passed to what does, or called and not spin_once."""
    around = module.parents.get(name)
    called = isinstance(around, ast.Call) and around.func is name
    once = called and last_part(dotted(name)) == "spin_once"
    loops = any(isinstance(n, ast.While | ast.For) for n in module.around(name))
    return loops or not (once or isinstance(around, ast.Expr))


def _sleep_loop(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the loop that does a timer's work: it logs, publishes or calls a function, and sleeps."""
    source = suspect.source
    for loop in (n for n in source.all_nodes if isinstance(n, ast.While | ast.For)):
        pauses = [call for call, name in calls_in(loop) if last_part(name) in PAUSES]
        if pauses and _works(source, loop):
            return suspect.finding("sleep_loop", pauses[0])
    return None


def _works(source: NodeSource, loop: Loop) -> bool:
    """Whether a loop logs, publishes, calls a function of the student's, or prints until Ctrl+C."""
    names = {last_part(name) for _, name in calls_in(loop)}
    own = {node.name for node in source.all_nodes if isinstance(node, Function)}
    prints = isinstance(loop, ast.While) and "print" in names
    return bool(names & (own | {"publish"}) or source.logs(loop) or prints)


def _exits(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a line of the callback, or of a method that it calls, which ends the node."""
    parts = parts_of_callback(suspect.source)
    ends = (n for part in parts for n in ast.walk(part) if isinstance(n, ast.Raise | ast.Call))
    for node in ends:
        raised = dotted(node.exc) if isinstance(node, ast.Raise) and node.exc else ""
        called = dotted(node.func) if isinstance(node, ast.Call) else ""
        if not raised.startswith(ENDED_BY) and called not in EXITS:
            continue
        around = suspect.source.module_of(node).around(node)
        if not any(isinstance(n, ast.ExceptHandler) or getattr(n, "orelse", ()) for n in around):
            return suspect.finding("exits", node, name=called or raised)
    return None


IMPORT = Replace(NODE, "import rclpy\nfrom", "import threading\nimport time\nimport rclpy\nfrom")
SPINS = """\
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
"""
LOOPS = """\
    try:
        while rclpy.ok():
            time.sleep(1.0)
            node.timer_callback()
    except KeyboardInterrupt:
        pass
    rclpy.try_shutdown()
"""
BESIDE = "    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()\n"


def _loop(new: str = LOOPS) -> tuple[Edit, ...]:
    """Return the edits that write a loop instead of the timer and of spin."""
    no_timer = Replace(NODE, "self.create_timer(1.0, self.timer_callback)", "pass")
    return IMPORT, no_timer, Replace(NODE, SPINS, new)


_node = Family("node", links.EXECUTORS)
KINDS = (
    _node(
        "sleep_loop",
        "spin",
        msg("A loop with sleep() does the work of a timer"),
        msg(
            "A loop with sleep does not follow ROS time, also if another thread spins the node: in a "
            "simulation or a replay it runs at the wrong speed. Where it keeps the node from spinning, "
            "no callback runs, and ros2 param list gets no answer."
        ),
        msg(
            "Put what the loop does into a method, without the sleep, if it is not in one already. Call "
            "the method with a timer that __init__ creates: self.create_timer({period}, "
            "self.{callback}). Delete the loop, and spin the node with rclpy.spin({node}) in {function}."
        ),
        behind={"run.never_spins": _sleep_loop},
        examples=(
            example(
                "sleep_loop",
                *_loop(),
                fails="run.spins",
                note="right lines and times, but no callback is ever called",
            ),
            example(
                "sleep_loop_beside_spin",
                *_loop(BESIDE + LOOPS),
                fails="run.spins",
                note="it answers, but ROS time stands still",
            ),
        ),
    ),
    _node(
        "spin_missing",
        "spin",
        msg("Nothing that ros2 run starts spins the node"),
        msg("rclpy.spin(node) waits and calls the callbacks when they are due, until Ctrl+C."),
        msg("Call {wanted} in {function}, after creating the node."),
        whys={
            "written": msg(
                "rclpy.spin(node) waits and calls the callbacks when they are due, until Ctrl+C. "
                "{name} does not: spin_once handles one callback, and a name without () calls nothing."
            ),
        },
        fixes={"written": msg("Write {written} instead of {name}.")},
        behind={
            "run.exits_at_once": _missing,
            "run.never_spins": _missing,
            "run.ended_early": _missing,
        },
        fixed_by=(lines.written, node_life.spin),
        examples=(
            example(
                "timer_and_sleep_loop",
                Replace(NODE, "import rclpy\nfrom", "import time\nimport rclpy\nfrom"),
                Replace(NODE, SPINS, LOOPS.replace("            node.timer_callback()\n", "")),
                fails="run.spins",
                blocks=("run.output", *SILENT),
                note="the timer is there, and nothing calls it",
            ),
            example(
                "executor_not_spun",
                Replace(
                    NODE,
                    "rclpy.spin(node)",
                    "executor = SingleThreadedExecutor()\n        executor.add_node(node)",
                ),
                Replace(
                    NODE,
                    "from rclpy.node",
                    "from rclpy.executors import SingleThreadedExecutor\nfrom rclpy.node",
                ),
                fails="run.starts",
            ),
            example(
                "spin_missing",
                Replace(NODE, "        rclpy.spin(node)\n", "        pass\n"),
                fails="run.starts",
            ),
            example(
                "spin_once",
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin_once(node)"),
                fails="run.starts",
                note="one line on the wall clock; none under use_sim_time, because the first message on /clock is the only callback that it runs",
            ),
            example(
                "spin_not_called",
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "exits",
        "spin",
        msg("The node ends itself"),
        msg("{name} ends the program; a node runs until Ctrl+C."),
        msg("Delete this line, and an if above it that has no other line."),
        behind=dict.fromkeys(("run.ended_early", "run.stops", "run.exits_at_once"), _exits),
        fixed_by=(lines.deleted,),
        examples=(
            example(
                "three_then_exit",
                Replace(
                    NODE,
                    "self.counter_ += 1",
                    (
                        "self.counter_ += 1\n"
                        "        if self.counter_ == 3:\n"
                        "            raise SystemExit"
                    ),
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "shutdown_not_called",
        "shutdown",
        msg("The () after rclpy.shutdown is missing"),
        msg("A function's name alone does nothing; only calling it does."),
        msg("Write rclpy.try_shutdown()."),
        links.RCLPY,
    ),
)
