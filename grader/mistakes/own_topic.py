"""The mistake of a node that publishes on one topic and listens on another."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.ends import ends
from grader.mistakes.example import LOG_LINE, NODE, SILENT, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.names import last_part
from grader.package.source.node import NodeSource


def logs_what_it_hears(source: NodeSource) -> bool:
    """Whether the callback of a subscription or a service logs."""
    methods = [source.methods.get(end.method) for end in ends(source)]
    return any(method is not None and bool(source.logs(method)) for method in methods)


def _differ(suspect: Suspect) -> RecognisedMistake | None:
    """Look for one publisher and one subscription, whose names of the topic differ."""
    source = suspect.source
    made = [c for c, name in source.calls if last_part(name) == "create_publisher"]
    heard = [end.call for end in ends(source) if end.kind == "create_subscription"]
    if len(made) != 1 or len(heard) != 1 or not logs_what_it_hears(source):
        return None
    topics = [call.args[1] if len(call.args) > 1 else None for call in (*made, *heard)]
    names = [t.value if isinstance(t, ast.Constant) else None for t in topics]
    if not all(isinstance(name, str) for name in names) or _whole(names[0]) == _whole(names[1]):
        return None
    code = [source.module_of(topic).text.code(topic) for topic in topics if topic is not None]
    found = suspect.finding("own_topic", topics[1], name=code[1], written=code[0])
    return replace(found, words={**found.words, "line": str(made[0].lineno)})


def _whole(name: object) -> str:
    return str(name).removeprefix("/")


_node = Family("node", links.NAMES)
KINDS = (
    _node(
        "own_topic",
        "topic",
        msg("The node publishes on one topic and listens on another"),
        msg(
            "The line is logged when a message comes. Line {line} publishes on {written}, and this line "
            "listens on {name}: for ROS these are two topics, so no message comes. A name that begins with "
            "~/ stands for one below the name of the node."
        ),
        msg("Write {written} instead of {name} in this line."),
        behind={"run.no_lines": _differ},
        fixed_by=(lines.written,),
        examples=(
            example(
                "hears_another_topic",
                Replace(
                    NODE,
                    "from rclpy.node import Node\n",
                    "from rclpy.node import Node\nfrom std_msgs.msg import String\n",
                ),
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "        self.publisher = self.create_publisher(String, '~/hello', 10)\n"
                    "        self.create_subscription(String, 'hello', self.listen, 10)\n"
                    "        self.create_timer(1.0, self.timer_callback)\n",
                ),
                Replace(
                    NODE,
                    LOG_LINE,
                    "        self.publisher.publish(String(data='Hello time: ' + str(self.counter_)))\n",
                ),
                Replace(
                    NODE,
                    "\n\ndef main(",
                    "\n    def listen(self, msg):\n        self.get_logger().info(msg.data)\n\n\ndef main(",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
)
