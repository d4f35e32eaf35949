"""A method that should replace an empty one of a base class, and has nearly its name."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import look
from tests.mistakes.test_named_exactly import changed

CLASS = "class MyFirstNode(Node)"
CALLBACK = "    def timer_callback"


def node(base: str, method: str, *, body: str = "pass") -> str:
    """A node whose base class makes the timer and calls its own method `base`."""
    cycle = f"class Cycle(Node):\n    def tick(self):\n        self.{base}()\n\n    def {base}(self):\n        {body}\n\n\n"
    return changed(
        (CLASS, f"{cycle}class MyFirstNode(Cycle)"),
        ("self.timer_callback)", "self.tick)"),
        (CALLBACK, f"    def {method}"),
    )


@pytest.mark.parametrize("text", [node("on_cycle", "on_cycle"), node("on_cycle", "report")])
def test_a_method_of_that_name_or_of_another_is_no_mistake(text: str) -> None:
    found = look("run.no_lines", text)
    assert found is None or found.kind != "node.not_overridden"
