"""The files of a class (gradebook, sheets, feedback), readable by their owner only.

Each is written as a whole. If one cannot be made or written, the others are written anyway.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

from grader.base.folder import Folder
from grader.batch.model import ClassResult, Entry
from grader.batch.sheet import Filled
from grader.batch.systems.canvas.write import CanvasGradebook, new_gradebook
from grader.batch.systems.moodle.gradebook_import import moodle_import
from grader.batch.systems.moodle.worksheet import Worksheet
from grader.publish.feedback import html_page, short_html
from grader.publish.gradebook_csv import gradebook_csv
from grader.publish.junit import class_xml
from grader.publish.markdown import markdown
from grader.publish.pages.names import page_names
from grader.publish.written import Written
from grader.report.files import could_not_write

FEEDBACK = "feedback"
GRADEBOOK = "gradebook.csv"
WORKSHEET = "moodle-worksheet.csv"
MOODLE = "moodle-gradebook.csv"
CANVAS = "canvas-gradebook.csv"
JUNIT = "junit.xml"


def write_outputs(
    result: ClassResult,
    out: Path,
    *,
    worksheet: Worksheet | None = None,
    canvas: CanvasGradebook | None = None,
    canvas_column: str = "",
    show_hidden: bool = False,
    say: Callable[[str], None] | None = None,
) -> Written:
    """Write the files of a class below `out` (created if missing) and return their paths.

    `worksheet` and `canvas` are the instructor's own files, of which filled copies are written;
    `say` is called with a warning for each entry that could not be filled in. Errors are collected
    in `failures`: UsageError for an instructor's file that cannot be used, SurroundingsError if
    the folder cannot be written. The files are not synced to disk.
    """
    written = Written()
    comment = partial(short_html, show_hidden=show_hidden)
    made: dict[str, Callable[[], Filled]] = {
        GRADEBOOK: lambda: Filled(gradebook_csv(result, bom=True)),
        JUNIT: lambda: Filled(class_xml(result)),
    }
    if worksheet is not None:
        made[WORKSHEET] = lambda: worksheet.filled(result, comment)
    if result.system == "moodle":
        made[MOODLE] = lambda: moodle_import(result, comment)
    if canvas is not None:
        made[CANVAS] = lambda: canvas.filled(result)
    elif result.system == "canvas":
        made[CANVAS] = lambda: Filled(new_gradebook(result, title=canvas_column))
    for name, make in made.items():
        with written.collecting_errors():
            _write(out, "", name, make(), written, say)
    for name, page in _feedback(result, show_hidden=show_hidden):
        with written.collecting_errors():
            _write(out, FEEDBACK, name, Filled(page()), written, say)
    return written


def _feedback(
    result: ClassResult, *, show_hidden: bool
) -> Iterator[tuple[str, Callable[[], bytes]]]:
    """Yield the names and contents of each student's two files; two students never share one.

    A student who submitted elsewhere gets none, unless an instructor corrected their points.
    """
    title = result.title or result.assignment
    pages = page_names(entry.student.key for entry in result.entries)
    for entry in result.entries:
        if entry.status == "elsewhere" and not entry.overrides:
            continue
        page = pages[entry.student.key]
        yield page, partial(html_page, entry, title, show_hidden=show_hidden)
        text = partial(_markdown, entry, title, show_hidden=show_hidden)
        yield f"{page.removesuffix('.html')}.md", text


def _markdown(entry: Entry, title: str, *, show_hidden: bool) -> bytes:
    return markdown(entry, title, show_hidden=show_hidden).encode()


def _write(
    out: Path,
    folder: str,
    name: str,
    made: Filled,
    written: Written,
    say: Callable[[str], None] | None,
) -> None:
    """Write one file into `out`, or into a folder in it."""
    try:
        out.mkdir(mode=0o700, parents=True, exist_ok=True)
        with Folder.open(out, durable=False) as outer:
            if folder:
                with outer.private(folder) as inner:
                    inner.replace(name, made.content)
            else:
                outer.replace(name, made.content)
    except OSError as error:
        raise could_not_write(error, out, what=folder or name) from error
    written.files.append(out / folder / name)
    if say is not None:
        for warning in made.warnings:
            say(warning)
