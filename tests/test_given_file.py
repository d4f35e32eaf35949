"""A misspelt path of an option is answered with the path that is meant."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from grader.cli.grade_all import grade_all


@pytest.mark.parametrize("option", ["--worksheet", "--canvas", "--roster"])
def test_a_misspelt_file_of_grade_all_is_suggested(option: str, tmp_path: Path) -> None:
    (tmp_path / "sheet.csv").write_text("name\n", encoding="utf-8")
    given = tmp_path / "shet.csv"
    done = CliRunner().invoke(grade_all, [str(tmp_path), option, str(given), "-n"])
    assert done.exit_code == 2
    assert f"does not exist (did you mean '{tmp_path / 'sheet.csv'}'?)." in done.output


def test_nothing_is_suggested_if_no_name_is_near(tmp_path: Path) -> None:
    done = CliRunner().invoke(grade_all, [str(tmp_path), "--roster", str(tmp_path / "x"), "-n"])
    assert done.exit_code == 2
    assert "did you mean" not in done.output
