"""Texts and numbers as cells of a CSV file that people open in a spreadsheet.

A spreadsheet runs a cell that begins with = + - @ as a formula (OWASP, "CSV Injection"), and with
other regional settings it splits cells at semicolons even inside quotes. An apostrophe prevents
both.
"""

from __future__ import annotations

import re

from grader.base.plain_text import one_line, points

STARTS = "=+\\-@＝＋－＠"
FORMULA = re.compile(rf"^([\s\"']*)([{STARTS}])")
AFTER_SPLIT = re.compile(rf"(;[\s\"']*)([{STARTS}])")
MOST = 1_000  # characters


def text(value: str, *, most: int = MOST) -> str:
    """Return a text as a cell: one line, without invisible characters, never a formula."""
    line = one_line(value, most=most)
    return AFTER_SPLIT.sub(r"\1'\2", FORMULA.sub(r"'\1\2", line))


def is_plain(value: str) -> bool:
    """Return whether a text is unchanged as a cell, so that another system recognises it."""
    return text(value) == value


def number(value: float | None, *, comma: bool = False) -> str:
    """Return points with a decimal point (or comma), "" for None."""
    if value is None:
        return ""
    return points(value).replace(".", ",") if comma else points(value)
