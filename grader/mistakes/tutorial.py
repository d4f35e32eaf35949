"""The mistake of handing in a node of ROS's own tutorials instead of the one of the exercise."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import Value, msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes.node_clock import count_of
from grader.mistakes.fixes.node_tutorial import parts_of_topic
from grader.mistakes.kind import Family
from grader.mistakes.placeholders import as_sum
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Write

LOGGED = {"create_publisher": "Publishing: ", "create_subscription": "I heard: "}
"""How the lines of the tutorials' nodes begin, by the call that makes their end of the topic."""


def _of_tutorial(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a node with a topic that logs a tutorial's lines, and not those of the exercise."""
    source, output = suspect.source, suspect.output
    if source.node_class is None or _has_topics(suspect):
        return None
    texts = [n.value for n in source.all_nodes if isinstance(n, ast.Constant)]
    written = [text for text in texts if isinstance(text, str)]
    own = output.text.partition("{n}")[0].strip()
    if any(own in text for text in written):
        return None
    logged = [
        n.value
        for call in source.own_logs
        for n in ast.walk(call)
        if isinstance(n, ast.Constant) and isinstance(n.value, str)
    ]
    for end, begin in LOGGED.items():
        if source.calls_of(end) and any(text.startswith(begin) for text in logged):
            return _found(suspect, source.node_class, end)
    return None


def _has_topics(suspect: Suspect) -> bool:
    """Whether the exercise is about topics: then a tutorial's node may be the start of it."""
    return any(
        use.kind.startswith(("topic.", "interface.", "service.", "action.", "world."))
        for use in suspect.assignment.checks
    )


def _found(suspect: Suspect, made: ast.ClassDef, end: str) -> RecognisedMistake:
    source = suspect.source
    counter, counts = count_of(source)
    log = next(ast.unparse(call.func) for call in source.own_logs)
    lines = ", ".join(map(_rows, parts_of_topic(source)))
    found = suspect.finding("of_tutorial", made, name=made.name)
    words: dict[str, Value] = {
        **found.words,
        "line": lines,
        "wanted": suspect.output.line(0),
        "counter": counter,
        "written": f"{log}({as_sum(suspect.output, counter)})",
    }
    kept = end == "create_publisher" and counts and bool(source.timers)
    return replace(found, variant="" if kept else "again", words=words)


def _rows(part: ast.stmt) -> str:
    last = part.end_lineno or part.lineno
    return str(part.lineno) if last == part.lineno else f"{part.lineno}-{last}"


PUBLISHER = """\
#!/usr/bin/env python3
import rclpy
from rclpy.node import Node

from std_msgs.msg import String


class MinimalPublisher(Node):

    def __init__(self):
        super().__init__('minimal_publisher')
        self.publisher_ = self.create_publisher(String, 'topic', 10)
        timer_period = 0.5  # seconds
        self.timer = self.create_timer(timer_period, self.timer_callback)
        self.i = 0

    def timer_callback(self):
        msg = String()
        msg.data = 'Hello World: %d' % self.i
        self.publisher_.publish(msg)
        self.get_logger().info('Publishing: "%s"' % msg.data)
        self.i += 1


def main(args=None):
    rclpy.init(args=args)

    minimal_publisher = MinimalPublisher()

    rclpy.spin(minimal_publisher)

    # Destroy the node explicitly
    # (optional - otherwise it will be done automatically
    # when the garbage collector destroys the node object)
    minimal_publisher.destroy_node()
    rclpy.shutdown()


if __name__ == '__main__':
    main()
"""
SUBSCRIBER = """\
#!/usr/bin/env python3
import rclpy
from rclpy.node import Node

from std_msgs.msg import String


class MinimalSubscriber(Node):

    def __init__(self):
        super().__init__('minimal_subscriber')
        self.subscription = self.create_subscription(
            String,
            'topic',
            self.listener_callback,
            10)
        self.subscription  # prevent unused variable warning

    def listener_callback(self, msg):
        self.get_logger().info('I heard: "%s"' % msg.data)


def main(args=None):
    rclpy.init(args=args)

    minimal_subscriber = MinimalSubscriber()

    rclpy.spin(minimal_subscriber)

    minimal_subscriber.destroy_node()
    rclpy.shutdown()


if __name__ == '__main__':
    main()
"""
_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "of_tutorial",
        "class",
        msg("This is the node of a ROS tutorial about topics, not the node of this exercise"),
        msg(
            "{name} publishes or receives messages on a topic, and logs them. In this exercise "
            "the node is called {node_name}. It logs '{wanted}' first, a line every {period} s, "
            "and it needs no topic."
        ),
        msg(
            "Make it the node of this exercise: pass '{node_name}' to super().__init__(), use the "
            "period {period} for create_timer, and write {written} in {callback} in the place of "
            "the call that logs. Delete what belongs to the topic (lines {line})."
        ),
        fixes={
            "again": msg(
                "Write the node of this exercise instead: pass '{node_name}' to super().__init__(), and "
                "write {counter} = {start} and self.create_timer({period}, self.{callback}) below "
                "it. Write def {callback}(self): and in it only {written} and {counter} += {step}. "
                "Delete what belongs to the topic (lines {line})."
            )
        },
        behind={
            "run.wrong_node_name": _of_tutorial,
            "run.wrong_text": _of_tutorial,
            "run.wrong_period": _of_tutorial,
            "run.no_lines": _of_tutorial,
        },
        examples=(
            example(
                "tutorial_publisher",
                Write(NODE, PUBLISHER, 0o755),
                fails="run.node_name",
                also={"run.output": "node.of_tutorial", "run.period": "node.of_tutorial"},
            ),
            example(
                "tutorial_publisher_of_right_name",
                Write(NODE, PUBLISHER.replace("minimal_publisher')", "my_first_node')"), 0o755),
                fails="run.output",
                also={"run.period": "node.of_tutorial"},
            ),
            example(
                "tutorial_subscriber",
                Write(NODE, SUBSCRIBER, 0o755),
                fails="run.node_name",
                also={"run.output": "node.of_tutorial"},
                blocks=("run.logger", "run.period"),
            ),
        ),
    ),
)
