"""`grader explain`: an entry by its id, or the mistakes in a terminal's output."""

from __future__ import annotations

import subprocess

from grader.mistakes.catalogue import CATALOGUE
from tests import processes


def explain(*words: str, text: str = "", lang: str = "C") -> subprocess.CompletedProcess[str]:
    env = {"LC_ALL": "", "LANGUAGE": "", "LC_MESSAGES": "", "LANG": lang, "COLUMNS": "100"}
    return processes.run(processes.grader("explain", *words), env=env, stdin=text)


def test_an_entry_has_the_reason_the_fix_and_a_link() -> None:
    done = explain("setup.missing_comma")
    assert done.returncode == 0
    for output in (
        "the comma between them is missing",
        "Python joins two adjacent strings",
        "Add a comma after",
        "https://",
    ):
        assert output in done.stdout


def test_the_language_comes_from_the_environment_or_the_option() -> None:
    assert "쉼표" in explain("setup.missing_comma", lang="ko_KR.UTF-8").stdout
    assert "쉼표" in explain("setup.missing_comma", "--lang", "ko").stdout
    assert "comma" in explain("setup.missing_comma", "--lang", "en", lang="ko_KR.UTF-8").stdout


def test_an_unknown_id_is_a_usage_error_with_a_suggestion() -> None:
    done = explain("setup.mising_comma")
    assert done.returncode == 2
    assert "did you mean 'setup.missing_comma'" in done.stderr
    assert "Traceback" not in done.stderr


def test_terminal_output_is_explained_root_cause_first() -> None:
    text = "RuntimeError: 'distutils.core.setup()' was never called\nNo executable found\n"
    done = explain("-", text=text)
    assert done.returncode == 0
    assert done.stdout.index("build.entry_unreadable") < done.stdout.index("lab.no_executable")
    assert "No executable found" in done.stdout


def test_a_text_without_a_known_mistake_is_reported_as_such() -> None:
    done = explain("-", text="Hello time: 0\n")
    assert done.returncode == 1
    assert "no mistake" in done.stdout


def test_control_characters_of_the_text_do_not_reach_the_terminal() -> None:
    done = explain("-", text="\x1b[31mPermission\x1b[2J ./a.py: Permission denied\x07\n")
    assert "\x1b" not in done.stdout
    assert "\x07" not in done.stdout


def test_all_entries_are_listed() -> None:
    listed = explain().stdout
    assert [kind for kind in CATALOGUE if f"{kind}: " not in listed] == []
