"""Diagnoses of threads, loops, the start and the end of a node: each statement is true."""

from __future__ import annotations

import pytest

from grader.mistakes.recognised import RecognisedMistake
from tests.mistakes.other_forms import RIGHT, TIMER, changed
from tests.mistakes.test_from_source import line_of, look, raised
from tests.mistakes.test_spun_and_ended import texts

SPIN = "        rclpy.spin(node)\n"
INIT = "    rclpy.init(args=args)\n"
MADE = "    node = MyFirstNode()\n"
THREADING = (
    "import rclpy\n",
    "import threading\nimport time\nfrom threading import Thread\nimport rclpy\n",
)
NO_TIMER = (f"        {TIMER}\n", "")
LOOP = "        while rclpy.ok():\n            time.sleep(1.0)\n            node.timer_callback()\n"


def kind_of(found: RecognisedMistake | None) -> str:
    return "" if found is None else found.kind


STEP = "        self.counter_ += 1\n"


@pytest.mark.parametrize("looped", [True, False])
def test_a_loop_above_spin_is_deleted_and_spin_stays(looped: bool) -> None:
    spin = f"    {SPIN}" if looped else SPIN
    text = changed(RIGHT, THREADING, NO_TIMER, (SPIN, LOOP + spin))
    fix = texts(look("run.never_spins", text))[1]
    line = line_of(text, "rclpy.spin(node)")
    assert fix.endswith(f"delete the loop: line {line} spins the node.") is not looped


def test_an_executor_may_get_the_node_through_a_name_of_add_node() -> None:
    spin = (
        "        executor = rclpy.executors.SingleThreadedExecutor()\n{}        executor.spin()\n"
    )
    add = "        add = executor.add_node\n        add(node)\n"
    for added, found in ((add, False), ("", True)):
        text = changed(RIGHT, (SPIN, spin.format(added)))
        kind = kind_of(look("run.never_spins", text))
        assert (kind == "node.executor_without_node") is found


@pytest.mark.parametrize(
    ("tried", "line", "found"),
    [
        ("rclpy.spin_once(node)", "pass", True),
        ("rclpy.spin_once(node)", "running = False", False),
        ("node.value = int('3')", "pass", False),
    ],
)
def test_an_except_that_lets_the_loop_end_is_not_the_cause(
    tried: str, line: str, found: bool
) -> None:
    loop = (
        "        running = True\n        while running:\n            try:\n"
        f"                {tried}\n            except:\n                {line}\n"
        f"            rclpy.spin_once(node, timeout_sec=0)\n"
    )
    if "spin" in tried:
        loop = loop.replace("            rclpy.spin_once(node, timeout_sec=0)\n", "")
    text = changed(RIGHT, (SPIN, loop))
    kind = kind_of(look("run.ignores_interrupt", text))
    assert (kind == "node.interrupt_swallowed") is found


def test_a_loop_that_is_over_soon_does_not_keep_init_from_returning() -> None:
    loop = "        for _ in range(3):\n            time.sleep(0.1)\n"
    text = changed(RIGHT, THREADING, (TIMER, f"{TIMER}\n{loop}"))
    assert kind_of(look("run.never_spins", text)) != "node.constructor_repeats"
    text = changed(RIGHT, THREADING, (STEP, STEP + loop))
    assert kind_of(look("run.stops", text)) != "node.callback_repeats"


NOT_INITIALIZED = "rclpy.exceptions.NotInitializedException: rclpy.init() has not been called"
BUILD = "def build():\n    return MyFirstNode()\n\n\n"


@pytest.mark.parametrize("on_import", [True, False])
def test_a_function_that_is_called_on_import_makes_the_node_then(on_import: bool) -> None:
    made, inside = ("node = build()\n\n\n", "") if on_import else ("", "    node = build()\n")
    text = changed(RIGHT, (INIT + MADE, inside + INIT), ("def main(", f"{BUILD}{made}def main("))
    found = raised(NOT_INITIALIZED, text, line_of(text, "super()"), "rclpy")
    assert (kind_of(found) == "node.made_on_import") is on_import
    if on_import:
        assert found is not None
        assert found.where is not None
        assert found.where.line == line_of(text, "node = build()")
        assert texts(found)[1].startswith("Move this line into main, below rclpy.init(args=args)")
