"""One student's feedback: the points, how they were calculated, and each check they may see.

All of it is in the entry's language.
"""

from __future__ import annotations

import functools
import html
from dataclasses import replace

from grader.base.carets import is_marks
from grader.base.i18n.message import joined, say, say_plural
from grader.base.i18n.translator import LANGUAGES, Translator
from grader.base.plain_text import one_line, shorten, visible
from grader.batch.cells import number
from grader.batch.model import GradebookEntry
from grader.batch.words import STATES
from grader.publish.pages.render import Renderer
from grader.publish.pages.student import FOLDER, KEY, CheckView, StudentView, student_view
from grader.report.blocks import WORDS, all_of
from grader.report.report_page import hidden_checks

# the instructor's folder and key of a submission are not shown to the student
INSTRUCTOR_FACTS = (FOLDER, KEY)
SHORT_FIELDS = (say("Found"), say("Fix"))  # the fields of a check in the short form
MOST = 300  # characters of one text in the short form
MOST_CHECKS = 40


def feedback_view(entry: GradebookEntry, *, show_hidden: bool) -> StudentView:
    """Return the view for a student's page, without the facts meant for the instructor only."""
    view = student_view(entry, show_hidden=show_hidden, lang=entry.lang)
    excluded = [Translator(entry.lang)(name) for name in INSTRUCTOR_FACTS]
    facts = tuple((name, value) for name, value in view.facts if name not in excluded)
    return replace(view, facts=facts, details=())


def headline(entry: GradebookEntry) -> str:
    """Return the result in a few words: `85 of 100 points`, or why there are none."""
    text = say("No points yet")
    if entry.final is not None:
        most = number(entry.max_score)
        text = say("{points} of {most} points", points=number(entry.final), most=most)
    elif entry.status != "graded":
        text = say("No points yet: {state}", state=STATES[entry.status])
    return Translator(entry.lang)(text)


def written_by_hand(entry: GradebookEntry) -> str:
    """Return what the instructor wrote to the student, with its title; "" if nothing."""
    if entry.remark is None:
        return ""
    return Translator(entry.lang)(say("Your instructor writes: {text}", text=entry.remark.text))


def reason(view: StudentView) -> str:
    """Return why points are missing, in a line: the first check that failed; "" if none did."""
    failed = next((one for one in view.checks if one.check.status == "failed"), None)
    if failed is None or failed.override is not None:
        return ""
    translate = Translator(view.entry.lang)
    title = translate(say("First: {title}", title=failed.check.title))
    labels = [translate(label) for label in SHORT_FIELDS]
    told = [one for label in labels for one in failed.fields if one.label == label]
    found = [f"{one.label}: {_first_line(one.text)}" for one in told]
    return ". ".join(part.removesuffix(".") for part in (title, *found)) + "."


def _first_line(text: str) -> str:
    return one_line(next((line.strip() for line in text.split("\n") if line.strip()), ""))


def hidden_words(view: StudentView) -> str:
    """Return a text with the number of checks hidden from the student, "" for none."""
    return Translator(view.entry.lang)(hidden_checks(view.hidden)) if view.hidden else ""


def mark_of(one: CheckView, lang: str) -> str:
    """Return a check's result and points in one line: `failed, 0 / 10 points`."""
    check = one.check
    most, state = number(check.max_score), WORDS[check.status]
    given = say("{given} / {most} points", given=number(check.score), most=most)
    if one.override is not None:
        given = say(
            "{given} / {most} points, corrected from {was}",
            given=number(one.override.points),
            most=most,
            was=number(check.score),
        )
    elif check.status in ("inconclusive", "error"):
        given = say("{most} points neither given nor taken", most=most)
    if one.because:
        state = say("{state} because of {checks}", state=state, checks=all_of(one.because))
    return Translator(lang)(joined(state, given, by=", "))


def short_html(entry: GradebookEntry, *, show_hidden: bool) -> str:
    """Return the feedback as short HTML without line breaks or quotation marks; the reason first.

    Moodle keeps comments as HTML, and PHP's CSV reader treats a backslash before a quotation
    mark as an escape (PHP manual, `fgetcsv`). A cell without either is read the same everywhere.
    """
    view = feedback_view(entry, show_hidden=show_hidden)
    open_ = [one for one in view.checks if one.check.status not in ("passed", "skipped")]
    skipped = sum(one.check.status == "skipped" for one in view.checks)
    translate = Translator(entry.lang)
    first = [line for line in (written_by_hand(entry), translate(entry.problem)) if line]
    lines = [_safe(line) for line in first]
    lines += [_check(one, translate) for one in open_[:MOST_CHECKS]]
    rest = [_more(len(open_) - MOST_CHECKS), _skipped(skipped), hidden_words(view)]
    lines += [_safe(translate(line)) for line in rest if line]
    lines += [_safe(line) for line in view.calculation]
    items = "".join(f"<li>{line}</li>" for line in lines)
    return f"<p><strong>{_safe(headline(entry))}</strong></p><ul>{items}</ul>"


def _more(count: int) -> str:
    """Return a text with the number of checks beyond MOST_CHECKS, "" if none."""
    if count <= 0:
        return ""
    return say_plural("1 more check did not pass", "{count} more checks did not pass", count)


def _skipped(count: int) -> str:
    """Return a text with the number of skipped checks, "" if none."""
    if count == 0:
        return ""
    return say_plural(
        "1 check skipped because of these", "{count} checks skipped because of these", count
    )


def html_page(entry: GradebookEntry, title: str, *, show_hidden: bool) -> bytes:
    """Return the feedback as a self-contained HTML page that makes no requests."""
    view = feedback_view(entry, show_hidden=show_hidden)
    translate = Translator(entry.lang)
    logs = [("transcript", translate(say("What ros2 run printed")), view.transcript)]
    logs.append(("build-log", translate(say("What colcon build printed")), view.build_log))
    return _renderer(one_line(title), entry.lang).page(
        "feedback.html.j2",
        script=False,
        view=view,
        headline=headline(entry),
        by_hand=written_by_hand(entry),
        reason=reason(view),
        logs=[log for log in logs if log[2].strip()],
        log_titles={place: words for place, words, _ in logs},
    )


@functools.lru_cache(maxsize=len(LANGUAGES))
def _renderer(heading: str, lang: str) -> Renderer:
    """Return the renderer of a class, so that templates are compiled once for all students."""
    return Renderer(heading=heading, pages={}, lang=lang)


def _check(one: CheckView, translate: Translator) -> str:
    check, labels = one.check, [translate(label) for label in SHORT_FIELDS]
    mark = mark_of(one, translate.lang)
    text = f"<code>{_safe(check.id)}</code> {_safe(mark)}: {_safe(check.title)}"
    for field in one.fields:
        if field.label in labels:
            lines = [line for line in field.text.split("\n") if not is_marks(line)]
            text += f"<br>{_safe(field.label)}: {_safe(chr(10).join(lines))}"
    return text


def _safe(text: str) -> str:
    """Return a text escaped for HTML, `<br>` between its lines, backslashes as character references."""
    lines = shorten(text.strip(), most=MOST).split("\n")
    escaped = [html.escape(visible(line)).replace("\\", "&#92;") for line in lines]
    return "<br>".join(escaped)
