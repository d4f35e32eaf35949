"""The advice on a function that the file calls when it is imported."""

from __future__ import annotations

import ast

import pytest

from grader.mistakes.hints import hints

MAIN = "def main():\n    pass\n\n\n"


def test_the_call_is_named() -> None:
    (text,) = hints(ast.parse(f"{MAIN}main()\n"))
    assert text.startswith("line 5: The file calls the function of the entry point")
    assert "main is called twice" in text
    assert "__name__ == '__main__'" in text


@pytest.mark.parametrize(
    "end",
    ["if __name__ == '__main__':\n    main()\n", "", "print('ready')\n", "other()\n"],
)
def test_a_call_below_the_guard_is_right(end: str) -> None:
    assert hints(ast.parse(MAIN + end)) == []
    assert hints(ast.parse("from other import main\nmain()\n")) == []
