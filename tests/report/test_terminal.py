"""The page on real pseudo-terminals and in pipes: colours and width."""

from __future__ import annotations

import io
import subprocess
import sys
import time

import pexpect
import pytest
from rich.cells import cell_len

from tests.report.pseudo_terminal import ROOT, STYLES, on_a_terminal, piped
from tests.report.samples import COMMAND, failing_report, print_report, render_report


def shown(columns: int = 80, env: dict[str, str] | None = None) -> str:
    """Return all that `print_pages` writes on a terminal."""
    terminal = on_a_terminal("print_pages", columns=columns, **(env or {}))
    terminal.expect(pexpect.EOF)
    terminal.close()
    assert terminal.exitstatus == 0
    return str(terminal.before).replace("\r\n", "\n")


def test_a_terminal_gets_colours_and_the_same_words() -> None:
    page = shown()
    assert "\x1b[1;31mFAIL" in page
    assert "\x1b[32mpass" in page
    assert "\x1b" not in STYLES.sub("", page)
    plain = [line.rstrip() for line in STYLES.sub("", page).splitlines()]
    assert plain == piped("print_pages").stdout.splitlines()


def test_a_pipe_gets_no_colours() -> None:
    output = piped("print_pages")
    assert output.stdout.isascii()
    assert "\x1b" not in output.stdout
    assert output.stderr == ""


@pytest.mark.parametrize(
    "env", [{"NO_COLOR": "1"}, {"TERM": "dumb"}, {"TERM": "unknown"}, {"TERM": ""}]
)
def test_colours_can_be_turned_off_on_a_terminal(env: dict[str, str]) -> None:
    page = shown(env=env)
    assert "\x1b" not in page
    assert "FAIL" in page


def test_an_empty_no_color_is_ignored() -> None:
    assert "\x1b[" in shown(env={"NO_COLOR": ""})


@pytest.mark.parametrize("columns", [40, 80, 200])
def test_the_page_is_as_wide_as_the_terminal(columns: int) -> None:
    page = STYLES.sub("", shown(columns))
    to_copy = (COMMAND, "report.json", "/src/my_robot_controller", ":main',")
    widths = [
        cell_len(line.rstrip()) for line in page.splitlines() if not line.rstrip().endswith(to_copy)
    ]
    assert columns * 0.8 < max(widths) <= columns or 80 < max(widths) <= 100 < columns


def test_columns_sets_the_width_in_a_pipe() -> None:
    narrow = piped("print_pages", COLUMNS="40").stdout
    assert STYLES.sub("", shown(40)).split() == narrow.split()
    assert piped("print_pages", COLUMNS="wide").stdout == piped("print_pages").stdout


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "utf-8"])
def test_every_report_can_be_printed_in_every_encoding(encoding: str) -> None:
    raw = io.BytesIO()
    file = io.TextIOWrapper(raw, encoding=encoding)
    clean = failing_report()
    submission = clean.submission.model_copy(update={"name": "Zoë 你好 🤖"})
    print_report(clean.model_copy(update={"submission": submission}), file=file)
    text = raw.getvalue().decode(encoding)
    assert "student" in text
    assert {
        "ascii": r"Zo\xeb \u4f60\u597d \U0001f916",
        "latin-1": r"Zoë \u4f60\u597d \U0001f916",
        "utf-8": "Zoë 你好 🤖",
    }[encoding] in text


def test_the_events_and_the_renderer_import_neither_pydantic_nor_rich() -> None:
    code = (
        "import sys, grader.report.events, grader.report.terminal; "
        "print(sorted({name.partition('.')[0] for name in sys.modules} & {'pydantic', 'rich'}))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout == "[]\n"


def test_printing_imports_only_the_parts_of_rich_that_it_needs() -> None:
    code = (
        "import sys; from tests.report.samples import failing_report, print_report\n"
        "print_report(failing_report(), file=sys.stderr)\n"
        "heavy = {'live', 'progress', 'markdown', 'syntax', 'traceback', 'logging', 'pretty'}\n"
        "print(sorted(name for name in heavy if f'rich.{name}' in sys.modules), "
        "'pygments' in sys.modules, 'asyncio' in sys.modules)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout == "[] False False\n"


def test_a_page_takes_little_processor_time() -> None:
    marked = failing_report()
    render_report(marked)
    begin = time.process_time()
    for _ in range(10):
        render_report(marked)
    assert time.process_time() - begin < 1
