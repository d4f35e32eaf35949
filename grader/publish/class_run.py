"""`grader grade-all`: mark the submissions of a class and write gradebook, feedback and pages."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from datetime import datetime, timezone
from functools import partial
from pathlib import Path
from typing import TextIO

from grader.base.errors import SurroundingsError
from grader.base.gate import gate, show
from grader.base.stream import takes_styles, width_of
from grader.batch import run
from grader.batch.by_hand import BY_HAND_FILE, by_hand
from grader.batch.correction import note_counting
from grader.batch.find_student import find_student
from grader.batch.given_files import given_files, write_private
from grader.batch.inputs import GRADEBOOK, read_inputs
from grader.batch.ledger import Ledger
from grader.batch.local_pool import LocalPool
from grader.batch.mistake_group import mistake_group
from grader.batch.model import ClassFolder, ClassResult
from grader.batch.progress import ClassProgress
from grader.batch.result import class_result
from grader.batch.sheets import SheetOptions
from grader.batch.words import plural
from grader.batch.work import Job, Pool
from grader.publish.before_marking import (
    agreed,
    marking_page,
    say_changes,
    say_join,
    seconds_to_mark,
)
from grader.publish.class_table import changes_of, class_page, regrade_page
from grader.publish.outputs import INDEX, Outcome, Outputs
from grader.publish.written import raise_failures
from grader.verdict.order import Order

MOST_A_CORE = 2  # workers per core, while the cores are not busy


@dataclass(frozen=True, kw_only=True)
class ClassOptions:
    """The options of `grade-all`; `order` has the assignment, the distro and the sandbox.

    `accepts` holds what the instructor accepts in advance (see `accept`), `given` the instructor's
    own lists (see `given_files`); `yes`: a long run does not ask first; `pseudonyms`: a gradebook
    without names is written too; `heard` gets the result, without its reports, once all is written.
    """

    order: Order
    out: Path
    ledger: Path
    system: str = "auto"
    roster: Path | None = None
    regrade: bool = False
    students: tuple[str, ...] = ()
    mistakes: tuple[str, ...] = ()
    workers: int = 0
    scheduler: str = ""
    sheets: SheetOptions = field(default_factory=SheetOptions)
    accepts: frozenset[str] = frozenset()
    given: Mapping[str, Path | None] = field(default_factory=dict)
    quiet: bool = False
    yes: bool = False
    pseudonyms: bool = False
    heard: Callable[[ClassResult], None] = lambda _: None


def grade_all(options: ClassOptions, *, dry_run: bool) -> int:
    """Mark what is not marked yet, write all outputs, and return the exit status.

    The instructor's files and the roster are read and checked before anything is marked. If
    marking ends early (Ctrl+C, or the surroundings fail), everything marked so far is kept and
    written, and KeyboardInterrupt or SurroundingsError is raised again.
    """
    started = datetime.now(timezone.utc)
    order = options.order
    known = read_inputs(
        order.path,
        order.assignment,
        options.sheets,
        options.out,
        system=options.system,
        roster=options.roster,
        given=given_files(options.given, options.out),
        notify=_notify,
    )
    rows = say_join(known, options.out, quiet=options.quiet, notify=_notify)
    known.refuse_poor_join(order.assignment.policy, options.accepts)
    if not dry_run:
        known.given.keep(options.out)
    ended: KeyboardInterrupt | SurroundingsError | None = None
    with Ledger(options.ledger) as ledger, _marking(options) as (setting, pool):
        outputs = Outputs(options.out, options.sheets, known, ledger, options.accepts)
        with ClassProgress(sys.stderr) as progress:
            plan = run.make_plan(ledger, known.folder, setting, listener=progress)
            if options.regrade or options.students or options.mistakes:
                chosen = None if options.regrade else _chosen(options, plan, ledger)
                if dry_run:
                    count = len(plan.items if chosen is None else chosen)
                    _notify(f"a regrade would mark {count} again")
                else:
                    plan = run.request_regrade(ledger, plan, chosen)
            result_now = partial(_result, options, ledger, known.folder, plan, started)
            before = result_now() if outputs.can_lower else None
            if before is not None:
                say_changes(known, plan, before, notify=_notify)
            _say_plan(plan)
            if dry_run:
                width, styled = width_of(sys.stdout), takes_styles(sys.stdout)
                _show_page(marking_page(rows, plan, width=width, styled=styled))
                return 0
            if not (options.yes or _agreed(ledger, plan, options)):
                _notify("nothing was marked")
                return 0
            try:
                if plan.todo:
                    if before is not None:
                        outputs.refuse_lower(before, but=plan.students)
                    run.carry_out(ledger, plan, setting, pool, listener=progress)
            except (KeyboardInterrupt, SurroundingsError) as why:
                ended = why
        result = result_now() if plan.todo or before is None else before
        note_counting(ledger, result)
        written = outputs.write(result, notify=_notify)
        _show(result, plan, ledger, options, written)
        status = _status(result)
    if ended is not None:
        _say_ended(ended, written)
        raise ended
    _say_faults(result)
    if written.state == "refused":
        raise written.failures[0]
    raise_failures(written.failures)
    options.heard(replace(result, entries=tuple(replace(e, report=None) for e in result.entries)))
    return status


def _write_pseudonyms(result: ClassResult, ledger: Ledger, out: Path) -> None:
    from grader.publish import pseudonyms as hidden  # noqa: PLC0415 - seldom needed

    names = hidden.pseudonyms(result, ledger)
    write_private(out, hidden.FOLDER, GRADEBOOK, hidden.gradebook(result, names))
    write_private(out, "", hidden.LIST, hidden.pseudonym_list(result, names))
    _print(f"pseudonyms {out / hidden.FOLDER / GRADEBOOK} (whose is which: {hidden.LIST})")


def _agreed(ledger: Ledger, plan: run.ClassPlan, options: ClassOptions) -> bool:
    seconds = seconds_to_mark(ledger, plan, options.workers or run.cores_here())
    return agreed(seconds, len(plan.todo))


def _say_ended(ended: KeyboardInterrupt | SurroundingsError, written: Outcome) -> None:
    for failure in written.failures:
        _notify(str(failure))
    if isinstance(ended, KeyboardInterrupt):
        _notify("interrupted: the verdicts so far are kept; run the same command again to continue")


def _result(
    options: ClassOptions,
    ledger: Ledger,
    folder: ClassFolder,
    plan: run.ClassPlan,
    started: datetime,
) -> ClassResult:
    """Return the result of the class from the ledger's current state."""
    return class_result(
        ledger,
        folder,
        plan.items,
        options.order.assignment,
        distro=options.order.distro.name,
        lang=options.order.lang,
        started=started,
        seconds=(datetime.now(timezone.utc) - started).total_seconds(),
    )


@contextlib.contextmanager
def _marking(options: ClassOptions) -> Iterator[tuple[run.MarkingSetting, Pool]]:
    """Open the workers that mark: on this machine, or on a cluster."""
    order = options.order
    if not options.scheduler:
        setting = run.prepare(order, notify=_notify)
        cores = run.cores_here()
        most = options.workers or MOST_A_CORE * cores
        yield setting, LocalPool(setting.job, options.workers or cores, most=most)
        return
    from grader.batch.cluster import Cluster  # noqa: PLC0415 - Dask is an optional extra

    job = Job(
        order.assignment,
        order.distro.name,
        order.sandbox,
        order.limits,
        order.lang,
        order.tries_fixes,
    )
    with Cluster(options.scheduler, job, notify=_notify) as cluster:
        setting = run.MarkingSetting(
            assignment=order.assignment,
            distro=order.distro,
            limits=order.limits,
            sandbox=cluster.sandbox,
            key=cluster.surroundings,
            lang=order.lang,
            tries_fixes=order.tries_fixes,
        )
        yield setting, cluster


def _chosen(options: ClassOptions, plan: run.ClassPlan, ledger: Ledger) -> list[str]:
    """Return the keys of the students to mark again."""
    students = {item.student: item.handed_in.student for item in plan.items}
    keys = [find_student(word, list(students.values())).key for word in options.students]
    for mistake in options.mistakes:
        group = mistake_group(ledger, options.order.assignment.id, mistake)
        keys += [student.key for student in group.students if student.key in students]
    return list(dict.fromkeys(keys))


def _say_faults(result: ClassResult) -> None:
    count = sum(entry.status == "error" for entry in result.entries)
    if count:
        who, it = (
            ("1 submission was", "it") if count == 1 else (f"{count} submissions were", "them")
        )
        _notify(f"{who} not marked: the grader failed on {it} every time, and works without {it}")
        _notify("the reasons are in the gradebook's notes; run the same command to try again")


def _status(result: ClassResult) -> int:
    """Return 0 if every submission passed all checks, else 1; missing submissions do not count."""
    marked = [e for e in result.entries if e.status not in ("missing", "elsewhere")]
    return 0 if all(e.report is not None and e.report.all_passed for e in marked) else 1


def _say_plan(plan: run.ClassPlan) -> None:
    again = sum((item.student, item.key) in plan.regrades for item in plan.todo)
    words = f"{len(plan.todo)} to mark" + (f" ({again} again)" if again else "")
    _notify(f"{words}, {plan.marked} marked before")


def _show(
    result: ClassResult,
    plan: run.ClassPlan,
    ledger: Ledger,
    options: ClassOptions,
    written: Outcome,
) -> None:
    out = sys.stdout
    width, styled = width_of(out), takes_styles(out)
    if plan.regrades:
        changes = changes_of(ledger, list(plan.regrades.values()))
        _show_page(regrade_page(changes, width=width, styled=styled))
    if not options.quiet:
        _show_page(class_page(result, width=width, styled=styled))
    if written.state == "refused":
        return
    _print(f"page       {options.out / INDEX}")
    _print(f"gradebook  {options.out / GRADEBOOK}")
    if options.pseudonyms:
        _write_pseudonyms(result, ledger, options.out)
    if waiting := by_hand(result):
        people = plural(len({one.entry.student.key for one in waiting}), "student")
        _print(f"by hand    {options.out / BY_HAND_FILE} ({people})")
    if written.state == "unchanged":
        _notify("nothing has changed since these were written")


def _notify(text: str) -> None:
    _write(sys.stderr, text)


def _show_page(page: str) -> None:
    show(page.rstrip("\n") + "\n", sys.stdout)


def _print(text: str) -> None:
    _write(sys.stdout, text)


def _write(file: TextIO, text: str) -> None:
    out = gate(file)
    out.write(f"{text}\n")
    out.flush()
