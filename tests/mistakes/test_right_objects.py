"""Classes, callbacks, arguments and names: what only looks like a mistake is not reported."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import RIGHT, line_of, look, raised

TIMER = "self.create_timer(1.0, self.timer_callback)"
STEP = "        self.counter_ += 1\n"


def changed(old: str, new: str) -> str:
    assert RIGHT.count(old) == 1
    return RIGHT.replace(old, new)


@pytest.mark.parametrize(
    "text",
    [
        changed("self.timer_callback)", "lambda: self.timer_callback())"),
        changed(STEP, f"{STEP}\n    @property\n    def n(self):\n        return 1\n\n"
                "    @n.setter\n    def n(self, value):\n        self.counter_ = value\n"),
        changed("node = MyFirstNode()", "helper = Node('helper')\n    node = MyFirstNode()"),
    ],
)  # fmt: skip
@pytest.mark.parametrize("symptom", ["run.no_lines", "run.constant_counter"])
def test_right_forms_are_not_reported(text: str, symptom: str) -> None:
    assert look(symptom, text) is None


def test_a_second_definition_that_does_the_same_is_not_the_cause() -> None:
    text = changed(STEP, f"{STEP}\n    def tick(self):\n{STEP}\n    def tick(self):\n{STEP}")
    assert look("run.no_lines", text) is None


@pytest.mark.parametrize(
    ("error", "old", "new", "kind"),
    [
        # a callback group as the third argument is right; the attribute is not
        ("AttributeError: 'MyFirstNode' object has no attribute 'group'",
         "self.timer_callback)", "self.timer_callback, self.group)", "node.attribute_not_set"),
        # str is hidden in another function, so that this call is Python's
        ("TypeError: 'int' object is not callable", "str(self.counter_)",
         "str(self.counter_())", "node.not_callable"),
        # the name belongs to a method, not to an object of another function
        ("NameError: name 'other' is not defined", TIMER,
         "other.create_timer(1.0, self.timer_callback)", "node.name_unknown"),
        # a string that is no number
        ('TypeError: can only concatenate str (not "int") to str', "' + str(self.counter_)",
         "' + self.counter_", "node.str_plus_int"),
        # a module that the code uses is not to be deleted
        ("ModuleNotFoundError: No module named 'turtlesim'", "import rclpy\nfrom",
         "import turtlesim\nPOSE = turtlesim\nfrom", "node.import_misspelt"),
    ],
)  # fmt: skip
def test_other_causes_of_the_same_errors_keep_their_answer(
    error: str, old: str, new: str, kind: str
) -> None:
    text = changed(old, new).replace("    rclpy.init", "    str = 'x'\n    rclpy.init")
    found = raised(error, text, line_of(text, new.partition("\n")[0]))
    assert found is not None
    assert found.kind == kind
    assert found.variant != "unused"
