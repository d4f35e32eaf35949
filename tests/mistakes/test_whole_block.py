"""A fix that takes away the only statement of a block says what becomes of the block."""

from __future__ import annotations

import pytest

from grader.mistakes.whole_block import rest_of_block
from grader.report.model import Where
from tests.mistakes.test_from_source import FILE, line_of, look, node_in
from tests.mistakes.test_named_exactly import LOG, STEP, changed

RESET = "            self.counter_ = 0  # again\n"


@pytest.mark.parametrize(
    ("block", "said"),
    [
        ("        if True:\n{}", "block of line {0} (if True): delete that line too."),
        ("        if (True and\n                True):\n{}", "lines {0}, {1}: delete these lines too"),
        ("        for n in (1,):\n            if n:\n    {}", "lines {0}, {1}: delete these"),
        ("        if True:\n{}        else:\n            pass\n", "write pass in its place"),
        ("        if False:\n            pass\n        else:\n{}", "line {2} (else): delete"),
        ("        if False:\n            pass\n        elif True:\n{}", "line {2} (elif True): del"),
        ("        try:\n            pass\n        finally:\n{}", "write pass in its place"),
        ("        if True:\n            pass\n{}", ""),
        ("        if True: self.counter_ = 0  # again\n", ""),
        ("        n = 1; self.counter_ = 0  # again\n", "has another statement too: keep that"),
        ("        self.counter_ = 0; n = 1  # again\n", "has another statement too: keep that"),
    ],
)  # fmt: skip
def test_what_becomes_of_the_block_is_said(block: str, said: str) -> None:
    text = changed((f"        {LOG}\n", block.format(RESET) + f"        {LOG}\n"))
    first = line_of(text, "def timer_callback") + 2
    found = str(rest_of_block(node_in(text), Where(file=FILE, line=line_of(text, "# again"))))
    said = said.format(*range(first, first + 4))
    assert said in found
    assert bool(said) == bool(found)


def test_a_reset_that_may_never_run_is_not_why_nothing_counts() -> None:
    text = changed((STEP, "        if self.counter_ > 59:\n            self.counter_ = 0\n"))
    found = look("run.constant_counter", text)
    assert found is not None
    assert found.kind == "node.counter_not_increased"
