"""A method that should replace an empty one of a base class, and has nearly its name."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import line_of, look, raised
from tests.mistakes.test_named_exactly import changed, fix_of, why_of

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


@pytest.mark.parametrize(
    ("base", "method"), [("on_cycle", "onCycle"), ("onCycle", "on_cycle"), ("on_cycle", "oncycle")]
)
@pytest.mark.parametrize("body", ["pass", "..."])
def test_the_line_and_its_name_are_told(base: str, method: str, body: str) -> None:
    text = node(base, method, body=body)
    found = look("run.no_lines", text)
    assert found is not None
    assert found.kind == "node.not_overridden"
    assert found.where is not None
    assert found.where.line == line_of(text, f"    def {method}")
    assert fix_of(found) == f"Write def {base} instead of def {method}."
    assert f"(line {line_of(text, f'    def {base}')}) is empty" in why_of(found)


def test_a_base_class_that_raises() -> None:
    text = node("on_cycle", "onCycle", body="raise NotImplementedError")
    found = raised("NotImplementedError", text, line_of(text, "        raise"))
    assert found is not None
    assert fix_of(found) == "Write def on_cycle instead of def onCycle."


@pytest.mark.parametrize("text", [node("on_cycle", "on_cycle"), node("on_cycle", "report")])
def test_a_method_of_that_name_or_of_another_is_no_mistake(text: str) -> None:
    found = look("run.no_lines", text)
    assert found is None or found.kind != "node.not_overridden"
