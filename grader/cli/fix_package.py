"""What `grader fix` does: it plans, shows, and writes only when asked to."""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import joined, say
from grader.base.i18n.translator import Translator
from grader.base.nearest import nearest
from grader.base.shown import shown
from grader.base.unheard import unheard
from grader.cli.fix_show import show_diff
from grader.course.assignment import Assignment
from grader.mistakes.fixes.case import Finding, finding_of
from grader.mistakes.fixes.table import STATIC
from grader.package.edit.disk import apply
from grader.package.edit.files import Files
from grader.package.submission import Submission, take_in
from grader.report.model import CheckResult
from grader.verdict.fix import Plan, fix_all, fix_files
from grader.verdict.mark import grade
from grader.verdict.order import Order
from grader.verdict.static import decided

Tell = Callable[[str], None]


@dataclass(frozen=True, kw_only=True)
class Wish:
    """What the command line asks for: `only` is one check's id or empty; `runs` whether the node
    may be built and run to learn what is wrong.
    """

    order: Order
    only: str = ""
    writes: bool = False
    runs: bool = True


def fix_package(wish: Wish, tell: Tell) -> int:
    """Fix a package and return the exit status: 0 nothing is left, 1 something is.

    The diff goes to stdout; what is said goes to `tell`, in the order's language. Raises
    UsageError for a path that cannot be written to, with nothing written.
    """
    translate = Translator(wish.order.lang)

    def told(text: str) -> None:
        tell(translate(text))

    assignment = wish.order.assignment
    _check_id(wish.only, assignment)
    submission = _own_copy(wish.order)
    if submission.root is None:
        missing = joined("package.found", submission.problem, by=": ")
        told(say("left    {finding}", finding=missing))
        told(submission.problem_fix)
        return 1
    plan = make_plan(wish, submission, told)
    show_diff(plan.patch, sys.stdout)
    for finding in plan.fixed:
        line = _line(finding)
        done, would = say("fixed  {finding}", finding=line), say("fixes  {finding}", finding=line)
        told(done if wish.writes else would)
    for finding in plan.left:
        told(say("left    {finding}", finding=_line(finding)))
    _finish(wish, submission, plan, told)
    return 1 if plan.left else 0


def _line(finding: Finding) -> str:
    first, _, _ = finding.actual.partition("\n")
    said = f"{finding.check}: {first}"
    if not finding.file:
        return said
    place: str = finding.file
    if finding.line:
        place = say("{file}, line {line}", file=finding.file, line=finding.line)
    return joined(said, " (", place, ")", by="")


def _check_id(only: str, assignment: Assignment) -> None:
    ids = [use.id for use in assignment.checks]
    if only and only not in ids:
        close = nearest(only, ids)
        missing = say(
            "there is no check '{check}' in {assignment}",
            check=shown(only),
            assignment=assignment.id,
        )
        meant = say("(did you mean '{word}'?)", word=close) if close else ""
        raise UsageError(
            joined(missing, meant), remedy=say("Checks: {names}", names=", ".join(ids))
        )


def _own_copy(order: Order) -> Submission:
    path, where = order.path, shown(str(order.path))
    if path.is_file():
        raise UsageError(
            say("{path} is a file: only the files of a folder can be fixed", path=where),
            remedy=say("Unpack the archive, and give the folder that holds the package."),
        )
    assignment = order.assignment
    found = take_in(path, package=assignment.package, node_file=assignment.node_file)
    if found.root is not None and found.origin in ("zip", "tar"):
        raise UsageError(
            say("the package lies in an archive in {path}, and is not changed there", path=where),
            remedy=say("Unpack it first."),
        )
    return found


def make_plan(wish: Wish, submission: Submission, tell: Tell) -> Plan:
    """Fix what the files show; then, if nothing of that is left, what a build and a run show."""
    assignment = wish.order.assignment
    old = Files.of(submission)
    plan = Plan(old, old)
    if not wish.only or wish.only in STATIC:
        plan = fix_files(submission, assignment, wish.only, lang=wish.order.lang)
        plan = replace(plan, left=(*plan.left, *_unasked(wish, plan, submission)))
    if plan.left:
        if wish.runs and not wish.only:
            tell(say("The node was not run: what is left comes first."))
        return plan
    if not wish.runs or wish.only in STATIC:
        return plan
    runner = _Runner(wish, tell)
    ran = fix_all(plan.new, assignment, runner.judge)
    return Plan(old, ran.new, (*plan.fixed, *ran.fixed), ran.left)


def _unasked(wish: Wish, plan: Plan, submission: Submission) -> list[Finding]:
    """Return the checks of the files that the files do not answer, where nothing will be run."""
    if wish.runs and not wish.only:
        return []
    results = decided(plan.new.put_into(submission), wish.order.assignment, wish.only)
    wanted = [wish.only] if wish.only else [u.id for u in wish.order.assignment.checks]
    undecided = [check for check in wanted if check in STATIC and check not in results]
    unknown = Translator(wish.order.lang)(say("the files alone do not tell"))
    return [Finding(check, "", actual=unknown) for check in undecided]


@dataclass(frozen=True)
class _Runner:
    """Judges files by the real checks: built and run as `grader check` does."""

    wish: Wish
    tell: Tell

    def judge(self, files: Files) -> list[Finding]:
        """Return what a build and a run show to be wrong."""
        order = self.wish.order
        self.tell(say("running the node …"))
        with tempfile.TemporaryDirectory(prefix="grader-fix-") as folder:
            path = Path(folder) / order.assignment.package
            _write_tree(files, path)
            report = grade(replace(order, path=path), unheard)
        if report.environment.sandbox == "none":
            self.tell(say("No sandbox was used: the package ran as you, with your files."))
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


def _finish(wish: Wish, submission: Submission, plan: Plan, tell: Tell) -> None:
    if not plan.patch and plan.left:
        tell(say("Nothing can be fixed by itself."))
    elif not plan.patch:
        tell(say("Nothing is wrong."))
    elif wish.writes:
        root = submission.path / (submission.root or ".")
        backups = apply(plan.old, plan.new, root)
        tell(say("Written to {path}.", path=shown(str(root))))
        if backups:
            names = ", ".join(shown(backup) for backup in backups)
            tell(say("The files as they were: {files}", files=names))
    else:
        tell(say("Nothing was changed: this is what --apply would write."))
