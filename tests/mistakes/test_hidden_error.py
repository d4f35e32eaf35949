"""The error that an except hides is named if the source shows it, and corrected with it."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import look
from tests.mistakes.test_named_exactly import LOG, STEP, changed, fix_of, why_of

BODY = f"        {LOG}\n{STEP}"
TEXT = "'Hello time: ' + str(self.counter_)"


def hidden(log: str, step: str = "self.counter_ += 1", handler: str = "pass") -> str:
    """Return the node whose callback hides errors of these two lines."""
    return changed(
        (
            BODY,
            f"        try:\n            {log}\n            {step}\n"
            f"        except Exception:\n            {handler}\n",
        )
    )


@pytest.mark.parametrize(
    "log",
    [
        LOG.replace(TEXT, "'Hello time: ' + self.text()"),
        LOG.replace(TEXT, "self.texts[self.counter_] + 'Hello time: '"),
    ],
)
def test_an_error_that_is_not_sure_is_not_named(log: str) -> None:
    found = look("run.no_lines", hidden(log))
    assert found is not None
    assert found.kind == "node.error_hidden"
    assert "raises" not in why_of(found)
    assert "Run the node again" in fix_of(found)


def test_a_text_in_the_counter_is_no_error() -> None:
    text = hidden(LOG.replace(TEXT, "'Hello time: ' + self.counter_")).replace(
        "        try:\n            self.get", "        self.counter_ = '0'\n        try:\n            self.get"
    )  # fmt: skip
    found = look("run.no_lines", text)
    assert found is not None
    assert "raises" not in why_of(found)


SPIN = "    try:\n        rclpy.spin(node)\n    except KeyboardInterrupt:\n        pass\n"


def in_main(head: str, more: str = "", log: str = LOG) -> str:
    """Return the node whose main hides errors of its callback."""
    spin = SPIN.replace("except KeyboardInterrupt:", head).replace("pass\n", f"pass\n{more}")
    return changed((SPIN, spin), (LOG, log))


@pytest.mark.parametrize("name", ["timers", "get_parameters([])"])
def test_an_attribute_of_node_is_no_misspelt_one(name: str) -> None:
    log = f"self.{name}\n        {LOG}"
    found = look("run.ended_early", in_main("except:", "", log))
    assert "instead of self." not in fix_of(found)
