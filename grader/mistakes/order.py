"""Mistakes in the order of lines: a name before its value, a clean-up before spin."""

from __future__ import annotations

import re

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import node_order
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.names import calls_in, last_part
from grader.package.source.node import NodeSource

MAIN = """\
    rclpy.init(args=args)
    node = MyFirstNode()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
"""


def _cleanup(source: NodeSource) -> tuple[str, int] | None:
    """Return what is called before spin in the entry function, and its line."""
    found = node_order.early_cleanup(source)
    if found is None:
        return None
    for _, name in calls_in(found[0]):
        if last_part(name) in node_order.CLEANUP:
            return f"{name}()", found[0].lineno
    return None


def _cleaned_up_first(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    source = raised.source
    early, found = node_order.early_cleanup(source), _cleanup(source)
    if early is None or found is None or source.main is None:
        return None
    name, line = found
    in_main = raised.line is None or line <= raised.line <= (source.main.end_lineno or line)
    if not in_main and "NotInitializedException" not in raised.error:
        return None
    return raised.finding("cleanup_early", at=early[0], name=name)


def _cleans_up_first(suspect: Suspect) -> RecognisedMistake | None:
    early, found = node_order.early_cleanup(suspect.source), _cleanup(suspect.source)
    if early is None or found is None:
        return None
    return suspect.finding("cleanup_early", early[0], name=found[0])


def spun_names(source: NodeSource) -> set[str]:
    """Return the variables that the code uses as the node: it spins or destroys them."""
    found: set[str] = set()
    for call, name in source.calls:
        if last_part(name) in (*node_order.SPINS, "add_node") and call.args:
            found.add(getattr(call.args[0], "id", ""))
        elif last_part(name) == "destroy_node":
            found.add(name.removesuffix(".destroy_node"))
    return found - {"", "self"}


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "cleanup_early",
        "shutdown",
        msg("The clean-up comes before spin"),
        msg(
            "After {name}, the node or ROS is shut down, and no line below can use it any more. Clean-up "
            "is the last thing that a program does."
        ),
        msg("Move {name} to the end of {function}, below the line that spins."),
        links.RCLPY,
        raised={r"\w": _cleaned_up_first},
        behind={
            "run.never_spins": _cleans_up_first,
            "run.exits_at_once": _cleans_up_first,
            "run.no_node": _cleans_up_first,
            "run.no_lines": _cleans_up_first,
        },
        fixed_by=(node_order.cleanup_last,),
        examples=(
            example(
                "shutdown_before_spin",
                Replace(
                    NODE,
                    MAIN,
                    (
                        "    rclpy.init(args=args)\n"
                        "    node = MyFirstNode()\n"
                        "    rclpy.shutdown()\n"
                        "    rclpy.spin(node)\n"
                    ),
                ),
                fails="run.starts",
                note="no attribute '_sigint_gc', says an exception that Python ignores",
            ),
            example(
                "destroyed_before_spin",
                Replace(
                    NODE,
                    "    node = MyFirstNode()\n",
                    "    node = MyFirstNode()\n    node.destroy_node()\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
