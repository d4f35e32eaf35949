"""The result of a class: what each student gets, from the ledger and what was handed in."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from functools import partial

from grader.batch.handed_in_before import HandedInBefore
from grader.batch.intake import Item
from grader.batch.ledger import Ledger
from grader.batch.ledger_rows import HandedInRow, VerdictRow, path_text
from grader.batch.model import ClassFolder, ClassResult, Elsewhere, Entry, Override, Student
from grader.batch.policy import Attempt, standing
from grader.batch.similar import groups
from grader.course.assignment import Assignment
from grader.report.model import Report

MOST_SAME = 10  # of the others with the same content, in one student's line
GONE = "handed in before, and no longer in the class' folder"


@dataclass(frozen=True)
class Found:
    """One attempt of a student: when it was handed in (else first seen), and its verdict's number."""

    at: datetime | None
    attempt: Attempt
    submission: str
    verdict: int | None


def class_result(
    ledger: Ledger,
    folder: ClassFolder,
    items: Sequence[Item],
    assignment: Assignment,
    *,
    distro: str,
    lang: str = "en",
    started: datetime | None = None,
    seconds: float = 0,
) -> ClassResult:
    """Return the result of a class as the ledger has it now; the ledger must stay open as
    long as its reports are asked for. `lang` is the language where there is no report.
    """
    verdicts = ledger.verdicts()
    overrides = defaultdict(list)
    for override in ledger.overrides(assignment.id):
        overrides[override.student].append(override)
    seen = {(row.student, row.submission): row for row in ledger.seen(assignment.id)}
    earlier = _earlier(ledger, items, seen.values(), assignment.id)
    own: dict[str, list[Item]] = defaultdict(list)
    students: dict[str, Student] = {}
    for item in items:
        own[item.student].append(item)
        students.setdefault(item.student, item.handed_in.student)
    entries: list[Entry] = []
    submissions: dict[str, str] = {}
    for key, student in students.items():
        found = [_of_item(ledger, item, verdicts, seen) for item in own[key]]
        found += [_of_row(ledger, row, assignment.id) for row in earlier.get(key, ())]
        entry, counts = _entry(student, found, overrides[key], assignment, lang)
        if counts is not None:
            submissions[key] = counts.submission
        verdict = counts.verdict if counts is not None else None
        entries.append(replace(entry, report=None, verdict=verdict))
    before = HandedInBefore(ledger, assignment.id, students, earlier)
    for student in folder.missing:
        known = before.as_known(student)
        found = [_of_row(ledger, row, assignment.id) for row in earlier.get(known.key, ())]
        where = folder.elsewhere.get(student.key)
        entry, counts = _entry(known, found, overrides[known.key], assignment, lang, where)
        verdict = counts.verdict if counts is not None else None
        entries.append(replace(entry, report=None, verdict=verdict))
    identical = _identical(ledger, submissions, _paths(items))
    return ClassResult(
        title=assignment.title,
        assignment=assignment.id,
        system=folder.system,
        entries=tuple(_with_reports(ledger, entries, identical)),
        max_score=assignment.max_score,
        distros=(distro,),
        started=started,
        seconds=seconds,
        notes=folder.notes,
        identical=identical,
    )


def _entry(
    student: Student,
    found: list[Found],
    overrides: Sequence[Override],
    assignment: Assignment,
    lang: str,
    elsewhere: Elsewhere | None = None,
) -> tuple[Entry, Found | None]:
    """Return a student's entry, and which attempt it stands on."""
    dated = sorted(found, key=lambda f: (f.at is not None, f.at.timestamp() if f.at else 0))
    attempts = [replace(f.attempt, number=n) for n, f in enumerate(dated, start=1)]
    policy, most = assignment.policy, assignment.max_score
    entry = standing(student, attempts, overrides, policy, most, elsewhere=elsewhere)
    if entry.report is None:
        return replace(entry, lang=lang), None
    return replace(entry, lang=entry.report.lang), dated[entry.attempt - 1]


def _of_item(
    ledger: Ledger,
    item: Item,
    verdicts: Mapping[tuple[str, str], VerdictRow],
    seen: Mapping[tuple[str, str], HandedInRow],
) -> Found:
    given = item.handed_in
    row = verdicts.get((item.student, item.key))
    notes = list(given.notes)
    fault = ledger.fault(item.student, item.key) if item.key else item.fault
    if fault and row is not None:
        notes.append(f"marking it again failed, the verdict before stands: {fault}")
    attempt = Attempt(
        number=given.attempt,
        submitted=given.submitted,
        late=given.late,
        report=_report(ledger, row),
        problem=item.problem,
        notes=tuple(notes),
        fault=fault,
    )
    noted = seen.get((item.student, item.submission))
    at = given.submitted or (noted.first_seen if noted else None)
    return Found(at, attempt, item.submission, row.id if row else None)


def _of_row(ledger: Ledger, seen: HandedInRow, assignment: str) -> Found:
    row = ledger.verdict_of(assignment, seen.student, seen.submission)
    attempt = Attempt(
        number=0,
        submitted=seen.submitted,
        late=seen.late,
        report=_report(ledger, row),
        problem="",
        notes=(GONE,),
    )
    return Found(
        seen.submitted or seen.first_seen, attempt, seen.submission, row.id if row else None
    )


def _earlier(
    ledger: Ledger, items: Sequence[Item], seen: Iterable[HandedInRow], assignment: str
) -> dict[str, list[HandedInRow]]:
    """Return what students handed in before that is no longer there, and was marked.

    What lies in the folder is only theirs whose it is now: a group's submission that was marked
    without a roster is no attempt of the participant who has the group's number.
    """
    here = {(item.student, item.submission) for item in items}
    places: dict[str, set[str]] = defaultdict(set)
    for item in items:
        places[path_text(item.handed_in.path)].add(item.student)
    found: dict[str, list[HandedInRow]] = defaultdict(list)
    for row in seen:
        others = row.path in places and row.student not in places[row.path]
        if (row.student, row.submission) in here or others:
            continue
        if ledger.verdict_of(assignment, row.student, row.submission) is not None:
            found[row.student].append(row)
    return found


def _report(ledger: Ledger, row: VerdictRow | None) -> Report | None:
    return None if row is None else ledger.report(row.id)


def _paths(items: Iterable[Item]) -> dict[tuple[str, str], str]:
    """Return where each student's contents lie."""
    return {(i.student, i.submission): path_text(i.handed_in.path) for i in items if i.submission}


def _identical(
    ledger: Ledger, submissions: Mapping[str, str], paths: Mapping[tuple[str, str], str]
) -> tuple[tuple[str, ...], ...]:
    """Return who has the same content; the members of one group have handed in only once."""
    known = ledger.fingerprints()
    found = groups({key: known.get(submission, "") for key, submission in submissions.items()})

    def place(key: str) -> str:
        return paths.get((key, submissions[key]), key)

    return tuple(group for group in found if len({place(key) for key in group}) > 1)


def _with_reports(
    ledger: Ledger, entries: Sequence[Entry], identical: Sequence[Sequence[str]]
) -> Iterator[Entry]:
    """Yield the entries with what fetches each report, and with whose submission is the same."""
    # each names a few of the others: all of them, for all of a large group, is a number squared
    others = {
        key: tuple(other for other in group[: MOST_SAME + 1] if other != key)[:MOST_SAME]
        for group in identical
        for key in group
    }
    for entry in entries:
        fetch = None if entry.verdict is None else partial(ledger.report, entry.verdict)
        yield replace(entry, report=fetch, same_as=others.get(entry.student.key, ()))
