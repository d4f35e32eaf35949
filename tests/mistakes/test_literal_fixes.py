"""A fix that is followed word by word leads to a right node, and its patch does the same."""

from __future__ import annotations

from pathlib import Path

from tests.mistakes.test_from_source import line_of, raised
from tests.mistakes.test_named_exactly import changed, patched

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
