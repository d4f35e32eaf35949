"""The line that clears the terminal is named, with what its block then needs."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import look
from tests.mistakes.test_named_exactly import LOG, STEP, changed

LOG_LINE = f"        {LOG}\n"
TIMER = "    def timer_callback"


@pytest.mark.parametrize(
    "edits",
    [
        [(LOG, "print('\\r' + 'Hello time: ' + str(self.counter_), end='')")],
        [("        rclpy.spin(node)\n", "        os.system('clear')\n        rclpy.spin(node)\n")],
        [(STEP, f"{STEP}        print('\\033[92m')\n")],
        [(STEP, f"{STEP}        os.system('ls')\n")],
        [(STEP, f"{STEP}        self.data.clear()\n")],
    ],
)
def test_what_clears_nothing_is_not_named(edits: list[tuple[str, str]]) -> None:
    assert look("run.erased", changed(*edits)) is None
