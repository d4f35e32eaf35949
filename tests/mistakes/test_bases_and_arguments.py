"""What a class inherits from, what a call gets and what a parameter is called is told exactly."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.report.model import Where
from grader.verdict.own_modules import own_module
from tests.mistakes.test_diagnose import TRACEBACK, evidence
from tests.mistakes.test_from_source import line_of, raised
from tests.mistakes.test_named_exactly import changed, fix_of, patched, why_of
from tests.static_bench import NODE, Bench

CLASS = "class MyFirstNode(Node):"
IMPORT = "from rclpy.node import Node\n"
SUPER = "super().__init__('my_first_node')"
TIMER = "self.create_timer(1.0, self.timer_callback)"
OF_OBJECT = "TypeError: object.__init__() takes exactly one argument (the instance to initialize)"
NO_HANDLE = "AttributeError: 'MyFirstNode' object has no attribute 'handle'"


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


@pytest.mark.parametrize(
    ("imported", "base"), [(IMPORT, "Node"), ("import rclpy.node as rn\n", "rn.Node")]
)
def test_the_call_of_the_init_of_node_needs_the_base(
    imported: str, base: str, tmp_path: Path
) -> None:
    call = (SUPER, f"{base}.__init__(self, 'my_first_node')")
    text = changed((IMPORT, imported), (CLASS, "class MyFirstNode(object):"), call)
    found = raised(NO_HANDLE, text, line_of(text, "__init__(self, 'my"))
    assert found is not None
    assert found.where is not None
    assert found.where.line == line_of(text, "class MyFirstNode")
    assert f"{base}.__init__(…) sets up a node" in why_of(found)
    assert fix_of(found) == f"Write: class MyFirstNode({base}):"
    right = changed((IMPORT, imported), (CLASS, f"class MyFirstNode({base}):"), call)
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


@pytest.mark.parametrize(
    ("wrong", "written"),
    [
        ("self.create_timer(1)", "self.create_timer(1, self.timer_callback)"),
        ("self.create_timer()", TIMER),
        ("self.create_timer(timer_period_sec=1.0)",
         "self.create_timer(timer_period_sec=1.0, callback=self.timer_callback)"),
        ("self.create_timer(callback=self.timer_callback)",
         "self.create_timer(1.0, callback=self.timer_callback)"),
        ("self.create_timer(lambda: self.timer_callback())",
         "self.create_timer(1.0, lambda: self.timer_callback())"),
        ("period = 1\n        self.create_timer(self.timer_callback)",
         "self.create_timer(period, self.timer_callback)"),
        (PARAMETER.replace(", self.timer_callback", ""), PARAMETER.splitlines()[1].strip()),
        (PARAMETER.replace("self.get_parameter('period').value, ", ""),
         PARAMETER.splitlines()[1].strip()),
    ],
)  # fmt: skip
def test_a_call_of_create_timer_is_completed(wrong: str, written: str, tmp_path: Path) -> None:
    text = changed((TIMER, wrong))
    last = wrong.splitlines()[-1].strip()
    error = "TypeError: Node.create_timer() missing 1 required positional argument: 'callback'"
    found = raised(error, text, line_of(text, last))
    assert fix_of(found) == f"Write {written} instead of {last}."
    assert patched(found, text, tmp_path) == changed((TIMER, wrong.replace(last, written)))


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


def test_a_parameter_is_declared_above_the_line_that_reads_it(tmp_path: Path) -> None:
    text = changed(rows(READ, MADE))
    found = raised(f"{UNDECLARED}period", text, line_of(text, "period ="))
    line = line_of(text, "period =")
    assert fix_of(found) == f"Write this line above line {line}: {DECLARED}"
    assert patched(found, text, tmp_path) == changed(rows(DECLARED, READ, MADE))


def test_the_default_value_of_an_unknown_parameter_is_left_open(tmp_path: Path) -> None:
    text = changed(
        ("self.counter_ = 0", "self.counter_ = 0\n        self.get_parameter('x').value")
    )
    found = raised(f"{UNDECLARED}x", text, line_of(text, "get_parameter"))
    assert "self.declare_parameter('x', …)" in fix_of(found)
    assert not patched(found, text, tmp_path)


def test_a_parameter_that_the_callback_reads_is_declared_in_init() -> None:
    text = changed(("self.counter_ += 1", "self.counter_ += self.get_parameter('x').value"))
    found = raised(f"{UNDECLARED}x", text, line_of(text, "get_parameter"))
    line = line_of(text, "self.counter_ = 0")
    assert fix_of(found).startswith(f"Write this line in __init__, above line {line}, with the d")


def test_the_declared_name_that_is_nearly_right_is_named(tmp_path: Path) -> None:
    text = changed(rows(DECLARED, READ.replace("'period'", '"perio"'), MADE))
    found = raised(f"{UNDECLARED}perio", text, line_of(text, 'perio"'))
    assert fix_of(found) == 'Write "period" instead of "perio" in this line.'
    assert patched(found, text, tmp_path) == changed(
        rows(DECLARED, READ.replace("'period'", '"period"'), MADE)
    )


def test_a_line_that_declares_too_late_is_moved(tmp_path: Path) -> None:
    text = changed(rows(READ, DECLARED, MADE))
    found = raised(f"{UNDECLARED}period", text, line_of(text, "period ="))
    line = line_of(text, "declare_parameter")
    assert fix_of(found) == f"Move line {line}, which declares 'period', above this line."
    assert patched(found, text, tmp_path) == changed(rows(DECLARED, READ, MADE))


@pytest.mark.parametrize(
    ("line", "wrong", "right"),
    [
        ("period = self.get_parameter('period').get_parameter_value.double_value",
         "self.get_parameter('period').get_parameter_value",
         "self.get_parameter('period').get_parameter_value()"),
        ("period = self.get_parameter.double_value", "self.get_parameter",
         "self.get_parameter('period')"),
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


def test_the_logger_of_another_object_keeps_its_name() -> None:
    text = changed(("self.get_logger().info(", "self.get_logger.warning("))
    error = "AttributeError: 'function' object has no attribute 'warning'"
    found = raised(error, text, line_of(text, "get_logger."))
    assert fix_of(found) == "Write self.get_logger().warning(…)."


TEXT = "'Hello time: ' + str(self.counter_)"
TOO_FEW = "TypeError: MyFirstNode.text() missing 1 required positional argument: 'more'"


def with_text(head: str, call: str, body: str = TEXT) -> str:
    method = f"{head}\n        return {body}\n\n    def timer_callback"
    return changed((f"info({TEXT})", f"info({call})"), ("    def timer_callback", method))


@pytest.mark.parametrize(
    ("head", "call"),
    [
        ("    @property\n    def text(self, more):", "self.text"),
        ("    def text(self, more):", "self.text()"),
    ],
)
def test_an_unused_parameter_of_a_method_is_removed(head: str, call: str, tmp_path: Path) -> None:
    text = with_text(head, call)
    found = raised(TOO_FEW, text, line_of(text, "info("))
    assert fix_of(found).startswith("Remove more from the parameters of text in this line")
    assert patched(found, text, tmp_path) == with_text(head.replace(", more", ""), call)


def test_a_used_parameter_gets_a_value_in_the_call(tmp_path: Path) -> None:
    text = with_text("    def text(self, more):", "self.text()", f"{TEXT} + more")
    found = raised(TOO_FEW, text, line_of(text, "info("))
    assert fix_of(found).startswith("Write a value for more in the () of self.text() on this line.")
    assert not patched(found, text, tmp_path)


def test_a_property_that_uses_its_parameter_is_no_call(tmp_path: Path) -> None:
    text = with_text("    @property\n    def text(self, more):", "self.text", f"{TEXT} + more")
    found = raised(TOO_FEW, text, line_of(text, "info("))
    assert "delete @property" in fix_of(found)
    assert not patched(found, text, tmp_path)


MODULE = "TypeError: module() takes at most 2 arguments (3 given)"


@pytest.mark.parametrize(
    ("wrong", "base", "imported", "right"),
    [
        ("import rclpy.node as Node\n", "Node", IMPORT, "Node"),
        ("from rclpy import node as Node\n", "Node", IMPORT, "Node"),
        ("import rclpy.node as RosNode\n", "RosNode", "from rclpy.node import Node as RosNode\n",
         "RosNode"),
        ("import rclpy.node as rn\n", "rn", "import rclpy.node as rn\n", "rn.Node"),
        ("import rclpy.node\n", "rclpy.node", "import rclpy.node\n", "rclpy.node.Node"),
    ],
)  # fmt: skip
def test_a_module_for_a_base_is_corrected_where_it_is_wrong(
    wrong: str, base: str, imported: str, right: str, tmp_path: Path
) -> None:
    text = changed((IMPORT, wrong), (CLASS, f"class MyFirstNode({base}):"))
    found = raised(MODULE, text, line_of(text, "class MyFirstNode"))
    after = changed((IMPORT, imported), (CLASS, f"class MyFirstNode({right}):"))
    assert patched(found, text, tmp_path) == after


LOGGED = """\
def logged(function):
    def wrapper(self):
        function(self)
{}

class MyFirstNode"""


@pytest.mark.parametrize("line", ["rclpy.spin(node)", "self.create_timer"])
def test_a_decorator_that_returns_nothing_is_named(line: str, tmp_path: Path) -> None:
    method = ("    def timer_callback", "    @logged\n    def timer_callback")
    text = changed(("class MyFirstNode", LOGGED.format("")), method)
    found = raised("TypeError: 'NoneType' object is not callable", text, line_of(text, line))
    assert fix_of(found).startswith("Write return wrapper as the last line of logged")
    right = changed(("class MyFirstNode", LOGGED.format("    return wrapper\n")), method)
    assert patched(found, text, tmp_path) == right


FROM_PARTIAL = ("import rclpy\nfrom", "import rclpy\nfrom functools import partial\nfrom")
TAKES = "TypeError: MyFirstNode.timer_callback() {}"


@pytest.mark.parametrize(
    ("given", "error"),
    [
        ("self.timer_callback, 1", "takes 1 positional argument but 2 were given"),
        ("self.timer_callback, when=1", "got an unexpected keyword argument 'when'"),
    ],
)
def test_partial_gets_no_more_than_the_method_takes(given: str, error: str, tmp_path: Path) -> None:
    text = changed(FROM_PARTIAL, (TIMER, f"self.create_timer(1.0, partial({given}))"))
    found = raised(TAKES.format(error), text, line_of(text, "rclpy.spin"))
    assert fix_of(found) == f"Write partial(self.timer_callback) instead of partial({given})."
    assert patched(found, text, tmp_path) == changed(
        FROM_PARTIAL, (TIMER, "self.create_timer(1.0, partial(self.timer_callback))")
    )


def test_a_partial_that_rclpy_refuses_before_it_calls_it_is_named(tmp_path: Path) -> None:
    """From kilted on rclpy looks at the parameters first; the words are of a real run."""
    text = changed(FROM_PARTIAL, (TIMER, "self.create_timer(1.0, partial(self.timer_callback, 1))"))
    error = (
        "ValueError: partial object functools.partial(<bound method MyFirstNode.timer_callback of "
        "<my_robot_controller.my_first_node.MyFirstNode object at 0x7fac840c6410>>, 1) has incorrect "
        "arguments"
    )
    found = raised(error, text, line_of(text, "rclpy.spin"))
    assert (
        fix_of(found)
        == "Write partial(self.timer_callback) instead of partial(self.timer_callback, 1)."
    )
    assert patched(found, text, tmp_path) == changed(
        FROM_PARTIAL, (TIMER, "self.create_timer(1.0, partial(self.timer_callback))")
    )


def test_partial_without_a_value_is_not_told_to_change_the_def_alone() -> None:
    text = changed(
        FROM_PARTIAL,
        (TIMER, "self.create_timer(1.0, partial(self.timer_callback))"),
        ("def timer_callback(self)", "def timer_callback(self, what)"),
    )
    error = TAKES.format("missing 1 required positional argument: 'what'")
    found = raised(error, text, line_of(text, "rclpy.spin"))
    assert "Pass a value for what in the () of partial." in fix_of(found)


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
    assert fix_of(found) == "Write self before n in this line: def make_text(self, n):"
    right = method.replace("(n)", "(self, n)", 1)
    assert patched(found, text, tmp_path) == changed(call, ("    def timer_callback", right))


def test_a_function_of_the_file_is_called_without_self(tmp_path: Path) -> None:
    function = "def make_text(n):\n    return 'Hello time: ' + str(n)\n\n\nclass MyFirstNode"
    call = "info({}make_text(self.counter_))"
    text = changed((f"info({TEXT})", call.format("self.")), ("class MyFirstNode", function))
    error = "AttributeError: 'MyFirstNode' object has no attribute 'make_text'"
    found = raised(error, text, line_of(text, "info("))
    assert fix_of(found) == "Write make_text instead of self.make_text."
    right = changed((f"info({TEXT})", call.format("")), ("class MyFirstNode", function))
    assert patched(found, text, tmp_path) == right


def test_a_number_has_no_value(tmp_path: Path) -> None:
    text = changed(("str(self.counter_)", "str(self.counter_.value)"))
    error = "AttributeError: 'int' object has no attribute 'value'"
    found = raised(error, text, line_of(text, "info("))
    assert fix_of(found) == "Write self.counter_ instead of self.counter_.value."
    assert patched(found, text, tmp_path) == changed()


def test_the_value_of_a_parameter_is_read_from_it(tmp_path: Path) -> None:
    text = changed(rows(DECLARED, READ.replace(".get_parameter_value()", ""), MADE))
    error = "AttributeError: 'Parameter' object has no attribute 'double_value'"
    found = raised(error, text, line_of(text, "period ="))
    assert ".get_parameter_value().double_value instead of .double_value" in fix_of(found)
    assert patched(found, text, tmp_path) == changed(rows(DECLARED, READ, MADE))


def test_a_parameter_that_is_declared_elsewhere_gets_its_line_in_init() -> None:
    text = changed(
        rows(READ, MADE),
        (
            "node = MyFirstNode()\n",
            "node = MyFirstNode()\n    node.declare_parameter('period', 1.0)\n",
        ),
    )
    found = raised(f"{UNDECLARED}period", text, line_of(text, "period ="))
    assert DECLARED in fix_of(found)
    assert f"delete line {line_of(text, 'node.declare')}" in fix_of(found)


def test_what_declares_a_parameter_returns_no_number(tmp_path: Path) -> None:
    text = changed(rows(f"period = {DECLARED}", MADE))
    error = "TypeError: float() argument must be a string or a real number, not 'Parameter'"
    found = raised(error, text, line_of(text, "create_timer"))
    assert fix_of(found) == f"Write {DECLARED}.value instead of {DECLARED}."
    assert patched(found, text, tmp_path) == changed(rows(f"period = {DECLARED}.value", MADE))
