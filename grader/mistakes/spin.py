"""Mistakes in spinning the node, and in how it ends."""

from __future__ import annotations

import ast

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import node_life
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.names import dotted, last_part

EXITS = ("exit", "quit", "sys.exit", "os._exit")
SPIN = msg("rclpy.spin(node) waits and calls the callbacks when they are due, until Ctrl+C.")


def _spins(suspect: Suspect) -> bool:
    names = {last_part(name) for _, name in suspect.source.calls}
    return bool(names & {"spin", "spin_until_future_complete"})


def _once_only(suspect: Suspect) -> RecognisedMistake | None:
    return None if _spins(suspect) else _once(suspect)


def _once(suspect: Suspect) -> RecognisedMistake | None:
    for call, name in suspect.source.calls:
        if last_part(name) == "spin_once":
            return suspect.finding("spin_once", call)
    return None


def _not_called(suspect: Suspect) -> RecognisedMistake | None:
    if _spins(suspect):
        return None
    for node in suspect.source.all_nodes:
        named = node.value if isinstance(node, ast.Expr) else None
        if isinstance(named, ast.Attribute) and named.attr == "spin":
            return suspect.finding("spin_not_called", named)
    return None


def _missing(suspect: Suspect) -> RecognisedMistake | None:
    if _spins(suspect):
        return None
    return suspect.finding("spin_missing", suspect.place_of_function)


def _exits(suspect: Suspect) -> RecognisedMistake | None:
    for node in suspect.source.all_nodes:
        if not isinstance(node, ast.Raise | ast.Call):
            continue
        raised = dotted(node.exc) if isinstance(node, ast.Raise) and node.exc else ""
        called = dotted(node.func) if isinstance(node, ast.Call) else ""
        if raised.startswith(("SystemExit", "KeyboardInterrupt")) or called in EXITS:
            return suspect.finding("exits", node, name=called or raised)
    return None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "spin_once",
        "spin",
        msg("spin_once is called instead of spin"),
        msg("rclpy.spin_once handles one callback and returns; then {function} ends."),
        msg("Write rclpy.spin({node})."),
        links.EXECUTORS,
        behind={"run.exits_at_once": _once_only, "run.ended_early": _once},
        fixed_by=(node_life.spin,),
        examples=(
            example(
                "spin_once",
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin_once(node)"),
                fails="run.starts",
                note="one line on the wall clock; none under use_sim_time, because the first message on /clock is the only callback that it runs",
            ),
            example(
                "spins_until_three",
                Replace(
                    NODE,
                    "rclpy.spin(node)",
                    "while node.counter_ < 3:\n            rclpy.spin_once(node)",
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "spin_not_called",
        "spin",
        msg("The () after rclpy.spin is missing"),
        msg("A function's name alone does nothing; only calling it does."),
        msg("Write rclpy.spin({node})."),
        links.EXECUTORS,
        behind={"run.exits_at_once": _not_called},
        fixed_by=(node_life.spin,),
        examples=(
            example(
                "spin_not_called",
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "spin_missing",
        "spin",
        msg("rclpy.spin is not called"),
        SPIN,
        msg("Call rclpy.spin(node) in {function}, after creating the node."),
        links.EXECUTORS,
        behind={"run.exits_at_once": _missing},
        fixed_by=(node_life.spin,),
        examples=(
            example(
                "spin_missing",
                Replace(NODE, "        rclpy.spin(node)\n", "        pass\n"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "exits",
        "spin",
        msg("The node ends itself"),
        msg("{name} ends the program; a node runs until Ctrl+C."),
        msg("Remove {name}."),
        links.EXECUTORS,
        behind={"run.ended_early": _exits},
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
