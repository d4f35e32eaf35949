"""Mistakes in the order of lines: a name before its value, a clean-up before spin."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import Value, msg
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
from grader.package.source.names import calls_in, dotted, last_part, own_name
from grader.package.source.node import NodeSource
from grader.package.source.place import function_at

SPIN = "        rclpy.spin(node)\n"
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
    if later is None or name in raised.source.attributes:
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
    source = raised.source
    early = node_order.early_cleanup(source)
    found = _cleanup(source)
    if early is None or found is None or source.main is None:
        return _init_ends_it(raised, match)
    name, line = found
    last = source.main.end_lineno or line
    in_main = raised.line is None or line <= raised.line <= last
    if not in_main and "NotInitializedException" not in raised.error:
        return None
    return _with_later(source, raised.finding("cleanup_early", at=early[0], name=name))


def _cleans_up_first(suspect: Suspect) -> RecognisedMistake | None:
    early = node_order.early_cleanup(suspect.source)
    found = _cleanup(suspect.source)
    if early is not None and _leaves_before(suspect.source, early[0].lineno):
        return None  # (what leaves the function is the cause, and finally runs on the way out)
    if early is None or found is None:
        return _init_ends(suspect) or _by_method(suspect)
    return _with_later(suspect.source, suspect.finding("cleanup_early", early[0], name=found[0]))


def _leaves_before(source: NodeSource, line: int) -> bool:
    """Whether the entry function has a return above a line."""
    nodes = ast.walk(source.main) if source.main is not None else ()
    own = [n for n in nodes if isinstance(n, ast.Return) and n.lineno < line]
    return any(source.function_around(n) is source.main for n in own)


def _with_later(source: NodeSource, found: RecognisedMistake) -> RecognisedMistake:
    """Say what is to be done with the line: it depends on its block and on the lines after spin."""
    inside, first = node_order.spin_into_try(source), node_order.spin_first(source)
    later, others = node_order.cleaned_up_later(source), node_order.other_cleanups(source)
    alone = node_order.is_alone(source)
    words: dict[str, Value] = {}
    variant = "alone" if alone else ""
    if inside is not None:
        around, spin = inside
        last = around.body[-1]
        variant = "into_try"
        words = {
            "line": str(spin.lineno),
            "statement": source.module_of(spin).text.code(spin),
            "written": str(last.end_lineno or last.lineno),
        }
    elif first is not None:
        variant = "spin_first"
        code = source.module_of(first[1]).text.code(first[1])
        words = {"line": str(first[1].lineno), "statement": code}
    elif later is not None:
        variant = "again_alone" if alone else "again"
        words = {"line": str(later.lineno)}
    elif others and not alone:
        variant = "several"
        words = {"line": ", ".join(str(s.lineno) for s in others[:3])}
    return replace(found, variant=variant, words={**found.words, **words})


def _in_init(source: NodeSource) -> tuple[ast.Expr, str] | None:
    """Return the line of __init__ that always runs and shuts rclpy down or destroys the node."""
    init = source.method("__init__")
    for statement in init.body if init is not None else []:
        call = statement.value if isinstance(statement, ast.Expr) else None
        name = dotted(call.func) if isinstance(call, ast.Call) else ""
        ends = name in ("rclpy.shutdown", "rclpy.try_shutdown", "self.destroy_node")
        if isinstance(statement, ast.Expr) and ends:
            return statement, f"{name}()"
    return None


def _by_method(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a call of an own function, above spin, that always cleans up."""
    source = suspect.source
    called = node_order.cleanup_by_call(source)
    if called is None:
        return None
    statement, function, name = called
    words = {"method": function.name, "line": str(function.lineno)}
    found = suspect.finding("cleanup_early", statement, name=f"{name}()")
    return replace(found, words={**found.words, **words}, variant="method")


def _init_ends_it(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    found = _in_init(raised.source)
    if found is None or not (raised.line is None or raised.line > found[0].lineno):
        return None
    return replace(raised.finding("cleanup_early", at=found[0], name=found[1]), variant="in_init")


def _init_ends(suspect: Suspect) -> RecognisedMistake | None:
    found = _in_init(suspect.source)
    if found is None:
        return None
    return replace(suspect.finding("cleanup_early", found[0], name=found[1]), variant="in_init")


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
        whys={
            "into_try": msg(
                "The block of finally runs as soon as the try ends: before line {line}. After {name} "
                "the node has no timer any more that spin could serve."
            ),
        },
        fixes={
            "again": msg("Delete this line: line {line} cleans up after rclpy.spin."),
            "again_alone": msg(
                "Write pass instead of this line: line {line} cleans up after rclpy.spin."
            ),
            "alone": msg(
                "Write pass instead of this line, and write {name} at the end of {function}, below "
                "the line that spins."
            ),
            "into_try": msg(
                "Move line {line} ({statement}) into the try, below line {written}. Indent it like "
                "line {written}. The finally then cleans up after it."
            ),
            "spin_first": msg(
                "Move line {line} ({statement}) above this line: the clean-up comes after it."
            ),
            "several": msg(
                "Move this line and the other lines that clean up ({line}) to the end of {function}, "
                "below the line that spins."
            ),
            "method": msg(
                "Move this line below the line that spins: it calls {method} (line {line}), which "
                "cleans up."
            ),
            "in_init": msg(
                "Delete this line. If {function} has no clean-up below the line that spins, write it "
                "there."
            ),
        },
        raised={r"\w": _cleaned_up_first},
        behind={
            "run.never_spins": _cleans_up_first,
            "run.exits_at_once": _cleans_up_first,
            "run.no_node": _cleans_up_first,
            "run.no_lines": _cleans_up_first,
        },
        fixed_by=(node_order.cleanup_last, node_order.not_in_init),
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
                "shutdown_before_node",
                Replace(
                    NODE,
                    "    node = MyFirstNode()\n",
                    "    rclpy.shutdown()\n    node = MyFirstNode()\n",
                ),
                fails="run.starts",
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
                "shutdown_in_init",
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "        self.create_timer(1.0, self.timer_callback)\n"
                    "        rclpy.shutdown()\n",
                ),
                fails="run.starts",
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
            example(
                "clean_up_in_try",
                Replace(NODE, SPIN, f"        node.destroy_node()\n{SPIN}"),
                fails="run.starts",
            ),
            example(
                "shutdown_in_try",
                Replace(NODE, SPIN, f"        rclpy.shutdown()\n{SPIN}"),
                fails="run.starts",
                note="rclpy.spin raises the error of an executor that does not exist any more",
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
