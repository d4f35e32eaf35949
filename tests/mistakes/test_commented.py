"""Statements in comments: which of them are found, and the file in which they are code."""

from __future__ import annotations

import pytest

from grader.package.edit.text import SourceText
from grader.package.source.commented import commented, uncommented

STEP = r"self\.a[ \t]*\+="


@pytest.mark.parametrize(
    ("text", "line", "fixed"),
    [
        ("f(1)  # self.a += 1\n", 1, "f(1)\nself.a += 1\n"),
        ("def f():\n    # self.a += 1\n    g()\n", 2, "def f():\n    self.a += 1\n    g()\n"),
        ("def f():\n    g()\n#    self.a += 1\n", 3, "def f():\n    g()\n    self.a += 1\n"),
        ("f('# no')  # log   self.a += 1  # count\n", 1, "f('# no')\nself.a += 1\n"),
        ("f(1)  # self.a += 1\r\ng()\r\n", 1, "f(1)\r\nself.a += 1\r\ng()\r\n"),
    ],
)
def test_a_statement_in_a_comment_becomes_code(text: str, line: int, fixed: str) -> None:
    source = SourceText(text, "utf-8")
    (found,) = commented(source, STEP)
    assert found.line == line
    assert uncommented(source, found) == fixed.encode()


@pytest.mark.parametrize(
    "text",
    [
        "self.a += 1\n",
        "f('# self.a += 1')\n",
        "f()  # self.a += 1 comes below\n",
        "f()  # adds one: self.b += 1\n",
        "f()  # other.self.a += 1\n",
        '"""\n# self.a += 1\n"""\n',
    ],
)
def test_other_comments_are_none(text: str) -> None:
    assert list(commented(SourceText(text, "utf-8"), STEP)) == []
