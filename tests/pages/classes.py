"""Results of classes for the tests of outputs: from real reports, small, large or hostile."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from datetime import datetime, timedelta, timezone
from pathlib import Path
from typing import Any

from grader.batch.model import ClassResult, GradebookEntry, Override, Student
from grader.batch.systems.known import SYSTEMS
from grader.report.model import CheckResult, Report
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.corpus.right import RIGHT
from tests.recorded import mark

DUE = datetime(2026, 11, 20, 22, 0, tzinfo=timezone.utc)
# of the corpus: right, wrong text, does not start, does not build, too fast, on the wall clock
REAL = (
    "solution",
    "text_capital",
    "module_misspelt",
    "setup_syntax_error",
    "period_half",
    "sleep_loop",
)
FIRST = ("Ann", "Bela", "Chidi", "Dörte", "Émile", "Farah", "Goran", "Hana", "Ines", "José")
LAST = ("Lee", "Nagy", "Okafor", "Weiß", "Zola", "Aziz", "Ilić", "Mori", "Costa", "Núñez")
# fields with fixed values, which are not texts of a student
FIXED = {"status", "visibility", "origin", "modes", "ros", "sandbox", "clock", "lang"}
FIXED |= {"lab", "before_due", "after_due"}


def student(number: int) -> Student:
    name = f"{FIRST[number % 10]} {LAST[number // 10 % 10]}"
    return Student(
        key=str(1000 + number),
        name=name if number < 100 else f"{name} {number}",
        email=f"student{number}@example.org",
        username=f"user{number}",
        id_number=str(70_000 + 7 * number),
        section="AB"[number % 2],
    )


def entry(number: int, report: Report | None, **fields: Any) -> GradebookEntry:
    usual: dict[str, Any] = {
        "student": student(number),
        "status": "graded",
        "report": report,
        "score": report.score if report else None,
        "final": report.score if report else None,
        "submitted": DUE - timedelta(hours=number % 50),
    }
    return GradebookEntry(**(usual | fields))


def result(entries: Sequence[GradebookEntry], **fields: Any) -> ClassResult:
    usual: dict[str, Any] = {
        "title": "Robotics 1, winter term",
        "assignment": "hello_time",
        "system": SYSTEMS["moodle"],
        "entries": tuple(entries),
        "max_score": 100,
        "distros": ("jazzy",),
        "started": DUE + timedelta(hours=12),
        "seconds": 412.0,
    }
    return ClassResult(**(usual | fields))


def marked(name: str, folder: Path) -> Report:
    """Return the report of one package of the corpus."""
    package = next(package for package in (*RIGHT, *BROKEN) if package.name == name)
    return mark(write(package, folder))


def mixed(reports: Sequence[Report], count: int) -> ClassResult:
    """Return a class with every kind of student: late, missing, ungradable, corrected, …"""
    entries = [_of_kind(number, reports[number % len(reports)]) for number in range(count)]
    keys = [e.student.key for e in entries if e.report is not None]
    pair = (keys[0], keys[len(reports)])
    entries = [
        dataclasses.replace(e, same_as=tuple(k for k in pair if k != e.student.key))
        if e.student.key in pair
        else e
        for e in entries
    ]
    return result(entries, identical=(pair,), notes=("notes.txt lies beside the submissions",))


def _of_kind(number: int, report: Report) -> GradebookEntry:
    nothing: dict[str, Any] = {"submitted": None}
    kind = number % 20
    if kind == 7:
        return entry(number, None, **nothing, status="missing")
    if kind == 13:
        problem = "the archive ends in the middle: not a zip file any more"
        return entry(number, None, **nothing, status="ungradable", problem=problem)
    if kind == 17:
        return entry(number, None, **nothing, status="pending")
    if kind == 3:
        late: dict[str, Any] = {"penalty": 5, "late_seconds": 7_800, "attempt": 2, "attempts": 3}
        return entry(number, report, final=max(report.score - 5, 0), **late)
    if kind == 9:
        because = "shown to work in the laboratory"
        correction = Override(str(1000 + number), "run.output", 10, because, by="M. Curie", at=DUE)
        better = report.score + 10 - report.check("run.output").score
        return entry(number, report, overrides=(correction,), score=better, final=better)
    if kind == 5:
        hidden = report.check("run.logger").model_copy(update={"visibility": "hidden"})
        report = _with(report, hidden)
    if kind == 11:
        open_ = report.check("run.period").model_copy(
            update={"status": "inconclusive", "score": 0, "actual": "the machine was too busy"}
        )
        report = _with(report, open_)
    return entry(number, report)


def _with(report: Report, changed: CheckResult) -> Report:
    checks = [changed if check.id == changed.id else check for check in report.checks]
    return report.model_copy(update={"checks": checks})


def with_every_text(report: Report, text: str) -> Report:
    """Return the report with `text` in place of every text that has no fixed values."""
    return Report.model_validate(_replace_texts(report.model_dump(by_alias=True), text))


def _replace_texts(part: Any, text: str, name: str = "") -> Any:
    if isinstance(part, Mapping):
        return {key: _replace_texts(value, text, key) for key, value in part.items()}
    if isinstance(part, list):
        return [_replace_texts(value, text, name) for value in part]
    return text if isinstance(part, str) and name not in FIXED else part
