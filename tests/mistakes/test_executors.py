"""An executor: the node that it gets, and what spins it."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.mistakes.test_from_source import look
from tests.mistakes.test_named_exactly import changed, fix_of, patched

SPIN = "        rclpy.spin(node)\n"
MADE = "    node = MyFirstNode()\n"
EXECUTOR = f"{MADE}    executor = SingleThreadedExecutor()\n"
ADD, RUN = "        executor.add_node(node)\n", "        executor.spin()\n"


@pytest.mark.parametrize(
    "lines",
    [
        ADD + RUN,
        "        executor.add_node(helper)\n" + ADD + RUN + "        executor.add_node(other)\n",
        ADD + RUN + "        executor.add_node(other)\n",
    ],
)
def test_an_executor_that_has_the_node_is_right(lines: str) -> None:
    found = look("run.never_spins", changed((MADE, EXECUTOR), (SPIN, lines)))
    assert found is None or found.kind != "node.executor_without_node"


def test_spin_once_of_an_executor_becomes_its_spin(tmp_path: Path) -> None:
    text = changed((MADE, EXECUTOR), (SPIN, ADD + RUN.replace("spin", "spin_once")))
    found = look("run.exits_at_once", text)
    assert fix_of(found) == "Write executor.spin() instead of executor.spin_once()."
    assert patched(found, text, tmp_path) == text.replace("spin_once", "spin")
