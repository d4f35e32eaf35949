"""What counts as lowering an existing grade."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import pytest

from grader.batch.earlier_gradebook import EarlierGradebook, read_earlier_gradebook
from grader.batch.lowered import lowered
from grader.batch.model import GradebookEntry, Override, Student
from grader.publish.gradebook_csv import gradebook_csv
from tests.pages import classes
from tests.report import samples

FAILED = samples.report(samples.check("run.output", "failed"))  # 90 of 100


def entry(final: float | None, *overrides: Override) -> GradebookEntry:
    return classes.entry(1, FAILED, score=final, final=final, overrides=overrides)


@pytest.mark.parametrize(
    ("before", "final", "lower"),
    [
        ("", 90, False),
        ("-", 90, False),
        ("90", 90, False),
        ("90.00", 89.99, True),
        ("90,50", 90.4, True),
        ("66.67", 66.6667, False),  # as Moodle and Canvas round it
        ("66.67", 66.66, True),
        ("80", 90, False),
        ("80", None, True),
        ("0", 0, False),
        # a grade that cannot be compared is not replaced without consent
        ("A-", 90, True),
        ("complete", 90, True),
    ],
)
def test_a_grade_is_lowered_if_a_cell_gets_less(
    before: str, final: float | None, lower: bool
) -> None:
    assert (lowered(entry(final), before, "x") is not None) == lower


def test_a_grade_lowered_by_a_correction_needs_no_consent() -> None:
    total = Override("1001", "", 50, "x")
    assert lowered(entry(50, total), "90", "x") is None
    taken = Override("1001", "run.starts", 1, "x")  # 4 of 5 points
    assert lowered(entry(86, taken), "90", "x") is None
    assert lowered(entry(80, taken), "90", "x") is not None, "but not what the verdict takes"


def before_of(tmp_path: Path, *entries: GradebookEntry) -> EarlierGradebook:
    path = tmp_path / "gradebook.csv"
    path.write_bytes(gradebook_csv(classes.result(entries), bom=True))
    return read_earlier_gradebook(path)


def test_the_earlier_gradebook_is_compared_row_by_row(tmp_path: Path) -> None:
    old = [classes.entry(n, FAILED, final=90) for n in range(4)]
    old.append(classes.entry(4, None, status="missing", final=0))
    before = before_of(tmp_path, *old)
    new = [
        dataclasses.replace(old[0], final=95),
        dataclasses.replace(old[1], final=80),
        dataclasses.replace(old[2], final=None, status="pending"),
    ]
    found = before.lowered(classes.result(new))
    assert [(one.key, one.before, one.after) for one in found] == [
        ("1001", "90", "80"),
        ("1003", "90", ""),
    ], "what is still to be marked is not lost, and a zero for nothing is no grade"


def test_a_student_whose_key_has_changed_is_found(tmp_path: Path) -> None:
    old = classes.entry(3, FAILED, final=90)
    before = before_of(tmp_path, old)
    renamed = dataclasses.replace(old, student=dataclasses.replace(old.student, key="ann"))
    assert before.lowered(classes.result([renamed])) == []
    nameless = Student("x", old.student.name)
    other = dataclasses.replace(classes.student(4), name=old.student.name)

    def kept(student: Student) -> list[float | None]:
        return [had.final for had in before.elsewhere([student], [student]).values()]

    assert kept(renamed.student) == [90]
    assert kept(nameless) == [90], "by the name, if nobody else has it"
    assert kept(other) == [], "the same name with another email address is somebody else"
    assert kept(classes.student(5)) == []


@pytest.mark.parametrize(
    "content", [None, b"", b"\0\0", b"a,b\n1,2\n", b'"', "키\n1\n".encode("cp949")]
)
def test_another_file_in_place_of_the_gradebook_has_no_grades(
    tmp_path: Path, content: bytes | None
) -> None:
    path = tmp_path / "gradebook.csv"
    if content is not None:
        path.write_bytes(content)
    assert not read_earlier_gradebook(path).rows
