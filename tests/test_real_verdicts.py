"""Verdicts for real: built by colcon, run by `ros2 run`, in each sandbox and on each distro.

The solution's is in test_recording.py.
"""

from __future__ import annotations

import json
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from grader.base.cache import cache_root
from grader.report.model import Report
from grader.sandbox.processes import adopt_orphans
from tests import processes
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.corpus.hostile import HOSTILE, WAITED_FOR
from tests.corpus.model import Package
from tests.corpus.right import RIGHT
from tests.marking import assert_verdict, mark, summary

PATIENCE = 120.0  # seconds in which the worst package must have its verdict
# one that each kind of check fails: files, build, install, start, spin, output, time, Ctrl+C
KINDS = (
    *("shebang_missing", "setup_import_error", "module_misspelt"),
    *("spin_missing", "text_capital", "ignores_interrupt"),
)
# what their replays in `make test` leave to the real programs: the build, and Ctrl+C
SOON = ("setup_import_error", "ignores_interrupt")
IMPORTS = "import threading\nimport time\n\nimport rclpy"
# sleep() returns at the first Ctrl+C, so that a second one does not come together with it
WAITS = """\
    rclpy.init(args=args)
    node = MyFirstNode()
    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
    try:
        time.sleep(600)
    except KeyboardInterrupt:
        time.sleep(0.5)
        rclpy.try_shutdon()
"""
DOZEN = [p for p in HOSTILE[:: max(1, len(HOSTILE) // 6)] if p.name not in WAITED_FOR]


def kinds() -> list[object]:
    return [
        pytest.param(p, id=p.name, marks=() if p.name in SOON else pytest.mark.full)
        for p in BROKEN
        if p.name in KINDS
    ]


def test_each_kind_of_check_has_its_package() -> None:
    assert {package.name for package in BROKEN} >= set(KINDS)


@pytest.mark.parametrize("package", kinds())
def test_a_broken_package_fails_where_and_why_it_must(package: Package, tmp_path: Path) -> None:
    assert_verdict(package, mark(write(package, tmp_path)))


@pytest.mark.parametrize(
    "package",
    [
        pytest.param(p, id=p.name, marks=pytest.mark.full if p in DOZEN else pytest.mark.long)
        for p in HOSTILE
    ],
)
def test_a_hostile_package_harms_nothing(package: Package, tmp_path: Path) -> None:
    adopt_orphans()
    before = set(processes.descendants())
    begin = time.monotonic()
    report = mark(write(package, tmp_path))
    assert time.monotonic() - begin < PATIENCE
    assert_verdict(package, report)
    assert len(report.model_dump_json()) < 1_000_000
    assert processes.descendants(without=before) == {}


@pytest.mark.full  # it makes another prefix
def test_the_solution_gets_full_marks_on_kilted_too(tmp_path: Path) -> None:
    report = mark(write(RIGHT[0], tmp_path), distro="kilted")
    assert report.score == 100, summary(report)
    assert report.environment.rclpy == "9.1.2"


@pytest.mark.full
def test_a_form_that_only_jazzys_own_python_reads_is_never_a_failure(tmp_path: Path) -> None:
    """The prefix has the grader's Python, which may be older than the 3.12 of Ubuntu 24.04."""
    root = write(RIGHT[0], tmp_path)
    node = root / "my_robot_controller" / "my_first_node.py"
    text = node.read_text(encoding="utf-8")
    line = "'Hello time: ' + str(self.counter_)"
    assert line in text
    node.write_text(text.replace(line, "f'Hello time: {vars(self)['counter_']}'"), encoding="utf-8")
    report = mark(root)
    statuses = {check.status for check in report.checks}
    assert statuses <= {"passed", "inconclusive"}, summary(report)
    assert report.score + report.inconclusive == 100


@pytest.mark.full
def test_kilteds_second_ctrl_c_does_not_hide_an_error_in_the_clean_up(tmp_path: Path) -> None:
    """Its `ros2 run` sends Ctrl+C on, though the terminal has sent it to the node as well."""
    root = write(RIGHT[0], tmp_path)
    node = root / "my_robot_controller" / "my_first_node.py"
    text = node.read_text(encoding="utf-8")
    before, main, _ = text.partition("def main(args=None):\n")
    node.write_text(f"{before.replace('import rclpy', IMPORTS, 1)}{main}{WAITS}", encoding="utf-8")
    report = mark(root, distro="kilted")
    failed = [check for check in report.checks if check.status == "failed"]
    assert [check.id for check in failed] == ["run.interrupt"], summary(report)
    assert failed[0].mistakes[0].id == "node.attribute_unknown"


@pytest.mark.long
def test_the_tutorials_own_node_gets_full_marks_on_kilted_too(tmp_path: Path) -> None:
    tutorial = next(package for package in RIGHT if package.name == "tutorial")
    report = mark(write(tutorial, tmp_path), distro="kilted")
    assert report.score == 100, summary(report)


@pytest.mark.parametrize(
    "name",
    [
        pytest.param("solution", marks=pytest.mark.full),
        pytest.param("text_capital", marks=pytest.mark.full),
        pytest.param("marker_missing", marks=pytest.mark.long),
        pytest.param("spin_missing", marks=pytest.mark.long),
    ],
)
def test_without_namespaces_the_verdict_is_the_same(name: str, tmp_path: Path) -> None:
    package = next(p for p in (*RIGHT, *BROKEN) if p.name == name)
    root = write(package, tmp_path)
    report = mark(root, sandbox="none")
    if package in RIGHT:
        assert report.score == 100, summary(report)
    else:
        assert_verdict(package, report)
    assert report.environment.sandbox == "none"


@pytest.mark.parametrize(  # needs root, which `make test` does not
    "name",
    [
        pytest.param("solution", marks=pytest.mark.full),
        pytest.param("period_half", marks=pytest.mark.long),
    ],
)
def test_the_account_sandbox_gives_the_same_verdict(name: str, tmp_path: Path) -> None:
    package = next(p for p in (*RIGHT, *BROKEN) if p.name == name)
    root = write(package, tmp_path)
    command = processes.grader("grade", root, "--sandbox", "account", "--out", tmp_path / "out")
    done = processes.run(processes.as_root_of_a_container(command))
    assert done.returncode == (0 if package in RIGHT else 1), done.stdout + done.stderr
    (written,) = (tmp_path / "out").rglob("report.json")
    report = Report.model_validate(json.loads(written.read_text()))
    if package in RIGHT:
        assert report.score == 100, summary(report)
    else:
        assert_verdict(package, report)
    assert report.environment.sandbox == "account"


@pytest.mark.full
def test_an_ordinary_user_gets_the_same_verdict(open_folder: Path) -> None:
    root = write(RIGHT[0], open_folder)
    done = processes.run(
        processes.as_user(processes.grader("grade", root, "--out", open_folder / "reports")),
        env={"HOME": str(open_folder), "GRADER_CACHE": str(cache_root())},
    )
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.fixture
def open_folder() -> Iterator[Path]:
    """A folder that every user may read and write; pytest's own are closed to the others."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        folder.chmod(0o777)
        yield folder
