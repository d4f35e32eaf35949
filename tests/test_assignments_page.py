"""docs/assignments.md is true: its examples are loaded, and no key of the schema is missing in it."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
import yaml
from pydantic import TypeAdapter

from grader.course.assignment import OWN, Assignment, CheckUse, Lesson, Output
from grader.course.load import load_assignment
from grader.course.policy import Late, Policy
from grader.course.rules import lesson_keys
from grader.course.shorthands import SHORTHANDS
from grader.course.values import KEYS
from grader.mistakes.catalogue import CATALOGUE
from grader.report.detail import FeedbackRules
from grader.ros.distro import find_distro
from grader.sandbox.limits import UNITS, Limits
from grader.validate.named import read_mutants
from grader.verdict.checks.all import CHECKS
from tests.processes import ROOT

PAGE = (ROOT / "docs" / "assignments.md").read_text(encoding="utf-8")
CLASSES = (ROOT / "docs" / "classes.md").read_text(encoding="utf-8")
FORMS = (ROOT / "docs" / "checks.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```yaml\n(.*?)```", PAGE, re.DOTALL)
WHOLE = [block for block in BLOCKS if block.startswith("schema: 2")]
MUTANTS = [block for block in BLOCKS if block.startswith("schema: 1\nmutants:")]
PARTS = [block for block in BLOCKS if block not in WHOLE + MUTANTS]
PLACES = lesson_keys({"nodes": {"any": {}}})


def first_line(block: str) -> str:
    return next(line for line in block.splitlines() if not line.startswith("schema"))


def words(text: str) -> set[str]:
    """Return the words in the code of a text."""
    spans = re.findall(r"```.*?```|`[^`\n]+`", text, re.DOTALL)
    return {word for span in spans for word in re.findall(r"\w+", span)}


def rows(heading: str, page: str = PAGE) -> dict[str, str]:
    """Return the rows of the table with this heading: the keys in the first column of each."""
    table = page.split(f"\n| {heading} |")[1].split("\n\n", maxsplit=1)[0].splitlines()[2:]
    found = {}
    for line in table:
        first = line.split("|")[1]
        found.update(dict.fromkeys(re.findall(r"`(\w+)`", first), line))
    return found


@pytest.mark.parametrize("block", WHOLE, ids=first_line)
def test_a_whole_example_is_an_assignment(block: str, tmp_path: Path) -> None:
    file = tmp_path / "assignment.yaml"
    file.write_text(block, encoding="utf-8")
    assert load_assignment(file, known_checks=CHECKS, known_limits=tuple(UNITS)).max_score > 0


@pytest.mark.parametrize("block", PARTS, ids=first_line)
def test_a_part_of_an_example_is_one_of_an_assignment(block: str) -> None:
    models = {**Assignment.model_fields, **Lesson.model_fields}
    for key, value in yaml.safe_load(block).items():
        kind: Any = models[key].annotation
        TypeAdapter(kind).validate_python(value)
        for use in map(CheckUse.model_validate, value if key == "checks" else ()):
            if use.kind in SHORTHANDS or use.kind.startswith(OWN):
                continue
            model = CHECKS[use.kind].parameters
            if model is not None:
                model.model_validate(use.with_)


def test_the_example_of_mutants_is_a_file_of_mutants(tmp_path: Path) -> None:
    (block,) = MUTANTS
    file = tmp_path / "mutants.yaml"
    file.write_text(block, encoding="utf-8")

    found = read_mutants(
        file, checks=[*CHECKS, *SHORTHANDS], kinds=CATALOGUE, distro=find_distro("jazzy")
    )
    assert [one.name for one in found.mutants] == ["other_text"]


@pytest.mark.parametrize(
    ("heading", "place"),
    [
        ("key", ()),
        ("key of a run", ("runs", "*")),
        ("key of `start`", ("runs", "*", "start", "*")),
        ("key of `do`", ("runs", "*", "do", "*")),
    ],
)
def test_a_table_has_exactly_the_keys_of_its_place(heading: str, place: tuple[str, ...]) -> None:
    assert set(rows(heading)) == set(PLACES[place])


@pytest.mark.parametrize("place", [place for place in PLACES if len(place) > 1], ids=str)
def test_each_key_of_an_inner_place_stands_in_the_row_of_the_outer_one(place: Any) -> None:
    if place[0] in ("nodes", "checks"):
        assert set(PLACES[place]) <= words(rows("key")[place[0]])
    elif place == ("policy", "late"):
        assert set(PLACES[place]) <= words(CLASSES)
    elif place[-1] != "*":
        heading = "key of `do`" if "do" in place else "key of a run"
        assert set(PLACES[place]) <= words(rows(heading)[place[-1]])


def test_the_keys_of_the_policy_the_feedback_and_schema_1_are_told() -> None:
    assert {*Policy.model_fields, *Late.model_fields} <= words(CLASSES)
    assert set(FeedbackRules.model_fields) <= words(PAGE.split("## Feedback")[1])
    before = PAGE.split("## A new lesson")[0]
    mine = set(PLACES[()]) | {"schema_", "sha256", "own_checks", "drawn"}
    assert {*Assignment.model_fields, *Output.model_fields} - mine <= words(before)


def test_the_table_of_limits_has_each_with_its_default() -> None:
    found = {name: row.split("|")[2].strip() for name, row in rows("limit").items()}
    assert found == {name: f"{getattr(Limits(), name):,.0f}" for name in UNITS}


def test_each_form_is_told() -> None:
    table = FORMS.split("| form |")[1].split("\n\n")[0]
    assert {*KEYS, "within", "step"} <= words(table)
