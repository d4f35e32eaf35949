"""The autograder archive, unpacked as Gradescope does, marks real packages as root of a container.

`results.json` is written and right, whatever happens.
"""

from __future__ import annotations

import json
import shutil
import stat
import sys
import tempfile
import zipfile
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from grader.base.errors import SurroundingsError, UsageError
from grader.batch.systems.gradescope import container as gradescope_run
from grader.batch.systems.gradescope.archive import gradescope_zip
from grader.package.edit.tree import Replace
from grader.package.submission import take_in
from grader.report import events
from grader.report.model import Report
from grader.ros.prefix import Ros
from grader.verdict.mark import grade
from grader.verdict.order import Order, make_orders
from tests import processes, recorded, weather
from tests.corpus.build import write
from tests.corpus.model import Package
from tests.gradebook.schemas import GRADESCOPE
from tests.report import samples

SOLUTION = Package(name="my_robot_controller", edits=())
SECRETS = ("source/grader/keys", "submission_metadata.json", "results", "submission")
# a setup.py that fails the build if it can read files that are not the student's
SPY = """import os
for name in {places!r}:
    try:
        os.listdir(name) if os.path.isdir(name) else open(name).read()
    except OSError:
        continue
    raise SystemExit('could read ' + name)
from setuptools import find_packages
"""
METADATA = {
    "id": 12345,
    "created_at": "2026-11-20T19:00:00.000000-08:00",
    "users": [{"email": "ann@example.org", "id": 1, "name": "Ann Lee"}],
    "previous_submissions": [],
}


def unpack(folder: Path, content: bytes) -> None:
    """Unpack the archive as Gradescope does: modes kept, `run_autograder` beside `source`."""
    with zipfile.ZipFile(BytesIO(content)) as archive:
        for entry in archive.infolist():
            path = Path(archive.extract(entry, folder / "source"))
            path.chmod(stat.S_IMODE(entry.external_attr >> 16))
    shutil.copy2(folder / "source/run_autograder", folder / "run_autograder")
    (folder / "submission").mkdir()
    (folder / "results").mkdir()
    (folder / "submission_metadata.json").write_text(json.dumps(METADATA))


@pytest.fixture
def autograder(ros_jazzy: Ros) -> Iterator[Path]:
    """A folder in the role of /autograder, open to all as there, with our own environment."""
    folder = Path(tempfile.mkdtemp(prefix="autograder-"))
    folder.chmod(0o755)
    unpack(folder, gradescope_zip())
    (folder / "source/.venv").symlink_to(sys.prefix)
    yield folder
    shutil.rmtree(folder)


def run(autograder: Path) -> tuple[int, dict[str, Any], str]:
    """Run it as root of a throwaway container; return status, results and output."""
    command = processes.as_root_of_a_container([str(autograder / "run_autograder")])
    done = processes.run(command, cwd=autograder, env={"PYTHONPATH": ""})
    written = (autograder / "results/results.json").read_bytes()
    assert written.isascii()
    assert b"\r" not in written
    found = json.loads(written)
    jsonschema.validate(found, GRADESCOPE)
    return done.returncode, found, done.stdout + done.stderr


@pytest.mark.full  # needs root, which `make test` does not
def test_the_solution_gets_full_marks_and_cannot_read_the_keys(autograder: Path) -> None:
    places = [str(autograder / name) for name in SECRETS]
    line = "from setuptools import find_packages\n"
    edit = Replace("setup.py", line, SPY.format(places=places))
    spy = Package(name=SOLUTION.name, edits=(edit,))
    write(spy, autograder / "submission")
    status, found, output = run(autograder)
    assert (status, found["score"]) == (0, 100), output
    assert {test["status"] for test in found["tests"]} == {"passed"}
    assert found["extra_data"]["submission"]["id"] == 12345
    assert found["extra_data"]["report"]["assignment"] == "hello_time"
    assert "Ann Lee: 100 of 100" in output


@pytest.mark.full
def test_a_broken_package_gets_the_reasons(autograder: Path) -> None:
    fault = Replace("setup.py", "my_first_node:main", "my_frist_node:main")
    write(Package(name=SOLUTION.name, edits=(fault,)), autograder / "submission")
    status, found, output = run(autograder)
    tests = {test["extra_data"]["check"]: test for test in found["tests"]}
    assert status == 0, output
    assert found["score"] < 100
    assert tests["entry_point.mapping"]["status"] == "failed"
    assert "my_frist_node" in tests["entry_point.mapping"]["output"]
    assert "because entry_point.mapping did not pass" in tests["run.output"]["output"]


@pytest.mark.full
def test_a_submission_without_a_package_has_results(autograder: Path) -> None:
    (autograder / "submission/notes.txt").write_text("I could not do it")
    status, found, _ = run(autograder)
    assert (status, found["score"]) == (0, 0)
    assert found["tests"][0]["status"] == "failed"


@pytest.mark.full
def test_a_grader_that_cannot_start_says_it_is_not_the_students_fault(autograder: Path) -> None:
    (autograder / "source/.venv").unlink()
    status, found, output = run(autograder)
    assert status != 0
    assert found["score"] == 0
    assert "not your package" in found["output"]
    assert "not your package" not in output


@pytest.mark.long
def test_the_archives_setup_installs_all_that_it_needs(autograder: Path) -> None:
    """`setup.sh` makes the locked environment from the archive alone, without the tests' part."""
    (autograder / "source/.venv").unlink()
    done = processes.run([autograder / "source/setup.sh"], cwd=autograder, timeout=300)
    assert done.returncode == 0, done.stderr
    write(SOLUTION, autograder / "submission")
    status, found, output = run(autograder)
    assert (status, found["score"]) == (0, 100), output


def test_results_are_complete_after_each_check(
    ros_jazzy: Ros, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(SOLUTION, tmp_path / "submission")
    seen: list[tuple[int, float, str]] = []

    def watched(order: Order, file: events.Listener) -> Report:
        def listener(event: events.Event) -> None:
            file(event)
            if isinstance(event, events.CheckFinished):
                found = json.loads((tmp_path / "results/results.json").read_text())
                jsonschema.validate(found, GRADESCOPE)
                seen.append((len(found["tests"]), found["score"], found["output"]))

        started = json.loads((tmp_path / "results/results.json").read_text())
        assert started["score"] == 0, "it is there before the first check"
        return grade(order, listener)

    monkeypatch.setattr("grader.verdict.mark.mark", recorded.mark_submission)
    monkeypatch.setattr(gradescope_run, "grade", watched)
    assert gradescope_run.run(tmp_path, sandbox="bubblewrap") == 0
    final = json.loads((tmp_path / "results/results.json").read_text())
    assert [count for count, _, _ in seen] == list(range(1, len(final["tests"]) + 1))
    assert [score for _, score, _ in seen] == sorted(score for _, score, _ in seen)
    assert seen[-1][1] == final["score"] == 100
    assert "run.interrupt" in seen[0][2], "what was not asked yet is named"
    assert "cut off" not in final["output"]
    assert [path.name for path in (tmp_path / "results").iterdir()] == ["results.json"]


@pytest.mark.parametrize("fault", [SurroundingsError("no sandbox"), RuntimeError("a bug of ours")])
def test_a_grader_failure_keeps_earlier_results(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    fault: Exception,
) -> None:
    write(SOLUTION, tmp_path / "submission")

    def fails(order: Order, file: events.Listener) -> Report:
        file(events.CheckFinished(samples.check("package.found")))
        raise fault

    monkeypatch.setattr(gradescope_run, "grade", fails)
    assert gradescope_run.run(tmp_path, sandbox="bubblewrap") == 3
    found = json.loads((tmp_path / "results/results.json").read_text())
    jsonschema.validate(found, GRADESCOPE)
    assert [test["extra_data"]["check"] for test in found["tests"]] == ["package.found"]
    assert found["output"].startswith("The grader failed, not your package.")
    assert str(fault) not in json.dumps(found)
    assert str(fault) in capsys.readouterr().err, "the instructor sees why"


def test_a_missing_submission_or_wrong_assignment_has_results(tmp_path: Path) -> None:
    for assignment in ("hello_time", "hello_tme"):
        assert gradescope_run.run(tmp_path, sandbox="bubblewrap", assignment=assignment) != 0
        found = json.loads((tmp_path / "results/results.json").read_text())
        jsonschema.validate(found, GRADESCOPE)
        assert "not your package" in found["output"]
        (tmp_path / "results/results.json").unlink()


@pytest.mark.parametrize(
    "content",
    ["", "[]", "{", "null", '{"users": 3}', '{"users": [1, {"name": 2}]}', "[" * 100_000],
)
def test_invalid_metadata_is_tolerated(tmp_path: Path, content: str) -> None:
    path = tmp_path / "submission_metadata.json"
    path.write_text(content)
    assert gradescope_run.student_name(gradescope_run.read_metadata(path)) is None
    assert gradescope_run.read_metadata(tmp_path / "none") == {}


def test_a_group_submission_has_all_names() -> None:
    metadata = {"users": [{"name": "Ann"}, {"name": "B\u202eob\n"}]}
    assert gradescope_run.student_name(metadata) == "Ann, B\\u202eob\\n"


def test_the_archive_has_only_what_gradescope_needs() -> None:
    content = gradescope_zip()
    assert content == gradescope_zip(), "the same files make the same archive"
    with zipfile.ZipFile(BytesIO(content)) as archive:
        names = set(archive.namelist())
        modes = {entry.filename: entry.external_attr >> 16 for entry in archive.infolist()}
        scripts = {name: archive.read(name) for name in ("setup.sh", "run_autograder")}
    for name, script in scripts.items():
        assert modes[name] & 0o111 == 0o111
        assert script.startswith(b"#!/")
        assert b"\r" not in script
    assert "grader/keys/hello_time/solution/my_robot_controller/setup.py" in names
    assert "lab/course/hello_time/assignment.yaml" in names
    others = {name for name in names if name.startswith(("tests/", ".git", ".venv"))}
    assert others == {"tests/requirements.txt"}
    assert not any("__pycache__" in name for name in names)


def test_the_archive_can_have_the_instructors_own_assignment(tmp_path: Path) -> None:
    own = tmp_path / "a b; $(touch x)" / "own assignment.yaml"
    own.parent.mkdir()
    shutil.copy(processes.ROOT / "lab/course/hello_time/assignment.yaml", own)
    with zipfile.ZipFile(BytesIO(gradescope_zip(assignment=str(own)))) as archive:
        assert archive.read("assignment/own assignment.yaml") == own.read_bytes()
        assert b"--assignment 'assignment/own assignment.yaml'" in archive.read("run_autograder")


def test_the_archive_can_have_another_courses_assignment(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    course = weather.write_course(tmp_path)
    monkeypatch.setenv("GRADER_COURSE", str(course))
    for assignment in (None, "readings"):
        with zipfile.ZipFile(BytesIO(gradescope_zip(assignment=assignment))) as archive:
            own = (course / "readings" / "assignment.yaml").read_bytes()
            assert archive.read("assignment/assignment.yaml") == own
            output = archive.read("run_autograder")
            assert b"--assignment assignment/assignment.yaml" in output


def test_an_archive_of_nothing_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SurroundingsError, match="not a checkout"):
        gradescope_zip(root=tmp_path)
    with pytest.raises(UsageError, match="hello_tme"):
        gradescope_zip(assignment="hello_tme")
    with pytest.raises(UsageError, match="no assignment"):
        gradescope_zip(assignment=str(tmp_path / "none.yaml"))


def policy(tmp_path: Path) -> Order:
    """Return an order with 10% off a day after 2026-11-20 12:00 in Los Angeles."""
    text = (processes.ROOT / "lab/course/hello_time/assignment.yaml").read_text(encoding="utf-8")
    file = tmp_path / "assignment.yaml"
    file.write_text(f"{text}policy: {{due: 2026-11-20T12:00:00-08:00, late: {{per_day: 10%}}}}\n")
    (order,) = make_orders(tmp_path, str(file), "jazzy", "account", ())
    return order


@pytest.mark.parametrize(
    ("created", "taken"),
    [
        ("2026-11-20T19:00:00.000000-08:00", 10),
        ("2026-11-20T12:00:00.000000-08:00", 0),
        ("2026-11-22T19:00:00.000Z", 20),
        ("yesterday", 0),
        (None, 0),
    ],
)
def test_lateness_comes_from_gradescopes_time_stamp(
    tmp_path: Path, created: str | None, taken: float
) -> None:
    metadata = {"created_at": created}
    assert gradescope_run.late_points(samples.report(), metadata, policy(tmp_path)) == taken


@pytest.mark.parametrize(
    ("method", "modes"), [("upload", "unknown"), ("GitHub", "recorded"), (None, "unknown")]
)
def test_an_exec_bit_lost_by_an_upload_costs_nothing(
    tmp_path: Path, method: str | None, modes: str
) -> None:
    write(SOLUTION, tmp_path / "submission")
    metadata = {} if method is None else {"submission_method": method}
    order = gradescope_run.order_for(tmp_path, metadata, "hello_time", "jazzy", "account")
    found = take_in(
        order.path,
        package=order.assignment.package,
        node_file=order.assignment.node_file,
        modes_kept=order.modes_kept,
    )
    assert found.modes == modes
