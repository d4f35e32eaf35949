"""Names without a value, calls without end and wrong signs: told where the source shows it."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import RIGHT, line_of, raised

STEP = "self.counter_ += 1"


def not_defined(name: str) -> str:
    return f"NameError: name '{name}' is not defined"


@pytest.mark.parametrize(
    ("name", "use", "statement"),
    [("os", "os.getcwd()", "import os"), ("deque", "deque()", "from collections import deque"),
     ("sleep", "sleep(1)", "from time import sleep")],
)  # fmt: skip
def test_the_import_of_a_standard_module_is_said(name: str, use: str, statement: str) -> None:
    text = RIGHT.replace(STEP, f"self.x_ = {use}")
    found = raised(not_defined(name), text, line_of(text, use))
    assert found is not None
    assert found.kind == "node.import_missing"
    assert found.params["statement"] == statement


@pytest.mark.parametrize(
    ("name", "use"), [("l", "l()"), ("string", "string(1)"), ("select", "select"), ("O", "O.x")]
)
def test_another_use_of_a_name_is_not_told_as_a_module(name: str, use: str) -> None:
    text = RIGHT.replace(STEP, f"self.x_ = str({use})")
    found = raised(not_defined(name), text, line_of(text, use))
    assert found is not None
    assert found.kind != "node.import_missing"
