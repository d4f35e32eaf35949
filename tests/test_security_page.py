"""Each promise of docs/SECURITY.md names tests that hold it, and they are there."""

from __future__ import annotations

import ast
import re
from functools import cache

from tests.corpus.hostile import HOSTILE
from tests.processes import ROOT

PAGE = (ROOT / "docs" / "SECURITY.md").read_text(encoding="utf-8")
TEST = re.compile(r"`([\w/]+\.py)::(test_\w+)`")
PACKAGE = re.compile(r"`([a-z_]+)`")


@cache
def functions(file: str) -> frozenset[str]:
    tree = ast.parse((ROOT / "tests" / file).read_text(encoding="utf-8"))
    return frozenset(node.name for node in tree.body if isinstance(node, ast.FunctionDef))


def promises() -> list[tuple[str, str]]:
    """Return the promise and the tests of each row of the page's tables."""
    rows = [line.strip("| ").split(" | ") for line in PAGE.splitlines() if line.startswith("| ")]
    return [(row[0], row[2]) for row in rows if row[0] != "promise"]


def test_every_promise_names_a_test_or_a_hostile_package() -> None:
    packages = {package.name for package in HOSTILE}
    found = promises()
    assert len(found) > 20
    for promise, tests in found:
        named = set(PACKAGE.findall(TEST.sub("", tests)))
        assert TEST.search(tests) or named, promise
        assert named <= packages, promise


def test_every_test_that_the_page_names_is_there() -> None:
    for file, name in TEST.findall(PAGE):
        assert name in functions(file), f"{file}::{name}"
