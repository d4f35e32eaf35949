"""A fix that is followed word by word leads to a right node, and its patch does the same."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.recognised import RecognisedMistake
from grader.report.model import Where
from tests.mistakes.test_from_source import FILE, line_of, raised
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


def test_init_behind_with_as_in_newer_documentation_becomes_a_line_of_its_own(
    tmp_path: Path,
) -> None:
    end = changed().index("    rclpy.init"), changed().index("\n\nif __name__")
    main = changed()[slice(*end)]
    block = "        node = MyFirstNode()\n        # until Ctrl+C\n\n        rclpy.spin(node)\n"
    text = changed((main, f"    with rclpy.init(args=args):  # as it is written there\n{block}"))
    error = "TypeError: 'NoneType' object does not support the context manager protocol"
    found = raised(error, text, line_of(text, "with rclpy.init"))
    assert found is not None
    assert (found.kind, found.variant) == ("node.not_for_with", "init")
    rows = [
        "rclpy.init(args=args)",
        "node = MyFirstNode()",
        "# until Ctrl+C",
        "",
        "rclpy.spin(node)",
    ]
    right = "".join(f"    {row}\n" if row else "\n" for row in rows)
    assert patched(found, text, tmp_path) == changed((main, right))


def test_a_node_behind_with_becomes_a_name_of_its_own(tmp_path: Path) -> None:
    old = "    node = MyFirstNode()\n"
    spin = changed()[changed().index(old) : changed().index("\n\nif __name__")]
    text = changed((spin, "    with MyFirstNode() as node:\n        rclpy.spin(node)\n"))
    error = "TypeError: 'MyFirstNode' object does not support the context manager protocol"
    found = raised(error, text, line_of(text, "with MyFirstNode"))
    right = changed((spin, f"{old}    rclpy.spin(node)\n"))
    assert patched(found, text, tmp_path) == right


def test_a_variable_of_init_that_others_read_gets_self(tmp_path: Path) -> None:
    text = changed(("self.counter_ = 0", "counter_ = 0"))
    error = "AttributeError: 'MyFirstNode' object has no attribute 'counter_'"
    found = raised(error, text, line_of(text, "str(self.counter_)"))
    assert found is not None
    assert found.where is not None
    assert (found.kind, found.variant) == ("node.attribute_not_set", "local")
    assert found.where.line == line_of(text, "        counter_ = 0")
    assert patched(found, text, tmp_path) == changed()


@pytest.mark.parametrize(
    ("wrong", "right"),
    [
        ("'Hello Time: {}'.format(self.counter_)", "'Hello time: {}'.format(self.counter_)"),
        ("'Hello time:%d' % self.counter_", "'Hello time: %d' % self.counter_"),
        ("'hello time: ' + str(self.counter_)", "'Hello time: ' + str(self.counter_)"),
    ],
)
def test_a_text_is_corrected_up_to_the_place_of_the_number(
    wrong: str, right: str, tmp_path: Path
) -> None:
    text = changed((TEXT, wrong))
    where = Where.model_validate({"file": FILE, "line": line_of(text, "get_logger")})
    found = RecognisedMistake(kind="run.wrong_text", where=where)
    assert patched(found, text, tmp_path) == changed((TEXT, right))
