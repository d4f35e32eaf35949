"""Small changes of a node's files: what they write, that Python can read them, and their order."""

from __future__ import annotations

import ast

import pytest

from grader.package.source.node import read_node
from grader.package.source.small_changes import SmallChange, small_changes
from grader.package.source.small_values import Goal

PATH = "my_robot_controller/my_first_node.py"
GOAL = Goal("Hello time: ", "", 0, 1, 1.0)
NODE = """\
import rclpy
from rclpy.node import Node


class MyFirstNode(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.counter_ = 0
        self.create_timer(1.0, self.timer_callback)

    def timer_callback(self):
        self.get_logger().info("Hello time: " + str(self.counter_))
        self.counter_ += 1


def main(args=None):
    rclpy.init(args=args)
    node = MyFirstNode()
    rclpy.spin(node)
    rclpy.shutdown()


if __name__ == "__main__":
    main()
"""
MISTAKES = [
    ("self.create_timer(1.0,", "self.create_timer(1000,", "seconds"),
    ("self.create_timer(1.0,", "self.create_timer(0.001,", "seconds"),
    (".info(", ".debug(", "value"),
    ('"Hello time: " + ', '"Hello time: " - ', "value"),
    ("str(self.counter_)", "str([self.counter_])", "value"),
    ("str(self.counter_))", "str(self.counter_ & 7))", "value"),
    ("str(self.counter_))", "str(DATA[self.counter_]))", "value"),
    ("str(self.counter_))", "str(self.counter_), self)", "argument"),
    ("MyFirstNode()\n", "MyFirstNode\n", "called"),
    ("self.timer_callback)", "self.timer_callback())", "not_called"),
    ("        self.counter_ += 1\n", "", "below"),
    ("    def timer_callback", "    @property\n    def timer_callback", "deleted"),
    ("    rclpy.spin(node)\n", "    rclpy.shutdown()\n    rclpy.spin(node)\n", "deleted"),
    (
        "    rclpy.init(args=args)\n    node = MyFirstNode()\n",
        "    node = MyFirstNode()\n    rclpy.init(args=args)\n",
        "moved_down",
    ),
    (
        "    node = MyFirstNode()\n    rclpy.spin(node)\n",
        "    rclpy.spin(node)\n    node = MyFirstNode()\n",
        "moved_down",
    ),
    (
        "        self.counter_ += 1\n",
        "        if self.counter_ < 0:\n            self.counter_ += 1\n",
        "condition",
    ),
    (
        "        self.counter_ += 1\n",
        "        while self.counter_ < 3:\n            self.counter_ += 1\n",
        "loop",
    ),
    ("    def timer_callback", "    async def timer_callback", "value"),
    ('"Hello time: " + str(self.counter_)', 'f"Hello time: {{self.counter_}}"', "value"),
    ("self.counter_ += 1", "++self.counter_", "unkept"),
    ("    rclpy.spin(node)\n", "    assert args is not None\n    rclpy.spin(node)\n", "deleted"),
]
OLD_VALUE = "        value = self.counter_\n        self.counter_ += 1\n        return value\n"
F_STRING = NODE.replace('"Hello time: " + str(self.counter_)', 'f"Hello time: {self.counter_}"')


def changes(text: str, **more: str) -> list[SmallChange]:
    files = {PATH: text, **{f"my_robot_controller/{name}.py": code for name, code in more.items()}}
    encoded = {path: code.encode() for path, code in files.items()}
    source = read_node(encoded.get, PATH, "main")
    assert source is not None
    return small_changes(source, GOAL)


def same(text: str) -> str:
    """Return a program without what does not matter: comments, blank lines and quotes."""
    return ast.dump(ast.parse(text.replace("self.create_timer(1,", "self.create_timer(1.0,")))


@pytest.mark.parametrize(("right", "wrong", "sort"), MISTAKES)
def test_one_of_the_changes_undoes_a_mistake(right: str, wrong: str, sort: str) -> None:
    text = NODE.replace(right, wrong, 1)
    assert text != NODE
    found = [one for one in changes(text) if same(one.text) in (same(NODE), same(F_STRING))]
    assert [one.change.sort for one in found][:1] == [sort]


def test_a_line_that_is_moved_up_is_told_with_the_line_below_it() -> None:
    text = NODE.replace("    rclpy.init(args=args)\n", "").replace(
        "    rclpy.shutdown()\n", "    rclpy.shutdown()\n    rclpy.init(args=args)\n"
    )
    found = [one.change for one in changes(text) if same(one.text) == same(NODE)]
    assert [(one.sort, one.name, one.written) for one in found] == [
        ("moved", "rclpy.init(args=args)", "node = MyFirstNode()")
    ]


def test_a_second_class_of_the_same_name_is_left_out() -> None:
    again = "class MyFirstNode(Node):\n    pass\n\n\n"
    text = NODE.replace("def main(", again + "def main(")
    found = [one for one in changes(text) if same(one.text) == same(NODE)]
    assert [one.change.sort for one in found] == ["deleted_lines"]
    moved = [one for one in changes(text) if one.change.sort.startswith("moved")]
    assert not [one for one in moved if one.change.name.startswith("class ")]


def test_another_base_becomes_rclpys_node() -> None:
    text = NODE.replace("from rclpy.node import Node", "from platform import node")
    text = text.replace("(Node)", "(node)")
    found = [one.text for one in changes(text) if one.change.sort == "base"]
    assert [one.splitlines()[0] for one in found] == ["from rclpy.node import Node"]
    assert "class MyFirstNode(Node):" in found[0]


def test_no_attribute_is_set_instead_of_another() -> None:
    text = NODE.replace("self.counter_ = 0", "self.counter_ = 0\n        self.begin = 5")
    other = [one for one in changes(text) if "self.begin += 1" in one.text]
    assert all("self.counter_ += 1" in one.text for one in other)


def test_what_is_counted_already_is_not_counted_twice() -> None:
    assert not [one for one in changes(NODE) if one.change.sort == "below"]


def test_a_line_is_moved_out_of_a_branch() -> None:
    branch = (
        "        if self.counter_ % 2:\n            print('odd')\n            self.counter_ += 1\n"
    )
    text = NODE.replace("        self.counter_ += 1\n", branch)
    after = "        if self.counter_ % 2:\n            print('odd')\n        self.counter_ += 1\n"
    found = [one for one in changes(text) if after in one.text]
    assert [(one.change.sort, one.change.form) for one in found] == [
        ("out", "if self.counter_ % 2:")
    ]


def test_a_local_name_becomes_an_attribute_in_the_whole_class() -> None:
    text = NODE.replace("self.counter_ = 0", "counter_ = 0")
    text = text.replace("(self.counter_)", "(counter_)").replace("self.counter_ +=", "counter_ +=")
    text = text.replace(
        "(self):\n        self.get", "(self):\n        global counter_\n        self.get"
    )
    assert [one.change.sort for one in changes(text) if one.text == NODE] == ["own"]


def test_other_modules_of_the_package_are_changed_too() -> None:
    text = NODE.replace(
        "import rclpy\n", "import rclpy\nfrom my_robot_controller import settings\n", 1
    )
    text = text.replace("(1.0,", "(settings.PERIOD,")
    found = changes(text, settings="PERIOD = 1000\n")
    assert ("my_robot_controller/settings.py", "PERIOD = 1\n") in [
        (one.path, one.text.replace("1.0", "1")) for one in found
    ]


def test_each_change_can_be_read_and_is_another_text() -> None:
    found = changes(NODE)
    assert len({one.text for one in found} | {NODE}) == len(found) + 1
    for one in found:
        ast.parse(one.text)


def test_the_smallest_changes_come_first() -> None:
    costs = [one.cost for one in changes(NODE)]
    assert costs == sorted(costs)
    assert len(set(costs)) > 2


def test_the_guard_at_the_end_is_left_alone() -> None:
    assert not [one for one in changes(NODE) if 'if __name__ == "__main__":' not in one.text]


def test_a_file_in_another_encoding_is_left_alone() -> None:
    assert changes("# coding: latin-1\n" + NODE) == []


def test_all_other_bytes_stay() -> None:
    text = NODE.replace("\n", "\r\n").replace("import rclpy\r\n", "import rclpy  # é\r\n", 1)
    for one in changes(text):
        assert "# é\r\n" in one.text
        assert "\n" not in one.text.replace("\r\n", "")


def test_no_comparison_takes_the_place_of_in() -> None:
    text = NODE.replace(
        "    rclpy.spin(node)\n", "    assert args in (None, [])\n    rclpy.spin(node)\n"
    )
    assert not [one for one in changes(text) if "args == " in one.text or "args != " in one.text]


def test_no_statement_becomes_a_value_that_nothing_uses() -> None:
    text = NODE.replace("    rclpy.spin(node)\n", "    rclpy.spin(node)\n    yield node\n")
    assert not [one for one in changes(text) if "\n    node\n" in one.text]


TRUTHS = [
    ("x = args or 5", "x = 5 if args is None else args", "falsy"),
    ("print(args or 5)", "print((5 if args is None else args))", "falsy"),
    ("x = 1 if args else 2", "x = 1 if args is not None else 2", "falsy"),
    ("x = 1 if not args else 2", "x = 1 if args is None else 2", "falsy"),
    ("x = args == 1.0", "x = round(args, 6) == 1.0", "inexact"),
    ("x = args % 1 == 0", "x = round(args, 6) % 1 == 0", "inexact"),
    ("x = int(args)", "x = round(args)", "inexact"),
    ("x = args // 1", "x = round(args, 6) // 1", "inexact"),
    ("x = args + 1.0", "x = args + 1", "value"),
]


@pytest.mark.parametrize(("before", "after", "sort"), TRUTHS)
def test_a_condition_asks_for_none_and_a_float_is_rounded(
    before: str, after: str, sort: str
) -> None:
    text = NODE.replace("    rclpy.spin(node)\n", f"    {before}\n    rclpy.spin(node)\n")
    found = [one.change.sort for one in changes(text) if f"    {after}\n" in one.text]
    assert found == [sort]


def test_a_function_returns_the_value_from_before_its_change() -> None:
    step = "    def step(self):\n        self.counter_ += 1\n        return self.counter_\n\n"
    text = NODE.replace("    def timer_callback", step + "    def timer_callback")
    found = [one for one in changes(text) if one.change.sort == "returned"]
    assert [OLD_VALUE in one.text for one in found] == [True]


def test_a_sum_that_a_statement_works_out_is_kept() -> None:
    text = NODE.replace("self.counter_ += 1", "self.counter_ + 1")
    found = [one for one in changes(text) if one.change.sort == "unkept"]
    assert ["self.counter_ = self.counter_ + 1\n" in one.text for one in found] == [True]


def test_the_function_that_reads_the_counter_comes_before_one_that_only_logs() -> None:
    text = NODE.replace("self.counter_ += 1", "++self.counter_")
    text = text.replace(
        "    def timer_callback",
        "    def show(self, text):\n        self.get_logger().info(text)\n\n    def timer_callback",
    ).replace('self.get_logger().info("H', 'self.show("H')
    found = [(one.cost, one.text) for one in changes(text) if one.change.sort == "below"]
    assert [
        cost for cost, new in found if "++self.counter_\n        self.counter_ += 1" in new
    ] == [3]
    assert [cost for cost, new in found if "info(text)\n        self.counter_ += 1" in new] == [5]


def test_a_method_whose_value_is_used_returns_the_object() -> None:
    every = "    def every(self, period):\n        self.period = period\n\n"
    text = NODE.replace("    def timer_callback", every + "    def timer_callback")
    text = text.replace("node = MyFirstNode()", "node = MyFirstNode().every(1)")
    found = [one for one in changes(text) if one.change.sort == "gives_itself"]
    after = every.replace("= period\n", "= period\n        return self\n")
    assert [(one.change.name, after in one.text) for one in found] == [("every", True)]


def test_what_runs_in_del_is_not_changed() -> None:
    end = "    def __del__(self):\n        self.end(self.counter_)\n\n"
    text = NODE.replace("    def timer_callback", end + "    def timer_callback")
    assert all(end in one.text for one in changes(text) if one.change.sort == "called")


def test_a_change_that_leaves_a_name_unused_costs_more() -> None:
    text = NODE.replace("self.counter_ = 0", "first = 5\n        self.counter_ = 0 + first")
    found = {one.text: one.cost for one in changes(text)}
    hidden = text.replace("= 0 + first", "= 0")
    corrected = text.replace("= 5", "= 0")
    assert found[corrected] < found[hidden]


UNITS = [
    ("self.create_timer(self.period,", "self.create_timer(self.period / 1000,"),
    ("self.create_timer(a.nanoseconds,", "self.create_timer(a.nanoseconds / 1e9,"),
]


@pytest.mark.parametrize(("wrong", "right"), UNITS)
def test_a_period_in_another_unit_becomes_seconds(wrong: str, right: str) -> None:
    text = NODE.replace("self.create_timer(1.0,", wrong)
    found = [one.change.sort for one in changes(text) if right in one.text]
    assert found == ["seconds"]


def test_ok_is_a_condition_already() -> None:
    text = NODE.replace("    rclpy.spin(node)\n", "    x = rclpy.ok() == 0\n")
    found = [(one.cost, one.change.sort) for one in changes(text) if "x = rclpy.ok()\n" in one.text]
    assert found == [(1, "value")]


def test_the_calls_of_a_table_become_functions() -> None:
    table = "    table = {1: args.on_one(), 2: args.on_two()}\n"
    text = NODE.replace("    rclpy.spin(node)\n", table + "    rclpy.spin(node)\n")
    after = "    table = {1: args.on_one, 2: args.on_two}\n"
    found = [one.change.sort for one in changes(text) if after in one.text]
    assert found == ["not_called"]


def test_a_mask_is_left_out_before_its_bits_are_changed() -> None:
    text = NODE.replace("self.counter_ += 1", "self.counter_ = self.counter_ + 1 & (1 << 2) - 1")
    assert not [one for one in changes(text) if "(0 << 2)" in one.text or "<< 3" in one.text]
    found = [one.cost for one in changes(text) if "= self.counter_ + 1\n" in one.text]
    assert found == [2]


def test_no_number_is_below_zero() -> None:
    text = NODE.replace("self.counter_ = 0", "self.counter_ = 2")
    assert not [one for one in changes(NODE) if "= -1" in one.text]
    assert [one for one in changes(text) if "self.counter_ = 1\n" in one.text]


def test_nothing_is_compared_with_itself() -> None:
    loop = "        self.last = 3\n        while self.counter_ > self.last:\n            self.counter_ -= 1\n"
    found = changes(NODE.replace("        self.counter_ += 1\n", loop))
    assert found
    assert not [one for one in found if "self.last > self.last" in one.text]


def test_a_conversion_gets_other_units() -> None:
    text = NODE.replace("self.counter_ = 0", "self.counter_ = 0\n        self.ms = 5 // 1000")
    found = [one.change for one in changes(text) if one.change.sort == "unit"]
    assert [(one.name, one.written) for one in found] == [
        ("1000", "1000000"),
        ("1000", "1000000000"),
    ]
    assert not [one for one in changes(NODE) if one.change.sort == "unit"]


def test_a_parameter_is_read_from_its_other_fields() -> None:
    text = NODE.replace("(1.0,", "(self.get_parameter('p').get_parameter_value().double_value,")
    found = [one for one in changes(text) if one.change.sort == "field"]
    assert {one.change.written for one in found} == {"integer_value", "string_value", "bool_value"}
    assert all(f"get_parameter_value().{one.change.written}," in one.text for one in found)


def test_a_period_that_is_worked_out_stays() -> None:
    text = NODE.replace("create_timer(1.0,", "create_timer(self.seconds(),")
    assert not [one for one in changes(text) if "create_timer(1.0," in one.text]


def test_a_line_below_spin_is_moved_above_it() -> None:
    text = NODE.replace("    rclpy.spin(node)\n", "    rclpy.spin(node)\n    node.begin()\n")
    found = [one.change for one in changes(text) if one.change.sort == "before_spin"]
    assert [(one.name, one.written) for one in found] == [("node.begin()", "rclpy.spin(node)")]
    assert not [one for one in changes(NODE) if one.change.sort == "before_spin"]


SWITCH = NODE.replace("self.counter_ = 0", "self.counter_ = 0\n        self.on = False").replace(
    "        self.counter_ += 1\n", "        if not self.on:\n            self.counter_ += 1\n"
)


def test_a_switch_is_not_turned_round_where_it_is_asked() -> None:
    found = [one.text for one in changes(SWITCH)]
    assert not [one for one in found if "if self.on:" in one or "if self.on is None:" in one]
    assert [one for one in found if "self.on = True" in one]
    number = SWITCH.replace("self.on = False", "self.on = 0")
    assert [one for one in changes(number) if "if self.on is None:" in one.text]


def test_a_modulo_becomes_no_sum() -> None:
    text = NODE.replace("(1.0,", "(self.counter_ % 10,")
    assert not [one for one in changes(text) if "self.counter_ + 10" in one.text]


def test_a_level_that_is_not_shown_becomes_info() -> None:
    text = NODE.replace("(self):\n        self.get", "(self, level='debug'):\n        self.get")
    assert [one for one in changes(text) if "level='info'" in one.text]


def test_only_a_line_like_that_of_the_count_gets_its_text() -> None:
    ready = NODE.replace(
        "self.counter_ = 0\n", "self.counter_ = 0\n        self.get_logger().info('ready')\n"
    )
    texts = [one.text for one in changes(ready)]
    assert not [
        one for one in texts if one.count("f'Hello time: {self.counter_}'") and "'ready'" not in one
    ]
    close = NODE.replace('"Hello time: " +', '"hello Time " +')
    assert [one for one in changes(close) if "info(f'Hello time: {self.counter_}')" in one.text]


def test_a_timer_is_left_out_after_what_its_callback_does() -> None:
    text = NODE.replace(
        "        self.create_timer(1.0, self.timer_callback)\n",
        "        self.create_timer(1.0, self.timer_callback)\n        self.create_timer(5.0, self.report)\n",
    )
    text = text.replace(
        "        self.counter_ += 1\n",
        "        self.counter_ += 1\n\n    def report(self):\n        print(self.counter_)\n        self.counter_ = 0\n",
    )
    costs = {one.change.name: one.cost for one in changes(text) if one.change.sort == "deleted"}
    assert costs["self.counter_ = 0"] < costs["self.create_timer(5.0, self.report)"]


def test_no_change_makes_a_line_that_does_nothing() -> None:
    texts = [one.text for one in changes(NODE.replace("+= 1", "= self.counter_ + 1"))]
    assert texts
    assert not [one for one in texts if "self.counter_ = self.counter_\n" in one]
    assert not [one for one in texts if "self.counter_ + 0" in one]


def test_a_name_that_is_none_first_may_be_asked_the_other_way_round() -> None:
    text = NODE.replace(
        "        self.create_timer",
        "        self.made = None\n        if self.made:\n            self.create_timer",
    )
    assert [one for one in changes(text) if "if self.made is None:" in one.text]


@pytest.mark.parametrize(
    ("code", "sort", "new"),
    [
        ("self.on = ~self.on", "bits", "self.on = not self.on"),
        ("value = [~self.on]", "bits", "value = [(not self.on)]"),
        ("if self.on & (n % 2 == 0): pass", "bits", "if self.on and (n % 2 == 0): pass"),
        ("if (n > 1) | self.on: pass", "bits", "if (n > 1) or self.on: pass"),
        ("n = 10^3", "power", "n = 10 ** 3"),
    ],
)
def test_what_works_on_bits_becomes_what_is_meant(code: str, sort: str, new: str) -> None:
    text = NODE.replace("self.counter_ = 0", code)
    found = [one.text for one in changes(text) if one.change.sort == sort]
    assert found == [NODE.replace("self.counter_ = 0", new)]


def test_an_order_does_not_become_an_equality() -> None:
    text = NODE.replace(
        "self.counter_ += 1", "if self.counter_ >= 0:\n            self.counter_ += 1"
    )
    written = {one.change.written for one in changes(text) if ">=" in one.change.name}
    assert {"self.counter_ > 0", "self.counter_ <= 0"} <= written
    assert not [code for code in written if "==" in code or "!=" in code]


def test_a_difference_of_times_becomes_seconds() -> None:
    text = NODE.replace("self.counter_ += 1", "if now - self.then > 1.0:\n            pass")
    found = [one.change.written for one in changes(text) if one.change.sort == "seconds"]
    assert "(now - self.then).nanoseconds / 1e9" in found


def test_digits_in_quotes_become_a_number_and_a_changed_text_is_kept() -> None:
    text = NODE.replace("self.counter_ = 0", "self.counter_ = '0'\n        name.replace('a', 'b')")
    found = {one.change.sort: one.change.written for one in changes(text)}
    assert found["digits"] == "0"
    assert found["unkept"] == "name = name.replace('a', 'b')"
