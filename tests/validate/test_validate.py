"""`grader validate`: mutants fail the expected checks, and deviations are reported."""

from __future__ import annotations

import json
import resource
import shutil
import signal
import subprocess
from pathlib import Path

import pytest

from grader.course.find import KEYS
from grader.sandbox.processes import adopt_orphans
from grader.validate.marking import Marked
from grader.validate.matrix import Matrix, MutantResult
from grader.validate.mutant import Mutant
from tests import processes

HELLO = KEYS / "hello_time"
QUICK = 20.0  # seconds of one core for the static checks of all mutants
CHECKED = """\
schema: 1
mutants:
  - name: mine
    check: source.exec_bit
    mistake: source.not_executable
    edits:
"""


def validate(*words: str | Path, timeout: float = 120, forked: bool = True) -> tuple[int, str, str]:
    done = processes.run(processes.grader("validate", *words), timeout=timeout, forked=forked)
    return done.returncode, done.stdout, done.stderr


def processor_seconds() -> float:
    """Return the processor time of our children, which excludes other load."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def keys(folder: Path, mutants: str) -> Path:
    """Return a copy of the keys with other mutants."""
    shutil.copytree(HELLO, folder / "keys")
    (folder / "keys/mutants.yaml").write_text(mutants)
    return folder / "keys"


def test_all_static_mutants_fail_the_expected_checks_for_the_expected_reason(
    tmp_path: Path,
) -> None:
    before = processor_seconds()
    words = ("hello_time", "--static", "--json", tmp_path / "m.json")
    status, shown, errors = validate(*words, forked=False)  # a child of ours, for its time
    assert processor_seconds() - before < QUICK
    assert status == 0, shown[-2000:] + errors
    figures = json.loads((tmp_path / "m.json").read_text())["figures"]
    assert figures["failed_where_they_must"] == figures["that_must_fail"] >= 120
    assert figures["mistake_named_first"] == figures["named"] >= 60


@pytest.mark.parametrize(
    "name",
    [
        pytest.param("spin_missing", marks=pytest.mark.full),
        pytest.param("text_capital", marks=pytest.mark.long),
        pytest.param("period_half", marks=pytest.mark.long),
    ],
)
def test_a_mutant_that_must_run_fails_the_expected_check(name: str, tmp_path: Path) -> None:
    status, shown, errors = validate("hello_time", "--only", name, "--json", tmp_path / "m.json")
    assert status == 0, shown[-2000:] + errors
    (row,) = json.loads((tmp_path / "m.json").read_text())["rows"]
    assert row["ran"]
    assert row["status"][row["expected"]["checks"][0]] == "failed"
    assert "solution" in shown
    assert "100 of 100" in shown


@pytest.mark.long
def test_a_surviving_mutant_is_reported(tmp_path: Path) -> None:
    harmless = CHECKED + "      - {write: README.md, text: hello}\n"
    found = keys(tmp_path, harmless)
    matrix = tmp_path / "m.json"
    status, shown, _ = validate("hello_time", "--keys", found, "--only", "mine", "--json", matrix)
    assert status == 1
    assert "mine: survived" in shown
    (row,) = json.loads(matrix.read_text())["rows"]
    assert "Hello time: 1" in row["transcript"]


@pytest.mark.full
def test_a_mutant_that_fails_another_check_is_reported(tmp_path: Path) -> None:
    other = CHECKED + "      - {delete: resource/my_robot_controller}\n"
    found = keys(tmp_path, other)
    status, shown, _ = validate("hello_time", "--keys", found, "--only", "mine")
    assert status == 1
    assert "mine: did not fail at source.exec_bit" in shown


@pytest.mark.long
def test_another_mistake_than_the_named_one_is_reported(tmp_path: Path) -> None:
    mode = '      - {chmod: my_robot_controller/my_first_node.py, mode: "0644"}\n'
    wrong = CHECKED.replace("source.not_executable", "source.crlf") + mode
    found = keys(tmp_path, wrong)
    status, shown, _ = validate("hello_time", "--keys", found, "--only", "mine", "--static")
    assert status == 1
    assert "mine: the first mistake is source.not_executable, not source.crlf" in shown


@pytest.mark.long
def test_a_solution_without_full_marks_is_reported(tmp_path: Path) -> None:
    mode = '      - {chmod: my_robot_controller/my_first_node.py, mode: "0644"}\n'
    found = keys(tmp_path, CHECKED + mode)
    package = found / "solution/my_robot_controller"
    cfg = package / "setup.cfg"
    cfg.write_text(cfg.read_text().replace("[develop]", "[devel]"))
    status, shown, _ = validate("hello_time", "--keys", found, "--only", "mine")
    assert status == 1
    assert "the solution does not get full marks: package.setup_cfg" in shown


@pytest.mark.long
def test_a_mutant_declared_right_must_get_full_marks(tmp_path: Path) -> None:
    text = "schema: 1\nequivalent:\n  - {mutant: drop rclpy.spin(node), why: I thought so}\n"
    found = keys(tmp_path, text)
    status, shown, _ = validate("hello_time", "--keys", found, "--only", "drop rclpy.spin*")
    assert status == 1
    assert "explained as equivalent, but it did not pass every check" in shown


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("schema: 1\nequivalent:\n  - {mutant: drop nothing, why: x}\n", "drop nothing"),
        (CHECKED + "      - {delete: gone.py}\n", "mutants.yaml:3"),
        (CHECKED + "      - {erase: setup.py}\n", "mutants.yaml:7"),
    ],
)
def test_an_error_in_mutants_yaml_is_a_usage_error(text: str, says: str, tmp_path: Path) -> None:
    status, _, errors = validate("hello_time", "--keys", keys(tmp_path, text), "--static")
    assert status == 2
    assert says in errors
    assert "Traceback" not in errors


@pytest.mark.parametrize(
    "words",
    [("hello_tiem",), ("hello_time", "--only", "nobody"), ("hello_time", "--keys", "/none")],
)
def test_invalid_arguments_are_usage_errors(words: tuple[str, ...]) -> None:
    status, _, errors = validate(*words)
    assert status == 2
    assert "Traceback" not in errors


def test_ctrl_c_ends_validate_and_all_its_processes() -> None:
    adopt_orphans()
    before = set(processes.descendants())
    command = processes.grader("validate", "hello_time", "--only", "text_*")
    process = subprocess.Popen(command, cwd=processes.ROOT, stderr=subprocess.PIPE, text=True)
    assert process.stderr is not None
    assert "to be run" in process.stderr.readline()
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "Traceback" not in errors
    assert processes.descendants(without=before) == {}


@pytest.mark.long
def test_each_mutant_of_the_node_fails_or_is_explained(tmp_path: Path) -> None:
    """The whole matrix takes minutes and is part of `make bench`."""
    file = tmp_path / "m.json"
    status, shown, errors = validate("hello_time", "--only", "drop*", "--json", file, timeout=600)
    assert status == 0, shown[-4000:] + errors[-1000:]
    figures = json.loads(file.read_text())["figures"]
    assert figures["failed_where_they_must"] == figures["that_must_fail"] > 5
    assert figures["equivalent"] > 0


def test_kept_mutants_are_packages_that_can_be_marked(tmp_path: Path) -> None:
    """Each one has a folder of its own; a second run does not write over the first."""
    kept = tmp_path / "kept"
    words = ("hello_time", "--static", "--only", "marker_*", "--keep", kept)
    status, _, errors = validate(*words)
    assert (status, f"written to {kept}" in errors) == (0, True)
    names = sorted(path.name for path in kept.iterdir())
    assert "marker_missing" in names
    package = kept / "marker_missing" / "my_robot_controller"
    assert (package / "setup.py").is_file()
    assert not (package / "resource" / "my_robot_controller").exists()
    status, _, errors = validate(*words)
    assert status == 2
    assert f"{kept} is not empty" in errors


def test_a_check_that_no_mutant_fails_is_not_as_expected() -> None:
    mutant = Mutant(name="one", edits=(), families=("build.colcon",))
    row = MutantResult(mutant, Marked({"build.colcon": "failed", "run.starts": "skipped"}))
    checks = ("build.colcon", "run.starts")
    matrix = Matrix(assignment="a", checks=checks, max_score=2, rows=(row,), left_out=0)
    assert matrix.faults == ("no mutant fails run.starts",)
