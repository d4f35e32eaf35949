"""The mistake behind a symptom is found in the source of differently written nodes."""

from __future__ import annotations

import textwrap

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.recognise import SYMPTOMS, behind_error, behind_symptom
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.source.node import MOST_BYTES, NodeSource, read_node
from grader.report.model import Where
from tests.corpus.build import SOLUTION
from tests.corpus.model import NODE
from tests.marking import ASSIGNMENT

FILE = "my_robot_controller/my_first_node.py"
RIGHT = (SOLUTION / NODE).read_text(encoding="utf-8")
OTHERWISE = textwrap.dedent(
    """\
    import rclpy
    from rclpy.executors import SingleThreadedExecutor
    from rclpy.node import Node as RosNode


    class Hello(RosNode):
        def __init__(self):
            super().__init__(node_name='my_first_node')
            self.n = 0
            self.timer = self.create_timer(callback=self.tick, timer_period_sec=1)

        def tick(self):
            self.get_logger().info(f"Hello time: {self.n}")
            self.n = self.n + 1


    def main(args=None):
        rclpy.init(args=args)
        hello = Hello()
        executor = SingleThreadedExecutor()
        executor.add_node(hello)
        executor.spin()
    """
)


def node_in(text: str) -> NodeSource:
    source = read_node({FILE: text.encode()}.get, FILE, "main")
    assert source is not None
    return source


def look(symptom: str, text: str) -> RecognisedMistake | None:
    return behind_symptom(symptom, Suspect(node_in(text), ASSIGNMENT))


def raised(error: str, text: str, line: int | None, inside: str = "") -> RecognisedMistake | None:
    where = Where(file=FILE, line=line) if line else None
    return behind_error(Raised(error, where, node_in(text), ASSIGNMENT, inside))


def line_of(text: str, part: str) -> int:
    (number,) = [n for n, line in enumerate(text.splitlines(), 1) if part in line]
    return number


@pytest.mark.parametrize(
    ("symptom", "old", "new", "wanted", "at"),
    [
        ("run.exits_at_once", "executor.spin()", "pass", "spin_missing", "def main"),
        ("run.exits_at_once", "executor.spin()", "executor.spin_once()", "spin_missing", "spin_once"),
        ("run.exits_at_once", "executor.spin()", "executor.spin", "spin_missing",
         "executor.spin"),
        ("run.exits_at_once", "hello = Hello()", "hello = None", "main_empty", "def main"),
        ("run.no_lines", "        self.timer = self.create_timer(callback=self.tick, "
         "timer_period_sec=1)\n", "", "timer_missing", "def __init__"),
        ("run.no_lines", "sec=1)", "sec=1000)", "period_wrong", "create_timer"),
        ("run.no_lines", ".info(", ".debug(", "debug_level", "debug"),
        ("run.constant_counter", "        self.n = self.n + 1\n", "", "counter_not_increased",
         "Hello time"),
        ("run.by_hand", "callback=self.tick,", "callback=self.tick(),", "callback_called",
         "create_timer"),
        ("run.print_not_logger", "self.get_logger().info(", "print(", "print_used", "print("),
        ("run.stops", "self.n = self.n + 1", "self.n += 1; input()", "waits_inside", "input"),
        ("run.no_lines", "def tick(self):", "def tick(self):\n        while True:\n"
         "            pass", "waits_inside", "while"),
    ],
)  # fmt: skip
def test_a_mistake_is_found_in_a_node_written_differently(
    symptom: str, old: str, new: str, wanted: str, at: str
) -> None:
    assert OTHERWISE.count(old) == 1
    text = OTHERWISE.replace(old, new)
    found = look(symptom, text)
    assert found is not None
    assert found.kind == f"node.{wanted}"
    assert found.where == Where(file=FILE, line=line_of(text, at))


def test_a_loop_that_ends_is_not_reported() -> None:
    text = OTHERWISE.replace("self.n = self.n + 1", "while True:\n            break")
    assert look("run.stops", text) is None


@pytest.mark.parametrize(
    ("period", "sleep"), [("1", "0.5"), ("1", "seconds"), ("1", ""), ("2", "0.5")]
)
def test_a_sleep_that_does_not_separate_lines_is_not_reported(period: str, sleep: str) -> None:
    text = OTHERWISE.replace("self.n = self.n + 1", f"self.n += 1; time.sleep({sleep})")
    assert look("run.wrong_period", text.replace("sec=1)", f"sec={period})")) is None


@pytest.mark.parametrize("text", [RIGHT, OTHERWISE])
@pytest.mark.parametrize(
    "symptom",
    ["run.exits_at_once", "run.no_node", "run.constant_counter", "run.wrong_step", "run.twice",
     "run.by_hand", "run.stops", "run.ended_early", "run.print_not_logger", "run.wrong_period"],
)  # fmt: skip
def test_nothing_is_reported_in_a_right_node(symptom: str, text: str) -> None:
    assert look(symptom, text) is None


@pytest.mark.parametrize(
    ("error", "old", "new", "wanted", "close"),
    [
        ("AttributeError: 'Hello' object has no attribute 'tik'", "self.tick,", "self.tik,",
         "callback_misspelt", "tick"),
        ("AttributeError: 'Hello' object has no attribute 'N'", "{self.n}", "{self.N}",
         "attribute_not_set", "n"),
        ("AttributeError: 'Hello' object has no attribute 'get_loger'", "get_logger", "get_loger",
         "attribute_unknown", "get_logger"),
        ("AttributeError: module 'rclpy' has no attribute 'Init'", "rclpy.init(", "rclpy.Init(",
         "attribute_unknown", "init"),
        ("NameError: name 'Hallo' is not defined", "Hello()", "Hallo()", "name_unknown", "Hello"),
        ("TypeError: Hello.tick() missing 1 required positional argument: 'msg'", "tick(self)",
         "tick(self, msg)", "callback_no_self", ""),
        ("ModuleNotFoundError: No module named 'rcply'", "import rclpy\n", "import rcply\n",
         "import_misspelt", "rclpy"),
        ("TypeError: float() argument must be a string or a real number, not 'method'",
         "callback=self.tick, timer_period_sec=1", "self.tick, 1", "timer_arguments", ""),
        ("AttributeError: module 'a.b' has no attribute 'main'", "def main(", "def mian(",
         "main_misspelt", "main"),
        ("TypeError: Hello.__init__() takes 0 positional arguments but 1 was given",
         "__init__(self)", "__init__()", "callback_no_self", ""),
        ("TypeError: Hello.tick() takes 0 positional arguments but 1 was given", "tick(self)",
         "tick()", "callback_no_self", ""),
        ("TypeError: Node.destroy_node() missing 1 required positional argument: 'self'",
         "hello = Hello()", "hello = Hello\n", "class_not_called", ""),
        ("TypeError: descriptor '__init__' requires a 'super' object but received a 'str'",
         "super()._", "super._", "super_missing", ""),
        ("TypeError: 'int' object is not callable", "{self.n}", "{self.n()}", "not_callable", ""),
        ("TypeError: RcutilsLogger.info() missing 1 required positional argument: 'message'",
         'info(f"Hello time: {self.n}")', "info()", "argument_missing", ""),
        ("TypeError: Hello.__init__() missing 1 required positional argument: 'name'",
         "__init__(self)", "__init__(self, name)", "argument_missing", ""),
    ],
)  # fmt: skip
def test_an_exception_is_classified_and_the_right_name_suggested(
    error: str, old: str, new: str, wanted: str, close: str
) -> None:
    assert OTHERWISE.count(old) == 1
    text = OTHERWISE.replace(old, new)
    at = next(n for n, line in enumerate(text.splitlines(), 1) if new.strip() in line)
    found = raised(error, text, at)
    assert found is not None
    assert found.kind == f"node.{wanted}"
    assert found.words["close"] == close
    assert found.where is not None
    assert found.where.line == at


@pytest.mark.parametrize(
    ("error", "fix"),
    [
        ("ModuleNotFoundError: No module named 'rcply'", "Write rclpy instead of rcply."),
        ("ModuleNotFoundError: No module named 'qqqqq'", "Check the spelling of the module's name"),
        ("ImportError: cannot import name 'node' from 'rclpy.node' (/opt/node.py)",
         "Write Node instead of node."),
        ("ImportError: cannot import name 'Int' from 'std_msgs.msg' (/opt/msg.py)",
         "Compare the name with the module's documentation."),
        ("NameError: name 'Hallo' is not defined",
         "Write Hello instead of Hallo, or define Hallo first."),
        ("NameError: name 'Helllo' is not defined", "Write Hello instead of Helllo."),
        ("NameError: name 'qqqqq' is not defined", "Look where qqqqq is defined. If no line does"),
    ],
)  # fmt: skip
def test_the_fix_of_a_misspelt_name_has_the_nearest_known_name(error: str, fix: str) -> None:
    found = raised(error, OTHERWISE, 1)
    assert found is not None
    values = {**found.params, **found.words}
    assert str(CATALOGUE[found.kind].fix_text(values, found.variant)).startswith(fix)


def test_the_second_of_two_calls_of_init_is_reported() -> None:
    text = OTHERWISE.replace("args=args)\n", "args=args)\n    rclpy.init()\n")
    found = raised("RuntimeError: Context.init() must only be called once", text, None)
    assert found is not None
    assert found.kind == "node.init_twice"
    assert found.where == Where(file=FILE, line=line_of(text, "rclpy.init()"))


def test_an_exception_raised_by_the_student_is_not_diagnosed() -> None:
    assert raised("ValueError: that is not my number", RIGHT, 5) is None


def test_a_missing_node_name_is_distinguished_from_a_misspelt_init() -> None:
    error = "TypeError: Node.__init__() missing 1 required positional argument: 'node_name'"
    nameless = RIGHT.replace("__init__('my_first_node')", "__init__()")
    assert getattr(raised(error, nameless, 13), "kind", "") == "node.super_without_name"
    single = RIGHT.replace("def __init__(", "def _init_(")
    found = raised(error, single, None)
    assert found is not None
    assert (found.kind, found.params["name"]) == ("node.init_underscores", "_init_")


@settings(max_examples=150)
@given(st.data())
def test_any_source_is_examined_without_an_error(data: st.DataObject) -> None:
    lines = RIGHT.splitlines()
    kept = data.draw(st.lists(st.sampled_from(lines), max_size=40))
    source = read_node({FILE: "\n".join(kept).encode()}.get, FILE, "main")
    if source is None:
        return
    for symptom in SYMPTOMS:
        found = behind_symptom(symptom, Suspect(source, ASSIGNMENT))
        assert found is None or found.kind in CATALOGUE
    errors = [p.replace("\\", "") for kind in CATALOGUE.values() for p in kind.raised]
    error = data.draw(st.sampled_from(errors) | st.text(max_size=80))
    found = behind_error(Raised(error, Where(file=FILE, line=3), source, ASSIGNMENT))
    assert found is None or found.kind in CATALOGUE


def test_an_unparsable_or_huge_file_has_no_facts() -> None:
    for found in (b"def broken(:\n", b"x = 1\n" * MOST_BYTES):
        assert read_node({FILE: found}.get, FILE, "main") is None
