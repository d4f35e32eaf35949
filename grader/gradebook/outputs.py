"""All files of a class, written as a whole and for their owner only."""

from __future__ import annotations

from collections.abc import Callable
from collections.abc import Iterable
from collections.abc import Iterator
from collections.abc import Mapping
from pathlib import Path

from grader.batch.model import ClassResult
from grader.errors import UsageError
from grader.gradebook.canvas import fill_gradebook
from grader.gradebook.canvas import new_gradebook
from grader.gradebook.feedback import html_page
from grader.gradebook.gradebook_csv import gradebook_csv
from grader.gradebook.junit import class_xml
from grader.gradebook.markdown import markdown
from grader.gradebook.moodle_import import moodle_import
from grader.gradebook.moodle_worksheet import fill_worksheet
from grader.report.files import could_not_write
from grader.report.folder import Folder
from grader.site.names import page_names

FEEDBACK = "feedback"
GRADEBOOK = "gradebook.csv"
WORKSHEET = "moodle-worksheet.csv"
MOODLE = "moodle-gradebook.csv"
CANVAS = "canvas-gradebook.csv"
JUNIT = "junit.xml"
MOST_INPUT = 50_000_000  # bytes of a file of the teacher's


def write_outputs(
    result: ClassResult,
    out: Path,
    *,
    worksheet: Path | None = None,
    canvas: Path | None = None,
    canvas_column: str | None = None,
    grade_column: str = "",
    feedback_column: str = "",
    show_hidden: bool = False,
    say: Callable[[str], None] | None = None,
) -> list[Path]:
    """Write the files of a class below `out` (made if it is not there) and return their paths.

    `worksheet` and `canvas` are the teacher's own files, of which filled copies are made; what
    could not be filled in is told to `say`. Nothing is written if one of them is refused
    (UsageError). SurroundingsError if the folder cannot be written. They may reach the disk a while
    later.
    """
    warnings: list[str] = []
    files = {GRADEBOOK: gradebook_csv(result, bom=True), JUNIT: class_xml(result)}
    if worksheet is not None:
        filled = fill_worksheet(
            _content(worksheet),
            result,
            grade_column=grade_column,
            feedback_column=feedback_column,
            show_hidden=show_hidden,
        )
        files[WORKSHEET] = filled.content
        warnings += filled.warnings
    if result.system == "moodle":
        made = moodle_import(result, show_hidden=show_hidden)
        files[MOODLE] = made.content
        warnings += made.warnings
    if canvas is not None:
        filled = fill_gradebook(_content(canvas), result, column=canvas_column or "")
        files[CANVAS] = filled.content
        warnings += filled.warnings
    elif result.system == "canvas":
        files[CANVAS] = new_gradebook(result, title=canvas_column or "")
    feedback = _feedback(result, show_hidden=show_hidden)
    if say is not None:
        for warning in warnings:
            say(warning)
    return _write(out, files, feedback)


def _feedback(result: ClassResult, *, show_hidden: bool) -> Iterator[tuple[str, bytes]]:
    """Yield each student's two files, by name; two students never share one."""
    title = result.title or result.assignment
    pages = page_names(entry.student.key for entry in result.entries)
    for entry in result.entries:
        page = pages[entry.student.key]
        yield page, html_page(entry, title, show_hidden=show_hidden)
        text = markdown(entry, title, show_hidden=show_hidden)
        yield f"{page.removesuffix('.html')}.md", text.encode()


def _write(
    out: Path, files: Mapping[str, bytes], feedback: Iterable[tuple[str, bytes]]
) -> list[Path]:
    written = [out / name for name in files]
    try:
        out.mkdir(mode=0o700, parents=True, exist_ok=True)
        with Folder.open(out, durable=False) as folder:
            for name, content in files.items():
                folder.replace(name, content)
            with folder.private(FEEDBACK) as inside:
                for name, content in feedback:
                    inside.replace(name, content)
                    written.append(out / FEEDBACK / name)
    except OSError as error:
        raise could_not_write(error, out, what="the files of the class") from error
    return written


def _content(path: Path) -> bytes:
    try:
        with path.open("rb") as file:
            content = file.read(MOST_INPUT + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise UsageError(f"{path} cannot be read: {reason}") from None
    if len(content) > MOST_INPUT:
        raise UsageError(f"{path} is too large for a list of grades")
    return content
