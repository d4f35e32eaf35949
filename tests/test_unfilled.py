"""A text without the values of its places is an error where it is composed."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from grader.base.i18n.message import Message, UnfilledError, joined, msg, say
from grader.base.i18n.translator import Translator
from grader.verdict.checks.all import CHECKS

TITLE = CHECKS["topic.publishes"].title


@pytest.mark.parametrize(
    "compose",
    [
        lambda: say("skipped because of: {title}", title=TITLE),
        lambda: joined("a", msg("{count} lines")),
        lambda: Translator("en")(TITLE),
        lambda: Translator("ko")(msg("{topic}, of the type {type}")),
    ],
    ids=["value", "part", "English", "Korean"],
)
def test_a_template_in_a_text_is_an_error(compose: Callable[[], str]) -> None:
    with pytest.raises(UnfilledError, match="without its values"):
        compose()


def test_a_template_is_filled_by_its_values() -> None:
    filled = Message(TITLE, {"topic": "/out", "type": "std_msgs/msg/Int32"})
    assert Translator("en")(filled) == "The node publishes /out, of the type std_msgs/msg/Int32"


def test_a_text_of_a_program_may_have_braces() -> None:
    text = say("line {line}: {code}", line=3, code="f'Hello {count}'")
    assert Translator("en")(text) == "line 3: f'Hello {count}'"
