"""The files of a class (gradebook, sheets, feedback), readable by their owner only.

Each is written as a whole. If one cannot be made or written, the others are written anyway.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from pathlib import Path

from grader.base.folder import Folder
from grader.batch.model import ClassResult, GradebookEntry
from grader.batch.sheet import Filled
from grader.batch.systems.system import Columns, OpenSheet
from grader.publish.feedback import html_page, short_html
from grader.publish.gradebook_csv import gradebook_csv
from grader.publish.junit import class_xml
from grader.publish.markdown import markdown
from grader.publish.pages.names import page_names
from grader.publish.written import Written
from grader.report.files import could_not_write

FEEDBACK = "feedback"
GRADEBOOK = "gradebook.csv"
JUNIT = "junit.xml"


def write_outputs(
    result: ClassResult,
    out: Path,
    *,
    sheets: Mapping[str, OpenSheet] | None = None,
    columns: Columns | None = None,
    show_hidden: bool = False,
    notify: Callable[[str], None] | None = None,
) -> Written:
    """Write the files of a class below `out` (created if missing) and return their paths.

    `sheets` are the instructor's files, by the name of the filled copy, and `columns` the columns
    that the instructor named. `notify` receives what could not be filled in. Errors are in `failures`:
    UsageError for a file of the instructor's that cannot be filled in, SurroundingsError if the
    folder cannot be written. The files may reach the disk a while later.
    """
    written = Written()

    def comment(entry: GradebookEntry) -> str:
        seen = entry.for_student(result.detail, show_hidden=show_hidden)
        return short_html(seen, show_hidden=show_hidden)

    made: dict[str, Callable[[], Filled]] = {
        GRADEBOOK: lambda: Filled(gradebook_csv(result, bom=True)),
        JUNIT: lambda: Filled(class_xml(result)),
    }
    for name, sheet in (sheets or {}).items():
        made[name] = partial(sheet.filled, result, comment)
    new = result.system.gradebook
    if new is not None and new.output not in made:
        names = defaultdict(str, columns or {})
        made[new.output] = partial(new.write, result, comment, names)
    for name, make in made.items():
        with written.collecting_errors():
            _write(out, "", name, make(), written, notify)
    for name, page in _feedback(result, show_hidden=show_hidden):
        with written.collecting_errors():
            _write(out, FEEDBACK, name, Filled(page()), written, notify)
    return written


def _feedback(
    result: ClassResult, *, show_hidden: bool
) -> Iterator[tuple[str, Callable[[], bytes]]]:
    """Yield the names and contents of each student's two files; two students never share one.

    A student who submitted elsewhere gets none, unless an instructor corrected their points, and
    neither does anybody for a submission of which it is not known whose it is.
    """
    title = result.title or result.assignment
    pages = page_names(entry.student.key for entry in result.entries)
    for entry in result.entries:
        if entry.status in ("elsewhere", "unclear") and not entry.overrides:
            continue
        seen = entry.for_student(result.detail, show_hidden=show_hidden)
        page = pages[entry.student.key]
        yield page, partial(html_page, seen, title, show_hidden=show_hidden)
        text = partial(_markdown, seen, title, show_hidden=show_hidden)
        yield f"{page.removesuffix('.html')}.md", text


def _markdown(entry: GradebookEntry, title: str, *, show_hidden: bool) -> bytes:
    return markdown(entry, title, show_hidden=show_hidden).encode()


def _write(
    out: Path,
    folder: str,
    name: str,
    made: Filled,
    written: Written,
    notify: Callable[[str], None] | None,
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
    if notify is not None:
        for warning in made.warnings:
            notify(warning)
