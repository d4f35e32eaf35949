"""The result of a class: what each student gets, from the ledger and the submissions."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime, timezone
from functools import partial

from grader.base.i18n.message import say
from grader.base.shown import utf8_name
from grader.batch.correction import holds
from grader.batch.earlier_submissions import EarlierSubmissions
from grader.batch.intake import IntakeItem
from grader.batch.ledger import HandedInRow, Ledger, VerdictRow
from grader.batch.model import (
    ClassFolder,
    ClassResult,
    Elsewhere,
    GradebookEntry,
    Grant,
    Override,
    Remark,
    Student,
)
from grader.batch.policy import Attempt, standing
from grader.batch.similar import groups
from grader.course.assignment import Assignment
from grader.course.policy import Policy
from grader.report.model import Report

MOST_SAME = 10  # students with the same content that are named for one student
GONE = say("handed in earlier, and no longer in the class folder")


@dataclass(frozen=True)
class DatedAttempt:
    """An attempt, when it was handed in (or first seen), and the id of its verdict."""

    at: datetime | None
    attempt: Attempt
    submission: str
    verdict: int | None


def class_result(
    ledger: Ledger,
    folder: ClassFolder,
    items: Sequence[IntakeItem],
    assignment: Assignment,
    *,
    distro: str,
    lang: str = "en",
    started: datetime | None = None,
    seconds: float = 0,
) -> ClassResult:
    """Return the result of a class from what the ledger has now.

    The ledger must stay open while the result's reports are read. `lang` is the language of the
    class' pages, and of a student without a report.
    """
    verdicts, remarks = ledger.verdicts(), ledger.remarks(assignment.id)
    now = started or _now()

    def grants(key: str) -> Grant:
        return folder.grants.get(key, Grant())

    overrides = defaultdict(list)
    for override in ledger.overrides(assignment.id):
        overrides[override.student].append(override)
    rows = {(row.student, row.submission): row for row in ledger.handed_in(assignment.id)}
    earlier = _earlier(ledger, items, rows.values(), assignment.id)
    own: dict[str, list[IntakeItem]] = defaultdict(list)
    students: dict[str, Student] = {}
    for item in items:
        own[item.student].append(item)
        students.setdefault(item.student, item.handed_in.student)
    entries: list[GradebookEntry] = []
    submissions: dict[str, str] = {}
    for key, student in students.items():
        # what is no longer in the folder came first, if the times are the same
        found = [_of_row(ledger, row, assignment.id) for row in earlier.get(key, ())]
        found += [_of_item(ledger, item, verdicts, rows) for item in own[key]]
        entry, counts = _entry(
            ledger, student, found, overrides[key], assignment, lang, grant=grants(key)
        )
        entry = _without_owner(entry, own[key][0].handed_in.unclear)
        if counts is not None:
            submissions[key] = counts.submission
        entry = _with_remark(entry, counts, remarks.get(key))
        entry = replace(entry, files=_files(own[key], counts))
        verdict = counts.verdict if counts is not None else None
        entries.append(replace(entry, report=None, verdict=verdict))
    recorded = EarlierSubmissions(ledger, assignment.id, students, earlier)
    for student in folder.missing:
        known = recorded.with_known_key(student)
        found = [_of_row(ledger, row, assignment.id) for row in earlier.get(known.key, ())]
        elsewhere = folder.elsewhere.get(student.key)
        entry, counts = _entry(
            ledger,
            known,
            found,
            overrides[known.key],
            assignment,
            lang,
            elsewhere=elsewhere,
            grant=grants(student.key),
        )
        entry = _with_remark(entry, counts, remarks.get(known.key))
        verdict = counts.verdict if counts is not None else None
        entries.append(replace(entry, report=None, verdict=verdict))
    # until the own due date, what helps with the next attempt is as before the due date
    entries = [
        replace(one, detail=assignment.feedback.handed_back(one.due, now))
        if one.is_extended
        else one
        for one in entries
    ]
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
        unclear=folder.unclear,
        detail=assignment.feedback.handed_back(assignment.policy.deadline, now),
        lang=lang,
    )


def _files(items: Sequence[IntakeItem], counts: DatedAttempt | None) -> tuple[str, ...]:
    """Return the downloaded names of the attempt that counts; of the last one without a report."""
    fit = [item for item in items if counts is None or item.submission == counts.submission]
    return fit[-1].handed_in.files if fit else ()


def _with_remark(
    entry: GradebookEntry, counts: DatedAttempt | None, remark: Remark | None
) -> GradebookEntry:
    """Return the entry with what the instructor wrote, if that is about what counts now."""
    if remark is None:
        return entry
    if remark.submission == (counts.submission if counts is not None else ""):
        return replace(entry, remark=remark)
    note = say("your comment on another submission is not shown: {text}", text=remark.text)
    return replace(entry, notes=(*entry.notes, note))


def _without_owner(entry: GradebookEntry, why: str) -> GradebookEntry:
    """Return the entry without a grade if it is not known whose the submission is.

    The instructor's own points for it stay.
    """
    if not why or any(override.check == "" for override in entry.overrides):
        return entry
    return replace(entry, status="unclear", final=None, penalty=0, notes=(*entry.notes, why))


def _local(at: datetime | None, policy: Policy) -> datetime | None:
    """Return an instant in the time zone of the class, if it has one."""
    return at if at is None or policy.zone is None else at.astimezone(policy.zone)


def _now() -> datetime:
    return datetime.now(timezone.utc)


def _entry(
    ledger: Ledger,
    student: Student,
    found: list[DatedAttempt],
    overrides: Sequence[Override],
    assignment: Assignment,
    lang: str,
    *,
    grant: Grant,
    elsewhere: Elsewhere | None = None,
) -> tuple[GradebookEntry, DatedAttempt | None]:
    """Return a student's entry, and the attempt that counts (None without a report)."""
    dated = sorted(found, key=lambda f: (f.at is not None, f.at.timestamp() if f.at else 0))
    attempts = [replace(f.attempt, number=n) for n, f in enumerate(dated, start=1)]
    attempts, rest = _with_overrides(ledger, dated, attempts, overrides)
    policy, most = assignment.policy, assignment.max_score
    entry = standing(student, attempts, rest, policy, most, elsewhere=elsewhere, grant=grant)
    entry = replace(entry, submitted=_local(entry.submitted, policy), due=_local(entry.due, policy))
    if entry.report is None:
        return replace(entry, lang=lang), None
    return replace(entry, lang=entry.report.lang), dated[entry.attempt - 1]


def _with_overrides(
    ledger: Ledger,
    dated: Sequence[DatedAttempt],
    attempts: Sequence[Attempt],
    overrides: Sequence[Override],
) -> tuple[list[Attempt], list[Override]]:
    """Return the attempts with the corrections of their verdicts, and the other corrections."""
    own: dict[int, list[Override]] = defaultdict(list)
    rest: list[Override] = []
    for override in overrides:
        places = [
            n for n, one in enumerate(dated) if holds(ledger, override, one.verdict, one.submission)
        ]
        # (without any verdict, a correction is about the last attempt)
        (own[places[-1]] if places else rest).append(override)
    return [replace(one, overrides=tuple(own[n])) for n, one in enumerate(attempts)], rest


def _of_item(
    ledger: Ledger,
    item: IntakeItem,
    verdicts: Mapping[tuple[str, str], VerdictRow],
    rows: Mapping[tuple[str, str], HandedInRow],
) -> DatedAttempt:
    given = item.handed_in
    row = verdicts.get((item.student, item.key))
    notes = list(given.notes)
    fault = ledger.fault(item.student, item.key) if item.key else item.fault
    if fault and row is not None:
        notes.append(
            say("marking it again failed, the earlier verdict still counts: {fault}", fault=fault)
        )
    recorded = rows.get((item.student, item.submission))
    # an earlier run may have had the list with the times
    timed = given if recorded is None or given.has_times else recorded
    attempt = Attempt(
        number=given.attempt,
        submitted=timed.submitted,
        late=given.late,
        late_seconds=timed.late_seconds,
        extension=timed.extension,
        report=_report(ledger, row),
        problem=item.problem,
        notes=tuple(notes),
        fault=fault,
    )
    at = timed.submitted or (recorded.first_seen if recorded else None)
    return DatedAttempt(at, attempt, item.submission, row.id if row else None)


def _of_row(ledger: Ledger, handed_in: HandedInRow, assignment: str) -> DatedAttempt:
    row = ledger.verdict_of(assignment, handed_in.student, handed_in.submission)
    attempt = Attempt(
        number=0,
        submitted=handed_in.submitted,
        late=handed_in.late,
        late_seconds=handed_in.late_seconds,
        extension=handed_in.extension,
        report=_report(ledger, row),
        problem="",
        notes=(GONE,),
    )
    at = handed_in.submitted or handed_in.first_seen
    return DatedAttempt(at, attempt, handed_in.submission, row.id if row else None)


def _earlier(
    ledger: Ledger, items: Sequence[IntakeItem], rows: Iterable[HandedInRow], assignment: str
) -> dict[str, list[HandedInRow]]:
    """Return the marked attempts of each student that are no longer in the folder.

    A path that is still in the folder belongs only to its present students: a group's submission
    that was marked without a roster is no attempt of the participant with the group's number.
    """
    here = {(item.student, item.submission) for item in items}
    places: dict[str, set[str]] = defaultdict(set)
    for item in items:
        places[utf8_name(item.handed_in.path)].add(item.student)
    found: dict[str, list[HandedInRow]] = defaultdict(list)
    for row in rows:
        others = row.path in places and row.student not in places[row.path]
        if (row.student, row.submission) in here or others:
            continue
        if ledger.verdict_of(assignment, row.student, row.submission) is not None:
            found[row.student].append(row)
    return found


def _report(ledger: Ledger, row: VerdictRow | None) -> Report | None:
    return None if row is None else ledger.report(row.id)


def _paths(items: Iterable[IntakeItem]) -> dict[tuple[str, str], str]:
    """Return the path of each submission, by student and hash."""
    return {(i.student, i.submission): utf8_name(i.handed_in.path) for i in items if i.submission}


def _identical(
    ledger: Ledger, submissions: Mapping[str, str], paths: Mapping[tuple[str, str], str]
) -> tuple[tuple[str, ...], ...]:
    """Return the groups of equal content; members of one group are not listed."""
    known = ledger.fingerprints()
    found = groups({key: known.get(submission, "") for key, submission in submissions.items()})

    def place(key: str) -> str:
        return paths.get((key, submissions[key]), key)

    return tuple(group for group in found if len({place(key) for key in group}) > 1)


def _with_reports(
    ledger: Ledger, entries: Sequence[GradebookEntry], identical: Sequence[Sequence[str]]
) -> Iterator[GradebookEntry]:
    """Yield the entries with a loader for each report, and the students with the same content."""
    # only a few names each: all names for all students of a large group grow quadratically
    others = {
        key: tuple(other for other in group[: MOST_SAME + 1] if other != key)[:MOST_SAME]
        for group in identical
        for key in group
    }
    for entry in entries:
        fetch = None if entry.verdict is None else partial(ledger.report, entry.verdict)
        yield replace(entry, report=fetch, same_as=others.get(entry.student.key, ()))
