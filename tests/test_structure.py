"""The limits of the structure are measured, and their list only shrinks."""

from __future__ import annotations

import subprocess
from pathlib import Path

import grimp

from tests import structure

NINE = "".join(f"    if a == {n} and b:\n        return {n}\n" for n in range(9))


def test_each_limit_finds_what_is_over_it(tmp_path: Path) -> None:
    package = tmp_path / "grader"
    package.mkdir()
    (tmp_path / "lab").mkdir()
    (package / "deep.py").write_text(f"def deep(a: int, b: int) -> int:\n{NINE}    return 0\n")
    (package / "flat.py").write_text("x = 1\n" * 501)
    (package / "late.py").write_text("def late() -> None:\n    import os  # noqa: PLC0415\n")
    subprocess.run(["git", "init", "-q"], cwd=tmp_path, check=True)

    assert dict(structure.complexities(tmp_path)) == {"grader/deep.py:deep": 19}
    assert dict(structure.lengths(tmp_path)) == {"grader/flat.py": 501}
    assert dict(structure.late_imports(tmp_path)) == {"grader/late.py": 1}


def test_a_ring_of_three_is_one_ring_and_a_line_is_none() -> None:
    graph = grimp.ImportGraph()
    for importer, imported in (("a", "b"), ("b", "c"), ("c", "a"), ("c", "d"), ("d", "e")):
        for module in (importer, imported):
            graph.add_module(module)
        graph.add_import(importer=importer, imported=imported)

    assert dict(structure.rings(graph)) == {"a": 3}


def test_what_grows_and_what_shrinks_are_told_apart() -> None:
    known = {"lines": {"grader/a.py": 700, "grader/b.py": 510, "grader/c.py": 520}}
    found = {"lines": {"grader/a.py": 701, "grader/b.py": 505, "grader/d.py": 501}}

    grown, smaller = structure.differences(known, found)

    assert grown == [
        "lines: grader/a.py: 701, in the list 700",
        "lines: grader/d.py: 501, in the list 0",
    ]
    assert smaller == [
        "lines: grader/b.py: 505, in the list 510",
        "lines: grader/c.py: 0, in the list 520",
    ]
