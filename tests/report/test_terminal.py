"""On real pseudo-terminals and in pipes: what is live, what is coloured, what is plain."""

from __future__ import annotations

import io
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pexpect
import pytest
from rich.cells import cell_len

from grader.events import Event
from grader.events import Note
from grader.events import StageStarted
from grader.events import to_all
from grader.report.terminal import LiveProgress
from grader.report.terminal import print_report
from grader.report.terminal import render_report
from tests.report.samples import failing_report

ROOT = Path(__file__).resolve().parents[2]
STYLES = re.compile(r"\x1b\[[0-9;]*m")
CURSOR_HIDDEN, CURSOR_SHOWN = "\x1b[?25l", "\x1b[?25h"
STAGES = "building with colcon ...\nrunning the node ...\n"
EVENTS = 8  # of tests.report.working
SECONDS = 30  # for a program to answer; it takes less than one


def environment(**more: str) -> dict[str, str]:
    kept = {"PATH": os.environ["PATH"], "HOME": os.environ.get("HOME", "/"), "LANG": "C.UTF-8"}
    return {**kept, "PYTHONPATH": str(ROOT), "TERM": "xterm-256color", **more}


def on_a_terminal(module: str, *words: str, columns: int = 80, **env: str) -> pexpect.spawn:
    return pexpect.spawn(
        sys.executable,
        ["-m", f"tests.report.{module}", *words],
        cwd=ROOT,
        env=environment(**env),
        dimensions=(24, columns),
        encoding="utf-8",
        echo=False,
        timeout=SECONDS,
    )


def shown(columns: int = 80, **env: str) -> str:
    """All that `showing` writes on a terminal."""
    terminal = on_a_terminal("showing", columns=columns, **env)
    terminal.expect(pexpect.EOF)
    terminal.close()
    assert terminal.exitstatus == 0
    return str(terminal.before).replace("\r\n", "\n")


def piped(module: str, *, lines: int = 0, **env: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", f"tests.report.{module}"],
        cwd=ROOT,
        env=environment(**env),
        input="\n" * lines,
        capture_output=True,
        encoding="utf-8",
        timeout=SECONDS,
        check=True,
    )


def test_on_a_terminal_there_are_colours_and_the_same_words() -> None:
    page = shown()
    assert "\x1b[1;31mFAIL" in page
    assert "\x1b[32mpass" in page
    assert "\x1b" not in STYLES.sub("", page)
    plain = [line.rstrip() for line in STYLES.sub("", page).splitlines()]
    assert plain == piped("showing").stdout.splitlines()


def test_in_a_pipe_there_are_none() -> None:
    output = piped("showing")
    assert output.stdout.isascii()
    assert "\x1b" not in output.stdout
    assert output.stderr == ""


@pytest.mark.parametrize(
    "env", [{"NO_COLOR": "1"}, {"TERM": "dumb"}, {"TERM": "unknown"}, {"TERM": ""}]
)
def test_who_wants_no_colours_gets_none_on_a_terminal_either(env: dict[str, str]) -> None:
    page = shown(**env)
    assert "\x1b" not in page
    assert "FAIL" in page


def test_an_empty_no_color_says_nothing() -> None:
    assert "\x1b[" in shown(NO_COLOR="")


@pytest.mark.parametrize("columns", [40, 80, 200])
def test_the_page_is_as_wide_as_the_terminal(columns: int) -> None:
    page = STYLES.sub("", shown(columns))
    widths = [cell_len(line.rstrip()) for line in page.splitlines()]
    prose = [width for width, line in zip(widths, page.splitlines()) if "  " not in line.strip()]
    assert max(prose) <= columns
    longest = max(widths)
    assert longest > 60 or columns == 40
    assert longest <= 100


def test_columns_tells_the_width_of_a_pipe() -> None:
    narrow = piped("showing", COLUMNS="40").stdout
    assert STYLES.sub("", shown(40)).split() == narrow.split()
    assert piped("showing", COLUMNS="wide").stdout == piped("showing").stdout


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "utf-8"])
def test_every_encoding_takes_every_report(encoding: str) -> None:
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


def test_the_live_line_shows_stage_tick_check_and_time_and_goes_away() -> None:
    terminal = on_a_terminal("working", columns=120)
    terminal.expect("Starting")
    terminal.sendline()
    terminal.expect("building with colcon.*?  [0-9] s")
    terminal.expect("building with colcon.*?  [1-9] s")  # time goes on while nothing happens
    for _ in range(4):
        terminal.sendline()
    terminal.expect("running the node.*?  Hello time: 0.*?The node counts: Hello time: 0, 1")
    for _ in range(EVENTS - 4):
        terminal.sendline()
    terminal.expect("the end")
    last = str(terminal.before)
    assert last.endswith("\x1b[2K")  # the line was erased before the next output
    terminal.expect(pexpect.EOF)


def test_notes_stay_above_the_live_line() -> None:
    terminal = on_a_terminal("working", columns=120)
    for _ in range(EVENTS + 1):
        terminal.sendline()
    terminal.expect("a second attempt, the machine is busy[^\r]*\r\n")
    terminal.expect("the end")


def test_what_a_student_logs_cannot_steer_the_live_line() -> None:
    terminal = on_a_terminal("working", columns=120)
    for _ in range(EVENTS + 1):
        terminal.sendline()
    terminal.expect(pexpect.EOF)
    output = str(terminal.before)
    ours = {"\x1b[2K", "\x1b[1A", CURSOR_HIDDEN, CURSOR_SHOWN}
    found = set(re.findall(r"\x1b\[[0-9;?]*[A-Za-z]|\x1b.", STYLES.sub("", output)))
    assert found <= ours
    assert not set(output) & {"\x9b", "\u202e", "\x07"}


def test_the_live_line_never_takes_two_lines_of_a_narrow_terminal() -> None:
    terminal = on_a_terminal("working", columns=40)
    for _ in range(EVENTS + 1):
        terminal.sendline()
    terminal.expect(pexpect.EOF)
    frames = re.split(r"\x1b\[2K|\r\n", STYLES.sub("", str(terminal.before)))
    drawn = [frame.strip("\r") for frame in frames if frame[:1] in tuple("|/-\\")]
    assert drawn
    assert max(len(frame) for frame in drawn) < 40


def test_hidden_checks_have_no_name_while_they_are_asked() -> None:
    terminal = on_a_terminal("working", "hidden", columns=120)
    for _ in range(4):
        terminal.sendline()
    terminal.expect("a hidden check")
    for _ in range(EVENTS - 3):
        terminal.sendline()
    terminal.expect(pexpect.EOF)
    assert "The node counts" not in str(terminal.before)


def test_with_no_color_the_live_line_moves_without_colours() -> None:
    terminal = on_a_terminal("working", NO_COLOR="1")
    terminal.expect("Starting.*?\x1b\\[2K.*?Starting")
    assert not re.search(r"\x1b\[[0-9;]*m", str(terminal.after))
    terminal.close(force=True)


@pytest.mark.parametrize("how", ["raises", "is interrupted", "is killed"])
def test_however_it_ends_the_cursor_is_there(how: str) -> None:
    terminal = on_a_terminal("working", *(["fail"] if how == "raises" else []))
    output = ""
    terminal.expect("Starting")
    output += str(terminal.before) + str(terminal.after)
    if how == "raises":
        for _ in range(4):
            terminal.sendline()
    elif how == "is interrupted":
        terminal.sendintr()
    else:
        terminal.kill(signal.SIGKILL)
    terminal.expect(pexpect.EOF)
    output += str(terminal.before)
    assert output.rfind(CURSOR_SHOWN) > output.rfind(CURSOR_HIDDEN)


def test_in_a_pipe_each_stage_is_one_plain_line_and_there_is_nothing_else() -> None:
    done = piped("working", lines=EVENTS + 1)
    assert done.stderr == STAGES
    assert done.stdout == "the end\n"


def test_on_a_dumb_terminal_too() -> None:
    terminal = on_a_terminal("working", TERM="dumb")
    for _ in range(EVENTS + 1):
        terminal.sendline()
    terminal.expect(pexpect.EOF)
    assert str(terminal.before).replace("\r\n", "\n") == f"{STAGES}the end\n"


def test_standard_output_in_a_pipe_stays_clean_while_the_line_lives() -> None:
    terminal = pexpect.spawn(
        "/bin/sh",
        ["-c", f"{sys.executable} -m tests.report.working | cat -v > \"$TARGET\"; echo written"],
        cwd=ROOT,
        env=environment(TARGET="/dev/stdout"),
        encoding="utf-8",
        echo=False,
        timeout=SECONDS,
    )
    for _ in range(EVENTS + 1):
        terminal.sendline()
    terminal.expect(r"the end\r\n")  # cat -v would show a control sequence as ^[
    terminal.expect("written")
    assert "^[" not in str(terminal.before)


def test_a_stream_that_has_gone_away_does_not_disturb_the_work() -> None:
    reader, writer = os.pipe()
    os.close(reader)
    with open(writer, "w") as gone, LiveProgress(gone) as progress:
        for _ in range(3):
            progress(StageStarted("build", "building"))
        os.dup2(os.open(os.devnull, os.O_WRONLY), writer)  # what is still in the buffer
    closed = io.StringIO()
    closed.close()
    with LiveProgress(closed) as progress:
        progress(StageStarted("build", "building"))


def test_all_listeners_hear_each_event_in_order() -> None:
    heard: list[tuple[str, Event]] = []
    tell = to_all([lambda event: heard.append(("a", event)), lambda e: heard.append(("b", e))])
    first, second = Note("one"), Note("two")
    tell(first)
    tell(second)
    assert heard == [("a", first), ("b", first), ("a", second), ("b", second)]


def test_the_events_and_the_renderer_import_neither_pydantic_nor_rich() -> None:
    code = (
        "import sys, grader.events, grader.report.terminal; "
        "print(sorted({name.partition('.')[0] for name in sys.modules} & {'pydantic', 'rich'}))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout == "[]\n"


def test_printing_imports_only_the_parts_of_rich_that_it_needs() -> None:
    code = (
        "import sys; from tests.report.samples import failing_report\n"
        "from grader.report.terminal import print_report\n"
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
