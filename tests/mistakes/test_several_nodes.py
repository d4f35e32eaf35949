"""Programs with several nodes or executors: what is spun, in which order, and what counts twice."""

from __future__ import annotations

from tests.mistakes.test_from_source import look
from tests.mistakes.test_named_exactly import changed, fix_of

MADE, SPIN = "    node = MyFirstNode()\n", "        rclpy.spin(node)\n"


def test_an_executor_of_a_with_is_spun_by_its_own_method() -> None:
    block = (
        "        with SingleThreadedExecutor() as executor:\n"
        "            executor.add_node(node)\n            executor.spin_once()\n"
    )
    found = look("run.exits_at_once", changed((SPIN, block)))
    assert fix_of(found) == "Write executor.spin() instead of executor.spin_once()."
