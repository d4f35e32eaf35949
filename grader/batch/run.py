"""The run of a class: what is not marked yet is marked, and each verdict is kept at once."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime, timezone

from grader.base.errors import SurroundingsError
from grader.batch.handed_in_before import HandedInBefore
from grader.batch.intake import Item, take_in_class, tasks
from grader.batch.keys import surroundings_key
from grader.batch.ledger import Ledger
from grader.batch.ledger_rows import HandedInRow, Regrade, path_text
from grader.batch.model import ClassFolder, Student
from grader.batch.shared import Pair, give_known, reports_of, together
from grader.batch.similar import fingerprint
from grader.batch.work import Done, Job, Pool
from grader.course.assignment import Assignment
from grader.package.submission import Submission
from grader.ros.distro import Distro
from grader.sandbox.choose import open_sandbox
from grader.sandbox.limits import Limits
from grader.verdict.order import Order

FAULTS_IN_A_ROW = 3  # after so many, the sandbox is tried without a submission before the next


@dataclass(frozen=True, kw_only=True)
class Setting:
    """In what a class is marked: `key` is the hash of all that decides a verdict beside the
    submission, `sandbox` one that was proven to open.
    """

    assignment: Assignment
    distro: Distro
    limits: Limits
    sandbox: str
    key: str
    lang: str = "en"

    @property
    def job(self) -> Job:
        """What a worker is told of it."""
        return Job(self.assignment, self.distro.name, self.sandbox, self.limits, self.lang)


def prove(order: Order, *, notify: Callable[[str], None]) -> Setting:
    """Open the order's sandbox once and return what is marked in; SurroundingsError if none opens."""
    sandbox = open_sandbox(order.sandbox, order.distro, order.limits, notify=notify)
    sandbox.close()
    return Setting(
        assignment=order.assignment,
        distro=order.distro,
        limits=order.limits,
        sandbox=sandbox.name,
        key=surroundings_key(order.assignment, sandbox.ros, order.limits, lang=order.lang),
        lang=order.lang,
    )


@dataclass
class Plan:
    """Every attempt of a class, the submissions that are still to be marked, and the regrades.

    A group's submission is in `todo` once; `sharing` are all students who get its verdict, by the
    pair of student and key that it is marked for.
    """

    items: list[Item]
    todo: list[Item]
    regrades: dict[Pair, Regrade] = field(default_factory=dict)
    sharing: dict[Pair, list[Student]] = field(default_factory=dict)

    @property
    def students(self) -> set[str]:
        """The students who will have a new verdict."""
        return {student.key for students in self.sharing.values() for student in students}

    @property
    def marked(self) -> int:
        """How many submissions have their verdict already."""
        return len(together(self.items)) - len(self.todo)


class Listener:
    """Hears how a class run goes; this one lets it pass."""

    def took_in(self, count: int) -> None:
        """So many attempts have been looked at."""

    def begins(self, total: int) -> None:
        """So many submissions are to be marked."""

    def started(self, name: str) -> None:
        """One is being marked."""

    def finished(self, name: str, done: Done) -> None:
        """One is done, and its verdict is on the disk."""


def make_plan(ledger: Ledger, folder: ClassFolder, setting: Setting, *, listener: Listener) -> Plan:
    """Take everything in, note it in the ledger, and see what there is to do."""
    surroundings = setting.key
    known = ledger.fingerprints()
    fresh: dict[str, str] = {}

    def seen(submission: Submission) -> None:
        if submission.sha256 not in known:
            fresh[submission.sha256] = fingerprint(submission)

    items = []
    for item in take_in_class(folder.handed_in, setting.assignment, surroundings, seen=seen):
        items.append(item)
        listener.took_in(len(items))
    if fresh:
        ledger.keep_fingerprints(fresh)
    _remember(ledger, items, setting.assignment.id)
    give_known(ledger, items)
    students = {attempt.student.key: attempt.student for attempt in folder.handed_in}
    students.update({student.key: student for student in _missing(ledger, folder, setting)})
    if set(students.values()) - set(ledger.students(setting.assignment.id)):
        ledger.enrol(setting.assignment.id, students.values())
    return _plan(ledger, items)


def _missing(ledger: Ledger, folder: ClassFolder, setting: Setting) -> Iterator[Student]:
    """Yield who has no submission now, under the key of what was handed in before."""
    assignment = setting.assignment.id
    present = {attempt.student.key for attempt in folder.handed_in}
    seen = {row.student for row in ledger.seen(assignment)}
    before = HandedInBefore(ledger, assignment, present, seen)
    yield from (before.as_known(student) for student in folder.missing)


def ask_regrade(ledger: Ledger, plan: Plan, students: Sequence[str] | None) -> Plan:
    """Have verdicts reached again: these students', or (None) everybody's.

    Where a regrade of everybody was begun and not finished, it goes on instead.
    """
    if students is None and plan.regrades:
        return plan
    verdicts = ledger.verdicts()
    wanted = {
        (item.student, item.key)
        for group in together(plan.items)
        if students is None or any(item.student in students for item in group)
        for item in group
    }
    ledger.ask_again(verdicts[pair] for pair in sorted(wanted) if pair in verdicts)
    return _plan(ledger, plan.items)


def carry_out(
    ledger: Ledger, plan: Plan, setting: Setting, pool: Pool, *, listener: Listener
) -> None:
    """Mark what is to be marked.

    A verdict is on the disk before it is said to be done. A submission on which our side fails, try
    by try, has no verdict, and the others go on: it is at fault itself if the sandbox works without
    it (`Pool.prove`). Raises SurroundingsError if that does not work, or if nothing of a class can
    be marked; what was reached until then is kept.
    """
    listener.begins(len(plan.todo))
    names = {item.student: item.handed_in.student.name or item.student for item in plan.todo}
    reached, faults, in_a_row = plan.marked, 0, 0
    waiting = tasks(plan.todo, setting.assignment, setting.key)
    running = pool.run(waiting, started=lambda task: listener.started(names[task.student]))
    with contextlib.closing(running):
        for done in running:
            if _keep(ledger, done, plan.sharing):
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
            f"the grader failed on all {faults} submissions, and its sandbox works",
            remedy="The reasons are in gradebook.csv: please report them.",
        )


def cores_here() -> int:
    """Return how many cores this process may use."""
    return len(os.sched_getaffinity(0))


def _remember(ledger: Ledger, items: Sequence[Item], assignment: str) -> None:
    known = {(row.student, row.submission): row for row in ledger.seen(assignment)}
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
            path=path_text(given.path),
            first_seen=before.first_seen if before else now,
        )
        if row != before:
            rows.append(row)
    if rows:
        ledger.see(assignment, rows)


def _plan(ledger: Ledger, items: list[Item]) -> Plan:
    verdicts, asked = ledger.verdicts(), ledger.asked_again()
    plan = Plan(items, [])
    for group in together(items):
        pairs = [(item.student, item.key) for item in group]
        waiting = [n for n, pair in enumerate(pairs) if pair not in verdicts or pair in asked]
        if not waiting:
            continue
        first = pairs[waiting[0]]
        if first not in plan.sharing:
            plan.todo.append(group[waiting[0]])
        students = [group[n].handed_in.student for n in waiting]
        plan.sharing.setdefault(first, []).extend(students)
        plan.regrades |= {pairs[n]: asked[pairs[n]] for n in waiting if pairs[n] in asked}
    return plan


def _keep(ledger: Ledger, done: Done, sharing: Mapping[Pair, list[Student]]) -> bool:
    """Keep a verdict; return False where there is none, and the one before still counts."""
    task, report = done.task, done.answer.report
    others = [one for one in sharing.get((task.student, task.key), ()) if one.key != task.student]
    if report is None:
        for student in (task.student, *(other.key for other in others)):
            ledger.record_fault(student, task.key, done.answer.fault)
        return False
    # one that became, while it waited, what had been marked before keeps that verdict
    ledger.record_for_all(task.key, {task.student: report, **reports_of(report, others)})
    return True
