"""Canvas' zip of marked submissions ("Re-Upload Submissions").

By `infer_comment_context_from_filename` of app/models/assignment.rb: the first two parts of a name
that are numbers are the user and the attachment; the attachment must be one of this submission, and
the comment's file gets that attachment's name. So a file has the name as downloaded, and the form
that this name promises: a zip in place of a zip.
"""

from __future__ import annotations

from grader.batch.model import ClassResult
from grader.batch.sheet import Filled
from grader.batch.systems.feedback_zip import PageOf, in_place_of, zip_of

OUTPUT = "canvas-feedback.zip"


def write(result: ClassResult, page_of: PageOf) -> Filled:
    """Return the zip: one file for each student who has a grade and handed in a file."""
    files: dict[str, bytes] = {}
    without: list[str] = []
    for entry in result.entries:
        if entry.final is None or entry.keeps_grade:
            continue
        if not entry.files:
            if entry.report is not None:
                without.append(entry.student.name or entry.student.key)
            continue
        page, text = page_of(entry)
        files[entry.files[0]] = in_place_of(entry.files[0], page, text)
    note = f"not in {OUTPUT}, because the name of the file is not known: {', '.join(without)}"
    return Filled(zip_of(files), (note,) if without else ())
