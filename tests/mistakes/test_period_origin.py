"""A wrong period is told at the number from which the node calculates it, and fixed there."""

from __future__ import annotations

import pytest

from grader.mistakes.catalogue import CATALOGUE, fixes_for
from grader.mistakes.fixes.case import Case, Finding
from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import Suspect
from grader.package.edit.files import Files
from grader.package.source.node import NodeSource, read_node
from grader.package.source.period import origin_of, wrong_number
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
    ("code", "lines", "old", "new"),
    [
        ("1.0 / rate", {"before": f"{DECLARED}        rate = self.get_parameter('rate').value\n"},
         "10.0", "1.0"),
        ("1.0 / self.get_parameter('rate').value", {"before": DECLARED}, "10.0", "1.0"),
        ("1 / p.get_parameter_value().double_value",
         {"before": f"{DECLARED}        p = self.get_parameter('rate')\n"}, "10.0", "1.0"),
        ("1 / rate", {"before": "        rate = self.declare_parameter('r', value=4).value\n"},
         "4", "1"),
        ("ms / 1000", {"before": "        self.declare_parameters('', [('a', 7), ('ms', 250)])\n"
                                 "        ms = self.get_parameter('ms').value\n"}, "250", "1000"),
        ("1 / RATE", {"constant": "RATE = 10\n\n\n"}, "10", "1"),
        ("PERIOD_MS / 1000", {"constant": "PERIOD_MS = 500\n\n\n"}, "500", "1000"),
        ("1.0 / self.rate", {"before": "        self.rate: float = 5.0\n"}, "5.0", "1.0"),
        ("1.0 / self.RATE", {"own": "    RATE = 10\n\n"}, "10", "1"),
        ("self.period", {"before": "        hz = 0.5\n        self.period = 1.0 / float(hz)\n"},
         "0.5", "1.0"),
        ("self.get_parameter('rate').value", {"before": DECLARED}, "10.0", "1.0"),
    ],
)  # fmt: skip
def test_the_number_is_named_and_changed(
    code: str, lines: dict[str, str], old: str, new: str
) -> None:
    text = with_period(code, **lines)
    fix, after = told(text)
    assert fix.startswith(f"Write {new} instead of {old} in line ")
    assert after != text
    origin = origin_of(source_in(after), source_in(after).timers[0].period)
    assert origin is not None
    assert origin.seconds == 1.0
    assert len(after.splitlines()) == len(text.splitlines())


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
        f"The value of {code} must be 1.0. Correct the numbers from which it comes; or write 1.0 "
        f"instead of {code} in this call of create_timer."
    )
    assert told(text) == (fix, text)


@pytest.mark.parametrize(
    ("code", "lines", "old", "written"),
    [
        ("ms / 100", {"before": "        self.declare_parameter('ms', 1000)\n"
                                "        ms = self.get_parameter('ms').value\n"}, "100", "1000"),
        ("PERIOD_MS / 100", {"constant": "PERIOD_MS = 1000\n\n\n"}, "100", "1000"),
        ("PERIOD_MS / 1000000", {"constant": "PERIOD_MS = 1000\n\n\n"}, "1000000", "1000"),
        ("PERIOD / 100", {"constant": "PERIOD = 1000\n\n\n"}, "100", "1000"),
        ("periodMs * 0.01", {"before": "        periodMs = 1000\n"}, "0.01", "0.001"),
        ("1000 / RATE", {"constant": "RATE = 1\n\n\n"}, "1000", "1"),
        ("seconds(1000)",
         {"constant": "def seconds(milliseconds):\n    return milliseconds / 100\n\n\n"},
         "100", "1000"),
        ("self.seconds(1000)",
         {"own": "    def seconds(self, ms):\n        'in s'\n        return ms / 10\n\n"},
         "10", "1000"),
    ],
)  # fmt: skip
def test_the_unit_of_a_calculation_is_corrected_and_not_the_number(
    code: str, lines: dict[str, str], old: str, written: str
) -> None:
    text = with_period(code, **lines)
    fix, after = told(text)
    assert fix.startswith(f"Write {written} instead of {old} in line ")
    period = source_in(after).timers[0].period
    assert wrong_number(source_in(after), period, 1.0) is None
    origin = origin_of(source_in(after), period)
    assert origin is not None
    assert origin.seconds == 1.0


@pytest.mark.parametrize(
    ("code", "constant"),
    [
        ("T / 1000000", "T = 1000\n\n\n"),  # T in ms with another divisor, or another T in us
        ("T / 100", "T = 500\n\n\n"),
        ("PERIOD_MS / 10 / 10", "PERIOD_MS = 1000\n\n\n"),
        ("1 / PERIOD_MS", "PERIOD_MS = 1000\n\n\n"),
        ("HZ * 1", "HZ = 10\n\n\n"),
    ],
)
def test_of_several_numbers_none_is_named_if_it_is_not_certain(code: str, constant: str) -> None:
    text = with_period(code, constant=constant)
    fix, after = told(text)
    assert fix.startswith(f"The value of {code} must be 1.0.")
    assert after == text


def test_the_timer_of_the_lines_is_told_and_not_another_one() -> None:
    other = "        self.create_timer(5.0, self.other)\n"
    text = changed(
        RIGHT,
        (TIMER, other + TIMER.replace("1.0", "2.0")),
        (INIT, f"    def other(self):\n        pass\n\n{INIT}"),
    )
    fix, after = told(text)
    assert fix == "Write 1.0 instead of 2.0 in this call of create_timer."
    assert after == text.replace("2.0", "1.0")


def test_a_calculation_without_names_is_replaced_as_a_whole() -> None:
    assert told(with_period("1.0 / 10")) == (
        "Write 1.0 instead of 1.0 / 10 in this call of create_timer.", RIGHT,
    )  # fmt: skip
    text = with_period("period", before="        period = 500 / 1000\n")
    assert told(text) == ("Write period = 1.0.", text.replace("500 / 1000", "1.0"))


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
    assert told(with_period("0.5"))[0] == "Write 1.0 instead of 0.5 in this call of create_timer."


def test_a_parameter_in_milliseconds() -> None:
    before = "        self.declare_parameter('period', 1000)\n"
    text = with_period("self.get_parameter('period').value", before=before)
    found = behind_symptom("run.no_lines", Suspect(source_in(text), ASSIGNMENT))
    assert found is not None
    assert found.kind == "node.period_milliseconds"
    assert found.where is not None
    assert "declare_parameter" in text.splitlines()[(found.where.line or 0) - 1]


@pytest.mark.parametrize(
    ("code", "constant", "old", "written"),
    [
        ("T", "T = 10^0\n\n\n", "10^0", "10**0"),
        ("T", "T = 10^1\n\n\n", "10^1", "1.0"),
        ("10^0", "", "10^0", "10**0"),
        ("T", "T = 1000 * 10^-3\n\n\n", "1000 * 10^-3", "1.0"),
    ],
)
def test_a_caret_is_no_power(code: str, constant: str, old: str, written: str) -> None:
    text = with_period(code, constant=constant)
    found = behind_symptom("run.wrong_period", Suspect(source_in(text), ASSIGNMENT))
    assert found is not None
    assert found.where is not None
    assert old in text.splitlines()[(found.where.line or 0) - 1]
    fix = CATALOGUE[found.kind].fix_text({**found.params, **found.words}, found.variant)
    assert str(fix) == f"Write {written} instead of {old} in this line."


def test_a_period_that_is_right_is_not_to_be_written() -> None:
    for code, constant in (("1.0", ""), ("T", "T = 1\n\n\n"), ("2 / 2", "")):
        told = told_of_period(source_in(with_period(code, constant=constant)), 1.0)
        assert told.variant == "there"
