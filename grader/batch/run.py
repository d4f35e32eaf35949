"""Runs a class: finds the submissions without a verdict, marks them and records each at once."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime, timezone
from functools import partial

from grader.base.errors import SurroundingsError
from grader.base.shown import utf8_name
from grader.batch.earlier_submissions import EarlierSubmissions
from grader.batch.group_submissions import Pair, by_submission, reports_for, share_group_verdicts
from grader.batch.intake import IntakeItem, take_in_class, tasks
from grader.batch.ledger import HandedInRow, Ledger, Regrade
from grader.batch.model import ClassFolder, Student
from grader.batch.similar import fingerprint
from grader.batch.verdict_key import surroundings_key
from grader.batch.work import Done, Job, Pool
from grader.course.assignment import Assignment
from grader.package.submission import Submission
from grader.ros.distro import Distro
from grader.run.known_interfaces import require_interfaces
from grader.sandbox.choose import open_sandbox
from grader.sandbox.limits import Limits
from grader.verdict.order import Order

FAULTS_IN_A_ROW = 3  # after that many failures the sandbox is tried without a submission


@dataclass(frozen=True, kw_only=True)
class MarkingSetting:
    """What a class is marked in.

    `key` is the hash of everything but the submission that decides a verdict; `sandbox` the name of
    a sandbox that was opened successfully.
    """

    assignment: Assignment
    distro: Distro
    limits: Limits
    sandbox: str
    key: str
    lang: str = "en"
    tries_fixes: bool = True

    @property
    def job(self) -> Job:
        """The part that a worker needs."""
        return Job(
            self.assignment,
            self.distro.name,
            self.sandbox,
            self.limits,
            self.lang,
            self.tries_fixes,
        )


def prepare(order: Order, *, notify: Callable[[str], None]) -> MarkingSetting:
    """Open the order's sandbox once and return the setting; SurroundingsError if none opens."""
    sandbox = open_sandbox(
        order.sandbox,
        order.distro,
        order.limits,
        interfaces=order.assignment.interfaces,
        notify=notify,
    )
    try:
        require_interfaces(sandbox, order.assignment.on(order.distro))
    finally:
        sandbox.close()
    return MarkingSetting(
        assignment=order.assignment,
        distro=order.distro,
        limits=order.limits,
        sandbox=sandbox.name,
        key=surroundings_key(order.assignment, sandbox.ros, order.limits, lang=order.lang),
        lang=order.lang,
        tries_fixes=order.tries_fixes,
    )


@dataclass
class ClassPlan:
    """Every attempt of a class, the submissions still to be marked, and the regrades.

    A group's submission is in `todo` once. `sharing` lists all students who get its verdict, by the
    student and key that it is marked for.
    """

    items: list[IntakeItem]
    todo: list[IntakeItem]
    regrades: dict[Pair, Regrade] = field(default_factory=dict)
    sharing: dict[Pair, list[Student]] = field(default_factory=dict)

    @property
    def students(self) -> set[str]:
        """The keys of the students who will get a new verdict."""
        return {student.key for students in self.sharing.values() for student in students}

    @property
    def marked(self) -> int:
        """How many submissions already have a verdict."""
        return len(by_submission(self.items)) - len(self.todo)


class Listener:
    """Receives the progress of a class run; this one ignores it."""

    def took_in(self, count: int) -> None:
        """`count` attempts have been read so far."""

    def begins(self, total: int) -> None:
        """The marking of `total` submissions begins."""

    def started(self, name: str) -> None:
        """The marking of one submission begins."""

    def finished(self, name: str, done: Done) -> None:
        """One submission is done, and its verdict is on the disk."""


def make_plan(
    ledger: Ledger, folder: ClassFolder, setting: MarkingSetting, *, listener: Listener
) -> ClassPlan:
    """Read all submissions, record them in the ledger, and return what is to be marked."""
    surroundings = setting.key
    known = ledger.fingerprints()
    fresh: dict[str, str] = {}

    def keep_fingerprint(submission: Submission) -> None:
        if submission.sha256 not in known:
            fresh[submission.sha256] = fingerprint(submission)

    items = []
    for item in take_in_class(
        folder.handed_in, setting.assignment, surroundings, seen=keep_fingerprint
    ):
        items.append(item)
        listener.took_in(len(items))
    if fresh:
        ledger.keep_fingerprints(fresh)
    _record_attempts(ledger, items, setting.assignment.id)
    share_group_verdicts(ledger, items)
    students = {attempt.student.key: attempt.student for attempt in folder.handed_in}
    students.update({student.key: student for student in _missing(ledger, folder, setting)})
    if set(students.values()) - set(ledger.students(setting.assignment.id)):
        ledger.enrol(setting.assignment.id, students.values())
    return _plan(ledger, items)


def _missing(ledger: Ledger, folder: ClassFolder, setting: MarkingSetting) -> Iterator[Student]:
    """Yield the students without a submission, under the key of their earlier ones."""
    assignment = setting.assignment.id
    present = {attempt.student.key for attempt in folder.handed_in}
    recorded = {row.student for row in ledger.handed_in(assignment)}
    earlier = EarlierSubmissions(ledger, assignment, present, recorded)
    yield from (earlier.with_known_key(student) for student in folder.missing)


def request_regrade(ledger: Ledger, plan: ClassPlan, students: Sequence[str] | None) -> ClassPlan:
    """Return the plan with regrades of these students, or of everybody (None).

    An unfinished regrade of everybody is continued instead.
    """
    if students is None and plan.regrades:
        return plan
    verdicts = ledger.verdicts()
    wanted = {
        (item.student, item.key)
        for group in by_submission(plan.items)
        if students is None or any(item.student in students for item in group)
        for item in group
    }
    ledger.request_regrades(verdicts[pair] for pair in sorted(wanted) if pair in verdicts)
    return _plan(ledger, plan.items)


def carry_out(
    ledger: Ledger, plan: ClassPlan, setting: MarkingSetting, pool: Pool, *, listener: Listener
) -> None:
    """Mark the submissions in `todo`.

    A verdict is on the disk before the listener hears that it is done. A submission on which the
    grader fails at every try gets no verdict, and the others go on if the sandbox works without it
    (`Pool.prove`). Raises SurroundingsError if it does not, or if no submission of the class can be
    marked; the verdicts reached so far are kept.
    """
    listener.begins(len(plan.todo))
    names = {item.student: item.handed_in.student.name or item.student for item in plan.todo}
    reached, faults, in_a_row = plan.marked, 0, 0
    waiting = tasks(plan.todo, setting.assignment, setting.key)
    running = pool.run(waiting, started=lambda task: listener.started(names[task.student]))
    with contextlib.closing(running):
        for done in running:
            if _keep(ledger, done, plan.sharing, setting.assignment):
                reached, in_a_row = reached + 1, 0
            else:
                faults, in_a_row = faults + 1, in_a_row + 1
            listener.finished(names[done.task.student], done)
            if in_a_row >= FAULTS_IN_A_ROW:
                pool.prove()
                in_a_row = 0
    if faults:
        pool.prove()
    if faults >= FAULTS_IN_A_ROW and not reached:
        raise SurroundingsError(
            f"the grader failed on all {faults} submissions, although its sandbox works",
            remedy="The reasons are in gradebook.csv. Please report them.",
        )


def cores_here() -> int:
    """Return how many cores this process may use."""
    return len(os.sched_getaffinity(0))


def _record_attempts(ledger: Ledger, items: Sequence[IntakeItem], assignment: str) -> None:
    known = {(row.student, row.submission): row for row in ledger.handed_in(assignment)}
    now = datetime.now(timezone.utc)
    rows = []
    for item in items:
        if not item.submission:
            continue
        given = item.handed_in
        before = known.get((item.student, item.submission))
        row = HandedInRow(
            student=item.student,
            submission=item.submission,
            submitted=given.submitted,
            late=given.late,
            path=utf8_name(given.path),
            first_seen=before.first_seen if before else now,
            late_seconds=given.late_seconds,
            extension=given.extension,
        )
        if before is not None and not given.has_times:  # without the list that has them, this time
            row = replace(
                row,
                submitted=before.submitted,
                late_seconds=before.late_seconds,
                extension=before.extension,
            )
        if row != before:
            rows.append(row)
    if rows:
        ledger.record_handed_in(assignment, rows)


def _plan(ledger: Ledger, items: list[IntakeItem]) -> ClassPlan:
    verdicts, regrades = ledger.verdicts(), ledger.pending_regrades()
    plan = ClassPlan(items, [])
    for group in by_submission(items):
        pairs = [(item.student, item.key) for item in group]
        waiting = [n for n, pair in enumerate(pairs) if pair not in verdicts or pair in regrades]
        if not waiting:
            continue
        first = pairs[waiting[0]]
        if first not in plan.sharing:
            plan.todo.append(group[waiting[0]])
        students = [group[n].handed_in.student for n in waiting]
        plan.sharing.setdefault(first, []).extend(students)
        plan.regrades |= {pairs[n]: regrades[pairs[n]] for n in waiting if pairs[n] in regrades}
    return plan


def _keep(
    ledger: Ledger, done: Done, sharing: Mapping[Pair, list[Student]], assignment: Assignment
) -> bool:
    """Record a verdict; return False if there is none, so that an earlier one still counts."""
    task, report, recording = done.task, done.answer.report, done.answer.recording
    others = [one for one in sharing.get((task.student, task.key), ()) if one.key != task.student]
    if report is None:
        for student in (task.student, *(other.key for other in others)):
            ledger.record_fault(student, task.key, done.answer.fault)
        return False
    # a submission that changed back to a marked one while it waited keeps that verdict
    from grader.verdict.evidence_file import Judged, evidence_bytes  # noqa: PLC0415 - slow

    judged = Judged(task.submission, recording) if recording is not None else None
    ledger.record_for_all(
        task.key,
        {task.student: report, **reports_for(report, others)},
        evidence=partial(evidence_bytes, judged, assignment),
    )
    return True
