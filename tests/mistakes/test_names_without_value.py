"""Names without a value, calls without end and wrong signs: told where the source shows it."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import RIGHT, line_of, raised

TIMER = "        self.create_timer(1.0,"
STEP = "self.counter_ += 1"
UNBOUND = "UnboundLocalError: cannot access local variable 'period' where it is not associated with a value"


def not_defined(name: str) -> str:
    return f"NameError: name '{name}' is not defined"


@pytest.mark.parametrize(
    ("error", "old", "new", "at", "kind", "written"),
    [
        ("TypeError: 'method' object is not subscriptable", TIMER,
         "        self.create_timer[1.0, self.f]\n        self.create_timer(1.0,", "timer[",
         "square_brackets", "self.create_timer(1.0, self.f)"),
        ("TypeError: not all arguments converted during string formatting",
         "'Hello time: ' + str(self.counter_)", "'Hello time: ' % self.counter_", "% self",
         "percent_without_place", "'Hello time: %d' % self.counter_"),
    ],
)  # fmt: skip
def test_the_line_and_the_code_are_named(
    error: str, old: str, new: str, at: str, kind: str, written: str
) -> None:
    text = RIGHT.replace(old, new)
    found = raised(error, text, line_of(text, at))
    assert found is not None
    assert (found.kind, found.params["written"]) == (f"node.{kind}", written)


@pytest.mark.parametrize(
    ("name", "use", "statement"),
    [("os", "os.getcwd()", "import os"), ("deque", "deque()", "from collections import deque"),
     ("sleep", "sleep(1)", "from time import sleep")],
)  # fmt: skip
def test_the_import_of_a_standard_module_is_said(name: str, use: str, statement: str) -> None:
    text = RIGHT.replace(STEP, f"self.x_ = {use}")
    found = raised(not_defined(name), text, line_of(text, use))
    assert found is not None
    assert found.kind == "node.module_not_imported"
    assert found.params["statement"] == statement


@pytest.mark.parametrize(
    ("name", "use"), [("l", "l()"), ("string", "string(1)"), ("select", "select"), ("O", "O.x")]
)
def test_another_use_of_a_name_is_not_told_as_a_module(name: str, use: str) -> None:
    text = RIGHT.replace(STEP, f"self.x_ = str({use})")
    found = raised(not_defined(name), text, line_of(text, use))
    assert found is not None
    assert found.kind != "node.module_not_imported"


INSIDE = RIGHT.replace("import rclpy\nfrom rclpy.node import Node\n", "")


def test_an_import_inside_of_a_function_is_moved_to_the_top() -> None:
    inside = "    import rclpy\n    from rclpy.node import Node\n    rclpy.init("
    text = INSIDE.replace("    rclpy.init(", inside)
    found = raised(not_defined("Node"), text, line_of(text, "class "))
    assert found is not None
    assert found.kind == "node.import_inside"
    assert found.params["written"] == "from rclpy.node import Node"
    assert found.where is not None
    assert found.where.line == line_of(text, "from rclpy.node")


def test_an_import_at_the_top_or_in_the_same_function_is_not_told_as_one_inside() -> None:
    within = RIGHT.replace(
        "    rclpy.init(", "    print(sleep)\n    from time import sleep\n    rclpy.init("
    )
    text = RIGHT + "\n\nprint(Nod)\n"
    for name, source, at in (("sleep", within, "print("), ("Nod", text, "print(Nod")):
        found = raised(not_defined(name), source, line_of(source, at))
        assert found is None or found.kind != "node.import_inside"
