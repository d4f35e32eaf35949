"""Moodle's zip of feedback files ("Upload multiple feedback files in a zip").

By mod/assign/feedback/file/importziplib.php: the first part of a path that is
`<name>_<participant>_<type>_<plugin>` says whose the file is, and only the participant's number
counts; the name has no underscore. The number is that of the grading worksheet.
"""

from __future__ import annotations

import unicodedata

from grader.base.plain_text import visible
from grader.batch.model import ClassResult, GradebookEntry
from grader.batch.sheet import Filled
from grader.batch.systems.feedback_zip import PAGE, PageOf, zip_of

OUTPUT = "moodle-feedback.zip"
PLUGIN = "assignsubmission_file"
UNSAFE = frozenset('_/\\:*?"<>|~')
MOST = 60  # characters of a name


def write(result: ClassResult, page_of: PageOf) -> Filled:
    """Return the zip: one page for each student who has a grade and a number of Moodle's."""
    files: dict[str, bytes] = {}
    without: list[str] = []
    for entry in result.entries:
        if entry.final is None or entry.keeps_grade:
            continue
        if not entry.student.key.isdecimal():
            without.append(entry.student.name or entry.student.key)
            continue
        files[f"{_name(entry)}_{entry.student.key}_{PLUGIN}/{PAGE}"] = page_of(entry)[0]
    note = f"not in {OUTPUT}, because Moodle's number is not known: {', '.join(without)}"
    return Filled(zip_of(files), (note,) if without else ())


def _name(entry: GradebookEntry) -> str:
    text = visible(unicodedata.normalize("NFC", entry.student.name))
    name = " ".join("".join(" " if letter in UNSAFE else letter for letter in text).split())
    return name[:MOST].strip(". ") or "Participant"
