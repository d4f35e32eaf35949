"""What is read behind a dot: attributes and methods that an object does not have."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.alike import is_typo, meant_by, plain_letters
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines, node_names, node_scope, node_timer, rename
from grader.mistakes.imports import RCLPY, ROS_1
from grader.mistakes.kind import INSTEAD, Family
from grader.mistakes.recognised import OWN_ATTRIBUTE, Raised, RecognisedMistake, of_self
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.module import Module
from grader.package.source.names import dotted, own_name
from grader.package.source.node import LOG_METHODS, NODE_METHODS
from grader.package.source.node_here import node_here
from grader.package.source.place import function_at, statement_at
from grader.package.source.scopes import class_of, local_of_init, scope_of

ATTRIBUTE = (
    r"AttributeError: (?:module |type object )?'(?P<type>[\w.]{1,200})'(?: object)? has no "
    r"attribute '(?P<name>\w{1,120})'"
)
OF_FUNCTION = (
    r"AttributeError: '(?:function|method|builtin_function_or_method)' object has no attribute "
    r"'(?P<name>\w{1,120})'"
)
NO_SETTER = (
    r"property '(?P<name>\w{1,120})' of '\w{1,120}' object has no setter"
    r"|can't set attribute '(?P<old>\w{1,120})'|(?P<only>handle) cannot be modified after"
)
OWN_METHOD = r"TypeError: \w{1,120}\.(?P<name>\w{1,120})\(\) (?:takes|missing|got)"
ELSEWHERE = {
    "create_wall_timer": "create_timer",
    "createTimer": "create_timer",
    "createWallTimer": "create_timer",
    "add_timer": "create_timer",
    "advertise": "create_publisher",
    "create_subscriber": "create_subscription",
    "getLogger": "get_logger",
}
"""Methods of nodes in C++, in ROS 1 and in other libraries, and those of rclpy."""

CALLBACK = '''\
    def timer_callback(self):
        """Say hello once; the timer calls this for as long as the node spins."""
        self.get_logger().info('Hello time: ' + str(self.counter_))
        self.counter_ += 1
'''
OUTSIDE = CALLBACK.replace("\n    ", "\n").removeprefix("    ")
MAIN = '''\
def main(args=None):
    """Run the node until Ctrl+C."""
    rclpy.init(args=args)
    node = MyFirstNode()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
'''
IN_CLASS = "".join(f"    {line}" for line in MAIN.splitlines(keepends=True))


def _close_attribute(raised: Raised, name: str) -> str:
    attributes = raised.source.attributes
    plain = plain_letters(name)
    spelt = [one for one in attributes if one != name and plain_letters(one) == plain]
    return spelt[0] if len(spelt) == 1 else meant_by(name, attributes, cutoff=0.75)


def _is_only_called(raised: Raised, name: str) -> bool:
    """Whether each use of an attribute of self calls it."""
    parents = raised.module.parents
    uses = [n for n in raised.module.nodes if dotted(n) == f"self.{name}"]
    around = [(parents.get(use), use) for use in uses if isinstance(use, ast.Attribute)]
    return bool(around) and all(isinstance(a, ast.Call) and a.func is use for a, use in around)


def _is_written(raised: Raised, name: str) -> bool:
    """Whether a file of the student has a name: one that only rclpy writes is not misspelt."""
    return any(name in module.text.text for module in raised.source.modules)


def _close(raised: Raised, match: re.Match[str]) -> str:
    """Return the attribute or method that is meant; "" if none is certain."""
    name, kind = match["name"], match["type"]
    of_node = kind.endswith("Logger") or kind in ("Node", "super", *raised.source.known_classes)
    if kind == "rclpy":
        return meant_by(name, RCLPY, cutoff=0.7)
    if of_node and name in ELSEWHERE:
        return ELSEWHERE[name]
    if of_self(raised, match):
        called = _is_only_called(raised, name)
        is_node = any(c.bases for c in raised.source.family if c.name == kind)
        if not called and (not is_node or _close_attribute(raised, name)):
            return ""
        return meant_by(name, {*NODE_METHODS, *raised.source.methods}, cutoff=0.75)
    if of_node:
        return meant_by(name, (*NODE_METHODS, *LOG_METHODS), cutoff=0.7)
    suggested = re.search(r"Did you mean: '(\w{1,120})'", raised.error)
    other = suggested[1] if suggested else ""
    return other if other and is_typo(name, other) else ""


def _unknown(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """What stands before the dot has no such attribute: tell which name is meant, or what it is."""
    name, kind, line = match["name"], match["type"], raised.module.line(raised.line)
    private = name.startswith("__") and not name.endswith("__") and kind != "super"
    if private or not _is_written(raised, name) or (raised.inside and name not in line):
        return None  # (no name of the student's, or one that Python writes otherwise)
    written = _instead(raised, name, kind, line)
    if written is not None:
        params = {"name": written[0], "written": written[1]}
        return replace(raised.finding("attribute_unknown", params=params), variant="written")
    if close := _close(raised, match):
        return raised.finding("attribute_unknown", name=name, close=close)
    found = raised.finding("attribute_unknown", name=name)
    owner = class_of(raised.module, function_at(raised.module, raised.line))
    if name in NODE_METHODS and of_self(raised, match) and owner and not owner[0].bases:
        return replace(found, variant="no_node", words={**found.words, "type": kind})
    return found


def _instead(raised: Raised, name: str, kind: str, line: str) -> tuple[str, str] | None:
    """Return what the line has, and what it should have, if that is certain."""
    source, spins = raised.source, name in ("spin", "spin_once")
    node = node_here(source, raised.module, raised.line)
    of_class = kind in source.class_names and name in source.attributes
    spun = re.search(rf"(?<![\w.])(\w{{1,60}})\.{name}\(\)", line)
    object_of = spun[1] if spun and spins and kind in source.known_classes else ""
    ways = (
        (source.held_node if name in NODE_METHODS else "", f"self.{name}", f".{name}"),
        (
            node if name in {*NODE_METHODS, *ROS_1} else "",
            f"rclpy.{name}",
            f".{ROS_1.get(name, name)}",
        ),
        (node if of_class else "", f"{kind}.{name}", f".{name}"),
        (f"rclpy.{name}" if object_of else "", f"{object_of}.{name}()", f"({object_of})"),
        ("__init__" if kind == "super" and "init" in name else "", name, ""),
        (".value" if kind == "Parameter" else "", f".{name}", ""),
    )
    return next(((old, f"{owner}{new}") for owner, old, new in ways if owner and old in line), None)


def _not_set(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """No line that has run for this object gave the attribute a value."""
    name = match["name"]
    if not of_self(raised, match) or not _is_written(raised, name):
        return None
    at = raised.source.module.functions.get(name)
    if at is not None:
        return raised.finding("callback_outside", at=at, name=name)
    if name in NODE_METHODS or _close(raised, match):
        return None
    owner = class_of(raised.module, function_at(raised.module, raised.line))
    local = local_of_init(owner[0] if owner is not None else None, name)
    if local is not None:
        params = {"name": name, "written": f"self.{name}"}
        return replace(
            raised.finding("attribute_not_set", at=local, params=params), variant="local"
        )
    lines_that_set = _set_in(raised, name)
    if lines_that_set:
        params = {"name": name, "lines": ", ".join(map(str, lines_that_set))}
        return replace(raised.finding("attribute_not_set", params=params), variant="set_here")
    close = _close_attribute(raised, name)
    found = raised.finding("attribute_not_set", name=name, close=close)
    counts = close or node_names.counts(raised.source, name)
    return found if counts else replace(found, variant="value")


def _set_in(raised: Raised, name: str) -> list[int]:
    """Return the lines of the same class that set an attribute; none if another class does too."""
    module = raised.module
    here = class_of(module, function_at(module, raised.line))
    sets = [part for part in module.nodes if _sets(module, part, f"self.{name}")]
    owners = [class_of(module, scope_of(module, part)) for part in sets]
    own = [owner for owner in owners if owner is not None and here and owner[0] is here[0]]
    return sorted({getattr(part, "lineno", 0) for part in sets}) if len(own) == len(sets) else []


def _sets(module: Module, part: ast.AST, name: str) -> bool:
    """Whether a part of the file gives a name a value that does not come from itself."""
    if not isinstance(part, ast.Attribute) or not isinstance(part.ctx, ast.Store):
        return False
    around = module.parents.get(part)
    if dotted(part) != name or isinstance(around, ast.AugAssign):
        return False
    value = around.value if isinstance(around, ast.Assign | ast.AnnAssign) else part
    return value is not None and all(dotted(n) != name for n in ast.walk(value) if n is not part)


def _not_called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Something is read from a function that the line, or the one that keeps it, does not call."""
    part = _kept_in(raised, _before_dot(raised, match["name"]))
    if part is None or not dotted(part) or isinstance(part, ast.Call) or raised.inside:
        return None
    code = raised.source.module_of(part).text.code(part)
    return raised.finding("not_called", at=part, name=code, written=f"{code}()")


def _before_dot(raised: Raised, name: str) -> ast.expr | None:
    """Return what the line reads an attribute from; None if it is not one thing."""
    statement = statement_at(raised.module, raised.line)
    parts = list(ast.walk(statement)) if statement is not None else []
    found = [n.value for n in parts if isinstance(n, ast.Attribute) and n.attr == name]
    return found[0] if len(found) == 1 else None


def _kept_in(raised: Raised, part: ast.expr | None) -> ast.expr | None:
    """Return what the only line that sets a variable gives it; the part itself if there is none."""
    code = dotted(part) if part is not None else ""
    sets = [n for n in raised.source.all_nodes if isinstance(n, ast.Assign | ast.AnnAssign)]
    kept = [n.value for n in sets if code and code in targets_of(n) and n.value is not None]
    return kept[0] if len(kept) == 1 and dotted(kept[0]) else part


def _taken(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The class sets an attribute, or has a method, with the name of one of Node's."""
    given = match.groupdict()
    name = given.get("name") or given.get("old") or given.get("only") or ""
    method = raised.source.methods.get(name)
    if method is not None:
        found = raised.finding("name_taken", at=method, name=name)
        return replace(found, variant="method") if name in NODE_METHODS else None
    for part in raised.source.own_nodes:
        stored = isinstance(part, ast.Attribute) and isinstance(part.ctx, ast.Store)
        if stored and isinstance(part, ast.Attribute) and own_name(part) == name:
            return raised.finding("name_taken", at=part, name=name)
    return None


def _main_in_class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    function = raised.assignment.function
    found = node_scope.inner_function(raised.source, function)
    if match["function"] != function or found is None:
        return None
    return raised.finding("main_in_class", at=found)


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "main_in_class",
        "start",
        msg("The entry point's function is inside the class"),
        msg(
            "The entry point ends in :{function}, so Python looks for a function {function} at the "
            "top level of the module. An indented def belongs to what is above it."
        ),
        msg(
            "Move def {function}(…) and all of its lines to the left by the same number of spaces, "
            "so that def begins at the margin."
        ),
        links.DEVELOPING,
        raised={
            r"AttributeError: module '[\w.]{1,200}' has no attribute '(?P<function>\w{1,120})'": (
                _main_in_class
            )
        },
        fixed_by=(node_scope.at_margin,),
        examples=(
            example(
                "main_in_class",
                Replace(NODE, MAIN, IN_CLASS),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "callback_outside",
        "timer",
        msg("The callback is outside of the class"),
        msg("A function at the margin is not a method of the class, so self does not have it."),
        msg(
            "Put def {name} and its lines at the end of the class, indented by 4 more spaces "
            "than now."
        ),
        fixed_by=(node_scope.into_class,),
        examples=(
            example(
                "callback_outside_class",
                Replace(NODE, CALLBACK, OUTSIDE),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "name_taken",
        "class",
        msg("A name that Node uses gets another meaning"),
        msg(
            "Your class inherits {name} from Node. If you define {name} again, your own replaces "
            "the one of Node, which the node needs."
        ),
        msg(
            "Use another name for your value, for example self.{name}_, on this line and "
            "wherever you use it."
        ),
        fixes={
            "method": msg(
                "Give your method another name than {name}, here and where the timer gets it."
            ),
        },
        raised={NO_SETTER: _taken, OWN_METHOD: _taken},
        examples=(
            example(
                "attribute_timers",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.timers = []"),
                fails="run.starts",
            ),
            example(
                "callback_is_create_timer",
                Replace(NODE, "def timer_callback", "def create_timer"),
                Replace(NODE, "self.timer_callback)", "self.create_timer)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "not_called",
        "callback",
        msg("The () after a function is missing"),
        msg("{name} is a function: only calling it, with (), gives its result."),
        msg("Write {written} instead of {name}."),
        links.PYTHON_ERRORS,
        raised={OF_FUNCTION: _not_called},
        fixed_by=(lines.written,),
        examples=(
            example(
                "get_clock_not_called",
                Replace(
                    NODE, "self.counter_ += 1", "self.get_clock.now()\n        self.counter_ += 1"
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "attribute_not_set",
        "counter",
        msg("An attribute is read that __init__ did not set"),
        msg("self.{name} does not exist until a line assigns to it."),
        msg("Give it a value in __init__: self.{name} = {start}"),
        close=msg("Write self.{close} instead of self.{name}."),
        whys={
            "local": msg(
                "{name} without self. is a variable of __init__ alone: it is gone when __init__ ends, and "
                "self.{name} does not exist."
            ),
            "set_here": msg(
                "self.{name} does not exist until a line assigns to it. Line {lines} does so, but had not "
                "run for this object when Python came to this line."
            ),
        },
        fixes={
            "local": INSTEAD,
            "value": msg(
                "Give it a value in __init__, before this line can run: self.{name} = and the value that it "
                "has at the beginning. If a method is meant, write its def in the class, or its right name."
            ),
            "set_here": msg(
                "See why Python did not run line {lines} before this line: it may be further down, "
                "in a branch or a loop that was not entered, or in a function that was not called. "
                "Move it to where it always runs first, as a rule to the beginning of __init__."
            ),
        },
        raised={OWN_ATTRIBUTE: _not_set},
        fixed_by=(lines.written, rename.attribute, node_names.counter),
        examples=(
            example(
                "counter_set_by_uncalled_method",
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def setup(self):\n        self.counter_ = 0\n\n    def timer_callback",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "publisher_of_another_example",
                Replace(
                    NODE,
                    "self.counter_ += 1",
                    "self.publisher_.publish(msg)\n        self.counter_ += 1",
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "counter_not_set",
                Replace(NODE, "        self.counter_ = 0\n", ""),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "counter_without_self",
                Replace(NODE, "self.counter_ = 0", "counter_ = 0"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "counter_misspelt_in_step",
                Replace(NODE, "self.counter_ += 1", "self.counter_ = self.counter + 1"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "attribute_unknown",
        "callback",
        msg("An object has no attribute with that name"),
        msg("The object before the dot has no such attribute: {name}"),
        msg(
            "Look up what this object can do: in the documentation of its class, or in the class if "
            "it is your own. There may be another name for {name}, or no such thing. Or another "
            "object is meant."
        ),
        links.RCLPY,
        close=msg("Write {close} instead of {name}."),
        whys={
            "close": msg("Python finds a method or an attribute only by its exact name."),
            "written": msg(
                "What stands before the dot has nothing of that name. Here it is meant in another way than "
                "{name}."
            ),
            "no_node": msg(
                "{name} belongs to the node. The class {type} does not inherit from Node, so its objects "
                "do not have it."
            ),
        },
        fixes={
            "written": msg("Write {written} instead of {name}."),
            "no_node": msg(
                "Pass the node to {type} when it is made, as self in {type}(self). Keep it in its "
                "__init__(self, node) with self.node = node, and write self.node.{name} here."
            ),
        },
        seen=r"AttributeError: (?:'\w{1,120}' object|type object '\w{1,120}'|module "
        r"'[\w.]{1,200}') has no attribute '(?P<name>\w{1,120})'",
        raised={ATTRIBUTE: _unknown},
        fixed_by=(lines.written, node_timer.misspelt, rename.attribute),
        examples=(
            example(
                "create_timer_misspelt",
                Replace(NODE, "create_timer", "create_timmer"),
                fails="run.starts",
            ),
            example(
                "logger_misspelt",
                Replace(NODE, "self.get_logger().info", "self.get_loger().info"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "error_at_stop",
                Replace(NODE, "        node.destroy_node()\n", "        node.destroy()\n"),
                fails="run.interrupt",
            ),
            example(
                "loginfo_of_ros_1",
                Replace(NODE, "self.get_logger().info", "rclpy.loginfo"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "helper_without_a_node",
                Replace(NODE, "self.get_logger().info(", "Speaker().speak("),
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class Speaker:\n    def speak(self, text):\n        self.get_logger().info(text)\n\n\nclass MyFirstNode",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "node_spins_itself",
                Replace(NODE, "rclpy.spin(node)", "node.spin()"),
                fails="run.starts",
            ),
        ),
    ),
)
