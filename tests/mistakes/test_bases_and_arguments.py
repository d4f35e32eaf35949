"""What a class inherits from, what a call gets and what a parameter is called is told exactly."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.report.model import Where
from grader.verdict.own_modules import own_module
from tests.mistakes.test_diagnose import TRACEBACK, evidence
from tests.mistakes.test_from_source import line_of, raised
from tests.mistakes.test_named_exactly import changed, fix_of, patched
from tests.static_bench import NODE, Bench

CLASS = "class MyFirstNode(Node):"
IMPORT = "from rclpy.node import Node\n"
TIMER = "self.create_timer(1.0, self.timer_callback)"
OF_OBJECT = "TypeError: object.__init__() takes exactly one argument (the instance to initialize)"


@pytest.mark.parametrize(
    ("imported", "base"),
    [
        (IMPORT, "Node"),
        ("from rclpy.node import Node as RosNode\n", "RosNode"),
        ("import rclpy.node\n", "rclpy.node.Node"),
        ("import rclpy.node as rn\n", "rn.Node"),
        ("from rclpy import node\n", "node.Node"),
    ],
)
@pytest.mark.parametrize("wrong", ["class MyFirstNode:", "class MyFirstNode(object):"])
def test_the_base_is_named_as_the_file_imports_it(
    imported: str, base: str, wrong: str, tmp_path: Path
) -> None:
    right = changed((IMPORT, imported), (CLASS, f"class MyFirstNode({base}):"))
    text = changed((IMPORT, imported), (CLASS, wrong))
    found = raised(OF_OBJECT, text, line_of(text, "super()"))
    assert fix_of(found) == f"Write: class MyFirstNode({base}):"
    assert patched(found, text, tmp_path) == right


def test_node_is_imported_too_if_the_file_does_not(tmp_path: Path) -> None:
    text = changed((IMPORT, ""), (CLASS, "class MyFirstNode():"))
    found = raised(OF_OBJECT, text, line_of(text, "super()"))
    assert "from rclpy.node import Node" in fix_of(found)
    assert patched(found, text, tmp_path) == changed()


def test_the_own_base_class_is_the_one_without_node(tmp_path: Path) -> None:
    base = "class Base:\n    def hello(self):\n        return 'Hello'\n\n\nclass MyFirstNode(Base):"
    text = changed((CLASS, base))
    found = raised(OF_OBJECT, text, line_of(text, "super()"))
    assert fix_of(found) == "Write: class Base(Node):"
    right = changed((CLASS, base.replace("class Base:", "class Base(Node):")))
    assert patched(found, text, tmp_path) in (right, "")  # (two classes: the change is not certain)


PARAMETER = """\
self.declare_parameter('period', 1.0)
        self.create_timer(self.get_parameter('period').value, self.timer_callback)"""


def test_the_method_for_the_timer_is_not_chosen_among_two(tmp_path: Path) -> None:
    other = (
        "    def timer_two(self):\n        self.get_logger().info('two')\n\n    def timer_callback"
    )
    text = changed((TIMER, "self.create_timer(1.0)"), ("    def timer_callback", other))
    error = "TypeError: Node.create_timer() missing 1 required positional argument: 'callback'"
    assert not patched(raised(error, text, line_of(text, "create_timer")), text, tmp_path)


UNDECLARED = (
    "rclpy.exceptions.ParameterNotDeclaredException: Invalid access to undeclared parameter(s): "
)
READ = "period = self.get_parameter('period').get_parameter_value().double_value"
MADE = "self.create_timer(period, self.timer_callback)"
DECLARED = "self.declare_parameter('period', 1.0)"
INDENT = "\n        "


def rows(*lines: str) -> tuple[str, str]:
    return TIMER, INDENT.join(lines)


def test_the_default_value_of_an_unknown_parameter_is_left_open(tmp_path: Path) -> None:
    text = changed(
        ("self.counter_ = 0", "self.counter_ = 0\n        self.get_parameter('x').value")
    )
    found = raised(f"{UNDECLARED}x", text, line_of(text, "get_parameter"))
    assert "self.declare_parameter('x', …)" in fix_of(found)
    assert not patched(found, text, tmp_path)


@pytest.mark.parametrize(
    ("line", "wrong", "right"),
    [
        ("period = self.get_parameter('period').get_parameter_value.double_value",
         "self.get_parameter('period').get_parameter_value",
         "self.get_parameter('period').get_parameter_value()"),
    ],
)  # fmt: skip
def test_the_brackets_that_lack_are_shown(
    line: str, wrong: str, right: str, tmp_path: Path
) -> None:
    text = changed(rows(DECLARED, line, MADE))
    error = "AttributeError: 'function' object has no attribute 'double_value'"
    found = raised(error, text, line_of(text, "period ="))
    assert fix_of(found) == f"Write {right} instead of {wrong}."
    assert patched(found, text, tmp_path) == changed(
        rows(DECLARED, line.replace(wrong, right), MADE)
    )


def test_the_brackets_lack_where_a_variable_gets_the_method(tmp_path: Path) -> None:
    got = "value = self.get_parameter('period').get_parameter_value"
    made = "self.create_timer(value.double_value, self.timer_callback)"
    text = changed(rows(DECLARED, got, made))
    error = "AttributeError: 'function' object has no attribute 'double_value'"
    found = raised(error, text, line_of(text, "value.double"))
    assert found is not None
    assert found.where is not None
    assert found.where.line == line_of(text, "value = ")
    assert patched(found, text, tmp_path) == changed(rows(DECLARED, f"{got}()", made))


TEXT = "'Hello time: ' + str(self.counter_)"


def test_a_name_of_an_own_file_that_is_misspelt_is_named(tmp_path: Path) -> None:
    bench = Bench(tmp_path / "my_robot_controller")
    bench.write(
        "my_robot_controller/texts.py", "HELLO = 'Hello time: '\n\n\ndef say():\n    pass\n"
    )
    line = "from my_robot_controller.texts import HELO"
    source = changed(("import rclpy\nfrom", f"import rclpy\n{line}\nfrom"))
    error = (
        "ImportError: cannot import name 'HELO' from 'my_robot_controller.texts' "
        "(/ws/build/my_robot_controller/my_robot_controller/texts.py)"
    )
    seen = evidence(bench, source, TRACEBACK.format(line=line_of(source, line), error=error))
    found = own_module(error, Where(file=NODE, line=line_of(source, line)), seen)
    assert fix_of(found) == (
        "Write HELLO instead of HELO, here and wherever this file uses it: "
        "my_robot_controller/texts.py defines HELLO."
    )
    other = error.replace("HELO", "goodbye")
    found = own_module(other, Where(file=NODE, line=line_of(source, line)), seen)
    assert fix_of(found).startswith("Define goodbye in my_robot_controller/texts.py")


def test_a_def_without_self_gets_it(tmp_path: Path) -> None:
    method = (
        "    def make_text(n):\n        return 'Hello time: ' + str(n)\n\n    def timer_callback"
    )
    call = (f"info({TEXT})", "info(self.make_text(self.counter_))")
    text = changed(call, ("    def timer_callback", method))
    error = "TypeError: MyFirstNode.make_text() takes 1 positional argument but 2 were given"
    found = raised(error, text, line_of(text, "info("))
    assert fix_of(found) == "Write: def make_text(self, n):"
    right = method.replace("(n)", "(self, n)", 1)
    assert patched(found, text, tmp_path) == changed(call, ("    def timer_callback", right))
