"""A wrong period is told at the number from which the node calculates it, and fixed there."""

from __future__ import annotations

import pytest

from grader.mistakes.catalogue import CATALOGUE, fixes_for
from grader.mistakes.fixes.case import Case, Finding
from grader.package.edit.files import Files
from grader.package.source.node import NodeSource, read_node
from grader.verdict.checks.timing import told_of_period
from tests.fixing import first_fix
from tests.marking import ASSIGNMENT
from tests.mistakes.other_forms import RIGHT, changed
from tests.mistakes.test_other_forms import submitted
from tests.static_bench import NODE

TIMER = "        self.create_timer(1.0, self.timer_callback)\n"
CLASS = "class MyFirstNode"
INIT = "    def __init__"
DECLARED = "        self.declare_parameter('rate', 10.0)\n"


def with_period(code: str, before: str = "", constant: str = "", own: str = "") -> str:
    """Return the node with another period, and with lines before it."""
    return changed(
        RIGHT,
        (TIMER, before + TIMER.replace("1.0", code)),
        (CLASS, f"{constant}{CLASS}"),
        (INIT, f"{own}{INIT}"),
    )


def source_in(text: str) -> NodeSource:
    source = read_node({NODE: text.encode()}.get, NODE, "main")
    assert source is not None
    return source


def told(text: str) -> tuple[str, str]:
    """Return the fix in words, and the code after the fix."""
    found = told_of_period(source_in(text), 1.0)
    words = {"period": "1.0", "callback": "timer_callback", **found.words}
    fix = str(CATALOGUE["run.wrong_period"].fix_text(words, found.variant))
    finding = Finding("run.period", "run.wrong_period", {}, NODE, found.where.line)
    new = first_fix(
        Case(Files.of(submitted({NODE: text})), finding, ASSIGNMENT), fixes_for(finding)
    )
    after = new.data(NODE) if new is not None else None
    return fix, after.decode() if after is not None else text


@pytest.mark.parametrize(
    ("code", "lines"),
    [
        # two numbers, a number that is set again, one that comes from elsewhere
        ("A / B", {"constant": "A = 1\nB = 10\n\n\n"}),
        ("1 / rate", {"before": "        rate = 10\n        rate = 20\n"}),
        ("1 / rate", {"before": "        rate = 10\n        rate += 1\n"}),
        ("1 / self.rate", {"before": "        self.rate = 10\n        self.rate = 2 * 10\n"}),
        ("1 / RATE", {"before": "        global RATE\n", "constant": "RATE = 10\n\n\n"}),
        ("1 / rate()", {}),
        ("1 / rate", {"before": "        for rate in (1, 10):\n            pass\n"}),
        ("1 / self.get_parameter('other').value", {"before": DECLARED}),
        # ROS reads 0.0 or nothing with the attribute of another type
        ("1 / self.get_parameter('rate').get_parameter_value().integer_value",
         {"before": DECLARED}),
        ("2 - rate", {"before": "        rate = 10\n"}),
        ("rate * rate", {"before": "        rate = 10\n"}),
    ],
)  # fmt: skip
def test_an_uncertain_number_is_not_changed(code: str, lines: dict[str, str]) -> None:
    text = with_period(code, **lines)
    fix = (
        f"The value of {code} must be 1.0. Correct the numbers from which it comes, or write 1.0 "
        "instead of it."
    )
    assert told(text) == (fix, text)


def test_the_timer_of_the_lines_is_told_and_not_another_one() -> None:
    other = "        self.create_timer(5.0, self.other)\n"
    text = changed(
        RIGHT,
        (TIMER, other + TIMER.replace("1.0", "2.0")),
        (INIT, f"    def other(self):\n        pass\n\n{INIT}"),
    )
    fix, after = told(text)
    assert fix == "Write 1.0 instead of 2.0."
    assert after == text.replace("2.0", "1.0")


def test_a_calculation_without_names_is_replaced_as_a_whole() -> None:
    assert told(with_period("1.0 / 10")) == (
        "Write 1.0 instead of 1.0 / 10.", RIGHT,
    )  # fmt: skip
    text = with_period("period", before="        period = 500 / 1000\n")
    assert told(text) == ("Write 1.0 instead of 500 / 1000.", text.replace("500 / 1000", "1.0"))


@pytest.mark.parametrize(
    "lines",
    [
        TIMER.replace("1.0", "0.5") * 2,
        f"        for _ in range(2):\n    {TIMER.replace('1.0', '0.5')}",
    ],
)
def test_once_is_said_only_if_there_can_be_several_timers(lines: str) -> None:
    once = "Let the program create this timer only once, with the period 1.0."
    assert told(changed(RIGHT, (TIMER, lines)))[0] == once
    assert told(with_period("0.5"))[0] == "Write 1.0 instead of 0.5."


def test_a_period_that_is_right_is_not_to_be_written() -> None:
    for code, constant in (("1.0", ""), ("T", "T = 1\n\n\n"), ("2 / 2", "")):
        told = told_of_period(source_in(with_period(code, constant=constant)), 1.0)
        assert told.variant == "there"
