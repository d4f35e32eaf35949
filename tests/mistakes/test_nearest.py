"""Suggestions of the nearest name, and marks where two texts differ."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grader.base.i18n.translator import Translator
from grader.base.nearest import (
    compared,
    did_you_mean,
    marks,
    meant,
    meant_or_known,
    nearest,
    with_difference,
)


@pytest.mark.parametrize(
    ("found", "wanted", "line"),
    [
        ("Hello Time: 0", "Hello time: 0", "      ^"),
        ("Hello time:0", "Hello time: 0", "           ^"),
        ("hello time 0", "Hello time: 0", "^         ^"),
        ("Hello time: 0!", "Hello time: 0", "             ^"),
        ("my_frist_node", "my_first_node", "    ^^"),
        ("test_nod", "test_node", "        ^"),
        ("mein", "main", " ^"),
        ("my_first_node", "test_node", "^^^^^^^^^^^^^"),
        ("a.node:MyFirstNode", "a.node:main", "       ^^^^^^^^^^^"),
    ],
)
def test_the_difference_is_marked_at_its_place(found: str, wanted: str, line: str) -> None:
    marked = marks(found, wanted)
    if found == "my_frist_node":  # either of the two swapped letters may be the wrong one
        assert marked.strip() in ("^", "^^", "^ ^")
        assert marked.index("^") in (4, 5)
    else:
        assert marked == line


@pytest.mark.parametrize(
    ("found", "wanted"),
    [
        ("same", "same"),
        ("", "main"),
        ("tomato", "my_first_node"),
        ("안녕 시간", "안녕 시가"),
        (
            "test_node = a.my_first_node:mainsecond = a.second:main",
            "test_node = a.my_first_node:main",
        ),
    ],
)
def test_marks_that_would_not_help_are_left_out(found: str, wanted: str) -> None:
    assert marks(found, wanted) == ""
    assert compared(found, wanted) == ""


def test_the_found_text_is_above_the_marks_and_the_expected_below() -> None:
    assert compared("tset_node", "test_node").split("\n")[::2] == ["tset_node", "test_node"]
    assert with_difference("mein", "mein", "main") == "mein\n ^\nmain"
    assert with_difference("it is mein", "mein", "main") == "it is mein\nmein\n ^\nmain"
    assert with_difference("it is so", "so", "") == "it is so"


@given(st.text(max_size=120), st.text(max_size=120))
def test_marks_never_reach_beyond_the_text(found: str, wanted: str) -> None:
    line = marks(found, wanted)
    assert len(line) <= len(found) + 1
    assert set(line) <= {" ", "^"}


def test_a_name_is_near_regardless_of_case() -> None:
    assert nearest("Timer_Callback", ["timer_callback", "main"]) == "timer_callback"
    assert nearest("xyz", ["timer_callback"]) == ""
    assert meant("") == ""
    assert "'main'" in meant("main")
    assert "main" in Translator("ko")(meant("main"))
    assert "mean" not in Translator("ko")(meant("main"))


def test_an_unknown_word_is_answered_with_the_nearest_or_with_all_known_ones() -> None:
    known = ("docker", "bubblewrap", "none")
    assert did_you_mean("Bubblewarp", known) == "did you mean 'bubblewrap'?"
    assert did_you_mean("xyz", known) == ""
    assert meant_or_known("dokcer", known) == " (did you mean 'docker'?)"
    assert meant_or_known("xyz", known) == "; known: docker, bubblewrap, none"
    assert "docker" in Translator("ko")(did_you_mean("dokcer", known))
    assert "mean" not in Translator("ko")(did_you_mean("dokcer", known))
