"""What a person can still read on the terminal after a node's output."""

from __future__ import annotations

import pytest

from grader.run.screen import stays

LOG = b"[INFO] [1795226661.262229158] [my_first_node]: Hello time: 0\r\n"


@pytest.mark.parametrize(
    "output",
    [
        LOG,
        b"\x1b[32m" + LOG.strip() + b"\x1b[0m\r\n",
        b"\x1b[38;5;8m" + LOG,
        b"\x1b[38;2;8;8;8m" + LOG,
        b"caf\xc3\xa9 \xed\x95\x9c\xea\xb8\x80\r\n" + LOG,
        b"two ends\r\r\n" + LOG,
    ],
    ids=["log", "colour", "bright", "true colour", "other letters", "two returns"],
)
def test_output_that_only_adds_lines_needs_no_screen(output: bytes) -> None:
    assert stays(output) is None


@pytest.mark.parametrize(
    "output",
    [
        LOG + b"\x1b[1A\x1b[2K",
        LOG.strip() + b"\r" + b" " * 100 + b"\r\n",
        LOG.strip() + b"\x08" * 1 + b"9\r\n",
        LOG + b"\x1b[2J",
        LOG + b"\x1bc",
        b"\x1b[8m" + LOG,
        b"\x1b[1;8m" + LOG,
        b"\x1b[?1049h" + LOG + b"\x1b[2J\x1b[?1049l",
    ],
    ids=["erased", "overwritten", "changed", "cleared", "reset", "hidden", "hidden bold", "other"],
)
def test_a_line_that_is_erased_or_hidden_does_not_stay(output: bytes) -> None:
    can_be_read = stays(output)
    assert can_be_read is not None
    assert not can_be_read("Hello time: 0")


def test_a_progress_bar_beside_the_lines_does_not_hide_them() -> None:
    bar = b"".join(b"\r%3d %%" % n for n in range(100)) + b"\r\n"
    can_be_read = stays(LOG + bar + LOG.replace(b"0\r", b"1\r") + bar)
    assert can_be_read is not None
    assert can_be_read("Hello time: 0")
    assert can_be_read("Hello time: 1")
    assert not can_be_read("Hello time: 2")


def test_lines_that_have_scrolled_away_can_be_read() -> None:
    lines = b"".join(LOG.replace(b"0\r", b"%d\r" % n) for n in range(200))
    can_be_read = stays(lines + b"\rdone\r\n")
    assert can_be_read is not None
    assert all(can_be_read(f"Hello time: {n}") for n in range(200))


def test_a_line_longer_than_the_screen_can_be_read() -> None:
    text = "x" * 300 + " end"
    can_be_read = stays(b"\rbegin\r\n" + text.encode() + b"\r\n")
    assert can_be_read is not None
    assert can_be_read(text)
