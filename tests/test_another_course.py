"""An assignment is data: another course has another text, package, node, period, start, step."""

from __future__ import annotations

import io
import json
import zipfile
from pathlib import Path

import pytest

from grader.batch.systems.gradescope.archive import gradescope_zip
from tests import processes
from tests.corpus.build import write
from tests.corpus.right import RIGHT
from tests.marking import ASSIGNMENT, COURSE

OTHER = {
    "my_robot_controller": "turtle_counter",
    "my_first_node": "ticker",
    "test_node": "go",
    "hello_time": "ticking",
    'text: "Hello time: {n}"': 'text: "[{n}] ticks, said the turtle"',
    "start: 0": "start: 5",
    "step: 1": "step: 5",
    "period: 1.0": "period: 0.5",
}
NODE = {
    "'Hello time: ' + str(self.counter_)": "f'[{self.counter_}] ticks, said the turtle'",
    "self.counter_ = 0": "self.counter_ = 5",
    "self.counter_ += 1": "self.counter_ += 5",
    "create_timer(1.0,": "create_timer(0.5,",
}


def replaced(text: str, pairs: dict[str, str]) -> str:
    for old, new in pairs.items():
        assert old in text, old
        text = text.replace(old, new)
    return text


def write_assignment(folder: Path) -> Path:
    """Write the other course's assignment and return its file."""
    text = (COURSE / "assignment.yaml").read_text()
    file = folder / "course" / "ticking" / "assignment.yaml"
    file.parent.mkdir(parents=True)
    file.write_text(replaced(text, OTHER))
    return file


def write_solution(folder: Path) -> Path:
    """Write the package that the other course requires."""
    root = write(RIGHT[0], folder)
    node = root / "my_robot_controller" / "my_first_node.py"
    node.write_text(replaced(node.read_text(), NODE))
    names = {k: v for k, v in OTHER.items() if k in ("my_robot_controller", "my_first_node")}
    for file in [path for path in root.rglob("*") if path.is_file()]:
        text = file.read_text()
        for old, new in {**names, "test_node": "go"}.items():
            text = text.replace(old, new)
        file.write_text(text)
    node.rename(node.with_name("ticker.py"))
    (root / "my_robot_controller").rename(root / "turtle_counter")
    (root / "resource" / "my_robot_controller").rename(root / "resource" / "turtle_counter")
    return root


@pytest.fixture
def course(tmp_path: Path) -> Path:
    return write_assignment(tmp_path)


@pytest.fixture
def package(tmp_path: Path) -> Path:
    return write_solution(tmp_path)


@pytest.mark.full
def test_its_own_package_gets_full_marks(course: Path, package: Path, tmp_path: Path) -> None:
    done = processes.run(
        processes.grader("grade", package, "--assignment", course, "--out", tmp_path / "o")
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "100 / 100" in done.stdout


def test_an_assignment_may_ask_for_the_output_alone(
    course: Path, package: Path, tmp_path: Path
) -> None:
    text = course.read_text()
    checks = "checks:\n  - {id: package.found, points: 1}\n  - {id: run.output, points: 2}\n"
    course.write_text(text[: text.index("\nchecks:") + 1] + checks)
    done = processes.run(
        processes.replaying("grade", package, "--assignment", course, "--out", tmp_path / "o")
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "3 / 3" in done.stdout


@pytest.mark.full
def test_the_package_of_the_first_course_does_not_get_full_marks(
    course: Path, tmp_path: Path
) -> None:
    solution = write(RIGHT[0], tmp_path)
    done = processes.run(
        processes.grader(
            "grade", solution, "--all", "--assignment", course, "--out", tmp_path / "o"
        )
    )
    assert done.returncode == 1
    assert "turtle_counter" in done.stdout


def test_a_course_folder_is_named_by_the_environment(
    course: Path, package: Path, tmp_path: Path
) -> None:
    done = processes.run(
        processes.replaying("grade", package, "--assignment", "ticking", "--out", tmp_path / "o"),
        env={"GRADER_COURSE": str(course.parent.parent)},
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_self_check_says_how_many_checks_are_hidden(course: Path, package: Path) -> None:
    course.write_text(course.read_text().replace("hidden_checks: 0", "hidden_checks: 2"))
    done = processes.run(processes.replaying("check", package, "--assignment", course))
    assert done.returncode == 0, done.stdout + done.stderr
    assert "2 hidden checks" in done.stdout


@pytest.fixture
def keys(course: Path, tmp_path: Path) -> Path:
    """An instructor's folder with a hidden check of the output, which the assignment announces."""
    text = course.read_text().replace("hidden_checks: 0", "hidden_checks: 1")
    checks = "checks:\n  - {id: package.found, points: 1}\n"
    course.write_text(text[: text.index("\nchecks:") + 1] + checks)
    folder = tmp_path / "keys"
    folder.mkdir()
    (folder / "hidden.yaml").write_text("checks: [{id: run.output, points: 2}]\n")
    return folder


def test_hidden_checks_are_read_from_the_instructors_folder(
    course: Path, package: Path, keys: Path, tmp_path: Path
) -> None:
    words = ("grade", package, "--assignment", course, "--keys", keys, "--out", tmp_path / "o")
    done = processes.run(processes.replaying(*words))
    assert done.returncode == 0, done.stdout + done.stderr
    assert "3 / 3" in done.stdout
    (file,) = (tmp_path / "o").rglob("report.json")
    checks = json.loads(file.read_text())["checks"]
    assert [(c["id"], c["visibility"]) for c in checks] == [
        ("package.found", "visible"),
        ("run.output", "hidden"),
    ]


@pytest.mark.parametrize("command", ["grade", "grade-all", "validate", "gradescope-zip"])
def test_announced_hidden_checks_are_required_without_that_folder(
    course: Path, package: Path, keys: Path, tmp_path: Path, command: str
) -> None:
    (keys / "hidden.yaml").unlink()
    words = {
        "grade": (package, "--assignment", course),
        "grade-all": (package.parent, "--assignment", course, "--out", tmp_path / "o"),
        "validate": (course, "--keys", keys),
        "gradescope-zip": (tmp_path / "a.zip", "--assignment", course),
    }[command]
    done = processes.run(processes.grader(command, *words))
    assert done.returncode == 2, done.stderr
    assert "hidden_checks is 1" in done.stderr
    assert "--keys" in done.stderr
    assert not (tmp_path / "a.zip").exists()


def test_gradescopes_archive_has_the_hidden_checks(course: Path, keys: Path) -> None:
    data = gradescope_zip(assignment=str(course), keys=keys)
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        assert archive.read("keys/hidden.yaml") == (keys / "hidden.yaml").read_bytes()
        assert "--keys keys" in archive.read("run_autograder").decode()


def test_validate_runs_the_hidden_checks(
    course: Path, package: Path, keys: Path, tmp_path: Path
) -> None:
    (keys / "solution").mkdir()
    package.rename(keys / "solution" / "turtle_counter")
    out = tmp_path / "m.json"
    words = ("validate", course, "--keys", keys, "--static", "--only", "drop*", "--json", out)
    done = processes.run(processes.grader(*words))
    assert done.returncode in (0, 1), done.stderr
    assert json.loads(out.read_text())["checks"] == ["package.found", "run.output"]


def test_hello_time_is_worth_a_hundred() -> None:
    assert ASSIGNMENT.max_score == 100
