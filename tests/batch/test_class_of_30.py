"""A class of 30 on Moodle with every oddity in it, marked three times: no grade changes."""

from __future__ import annotations

import re
import shutil
import zipfile
from dataclasses import replace
from pathlib import Path

import pytest

from tests.batch.archives import zipped
from tests.batch.downloads import Person, moodle_files, people, scored, worksheet
from tests.batch.odd_files import ODD_FILES
from tests.batch.stub_run import Run, grade_all
from tests.processes import ROOT, grader, run

pytestmark = [pytest.mark.prefix, pytest.mark.full]

POLICY = """
policy:
  due: 2026-11-20T23:59:00
  time_zone: Asia/Seoul
  late: {per_day: 10%}
  missing: zero
"""
SAME, LATE, EXTENDED, COPIED, HALF = range(0, 2), 2, 3, 4, 5
ODD = range(6, 6 + len(ODD_FILES))
GONE, COUNT = 29, 30
STATUS = {
    LATE: "Submitted for grading - 2 days 3 hours late",
    EXTENDED: "Submitted for grading - Extension granted until: Wednesday, 25 November 2026, "
    "11:59 PM",
}


@pytest.fixture
def assignment(tmp_path: Path) -> Path:
    place = tmp_path / "course" / "hello_time"
    shutil.copytree(ROOT / "lab/course/hello_time", place)
    with (place / "assignment.yaml").open("a", encoding="utf-8") as file:
        file.write(POLICY)
    return place / "assignment.yaml"


def a_class() -> list[Person]:
    class_ = people(COUNT)
    for n in (*SAME, GONE):
        class_[n] = replace(class_[n], submitted=False)
    return [replace(one, name="Same Name") if n in SAME else one for n, one in enumerate(class_)]


def sheet(class_: list[Person]) -> bytes:
    """Return the worksheet: one is late, another one was late but has an extension."""
    lines = worksheet(class_).decode().split("\r\n")
    for n, status in STATUS.items():
        lines[n + 1] = lines[n + 1].replace("Submitted for grading", f'"{status}"')
        date = (
            "Tuesday, 24 November 2026, 3:00 PM"
            if n == EXTENDED
            else "Monday, 23 November 2026, 2:59 AM"
        )
        lines[n + 1] = lines[n + 1].replace("Friday, 20 November 2026, 7:00 PM", date)
    return "\r\n".join(lines).encode()


def download(path: Path, class_: list[Person], *, again: bool) -> Path:
    """Write Moodle's zip; `again`: two students handed in a second time."""
    names = dict(zip(ODD, ODD_FILES, strict=True))
    files = []
    for n, person in enumerate(class_):
        score = (100 if again else 60) if n in (COPIED, HALF) else 90
        name = names.get(n, "package.zip")
        content = ODD_FILES[name][0] if n in names else zipped(scored(score))
        if person.submitted:
            files.append((person, name, content))
    moodle_files(path, files)
    with zipfile.ZipFile(path, "a") as archive:  # put there by hand, from an email
        archive.writestr("Same Name/package.zip", zipped(scored(90)))
    return path


def oddities(class_: list[Person]) -> list[str]:
    """Return what the terminal must say, each once."""
    odd = [reason for _, reason in ODD_FILES.values()]
    copied, half = class_[COPIED].name, class_[HALF].name
    return [
        *odd,
        "Same Name: 2 students of this name",
        f"{copied}: the total of attempt 1 was corrected to 10, because: copied",
        f"{half}: run.output of attempt 1 was corrected to 5, because: half of it",
    ]


def test_a_class_with_every_oddity_has_the_same_grades_each_time(
    tmp_path: Path, assignment: Path
) -> None:
    class_, out = a_class(), tmp_path / "out"
    (tmp_path / "worksheet.csv").write_bytes(sheet(class_))
    words = ("--worksheet", tmp_path / "worksheet.csv", "--assignment", assignment)
    first = grade_all(download(tmp_path / "class.zip", class_, again=False), out, *words)
    assert first.status == 1, first.output
    for n, how in (
        (COPIED, ("--points", "10", "--because", "copied")),
        (HALF, ("--check", "run.output", "--points", "5", "--because", "half of it", "--force")),
    ):
        corrected = (class_[n].email, *how, "--assignment", assignment, "--out", out)
        assert run(grader("override", *corrected)).returncode == 0
    download(tmp_path / "class.zip", class_, again=True)
    runs = [grade_all(tmp_path / "class.zip", out, *words, quiet=False)]
    saved = [(out / name).read_bytes() for name in ("gradebook.csv", "moodle-worksheet.csv")]
    runs.append(grade_all(tmp_path / "class.zip", out, *words, quiet=False))
    runs.append(grade_all(tmp_path / "class.zip", out, *words, "--regrade", quiet=False))
    assert [(out / n).read_bytes() for n in ("gradebook.csv", "moodle-worksheet.csv")] == saved
    finals = final_grades(runs[0])
    expected = {one.id_number: "90" for one in class_}
    expected |= {class_[n].id_number: "" for n in (*SAME, *ODD)}
    expected |= {class_[LATE].id_number: "60", class_[EXTENDED].id_number: "90"}
    expected |= {class_[n].id_number: "100" for n in (COPIED, HALF)}
    expected |= {class_[GONE].id_number: "0"}
    assert finals == expected
    assert runs[0].column("moodle-worksheet.csv", "Grade", "ID number") == expected
    for one in runs:
        said = " ".join(one.output.split())
        assert {text: said.count(text) for text in oddities(class_)} == dict.fromkeys(
            oddities(class_), 1
        )
    page = re.sub(r"\s+", " ", (out / "index.html").read_text(encoding="utf-8"))
    first_part = page.partition("Needs attention</h2>")[2].partition("<h2")[0]
    assert page.index("Needs attention</h2>") < page.index("The class in numbers")
    for text in oddities(class_):
        assert first_part.count(text.partition(": ")[2] if "attempt 1" in text else text) == 1


def final_grades(marked: Run) -> dict[str, str]:
    """Return the final grades by the student's number; the file without an owner has none."""
    return {row["id_number"]: row["final"] for row in marked.rows() if row["id_number"]}
