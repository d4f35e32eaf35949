"""One student's feedback as Markdown (CommonMark); text from a submission is always escaped."""

from __future__ import annotations

import re

from grader.base.carets import pieces
from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator
from grader.base.plain_text import first_lines, last_lines, one_line
from grader.batch.model import GradebookEntry
from grader.publish.feedback import (
    feedback_view,
    headline,
    hidden_words,
    mark_of,
    reason,
    written_by_hand,
)
from grader.publish.pages.student import CheckView
from grader.report.tracebacks import folded

# CommonMark: a backslash before ASCII punctuation makes it a literal character
ACTIVE = re.compile(r"([\\`*_\[\]<>&#|~!$@]|:(?=//)|(?<=www)\.|^[-+=])", re.I)
LIST_NUMBER = re.compile(r"^(\d+)([.)])")
BACKTICKS = re.compile(r"`+")
LOG_LINES, FIELD_LINES = 60, 30


def markdown(entry: GradebookEntry, title: str, *, show_hidden: bool) -> str:
    """Return the feedback; hidden checks are only counted, unless `show_hidden`."""
    view = feedback_view(entry, show_hidden=show_hidden)
    student, translate = entry.student, Translator(entry.lang)
    lines = [f"# {_plain(student.name or student.key)}: {_plain(title)}", ""]
    lines += [f"**{_plain(headline(entry))}**", ""]
    if by_hand := written_by_hand(entry):
        for part in by_hand.split("\n"):
            lines += [_plain(part), ""]
    if entry.problem:
        lines += [_plain(translate(entry.problem)), ""]
    if first := reason(view):
        lines += [_plain(first), ""]
    lines += [f"- {_plain(line)}" for line in view.calculation]
    if view.checks:
        head = translate(say("Checks"))
        lines += ["", f"## {_plain(head)}", ""]
        for one in view.checks:
            lines.append(f"- {_code(one.check.id)} {_plain(mark_of(one, entry.lang))}")
    if hidden := hidden_words(view):
        lines.append(f"- {_plain(hidden)}")
    for one in view.checks:
        if one.needs_block or one.override is not None or one.check.advice:
            lines += ["", *_block(one, translate)]
    for head, text in (
        (say("What ros2 run printed"), view.transcript),
        (say("What colcon build printed"), view.build_log),
    ):
        if text.strip():
            lines += ["", f"## {_plain(translate(head))}", ""]
            short = folded(text, translate=translate)
            lines += _fenced(last_lines(short, lines=LOG_LINES, translate=translate)[0])
    return "\n".join(lines) + "\n"


def _block(one: CheckView, translate: Translator) -> list[str]:
    lines = [f"## {_code(one.check.id)}: {_plain(one.check.title)}"]
    for field in one.fields:
        text = first_lines(field.text, lines=FIELD_LINES, most=1_000, translate=translate)
        if not field.code:
            lines += ["", *_prose(field.label, text)]
        elif len(text) > 1:
            lines += ["", f"{field.label}:", "", *_fenced(text)]
        else:
            lines += ["", f"{field.label}: {_code(text[0])}"]
    if one.override is not None:
        by, why = one.override.by, one.override.because
        correction = say("Corrected, because: {why}", why=why)
        if by:
            correction = say("Corrected by {name}, because: {why}", name=by, why=why)
        lines += ["", _plain(translate(correction))]
    return lines


def _prose(label: str, text: list[str]) -> list[str]:
    """Return a labelled text as one line; lines with marks below them are fenced."""
    lines, words = [], [f"{label}:"]
    for piece in pieces(text):
        if not piece.marked:
            words += piece.lines
            continue
        lines += [_plain(" ".join(words)), "", *_fenced(list(piece.lines)), ""]
        words = []
    return [*lines, _plain(" ".join(words))] if words else lines[:-1]


def _plain(text: str) -> str:
    """Return a text as one line without active markup, valid at any position."""
    line = one_line(" ".join(first_lines(text, lines=40, most=1_000)), most=4_000).strip()
    return LIST_NUMBER.sub(r"\1\\\2", ACTIVE.sub(r"\\\1", line))


def _code(text: str) -> str:
    """Return a text as inline code, with a fence longer than any run of backticks in it."""
    line = one_line(text, most=1_000)
    fence = "`" * (_longest(line) + 1)
    return f"{fence} {line} {fence}" if "`" in line or not line.strip() else f"{fence}{line}{fence}"


def _fenced(lines: list[str]) -> list[str]:
    fence = "`" * max(3, _longest("\n".join(lines)) + 1)
    return [f"{fence}text", *lines, fence]


def _longest(text: str) -> int:
    return max((len(run) for run in BACKTICKS.findall(text)), default=0)
