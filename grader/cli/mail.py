"""The command that writes e-mail drafts for the students of a class."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.base.errors import UsageError
from grader.cli import options

if TYPE_CHECKING:
    from grader.batch.model import Student

MOST_NAMED = 20
GIVE = "Addresses are read from the roster or the worksheet: give one to grade-all."


@click.command("mail")
@click.argument("students", nargs=-1, metavar="[STUDENT]...")
@click.option(
    "--mistake", default="", metavar="ID", help="Only the students whose verdict has this mistake."
)
@click.option("--text", default="", help="What you write; it comes before the feedback.")
@click.option("--no-feedback", is_flag=True, help="Only your text.")
@click.option("--page", is_flag=True, help="Attach each student's page (HTML).")
@click.option("--sender", default="", metavar="ADDRESS", help="Your address (From).")
@click.option("-n", "--dry-run", is_flag=True, help="Only show who would get a draft.")
@options.assignment
@options.keys
@options.ledger
@options.class_out
def mail(
    students: tuple[str, ...],
    mistake: str,
    text: str,
    no_feedback: bool,
    page: bool,
    sender: str,
    dry_run: bool,
    assignment: str | None,
    keys: Path | None,
    ledger: Path | None,
    out: Path | None,
) -> int:
    """Write e-mail drafts for the students of a class into drafts.mbox: it sends nothing.

    Open the file with your mail program (Thunderbird, Apple Mail, mutt) and send what you want to.
    Each draft has the student's feedback as text. Without STUDENT it is the whole class.
    """
    from grader.batch.given_files import write_private  # noqa: PLC0415 - keeps --help fast
    from grader.batch.ledger import Ledger  # noqa: PLC0415
    from grader.batch.mistake_group import mistake_group  # noqa: PLC0415
    from grader.batch.override import find_ledger  # noqa: PLC0415
    from grader.publish import mail as letters  # noqa: PLC0415
    from grader.verdict.order import load_with_hidden  # noqa: PLC0415

    if students and mistake:
        raise UsageError("give STUDENT or --mistake, not both")
    if no_feedback and not text.strip():
        raise UsageError("--no-feedback needs your text: --text TEXT")
    if sender and not letters.ADDRESS.fullmatch(sender):
        raise UsageError(f"'{sender}' is no address (--sender)")
    wanted = load_with_hidden(assignment, keys)
    place = find_ledger(ledger, out, Path.cwd())
    chosen_keys = None
    if mistake:
        with Ledger(place, makes=False) as opened:
            group = mistake_group(opened, wanted.id, mistake)
            chosen_keys = {student.key for student in group.students}
    folder = out or place.parent
    class_ = letters.chosen(letters.read_feedback_list(folder), students, chosen_keys)
    letter = letters.Letter(wanted.title, text, sender, not no_feedback, page)
    without: list[str] = []

    def left_out(student: Student, why: str) -> None:
        without.append(f"{student.name or student.key}: {why}")

    messages = list(letters.drafts(class_, letter, left_out))
    for line in without[:MOST_NAMED]:
        click.echo(f"left out: {line}", err=True)
    if without[MOST_NAMED:]:
        click.echo(f"left out: {len(without) - MOST_NAMED} more", err=True)
    if dry_run:
        for message in messages:
            click.echo(f"draft to {message['To']}")
        click.echo(f"{len(messages)} drafts would be written; nothing was")
        return 0
    if not messages:
        raise UsageError("no draft was written: no student has an address", remedy=GIVE)
    write_private(folder, "", letters.DRAFTS, letters.mbox_of(messages, folder))
    click.echo(f"{len(messages)} drafts: {folder / letters.DRAFTS} (nothing was sent)")
    return 0
