"""Help and usage errors of the students' commands in the reader's language."""

from __future__ import annotations

import gettext
import inspect
import os
import re
import sys

import click
import pytest
from rich.cells import cell_len

from grader.base.i18n.translator import LANGUAGES, translated
from grader.cli.localized import language_of, translated_help
from grader.cli.main import COMMANDS, commands, main
from tests import processes

KOREAN = {"LANG": "ko_KR.UTF-8", "LC_ALL": "", "LANGUAGE": "", "GRADER_LANG": ""}
ENGLISH = {**KOREAN, "LANG": "C.UTF-8"}
HANGUL = re.compile("[가-힣]")
PROSE = re.compile(r"(?:\b[a-z]{2,}\b +){3}[a-z]{2,}\b")
HELPS = [
    ("grader", "check"),
    ("grader", "fix"),
    ("grader", "explain"),
    ("lab",),
    ("lab.guide",),
]


def run(*words: str, env: dict[str, str]) -> tuple[int, str]:
    done = processes.run([sys.executable, "-m", *words], env=env)
    return done.returncode, done.stdout + done.stderr


@pytest.mark.parametrize("words", HELPS, ids=" ".join)
def test_the_help_of_a_students_command_is_in_their_language(words: tuple[str, ...]) -> None:
    status, english = run(*words, "--help", env=ENGLISH)
    assert status == 0
    assert not HANGUL.search(english)
    status, korean = run(*words, "--help", env=KOREAN)
    assert status == 0
    assert not PROSE.search(korean), korean
    options = re.compile(r"^ +(-\S.*?)(?:  |$)", re.MULTILINE)
    assert options.findall(korean) == options.findall(english)
    assert run(*words, "--lang", "ko", "--help", env=ENGLISH) == (0, korean)
    assert run(*words, "--lang=en", "--help", env=KOREAN) == (0, english)


@pytest.mark.parametrize("width", [60, 80])
@pytest.mark.parametrize("words", HELPS, ids=" ".join)
def test_korean_lines_end_between_words(words: tuple[str, ...], width: int) -> None:
    """A character of Korean takes two columns; click counts one."""
    status, korean = run(*words, "--help", env={**KOREAN, "COLUMNS": str(width)})
    assert status == 0
    lines = [line for line in korean.splitlines() if HANGUL.search(line)]
    assert lines
    assert max(map(cell_len, lines)) <= width
    assert max(map(cell_len, lines)) > 0.8 * width - 10  # the width is used
    assert "\0" not in korean


@pytest.mark.parametrize(
    ("words", "wrong"),
    [
        (("check", "--bogus"), "--bogus"),
        (("check", "a", "b"), "(b)"),
        (("fix", "--lang", "fr"), "'fr'"),
        (("fix", "--distro"), "--distro"),
        (("chek",), "chek"),
    ],
    ids=lambda value: value if isinstance(value, str) else " ".join(value),
)
def test_usage_errors_are_reported_in_the_readers_language(
    words: tuple[str, ...], wrong: str
) -> None:
    status, text = run("grader", *words, env=KOREAN)
    assert status == 2
    last = text.splitlines()[-1]
    assert wrong in last
    assert last.startswith("오류: ")
    assert not PROSE.search(text), text


@pytest.mark.parametrize(
    ("words", "wanted"),
    [
        (("check", "--lang", "ko"), "ko"),
        (("check", "--lang=ko", "x"), "ko"),
        (("check", "--lang", "fr"), "en"),
        (("check", "--lang"), "en"),
        (("lab", "--", "--lang", "ko"), "en"),  # `check` is a command of its own in the lab
        ((), "en"),
    ],
)
def test_the_language_is_read_from_the_command_line(
    words: tuple[str, ...], wanted: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name, value in ENGLISH.items():
        monkeypatch.setenv(name, value)
    assert language_of(words) == wanted


def test_the_language_lasts_as_long_as_the_block() -> None:
    def state() -> tuple[str, str | None, str, str | None]:
        help_text = commands.commands["check"].help
        usage = click.Context(commands).get_usage()
        return gettext.textdomain(), os.environ.get("LANGUAGE"), usage, help_text

    before = state()
    with pytest.raises(KeyError), translated_help("ko", commands):
        assert all(now != then for now, then in zip(state(), before))
        raise KeyError
    assert state() == before


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("name", COMMANDS)
def test_the_list_of_commands_has_the_first_line_of_each_commands_own_help(
    name: str, lang: str
) -> None:
    command = COMMANDS[name].load()
    assert command.name == name
    assert command.help is not None
    own = translated(inspect.cleandoc(command.help), lang)
    assert translated(COMMANDS[name].help, lang) == own.partition("\n\n")[0]


def test_the_help_of_a_command_is_english_again_after_a_run(
    capsys: pytest.CaptureFixture[str],
) -> None:
    command = COMMANDS["check"].load()
    before = command.help
    assert main(["check", "--lang", "ko", "--help"]) == 0
    assert HANGUL.search(capsys.readouterr().out)
    assert command.help == before


def test_a_command_imported_for_korean_help_keeps_its_metavars() -> None:
    """click translates the name of a path's type once, when the option is made."""
    command = processes.grader("grade", "--lang", "ko", "--help")
    done = processes.run(command, env=ENGLISH, forked=False)
    assert done.returncode == 0
    assert HANGUL.search(done.stdout)
    assert "--out DIRECTORY" in done.stdout
