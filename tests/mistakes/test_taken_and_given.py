"""What is told of next(), sum() and a call of the logger itself."""

from __future__ import annotations

from tests.mistakes.test_from_source import line_of, look, raised
from tests.mistakes.test_named_exactly import LOG, STEP, changed, fix_of

START = "        self.counter_ = 0\n"
TEXT = "'Hello time: ' + str(self.counter_)"


def test_sum_adds_no_texts() -> None:
    text = changed((TEXT, "sum(['Hello time: ', str(self.counter_)])"))
    error = "TypeError: unsupported operand type(s) for +: 'int' and 'str'"
    found = raised(error, text, line_of(text, "sum("))
    assert found is None or found.kind != "node.str_plus_int"


def test_a_second_value_of_next_is_no_error() -> None:
    text = changed(
        (START, "        self.n = iter([0, 1, 2])\n"),
        (TEXT, "f'Hello time: {next(self.n, None)}'"),
        (STEP, ""),
    )
    assert look("run.ended_early", text) is None


def test_the_logger_is_no_function() -> None:
    text = changed((LOG, f"self.get_logger()({TEXT})"))
    found = raised(
        "TypeError: 'RcutilsLogger' object is not callable", text, line_of(text, "get_logger")
    )
    assert (
        fix_of(found)
        == f"Write self.get_logger().info({TEXT}) instead of self.get_logger()({TEXT})."
    )
