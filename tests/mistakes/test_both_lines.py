"""The text of a fix names each line that the patch changes."""

from __future__ import annotations

from pathlib import Path

from grader.report.model import CheckResult
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.recorded import mark

BY_NAME = {package.name: package for package in BROKEN}


def failed(name: str, folder: Path) -> CheckResult:
    checks = mark(write(BY_NAME[name], folder)).checks
    return next(check for check in checks if check.status == "failed")


def test_both_settings_of_another_package_are_named(tmp_path: Path) -> None:
    fix = failed("setup_cfg_other_package", tmp_path).fix
    assert "script_dir=" in fix
    assert "install_scripts=" in fix


def test_a_wrong_program_on_line_1_is_not_a_missing_line(tmp_path: Path) -> None:
    assert "'python3\\r': No such file" in failed("shebang_crlf", tmp_path / "a").rationale
    assert "'python': No such file" in failed("shebang_python2", tmp_path / "b").rationale
    assert "the shell tries" in failed("shebang_second_line", tmp_path / "c").rationale
