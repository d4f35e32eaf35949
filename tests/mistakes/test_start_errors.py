"""Exceptions at the start and in callbacks: the line that is to be changed, and what is left alone."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import line_of, raised
from tests.mistakes.test_named_exactly import changed

TEXT = "'Hello time: ' + str(self.counter_)"
STEP = "        self.counter_ += 1\n"
TIMER = "self.create_timer(1.0, self.timer_callback)"
START = "self.counter_ = 0"
UNKNOWN = "NameError: name '{}' is not defined"
ON_METHOD = "AttributeError: 'method' object has no attribute 'count'"
SUPER = "super().__init__('my_first_node')"


def kind_of(error: str, text: str, at: str) -> str:
    found = raised(error, text, line_of(text, at))
    return f"{found.kind} {found.variant}".strip() if found is not None else ""


def test_a_method_that_is_only_read_from_is_not_called() -> None:
    text = changed((STEP, f"{STEP}        self.last_ = self.timer_callback.count\n"))
    assert kind_of(ON_METHOD, text, "self.last_") == "node.not_called"


@pytest.mark.parametrize("last", ["return", "return None", f"return {SUPER}"])
def test_an_init_that_returns_nothing_is_left_alone(last: str) -> None:
    text = changed((TIMER, f"{TIMER}\n        {last}"))
    error = "TypeError: __init__() should return None, not 'Other'"
    assert raised(error, text, line_of(text, "node = MyFirstNode()")) is None


@pytest.mark.parametrize(
    ("old", "new", "name", "kind"),
    [
        (START, f"{START}  // startwert", "startwert", "node.slash_comment"),
        # a calculation with a name that is wrong
        (START, "self.counter_ = 100 % limit", "limit", "node.name_unknown"),
        (START, "self.counter_ = self.counter % limit", "limit", "node.name_unknown"),
        (TEXT, "'Hello time: %d' % counter", "counter", "node.name_unknown"),
        (f"info({TEXT})", "info('Hello time: %d') % zahl", "zahl", "node.name_unknown"),
        (START, "limits = 5\n        self.counter_ = 0 % limit", "limit", "node.name_unknown instead"),
        (START, "limits = 5\n        self.counter_ = 9 // limit", "limit", "node.name_unknown instead"),
    ],
)  # fmt: skip
def test_a_comment_of_another_language(old: str, new: str, name: str, kind: str) -> None:
    text = changed((old, new))
    assert kind_of(UNKNOWN.format(name), text, new.strip().splitlines()[-1]) == kind


def test_the_key_of_a_dict_is_no_place_of_a_text() -> None:
    text = changed((TEXT, "self.texts_['n'].format(1)"))
    assert kind_of("KeyError: 'n'", text, "texts_") == "node.no_such_item key"


LAMBDA = "TypeError: MyFirstNode.__init__.<locals>.<lambda>() missing 1 required positional argument: '{}'"


def test_a_lambda_that_the_timer_can_call_is_left_alone() -> None:
    text = changed(
        ("self.timer_callback)", "lambda *args: self.timer_callback())"),
        (STEP, f"{STEP}        self.f = lambda e: e\n        self.f()\n"),
    )
    error = LAMBDA.format("e").replace("__init__", "timer_callback")
    assert raised(error, text, line_of(text, "self.f()")) is None


@pytest.mark.parametrize(
    "code", ["RCLCPP_INFO(self.get_logger(), 'Hello')", "printf('Hello time: %d', self.counter_)"]
)
def test_what_another_language_prints_is_told(code: str) -> None:
    text = changed((f"self.get_logger().info({TEXT})", code))
    name = code.partition("(")[0]
    found = raised(UNKNOWN.format(name), text, line_of(text, code))
    assert found is not None
    assert (found.kind, found.variant) == ("node.other_language", "print")
