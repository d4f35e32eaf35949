"""Example values for the placeholders of the catalogue, for texts about no particular package."""

from __future__ import annotations

import string
from collections.abc import Iterable, Iterator, Mapping

from grader.base.i18n.message import Value
from grader.course.assignment import Assignment
from grader.mistakes.placeholders import CALLBACK, EXAMPLE, placeholder_values

UNKNOWN = "…"
"""What stands for a part of a program that only the program itself has."""
NAMES: Mapping[str, Value] = {
    **EXAMPLE,
    "attribute": "self.counter",
    "before": "talker = my_package.talker:main",
    "callback": CALLBACK,
    "debian": "turtlesim",
    "entry": "my_node = my_package.my_node:main",
    "executable": "my_node",
    "file": "my_node.py",
    "folder": "my_package/my_node",
    "key": "script_dir",
    "library": "rclpy",
    "make": "create_service",
    "needed": "geometry_msgs",
    "node": "node",
    "node_file": "my_node.py",
    "node_name": "my_node",
    "package": "my_package",
    "path": "my_package/my_node.py",
    "period": "1.0",
    "radius": "2",
    "service": "/reset",
    "short": "String",
    "start": 0,
    "statement": "from rclpy.node import Node",
    "step": 1,
    "tag": "name",
    "topic": "/chatter",
    "turtle": "turtle1",
}
ENTRY = "my_node = my_package.my_node:main"
COUNTER: Mapping[str, Value] = {"name": "self.counter"}
LINE: Mapping[str, Value] = {"line": "Count: 0"}
OF_KIND: Mapping[str, Mapping[str, Value]] = {
    "node.callback_called": {
        "name": f"create_timer(0.5, self.{CALLBACK}())",
        "written": f"create_timer(0.5, self.{CALLBACK})",
    },
    "node.counter_local": {"name": "counter", "function": CALLBACK},
    "node.counter_not_increased": COUNTER,
    "node.f_prefix": {"name": "'Count: {self.counter}'", "written": "f'Count: {self.counter}'"},
    "node.init_missing": {"written": "rclpy.init(args=args)"},
    "node.main_misspelt": {"name": "mian"},
    "node.str_plus_int": {"name": "self.counter", "written": "str(self.counter)"},
    "package.setup_cfg_wrong": {"wanted": "$base/lib/my_package", "line": "2, 4"},
    "run.wrong_node_name": {"wanted": "my_node"},
    "run.wrong_text": LINE,
    "source.misplaced_node_file": {"wanted": "my_package/my_node.py", "there": "my_node.py"},
    "topic.wrong_name": {"name": "/chater"},
    "topic.wrong_type": {"wanted": "std_msgs/msg/String"},
    "topic.wrong_period": {"wanted": "0.5"},
}
"""What the texts of one mistake show of a program."""


def example_values(kind: str, templates: Iterable[str]) -> Mapping[str, Value]:
    """Return a value for every placeholder of the texts of a mistake."""
    entry = {"wanted": ENTRY} if kind.startswith("setup.") else {}
    known = {**NAMES, **entry, **OF_KIND.get(kind, {})}
    return {name: known.get(name, UNKNOWN) for name in names_in(templates)}


def names_in(templates: Iterable[str]) -> Iterator[str]:
    """Yield the placeholders of texts."""
    for template in templates:
        yield from (name for _, name, _, _ in string.Formatter().parse(template) if name)


def lesson_values(kind: str, assignment: Assignment) -> Mapping[str, Value]:
    """Return the values that a lesson gives to the placeholders of a mistake."""
    path = f"{assignment.package}/{assignment.node_file}"
    wanted = {
        "package.setup_cfg_wrong": f"$base/lib/{assignment.package}",
        "source.misplaced_node_file": path,
        "run.wrong_node_name": assignment.node_name,
    }
    own = {"file": assignment.node_file, "path": path}
    if kind in wanted or kind.startswith("setup."):
        own["wanted"] = wanted.get(kind, f"{assignment.executable} = {assignment.target}")
    return {**placeholder_values(assignment), **own}
