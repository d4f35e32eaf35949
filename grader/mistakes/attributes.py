"""Mistakes in what is read behind a dot: attributes and methods that an object does not have.

These come late: their patterns also match errors that have a more precise cause.
"""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.alike import is_typo, meant_by, plain_letters
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines, node_names, node_timer, rename
from grader.mistakes.imports import RCLPY
from grader.mistakes.kind import Family
from grader.mistakes.recognised import OWN_ATTRIBUTE, Raised, RecognisedMistake, of_self
from grader.mistakes.scope import NODE_METHODS
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.module import Module
from grader.package.source.names import dotted, last_part
from grader.package.source.node import LOG_METHODS
from grader.package.source.node_here import node_here
from grader.package.source.place import function_at
from grader.package.source.scopes import class_of, scope_of

ATTRIBUTE = (
    r"AttributeError: (?:module |type object )?'(?P<type>[\w.]{1,200})'(?: object)? has no "
    r"attribute '(?P<name>\w{1,120})'"
)


ELSEWHERE = {
    "create_wall_timer": "create_timer",
    "createTimer": "create_timer",
    "createWallTimer": "create_timer",
    "add_timer": "create_timer",
    "advertise": "create_publisher",
    "create_subscriber": "create_subscription",
    "getLogger": "get_logger",
    "logger": "get_logger",
}
"""Methods of nodes in C++, in ROS 1 and in other libraries, and those of rclpy."""
SET_ELSEWHERE = msg(
    "self.{name} does not exist until a line assigns to it. Line {lines} does so, but had not run "
    "for this object when Python came to this line."
)


SET_IN_METHOD = msg(
    "self.{name} does not exist until a line assigns to it. Line {lines} does so, in the method "
    "{method}, which had not run for this object when Python came to this line."
)


def _close_attribute(raised: Raised, name: str) -> str:
    attributes = raised.source.attributes
    spelt = [
        other
        for other in attributes
        if other != name and plain_letters(other) == plain_letters(name)
    ]
    return spelt[0] if len(spelt) == 1 else meant_by(name, attributes, cutoff=0.75)


def _close_method(raised: Raised, match: re.Match[str]) -> str:
    """Return the method that is meant: of the node, of rclpy or of the logger."""
    name = match["name"]
    if name == "logger" and not _is_only_called(raised, name):
        return ""  # (get_logger would lack its ())
    if _is_of_node(raised, match["type"]) and name in ELSEWHERE:
        return ELSEWHERE[name]
    if of_self(raised, match):
        own = [c for c in raised.source.family if c.name == match["type"] and c.bases]
        if not own and not _is_only_called(raised, name):
            return ""
        if _close_attribute(raised, name) and not _is_only_called(raised, name):
            return ""
        return meant_by(name, {*NODE_METHODS, *raised.source.methods}, cutoff=0.75)
    if match["type"] == "rclpy":
        return meant_by(name, RCLPY, cutoff=0.7)
    if not _is_of_node(raised, match["type"]):
        return ""
    return meant_by(name, (*NODE_METHODS, *LOG_METHODS), cutoff=0.7)


def _is_only_called(raised: Raised, name: str) -> bool:
    """Whether each use of an attribute of self calls it."""
    parents = raised.module.parents
    uses = [n for n in raised.module.nodes if dotted(n) == f"self.{name}"]
    around = [(parents.get(use), use) for use in uses if isinstance(use, ast.Attribute)]
    return bool(around) and all(isinstance(a, ast.Call) and a.func is use for a, use in around)


def _is_of_node(raised: Raised, kind: str) -> bool:
    """Whether an object of this type can have the methods of a node or of a logger."""
    logger = kind.endswith("Logger")
    return logger or kind in ("Node", "super") or kind in raised.source.known_classes


def _is_written(raised: Raised, name: str) -> bool:
    """Whether a file of the student has a name: one that only rclpy writes is not misspelt."""
    return any(name in module.text.text for module in raised.source.modules)


def _method_misspelt(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if not _is_written(raised, match["name"]):
        return None
    close = _close_method(raised, match)
    return raised.finding("method_misspelt", name=match["name"], close=close) if close else None


def _not_set(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """No line that has run for this object gave the attribute a value."""
    name = match["name"]
    if not of_self(raised, match) or name in raised.module.functions:
        return None
    if name in NODE_METHODS and (found := _without_node(raised, name)) is not None:
        return found
    close = _close_attribute(raised, name)
    elsewhere = _set_elsewhere(raised, name) or _without_self(raised, name)
    if elsewhere is not None:
        return elsewhere
    found = raised.finding("attribute_not_set", name=name, close=close)
    if close or node_names.counts(raised.source, name):
        return found
    if _is_only_called(raised, name):
        return replace(found, variant="no_method")
    return replace(found, variant="object" if _is_object(raised, name) else "value")


def _set_elsewhere(raised: Raised, name: str) -> RecognisedMistake | None:
    """Lines of the same class set the attribute, but none of them ran before this one."""
    module = raised.module
    here = class_of(module, function_at(module, raised.line))
    sets = [part for part in module.nodes if _sets(module, part, f"self.{name}")]
    owners = [class_of(module, scope_of(module, part)) for part in sets]
    methods = [owner[1] for owner in owners if owner is not None and here and owner[0] is here[0]]
    if not sets or len(methods) != len(sets):
        return None
    rows = ", ".join(map(str, sorted({getattr(part, "lineno", 0) for part in sets})))
    found = raised.finding("attribute_not_set", params={"name": name, "lines": rows})
    if len(set(methods)) != 1 or methods[0].name == "__init__":
        return replace(found, variant="set_here")
    return replace(found, variant="set_later", words={**found.words, "method": methods[0].name})


def _without_self(raised: Raised, name: str) -> RecognisedMistake | None:
    """A variable of __init__ that no line of it reads has the name of the attribute."""
    here = class_of(raised.module, function_at(raised.module, raised.line))
    inits = [s for s in here[0].body if getattr(s, "name", "") == "__init__"] if here else []
    inside = [part for init in inits for part in ast.walk(init)]
    sets = [n for n in inside if isinstance(n, ast.Assign) and list(targets_of(n)) == [name]]
    uses = [n for n in inside if isinstance(n, ast.Name) and n.id == name]
    if len(sets) != 1 or len(uses) != 1:
        return None
    params = {"name": name, "written": f"self.{name}"}
    found = raised.finding("attribute_not_set", at=sets[0], params=params)
    return replace(found, variant="local", words={**found.words, "line": str(raised.line)})


def _sets(module: Module, part: ast.AST, name: str) -> bool:
    """Whether a part of the file gives a name a value that does not come from itself."""
    if not isinstance(part, ast.Attribute) or not isinstance(part.ctx, ast.Store):
        return False
    around = module.parents.get(part)
    if dotted(part) != name or isinstance(around, ast.AugAssign):
        return False
    value = around.value if isinstance(around, ast.Assign | ast.AnnAssign) else part
    return value is not None and all(dotted(n) != name for n in ast.walk(value) if n is not part)


def _is_object(raised: Raised, name: str) -> bool:
    """Whether the code uses something of the attribute: a method or another attribute."""
    parents = raised.module.parents
    uses = [n for n in raised.module.nodes if dotted(n) == f"self.{name}"]
    return any(isinstance(parents.get(use), ast.Attribute) for use in uses)


def _unknown(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """What stands before the dot has no such attribute: tell what it is, or which name is meant."""
    name, kind, line = match["name"], match["type"], raised.module.line(raised.line)
    private = name.startswith("__") and not name.endswith("__") and kind != "super"
    if private or (raised.inside and name not in line):
        return None  # (no name of the student's, or one that Python writes otherwise)
    node = node_here(raised.source, raised.module, raised.line)
    written = _meant(raised, match, node)
    if written is not None:
        params = {"name": written[0], "written": written[1]}
        return replace(raised.finding("attribute_unknown", params=params), variant="written")
    variant = {"NoneType": "none", "rclpy": "module"}.get(kind, "")
    if variant:
        return replace(raised.finding("attribute_unknown", name=name), variant=variant)
    if kind == "Parameter" and not name.lower().startswith("get_param"):
        found = raised.finding("attribute_unknown", name=f".{name}", written=".value")
        return replace(found, variant="parameter")
    return _similar(raised, match)


def _similar(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    """Python's own suggestion, if it is the same name with a typing mistake."""
    name, kind = match["name"], last_part(match["type"])
    suggested = re.search(r"Did you mean: '(\w{1,120})'", raised.error)
    other = suggested[1] if suggested and _is_written(raised, name) else ""
    if other and is_typo(name, other):
        return raised.finding("attribute_unknown", name=name, close=other)
    found = raised.finding("attribute_unknown", name=name)
    found = replace(found, words={**found.words, "type": kind})
    own = [c for m in raised.source.modules for c in m.classes if c.name == kind]
    if own and "type object" in match[0]:
        return replace(found, variant="class_kept")
    if len(own) == 1 and own[0] not in raised.source.family:
        words = {**found.words, "line": str(own[0].lineno)}
        return replace(found, variant="own_class", words=words)
    if other:
        return replace(found, variant="similar", words={**found.words, "other": other})
    return found


NO_NODE = msg(
    "{name} belongs to the node. The class {type} does not inherit from Node, so its objects "
    "do not have it."
)


def _without_node(raised: Raised, name: str) -> RecognisedMistake | None:
    """A method of the node is called on an object that is no node."""
    held = raised.source.held_node
    if held:
        params = {"name": f"self.{name}", "written": f"{held}.{name}"}
        found = raised.finding("attribute_not_set", params=params)
        return replace(found, variant="held", words={**found.words, "held": held})
    owner = class_of(raised.module, function_at(raised.module, raised.line))
    if owner is None or owner[0].bases:
        return None
    found = raised.finding("attribute_not_set", name=name)
    return replace(found, variant="no_node", words={**found.words, "type": owner[0].name})


def _meant(raised: Raised, match: re.Match[str], node: str) -> tuple[str, str] | None:
    """Return what the line has, and what it should have, if that is certain."""
    name, kind, line = match["name"], match["type"], raised.module.line(raised.line)
    if kind == "super" and "init" in name:
        return name, "__init__"
    if kind == "rclpy" and name in NODE_METHODS and node:
        given = re.search(rf"\brclpy\.{name}\((?:self\b|node\b|['\"])", line)
        return None if given else (f"rclpy.{name}", f"{node}.{name}")
    if kind in raised.source.class_names and name in raised.source.attributes and node:
        code = f"{kind}.{name}"
        return (code, f"{node}.{name}") if code in line else None
    spun = re.search(rf"(?<![\w.])(\w{{1,60}})\.{name}\(\)", line)
    if kind in raised.source.known_classes and name in ("spin", "spin_once") and spun:
        return spun[0], f"rclpy.{name}({spun[1]})"
    return None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "method_misspelt",
        "class",
        msg("A method or attribute of the node is misspelt"),
        msg("Python finds a method or an attribute only by its exact name."),
        msg("Write {close} instead of {name}."),
        links.RCLPY,
        raised={ATTRIBUTE: _method_misspelt},
        fixed_by=(node_timer.misspelt, rename.attribute),
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
        ),
    ),
    _node(
        "attribute_not_set",
        "counter",
        msg("An attribute is read that __init__ did not set"),
        msg("self.{name} does not exist until a line assigns to it."),
        msg("Give it a value in __init__: self.{name} = {start}"),
        links.PYTHON_CLASSES,
        close=msg("Write self.{close} instead of self.{name}."),
        fixes={
            "no_node": msg(
                "Pass the node to {type} when it is made, as self in {type}(self). Keep it in its "
                "__init__(self, node) with self.node = node, and write self.node.{name} here."
            ),
            "held": msg(
                "Write {written} instead of {name}. Do the same wherever self. stands before another "
                "method of the node."
            ),
            "value": msg(
                "Give it a value in __init__, above the line that creates the timer: self.{name} = "
                "and the value that it has at the beginning."
            ),
            "set_here": msg(
                "See why Python did not run line {lines} before this line: it may be further down, "
                "in a branch or a loop that was not entered, or in a function that was not called. "
                "Move it to where it always runs first, as a rule to the beginning of __init__."
            ),
            "local": msg("Write {written} instead of {name} on that line."),
            "set_later": msg(
                "Set self.{name} in __init__ too, before this line can run, or call {method} "
                "before this line can run."
            ),
            "no_method": msg(
                "If {name} is a method of yours, write its def in the class. If it is one of ROS, look it up "
                "in the documentation of your distro: it may have another name there, as from one release "
                "to the next. If nothing needs the call, delete it."
            ),
            "object": msg(
                "Delete this line if it belongs to another example. If the node needs it, create "
                "self.{name} in __init__ first."
            ),
        },
        whys={
            "local": msg(
                "Without self., {name} is a variable of __init__ alone. Line {line} reads {written}, which no line "
                "sets."
            ),
            "no_node": NO_NODE,
            "held": msg(
                "This class is no node: it does not inherit from Node. Its node is {held}, which has "
                "this method."
            ),
            "set_here": SET_ELSEWHERE,
            "set_later": SET_IN_METHOD,
            "no_method": msg("self.{name}() calls a method, and the class has no method {name}."),
        },
        raised={OWN_ATTRIBUTE: _not_set},
        fixed_by=(lines.written, node_names.close_attribute, node_names.counter),
        examples=(
            example(
                "logger_in_an_attribute_that_is_not_set",
                Replace(NODE, "self.get_logger().info", "self.logger_.info"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "period_attribute_not_set",
                Replace(NODE, "create_timer(1.0", "create_timer(self.timer_period"),
                fails="run.starts",
            ),
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
                "node_kept_in_an_attribute",
                Replace(NODE, "class MyFirstNode(Node)", "class MyFirstNode"),
                Replace(
                    NODE, "super().__init__('my_first_node')", "self.node = Node('my_first_node')"
                ),
                Replace(NODE, "node = MyFirstNode()", "node = MyFirstNode().node"),
                fails="run.starts",
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
            "written": msg(
                "What stands before the dot has nothing of that name. Here it is meant in another way than "
                "{name}."
            ),
            "parameter": msg(
                "get_parameter returns an object of the type Parameter. Its value is in .value, or in "
                "get_parameter_value()."
            ),
            "none": msg(
                "A value on that line is None: nothing was assigned to it, or a function returned "
                "nothing."
            ),
            "class_kept": msg(
                "Without (), {type} is the class itself. Only an object of it has what its __init__ sets."
            ),
            "module": msg("The module rclpy has nothing with the name {name}."),
        },
        fixes={
            "written": msg("Write {written} instead of {name}."),
            "similar": msg(
                "Look up what a {type} can do. It has the similar name {other}: write that only if "
                "it does what you want."
            ),
            "own_class": msg(
                "Write a name that the class {type} has (line {line}), or let its __init__ set "
                "self.{name}."
            ),
            "parameter": msg("Write {written} instead of {name} behind get_parameter(…)."),
            "none": msg("Find the line that should give it its value, and see what that does."),
            "module": msg(
                "Compare the name with the documentation of rclpy. Many of a node's functions are "
                "methods of the node: self.name(…) in the class."
            ),
        },
        seen=r"AttributeError: (?:'\w{1,120}' object|type object '\w{1,120}'|module "
        r"'[\w.]{1,200}') has no attribute '(?P<name>\w{1,120})'",
        raised={ATTRIBUTE: _unknown},
        fixed_by=(lines.written,),
        examples=(
            example(
                "create_timer_of_rclpy_with_the_node",
                Replace(NODE, "self.create_timer(1.0,", "rclpy.create_timer(self, 1.0,"),
                fails="run.starts",
            ),
            example(
                "logger_of_rclpy",
                Replace(NODE, "self.get_logger()", "rclpy.get_logger('my_first_node')"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "class_for_self",
                Replace(NODE, "self.counter_ += 1", "MyFirstNode.counter_ += 1"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "class_kept_for_an_object",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class Texts:\n    def __init__(self):\n        self.text = 'Hello time: '\n\n\nclass MyFirstNode",
                ),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.texts = Texts"),
                Replace(NODE, "'Hello time: ' + str", "self.texts.text + str"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "node_spins_itself",
                Replace(NODE, "rclpy.spin(node)", "node.spin()"),
                fails="run.starts",
            ),
            example(
                "init_of_super_half",
                Replace(NODE, "super().__init__(", "super().__init("),
                fails="run.starts",
            ),
        ),
    ),
)
