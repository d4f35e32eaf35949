"""Habits of the web, of C# and of a PLC: async helpers, scan cycles, static methods, executors."""

from __future__ import annotations

from grader.mistakes.recognised import RecognisedMistake
from tests.mistakes.test_from_source import line_of, raised
from tests.mistakes.test_named_exactly import changed, fix_of

TIMER = "self.create_timer(1.0, self.timer_callback)"
CLASS = "class MyFirstNode(Node):"
NO_TYPE = "TypeError: __init__(): incompatible constructor arguments."


def found_at(error: str, text: str, part: str, inside: str = "") -> RecognisedMistake:
    found = raised(error, text, line_of(text, part), inside)
    assert found is not None
    return found


def test_a_parameter_with_several_values_is_not_replaced_by_the_name() -> None:
    text = changed(
        ("def __init__(self):", "def __init__(self, options):"),
        ("super().__init__('my_first_node')", "super().__init__(options)"),
        ("create_timer(1.0", "create_timer(options['period']"),
        ("MyFirstNode()", "MyFirstNode({'name': 'my_first_node', 'period': 1.0})"),
    )
    found = found_at(NO_TYPE, text, "super().__init__(options)", "rclpy")
    assert (
        fix_of(found)
        == "Write super().__init__('my_first_node') in this line, without another value."
    )
