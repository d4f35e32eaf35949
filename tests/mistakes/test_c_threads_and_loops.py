"""Diagnoses of threads, loops, the start and the end of a node: each statement is true."""

from __future__ import annotations

from grader.mistakes.recognised import RecognisedMistake
from tests.mistakes.other_forms import RIGHT, TIMER, changed
from tests.mistakes.test_from_source import look

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


def test_a_loop_that_is_over_soon_does_not_keep_init_from_returning() -> None:
    loop = "        for _ in range(3):\n            time.sleep(0.1)\n"
    text = changed(RIGHT, THREADING, (TIMER, f"{TIMER}\n{loop}"))
    assert kind_of(look("run.never_spins", text)) != "node.waits_inside"
    text = changed(RIGHT, THREADING, (STEP, STEP + loop))
    assert kind_of(look("run.stops", text)) != "node.waits_inside"
