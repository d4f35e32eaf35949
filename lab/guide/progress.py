"""A student's progress: a small file in the workspace, replaced as a whole.

It counts the hints and keeps the best result of `check`. It gives no points: nothing in it goes to
the instructor. Newer versions may add keys: unknown ones are kept.
"""

from __future__ import annotations

import json
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from grader.base.folder import Folder

FOLDER = ".lab"
FILE = "progress.json"
LESSON_FILE = "lesson"
"""The file of the lesson that the student has gone on to (`grader.course.find.GONE_ON`)."""
SCHEMA = 1
MOST_BYTES = 1_000_000


class Open(BaseModel):
    """A part of the file; unknown keys are kept."""

    model_config = ConfigDict(extra="allow")


class FailedCheck(Open):
    """The failure to look at first: what is wrong, where, and the hints about it.

    `kind` is the kind of check, `mistake` what it recognised, `file` the file that is to be changed.
    """

    id: str
    found: str
    kind: str = ""
    mistake: str = ""
    file: str = ""
    line: int = 0
    hints: list[str] = Field(default_factory=list)
    difference: str = ""


class LessonProgress(Open):
    """What is known of one lesson; `hints` counts those that were shown, by task.

    `passed` is whether it ever had full marks. `sha256` is of the files that the last check read: what
    it found holds as long as they are the same. `all_passed` and `failed` are of that check.
    `step` is the position (from 1) that the student was told last, 0 if none. `seen` are the
    conditions about the ROS graph that once held, each with the name of its node or topic. `student`
    is the name for the archive.
    """

    score: float = 0
    max_score: float = 0
    passed: bool = False
    checked: str = ""
    sha256: str = ""
    all_passed: bool = False
    submitted: str = ""
    student: str = ""
    step: int = 0
    failed: FailedCheck | None = None
    hints: dict[str, int] = Field(default_factory=dict)
    seen: list[str] = Field(default_factory=list)


class Progress(Open):
    """The file: the lessons by the id of their assignment."""

    schema_: int = Field(default=SCHEMA, alias="schema")
    lessons: dict[str, LessonProgress] = Field(default_factory=dict)

    def of(self, lesson: str) -> LessonProgress:
        """Return what is known of a lesson; something empty that can be changed if it is new."""
        return self.lessons.setdefault(lesson, LessonProgress())


def archive_of(kept: LessonProgress, saved: float) -> str:
    """Return the archive that was made last, if no file was `saved` after it; else "".

    `submitted` has its file and, behind a space, the time in whole seconds.
    """
    file, made = submitted(kept)
    return file if made is not None and int(saved) <= made.timestamp() else ""


def submitted(kept: LessonProgress) -> tuple[str, datetime | None]:
    """Return the archive that was made last, and when, in this machine's time; ("", None) if none."""
    file, _, time = kept.submitted.rpartition(" ")
    try:
        return file, datetime.fromisoformat(time).astimezone()
    except ValueError:
        return kept.submitted, None


def read_progress(workspace: Path) -> Progress:
    """Return the progress in a workspace; empty if there is none or it cannot be read."""
    try:
        with (workspace / FOLDER / FILE).open("rb") as stream:
            return Progress.model_validate(json.loads(stream.read(MOST_BYTES)))
    except (OSError, ValueError, ValidationError, RecursionError):
        return Progress()


def keep_progress(workspace: Path, lesson: str, **changes: Any) -> LessonProgress:
    """Change what is known of a lesson, and return it.

    A file that cannot be read is kept beside the new one, as `progress.json.unreadable`. Raises
    OSError if the workspace cannot be written to.
    """
    with Folder.open(workspace) as root, root.private(FOLDER) as folder:
        folder.lock()
        folder.sweep()
        old = folder.read(FILE)
        progress = read_progress(workspace)
        if old is not None and not progress.lessons and not _is_empty(old):
            folder.replace(f"{FILE}.unreadable", old)
        changed = progress.of(lesson).model_copy(update=changes)
        progress.lessons[lesson] = changed
        text = json.dumps(progress.model_dump(by_alias=True), indent=1, ensure_ascii=False)
        folder.replace(FILE, f"{text}\n".encode())
    return changed


def _is_empty(text: bytes) -> bool:
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        return False
    return isinstance(found, dict) and not found.get("lessons")


def now() -> str:
    """Return the time in UTC, as the file has it."""
    return datetime.now(timezone.utc).isoformat(timespec="seconds")
