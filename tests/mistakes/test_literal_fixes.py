"""A fix that is followed word by word leads to a right node, and its patch does the same."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.mistakes.test_from_source import line_of, look, raised
from tests.mistakes.test_named_exactly import LOG, STEP, changed, fix_of, patched, why_of

TEXT = "'Hello time: ' + str(self.counter_)"
TIMER = "        self.create_timer(1.0, self.timer_callback)\n"
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


def test_a_difference_of_times_is_not_told_of_1970() -> None:
    text = changed(
        ("self.counter_ = 0", "self.start = self.get_clock().now()"),
        (LOG + "\n", "past = self.get_clock().now() - self.start\n"
         "        self.get_logger().info(f'Hello time: {past.nanoseconds // 10**9}')\n"),
        (STEP, ""),
    )  # fmt: skip
    found = look("run.wrong_start", text)
    assert found is not None
    assert found.kind == "node.time_for_count"
    assert "1970" not in why_of(found)
    assert "how much time has passed" in why_of(found)


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


@pytest.mark.parametrize(
    ("logged", "written"),
    [
        ("'Hello time: %d', self.counter_", "'Hello time: %d' % self.counter_"),
        (TEXT, TEXT),
    ],
)
def test_the_call_of_the_nodes_logger_is_written_out(logged: str, written: str) -> None:
    text = changed(
        ("import rclpy\nfrom", "import logging\nimport rclpy\nfrom"),
        (LOG, f"logging.info({logged})"),
    )
    assert f"Write self.get_logger().info({written}) on" in fix_of(look("run.no_lines", text))


def test_all_uses_of_a_name_of_python_are_named() -> None:
    text = changed(
        (LOG, f"str = 'Hello time: '\n        {LOG.replace(TEXT, 'str + ' + TEXT[17:])}")
    )
    line = line_of(text, "info(")
    found = raised("TypeError: 'str' object is not callable", text, line)
    assert f"here and on line {line}." in fix_of(found)


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
