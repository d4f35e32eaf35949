"""The live line on real pseudo-terminals, and its replacement elsewhere."""

from __future__ import annotations

import io
import os
import re
import signal
import sys
from pathlib import Path

import pexpect
import pytest

from grader.report.events import Event, Note, StageStarted, to_all
from grader.report.terminal import LiveProgress
from tests import processes
from tests.report.pseudo_terminal import ROOT, SECONDS, STYLES, environment, on_a_terminal, piped

CURSOR_HIDDEN, CURSOR_SHOWN = "\x1b[?25l", "\x1b[?25h"
STAGES = "building with colcon ...\nrunning the node ...\n"
NOTE = "a second attempt, the machine is busy [red]\\x1b]0;title\\x07\n"
EVENTS = 8  # of tests.report.emit_events


def test_the_live_line_shows_stage_tick_check_and_time_and_disappears() -> None:
    terminal = on_a_terminal("emit_events", columns=120)
    terminal.expect("Starting")
    terminal.sendline()
    terminal.expect("building with colcon.*?  [0-9] s")
    terminal.expect("building with colcon.*?  [1-9] s")  # the time advances while nothing happens
    for _ in range(4):
        terminal.sendline()
    terminal.expect("running the node.*?  Hello time: 0.*?The node counts: Hello time: 0, 1")
    for _ in range(EVENTS - 4):
        terminal.sendline()
    terminal.expect("the end")
    last = str(terminal.before)
    assert last.endswith("\x1b[2K")  # the line is erased before the next output
    terminal.expect(pexpect.EOF)


def test_notes_stay_above_the_live_line() -> None:
    terminal = on_a_terminal("emit_events", columns=120)
    for _ in range(EVENTS + 1):
        terminal.sendline()
    terminal.expect(r"a second attempt, the machine is busy \[red\][^\r]*\r\n")
    terminal.expect("the end")


def test_a_students_log_text_cannot_control_the_live_line() -> None:
    terminal = on_a_terminal("emit_events", columns=120)
    for _ in range(EVENTS + 1):
        terminal.sendline()
    terminal.expect(pexpect.EOF)
    output = str(terminal.before)
    ours = {"\x1b[2K", "\x1b[1A", CURSOR_HIDDEN, CURSOR_SHOWN}
    found = set(re.findall(r"\x1b\[[0-9;?]*[A-Za-z]|\x1b.", STYLES.sub("", output)))
    assert found <= ours
    assert not set(output) & {"\x9b", "\u202e", "\x07"}


def test_the_live_line_never_takes_two_lines_of_a_narrow_terminal() -> None:
    terminal = on_a_terminal("emit_events", columns=40)
    for _ in range(EVENTS + 1):
        terminal.sendline()
    terminal.expect(pexpect.EOF)
    frames = re.split(r"\x1b\[2K|\r\n", STYLES.sub("", str(terminal.before)))
    drawn = [frame.strip("\r") for frame in frames if frame[:1] in tuple("|/-\\")]
    assert drawn
    assert max(len(frame) for frame in drawn) < 40


def test_hidden_checks_are_not_named_while_they_run() -> None:
    terminal = on_a_terminal("emit_events", "hidden", columns=120)
    for _ in range(4):
        terminal.sendline()
    terminal.expect("a hidden check")
    for _ in range(EVENTS - 3):
        terminal.sendline()
    terminal.expect(pexpect.EOF)
    assert "The node counts" not in str(terminal.before)


def test_with_no_color_the_live_line_has_no_colours() -> None:
    terminal = on_a_terminal("emit_events", NO_COLOR="1")
    terminal.expect("Starting.*?\x1b\\[2K.*?Starting")
    assert not re.search(r"\x1b\[[0-9;]*m", str(terminal.after))
    terminal.close(force=True)


@pytest.mark.parametrize("how", ["raises", "is interrupted", "is killed"])
def test_the_cursor_is_visible_however_it_ends(how: str) -> None:
    terminal = on_a_terminal("emit_events", *(["fail"] if how == "raises" else []))
    output = ""
    terminal.expect("Starting")
    output += str(terminal.before) + str(terminal.after)
    if how == "raises":
        for _ in range(4):
            terminal.sendline()
    elif how == "is interrupted":
        processes.wait_until_asleep(terminal.pid)
        terminal.sendintr()
    else:
        terminal.kill(signal.SIGKILL)
    terminal.expect(pexpect.EOF)
    output += str(terminal.before)
    assert output.rfind(CURSOR_SHOWN) > output.rfind(CURSOR_HIDDEN)


def test_a_pipe_gets_one_plain_line_for_each_stage_and_note() -> None:
    done = piped("emit_events", lines=EVENTS + 1)
    assert done.stderr == STAGES + NOTE
    assert done.stdout == "the end\n"


def test_a_dumb_terminal_gets_plain_lines() -> None:
    terminal = on_a_terminal("emit_events", TERM="dumb")
    for _ in range(EVENTS + 1):
        terminal.sendline()
    terminal.expect(pexpect.EOF)
    assert str(terminal.before).replace("\r\n", "\n") == f"{STAGES}{NOTE}the end\n"


def test_stdout_in_a_file_has_nothing_of_the_live_line(tmp_path: Path) -> None:
    command = f"{sys.executable} -m tests.report.emit_events print > {tmp_path}/out; echo written"
    terminal = pexpect.spawn(
        "/bin/sh",
        ["-c", command],
        cwd=ROOT,
        env=environment(),
        encoding="utf-8",
        echo=False,
        timeout=SECONDS,
    )
    for _ in range(EVENTS + 1):
        terminal.sendline()
    terminal.expect("running the node")
    terminal.expect("written")
    assert (tmp_path / "out").read_text() == "in between\nthe end\n"


def test_a_closed_stream_does_not_interrupt_the_work() -> None:
    reader, writer = os.pipe()
    os.close(reader)
    with os.fdopen(writer, "w") as gone, LiveProgress(gone) as progress:
        for _ in range(3):
            progress(StageStarted("build", "building"))
        os.dup2(os.open(os.devnull, os.O_WRONLY), writer)  # takes what is still in the buffer
    closed = io.StringIO()
    closed.close()
    with LiveProgress(closed) as progress:
        progress(StageStarted("build", "building"))


def test_all_listeners_get_each_event_in_order() -> None:
    heard: list[tuple[str, Event]] = []
    tell = to_all([lambda event: heard.append(("a", event)), lambda e: heard.append(("b", e))])
    first, second = Note("one"), Note("two")
    tell(first)
    tell(second)
    assert heard == [("a", first), ("b", first), ("a", second), ("b", second)]
