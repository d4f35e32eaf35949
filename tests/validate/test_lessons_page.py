"""docs/lessons.md: what each lesson asks, the check of it, and the mutants that fail there."""

from __future__ import annotations

import re
from dataclasses import dataclass

import pytest

from grader.course.find import KEYS
from grader.course.load import load_assignment
from grader.mistakes.catalogue import CATALOGUE
from grader.ros.distro import find_distro
from grader.validate.mutant import Mutant
from grader.validate.named import read_mutants
from grader.verdict.checks.all import CHECKS
from tests.processes import ROOT

COURSE = ROOT / "lab" / "course"
LESSONS = sorted(file.parent.name for file in COURSE.glob("*/lesson.md"))
PAGE = (ROOT / "docs" / "lessons.md").read_text(encoding="utf-8")
ROW = re.compile(r"^\| (\d*) \| (.+) \| `([\w.]+)` \| (.+) \|$", re.MULTILINE)


@dataclass(frozen=True)
class Row:
    """A demand: the lesson's step ("" is the text above the first one), its words, its check."""

    step: str
    words: str
    check: str
    mutants: tuple[str, ...]


def rows(lesson: str) -> list[Row]:
    section = sections(PAGE, r"^## (\w+)$")[lesson]
    found = [
        Row(step, words, check, tuple(names.split("; ")))
        for step, words, check, names in ROW.findall(section)
    ]
    assert len(found) == len(re.findall(r"^\|", section, re.MULTILINE)) - 2  # heading and rule
    return found


def sections(text: str, heading: str) -> dict[str, str]:
    """Return the text below each heading, by what the heading's group has; "" is the first."""
    parts = re.split(heading, text, flags=re.MULTILINE)
    return {"": parts[0], **dict(zip(parts[1::2], parts[2::2]))}


def checks(lesson: str) -> list[str]:
    file = COURSE / lesson / "assignment.yaml"
    return [use.id for use in load_assignment(file, known_checks=CHECKS).checks]


def mutants(lesson: str) -> dict[str, Mutant]:
    file = KEYS / lesson / "mutants.yaml"
    distro = find_distro("jazzy")
    beside = lesson == "own_message"
    found = read_mutants(file, checks=checks(lesson), kinds=CATALOGUE, distro=distro, beside=beside)
    return {mutant.name: mutant for mutant in found.mutants}


def test_every_lesson_stands_on_the_page() -> None:
    assert sorted(name for name in sections(PAGE, r"^## (\w+)$") if name) == LESSONS


@pytest.mark.parametrize("lesson", LESSONS)
def test_every_check_of_a_lesson_belongs_to_a_demand(lesson: str) -> None:
    assert {row.check for row in rows(lesson)} == set(checks(lesson))


@pytest.mark.parametrize("lesson", LESSONS)
def test_every_demand_is_in_its_step_of_the_lesson(lesson: str) -> None:
    steps = sections((COURSE / lesson / "lesson.md").read_text(encoding="utf-8"), r"^## (\d+)\. ")
    assert [row for row in rows(lesson) if row.words not in steps[row.step]] == []


@pytest.mark.parametrize("lesson", LESSONS)
def test_every_demand_has_mutants_that_must_fail_at_its_check(lesson: str) -> None:
    known = mutants(lesson)
    for row in rows(lesson):
        for name in row.mutants:
            assert name in known, f"{lesson} has no mutant '{name}'"
            assert known[name].families == (row.check,), f"'{name}' is a mutant of another check"
            assert known[name].mistake and not known[name].equivalent
