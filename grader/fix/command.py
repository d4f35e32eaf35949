"""What `grader fix` does: it plans, shows, and writes only when asked to."""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from dataclasses import replace
from pathlib import Path

from grader.assignment import Assignment
from grader.errors import UsageError
from grader.events import Event
from grader.fix.asking import ask
from grader.fix.case import Finding
from grader.fix.case import finding_of
from grader.fix.disk import apply
from grader.fix.files import Files
from grader.fix.mends import STATIC
from grader.fix.plan import Plan
from grader.fix.plan import mend
from grader.fix.plan import mend_files
from grader.fix.show import show_diff
from grader.intake.notes import shown
from grader.mistakes.likeness import nearest
from grader.report.model import CheckResult
from grader.runner import Order
from grader.runner import grade
from grader.submission import Submission
from grader.submission import take_in

Say = Callable[[str], None]


@dataclass(frozen=True, kw_only=True)
class Wish:
    """What the command line asks for: `only` is one check's id or empty; `runs` whether the node
    may be built and run to learn what is wrong.
    """

    order: Order
    only: str = ""
    writes: bool = False
    runs: bool = True


def fix(wish: Wish, say: Say) -> int:
    """Mend a package and return the exit status: 0 nothing is left, 1 something is.

    The diff goes to stdout, what is said to `say`. Raises UsageError for a path that cannot be
    written to, with nothing written.
    """
    assignment = wish.order.assignment
    _check_id(wish.only, assignment)
    submission = _own_copy(wish.order)
    if submission.root is None:
        say(f"left    package.found: {submission.problem}")
        say(submission.problem_fix)
        return 1
    plan = make_plan(wish, submission, say)
    show_diff(plan.patch, sys.stdout)
    for finding in plan.mended:
        say(f"{'mended' if wish.writes else 'mends'}  {_line(finding)}")
    for finding in plan.left:
        say(f"left    {_line(finding)}")
    _finish(wish, submission, plan, say)
    return 1 if plan.left else 0


def _line(finding: Finding) -> str:
    place = f" ({finding.file}" + (f", line {finding.line})" if finding.line else ")")
    said = finding.actual.partition("\n")[0]
    return f"{finding.check}: {said}" + (place if finding.file else "")


def _check_id(only: str, assignment: Assignment) -> None:
    ids = [use.id for use in assignment.checks]
    if only and only not in ids:
        close = nearest(only, ids)
        raise UsageError(
            f"there is no check '{shown(only)}' in {assignment.id}"
            + (f" (did you mean '{close}'?)" if close else ""),
            remedy=f"Checks: {', '.join(ids)}",
        )


def _own_copy(order: Order) -> Submission:
    path = order.path
    if path.is_file():
        raise UsageError(
            f"{shown(str(path))} is a file: only the files of a folder can be mended",
            remedy="Unpack the archive, and give the folder that holds the package.",
        )
    assignment = order.assignment
    found = take_in(path, package=assignment.package, node_file=assignment.node_file)
    if found.root is not None and found.origin in ("zip", "tar"):
        raise UsageError(
            f"the package lies in an archive in {shown(str(path))}, and is not changed in there",
            remedy="Unpack it first.",
        )
    return found


def make_plan(wish: Wish, submission: Submission, say: Say) -> Plan:
    """Mend what the files show; then, if nothing of that is left, what a build and a run show."""
    assignment = wish.order.assignment
    old = Files.of(submission)
    plan = Plan(old, old)
    if not wish.only or wish.only in STATIC:
        plan = mend_files(submission, assignment, wish.only)
        plan = replace(plan, left=(*plan.left, *_unasked(wish, plan, submission)))
    if plan.left:
        if wish.runs and not wish.only:
            say("The node was not run: what is left comes first.")
        return plan
    if not wish.runs or wish.only in STATIC:
        return plan
    runner = _Runner(wish, say)
    ran = mend(plan.new, assignment, runner.judge)
    return Plan(old, ran.new, (*plan.mended, *ran.mended), ran.left)


def _unasked(wish: Wish, plan: Plan, submission: Submission) -> list[Finding]:
    """Return the checks of the files that the files do not answer, where nothing will be run."""
    if wish.runs and not wish.only:
        return []
    results = ask(plan.new.put_into(submission), wish.order.assignment, wish.only)
    wanted = [wish.only] if wish.only else [u.id for u in wish.order.assignment.checks]
    undecided = [check for check in wanted if check in STATIC and check not in results]
    return [Finding(check, "", actual="the files alone do not tell") for check in undecided]


@dataclass(frozen=True)
class _Runner:
    """Judges files by the real checks: built and run as `grader check` does."""

    wish: Wish
    say: Say

    def judge(self, files: Files) -> list[Finding]:
        """Return what a build and a run show to be wrong."""
        order = self.wish.order
        self.say("running the node …")
        with tempfile.TemporaryDirectory(prefix="grader-fix-") as folder:
            path = Path(folder) / order.assignment.package
            _write_tree(files, path)
            report = grade(replace(order, path=path), _unheard)
        if report.environment.sandbox == "none":
            self.say("No sandbox was used: the package ran as you, with your files.")
        return [f for result in report.checks for f in self._found(result)]

    def _found(self, result: CheckResult) -> list[Finding]:
        only = self.wish.only
        if only and result.id != only:
            return []
        found = finding_of(result)
        unknown = result.status in ("inconclusive", "error") or (
            only and result.status == "skipped"
        )
        if found is None and unknown:
            found = Finding(result.id, "", actual=result.actual)
        return [found] if found is not None else []


def _write_tree(files: Files, root: Path) -> None:
    """Write all of a package's files to a new folder, where they can be run."""
    root.mkdir(parents=True)
    for path, file in sorted(files.by_path.items()):
        place = root / path
        place.parent.mkdir(parents=True, exist_ok=True)
        if file.kind == "folder":
            place.mkdir(exist_ok=True)
        elif file.kind == "link":
            place.symlink_to(file.target)
        elif not file.unreadable:
            place.write_bytes(file.data)
            place.chmod(file.mode & 0o777 | 0o600)


def _unheard(event: Event) -> None:
    del event


def _finish(wish: Wish, submission: Submission, plan: Plan, say: Say) -> None:
    if not plan.patch:
        say("Nothing is wrong." if not plan.left else "Nothing can be mended by itself.")
    elif wish.writes:
        root = submission.path / (submission.root or ".")
        backups = apply(plan, root)
        say(f"Written to {shown(str(root))}.")
        if backups:
            say(f"The files as they were: {', '.join(shown(b) for b in backups)}")
    else:
        say("Nothing was changed: this is what --apply would write.")
