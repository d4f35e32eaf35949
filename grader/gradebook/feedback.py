"""What one student is told: their points, how they came about, and each check that they may see."""

from __future__ import annotations

import functools
import html
from dataclasses import replace

from grader.batch.model import Entry
from grader.gradebook.cells import number
from grader.report.blocks import WORDS
from grader.report.plain import one_line
from grader.site.render import Renderer
from grader.site.student import CheckView
from grader.site.student import StudentView
from grader.site.student import student_view
from grader.site.words import STATES
from grader.site.words import plural

# where the instructor keeps the submission, and by what key, is not the student's business
KEPT_BACK = ("Folder", "Key")
TOLD = ("Found", "Fix")  # of a check, where there is little room
MOST = 300  # characters of one text in the short form
MOST_CHECKS = 40


def feedback_view(entry: Entry, *, show_hidden: bool) -> StudentView:
    """Return what a student's page shows, without what is for the instructor alone."""
    view = student_view(entry, show_hidden=show_hidden)
    facts = tuple((name, value) for name, value in view.facts if name not in KEPT_BACK)
    return replace(view, facts=facts, details=())


def headline(entry: Entry) -> str:
    """Return the result in a few words: `85 of 100 points`, or why there are none."""
    if entry.final is not None:
        return f"{number(entry.final)} of {number(entry.max_score)} points"
    return f"No points yet: {STATES[entry.status]}" if entry.status != "graded" else "No points yet"


def hidden_words(view: StudentView) -> str:
    """Return how many checks the student does not see, "" for none."""
    return f"{plural(view.hidden, 'hidden check')}: not shown" if view.hidden else ""


def mark_of(one: CheckView) -> str:
    """Return a check's result and points in one line: `failed, 0 / 10 points`."""
    check = one.check
    most = number(check.max_score)
    if one.override is not None:
        was = number(check.score)
        given = f"{number(one.override.points)} / {most} points, corrected from {was}"
    elif check.status in ("inconclusive", "error"):
        given = f"{most} points neither given nor taken"
    else:
        given = f"{number(check.score)} / {most} points"
    because = f" because of {' and '.join(one.because)}" if one.because else ""
    return f"{WORDS[check.status]}{because}, {given}"


def short_html(entry: Entry, *, show_hidden: bool) -> str:
    """Return the feedback as a few lines of HTML without any line end or quotation mark.

    Moodle keeps comments as HTML, and PHP's reader of CSV takes a backslash before a quotation
    mark for an escape (PHP manual, `fgetcsv`): a cell without them is read the same everywhere.
    """
    view = feedback_view(entry, show_hidden=show_hidden)
    open_ = [one for one in view.checks if one.check.status not in ("passed", "skipped")]
    skipped = sum(one.check.status == "skipped" for one in view.checks)
    lines = [f"<li>{_safe(line)}</li>" for line in [entry.problem, *view.reckoning] if line]
    lines += [f"<li>{_check(one)}</li>" for one in open_[:MOST_CHECKS]]
    if len(open_) > MOST_CHECKS:
        lines.append(f"<li>{plural(len(open_) - MOST_CHECKS, 'more check')} did not pass</li>")
    if skipped:
        lines.append(f"<li>{plural(skipped, 'check')} skipped because of these</li>")
    if hidden := hidden_words(view):
        lines.append(f"<li>{hidden}</li>")
    return f"<p><strong>{_safe(headline(entry))}</strong></p><ul>{''.join(lines)}</ul>"


def html_page(entry: Entry, title: str, *, show_hidden: bool) -> bytes:
    """Return the feedback as a page of its own, which opens offline and asks for nothing."""
    view = feedback_view(entry, show_hidden=show_hidden)
    logs = [("transcript", "What ros2 run printed", view.transcript)]
    logs.append(("build-log", "What colcon build printed", view.build_log))
    return _renderer(one_line(title)).page(
        "feedback.html.j2",
        script=False,
        view=view,
        headline=headline(entry),
        logs=[log for log in logs if log[2].strip()],
        log_titles={place: words for place, words, _ in logs},
    )


@functools.lru_cache(maxsize=1)
def _renderer(heading: str) -> Renderer:
    """Return the renderer of a class: templates are compiled once for all students."""
    return Renderer(heading=heading, pages={})


def _check(one: CheckView) -> str:
    check = one.check
    text = f"<code>{_safe(check.id)}</code> {_safe(mark_of(one))}: {_safe(check.title)}"
    for field in one.fields:
        if field.label in TOLD:
            text += f"<br>{field.label}: {_safe(field.text)}"
    return text


def _safe(text: str) -> str:
    """Return a text for HTML on one line; a backslash is written as its character reference."""
    return html.escape(one_line(text, most=MOST)).replace("\\", "&#92;")
