"""A fix is told and made only where it holds: in branches, one-line functions, classes without __init__."""

from __future__ import annotations

import pytest

from grader.mistakes.fixes.placed import is_misplaced
from tests.mistakes.test_from_source import RIGHT, look, raised

LOG = "        self.get_logger().info('Hello time: ' + str(self.counter_))\n"


def changed(old: str, new: str, text: str = RIGHT) -> str:
    assert text.count(old) == 1
    return text.replace(old, new)


def told(symptom: str, text: str) -> tuple[str, str]:
    found = look(symptom, text)
    return (found.kind, found.variant) if found is not None else ("", "")


def test_a_trace_at_debug_level_is_not_the_reason_for_missing_lines() -> None:
    trace = f"        self.get_logger().debug('called')\n        if self.counter_ > 5:\n    {LOG}"
    found = look("run.no_lines", changed(LOG, trace))
    assert found is None or found.kind != "node.debug_level"
    line = LOG.replace(".info", ".debug")
    assert told("run.no_lines", changed(LOG, line))[0] == "node.debug_level"


@pytest.mark.parametrize(
    ("lines", "variant"),
    [
        ("print(t)\n        self.get_logger().info(t)\n", "beside"),
        ("if self.counter_:\n            print(t)\n        self.get_logger().info(t)\n", "beside"),
        ("print(t)\n        self.get_logger().debug(t)\n", ""),
        (
            "if self.counter_ % 2:\n            print(t)\n        else:\n"
            "            self.get_logger().info(t)\n",
            "",
        ),
    ],
)
def test_a_print_is_deleted_only_where_the_logger_logs_the_text_too(
    lines: str, variant: str
) -> None:
    text = f"        t = 'Hello time: ' + str(self.counter_)\n        {lines}"
    assert told("run.print_not_logger", changed(LOG, text)) == ("node.print_used", variant)


@pytest.mark.parametrize(
    "lines",
    [
        "if self.counter_ == 5:\n            exit()\n        else:\n    {log}",
        "if self.counter_ < 5:\n    {log}        else:\n            exit()\n",
    ],
)
def test_of_two_branches_none_is_told_to_go(lines: str) -> None:
    text = changed(LOG, "        " + lines.format(log=LOG))
    assert told("run.ended_early", text) == ("", "")


def test_a_dict_is_not_replaced_by_a_number() -> None:
    text = RIGHT.replace("self.counter_ = 0", "self.counter_ = {'n': None}")
    text = text.replace("str(self.counter_)", "str(self.counter_['n'])")
    text = text.replace("self.counter_ += 1", "self.counter_['n'] += 1")
    error = "TypeError: unsupported operand type(s) for +=: 'NoneType' and 'int'"
    found = raised(error, text, text[: text.index("'] += 1")].count("\n") + 1)
    assert found is None or found.kind != "node.counter_not_number"


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (b"def f():\n    return 1\n", b"def f():\n    return 1\n    n = 1\n"),
        (
            b"class C:\n    def f(self): self.n = 1\n",
            b"class C:\n    def f(self): self.n = 1\n    self.m = 1\n",
        ),
    ],
)
def test_a_change_that_python_does_not_run_is_noticed(old: bytes, new: bytes) -> None:
    assert is_misplaced(old, new)
    assert not is_misplaced(new, old)
    assert not is_misplaced(old, old)
