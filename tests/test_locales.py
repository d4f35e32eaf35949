"""Every locale, and a terminal without UTF-8: what is printed can be read."""

from __future__ import annotations

import io
import os
import subprocess
import sys
from pathlib import Path

import pexpect
import pytest

from grader.base.gate import is_utf8, readable
from tests import processes
from tests.test_cli import solution

CLEAN = {
    name: value
    for name, value in os.environ.items()
    if not name.startswith(("LC_", "LANG", "PYTHONUTF8", "PYTHONIOENCODING", "GRADER_LANG"))
}
LOCALES: dict[str, dict[str, str]] = {
    "none": {},
    "C": {"LANG": "C"},
    "POSIX": {"LC_ALL": "POSIX"},
    "not installed": {"LC_ALL": "de_DE.ISO-8859-1", "LANG": "de_DE.ISO-8859-1"},
    "ASCII only": {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
    "Latin-1 output": {"LANG": "C.UTF-8", "PYTHONIOENCODING": "latin-1"},
    "Korean": {"LANG": "ko_KR.UTF-8"},
    "Korean without Hangul": {"LANG": "ko_KR.UTF-8", "PYTHONIOENCODING": "ascii"},
}
UNLIKE = ("C", "ASCII only", "Latin-1 output", "Korean without Hangul")
"""Those in which Python prints differently."""
ENTRY = ("-m", "grader", "explain", "node.f_prefix")  # it has an ellipsis


def run(*words: str | Path, **env: str) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        [sys.executable, *words],
        cwd=processes.ROOT,
        env={**CLEAN, **env},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        check=False,
    )


@pytest.mark.prefix
@pytest.mark.parametrize(
    "locale",
    [
        pytest.param(name, marks=pytest.mark.full if name == "ASCII only" else pytest.mark.long)
        for name in LOCALES
    ],
)
def test_a_correct_package_gets_full_marks_in_every_locale(locale: str, tmp_path: Path) -> None:
    package = solution(tmp_path / "숙제 für Zoë")
    done = run("-m", "grader", "grade", package, "--out", tmp_path / "out", **LOCALES[locale])
    assert done.returncode == 0, done.stderr.decode(errors="replace")
    assert b"Traceback" not in done.stderr
    assert b"100 / 100" in done.stdout
    assert b"\\u" not in done.stdout.replace(b"\\uc219\\uc81c", b""), "only the folder's name"


@pytest.mark.parametrize(
    "locale",
    [pytest.param(name, marks=() if name in UNLIKE else pytest.mark.full) for name in LOCALES],
)
@pytest.mark.parametrize(
    "words",
    [
        ENTRY,
        pytest.param(("-m", "lab.guide", "all"), marks=pytest.mark.full),
        pytest.param(("-m", "grader", "check", "--help"), marks=pytest.mark.full),
    ],
    ids=" ".join,
)
def test_texts_are_readable_in_every_locale(locale: str, words: tuple[str, ...]) -> None:
    done = run(*words, **LOCALES[locale])
    assert done.returncode == 0, done.stderr
    assert b"Traceback" not in done.stderr
    assert b"\\u" not in done.stdout


def test_korean_that_the_output_cannot_show_becomes_english() -> None:
    korean, ascii_only = (run(*ENTRY, **LOCALES[n]) for n in ("Korean", "Korean without Hangul"))
    assert "중괄호" in korean.stdout.decode() or "f" in korean.stdout.decode()
    assert not korean.stdout.isascii()
    assert ascii_only.stdout.isascii()
    assert b"Python replaces {...} with a value" in b" ".join(ascii_only.stdout.split())
    asked = run(*ENTRY, "--lang", "ko", **LOCALES["Korean without Hangul"])
    assert b"\\u" in asked.stdout, "who asks for Korean gets Korean"


@pytest.mark.parametrize("words", [ENTRY, ("-m", "lab.guide", "all")], ids=" ".join)
def test_a_terminal_without_utf8_gets_punctuation_in_ascii(words: tuple[str, ...]) -> None:
    """Python itself writes UTF-8 in the locale C."""
    terminal = pexpect.spawn(
        sys.executable,
        list(words),
        cwd=str(processes.ROOT),
        env={**CLEAN, "LANG": "C", "TERM": "xterm"},
        timeout=60,
    )
    terminal.expect(pexpect.EOF)
    assert isinstance(terminal.before, bytes)
    assert len(terminal.before) > 100
    assert terminal.before.isascii()


def test_what_an_encoding_lacks_is_simplified_before_it_is_escaped() -> None:
    file = io.TextIOWrapper(io.BytesIO(), encoding="latin-1")
    assert readable("a … b → “c” – Zoë", file) == 'a ... b -> "c" - Zoë'
    assert readable("한", file) == "\\ud55c"


def test_the_encoding_of_a_locale() -> None:
    assert is_utf8({"LANG": "C.UTF-8"})
    assert is_utf8({"LANG": "C", "LC_ALL": "ko_KR.utf8"})
    assert not is_utf8({"LANG": "C"})
    assert not is_utf8({})
    assert not is_utf8({"LANG": "C", "LC_CTYPE": "C.UTF-8"}), "which Python sets"
    assert not is_utf8({"LANG": "en_US.UTF-8", "LC_CTYPE": "POSIX"})
