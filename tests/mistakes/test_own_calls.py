"""Exceptions at a call: of an own function or class, of the entry point, and inside of a library."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.recognised import RecognisedMistake
from tests.mistakes.test_from_source import line_of, raised
from tests.mistakes.test_named_exactly import changed, fix_of, patched, why_of

INIT = "    def __init__(self):\n"
NODE_CLASS = "class MyFirstNode(Node):"
MADE = "    node = MyFirstNode()\n"
START = "self.counter_ = 0"
RCLPY_INIT = "    rclpy.init(args=args)\n"
SETTINGS = "class Settings:\n    period: float = 1.0\n    start: int = 0\n\n\n"
NO_CONTEXT = "TypeError: 'NoneType' object does not support the context manager protocol"
NO_LENGTH = "TypeError: object of type 'NoneType' has no len()"


def at(error: str, text: str, part: str, inside: str = "") -> RecognisedMistake:
    found = raised(error, text, line_of(text, part), inside)
    assert found is not None
    return found


def test_of_two_constructors_the_last_one_gets_the_values_of_the_first() -> None:
    text = changed(
        (
            INIT,
            f"{INIT}        self.__init__('my_first_node', 2.0)\n\n    def __init__(self, name, period):\n",
        )
    )
    error = "TypeError: MyFirstNode.__init__() missing 2 required positional arguments: 'name' and 'period'"
    found = at(error, text, MADE.strip())
    assert found.kind == "node.last_def_counts"
    assert "def __init__(self, name='my_first_node', period=2.0):" in fix_of(found)
    assert found.where is not None
    assert found.where.line == line_of(text, "def __init__(self, name, period)")


def test_all_missing_values_are_named() -> None:
    text = changed((INIT, "    def __init__(self, name, period, start):\n"))
    error = (
        "TypeError: MyFirstNode.__init__() missing 3 required positional arguments: 'name', 'period', and "
        "'start'"
    )
    found = at(error, text, MADE.strip())
    assert (found.kind, found.variant) == ("node.own_call", "several")
    assert "name, period, start" in fix_of(found)


def test_values_of_rclpy_are_all_named() -> None:
    text = changed((START, f"{START}\n        self.create_subscription(int, 'a')"))
    error = (
        "TypeError: Node.create_subscription() missing 2 required positional arguments: 'callback' and "
        "'qos_profile'"
    )
    found = at(error, text, "create_subscription")
    assert "callback, qos_profile" in fix_of(found)


def test_a_misspelt_name_of_a_parameter_is_corrected(tmp_path: Path) -> None:
    text = changed(
        (INIT, "    def __init__(self, period=1.0):\n"),
        (MADE, "    node = MyFirstNode(priod=1.0)\n"),
    )
    error = "TypeError: MyFirstNode.__init__() got an unexpected keyword argument 'priod'"
    found = at(error, text, "priod")
    assert (found.kind, found.variant) == ("node.own_call", "near")
    assert "MyFirstNode(period=1.0)" in patched(found, text, tmp_path)


def test_a_parameter_that_the_def_uses_is_not_told_to_be_removed() -> None:
    text = changed(
        (START, f"{START}\n        self.show()"),
        (
            "    def timer_callback",
            "    def show(self, text):\n        print(text)\n\n    def timer_callback",
        ),
    )
    error = "TypeError: MyFirstNode.show() missing 1 required positional argument: 'text'"
    assert "remove" not in fix_of(at(error, text, "self.show()")).lower()


@pytest.mark.parametrize("given", ["Settings(period=2.0)", "Settings(2.0, 1)"])
def test_a_dataclass_without_its_decorator_gets_it(given: str, tmp_path: Path) -> None:
    text = changed(
        ("import rclpy\nfrom", "from dataclasses import dataclass\n\nimport rclpy\nfrom"),
        (NODE_CLASS, f"{SETTINGS}{NODE_CLASS}"),
        (START, f"self.counter_ = {given}.start"),
    )
    found = at("TypeError: Settings() takes no arguments", text, given)
    assert (found.kind, found.variant) == ("node.class_takes_nothing", "dataclass")
    assert "\n@dataclass\nclass Settings:" in patched(found, text, tmp_path)


def test_a_class_without_init_is_no_dataclass_if_the_values_do_not_fit() -> None:
    text = changed(
        (NODE_CLASS, f"{SETTINGS}{NODE_CLASS}"),
        (START, "self.counter_ = Settings(speed=2.0).start"),
    )
    found = at("TypeError: Settings() takes no arguments", text, "speed=2.0")
    assert (found.kind, found.variant) == ("node.class_takes_nothing", "")
    assert "dataclass" not in fix_of(found)


def test_a_method_that_looks_like_init_is_renamed() -> None:
    text = changed(
        (
            NODE_CLASS,
            f"class Count:\n    def __int__(self, n):\n        self.n = n\n\n\n{NODE_CLASS}",
        ),
        (START, "self.counter_ = Count(0).n"),
    )
    found = at("TypeError: Count() takes no arguments", text, "Count(0)")
    assert fix_of(found).startswith("Rename __int__ to __init__")


@pytest.mark.parametrize(
    ("line", "error", "new"),
    [
        ("if len(args) > 0:", NO_LENGTH, "if len(args or []) > 0:"),
        (
            "for one in args:",
            "TypeError: 'NoneType' object is not iterable",
            "for one in args or []:",
        ),
        (
            "if '-v' in args:",
            "TypeError: argument of type 'NoneType' is not iterable",
            "if '-v' in (args or []):",
        ),
    ],
)
def test_main_gets_no_arguments(line: str, error: str, new: str, tmp_path: Path) -> None:
    text = changed((RCLPY_INIT, f"    {line}\n        print('given')\n{RCLPY_INIT}"))
    found = at(error, text, line)
    assert found.kind == "node.main_gets_none"
    assert f"    {new}\n" in patched(found, text, tmp_path)


def test_an_argument_that_main_sets_itself_is_not_the_missing_one() -> None:
    text = changed((RCLPY_INIT, f"    args = find()\n    print(len(args))\n{RCLPY_INIT}"))
    found = raised(NO_LENGTH, text, line_of(text, "len(args)"))
    assert found is None or found.kind != "node.main_gets_none"


def test_a_with_of_rclpy_is_not_one_of_the_student() -> None:
    text = changed()
    found = at(NO_CONTEXT, text, "rclpy.spin(node)", inside="rclpy")
    assert found.kind == "node.ros_not_running"


def test_the_lines_below_a_with_that_shuts_ros_down_move_into_it(tmp_path: Path) -> None:
    context = (
        "@contextmanager\ndef ros():\n    rclpy.init()\n    try:\n        yield\n    finally:\n"
        "        rclpy.try_shutdown()\n\n\n"
    )
    text = changed(
        ("import rclpy\nfrom", "from contextlib import contextmanager\n\nimport rclpy\nfrom"),
        (NODE_CLASS, f"{context}{NODE_CLASS}"),
        (RCLPY_INIT, ""),
        (MADE, f"    with ros():\n    {MADE}"),
    )
    found = at(NO_CONTEXT, text, "rclpy.spin(node)", inside="rclpy")
    assert found.kind == "node.below_with"
    assert "\n            rclpy.spin(node)\n" in patched(found, text, tmp_path)


@pytest.mark.parametrize(
    "error",
    [
        "TypeError: 'int' object is not iterable",
        "TypeError: 'NoneType' object is not subscriptable",
        "TypeError: '<' not supported between instances of 'str' and 'int'",
        "TypeError: cannot unpack non-iterable int object",
        "KeyError: 'x'",
        "IndexError: list index out of range",
    ],
)
def test_an_error_of_a_library_is_not_explained_by_the_line(error: str) -> None:
    text = changed((START, f"{START}\n        self.load('x')"))
    assert raised(error, text, line_of(text, "self.load"), "Python") is None


def test_a_text_before_percent_may_be_meant_as_a_number() -> None:
    text = changed((START, f"{START}\n        self.rest = self.given % 10"))
    error = "TypeError: not all arguments converted during string formatting"
    found = at(error, text, "self.given")
    assert "find the line that gives the value before %" in fix_of(found)


def test_the_arguments_of_a_thread_become_a_tuple() -> None:
    text = changed(
        (
            "        rclpy.spin(node)\n",
            "        threading.Thread(target=rclpy.spin, args=(node)).start()\n",
        )
    )
    error = "TypeError: rclpy.spin() argument after * must be an iterable, not MyFirstNode"
    found = raised(error, text, None, "Python")
    assert fix_of(found) == "Write args=(node,) instead of args=(node)."


def test_ros_that_was_shut_down_is_not_told_to_be_started_late() -> None:
    text = changed((MADE, f"    clean_up()\n{MADE}"))
    error = "rclpy.exceptions.NotInitializedException: ('rclpy.init() has not been called', 'x')"
    found = at(error, text, "super().__init__", inside="rclpy")
    assert found.kind == "node.ros_not_running"
    assert "shut" in why_of(found)


def test_a_number_added_to_a_list_is_told_with_both_ways() -> None:
    text = changed((START, "self.counter_ = []"))
    found = at("TypeError: 'int' object is not iterable", text, "self.counter_ += 1")
    assert "begin with a number" in fix_of(found)
    assert "self.counter_.append(…)" in fix_of(found)


@pytest.mark.parametrize(("path", "variant"), [("start.txt", ""), ("/home/me/start.txt", "whole")])
def test_a_whole_path_is_not_told_to_begin_with_a_slash(path: str, variant: str) -> None:
    text = changed((START, f"self.counter_ = int(open('{path}').read())"))
    error = f"FileNotFoundError: [Errno 2] No such file or directory: '{path}'"
    found = at(error, text, "open(")
    assert (found.kind, found.variant) == ("node.no_such_file", variant)


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("open('notes/log.txt', 'w')", "Create the folder of 'notes/log.txt'"),
        ("open('notes/log.txt', mode='a')", "Create the folder of 'notes/log.txt'"),
        ("open('notes/log.txt', 'r')", "Write the values that the program takes from"),
    ],
)
def test_a_file_that_is_written_needs_its_folder(line: str, told: str) -> None:
    text = changed((START, f"self.counter_ = {line}"))
    error = "FileNotFoundError: [Errno 2] No such file or directory: 'notes/log.txt'"
    assert told in fix_of(at(error, text, "open("))


def test_a_program_that_cannot_be_started_is_no_file_to_be_read() -> None:
    text = changed((START, "subprocess.run(['rviz'])"))
    error = "FileNotFoundError: [Errno 2] No such file or directory: 'rviz'"
    assert raised(error, text, line_of(text, "subprocess.run")) is None


def test_a_timer_of_pythons_threading_is_not_one_of_rclpy() -> None:
    text = changed((START, f"{START}\n        Timer(1.0)"))
    error = "TypeError: Timer.__init__() missing 1 required positional argument: 'function'"
    assert at(error, text, "Timer(1.0)").kind != "node.timer_class"
