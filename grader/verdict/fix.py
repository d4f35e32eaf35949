"""Fixes a package in memory, one mistake after the other, until no other can be fixed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace

from grader.base.i18n.message import say
from grader.base.i18n.translator import SOURCE, Translator
from grader.course.assignment import Assignment
from grader.mistakes.catalogue import fixes_for
from grader.mistakes.fixes import layout, manifest, setup_cfg, syntax
from grader.mistakes.fixes.case import Case, Finding, Fix, finding_of
from grader.package.edit.diff import diff
from grader.package.edit.files import Files
from grader.package.submission import Submission
from grader.report.model import CheckResult
from grader.verdict.checks.all import STATIC
from grader.verdict.static import static_findings

MOST_STEPS = 30
"""The most fixes of one package: each mistake needs one, and a package has 17 checks."""
MOST_PATCH = 50_000
"""Bytes of a diff in a report: twice the size of a diff that changes all lines of an exercise."""
ADVISED: tuple[tuple[str, Fix], ...] = (
    ("package.manifest", manifest.dependencies),
    ("package.manifest", manifest.depend),
    ("source.node_file", layout.init_file),
    ("package.setup_cfg", setup_cfg.dashes),
)
"""Fixes of what costs no points by itself, or only when the node runs: the check that advises it."""
Judge = Callable[[Files], list[Finding]]


@dataclass(frozen=True)
class FixPlan:
    """The files before and after the fixes; the findings that were fixed, and those left."""

    old: Files
    new: Files
    fixed: tuple[Finding, ...] = ()
    left: tuple[Finding, ...] = ()

    @property
    def patch(self) -> bytes:
        """The diff; empty if nothing changes."""
        return diff(self.old, self.new)


def fixes_of(
    result: CheckResult, submission: Submission, assignment: Assignment
) -> Iterator[Files]:
    """Yield the files after each fix of a failed check, in the order to try them.

    Checks that need a run are not evaluated again: their fix relies on the form of the mistake.
    """
    finding = finding_of(result)
    follows = result.consequence_of and result.id in STATIC
    if finding is None or submission.root is None or follows:
        return
    if finding.check in STATIC:
        plan = fix_files(submission, assignment, only=finding.check)
        if not any(f.check == finding.check for f in plan.left):
            yield plan.new
    else:
        yield from certain_fixes(
            Case(Files.of(submission), finding, assignment), _fixes(finding, assignment)
        )


def patch_text(old: Files, new: Files) -> str:
    """Return the diff for a report; empty if it is too long or not UTF-8."""
    patch = diff(old, new)
    if len(patch) > MOST_PATCH:
        return ""
    try:
        return patch.decode("utf-8")
    except UnicodeDecodeError:  # JSON cannot contain other bytes
        return ""


def fix_files(
    submission: Submission, assignment: Assignment, only: str = "", *, lang: str = SOURCE
) -> FixPlan:
    """Fix the mistakes that the files alone show (of the check `only`, if given)."""

    def judge(files: Files) -> list[Finding]:
        return static_findings(files, submission, assignment, only, lang=lang)

    old = Files.of(submission)
    if only:
        return fix_all(old, assignment, judge)
    # (no static check fails because of a setup.py that Python cannot read, so fix it first)
    readable = syntax.setup_py(Case(old, Finding("", ""), assignment))
    plan = fix_all(readable or old, assignment, judge)
    if readable is not None:
        said = Translator(lang)(say("Python cannot read setup.py"))
        unread = Finding("build.colcon", "", file="setup.py", actual=said)
        plan = replace(plan, fixed=(unread, *plan.fixed))
    return _advised(replace(plan, old=old), assignment, judge, lang)


def fix_all(files: Files, assignment: Assignment, judge: Judge) -> FixPlan:
    """Fix until `judge` finds nothing more that can be fixed.

    A fix is dropped if `judge` still finds the same afterwards.
    """
    start, fixed = files, []
    found = judge(files)
    for _ in range(MOST_STEPS):
        step = _step(files, assignment, found, judge)
        if step is None:
            break
        done, files, found = step
        fixed.append(done)
    return FixPlan(start, files, tuple(fixed), tuple(found))


def _step(
    files: Files,
    assignment: Assignment,
    found: list[Finding],
    judge: Judge,
) -> tuple[Finding, Files, list[Finding]] | None:
    for finding in found:
        case = Case(files, finding, assignment)
        for new in certain_fixes(case, _fixes(finding, assignment)):
            after = judge(new)
            gone = finding.known_by not in [f.known_by for f in after]
            if gone and _no_worse(found, after, case):
                return finding, new, after
    return None


def _fixes(finding: Finding, assignment: Assignment) -> tuple[Fix, ...]:
    """Return the fixes of a finding; none of one in another package, whose files are not changed."""
    is_here = assignment.about(finding.node).package == assignment.package
    return fixes_for(finding) if is_here else ()


def _no_worse(before: list[Finding], after: list[Finding], case: Case) -> bool:
    """Whether no check newly fails, except later ones, which could not be evaluated before."""
    order = [use.id for use in case.assignment.checks]
    at = order.index(case.finding.check) if case.finding.check in order else len(order)
    new = {f.check for f in after} - {f.check for f in before}
    return all(order.index(check) > at for check in new)


def certain_fixes(case: Case, fixes: Iterable[Fix]) -> Iterator[Files]:
    """Yield the files after each of these fixes that is certain."""
    for attempt in fixes:
        new = attempt(case)
        if new is not None and not _breaks_python(case.files, new):
            yield new


def _breaks_python(old: Files, new: Files) -> bool:
    """Whether a fix makes a file unreadable for Python."""
    for path, file in new.by_path.items():
        before = old.by_path.get(path)
        changed = before is not None and before.data != file.data
        if before is None or not changed or not path.endswith(".py"):
            continue
        if syntax.fault_of(file.data) is not None and syntax.fault_of(before.data) is None:
            return True
    return False


def _advised(plan: FixPlan, assignment: Assignment, judge: Judge, lang: str) -> FixPlan:
    files, left, fixed = plan.new, list(plan.left), list(plan.fixed)
    said = Translator(lang)(say("the advice on this check"))
    for check, attempt in ADVISED:
        case = Case(files, Finding("", ""), assignment)
        new = attempt(case)
        if new is not None and _no_worse(left, judge(new), case):
            changed = [
                path for path, file in new.by_path.items() if files.by_path.get(path) != file
            ]
            fixed.append(Finding(check, "", file=changed[0], actual=said))
            files = new
    return replace(plan, new=files, fixed=tuple(fixed))
