"""The folder of a class: `index.html` and one page per student, readable without a server."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

from grader.base.folder import Folder
from grader.base.i18n.message import joined, say
from grader.base.i18n.translator import LANGUAGES
from grader.base.plain_text import one_line
from grader.batch.model import ClassResult, EntryStatus, GradebookEntry
from grader.batch.words import STATES, duration, instant, local_instant, offset_words
from grader.publish.pages import overview
from grader.publish.pages.charts import histogram
from grader.publish.pages.names import page_names
from grader.publish.pages.render import Renderer
from grader.publish.pages.student import student_view
from grader.report.files import could_not_write

INDEX, STUDENTS = "index.html", "students"
OURS = tuple(
    f'<!doctype html>\n<html lang="{lang}" data-made-by="ros2-teaching-lab">'.encode()
    for lang in LANGUAGES
)
FEW = 8  # more names than this are folded
LOG_TITLES = {
    "transcript": say("What ros2 run printed"),
    "build-log": say("What colcon build printed"),
}


def write_site(result: ClassResult, out: Path, *, show_hidden: bool = True) -> Path:
    """Write the pages into the folder `out` (made if missing); return `index.html`'s path.

    The pages are a pure function of the result; only their owner can read them. Pages of students
    who left the class since an earlier run are removed. `show_hidden` includes the checks that
    students do not see. Files are not synced to disk. Raises SurroundingsError if the folder cannot
    be written.
    """
    pages = page_names(entry.student.key for entry in result.entries)
    renderer = Renderer(lang=result.lang, result=result, pages=pages, heading=_heading(result))
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        out.mkdir(mode=0o700, exist_ok=True)
        with Folder.open(out, durable=False) as folder:
            with folder.private(STUDENTS) as students:
                _write_students(students, renderer, result, pages, show_hidden=show_hidden)
                _remove_old(students, set(pages.values()))
            folder.replace(INDEX, _index(renderer, result, show_hidden=show_hidden))
    except OSError as error:
        raise could_not_write(error, out, what="the page of the class") from error
    return out / INDEX


def _write_students(
    folder: Folder,
    renderer: Renderer,
    result: ClassResult,
    pages: dict[str, str],
    *,
    show_hidden: bool,
) -> None:
    entries = result.entries
    around = zip_longest((None, *entries[:-1]), entries, entries[1:])
    known = {entry.student.key: entry for entry in entries}
    for before, entry, after in around:
        if entry is None:
            continue
        view = student_view(entry, show_hidden=show_hidden, lang=result.lang)
        logs = [("transcript", view.transcript), ("build-log", view.build_log)]
        page = renderer.page(
            "student.html.j2",
            script=False,
            view=view,
            about=_about_student(result, entry),
            before=before,
            after=after,
            notes=[*entry.notes, *(entry.report.submission.notes if entry.report else ())],
            same=[known[key] for key in entry.same_as if key in known],
            logs=[(place, LOG_TITLES[place], text) for place, text in logs if text.strip()],
            log_titles=LOG_TITLES,
        )
        folder.replace(pages[entry.student.key], page)


def _heading(result: ClassResult) -> str:
    return one_line(result.title or result.assignment)


def _about_student(result: ClassResult, entry: GradebookEntry) -> list[str]:
    at = local_instant(entry.submitted)
    submitted = joined(say("Submitted"), at, by=": ") if at else ""
    parts = (_heading(result), _number(entry), STATES[entry.status], submitted)
    return [part for part in parts if part]


def _number(entry: GradebookEntry) -> str:
    """Return the student's number in the course, "" if it is the name."""
    number = entry.student.id_number or entry.student.key
    return one_line(number, most=60) if number != entry.student.name else ""


def _remove_old(folder: Folder, kept: set[str]) -> None:
    """Remove pages of an earlier run that this one did not write, and no other files."""
    for name in folder.names():
        if name.endswith(".html") and name not in kept:
            content = folder.read(name)
            if content is not None and content.startswith(OURS):
                folder.remove(name)


@dataclass(frozen=True)
class StudentRow:
    """A student's row; the search also matches `find` and the start of a word in `mistakes`."""

    entry: GradebookEntry
    number: str
    attempt: str
    failed: tuple[str, ...]
    find: str
    mistakes: str
    points: str
    """The number of the histogram's bar, "" without points."""


def _index(renderer: Renderer, result: ClassResult, *, show_hidden: bool) -> bytes:
    entries = result.entries
    scores = overview.scores(result)
    groups = {
        "unclear": result.unclear,
        "open_lateness": [entry for entry in entries if entry.is_lateness_open],
        "unsure": overview.unsure(result, show_hidden=show_hidden),
        "identical": _identical(result),
        **{
            status: [entry for entry in entries if entry.status == status]
            for status in ("error", "elsewhere", "missing", "pending")
        },
        "by_hand": [entry for entry in entries if entry.by_hand],
        "lapsed": [entry for entry in entries if entry.lapsed],
    }
    return renderer.page(
        "index.html.j2",
        script=True,
        about=_about(result),
        cards=_cards(entries),
        attention=any(groups.values()),
        **groups,
        scores=scores,
        histogram=histogram(scores.bins) if scores else None,
        checks=overview.checks(result, show_hidden=show_hidden),
        mistakes=overview.mistakes(result, show_hidden=show_hidden),
        graded=sum(entry.report is not None for entry in entries),
        few=FEW,
        slowest=overview.slowest(result),
        rows=[_row(entry, show_hidden=show_hidden, most=result.max_score) for entry in entries],
        section_names=sorted({e.student.section for e in entries if e.student.section}),
        sections=any(entry.student.section for entry in entries),
        grants=any(entry.is_extended or entry.slip_days for entry in entries),
        zone=_common_zone(entries),
    )


def _common_zone(entries: Sequence[GradebookEntry]) -> str:
    """Return the offset from UTC of all times in the table, "" if they have several."""
    times = (at for e in entries for at in (e.submitted, e.due if e.is_extended else None) if at)
    offsets = {offset_words(at) for at in times} or {"UTC"}
    return offsets.pop() if len(offsets) == 1 else ""


def _about(result: ClassResult) -> list[str]:
    distros = f"ROS 2 {', '.join(result.distros)}" if result.distros else ""
    took = say("took {duration}", duration=duration(result.seconds)) if result.seconds else ""
    parts = (result.assignment, result.system.title, distros, instant(result.started), took)
    return [part for part in parts if part]


def _cards(entries: Sequence[GradebookEntry]) -> list[tuple[str, int]]:
    def count(status: str) -> int:
        return sum(entry.status == status for entry in entries)

    granted = sum(entry.is_extended or entry.slip_days > 0 for entry in entries)
    full = [e for e in entries if e.final is not None and e.final >= e.max_score]
    cards = [
        (say("Students"), len(entries)),
        (STATES["graded"], count("graded")),
        (say("Full marks"), len(full)),
        (say("Late"), sum(bool(entry.late_seconds) for entry in entries)),
        *([(say("With an extension"), granted)] if granted else []),
        (say("Look at by hand"), count("ungradable")),
        (STATES["missing"], count("missing")),
    ]
    rare: tuple[EntryStatus, ...] = ("error", "elsewhere", "unclear", "pending")
    return [*cards, *((STATES[status], number) for status in rare if (number := count(status)))]


def _identical(result: ClassResult) -> list[list[GradebookEntry]]:
    known = {entry.student.key: entry for entry in result.entries}
    groups = ([known[key] for key in group if key in known] for group in result.identical)
    return [group for group in groups if len(group) > 1]


def _row(entry: GradebookEntry, *, show_hidden: bool, most: float) -> StudentRow:
    student = entry.student
    checks = overview.shown(entry, show_hidden=show_hidden)
    mistakes = [mistake.id for check in checks for mistake in check.mistakes]
    attempt = "1"
    if entry.attempts > 1:
        attempt = say("{number} of {count}", number=entry.attempt, count=entry.attempts)
    unseen = (student.key, student.email, student.username)
    return StudentRow(
        entry=entry,
        number=_number(entry),
        attempt=attempt if entry.report else "",
        failed=tuple(check.id for check in checks if check.status == "failed"),
        find=" ".join(dict.fromkeys(one_line(part, most=120) for part in unseen if part)),
        mistakes=" ".join(dict.fromkeys(mistakes)),
        points=_bin(entry, most),
    )


def _bin(entry: GradebookEntry, most: float) -> str:
    if entry.status != "graded" or entry.final is None or most <= 0:
        return ""
    return str(overview.bin_of(entry.final, most))
