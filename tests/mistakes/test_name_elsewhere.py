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


def test_a_variable_of_init_becomes_an_attribute() -> None:
    text = changed((START, f"{START}        prefix = 'Hello time: '\n"), (TEXT, "prefix + '0'"))
    found = no_name("prefix", text, "prefix + '0'")
    lines = f"{line_of(text, 'prefix =')}, {line_of(text, 'prefix +')}"
    assert found.kind == "node.name_local"
    assert fix_of(found).startswith(f"Write self.prefix instead of prefix (lines: {lines}):")


def test_an_attribute_of_a_name_that_node_has_itself_is_not_advised() -> None:
    text = changed((START, f"{START}        timers = 'Hello time: '\n"), (TEXT, "timers + '0'"))
    assert no_name("timers", text, "timers + '0'").params["written"] == "self.timers_"


def test_a_function_gets_the_variable_of_the_function_that_calls_it() -> None:
    text = changed(
        ("def main(", "def run():\n    rclpy.spin(node)\n\n\ndef main("),
        ("        rclpy.spin(node)\n", "        run()\n"),
    )
    found = no_name("node", text, "    rclpy.spin(node)")
    head, call = line_of(text, "def run"), line_of(text, "        run()")
    assert fix_of(found) == (
        f"Add node to the parameters of run (line {head}), and pass node in the () behind run in "
        f"line {call}."
    )


@pytest.mark.parametrize(
    ("use", "method", "written"),
    [
        ("PREFIX + '0'", "    def other(self)", "self.PREFIX"),
        ("self.text()", "    @staticmethod\n    def text()", "MyFirstNode.PREFIX"),
    ],
)
def test_a_name_of_the_class_needs_self_or_the_class(use: str, method: str, written: str) -> None:
    more = f"{method}:\n        return PREFIX\n\n" if "text" in method else ""
    text = changed((TEXT, use), (CALLBACK, f"    PREFIX = 'x'\n\n{more}{CALLBACK}"))
    at = "return PREFIX" if more else use
    found = no_name("PREFIX", text, at)
    assert (found.kind, found.params["written"]) == ("node.name_in_class", written)


def test_a_close_name_of_another_function_is_not_advised() -> None:
    text = changed(("def main(", "def run():\n    rclpy.spin(noode)\n\n\ndef main("))
    found = no_name("noode", text, "rclpy.spin(noode)")
    assert (found.kind, found.variant) == ("node.name_unknown", "")


def test_a_helper_class_has_no_logger_of_its_own() -> None:
    helper = "class Helper:\n    def say(self):\n        get_logger().info('x')\n\n\n"
    text = changed((CLASS, f"{helper}{CLASS}"))
    assert no_name("get_logger", text, "        get_logger()").kind == "node.name_unknown"


def test_a_private_name_of_a_base_is_told_with_both_classes() -> None:
    base = (
        "class Base(Node):\n    def __init__(self, name):\n        super().__init__(name)\n"
        "        self.__count = 0\n\n\nclass MyFirstNode(Base):"
    )
    text = changed((CLASS, base), (TEXT, "str(self.__count)"))
    found = no_attribute("_MyFirstNode__count", text, "str(self.__count)")
    assert (found.kind, found.variant) == ("node.private_name", "other")
    assert (found.words["type"], found.words["class"]) == ("Base", "MyFirstNode")


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
        (f"    def setup(self):\n{START}\n{CALLBACK}", "set_by_uncalled"),
        (f"    def setup(self, n):\n{START}\n{CALLBACK}", "set_later"),
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


def test_an_attribute_that_is_called_to_be_set_is_assigned() -> None:
    text = changed((START, "        self.counter_(0)\n"))
    found = no_attribute("counter_", text, "self.counter_(0)")
    assert fix_of(found) == "Write self.counter_ = 0 instead of self.counter_(0)."


def test_a_missing_method_gets_no_number() -> None:
    text = changed((STEP, "        self.update()\n"))
    found = no_attribute("update", text, "self.update()")
    assert (found.kind, found.variant) == ("node.attribute_not_set", "no_method")


def test_an_attribute_of_a_helper_is_read_through_the_helper() -> None:
    helper = "class State:\n    def __init__(self):\n        self.count = 0\n\n\n"
    text = changed(
        (CLASS, f"{helper}{CLASS}"), (START, "        self.state = State()\n"),
        (TEXT, "str(self.count)"), (STEP, "        self.state.count += 1\n"),
    )  # fmt: skip
    found = no_attribute("count", text, "str(self.count)")
    assert (found.variant, found.params["written"]) == ("helper", "self.state.count")


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


@pytest.mark.parametrize(
    ("old", "new", "written"),
    [
        ("rclpy.spin(node)", "rclpy.spin_some(node)", "rclpy.spin(node)"),
        ("        rclpy.spin(node)", "        while True:\n            rclpy.spin_some(node)",
         "rclpy.spin_once(node)"),
    ],
)  # fmt: skip
def test_spin_once_belongs_only_in_a_loop(old: str, new: str, written: str) -> None:
    text = changed((old, new))
    error = (
        "AttributeError: module 'rclpy' has no attribute 'spin_some'. Did you mean: 'spin_once'?"
    )
    found = raised(error, text, line_of(text, "spin_some"))
    assert found is not None
    assert (found.kind, found.params["written"]) == ("node.spin_of_others", written)


@pytest.mark.parametrize(
    ("called", "fix"),
    [("start", "Delete this line"), ("stop", "Write self.t.cancel instead of self.t.stop.")],
)
def test_what_a_timer_of_ros_has_instead_is_said(called: str, fix: str) -> None:
    text = changed((STEP, f"{STEP}        self.t.{called}()\n"))
    found = no_attribute(called, text, f"self.t.{called}", kind="Timer")
    assert fix_of(found).startswith(fix)


def test_a_timer_of_threading_is_another_object() -> None:
    text = "import threading\n" + changed((STEP, f"{STEP}        self.t.stop()\n"))
    assert no_attribute("stop", text, "self.t.stop", kind="Timer").kind == "node.attribute_unknown"


def test_a_similar_name_that_does_something_else_is_not_advised() -> None:
    text = changed((STEP, f"{STEP}        self.x.get_time()\n"))
    error = "AttributeError: 'Future' object has no attribute 'get_time'. Did you mean: 'get_name'?"
    found = raised(error, text, line_of(text, "self.x.get_time"))
    assert found is not None
    assert not fix_of(found).startswith("Write")


@pytest.mark.parametrize(
    ("line", "error"),
    [
        ("if len(args) > 0:\n        pass", "object of type 'NoneType' has no len()"),
        ("for arg in args:\n        pass", "'NoneType' object is not iterable"),
        ("first = args[0]", "'NoneType' object is not subscriptable"),
    ],
)
def test_the_parameter_of_main_is_none_under_ros2_run(line: str, error: str) -> None:
    text = changed(("    rclpy.init(", f"    {line}\n    rclpy.init("))
    found = raised(f"TypeError: {error}", text, line_of(text, line.partition("\n")[0]))
    assert found is not None
    assert found.kind == "node.main_gets_none"


def test_a_parameter_that_gets_a_value_before_is_not_told_as_none() -> None:
    text = changed(("    rclpy.init(", "    args = look()\n    first = args[0]\n    rclpy.init("))
    found = raised(
        "TypeError: 'NoneType' object is not subscriptable", text, line_of(text, "first =")
    )
    assert found is None or found.kind != "node.main_gets_none"


def test_a_word_that_was_replaced_everywhere_is_shown_with_its_lines() -> None:
    text = RIGHT.replace("from rclpy.node", "from rclpy.robot")
    text = text.replace("destroy_node", "destroy_robot").replace(
        "'my_first_node'", "'my_first_robot'"
    )
    error = "ModuleNotFoundError: No module named 'rclpy.robot'"
    found = raised(error, text, line_of(text, "rclpy.robot"))
    assert found is not None
    assert (found.params["close"], found.variant) == ("rclpy.node", "replaced")
    destroys = line_of(text, "destroy_robot")
    assert str(found.words["others"]).endswith(f"destroy_node ({destroys})")


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
