"""A callback that measures the time itself: the condition goes, and the timer gets the period."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.mistakes.test_from_source import line_of, look
from tests.mistakes.test_named_exactly import LOG, STEP, changed, fix_of, patched

LOG_LINE = f"        {LOG}\n"
START, TIMER = "        self.counter_ = 0\n", "self.create_timer(1.0,"
MS = "        now = time.time() * 1000\n        if now - self.last >= 1000:\n            self.last = now\n"
BARE = "        if time.time() - self.last > 1.0:\n            self.last = time.time()\n"
OF_ROS = (
    "        now = self.get_clock().now()\n"
    "        if (now - self.last).nanoseconds >= 1e9:\n            self.last = now\n"
)
NEXT = "        if time.monotonic() >= self.last:\n            self.last += 1.0\n"
RETURNS = "        if time.time() - self.last < 1.0:\n            return\n        self.last = time.time()\n"


def node(lines: str, period: str = "0.01") -> str:
    inner = "" if "return" in lines else "    "
    return changed(
        (LOG_LINE + STEP, f"{lines}{inner}{LOG_LINE}{inner}{STEP}"),
        (START, f"{START}        self.last = 0\n"),
        (TIMER, TIMER.replace("1.0", period)),
    )


@pytest.mark.parametrize("lines", [MS, BARE, OF_ROS, NEXT, RETURNS])
@pytest.mark.parametrize("period", ["0.01", "1.0"])
def test_the_condition_is_removed(lines: str, period: str, tmp_path: Path) -> None:
    text = node(lines, period)
    found = look("run.wrong_period", text)
    fix = fix_of(found)
    first = f"Write 1.0 as the period in line {line_of(text, 'create_timer')}."
    assert fix.startswith(first) is (period == "0.01")
    assert found is not None
    assert found.where is not None
    assert found.where.line == line_of(text, "        if ")
    assert patched(found, text, tmp_path) == changed()


def test_a_time_that_is_used_further_is_kept(tmp_path: Path) -> None:
    text = node(MS).replace(STEP, f"{STEP}            self.at = now\n")
    found = look("run.wrong_period", text)
    rows = ", ".join(str(line_of(text, part)) for part in ("self.last = 0", "self.last = now"))
    assert fix_of(found).endswith(f"(line {rows}).")
    assert "        now = time.time() * 1000\n" in patched(found, text, tmp_path)


@pytest.mark.parametrize(
    "lines",
    [
        "        now = time.time()\n        if self.counter_ < 5:\n            self.last = now\n",
        "        if self.counter_ - self.last >= 0:\n            self.last = self.counter_\n",
        "        if time.time() > 0:\n            self.last = 1\n",
    ],
)
def test_another_condition_is_no_measure_of_time(lines: str) -> None:
    found = look("run.wrong_period", node(lines))
    assert found is None or found.kind != "node.measures_time"
