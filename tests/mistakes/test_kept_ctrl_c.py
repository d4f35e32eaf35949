"""An except inside of a loop that keeps Ctrl+C, told where the node does not end."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import look
from tests.mistakes.test_named_exactly import changed, fix_of, why_of

SPIN = "        rclpy.spin(node)\n"
LOOP = """\
        while True:
            try:
                rclpy.spin_once(node)
            {head}
                {body}
"""


def spinning(head: str, body: str = "pass") -> str:
    return changed((SPIN, LOOP.format(head=head, body=body)))


@pytest.mark.parametrize("head", ["except:", "except BaseException:", "except KeyboardInterrupt:"])
def test_an_except_that_keeps_it_is_told_with_what_leaves_the_loop(head: str) -> None:
    found = look("run.ignores_interrupt", spinning(head))
    assert found is not None
    assert (found.kind, found.variant) == ("node.error_hidden", "ctrl_c")
    assert "begins again" in why_of(found)
    assert "break" in fix_of(found)


@pytest.mark.parametrize(
    ("head", "body"),
    [("except:", "break"), ("except:", "raise"), ("except ValueError:", "pass")],
)
def test_one_that_lets_it_out_is_not_told(head: str, body: str) -> None:
    found = look("run.ignores_interrupt", spinning(head, body))
    assert found is None or found.variant != "ctrl_c"
