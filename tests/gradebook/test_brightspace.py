"""Brightspace's grades export: only the cells of one item change."""

from __future__ import annotations

import pytest

from grader.base.errors import UsageError
from grader.batch.model import ClassResult, GradebookEntry, Student
from grader.batch.systems.brightspace.grades import read_grades
from grader.batch.systems.known import SYSTEMS

HEADER = (
    "OrgDefinedId,Username,Last Name,First Name,Email,"
    "Hello time Points Grade <Numeric MaxPoints:100>,End-of-Line Indicator\r\n"
)
EXPORT = (
    f"\ufeff{HEADER}#101,#stud0,Zero,Student,s0@example.org,,#\r\n"
    "#102,#stud1,One,Student,s1@example.org,55.5,#\r\n#103,#stud2,Two,Student,,,#\r\n"
)
NAMES = ("Hello time", "hello_time")


def result(*finals: float | None, most: float = 100) -> ClassResult:
    students = (
        Student("a", "Zero Student", username="stud0"),
        Student("b", "B", id_number="102"),
        Student("c", "Student Two"),
    )
    entries = [
        GradebookEntry(
            one, "graded" if final is not None else "missing", final=final, max_score=most
        )
        for one, final in zip(students, finals)
    ]
    return ClassResult("Hello", "hello_time", SYSTEMS["brightspace"], tuple(entries), most)


def test_only_the_cells_of_the_item_change() -> None:
    export = read_grades(EXPORT.encode(), column="", names=NAMES)
    filled = export.filled(result(87.5, 60, None), lambda _: "")
    wanted = EXPORT.replace("s0@example.org,,", "s0@example.org,87.5,").replace(",55.5,", ",60,")
    assert filled.content.decode() == wanted
    one = [(entry.student.key, cell) for entry, cell in export.existing(result(1, 2, 3))]
    assert one == [("a", ""), ("b", "55.5"), ("c", "")]
    assert "Student Two was found in Brightspace's grades export by name only" in (
        export.filled(result(None, None, 3), lambda _: "").warnings
    )


def test_a_grade_above_the_items_maximum_is_refused() -> None:
    export = read_grades(EXPORT.encode(), column="", names=NAMES)
    with pytest.raises(UsageError, match="more points than Brightspace"):
        export.filled(result(120, None, None, most=120), lambda _: "")


def test_an_item_of_several_is_named() -> None:
    two = HEADER.replace("Hello", "Bye Points Grade <Numeric MaxPoints:9>,Hi").encode()
    row = b"#101,#stud0,Zero,Student,s0@example.org,,,#\r\n"
    with pytest.raises(UsageError, match="not clear which column"):
        read_grades(two + row, column="", names=NAMES)
    assert read_grades(two + row, column="bye", names=NAMES).most == 9
    assert read_grades(two + row, column="", names=("Hi time",)).column == 6
    with pytest.raises(UsageError, match="no column OrgDefinedId"):
        read_grades(b"a,b\n1,2\n", column="", names=NAMES)
