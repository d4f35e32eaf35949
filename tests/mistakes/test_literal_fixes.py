"""A fix that is followed word by word leads to a right node, and its patch does the same."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.mistakes.test_from_source import line_of, look, raised
from tests.mistakes.test_named_exactly import changed, fix_of, patched, why_of

TEXT = "'Hello time: ' + str(self.counter_)"
SPIN = """\
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
"""
LOOP = """\
    while True:
        try:
            rclpy.spin(node)
        except{}:
            print('Ctrl+C')
"""


def test_the_time_itself_is_still_told_of_1970() -> None:
    text = changed((TEXT, "f'Hello time: {self.get_clock().now().nanoseconds // 10**9}'"))
    assert "1970" in why_of(look("run.wrong_start", text))


@pytest.mark.parametrize("caught", ["", " KeyboardInterrupt", " (KeyboardInterrupt, ValueError)"])
def test_break_ends_the_loop_that_catches_ctrl_c(caught: str, tmp_path: Path) -> None:
    text = changed((SPIN, LOOP.format(caught)))
    found = look("run.ignores_interrupt", text)
    assert "break as the last line in" in fix_of(found)
    assert f"line {line_of(text, 'while True')}." in fix_of(found)
    right = LOOP.format(caught or " KeyboardInterrupt") + "            break\n"
    assert patched(found, text, tmp_path) == changed((SPIN, right))


def test_a_callback_in_init_is_moved_with_its_comment(tmp_path: Path) -> None:
    start = changed().index("    def timer_callback")
    method = changed()[start : changed().index("\n\ndef main")]
    inner = "".join(f"    {row}\n" if row else "\n" for row in method.splitlines())
    text = changed((method, "        # each second\n" + inner))
    error = "AttributeError: 'MyFirstNode' object has no attribute 'timer_callback'"
    found = raised(error, text, line_of(text, "create_timer"))
    right = changed((method, "    # each second\n" + method))
    assert patched(found, text, tmp_path).split() == right.split()
    assert "\n    def timer_callback(self):\n        " in patched(found, text, tmp_path)


def test_a_number_behind_a_comma_is_joined(tmp_path: Path) -> None:
    text = changed((TEXT, "'Hello time:', self.counter_"))
    error = "TypeError: RcutilsLogger.info() takes 2 positional arguments but 3 were given"
    found = raised(error, text, line_of(text, "info("))
    assert patched(found, text, tmp_path) == changed()


def test_a_class_that_is_spun_is_called_first(tmp_path: Path) -> None:
    tail = "    node = MyFirstNode()\n" + SPIN
    text = changed((tail, "    rclpy.spin(MyFirstNode)\n"))
    found = raised("TypeError: 'property' object is not iterable", text, line_of(text, "spin(My"))
    right = changed((tail, "    node = MyFirstNode()\n    rclpy.spin(node)\n"))
    assert patched(found, text, tmp_path) == right
