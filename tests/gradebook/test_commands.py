"""The conversion commands: output, files, refusals and exit statuses."""

from __future__ import annotations

import json
import stat as modes
import subprocess
import sys
import zipfile
from pathlib import Path

import jsonschema
import pytest

from grader.report.files import report_json
from tests import processes
from tests.gradebook.schemas import GRADESCOPE, PRAIRIELEARN
from tests.gradebook.test_junit import suites
from tests.report import samples


def outputs(*words: str | Path) -> subprocess.CompletedProcess[str]:
    return processes.run([sys.executable, "-m", "grader", *words])


@pytest.fixture
def report(tmp_path: Path) -> Path:
    path = tmp_path / "report.json"
    path.write_text(report_json(samples.failing_report()))
    return path


def test_a_report_is_converted_into_each_form(report: Path) -> None:
    jsonschema.validate(json.loads(outputs("convert", "gradescope", report).stdout), GRADESCOPE)
    jsonschema.validate(json.loads(outputs("convert", "prairielearn", report).stdout), PRAIRIELEARN)
    (suite,) = suites(outputs("convert", "junit", report).stdout.encode())
    assert suite.failures == 1
    assert outputs("convert", "md", report).stdout.startswith("# anna")


def test_the_archive_is_readable_by_its_owner_only(tmp_path: Path) -> None:
    out = tmp_path / "autograder.zip"
    done = outputs("gradescope-zip", out)
    assert done.returncode == 0, done.stderr
    assert modes.S_IMODE(out.stat().st_mode) == 0o600
    with zipfile.ZipFile(out) as archive:
        assert archive.testzip() is None
        assert "run_autograder" in archive.namelist()


@pytest.mark.parametrize(
    ("words", "status", "output"),
    [
        (["convert", "gradescope", "/no/such"], 2, "/no/such"),
        (["convert", "gradescope", str(processes.ROOT / "setup.py")], 2, "not a report"),
        (["convert", "gradscope", "x"], 2, "gradscope"),
        (["gradescope-zip", "--distro", "jazy", "x.zip"], 2, "did you mean 'jazzy'?"),
        (["gradescope-zip", "--sandbox", "acount", "x.zip"], 2, "did you mean 'account'?"),
        (["gradescope-zip", "/no/such/folder/x.zip"], 3, "could not be written"),
    ],
)
def test_a_usage_error_says_what_to_do(words: list[str], status: int, output: str) -> None:
    done = outputs(*words)
    assert done.returncode == status
    assert output in done.stderr
    assert "Traceback" not in done.stderr
