"""Names that the file defines elsewhere, and attributes that look like others: told as they are."""

from __future__ import annotations

import pytest

from grader.mistakes.alike import is_typo, meant_by
from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.recognised import RecognisedMistake
from tests.mistakes.test_from_source import RIGHT, line_of, raised

START = "        self.counter_ = 0\n"
STEP = "        self.counter_ += 1\n"
TEXT = "'Hello time: ' + str(self.counter_)"
CALLBACK = "    def timer_callback(self)"
CLASS = "class MyFirstNode(Node):"


def changed(*pairs: tuple[str, str]) -> str:
    text = RIGHT
    for old, new in pairs:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


def no_name(name: str, text: str, at: str) -> RecognisedMistake:
    found = raised(f"NameError: name '{name}' is not defined", text, line_of(text, at))
    assert found is not None
    return found


def no_attribute(name: str, text: str, at: str, kind: str = "MyFirstNode") -> RecognisedMistake:
    error = f"AttributeError: '{kind}' object has no attribute '{name}'"
    found = raised(error, text, line_of(text, at))
    assert found is not None
    return found


def fix_of(found: RecognisedMistake) -> str:
    return str(CATALOGUE[found.kind].fix_text({**found.params, **found.words}, found.variant))


def test_a_close_name_of_another_function_is_not_advised() -> None:
    text = changed(("def main(", "def run():\n    rclpy.spin(noode)\n\n\ndef main("))
    found = no_name("noode", text, "rclpy.spin(noode)")
    assert (found.kind, found.variant) == ("node.name_unknown", "")


def test_a_helper_class_has_no_logger_of_its_own() -> None:
    helper = "class Helper:\n    def say(self):\n        get_logger().info('x')\n\n\n"
    text = changed((CLASS, f"{helper}{CLASS}"))
    assert no_name("get_logger", text, "        get_logger()").kind == "node.name_unknown"


def test_an_own_attribute_with_an_underscore_is_no_late_call_of_super() -> None:
    text = RIGHT.replace(START, "").replace("self.counter_", "self._counter")
    found = no_attribute("_counter", text, "str(self._counter)")
    assert found.kind == "node.attribute_not_set"
    assert fix_of(found) == "Give it a value in __init__: self._counter = 0"


def test_no_number_is_advised_for_what_nothing_adds_to() -> None:
    text = changed((TEXT, "self.prefix + '0'"))
    found = no_attribute("prefix", text, "self.prefix")
    assert found.variant == "value"
    assert "= 0" not in fix_of(found)


@pytest.mark.parametrize(
    ("new", "variant"),
    [
        (f"    def setup(self):\n{START}\n{CALLBACK}", "set_here"),
        (f"    def setup(self, n):\n{START}\n{CALLBACK}", "set_here"),
    ],
)
def test_the_line_that_sets_an_attribute_elsewhere_is_named(new: str, variant: str) -> None:
    text = changed((START, ""), (CALLBACK, new))
    found = no_attribute("counter_", text, "str(self.counter_)")
    assert (found.kind, found.variant) == ("node.attribute_not_set", variant)
    assert found.params["lines"] == str(line_of(text, "self.counter_ = 0"))


def test_an_attribute_in_a_branch_of_init_is_not_to_be_written_again() -> None:
    text = changed((START, "        if not rclpy.ok():\n            self.counter_ = 0\n"))
    found = no_attribute("counter_", text, "str(self.counter_)")
    assert found.variant == "set_here"
    assert "self.counter_ = 0" not in fix_of(found)


@pytest.mark.parametrize(
    ("name", "other", "same"),
    [
        ("get_loger", "get_logger", True), ("getLogger", "get_logger", True),
        ("create_timmer", "create_timer", True), ("destroy", "destroy_node", True),
        ("get_time", "get_name", False), ("create_node", "create_rate", False),
        ("spin_some", "spin_once", False), ("get_node", "get_name", False),
    ],
)  # fmt: skip
def test_two_names_are_alike_only_word_by_word(name: str, other: str, same: bool) -> None:
    assert is_typo(name, other) is same


def test_a_timer_of_threading_is_another_object() -> None:
    text = "import threading\n" + changed((STEP, f"{STEP}        self.t.stop()\n"))
    assert no_attribute("stop", text, "self.t.stop", kind="Timer").kind == "node.attribute_unknown"


def test_a_similar_name_that_does_something_else_is_not_advised() -> None:
    text = changed((STEP, f"{STEP}        self.x.get_time()\n"))
    error = "AttributeError: 'Future' object has no attribute 'get_time'. Did you mean: 'get_name'?"
    found = raised(error, text, line_of(text, "self.x.get_time"))
    assert found is not None
    assert not fix_of(found).startswith("Write")


def test_a_name_of_another_module_of_rclpy_gets_its_import() -> None:
    new = "from rclpy import SingleThreadedExecutor"
    text = changed(("import rclpy\n", f"import rclpy\n{new}\n"))
    error = "ImportError: cannot import name 'SingleThreadedExecutor' from 'rclpy' (/x/__init__.py)"
    found = raised(error, text, line_of(text, new))
    assert found is not None
    assert found.params["written"] == "from rclpy.executors import SingleThreadedExecutor"


@pytest.mark.parametrize(
    ("name", "known", "close"),
    [
        ("mgs", ["msg", "mag", "node"], "msg"),
        ("mgs", ["node"], ""),
        ("tiemr", ["timer", "tier"], "timer"),
        ("ab", ["ba"], ""),
        ("cba", ["abc"], ""),
    ],
)
def test_two_letters_that_changed_places_are_a_typing_mistake(
    name: str, known: list[str], close: str
) -> None:
    assert meant_by(name, known, 0.75) == close
