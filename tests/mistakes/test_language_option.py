"""`--lang` and the environment choose the language of `grader grade` and `check`."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from tests import processes

KOREAN = {"LANG": "ko_KR.UTF-8", "LC_ALL": "", "LANGUAGE": "", "LC_MESSAGES": ""}
ENGLISH = {**KOREAN, "LANG": "C.UTF-8"}


@pytest.mark.parametrize(
    ("words", "environment", "lang"),
    [
        ([], KOREAN, "ko"),
        ([], ENGLISH, "en"),
        (["--lang", "ko"], ENGLISH, "ko"),
        (["--lang", "en"], KOREAN, "en"),
    ],
)
def test_a_report_says_in_which_language_it_is(
    words: list[str], environment: dict[str, str], lang: str, tmp_path: Path
) -> None:
    (tmp_path / "anna").mkdir()
    (tmp_path / "anna" / "my_first_node.py").write_text("print('Hello time: 0')\n")
    done = processes.run(
        processes.grader("grade", tmp_path / "anna", "--out", tmp_path / "out", *words),
        env=environment,
    )
    assert done.returncode == 1, done.stderr
    report = json.loads((tmp_path / "out/anna/jazzy/report.json").read_text(encoding="utf-8"))
    assert report["lang"] == lang
    found = next(check for check in report["checks"] if check["id"] == "package.found")
    assert [mistake["id"] for mistake in found["mistakes"]] == ["package.only_node"]
    for text in (found["title"], found["actual"], found["fix"], done.stdout, done.stderr):
        assert bool(re.search("[가-힣]", text)) == (lang == "ko"), text


def test_usage_errors_are_in_the_readers_language(tmp_path: Path) -> None:
    done = processes.run(processes.grader("check", tmp_path / "nowhere"), env=KOREAN)
    assert done.returncode == 2
    assert "폴더가 없습니다" in done.stderr
    assert "nowhere" in done.stderr
    done = processes.run(
        processes.grader("check", ".", "--distro", "jazy", "--lang", "ko"), env=ENGLISH
    )
    assert done.returncode == 2
    assert "'jazzy'" in done.stderr
    assert "쓰려고" in done.stderr


def test_an_unsupported_language_is_a_usage_error(tmp_path: Path) -> None:
    done = processes.run(processes.grader("check", tmp_path, "--lang", "tlh"), env=ENGLISH)
    assert done.returncode == 2
    assert "tlh" in done.stderr
