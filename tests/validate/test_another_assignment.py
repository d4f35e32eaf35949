"""Validating an instructor's own assignment with another package and text."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests import processes
from tests.test_another_course import write_assignment, write_solution

MUTANTS = """\
schema: 1
mutants:
  - name: other_text
    check: run.output
    mistake: run.wrong_text
    edits:
      - replace: turtle_counter/ticker.py
        old: said the turtle
        new: said the hare
  - name: no_marker
    check: package.marker
    mistake: package.marker_missing
    edits:
      - {delete: resource/turtle_counter}
"""
SHEBANG = "  - {id: source.shebang, points: 5}\n"


@pytest.fixture
def course(tmp_path: Path) -> Path:
    return write_assignment(tmp_path)


@pytest.fixture
def keys(tmp_path: Path) -> Path:
    folder = tmp_path / "keys"
    (folder / "solution").mkdir(parents=True)
    write_solution(tmp_path).rename(folder / "solution" / "turtle_counter")
    (folder / "mutants.yaml").write_text(MUTANTS)
    return folder


def validate(*words: str | Path) -> tuple[int, str, str]:
    done = processes.run(processes.grader("validate", *words))
    assert "Traceback" not in done.stderr
    return done.returncode, done.stdout, done.stderr


def matrix_of(course: Path, keys: Path, *words: str) -> dict[str, Any]:
    """Validate, assert that everything is as expected, and return the matrix."""
    file = keys / "matrix.json"
    status, shown, errors = validate(course, "--keys", keys, "--json", file, *words)
    assert status == 0, shown[-2000:] + errors
    matrix: dict[str, Any] = json.loads(file.read_text())
    assert matrix["as_expected"]
    return matrix


def test_static_checks_decide_as_many_mutants_of_another_package(course: Path, keys: Path) -> None:
    matrix = matrix_of(course, keys, "--static")
    assert matrix["assignment"] == "ticking"
    assert matrix["figures"]["failed_where_they_must"] >= 100
    names = {row["mutant"] for row in matrix["rows"]}
    assert {"no_marker", "delete turtle_counter/ticker.py", "entry letter added to name"} <= names


@pytest.mark.full
def test_its_node_is_run(course: Path, keys: Path) -> None:
    matrix = matrix_of(course, keys, "--only", "other_text")
    (row,) = matrix["rows"]
    assert row["ran"]
    assert row["mistakes"] == {"run.output": "run.wrong_text"}


@pytest.mark.long
def test_an_f_string_has_mutants_of_its_own(course: Path, keys: Path) -> None:
    matrix = matrix_of(course, keys, "--only", "f lost*")
    (row,) = matrix["rows"]
    assert row["mistakes"]["run.output"] == "node.f_prefix"


def test_changes_that_no_check_covers_are_not_mutants(course: Path, keys: Path) -> None:
    course.write_text(course.read_text().replace(SHEBANG, ""))
    status, _, errors = validate(course, "--keys", keys, "--static", "--only", "first line lost")
    assert status == 2
    assert "no mutant's name matches 'first line lost'" in errors


def test_a_mutant_of_an_unused_check_is_reported_with_its_line(course: Path, keys: Path) -> None:
    course.write_text(course.read_text().replace(SHEBANG, ""))
    (keys / "mutants.yaml").write_text(MUTANTS.replace("package.marker\n", "source.shebang\n"))
    status, _, errors = validate(course, "--keys", keys, "--static")
    assert status == 2
    assert f"{keys}/mutants.yaml:11:5: the assignment has no check 'source.shebang'" in errors


@pytest.mark.parametrize(
    ("file", "text", "says"),
    [
        ("setup.cfg", None, "has no file setup.cfg"),
        (
            "turtle_counter/ticker.py",
            b"def main(:\n",
            "turtle_counter/ticker.py is not valid Python",
        ),
        ("turtle_counter/ticker.py", b"# \xff\n", "turtle_counter/ticker.py is not UTF-8"),
        ("package.xml", b"\xff", "package.xml is not UTF-8"),
        ("setup.py", b"print()\n", "setup.py does not call setup()"),
    ],
)
def test_a_solution_without_possible_mutants_is_reported(
    file: str, text: bytes | None, says: str, course: Path, keys: Path
) -> None:
    path = keys / "solution/turtle_counter" / file
    path.unlink()
    if text is not None:
        path.write_bytes(text)
    status, _, errors = validate(course, "--keys", keys, "--static")
    assert status == 2
    assert says in errors


def test_a_missing_solution_is_reported_with_its_expected_path(
    course: Path, tmp_path: Path
) -> None:
    status, _, errors = validate(course, "--keys", tmp_path)
    assert status == 2
    assert f"{tmp_path}/solution/turtle_counter" in errors
