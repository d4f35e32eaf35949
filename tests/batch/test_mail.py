"""`grader mail`: drafts that a mail program opens; nothing is sent."""

from __future__ import annotations

import email
import mailbox
from email import policy
from email.message import EmailMessage
from pathlib import Path

import pytest

from tests.batch.archives import write
from tests.batch.downloads import scored
from tests.batch.stub_run import Run, grade_all
from tests.processes import grader, run

pytestmark = pytest.mark.prefix
ROSTER = """id,name,email
1,김민지,minji@example.org
2,Ann Lee,"ann@example.org\r\nBcc: all@example.org"
3,Bob Ray,bob@example.org
4,Cleo Poe,
"""


@pytest.fixture
def marked(tmp_path: Path) -> Run:
    for name in ("김민지", "Ann Lee", "Bob Ray", "Cleo Poe"):
        write(tmp_path / "class" / name, scored(60))
    (tmp_path / "roster.csv").write_text(ROSTER, newline="")
    return grade_all(tmp_path / "class", tmp_path / "out", "--roster", tmp_path / "roster.csv")


def messages(place: Path) -> list[EmailMessage]:
    def read(raw: object) -> EmailMessage:
        return email.message_from_bytes(raw.read(), policy=policy.default)  # type: ignore[attr-defined]

    return list(mailbox.mbox(place, factory=read))  # type: ignore[arg-type]


def test_each_student_with_an_address_gets_a_draft(marked: Run) -> None:
    text = "Dear all,\nFrom now on: ask me.\n안녕하십니까"
    command = grader("mail", "--out", marked.out, "--text", text, "--page")
    tried = run([*command, "--dry-run"])
    assert tried.stdout.splitlines()[-1] == "2 drafts would be written; nothing was"
    assert not (marked.out / "drafts.mbox").exists()
    done = run(command)
    assert done.returncode == 0, done.stderr
    assert "left out: Cleo Poe: no address is known" in done.stderr
    assert "left out: Ann Lee: 'ann@example.org" in done.stderr
    found = messages(marked.out / "drafts.mbox")
    assert [message["To"] for message in found] == ["minji@example.org", "bob@example.org"]
    assert all(message["Bcc"] is None for message in found)
    body = found[0].get_body(("plain",))
    assert body is not None
    assert body.get_content().startswith(f"{text}\n\n# 김민지: ")
    assert "60 of 100 points" in body.get_content()
    (page,) = found[0].iter_attachments()
    assert page.get_filename() == "feedback.html"
    assert page.get_content().startswith("<!doctype html>")
    assert (marked.out / "drafts.mbox").stat().st_mode & 0o077 == 0
    # one student, only the instructor's words
    one = run(grader("mail", "Bob Ray", "--out", marked.out, "--text", "Come by.", "--no-feedback"))
    assert one.returncode == 0, one.stderr
    (only,) = messages(marked.out / "drafts.mbox")
    assert only.get_content() == "Come by.\n"
