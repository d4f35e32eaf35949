"""A fix names the student's own line and words, and its patch is exactly that change."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from grader.mistakes.catalogue import CATALOGUE, fixes_for
from grader.mistakes.fixes.case import Case, Finding
from grader.mistakes.recognised import RecognisedMistake
from grader.package.edit.files import Files
from tests.fixing import first_fix
from tests.marking import ASSIGNMENT, taken_in
from tests.mistakes.test_diagnose import RIGHT
from tests.mistakes.test_from_source import line_of, look, raised
from tests.static_bench import NODE, Bench

LOG = "self.get_logger().info('Hello time: ' + str(self.counter_))"
STEP = "        self.counter_ += 1\n"
UNBOUND = "UnboundLocalError: cannot access local variable '{}' where it is not associated"
NO_INIT = "rclpy.exceptions.NotInitializedException: rclpy.init() has not been called"
MISSING = "TypeError: MyFirstNode.__init__() missing 1 required positional argument: '{}'"
DURATION = "TypeError: float() argument must be a string or a real number, not '{}'"
HELPER = """\
class HelloCounter:
    def __init__(self):
        self.value = 0

    def increase(self):
        self.value += 1


class MyFirstNode"""


def changed(*edits: tuple[str, str]) -> str:
    text = RIGHT
    for old, new in edits:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


def fix_of(found: RecognisedMistake | None) -> str:
    assert found is not None
    return str(CATALOGUE[found.kind].fix_text({**found.params, **found.words}, found.variant))


def why_of(found: RecognisedMistake | None) -> str:
    assert found is not None
    return str(CATALOGUE[found.kind].rationale({**found.params, **found.words}, found.variant))


def patched(found: RecognisedMistake | None, text: str, folder: Path) -> str:
    """Return the node's file after the fix of a mistake; "" if no fix is certain."""
    assert found is not None
    assert found.where is not None
    bench = Bench(folder / "my_robot_controller")
    bench.write(NODE, text)
    finding = Finding(
        "run.output", found.kind, dict(found.params), found.where.file, found.where.line
    )
    case = Case(Files.of(taken_in(bench.root)), finding, ASSIGNMENT)
    new = first_fix(case, fixes_for(finding))
    data = new.data(NODE) if new is not None else b""
    return (data or b"").decode()


def test_a_class_that_its_variable_hides_gets_a_name_in_capitals(tmp_path: Path) -> None:
    text = changed(("class MyFirstNode", "class node"), ("node = MyFirstNode()", "node = node()"))
    found = raised(UNBOUND.format("node"), text, line_of(text, "node = node()"))
    assert fix_of(found) == (
        f"Rename the class: write class MyFirstNode(Node): in line {line_of(text, 'class node')}, "
        "and node = MyFirstNode() in this line."
    )
    assert patched(found, text, tmp_path) == RIGHT


def test_all_that_means_the_class_gets_its_new_name(tmp_path: Path) -> None:
    text = changed(
        ("class MyFirstNode", "class node"),
        ("node = MyFirstNode()", "node = node()"),
        ("super().__init__", "super(node, self).__init__"),
    )
    found = raised(UNBOUND.format("node"), text, line_of(text, "node = node()"))
    assert f"instead of node in line {line_of(text, 'super')}." in fix_of(found)
    new = patched(found, text, tmp_path)
    assert new == RIGHT.replace("super().__init__", "super(MyFirstNode, self).__init__")


def test_a_variable_with_a_class_name_is_renamed_in_all_lines(tmp_path: Path) -> None:
    main = RIGHT.index("    node = MyFirstNode()")
    text = RIGHT[:main] + RIGHT[main:].replace("node = ", "MyFirstNode = ").replace(
        "(node)", "(MyFirstNode)"
    ).replace("node.destroy", "MyFirstNode.destroy")
    found = raised(UNBOUND.format("MyFirstNode"), text, line_of(text, "MyFirstNode = My"))
    assert fix_of(found).startswith("Give the variable another name: write node = MyFirstNode() in")
    assert patched(found, text, tmp_path) == RIGHT


@pytest.mark.parametrize(
    ("made", "shown", "step", "written"),
    [
        ("counter = HelloCounter()", "f'Hello time: {counter.value}'", "counter.increase()",
         "self.counter = HelloCounter()"),
        ("n = [0]", "f'Hello time: {n[0]}'", "n[0] += 1", "self.n = [0]"),
        ("state = {'n': 0}", "'Hello time: ' + str(state['n'])", "state['n'] += 1",
         "self.state = {'n': 0}"),
        ("numbers = itertools.count()", "'Hello time: %d' % next(numbers)", "pass",
         "self.numbers = itertools.count()"),
    ],
)  # fmt: skip
def test_a_counter_made_anew_in_each_call_is_made_once(
    made: str, shown: str, step: str, written: str, tmp_path: Path
) -> None:
    text = changed(
        ("class MyFirstNode", HELPER),
        (LOG, f"{made}\n        self.get_logger().info({shown})"),
        (STEP, f"        {step}\n"),
    )
    found = look("run.constant_counter", text)
    assert found is not None
    assert found.kind == "node.made_anew"
    assert found.where is not None
    assert found.where.line == line_of(text, f"        {made}")
    attribute = written.partition(" = ")[0]
    assert f"write {written} in __init__ instead of this line, and {attribute} inst" in fix_of(
        found
    )
    new = patched(found, text, tmp_path)
    assert f"        {written}\n" in new[: new.index("def timer_callback")]
    name = made.partition(" = ")[0]
    assert f" {made}\n" not in new
    used = re.sub(rf"(?<=[{{( ]){name}(?=[.\[)])", attribute, shown)
    assert used in new


@pytest.mark.parametrize(
    ("log", "step"),
    [
        ("parts = ['Hello time: ']\n        parts.append(str(self.counter_))\n"
         "        self.get_logger().info(''.join(parts))", ""),
        ("text = dict(n=self.counter_)\n        text['n'] += 0\n"
         "        self.get_logger().info(f'Hello time: {text[\"n\"]}')", ""),
        ("time = list()\n        time.append(1)\n        " + LOG, ""),
    ],
)  # fmt: skip
def test_another_object_of_the_callback_is_not_taken_for_the_counter(log: str, step: str) -> None:
    found = look("run.constant_counter", changed((LOG, log), (STEP, step)))
    assert found is None or found.kind != "node.made_anew"


def test_a_counter_that_init_makes_too_is_only_deleted(tmp_path: Path) -> None:
    text = changed(
        ("class MyFirstNode", HELPER),
        ("self.counter_ = 0", "self.counter_ = HelloCounter()"),
        (LOG, "self.counter_ = HelloCounter()  # new\n"
         "        self.get_logger().info(f'Hello time: {self.counter_.value}')"),
        (STEP, "        self.counter_.increase()\n"),
    )  # fmt: skip
    found = look("run.constant_counter", text)
    assert fix_of(found) == "Delete this line: __init__ sets self.counter_ already."
    assert patched(found, text, tmp_path) == text.replace(
        "        self.counter_ = HelloCounter()  # new\n", ""
    )


@pytest.mark.parametrize("symptom", ["run.stops", "run.wrong_step", "run.wrong_period"])
def test_a_throttled_log_of_a_fast_timer_needs_both_changes(symptom: str, tmp_path: Path) -> None:
    text = changed(
        ("create_timer(1.0,", "create_timer(0.1,"),
        ("str(self.counter_))", "str(self.counter_),\n            throttle_duration_sec=1.0)"),
    )
    found = look(symptom, text)
    assert found is not None
    assert found.where is not None
    assert found.where.line == line_of(text, "create_timer")
    assert fix_of(found) == (
        "Write 1.0 as the period in this line, and remove throttle_duration_sec=… from line "
        f"{line_of(text, 'throttle')}."
    )
    assert patched(found, text, tmp_path) == RIGHT


def test_a_throttled_log_of_a_right_timer_only_loses_its_option() -> None:
    text = changed(("str(self.counter_))", "str(self.counter_), throttle_duration_sec=60.0)"))
    found = look("run.wrong_step", text)
    assert found is not None
    assert found.kind == "node.log_option"


@pytest.mark.parametrize("period", ["0.1", "1 / 10", "2.0"])
def test_a_sleep_that_holds_back_a_timer_is_deleted_too(period: str, tmp_path: Path) -> None:
    text = changed(
        ("import rclpy\nfrom", "import time\nimport rclpy\nfrom"),
        ("create_timer(1.0,", f"create_timer({period},"),
        (STEP, f"{STEP}        time.sleep(3)\n"),
    )
    found = look("run.wrong_period", text)
    assert found is not None
    assert (found.kind, found.params["slept"]) == ("node.sleep_for_timer", "3")
    assert f"delete the sleep in line {line_of(text, 'sleep(')}" in fix_of(found)
    assert patched(found, text, tmp_path) == RIGHT


def test_an_init_below_the_guard_is_moved_as_it_is(tmp_path: Path) -> None:
    text = changed(
        ("    rclpy.init(args=args)\n", ""),
        ("def main(args=None):", "def main():"),
        ("'__main__':\n", "'__main__':\n    rclpy.init()\n"),
    )
    found = raised(NO_INIT, text, line_of(text, "super()"))
    assert found is not None
    assert found.where is not None
    line = line_of(text, "    rclpy.init()")
    assert (found.kind, found.where.line) == ("node.init_in_guard", line)
    assert fix_of(found) == f"Move rclpy.init() from line {line} to the first line of main."
    new = patched(found, text, tmp_path)
    assert new == RIGHT.replace("(args=args)", "()").replace("main(args=None)", "main()")


@pytest.mark.parametrize(
    ("old", "new", "fix"),
    [
        ("    rclpy.init(args=args)\n    node = MyFirstNode()\n",
         "    node = MyFirstNode()\n    rclpy.init()\n",
         "Move rclpy.init() to the first line of main."),
        ("    rclpy.init(args=args)\n", "", "Write rclpy.init() as the first line of main."),
    ],
)  # fmt: skip
def test_no_args_are_named_in_a_function_without_them(old: str, new: str, fix: str) -> None:
    text = changed((old, new), ("def main(args=None):", "def main():"))
    assert fix_of(raised(NO_INIT, text, line_of(text, "super()"))) == fix


@pytest.mark.parametrize(
    ("parameter", "old", "new", "call"),
    [
        ("name", "super().__init__('my_first_node')", "super().__init__(name)",
         "MyFirstNode('my_first_node')"),
        ("node_name", "super().__init__('my_first_node')", "super().__init__(node_name=node_name)",
         "MyFirstNode('my_first_node')"),
        ("start", "self.counter_ = 0", "self.counter_ = start", "MyFirstNode(0)"),
        ("period", "create_timer(1.0,", "create_timer(period,", "MyFirstNode(1.0)"),
    ],
)  # fmt: skip
def test_the_value_that_the_constructor_wants_is_named(
    parameter: str, old: str, new: str, call: str, tmp_path: Path
) -> None:
    text = changed(("__init__(self)", f"__init__(self, {parameter})"), (old, new))
    line = line_of(text, "node = MyFirstNode()")
    found = raised(MISSING.format(parameter), text, line)
    assert fix_of(found) == f"Pass a value for {parameter}: write {call} in line {line}."
    assert patched(found, text, tmp_path) == text.replace("MyFirstNode()", call)


def test_a_parameter_that_nothing_uses_is_removed(tmp_path: Path) -> None:
    text = changed(("__init__(self)", "__init__(self, args)"))
    found = raised(MISSING.format("args"), text, line_of(text, "node = MyFirstNode()"))
    assert fix_of(found).startswith("Remove args from the parameters in this line")
    assert patched(found, text, tmp_path) == RIGHT


def test_a_parameter_of_unknown_use_is_not_removed(tmp_path: Path) -> None:
    text = changed(
        ("__init__(self)", "__init__(self, prefix)"),
        ("self.counter_ = 0", "self.counter_ = 0\n        self.prefix = prefix"),
    )
    found = raised(MISSING.format("prefix"), text, line_of(text, "node = MyFirstNode()"))
    assert fix_of(found) == "Pass a value for prefix where MyFirstNode.__init__ is called."
    assert patched(found, text, tmp_path) == ""


def test_super_with_the_old_name_of_the_class(tmp_path: Path) -> None:
    text = RIGHT.replace("MyFirstNode", "HelloNode").replace("super()", "super(MyFirstNode, self)")
    found = raised("NameError: name 'MyFirstNode' is not defined", text, line_of(text, "super("))
    assert fix_of(found) == "Write super().__init__('my_first_node'): super() needs no arguments."
    assert "The class is called HelloNode (line " in why_of(found)
    assert patched(found, text, tmp_path) == RIGHT.replace("MyFirstNode", "HelloNode")


def test_the_old_name_of_a_class_before_what_the_class_has() -> None:
    text = RIGHT.replace("MyFirstNode", "HelloNode").replace("self.counter_", "MyFirstNode.counter")
    text = text.replace("(Node):\n", "(Node):\n    counter = 0\n")
    line = line_of(text, "Hello time: '")
    found = raised("NameError: name 'MyFirstNode' is not defined", text, line)
    assert found is not None
    assert found.params["close"] == "HelloNode"


@pytest.mark.parametrize(
    ("log", "fix", "after"),
    [
        (f"return {LOG}", "Delete only the word return in this line", LOG),
        (f"return (\n            {LOG}\n        )", "Delete only the word return in this line",
         f"(\n            {LOG}\n        )"),
        (f"{LOG}\n        return", "Delete this return", LOG),
        (f"{LOG}\n        return True", "Delete this return", LOG),
    ],
)  # fmt: skip
def test_an_early_return_goes_and_what_it_returns_stays(
    log: str, fix: str, after: str, tmp_path: Path
) -> None:
    text = changed((LOG, log))
    found = look("run.constant_counter", text)
    assert fix_of(found).startswith(fix)
    assert patched(found, text, tmp_path) == RIGHT.replace(LOG, after)


@pytest.mark.parametrize(
    ("written", "type_name"),
    [("Duration(seconds=1.0)", "Duration"), ("timedelta(seconds=1)", "datetime.timedelta")],
)
def test_a_duration_is_replaced_by_the_number(written: str, type_name: str, tmp_path: Path) -> None:
    text = changed(("self.create_timer(1.0,", f"self.timer = self.create_timer({written},"))
    found = raised(DURATION.format(type_name), text, line_of(text, "create_timer"))
    assert fix_of(found) == f"Write 1.0 instead of {written}."
    assert patched(found, text, tmp_path) == text.replace(written, "1.0")


def test_the_call_of_a_method_belongs_at_the_end_of_init(tmp_path: Path) -> None:
    timer = "        self.create_timer(1.0, self.timer_callback)\n"
    text = changed((timer, f"\n    def setup(self):\n{timer}"))
    found = look("run.no_lines", text)
    line = line_of(text, "self.counter_ = 0")
    assert fix_of(found) == f"Write self.setup() below line {line}, at the end of __init__."
    assert found is not None
    assert found.where is not None
    assert found.where.line == line
    new = patched(found, text, tmp_path)
    assert new == text.replace("self.counter_ = 0\n", "self.counter_ = 0\n        self.setup()\n")


def test_only_the_decorator_that_is_there_is_explained() -> None:
    text = changed(("    def timer_callback", "    @staticmethod\n    def timer_callback"))
    error = "TypeError: MyFirstNode.timer_callback() missing 1 required positional argument: 'self'"
    why = why_of(raised(error, text, line_of(text, "rclpy.spin")))
    assert "@staticmethod" in why
    assert "@classmethod" not in why
    assert "@property" not in why
