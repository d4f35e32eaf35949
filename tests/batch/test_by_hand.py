"""A submission that holds no package has no grade, and its reason comes first."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from tests.batch.archives import write, zipped
from tests.batch.downloads import moodle_files, people, scored, worksheet
from tests.batch.odd_files import ODD_FILES
from tests.batch.stub_run import Run, grade_all
from tests.processes import ROOT

pytestmark = pytest.mark.prefix


@pytest.fixture(scope="session")
def zero(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The assignment with a policy that gives zero for a missing submission."""
    place = tmp_path_factory.mktemp("course") / "hello_time"
    shutil.copytree(ROOT / "lab/course/hello_time", place)
    with (place / "assignment.yaml").open("a", encoding="utf-8") as file:
        file.write("\npolicy:\n  missing: zero\n")
    return place / "assignment.yaml"


def by_hand(run: Run) -> str:
    """Return what the terminal lists for the instructor to look at, without its line ends."""
    return " ".join(run.output.partition("Look at by hand")[2].split())


def test_nobody_gets_a_zero_for_a_file_that_cannot_be_opened(tmp_path: Path, zero: Path) -> None:
    class_ = people(len(ODD_FILES) + 4)
    odd = dict(zip(class_, ODD_FILES, strict=False))
    good = class_[len(odd) : -1]
    files = [(person, name, ODD_FILES[name][0]) for person, name in odd.items()]
    files += [(person, "package.zip", zipped(scored(90))) for person in good]
    path = moodle_files(tmp_path / "class.zip", files)
    (tmp_path / "worksheet.csv").write_bytes(
        worksheet([*class_[:-1], replace(class_[-1], submitted=False)])
    )
    words = ("--worksheet", tmp_path / "worksheet.csv", "--assignment", zero)
    run = grade_all(path, tmp_path / "out", *words, quiet=False)
    assert run.status == 1, run.output
    finals = {person.name: "" for person in odd} | {person.name: "90" for person in good}
    assert run.finals() == {**finals, class_[-1].name: "0"}
    sheet = run.column("moodle-worksheet.csv", "Grade", "Full name")
    assert sheet == {**finals, class_[-1].name: "0"}, "an empty cell is no zero"
    page = (run.out / "index.html").read_text(encoding="utf-8")
    first = page.partition("Needs attention</h2>")[2].partition("<h2")[0]
    assert page.index("Look at by hand") < page.index("The class in numbers")
    notes = run.column("gradebook.csv", "notes", "name")
    checks = run.column("gradebook.csv", "package.found", "name")
    for person, name in odd.items():
        reason = ODD_FILES[name][1]
        assert by_hand(run).count(reason) == 1, name
        assert first.count(reason) == 1, name
        assert "look at by hand: " in notes[person.name]
        assert reason in notes[person.name]
        assert checks[person.name] == "", "nor are the points of its checks"
        feedback = (run.out / "feedback" / f"{person.feedback}.md").read_text(encoding="utf-8")
        assert "No points yet: to be looked at by hand" in feedback
        assert "of 100" not in feedback


def test_a_file_with_a_students_name_is_no_missing_submission(tmp_path: Path, zero: Path) -> None:
    folder = tmp_path / "class"
    for name in ("Ann Lee", "Bela Nagy", "Chidi Okafor", "Dan Poe", "Eve Ray"):
        write(folder / name, scored(90))
    (folder / "Kim Minji.pdf").write_bytes(b"%PDF-1.7\n")
    (folder / "read me.txt").write_text("the class of 2026")
    roster = tmp_path / "roster.csv"
    names = [*(place.name for place in folder.iterdir() if place.is_dir()), "Kim Minji", "Zoe Zed"]
    rows = [f"s{n},{name},s{n}@example.org" for n, name in enumerate(names)]
    roster.write_text("\n".join(["id,name,email", *rows]) + "\n")
    words = ("--roster", roster, "--assignment", zero, "--accept", "join")
    run = grade_all(folder, tmp_path / "out", *words, quiet=False)
    finals = run.finals()
    assert (finals["Kim Minji"], finals["Zoe Zed"], finals["Ann Lee"]) == ("", "0", "90")
    assert "Kim Minji: Kim Minji.pdf is neither a folder nor an archive" in by_hand(run)
    assert run.output.count("Kim Minji.pdf is neither") == 1
    left_out = [line for line in run.output.splitlines() if "left out" in line]
    assert left_out == ["  left out: neither a folder nor an archive: read me.txt"]
