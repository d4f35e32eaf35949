"""What a page on one screen says beside the verdict: commands, links, and what comes next."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import quote

from grader.base.i18n.message import say
from grader.cli.called import Commands
from grader.course.after import after_lesson
from grader.report.model import Report

if TYPE_CHECKING:
    from grader.report.one_screen import Lead


def lead_of(
    report: Report, commands: Commands, *, written: Path | None, more: str, own_code: bool
) -> Lead:
    """Return what the page says about commands; `written` is the report's file.

    `own_code`: a student reads it, who gets to know what comes after a success.
    """
    from grader.report.one_screen import Lead  # noqa: PLC0415 - rich costs 35 ms

    after = after_success(report, commands) if own_code and report.all_passed else []
    pages = {text: text for _, text in after if text.startswith("https://")}
    return Lead(
        own_code=own_code,
        around=3 + own_code + (report.environment.sandbox == "none"),
        rest=commands.rest,
        more=more,
        report=str(written or ""),
        after=after,
        links={**dict(_links(report, written)), **pages},
    )


def after_success(report: Report, commands: Commands) -> list[tuple[str, str]]:
    """Return labels and texts: what was learned, where to read on, and the next lesson."""
    after = after_lesson(report.assignment.id, lang=report.lang, distro=report.environment.distro)
    return [
        (label, text)
        for label, text in (
            (say("learned"), after.learned),
            (say("read on"), after.documentation),
            (say("next"), commands.next_lesson(after)),
        )
        if text
    ]


def _links(report: Report, written: Path | None) -> Iterator[tuple[str, str]]:
    """Yield the paths that the page may name, and their URLs."""
    if written is not None:
        yield str(written), url_of(written)
    folder = Path(report.submission.path)
    package = report.submission.package or ""
    for file in {check.where.file for check in report.checks if check.where is not None}:
        for place in (folder, folder / package, folder / "src" / package):
            if (place / file).is_file():
                yield file, url_of(place / file)
                break


def url_of(path: Path) -> str:
    """Return the URL of a file on this machine, as terminals open it."""
    return f"file://{socket.gethostname()}{quote(str(path.absolute()))}"
