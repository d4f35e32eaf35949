"""What stands between two pieces of code, or is missing there: how it is named and fixed."""

from __future__ import annotations

import pytest

from grader.package.source.python import can_parse
from grader.package.source.slips import slip_of

# what is written, the variant, its line, and the file after the fix ("" if there is none)
SLIPS = [
    ("a = f('b' + ...\n      c)\n", "dots_inside", 1, "a = f('b' +\n      c)\n"),
    ("a = f( ...\n    'b' + c)\n", "dots_inside", 1, "a = f(\n    'b' + c)\n"),
    ("a = 'b' + ...\n    c\n", "dots_outside", 1, "a = 'b' + \\\n    c\n"),
    ("a = b _\n    + c\n", "dots_outside", 1, "a = b \\\n    + c\n"),
    ("a = 'b' +\n    c\n", "goes_on", 1, "a = 'b' + \\\n    c\n"),
    ("a = 'b' +\nc()\n", "goes_on", 1, "a = 'b' + \\\nc()\n"),
    ("a = 'b'\n    + c\n", "goes_on", 1, "a = 'b' \\\n    + c\n"),
    ("a.b()\n    .c()\n", "goes_on", 1, "a.b() \\\n    .c()\n"),
    ("a = 'b'  # c\n    + d\n", "goes_on_joined", 1, "a = 'b' + d  # c\n"),
    ("a = 'b' str(c)\n", "plus_missing", 1, "a = 'b' + str(c)\n"),
    ("a = 'b' c.d\n", "plus_missing", 1, "a = 'b' + str(c.d)\n"),
    ("return_ = a.b 'c'\n", "plus_missing", 1, "return_ = str(a.b) + 'c'\n"),
    ("print('b' c)\n", "plus_missing", 1, "print('b' + str(c))\n"),
    ("print('b' c())\n", "plus_missing", 1, "print('b' + c())\n"),
    ("a = [('share/' b, c)]\n", "plus_missing", 1, "a = [('share/' + b, c)]\n"),
    ("self.get_logger() info('a')\n", "dot_missing", 1, "self.get_logger().info('a')\n"),
    ("self counter = 1\n", "dot_missing", 1, "self.counter = 1\n"),
    ("super() __init__('a')\n", "dot_missing", 1, "super().__init__('a')\n"),
    ("rclpy init()\n", "dot_missing", 1, "rclpy.init()\n"),
    ("a(1.0 s, b)\n", "number_unit", 1, "a(1.0, b)\n"),
    ("a(500 ms, b)\n", "number_other_unit", 1, ""),
    ("a('b: ' {c.d})\n", "braces_outside", 1, "a(f'b: {c.d}')\n"),
    ("a('b: ' + (str)c.d)\n", "cast", 1, "a('b: ' + str(c.d))\n"),
    ("a = (double)c\n", "cast", 1, "a = float(c)\n"),
    ("a(1.0; b)\n", "comma_instead", 1, "a(1.0, b)\n"),
    ("a(1.0: b)\n", "comma_instead", 1, "a(1.0, b)\n"),
    ("a.info(Hello you: + str(b))\n", "text_unquoted", 1, "a.info('Hello you: ' + str(b))\n"),
    ("def a self:\n    pass\n", "def_brackets", 1, "def a(self):\n    pass\n"),
    ("self.get_logger().info 'a'\n", "call_brackets", 1, "self.get_logger().info('a')\n"),
]  # fmt: skip


@pytest.mark.parametrize(("written", "variant", "line", "fixed"), SLIPS)
def test_a_slip_between_two_pieces_is_named_and_fixed(
    written: str, variant: str, line: int, fixed: str | None
) -> None:
    slip = slip_of(written.encode())
    assert slip is not None
    assert (slip.variant, slip.line) == (variant, line)
    if fixed is not None:
        assert (slip.fixed or b"").decode() == fixed
        assert not fixed or can_parse(fixed.encode())


@pytest.mark.parametrize(
    "written",
    [
        "a('b' c d e)\n",  # more than one change is possible
        "a.info(b c)\n",
        "class A(B) :-\n",
    ],
)
def test_a_change_that_is_only_a_guess_is_not_made(written: str) -> None:
    slip = slip_of(written.encode())
    assert slip is None or slip.variant in ("text_unquoted", "comma_missing")


def test_three_dots_that_are_a_value_stay() -> None:
    slip = slip_of(b"def a(): ...\ndef b()\n    ...\n")
    assert slip is not None and slip.variant == "colon_missing"
