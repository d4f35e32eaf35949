"""Diagnoses that could mislead: the cause is named, and what only looks like one is not."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.catalogue import CATALOGUE
from grader.run.observer import Event
from grader.verdict.checks.counting import _first_wrong
from grader.verdict.diagnose import diagnose
from tests.mistakes.test_diagnose import RIGHT, TRACEBACK, evidence, failed
from tests.mistakes.test_from_source import look, raised
from tests.static_bench import Bench

HANDLING = "\nDuring handling of the above exception, another exception occurred:\n\n"
IGNORED = """\
Exception ignored in: <function Executor.__del__ at 0x7f>
Traceback (most recent call last):
  File "/opt/ros/jazzy/lib/python3.12/site-packages/rclpy/executors.py", line 257, in __del__
    if self._sigint_gc is not None:
AttributeError: 'SingleThreadedExecutor' object has no attribute '_sigint_gc'
"""
UNBOUND = (
    "UnboundLocalError: cannot access local variable 'node' where it is not associated with a value"
)
LOG = "        self.get_logger().info('Hello time: ' + str(self.counter_))\n"


def changed(old: str, new: str) -> str:
    assert RIGHT.count(old) == 1
    return RIGHT.replace(old, new)


def line_of(text: str, part: str) -> int:
    return next(n for n, line in enumerate(text.splitlines(), 1) if part in line)


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path / "my_robot_controller")


def test_an_error_in_a_finally_is_not_taken_for_the_cause(bench: Bench) -> None:
    text = changed(
        "    node = MyFirstNode()\n    try:\n", "    try:\n        node = MyFirstNode()\n"
    )
    text = text.replace("        self.counter_ = 0\n", "        self.counter_ = zero\n")
    cause = "NameError: name 'zero' is not defined"
    shown = HANDLING.join(
        (
            TRACEBACK.format(line=line_of(text, "= zero"), error=cause),
            TRACEBACK.format(line=line_of(text, "destroy_node"), error=UNBOUND),
        )
    )
    found = diagnose(failed("run.died_at_start"), evidence(bench, text, shown))
    assert found.mistakes[0].id == "node.name_unknown"
    assert found.where is not None
    assert found.where.line == line_of(text, "= zero")


def test_a_misspelt_except_does_not_hide_the_error_before_it(bench: Bench) -> None:
    text = changed("def timer_callback(self)", "def timer_callback(self, event)")
    text = text.replace("except KeyboardInterrupt:", "except KeyboardInterupt:")
    cause = (
        "TypeError: MyFirstNode.timer_callback() missing 1 required positional argument: 'event'"
    )
    line = line_of(text, "except")
    in_except = TRACEBACK.format(line=line, error="NameError: name 'KeyboardInterupt'").replace(
        "NameError", "    except KeyboardInterupt:\nNameError"
    )
    spun = TRACEBACK.format(line=line_of(text, "rclpy.spin"), error=cause)
    found = diagnose(
        failed("run.ended_early"), evidence(bench, text, HANDLING.join((spun, in_except)))
    )
    assert found.mistakes[0].id == "node.callback_no_self"


def test_an_error_of_ones_own_while_ctrl_c_is_handled_stays_the_cause(bench: Bench) -> None:
    text = changed("        node.destroy_node()\n", "        count.stop()\n")
    error = "NameError: name 'count' is not defined"
    shown = HANDLING.join(
        (
            TRACEBACK.format(line=line_of(text, "rclpy.spin"), error="KeyboardInterrupt"),
            TRACEBACK.format(line=line_of(text, "count.stop()"), error=error),
        )
    )
    found = diagnose(failed("run.error_at_stop"), evidence(bench, text, shown))
    assert found.where is not None
    assert found.where.line == line_of(text, "count.stop()")


def test_an_exception_that_python_ignores_is_not_the_cause(bench: Bench) -> None:
    text = changed("self.counter_ = 0", "self.counter_ = zero")
    error = "NameError: name 'zero' is not defined"
    shown = TRACEBACK.format(line=line_of(text, "= zero"), error=error) + IGNORED
    found = diagnose(failed("run.died_at_start"), evidence(bench, text, shown))
    assert found.mistakes[0].id == "node.name_unknown"


def test_a_python_suggestion_helps_only_if_nothing_else_is_known(bench: Bench) -> None:
    text = changed("rclpy.init(args=args)", "rclpy.init(args=args.copi())")
    error = "AttributeError: 'list' object has no attribute 'copi'. Did you mean: 'copy'?"
    shown = TRACEBACK.format(line=line_of(text, "copi"), error=error)
    found = diagnose(failed("run.died_at_start"), evidence(bench, text, shown))
    assert found.mistakes[0].id == "node.attribute_unknown"
    assert found.fix.startswith("Write copy instead of copi")
    text = changed("'my_first_node'", "my_first_node")
    error = "NameError: name 'my_first_node' is not defined. Did you mean: 'MyFirstNode'?"
    shown = TRACEBACK.format(line=line_of(text, "(my_first_node)"), error=error)
    found = diagnose(failed("run.died_at_start"), evidence(bench, text, shown))
    assert found.fix == "Write 'my_first_node' instead of my_first_node."


@pytest.mark.parametrize(
    ("handler", "hidden"),
    [
        ("except:\n            pass", True),
        ("except Exception:\n            return", True),
        ("except (TypeError, ValueError):\n            print('oops')", True),
        ("except Exception as error:\n            print(error)", False),
        ("except Exception:\n            raise", False),
        ("except KeyboardInterrupt:\n            pass", False),
    ],
)
def test_only_an_except_that_shows_nothing_is_reported(handler: str, hidden: bool) -> None:
    text = changed(LOG, f"        try:\n    {LOG}        {handler}\n")
    found = look("run.no_lines", text)
    assert (found is not None and found.kind == "node.error_hidden") == hidden
    if found is not None:
        assert found.where is not None
        assert found.where.line == line_of(text, handler.partition("\n")[0])


def test_a_missing_timer_is_named_before_what_else_may_be_wrong() -> None:
    text = changed(LOG, f"        try:\n    {LOG}        except:\n            pass\n")
    text = text.replace("        self.create_timer(1.0, self.timer_callback)\n", "")
    found = look("run.no_lines", text)
    assert found is not None
    assert found.kind == "node.timer_missing"


def test_a_return_after_the_last_line_is_not_reported() -> None:
    text = changed("        self.counter_ += 1\n", "        self.counter_ += 1\n        return\n")
    for symptom in ("run.no_lines", "run.constant_counter", "run.exits_at_once"):
        assert look(symptom, text) is None


def test_the_node_is_never_suggested_to_be_its_class() -> None:
    text = changed("node = MyFirstNode()", "robot = MyFirstNode()")
    at = line_of(text, "rclpy.spin(node)")
    found = raised("NameError: name 'node' is not defined", text, at)
    assert found is not None
    assert (found.kind, found.params["close"]) == ("node.name_unknown", "robot")


@pytest.mark.parametrize(
    ("old", "new", "kind", "fix"),
    [
        ("self.counter_ += 1", "self.counter_ = self.counter + 1", "node.attribute_not_set",
         "Write self.counter_ instead of self.counter."),
    ],
)  # fmt: skip
def test_the_name_that_differs_from_all_others_is_the_one_to_correct(
    old: str, new: str, kind: str, fix: str
) -> None:
    text = changed(old, new)
    other = kind == "node.attribute_other_name"
    name, at = ("counter_", LOG.strip()) if other else ("counter", new)
    error = f"AttributeError: 'MyFirstNode' object has no attribute '{name}'"
    found = raised(error, text, line_of(text, at))
    assert found is not None
    assert (found.kind, found.variant) == (kind, "close")
    assert found.params["close"] == "counter_"
    values = {**found.params, **found.words}
    assert str(CATALOGUE[found.kind].fix_text(values, found.variant)).startswith(fix)


def test_a_name_that_no_line_sets_is_reported_where_it_is_used_first(bench: Bench) -> None:
    text = changed("    node = MyFirstNode()\n", "")
    error = "NameError: name 'node' is not defined"
    lines = [line_of(text, "rclpy.spin"), line_of(text, "destroy_node")]
    shown = HANDLING.join(TRACEBACK.format(line=line, error=error) for line in lines)
    found = diagnose(failed("run.died_at_start"), evidence(bench, text, shown))
    assert found.mistakes[0].id == "node.name_unknown"
    assert found.where is not None
    assert found.where.line == lines[0]


def test_a_second_definition_is_not_the_cause_if_nothing_is_lost() -> None:
    log = LOG.strip()
    first = f"    def timer_callback(self):\n        {log}\n        self.last = 1\n\n"
    text = RIGHT.replace("    def timer_callback", f"{first}    def timer_callback", 1)
    text = text.replace("        self.create_timer(1.0, self.timer_callback)\n", "")
    found = look("run.no_lines", text)
    assert found is not None
    assert found.kind == "node.timer_missing"


def test_a_class_in_a_plain_import_is_told_from_a_module_with_a_capital() -> None:
    error = "ModuleNotFoundError: No module named 'rclpy.Node'"
    for new, wanted in (
        ("import rclpy.Node", "Write from rclpy.node import Node instead of import rclpy.Node."),
        ("from rclpy.Node import Node", "Write rclpy.node instead of rclpy.Node."),
    ):
        text = changed("from rclpy.node import Node", new)
        found = raised(error, text, line_of(text, new))
        assert found is not None
        values = {**found.params, **found.words}
        assert str(CATALOGUE[found.kind].fix_text(values, found.variant)).startswith(wanted)


def test_a_line_at_each_tenth_call_is_not_reported() -> None:
    text = changed(LOG, f"        if self.counter_ % 10 == 0:\n    {LOG}")
    for symptom in ("run.stops", "run.no_lines", "run.wrong_step"):
        assert look(symptom, text) is None


def test_the_lines_around_the_wrong_step_are_shown() -> None:
    numbers = [0, 1, 2, 3, 4, 0, 1]
    events = [Event(f"n: {n}", wall=n, virtual=n, source="logger", n=n) for n in numbers]
    assert _first_wrong(events, 1) == 3
    assert _first_wrong(events[:5], 1) == 0


def test_only_a_line_with_create_timer_swaps_its_arguments() -> None:
    error = "TypeError: float() argument must be a string or a real number, not 'method'"
    text = changed("str(self.counter_)", "str(float(self.get_name))")
    found = raised(error, text, line_of(text, "float("))
    assert found is None or found.kind != "node.timer_arguments"
    timer = raised(error, RIGHT, line_of(RIGHT, "create_timer"))
    assert timer is not None and timer.kind == "node.timer_arguments"
