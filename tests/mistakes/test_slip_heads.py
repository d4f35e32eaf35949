"""The damaged head of a def, a class or an except, and brackets that are closed too early."""

from __future__ import annotations

import pytest

from grader.package.source.slips import slip_of

METHOD = "class A:\n    x = 1\n\n    def f(self):\n        return 1\n\n"
AFTER = "\n    def g(self):\n        pass\n"
# what is written, the variant, its line, the line as it should be, and whether the fix is certain
LINES = [
    # a def that is too deep, whose lines are in its column
    (f"{METHOD}        def g(self):\n        # note\n        self.x = 2\n", "head_deeper", 7, "4", True),
    ("class A:\n    def f(self):\n    # note\n    a = self.x\n    self.g(a)\n", "lines_not_indented", 4,
     "5", True),
    ("def f():\n    # note\ng()\n", "block_comment", 1, "", True),
    ("def f():\n# note\ndef g():\n    f()\n", "block_comment", 1, "", True),
    # a class without a block, beside other lines of the class around it
    ("class A:\n    x = 1\n\n    class B:\n\n    def f(self):\n        pass\n", "block_empty", 4, "", False),
    # half of a line
    ("class A:\n    def f(self,\n        return 1\n", "def_half_open", 2, "def f(self, …):", False),
    ("class A:\n    def f(self\n        self.x = 1\n", "def_half", 2, "def f(self):", True),
    ("a = f(b, c.\nreturn_ = 1\n\n\ndef f(b, c):\n    pass\n", None, 0, "", False),
    ("class A:\n    def f(self):\n        g(1, self.\n\n    def h(self):\n        pass\n", "value_half", 3,
     "g(1, self.…)", False),
    # def for class, and class for def
    ("@dataclass\ndef A:\n    x: int = 0\n", "def_for_class", 2, "class A:", True),
    ("def main:\n    pass\n", "def_brackets", 1, "def main():", True),
    (f"class A:\n    class f(self, n):\n        return n\n{AFTER}", "class_for_def", 2, "def f(self, n):",
     True),
    ("class A:\n    return 1\n", "outside_function", 2, "return", False),
    ("class A:\n    def self.f():\n        pass\n", "def_self", 2, "def f(self):", True),
    ("class A:\n    def self.f(self, n):\n        pass\n", "def_self", 2, "def f(self, n):", True),
    # signs
    ("class A:\n    def f[self, n]:\n        pass\n", "def_square", 2, "def f(self, n):", True),
    ("self.get_logger[].info(a)\n", "round_brackets", 1, "self.get_logger().info(a)", True),
    ("a = self.items[]\n", None, 0, "", False),
    ("f(1, lambda self.g(2))\n", "lambda_colon", 1, "f(1, lambda: self.g(2))", True),
    ("x = int: 0\n", "type_and_value", 1, "x: int = 0", True),
    ("a = {\n    'b: 'Some text: ',\n    'c': 1,\n}\n", "quote_exact", 2, "'b': 'Some text: ',", True),
    ('def f():\n    ""Some text.""\n    pass\n', "docstring_quotes", 2, '"""Some text."""', True),
    ("a = (\n    'b': 1,\n    'c': 2,\n}\n", "bracket_opener", 1, "a = {", True),
    ("f(\n    a=1.0),\n    b=2,\n)\n", "closed_early", 2, "a=1.0,", True),
    ("class A:\n    x = 0    def f(self):\n        pass\n", "two_statements", 2, "def f(self):", True),
    ("a <- function(b) c('d', b)\n", None, 0, "", False),
    # several classes behind except
    ("try:\n    a()\nexcept (B | c.D e):\n    pass\n", "handler_several", 3, "except (B, c.D) as e:", True),
    ("try:\n    a()\nexcept (B, C) e:\n    pass\n", "handler_several", 3, "except (B, C) as e:", True),
    ("try:\n    a()\ncatch (B | C e):\n    pass\n", "catch", 3, "except (B, C) as e:", True),
    # a comment without its sign, between two comments
    ('# one\n   says "two" and three\n# four\na = 1\n', "note_without_sign", 2, '# says "two" and three',
     True),
    ("# one\n  a = f(1\n# two\n", None, 0, "", False),
]  # fmt: skip


@pytest.mark.parametrize(("text", "variant", "line", "wanted", "certain"), LINES)
def test_a_damaged_head_is_named(
    text: str, variant: str | None, line: int, wanted: str, certain: bool
) -> None:
    slip = slip_of(text.encode())
    if variant is None:
        assert slip is None or slip.variant not in {known for _, known, *_ in LINES}
        return
    assert slip is not None
    assert (slip.variant, slip.line, slip.wanted) == (variant, line, wanted)
    assert (slip.fixed is not None) == certain
