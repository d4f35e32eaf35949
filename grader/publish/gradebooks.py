"""The files of a class (gradebook, sheets, feedback), readable by their owner only.

Each is written as a whole. If one cannot be made or written, the others are written anyway.
"""

from __future__ import annotations

import contextlib
import csv
import io
from collections import defaultdict
from collections.abc import Callable, Collection, Iterator, Mapping
from functools import partial
from pathlib import Path

from grader.base.folder import Folder
from grader.batch import cells
from grader.batch.by_hand import BY_HAND_FILE, by_hand_csv
from grader.batch.model import ClassResult, GradebookEntry
from grader.batch.sheet import Filled
from grader.batch.systems.system import Columns, OpenSheet
from grader.publish.feedback import html_page, short_html
from grader.publish.feedback_names import feedback_names
from grader.publish.gradebook_csv import gradebook_csv
from grader.publish.junit import class_xml
from grader.publish.markdown import markdown
from grader.publish.pages.names import page_names
from grader.publish.written import Written
from grader.report.files import could_not_write

FEEDBACK = "feedback"
FEEDBACK_LIST = "feedback.csv"
FILES = ("page", "text")
FEEDBACK_COLUMNS = ("key", "name", "email", "language", *FILES)
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
        BY_HAND_FILE: lambda: Filled(by_hand_csv(result)),
    }
    for name, sheet in (sheets or {}).items():
        made[name] = partial(sheet.filled, result, comment)
    new = result.system.gradebook
    if new is not None and new.output not in made:
        names = defaultdict(str, columns or {})
        made[new.output] = partial(new.write, result, comment, names)
    pages = _Pages(result, show_hidden=show_hidden)
    if result.system.feedback is not None:
        form = result.system.feedback
        made[form.output] = partial(form.write, result, pages.both)
    for name, make in made.items():
        with written.collecting_errors():
            _write(out, "", name, make(), written, notify)
    with written.collecting_errors():
        _remove_earlier(out, result, {name for name, _ in pages.files()})
    for name, page in pages.files():
        with written.collecting_errors():
            _write(out, FEEDBACK, name, Filled(page()), written, notify)
    with written.collecting_errors():
        listed = Filled(feedback_list(pages.names, result))
        _write(out, "", FEEDBACK_LIST, listed, written, notify)
    return written


def _remove_earlier(out: Path, result: ClassResult, kept: Collection[str]) -> None:
    """Remove feedback that an earlier run wrote under other names, and nothing else."""
    known = {f"{name}.{end}" for name, end in _earlier_names(result)}
    with contextlib.suppress(OSError), Folder.open(out, durable=False) as outer:
        rows = csv.DictReader(io.StringIO((outer.read(FEEDBACK_LIST) or b"").decode("utf-8-sig")))
        for row in rows:
            known |= {str(row.get(column)).removeprefix(f"{FEEDBACK}/") for column in FILES}
        with outer.private(FEEDBACK) as folder:
            for name in known.intersection(folder.names()).difference(kept):
                folder.remove(name)


def _earlier_names(result: ClassResult) -> Iterator[tuple[str, str]]:
    """Yield the names of graders that named feedback by the student's key."""
    pages = page_names(entry.student.key for entry in result.entries)
    for page in pages.values():
        yield from ((page.removesuffix(".html"), ending) for ending in ("html", "md"))


class _Pages:
    """The feedback of a class; two students never share a file.

    A student who submitted elsewhere gets none, unless an instructor corrected their points, and
    neither does anybody for a submission of which it is not known whose it is.
    """

    def __init__(self, result: ClassResult, *, show_hidden: bool) -> None:
        self._result = result
        self._title = result.title or result.assignment
        self._show_hidden = show_hidden
        entries = [
            entry
            for entry in result.entries
            if entry.status not in ("elsewhere", "unclear") or entry.overrides
        ]
        self._entries = entries
        self.names = feedback_names(entry.student for entry in entries)

    def files(self) -> Iterator[tuple[str, Callable[[], bytes]]]:
        """Yield the names and contents of each student's two files."""
        for entry in self._entries:
            name = self.names[entry.student.key]
            yield f"{name}.html", partial(self._html, entry)
            yield f"{name}.md", partial(self._markdown, entry)

    def both(self, entry: GradebookEntry) -> tuple[bytes, str]:
        """Return a student's feedback as HTML and as text."""
        return self._html(entry), self._markdown(entry).decode()

    def _html(self, entry: GradebookEntry) -> bytes:
        return html_page(self._seen(entry), self._title, show_hidden=self._show_hidden)

    def _markdown(self, entry: GradebookEntry) -> bytes:
        return markdown(self._seen(entry), self._title, show_hidden=self._show_hidden).encode()

    def _seen(self, entry: GradebookEntry) -> GradebookEntry:
        return entry.for_student(self._result.detail, show_hidden=self._show_hidden)


def feedback_list(names: Mapping[str, str], result: ClassResult) -> bytes:
    """Return which feedback file is whose, as a CSV file."""
    out = io.StringIO()
    table = csv.writer(out, quoting=csv.QUOTE_ALL)
    table.writerow(FEEDBACK_COLUMNS)
    for entry in result.entries:
        if entry.student.key in names:
            who = (entry.student.key, entry.student.name, entry.student.email, entry.lang)
            name = f"{FEEDBACK}/{names[entry.student.key]}"
            table.writerow([*(cells.text(word) for word in who), f"{name}.html", f"{name}.md"])
    return out.getvalue().encode("utf-8-sig")


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
