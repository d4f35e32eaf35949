"""Mistakes in the order of lines: a name before its value, a clean-up before spin."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import node_order
from grader.mistakes.kind import Family
from grader.mistakes.recognised import (
    NAME_ERROR,
    OWN_ATTRIBUTE,
    Raised,
    RecognisedMistake,
    Suspect,
    of_self,
)
from grader.package.edit.tree import Replace
from grader.package.source.early_use import EarlyUse, early_use
from grader.package.source.names import calls_in, last_part, own_name
from grader.package.source.node import NodeSource
from grader.package.source.place import function_at

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


def _used_before_set(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name = match["name"]
    function = function_at(raised.module, raised.line)
    later = node_order.set_after_use(function, name) if function is not None else None
    use = node_order.first_use(function, name) if function is not None else None
    imported = {n.asname or n.name for n in raised.module.nodes if isinstance(n, ast.alias)}
    if later is None or name in raised.source.attributes or name in imported:
        return None
    found = raised.finding("used_before_set", at=use, name=name, line=str(later.lineno))
    user = node_order.first_user(function, name) if function is not None else None
    if user is None or use is None or user.lineno == use.lineno:
        return replace(found, variant="line")
    return replace(found, words={**found.words, "at": str(user.lineno)}, variant="block")


def attribute_needed_early(raised: Raised, match: re.Match[str]) -> EarlyUse | None:
    """Return where __init__ needs the missing attribute before the line that sets it."""
    if raised.line is None or not of_self(raised, match):
        return None
    return early_use(raised.source, raised.module, raised.line, match["name"])


def _attribute_late(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    early = attribute_needed_early(raised, match)
    if early is None:
        return None
    callbacks = {timer.method for timer in raised.source.timers} - {""}
    if callbacks & {own_name(call.func) for call, _ in calls_in(early.needs)}:
        return None  # (the timer calls it later: see timer.py)
    name, late = f"self.{match['name']}", str(early.sets.lineno)
    return raised.finding("attribute_set_late", at=early.needs, name=name, line=late)


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


def _not_kept(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name, source = match["name"], raised.source
    if name not in spun_names(source) or source.node_variables or source.node_class is None:
        return None
    params = {"name": name, "made": source.node_class.name}
    main = source.main
    alone = node_order.unkept(source, main)[1] if main is not None else None
    if alone is not None:
        return replace(raised.finding("node_not_kept", at=alone, params=params), variant="alone")
    user = node_order.first_user(main, name) if main is not None else None
    found = raised.finding("node_not_kept", params=params)
    line = str(user.lineno if user is not None else found.where.line if found.where else "")
    return replace(found, words={**found.words, "line": line})


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "used_before_set",
        "start",
        msg("A variable is used before it has a value"),
        msg(
            "Python runs the lines of a function from top to bottom, and {name} has no value "
            "until a line gives it one."
        ),
        msg("Move the line {name} = … above this line."),
        links.PYTHON_ERRORS,
        seen=r"UnboundLocalError: .{0,60}'(?P<name>\w{0,60}node\w{0,60})'",
        fixes={
            "line": msg("Move line {line} ({name} = …) above this line."),
            "block": msg(
                "Move line {line} ({name} = …) above line {at}, indented as far as line {at}."
            ),
        },
        raised={r"UnboundLocalError: .{0,60}'(?P<name>\w{1,120})'": _used_before_set},
        fixed_by=(node_order.moved_up,),
        examples=(
            example(
                "spin_before_node",
                Replace(
                    NODE,
                    MAIN,
                    (
                        "    rclpy.init(args=args)\n"
                        "    rclpy.spin(node)\n"
                        "    node = MyFirstNode()\n"
                        "    node.destroy_node()\n"
                        "    rclpy.try_shutdown()\n"
                    ),
                ),
                fails="run.starts",
            ),
            example(
                "node_made_after_try",
                Replace(NODE, "    node = MyFirstNode()\n", ""),
                Replace(
                    NODE,
                    "        rclpy.try_shutdown()\n",
                    "        rclpy.try_shutdown()\n    node = MyFirstNode()\n",
                ),
                fails="run.starts",
                note="the finally raises the same error once more",
            ),
        ),
    ),
    _node(
        "attribute_set_late",
        "start",
        msg("__init__ uses an attribute before the line that sets it"),
        msg(
            "Python runs the lines of __init__ from top to bottom, and {name} does not exist until "
            "line {line} has run."
        ),
        msg("Move line {line} ({name} = …) above this line."),
        links.PYTHON_CLASSES,
        raised={OWN_ATTRIBUTE: _attribute_late},
        fixed_by=(node_order.attribute_first,),
        examples=(
            example(
                "period_set_after_timer",
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "        self.create_timer(self.period_, self.timer_callback)\n"
                    "        self.period_ = 1.0\n",
                ),
                fails="run.starts",
            ),
            example(
                "set_up_before_attribute",
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "        self.set_up()\n"
                    "        self.period_ = 1.0\n"
                    "\n"
                    "    def set_up(self):\n"
                    "        self.create_timer(self.period_, self.timer_callback)\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
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
                "finally_before_spin",
                Replace(
                    NODE,
                    MAIN,
                    (
                        "    rclpy.init(args=args)\n"
                        "    node = None\n"
                        "    try:\n"
                        "        node = MyFirstNode()\n"
                        "    finally:\n"
                        "        rclpy.shutdown()\n"
                        "    rclpy.spin(node)\n"
                    ),
                ),
                fails="run.starts",
                note="the spin belongs in the try: without the line the finally would be empty",
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
    _node(
        "node_not_kept",
        "start",
        msg("The node is not assigned to a variable"),
        msg("The name {name} does not exist until a line assigns something to it."),
        msg("Write above line {line}, indented as far as that line: {name} = {made}()"),
        links.PYTHON_CLASSES,
        fixes={"alone": msg("Write in this line: {name} = {made}()")},
        raised={NAME_ERROR: _not_kept},
        fixed_by=(node_order.kept,),
        examples=(
            example(
                "node_without_variable",
                Replace(NODE, "node = MyFirstNode()", "MyFirstNode()"),
                fails="run.starts",
            ),
            example(
                "node_line_missing",
                Replace(NODE, "    node = MyFirstNode()\n", ""),
                fails="run.starts",
            ),
        ),
    ),
)
