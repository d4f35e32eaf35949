"""Implements `grader fix`: plans the fixes, shows the diff, and writes it with --apply."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from itertools import count
from pathlib import Path
from typing import TextIO

from rich.text import Text

from grader.base.errors import UsageError
from grader.base.gate import bytes_of
from grader.base.gated_console import GatedConsole
from grader.base.i18n.message import joined, say
from grader.base.i18n.translator import Translator
from grader.base.nearest import nearest
from grader.base.shown import shown
from grader.course.assignment import Assignment
from grader.mistakes.fixes.case import Finding, finding_of
from grader.package.edit.disk import apply
from grader.package.edit.files import Files
from grader.package.intake.archive_kind import is_named_archive
from grader.package.intake.given import package_above
from grader.package.submission import Submission
from grader.report.live import LiveProgress
from grader.report.model import CheckResult
from grader.report.shown_patch import shown_patch
from grader.verdict.checks.all import STATIC
from grader.verdict.fix import FixPlan, fix_all, fix_files
from grader.verdict.mark import mark
from grader.verdict.order import Order
from grader.verdict.static import static_results
from grader.verdict.take_in import take_in_for

Notify = Callable[[str], None]
STYLES = {"+": "green", "-": "red", "@": "cyan", "d": "bold"}
"""The colours of a diff, by a line's first character."""


@dataclass(frozen=True, kw_only=True)
class FixRequest:
    """The options of `grader fix`; `only` is a check's id, or empty for all checks.

    `writes` is whether to write the fixes, `runs` whether to build and run the node.
    """

    order: Order
    only: str = ""
    writes: bool = False
    runs: bool = True


def fix_package(request: FixRequest, notify: Notify) -> int:
    """Fix a package and return the exit status: 0 if nothing is left to fix, else 1.

    The diff goes to stdout, messages in the order's language to `notify`. Raises UsageError, with
    nothing written, if the path cannot be written to.
    """
    translate = Translator(request.order.lang)

    def notify_translated(text: str) -> None:
        notify(translate(text))

    assignment = request.order.assignment
    _check_id(request.only, assignment)
    submission = _own_copy(request.order)
    if submission.root is None:
        missing = joined("package.found", submission.problem, by=": ")
        notify_translated(say("left    {finding}", finding=missing))
        notify_translated(submission.problem_fix)
        return 1
    plan = make_plan(request, submission, notify_translated)
    _print_diff(plan.patch, sys.stdout, translate)
    for finding in plan.fixed:
        line = _line(finding)
        done, would = say("fixed  {finding}", finding=line), say("fixes  {finding}", finding=line)
        notify_translated(done if request.writes else would)
    for finding in plan.left:
        notify_translated(say("left    {finding}", finding=_line(finding)))
    _finish(request, submission, plan, notify_translated)
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
        raise _only_a_file(path)
    found = take_in_for(order.assignment, path)
    if found.root is not None and found.origin in ("zip", "tar"):
        raise UsageError(
            say("the package is in an archive in {path}, and archives are not changed", path=where),
            remedy=say("Unpack it first."),
        )
    return found


def _only_a_file(path: Path) -> UsageError:
    folder = package_above(path.resolve())
    if is_named_archive(path.name):
        remedy = say("Unpack the archive, and give the folder that holds the package.")
    elif folder is not None:
        remedy = say("Give the folder of the package: {folder}", folder=shown(str(folder)))
    else:
        remedy = say("Give the folder that holds the package.")
    where = shown(str(path))
    return UsageError(
        say("{path} is a file: only the files of a folder can be fixed", path=where), remedy=remedy
    )


def make_plan(request: FixRequest, submission: Submission, notify: Notify) -> FixPlan:
    """Fix what the files show; if nothing of that is left, also what a build and a run show."""
    assignment = request.order.assignment
    old = Files.of(submission)
    plan = FixPlan(old, old)
    if not request.only or request.only in STATIC:
        plan = fix_files(submission, assignment, request.only, lang=request.order.lang)
        plan = replace(plan, left=(*plan.left, *_undecided(request, plan, submission)))
    if plan.left:
        if request.runs and not request.only:
            notify(say("The node was not run: fix what is left first."))
        return plan
    if not request.runs or request.only in STATIC:
        return plan
    judge = _RunJudge(request, submission, notify)
    ran = fix_all(plan.new, assignment, judge)
    return FixPlan(old, ran.new, (*plan.fixed, *ran.fixed), ran.left)


def _undecided(request: FixRequest, plan: FixPlan, submission: Submission) -> list[Finding]:
    """Return the static checks that the files do not decide; none if the node may be run."""
    if request.runs and not request.only:
        return []
    results = static_results(plan.new.put_into(submission), request.order.assignment, request.only)
    wanted = [request.only] if request.only else [u.id for u in request.order.assignment.checks]
    actual = Translator(request.order.lang)(say("the files alone do not show it"))
    undecided = [check for check in wanted if check in STATIC and check not in results]
    return [Finding(check, "", actual=actual) for check in undecided]


@dataclass(frozen=True)
class _RunJudge:
    """Finds mistakes by building and running the package, as `grader check` does."""

    request: FixRequest
    submission: Submission
    notify: Notify
    tries: Iterator[int] = field(default_factory=count)

    def __call__(self, files: Files) -> list[Finding]:
        """Return the findings of a build and a run; the progress is shown meanwhile."""
        order = replace(self.request.order, tries_fixes=False)  # this is where they are tried
        tried = next(self.tries)
        again = say("running the node with change {number} …", number=tried)
        self.notify(again if tried else say("running the node …"))
        with LiveProgress(sys.stderr, lang=order.lang) as progress:
            report = mark(files.put_into(self.submission), order, progress)
        if report.environment.sandbox == "none":
            self.notify(
                say("No sandbox was used: the package ran as your user, with access to your files.")
            )
        return [f for result in report.checks for f in self._found(result)]

    def _found(self, result: CheckResult) -> list[Finding]:
        only = self.request.only
        if only and result.id != only:
            return []
        found = finding_of(result)
        unknown = result.status in ("inconclusive", "error") or (
            only and result.status == "skipped"
        )
        if found is None and unknown:
            found = Finding(result.id, "", actual=result.actual)
        return [found] if found is not None else []


def _finish(request: FixRequest, submission: Submission, plan: FixPlan, notify: Notify) -> None:
    if not plan.patch and plan.left:
        notify(say("Nothing can be fixed automatically."))
    elif not plan.patch:
        notify(say("Nothing is wrong."))
    elif request.writes:
        root = submission.path / (submission.root or ".")
        backups = apply(plan.old, plan.new, root)
        notify(say("Written to {path}.", path=shown(str(root))))
        if backups:
            names = ", ".join(shown(backup) for backup in backups)
            notify(say("The original files: {files}", files=names))
    else:
        notify(say("Nothing was changed: this is what --apply would write."))


def _print_diff(patch: bytes, file: TextIO, translate: Translator) -> None:
    """Print a diff; on a terminal in colours and without the student's control characters."""
    if not file.isatty():
        file.flush()
        raw = bytes_of(file)
        raw.write(patch)
        raw.flush()
        return
    console = GatedConsole(file, soft_wrap=True)
    text = shown_patch(patch.decode("utf-8", "backslashreplace"), translate)
    for line in text.split("\n")[:-1]:
        named = line.startswith(("--- ", "+++ "))
        style = "bold" if named else STYLES.get(line[:1], "")
        console.print(Text(_plain(line), style=style), soft_wrap=True)


def _plain(line: str) -> str:
    return "".join(c if c.isprintable() or c == "\t" else _escaped(c) for c in line)


def _escaped(sign: str) -> str:
    return sign.encode("unicode_escape", "surrogatepass").decode("ascii")
