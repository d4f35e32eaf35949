"""Habits of the web, of C# and of a PLC: async helpers, scan cycles, static methods, executors."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.recognised import RecognisedMistake
from tests.mistakes.test_from_source import line_of, look, raised
from tests.mistakes.test_named_exactly import changed, fix_of, patched, why_of

CALLBACK = "    def timer_callback(self)"
LOG = "        self.get_logger().info('Hello time: ' + str(self.counter_))\n"
STEP = "        self.counter_ += 1\n"
TIMER = "self.create_timer(1.0, self.timer_callback)"
CLASS = "class MyFirstNode(Node):"
NO_TYPE = "TypeError: __init__(): incompatible constructor arguments."
NO_CALLBACK = "TypeError: Node.create_timer() missing 1 required positional argument: 'callback'"


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
    assert fix_of(found) == "Write super().__init__('my_first_node')."


def test_a_callback_in_a_chain_replaces_the_whole_chain() -> None:
    text = changed((TIMER, "self.create_timer(1.0).then(self.timer_callback)"))
    found = found_at(NO_CALLBACK, text, ".then(")
    assert fix_of(found) == f"Write {TIMER} instead of {found.params['name']}."
    assert found.params["name"] == "self.create_timer(1.0).then(self.timer_callback)"


def test_create_timer_is_no_decorator() -> None:
    text = (
        "import rclpy\nfrom rclpy.node import Node\n\nrclpy.init()\napp = Node('my_first_node')\n"
        "\n\n@app.create_timer(1.0)\ndef hello():\n    app.get_logger().info('Hello time: 0')\n"
        "\n\ndef main():\n    rclpy.spin(app)\n"
    )
    found = found_at(NO_CALLBACK, text, "@app.create_timer")
    assert fix_of(found) == (
        "Delete the line @app.create_timer(1.0), and write app.create_timer(1.0, hello) on a line of "
        "its own below the lines of hello, indented like def hello."
    )


def test_the_node_of_a_helper_is_kept() -> None:
    text = (
        "import rclpy\nfrom rclpy.node import Node\n\n\nclass Hello:\n    def __init__(self, owner):\n"
        "        owner.create_timer(1.0, self.tick)\n\n    def tick(self):\n"
        "        self.get_logger().info('Hello time: 0')\n\n\ndef main():\n    rclpy.init()\n"
        "    node = Node('my_first_node')\n    hello = Hello(node)\n    rclpy.spin(node)\n"
    )
    error = "AttributeError: 'Hello' object has no attribute 'get_logger'"
    found = found_at(error, text, "self.get_logger()")
    assert fix_of(found) == (
        "Write self.owner = owner in the __init__ of Hello, and self.owner.get_logger instead of "
        "self.get_logger."
    )


@pytest.mark.parametrize(("period", "told"), [("0.1", True), ("CYCLE", True), ("1.0", False)])
def test_a_scan_cycle_also_needs_the_period(period: str, told: bool) -> None:
    body = LOG + STEP
    inner = "".join(f"    {row}\n" for row in body.splitlines())
    text = changed(
        ("create_timer(1.0", f"create_timer({period}"),
        (body, f"        if self.counter_ == 1.0:\n{inner}"),
        (CLASS, f"CYCLE = 0.1\n\n\n{CLASS}"),
    )
    found = look("run.no_lines", text)
    assert found is not None
    assert found.kind == "node.log_if"
    assert ("the period 1.0 instead of 0.1" in fix_of(found)) is told


@pytest.mark.parametrize(
    ("number", "period", "fix"),
    [
        ("20", "0.1", "Write self.calls % 10 == 0 instead of self.calls % 20 == 0"),
        ("100", "0.5", "Write self.calls % 2 == 0 instead of self.calls % 100 == 0"),
        ("10", "0.1", ""),
        ("20", "0.3", ""),
    ],
)
def test_each_nth_call(number: str, period: str, fix: str) -> None:
    inner = f"    {LOG}    {STEP}"
    text = changed(
        ("create_timer(1.0", f"create_timer({period}"),
        (LOG + STEP, f"        self.calls += 1\n        if self.calls % {number} == 0:\n{inner}"),
        ("        self.counter_ = 0\n", "        self.counter_ = 0\n        self.calls = 0\n"),
    )
    found = look("run.stops", text)
    is_told = found is not None and found.kind == "node.nth_call"
    assert is_told is bool(fix)
    assert found is None or not fix or fix_of(found).startswith(fix)


def test_a_wrapper_around_the_callback_is_not_the_callback() -> None:
    text = changed(
        ("self.timer_callback)", "asyncio.run(self.timer_callback()))"),
        ("import rclpy\n", "import asyncio\nimport rclpy\n"),
    )
    found = found_at("TypeError: 'NoneType' object is not callable", text, "rclpy.spin", "rclpy")
    assert fix_of(found) == (
        "Pass the callback itself: write self.timer_callback instead of "
        "asyncio.run(self.timer_callback())."
    )


@pytest.mark.parametrize(
    ("body", "fix"),
    [
        ("", "Delete pause with its lines, and what calls it (lines: {line})."),
        (
            "        self.waited = 1\n",
            "Delete this line, and write def pause without async. Delete",
        ),
    ],
)
def test_the_await_of_a_helper_that_sleeps(body: str, fix: str) -> None:
    helper = f"    async def pause(self):\n{body}        await asyncio.sleep(0.5)\n\n"
    text = changed(
        ("import rclpy\n", "import asyncio\nimport rclpy\n"),
        (CALLBACK, f"{helper}    async def timer_callback(self)"),
        (STEP, f"{STEP}        await self.pause()\n"),
    )
    found = found_at("RuntimeError: no running event loop", text, "await asyncio.sleep", "Python")
    assert fix_of(found).startswith(fix.format(line=line_of(text, "await self.pause()")))


def test_a_class_method_that_uses_self() -> None:
    text = changed((CALLBACK, "    @classmethod\n    def timer_callback(cls)"))
    found = found_at("NameError: name 'self' is not defined", text, "self.get_logger()")
    assert fix_of(found) == "Delete the line @classmethod, and write def timer_callback(self):"


def test_the_method_that_the_base_class_gives_to_its_timer() -> None:
    base = (
        "class Ticking(Node):\n    def __init__(self, name):\n        super().__init__(name)\n"
        "        self.create_timer(1.0, self.on_tick)\n\n    def on_tick(self):\n"
        "        raise NotImplementedError\n\n\n"
    )
    text = changed((CLASS, f"{base}class MyFirstNode(Ticking):"), (f"        {TIMER}\n", ""))
    found = found_at("NotImplementedError", text, "raise NotImplementedError")
    assert fix_of(found) == "Write def on_tick instead of def timer_callback."


def test_a_base_class_whose_heir_has_no_such_method() -> None:
    base = "class Ticking(Node):\n    def setup(self):\n        raise NotImplementedError\n\n\n"
    text = changed(
        (CLASS, f"{base}class MyFirstNode(Ticking):"),
        ("        self.counter_ = 0\n", "        self.counter_ = 0\n        self.setup()\n"),
    )
    found = found_at("NotImplementedError", text, "raise NotImplementedError")
    assert fix_of(found).startswith("Write a method setup in the class MyFirstNode.")


def test_init_that_runs_first_is_not_to_be_moved() -> None:
    text = changed(
        ("node = MyFirstNode()", "node = made()"),
        ("def main(", "def made():\n    return MyFirstNode()\n\n\ndef main("),
    )
    error = "rclpy.exceptions.NotInitializedException: rclpy.init() has not been called."
    found = found_at(error, text, "super().__init__", "rclpy")
    assert found.kind == "node.ros_not_running"
    assert "or Ctrl+C, which ends spin" in fix_of(found)


def test_a_setter_that_sets_its_property() -> None:
    methods = (
        "    @property\n    def counter_(self):\n        return self.counter_\n\n"
        "    @counter_.setter\n    def counter_(self, value):\n        self.counter_ = value\n\n"
    )
    text = changed((CALLBACK, methods + CALLBACK))
    found = found_at("RecursionError: maximum recursion depth", text, "self.counter_ = value")
    read = line_of(text, "return self.counter_")
    assert f"(lines: {read}, {read + 4})" in fix_of(found)
    assert "each time it is set" in why_of(found)


def test_a_constructor_that_calls_the_earlier_one() -> None:
    text = changed(
        ("def __init__(self):", "def __init__(self, name):"),
        ("super().__init__('my_first_node')", "super().__init__(name)"),
        (
            CALLBACK,
            f"    def __init__(self):\n        self.__init__('my_first_node')\n\n{CALLBACK}",
        ),
    )
    error = "TypeError: MyFirstNode.__init__() takes 1 positional argument but 2 were given"
    found = found_at(error, text, "self.__init__(")
    line = line_of(text, "def __init__(self, name)")
    assert fix_of(found) == (
        f"Write def __init__(self, name='my_first_node'): in line {line}, and delete the def in this "
        "line with its block."
    )


@pytest.mark.parametrize(("made", "told"), [("Base()", True), ("MyFirstNode()", False)])
def test_the_base_class_is_created(made: str, told: bool) -> None:
    base = "class Base(Node):\n    def __init__(self):\n        super().__init__('my_first_node')\n"
    text = changed(
        (CLASS, f"{base}\n\nclass MyFirstNode(Base):"),
        (
            "        super().__init__('my_first_node')\n        self",
            "        super().__init__()\n        self",
        ),
        ("node = MyFirstNode()", f"node = {made}"),
    )
    found = look("run.no_lines", text)
    assert (found is not None and found.kind == "node.base_created") is told
    assert found is None or not told or fix_of(found) == "Write MyFirstNode() instead of Base()."


def test_a_bare_except_that_continues() -> None:
    spin = "        rclpy.spin(node)\n    except KeyboardInterrupt:\n        pass\n"
    loop = (
        "        while True:\n            try:\n                rclpy.spin(node)\n"
        "            except:\n                continue\n    except KeyboardInterrupt:\n        pass\n"
    )
    text = changed((spin, loop))
    found = look("run.ignores_interrupt", text)
    assert found is not None
    last = line_of(text, "continue")
    assert fix_of(found).startswith(
        f"Write except KeyboardInterrupt: here, and break instead of continue on line {last}:"
    )


def test_super_is_the_first_base_class() -> None:
    mixin = "class Counting:\n    def __init__(self):\n        self.counter_ = 0\n\n\n"
    text = changed((CLASS, f"{mixin}class MyFirstNode(Counting, Node):"))
    error = "TypeError: Counting.__init__() takes 1 positional argument but 2 were given"
    found = found_at(error, text, "super().__init__('my_first_node')")
    assert fix_of(found).startswith(
        "Write Node.__init__(self, 'my_first_node') instead of super().__init__('my_first_node'), and "
        "Counting.__init__(self) on a line of its own below it."
    )


def test_a_function_that_only_makes_the_callback() -> None:
    rows = f"        def handler():\n    {LOG}    {STEP}        return handler\n"
    text = changed((LOG + STEP, rows))
    found = look("run.no_lines", text)
    assert found is not None
    assert found.kind == "node.makes_callback"
    assert fix_of(found).startswith(
        "Write handler() instead of return handler: timer_callback calls handler then"
    )


def test_a_function_that_makes_a_callback_with_a_value_of_its_own_is_called_once() -> None:
    rows = (
        "        number = 0\n\n        def handler():\n            nonlocal number\n"
        "            self.get_logger().info(f'Hello time: {number}')\n            number += 1\n\n"
        "        return handler\n"
    )
    found = look("run.no_lines", changed((LOG + STEP, rows)))
    assert found is not None
    assert fix_of(found).startswith(
        "Write self.timer_callback() instead of self.timer_callback: create_timer gets what"
    )


def test_all_lines_of_a_property_that_sets_itself_are_changed(tmp_path: Path) -> None:
    methods = (
        "    @property\n    def counter_(self):\n        return self.counter_\n\n"
        "    @counter_.setter\n    def counter_(self, value):\n        self.counter_ = value\n\n"
    )
    text = changed((CALLBACK, methods + CALLBACK))
    found = found_at("RecursionError: maximum recursion depth", text, "self.counter_ = value")
    after = methods.replace("self.counter_", "self._counter_")
    assert patched(found, text, tmp_path) == changed((CALLBACK, after + CALLBACK))
