"""One token of a right file is gone, doubled or misspelt: the change has to be the reverse of that."""

from __future__ import annotations

import ast
import io
import tokenize
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

from grader.package.source.slips import slip_of
from tests.corpus.build import SOLUTION

NODE = SOLUTION / "my_robot_controller" / "my_first_node.py"
SETUP = SOLUTION / "setup.py"
WORDS = ("def", "class", "import", "from", "if", "try", "except", "return")
MOST_OTHER = 0.05


def mutants(text: str) -> Iterator[str]:
    """Yield the file with each of its tokens gone or doubled, words misspelt, lines moved."""
    rows = text.splitlines(keepends=True)
    starts = [0]
    for row in rows:
        starts.append(starts[-1] + len(row))
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        start, end = (starts[line - 1] + column for line, column in (token.start, token.end))
        before, word, behind = text[:start], token.string, text[end:]
        if token.type == tokenize.OP:
            yield before + behind
            yield before + word * 2 + behind
        elif token.type == tokenize.STRING:
            yield before + word[:-1] + behind
        elif word in WORDS:
            yield before + word.capitalize() + behind
            yield before + word[1] + word[0] + word[2:] + behind
    for number, row in enumerate(rows):
        for moved in (f"    {row}", row[4:], f"\t{row.lstrip()}"):
            if row.startswith("    ") and row.strip():
                yield "".join([*rows[:number], moved, *rows[number + 1 :]])


def tree(text: str) -> str:
    """Return what Python reads; "" if it cannot."""
    try:
        return ast.dump(ast.parse(text))
    except SyntaxError:
        return ""


@pytest.mark.parametrize(("path", "least"), [(NODE, 0.85), (SETUP, 0.65)])
def test_most_changes_are_the_reverse_of_the_mistake(path: Path, least: float) -> None:
    right = path.read_text(encoding="utf-8")
    seen: Counter[str] = Counter()
    for broken in dict.fromkeys(mutants(right)):
        if not tree(broken):
            slip = slip_of(broken.encode())
            fixed = (slip.fixed or b"").decode() if slip is not None else ""
            seen["none" if not fixed else "right" if tree(fixed) == tree(right) else "other"] += 1
    count = sum(seen.values())
    assert count > 100
    assert seen["right"] / count >= least, seen
    assert seen["other"] / count <= MOST_OTHER, seen
