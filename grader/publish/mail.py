"""E-mail drafts for the students of a class: an mbox file that mail programs import."""

from __future__ import annotations

import csv
import io
import mailbox
import re
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from email.message import EmailMessage
from email.policy import default
from pathlib import Path

from grader.base.errors import SurroundingsError, UsageError
from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator
from grader.base.plain_text import one_line, visible
from grader.base.shown import shown
from grader.batch.find_student import find_student
from grader.batch.model import Student
from grader.publish.gradebooks import FEEDBACK_LIST

DRAFTS = "drafts.mbox"
ADDRESS = re.compile(
    r"[^\s@<>()\[\],;:\\\"]+@[^\s@<>()\[\],;:\\\"]+\.[^\s@<>()\[\],;:\\\"]+", re.ASCII
)
SAFE_PATH = re.compile(r"feedback/[^/\\]+\.(?:html|md)")
MOST_BYTES = 5_000_000  # of one page


@dataclass(frozen=True)
class Feedback:
    """A student's feedback files, and the language of their text."""

    student: Student
    lang: str
    page: Path
    text: Path


@dataclass(frozen=True)
class Letter:
    """What the drafts have in common: `text` comes first, in the instructor's words."""

    title: str
    text: str = ""
    sender: str = ""
    has_feedback: bool = True
    has_page: bool = False


def read_feedback_list(out: Path) -> list[Feedback]:
    """Return the feedback that the last run wrote; raise UsageError if there is none."""
    place = out / FEEDBACK_LIST
    try:
        rows = list(csv.DictReader(io.StringIO(place.read_text(encoding="utf-8-sig"))))
    except (OSError, ValueError):
        raise UsageError(
            f"there is no {shown(str(place))}",
            remedy="Mark the class first: grader grade-all. Name its folder with --out.",
        ) from None
    return [_feedback(out, row) for row in rows]


def _feedback(out: Path, row: dict[str, str]) -> Feedback:
    page, text = row.get("page") or "", row.get("text") or ""
    if not SAFE_PATH.fullmatch(page) or not SAFE_PATH.fullmatch(text):
        raise UsageError(f"{FEEDBACK_LIST} was changed: '{one_line(page, most=80)}'")
    student = Student(*((row.get(name) or "").lstrip("'") for name in ("key", "name", "email")))
    return Feedback(student, row.get("language") or "en", out / page, out / text)


def chosen(
    known: Sequence[Feedback], words: Collection[str], keys: Collection[str] | None
) -> list[Feedback]:
    """Return the feedback of the students that `words` name, or of those with `keys`; else all."""
    if words:
        students = [one.student for one in known]
        keys = {find_student(word, students).key for word in words}
    return [one for one in known if keys is None or one.student.key in keys]


def drafts(
    class_: Sequence[Feedback], letter: Letter, left_out: Callable[[Student, str], None]
) -> Iterator[EmailMessage]:
    """Yield a message for each student; `left_out` is told who gets none, and why."""
    for one in class_:
        if not one.student.email:
            left_out(one.student, "no address is known")
        elif not ADDRESS.fullmatch(one.student.email):
            left_out(one.student, f"'{one_line(one.student.email, most=80)}' is no address")
        else:
            yield _draft(one, letter)


def _draft(one: Feedback, letter: Letter) -> EmailMessage:
    message = EmailMessage(policy=default)
    translate = Translator(one.lang)
    message["To"] = one.student.email
    if letter.sender:
        message["From"] = letter.sender
    title = one_line(letter.title, most=200)
    message["Subject"] = translate(say("Your feedback: {title}", title=title))
    message["X-Unsent"] = "1"  # Outlook opens it to be sent
    parts = [visible(letter.text).strip(), _read(one.text).strip() if letter.has_feedback else ""]
    message.set_content("\n\n".join(part for part in parts if part) + "\n", cte="base64")
    if letter.has_page:
        content = _read(one.page).encode()
        message.add_attachment(content, maintype="text", subtype="html", filename="feedback.html")
    return message


def _read(path: Path) -> str:
    try:
        with path.open("rb") as file:
            return file.read(MOST_BYTES).decode("utf-8", errors="replace")
    except OSError as error:
        raise UsageError(
            f"{shown(str(path))} cannot be read: {error.strerror}",
            remedy="Run the same `grader grade-all` again: it writes the feedback.",
        ) from None


def mbox_of(messages: Sequence[EmailMessage], folder: Path) -> bytes:
    """Return the messages as an mbox file; it is made in `folder`."""
    place = folder / f".{DRAFTS}.new"
    try:
        place.unlink(missing_ok=True)
        box = mailbox.mbox(place)
        for message in messages:
            kept = mailbox.mboxMessage(message)
            kept.set_from("grader", (2000, 1, 1, 0, 0, 0, 5, 1, 0))
            kept.set_flags("D")
            box.add(kept)
        box.close()
        return place.read_bytes()
    except OSError as error:
        raise SurroundingsError(
            f"{shown(str(place))} cannot be written: {error.strerror}"
        ) from error
    finally:
        place.unlink(missing_ok=True)
