"""rclpy.spin gets an object of the student's class that is no node, but may have one."""

from __future__ import annotations

import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import node_life
from grader.mistakes.kind import Family
from grader.mistakes.recognised import OWN_ATTRIBUTE, Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.names import dotted
from grader.package.source.spun_object import given_to_spin, node_of_class

NODE_AS_ATTRIBUTE = (
    Replace(NODE, "class MyFirstNode(Node):", "class MyFirstNode:"),
    Replace(NODE, "super().__init__('my_first_node')", "self.node = Node('my_first_node')"),
    Replace(NODE, "self.create_timer", "self.node.create_timer"),
    Replace(NODE, "self.get_logger()", "self.node.get_logger()"),
)


def _spins_object(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for a call of spin or add_node on this line, with an object of the class."""
    module = raised.module
    if f".{match['name']}" in module.line(raised.line):
        return None
    spun = given_to_spin(module.tree, raised.line, match["type"])
    if spun is None:
        return None
    classes = (c for m in raised.source.modules for c in m.classes if c.name == match["type"])
    found = next(classes, None)
    if found is None or any(dotted(base) != "object" for base in found.bases):
        return None
    attribute = node_of_class(found)
    of_own_class = "" if attribute else node_of_class(found, raised.source.class_names)
    attribute = attribute or of_own_class
    name, code = dotted(spun), raised.module.text.code(spun)
    given = name or code
    if not attribute:
        mistake = raised.finding("spin_of_object", at=spun, name=given, type=match["type"])
        return replace(mistake, variant="without")
    mistake = raised.finding(
        "spin_of_object", at=spun, name=given, type=match["type"], attribute=attribute
    )
    return replace(mistake, variant="own_class") if of_own_class else mistake


_node = Family("node", links.EXECUTORS)
KINDS = (
    _node(
        "spin_of_object",
        "spin",
        msg("An object that is not a node is used as the node"),
        msg(
            "{type} does not inherit from Node: {name} is not a node, it only has one in "
            "{name}.{attribute}. rclpy.spin calls the callbacks of a node. The error comes from "
            "rclpy's files, but the cause is what this line passes."
        ),
        msg("Write {name}.{attribute} instead of {name} in this call: that is the node."),
        whys={
            "without": msg(
                "{type} does not inherit from Node: {name} is not a node. rclpy.spin calls the "
                "callbacks of a node. The error comes from rclpy's files, but the cause is what "
                "this line passes."
            )
        },
        fixes={
            "own_class": msg("Write {name}.{attribute} instead of {name} in this call."),
            "without": msg(
                "Give rclpy.spin the node. If {type} is meant to be the node, write class {type}(Node): "
                "with super().__init__('{node_name}') in its __init__."
            ),
        },
        raised={OWN_ATTRIBUTE: _spins_object},
        fixed_by=(node_life.node_of_object,),
        examples=(
            example(
                "object_with_a_node_is_spun",
                *NODE_AS_ATTRIBUTE,
                Replace(NODE, "node.destroy_node()", "node.node.destroy_node()"),
                fails="run.starts",
            ),
            example(
                "object_with_a_node_in_executor",
                *NODE_AS_ATTRIBUTE,
                Replace(NODE, "Node('my_first_node')", "rclpy.create_node('my_first_node')"),
                Replace(NODE, "node = MyFirstNode()", "app = MyFirstNode()"),
                Replace(
                    NODE,
                    "rclpy.spin(node)",
                    "executor = rclpy.executors.SingleThreadedExecutor()\n"
                    "        executor.add_node(app)\n"
                    "        executor.spin()",
                ),
                Replace(NODE, "import rclpy\n", "import rclpy\nimport rclpy.executors\n"),
                Replace(NODE, "node.destroy_node()", "app.node.destroy_node()"),
                fails="run.starts",
            ),
            example(
                "object_that_holds_the_node_spins_itself",
                Replace(NODE, "node = MyFirstNode()", "app = App()"),
                Replace(
                    NODE,
                    "def main(",
                    "class App:\n\n    def __init__(self):\n        self.node = MyFirstNode()\n\n"
                    "    def run(self):\n        rclpy.spin(self)\n\n\ndef main(",
                ),
                Replace(NODE, "rclpy.spin(node)", "app.run()"),
                Replace(NODE, "node.destroy_node()", "app.node.destroy_node()"),
                fails="run.starts",
            ),
            example(
                "object_without_node_is_spun",
                Replace(
                    NODE,
                    "def main(",
                    "class App:\n\n    def __init__(self):\n        self.started = True\n\n\n"
                    "def main(",
                ),
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin(App())"),
                fails="run.starts",
            ),
        ),
    ),
)
