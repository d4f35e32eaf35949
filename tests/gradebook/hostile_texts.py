"""Hostile texts, and classes made of them."""

from __future__ import annotations

import dataclasses

from hypothesis import strategies as st

from grader.batch.model import ClassResult, GradebookEntry, Override, Student
from tests.pages import classes
from tests.report import samples

NASTY = (
    "=1+1",
    '=HYPERLINK("http://x";"y")',
    "+1",
    "-1",
    "@SUM(A1)",
    "\t=1",
    "\r=1",
    " =1",
    "a;=cmd|' /C calc'!A0",
    'a";"=1',
    "＝1+1",
    "O'Neil, Jr.",
    'say "hi"',
    "two\nlines",
    "two\r\nlines",
    "\x00\x07\x1b[31mred",
    "\u202egnirts",
    "\u200e\ufeff",
    "\ud800",
    "\ufffe\uffff",
    "&#44",
    "<script>alert(1)</script>",
    "]]>",
    "a\\",
    'a\\"b',
    "::error::x",
    "x\n  ::set-output name=a::b",
    "x\n##[add-path]/tmp",
    "``` x",
    "[x](http://evil.example)",
    "![x](y)",
    "# no heading",
    "1. no list",
    "www.evil.example https://evil.example a@b.example",
    "x" * 5_000,
    "",
    "Ünï çødé 名前",
)
texts = st.one_of(
    st.sampled_from(NASTY),
    st.text(max_size=40),
    st.lists(st.sampled_from(NASTY), min_size=2, max_size=3).map("".join),
)


def hostile_entry(text: str, *, number: int = 1) -> GradebookEntry:
    """An entry in which every text, of the student and of the report, is `text`."""
    poisoned = classes.with_every_text(samples.failing_report(), text.replace("\ud800", "?"))
    entry = classes.entry(
        number,
        poisoned,
        student=Student(str(1000 + number), text, text, text, text, text),
        score=61,
        final=56,
        penalty=5,
        late_seconds=60,
        notes=(text,),
    )
    corrections = (Override(str(1000 + number), "", 61, text, by=text),)
    return dataclasses.replace(entry, overrides=corrections)


def hostile_class(*found: str) -> ClassResult:
    entries = [hostile_entry(text, number=number) for number, text in enumerate(found)]
    return classes.result(entries, title=found[0] if found else "x")
