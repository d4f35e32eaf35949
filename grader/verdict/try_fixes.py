"""Tries the fixes of a failed check: builds and runs the package with each before one is shown.

A fix that leaves the failure as it was shows that the diagnosis does not explain it. The check is
then diagnosed again without that kind of mistake. Another diagnosis has to have a fix that helps;
if none has, the report only says what was seen. A fix of what the files alone show has to let the
package get further; what they show stays true without it.
"""

from __future__ import annotations

import hashlib
import keyword
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import islice

from grader.base.errors import GraderError
from grader.base.i18n.message import Message, joined, say
from grader.base.i18n.translator import Translator
from grader.base.shown import shown
from grader.mistakes.catalogue import CATALOGUE
from grader.package.edit.diff import diff
from grader.package.edit.files import Files
from grader.report.model import CheckResult, Mistake
from grader.verdict.checks.all import STATIC
from grader.verdict.checks.parsed import line_at
from grader.verdict.diagnose import RAISES
from grader.verdict.evaluate import evaluate_again, evaluate_checks
from grader.verdict.evidence import Evidence
from grader.verdict.fix import fixes_of, patch_text
from grader.verdict.fix_text import matching_text, without_change
from grader.verdict.found_change import FAR, FoundChange
from grader.verdict.search import KIND, fix_text, recognised, value_texts, values_seen

MOST_TRIED = 6
"""The most fixes of one package that are tried: each takes a build and a run."""
MOST_ALTERNATIVES = 2
"""The most fixes of one mistake that are tried."""
MOST_ON_TOP = 2
"""The most fixes that are tried together with the first one."""
WHY = ("node.", "setup.", "package.", "source.", "interface.", "beside.")
"""How the ids of mistakes begin that say why something failed, and not only what was seen."""
RUNS = "run."
"""How the ids of checks begin that a change of the node's files can let pass."""
COUNTS = ("run.starts", "run.spins", "run.output")
"""The checks that pass if the node counts."""
VAGUE = {
    *("run.died_at_start", "run.ended_early", "run.exits_at_once", "run.stops", "run.no_lines"),
    *("run.wrong_text", "run.wrong_start", "run.wrong_step", "run.constant_counter", "run.twice"),
    *("run.wrong_period", "run.never_spins"),
}
"""What was seen that has many causes: its text alone helps little."""
CAUSED_ELSEWHERE = ("node.text_not_a_number", "node.severity_changed")
"""The mistakes of a line whose cause is a value from another one: a change of the line hides it."""
MEASURED = "node.measures_time"
REWRITTEN = (MEASURED, "node.period_tiny", "node.log_if", "node.return_early")
"""The mistakes whose fix writes the program in another way: a certain change of it comes first."""
FURTHER = say("The change also corrects what would fail next.")
SLIGHT = 2
"""The highest cost of a change of a mistake's own line that a certain change elsewhere does not replace."""
EVERYWHERE = {*keyword.kwlist, "self", "rclpy", "node", "Node", "main", "init", "info"}
"""Names that do not tell which lines of a program a text speaks of."""
ERRORS = (*RAISES, "build.setup_error")
"""The mistakes that were seen as an exception."""


def with_tried_fix(result: CheckResult, evidence: Evidence, translate: Translator) -> CheckResult:
    """Return a failed check's result with a fix that helps, if one is known or can be found."""
    found = _with_known_fix(result, evidence, translate)
    root = _root(found)
    if found.consequence_of or not found.id.startswith(RUNS):
        return found
    rewritten = root is not None and root.id in REWRITTEN
    if found.patch and (rewritten or _needs_more(found, translate)):
        measured = root if root is not None and root.id == MEASURED else None
        sure = [
            one
            for one in _found_changes(evidence)
            if one.is_certain
            or (measured is not None and one.cost <= SLIGHT and _fits(one, found, measured))
        ]
        return _with_first(sure, result, evidence, translate, replaces=True) or found
    if found.patch:
        return found
    changed = _with_small_change(found, evidence, translate)
    if root is None and (changed is None or not changed.patch):
        changed = _with_followed(found, evidence, translate) or changed
    return changed or found


def _with_followed(
    result: CheckResult, evidence: Evidence, translate: Translator
) -> CheckResult | None:
    """Return the result with what a followed run shows; None if that is nothing."""
    if evidence.with_fix is None or evidence.follow is None:
        return None
    from grader.verdict.follow import followed  # noqa: PLC0415 - few packages need it

    for mistake in result.mistakes:
        shows = followed(evidence, mistake.id)
        if shows is not None:
            now = evaluate_again(result.id, evidence, translate, found=shows[0])
            texts = [] if now.consequence_of else values_seen(shows[1])
            return now.model_copy(update={"advice": [*now.advice, *map(translate, texts)]})
    return None


def _needs_more(found: CheckResult, translate: Translator) -> bool:
    """Whether the usual fix of what was only seen helps only together with further fixes."""
    return _root(found) is None and translate(FURTHER) in found.advice


def _with_small_change(
    result: CheckResult, evidence: Evidence, translate: Translator
) -> CheckResult | None:
    """Return the result with a small change that was found and helps; None if there is none.

    A known mistake keeps its reason with a change of its own line. If no such change helps, but a
    certain one of another place does, the mistake is elsewhere, and the change is told instead of it,
    as it is of what was only seen.
    """
    root = _root(result)
    if root is None and not {mistake.id for mistake in result.mistakes} & VAGUE:
        return None
    found = _found_changes(evidence)
    if root is None:
        return _with_first(_nearest(found, result, evidence), result, evidence, translate)
    fits = _nearest([one for one in found if _fits(one, result, root)], result, evidence)
    sure = [one for one in found if one.is_certain and root.id not in CAUSED_ELSEWHERE]
    tries = [
        lambda: _with_first(fits, result, evidence, translate),
        lambda: _with_first(sure, result, evidence, translate, replaces=True),
    ]
    if fits and fits[0].cost > SLIGHT:
        tries.reverse()
    return tries[0]() or tries[1]()


def _found_changes(evidence: Evidence) -> Sequence[FoundChange]:
    """Return the small changes that help a package, which is searched once."""
    if evidence.search is None or evidence.with_fix is None:
        return []
    if evidence.found_changes is None:
        evidence.found_changes = evidence.search(evidence)
    return evidence.found_changes


def _nearest(
    changes: Sequence[FoundChange], result: CheckResult, evidence: Evidence
) -> list[FoundChange]:
    """Return changes in the order in which they are tried: one that was told before comes first."""
    near = {id(one): one.distance(result.where) for one in changes}
    told = [m for r in evidence.results.values() for m in r.mistakes if m.id == KIND]
    known = _root(result) is not None

    def order(one: FoundChange) -> tuple[bool, int, int, int, int]:
        distance = near[id(one)]
        first = distance if known else 0
        return (recognised(one).mistake not in told, first, one.rank, one.cost, distance)

    return sorted(changes, key=order)


def _with_first(
    changes: Sequence[FoundChange],
    result: CheckResult,
    evidence: Evidence,
    translate: Translator,
    *,
    replaces: bool = False,
) -> CheckResult | None:
    """Return the result with the first of the changes that helps; None if none of them does.

    The change replaces the reason if there is none, or if it `replaces` a known mistake.
    """
    old = Files.of(evidence.submission)
    for change in changes[:MOST_ALTERNATIVES]:
        new = change.of(old)
        if _Trial(result, evidence, translate).is_better(new, passes=change.counts):
            if replaces or _root(result) is None:
                result = evaluate_again(result.id, evidence, translate, found=recognised(change))
            fix = result.fix if result.consequence_of else translate(fix_text(change, result.where))
            other = [say("Another change may fit what you want to do better.")]
            seen = [] if result.consequence_of else value_texts(change)
            more = [*seen, *(other if change.counts else [])]
            advice = [*result.advice, *map(translate, more)]
            patch = "" if change.is_cautious else patch_text(old, new)
            update = {"fix": fix, "patch": patch, "advice": advice}
            return result.model_copy(update=update)
    return None


def _fits(change: FoundChange, result: CheckResult, root: Mistake) -> bool:
    """Whether a mistake's reason can explain a change: it is of its line, or of that next to it."""
    far = change.distance(result.where)
    if root.id in CAUSED_ELSEWHERE:
        return False
    return change.is_simple and (far == 0 or (far < FAR and _speaks_of(root, change)))


def _speaks_of(root: Mistake, change: FoundChange) -> bool:
    """Whether a mistake's text names a line that a change changes, or something in it."""
    given = {str(value) for value in root.params.values()}
    told = _names(" ".join(given))
    return any(
        str(step.line) in given or told & _names(f"{step.name} {step.written} {step.form}")
        for step in change.steps
    )


def _names(code: str) -> set[str]:
    """Return the names in code that a program may have given."""
    return set(re.findall(r"[^\W\d]\w+", code)) - EVERYWHERE


def _with_known_fix(result: CheckResult, evidence: Evidence, translate: Translator) -> CheckResult:
    """Return a failed check's result with a fix that helps, if its mistake has one.

    A fix that could not be tried is kept: the form of the mistake is all that it relies on.
    """
    old, without = Files.of(evidence.submission), set[str]()
    while True:
        trial, refuted = _Trial(result, evidence, translate), bool(without)
        fixes = fixes_of(result, evidence.submission, evidence.assignment)
        for new in islice(fixes, MOST_ALTERNATIVES):
            tried = trial.of_files(new) if result.id in STATIC else trial.helps(new)
            if tried.helps or (tried.helps is None and not without):
                other = _other_cause(result, tried, evidence, translate)
                if (
                    other is None
                    and tried.helps
                    and tried.files is not new
                    and result.id not in STATIC
                ):
                    other = _without_first(result, trial, new, evidence, translate)
                return other or _with_change(result, old, tried, new, translate)
            refuted = True
        root = _root(result)
        if result.id in STATIC or not refuted:
            return result
        if root is None or root.id in without:
            return result if without else without_change(result, translate)
        without.add(root.id)
        result = evaluate_again(result.id, evidence, translate, without=without)


@dataclass(frozen=True)
class Tried:
    """Whether a fix helps (None: not known), the files as tried last, and the cause of what is left.

    `later` are the mistakes for which further fixes were tried on top.
    """

    helps: bool | None
    files: Files
    left: str = ""
    later: tuple[Message, ...] = ()


def _other_cause(
    result: CheckResult, tried: Tried, evidence: Evidence, translate: Translator
) -> CheckResult | None:
    """Return the result with the cause that is left after the fix, if it can be seen without it too.

    The check sees the same with and without the fix: the other cause has to be removed anyway.
    """
    root = _root(result)
    if tried.helps is not None or not tried.left or root is None:
        return None
    other = evaluate_again(result.id, evidence, translate, without={root.id})
    now = _root(other)
    return other if now is not None and now.id == tried.left else None


def _without_first(
    result: CheckResult, trial: _Trial, new: Files, evidence: Evidence, translate: Translator
) -> CheckResult | None:
    """Return the result of another mistake whose fix alone is enough, where the fix `new` changes nothing.

    The fix helped only with another one on top: then the other one alone may be the reason.
    """
    root = _root(result)
    if root is None or trial.changes(new):
        return None
    other = evaluate_again(result.id, evidence, translate, without={root.id})
    if _root(other) is None:
        return None
    again = _Trial(other, evidence, translate)
    fix = next(fixes_of(other, evidence.submission, evidence.assignment), None)
    if fix is None or not again.helps(fix, on_top=0).helps:
        return None
    return _with_change(other, Files.of(evidence.submission), Tried(True, fix), fix, translate)


def _with_change(
    result: CheckResult, old: Files, tried: Tried, new: Files, translate: Translator
) -> CheckResult:
    """Return a result with its fix, and with those that the check needs after it, if that is known."""
    rest = [FURTHER, *tried.later] if tried.files is not new and not result.consequence_of else []
    patch, fix = patch_text(old, tried.files), matching_text(result, old, new, translate)
    update = {"patch": patch, "fix": fix, "advice": [*result.advice, *map(translate, rest)]}
    return result.model_copy(update=update)


class _Trial:
    """Judges whether a fix helps a check."""

    def __init__(self, result: CheckResult, evidence: Evidence, translate: Translator) -> None:
        self._before = result
        self._evidence = evidence
        self._translate = translate
        self._old = Files.of(evidence.submission)

    @property
    def _all(self) -> dict[str, CheckResult]:
        """The results of all checks without a fix: those after this one are evaluated now."""
        evidence = self._evidence
        if not evidence.untried:
            kept, evidence.results = evidence.results, {}
            try:
                for _ in evaluate_checks(evidence, self._translate):
                    pass
                evidence.untried = evidence.results
            finally:
                evidence.results = kept
        return evidence.untried

    def of_files(
        self, new: Files, on_top: int = MOST_ON_TOP, later: tuple[Message, ...] = ()
    ) -> Tried:
        """Return whether the package gets further with a fix of what the files alone show.

        It has to help only if the mistake prevents other checks. If another check fails instead, a
        fix of that is tried on top.
        """
        if self._evidence.with_fix is None:
            return Tried(None, new)
        if not any(result.blocked_by == self._before.id for result in self._all.values()):
            return Tried(True, new)
        fixed = self._fixed(new)
        if fixed is None:
            return Tried(None, new)
        if _score(fixed.results) > _score(self._all):
            return Tried(True, new, later=later)
        for check, after in fixed.results.items():
            if after.status == "failed" and self._all[check].status != "failed":
                further = _further(after, fixed, new)
                if further is None or not on_top:
                    break
                return self.of_files(further.files, on_top - 1, (*later, *further.told))
        return Tried(False, new)

    def helps(
        self, new: Files, on_top: int = MOST_ON_TOP, later: tuple[Message, ...] = ()
    ) -> Tried:
        """Return whether a fix lets the check pass.

        If it still fails, up to `on_top` further fixes are tried on top: there may be two mistakes.
        If the second one is known but has no fix, nothing is known about the first one's.
        """
        fixed = self._fixed(new)
        if fixed is None:
            return Tried(None, new)
        after = fixed.results[self._before.id]
        if after.status == "passed":
            tried = Tried(not self._breaks_a_check(fixed), new, later=later)
            return self._with_consequences(tried, on_top)
        further = _further(after, fixed, new)
        if further is not None and on_top:
            return self.helps(further.files, on_top - 1, (*later, *further.told))
        worse = _score(fixed.results) < _score(self._all)
        if after.status != "failed":
            return Tried(False if worse or self._breaks_a_check(fixed) else None, new)
        root, same = _root(after), _seen(after) == _seen(self._before)
        if root is None or root == _root(self._before) or (same and _is_error(after)):
            return Tried(False, new)
        if worse:
            return Tried(False, new)
        return Tried(None, new, root.id if same else "")

    def changes(self, new: Files) -> bool:
        """Whether the check sees something else with a fix, or passes."""
        fixed = self._fixed(new)
        after = fixed.results[self._before.id] if fixed is not None else None
        return after is None or after.status != "failed" or _seen(after) != _seen(self._before)

    def is_better(self, new: Files, *, passes: bool) -> bool:
        """Whether the check passes with a fix, or (not `passes`) sees something else, and not worse."""
        fixed = self._fixed(new)
        if passes:
            left = [c for c in COUNTS if fixed and fixed.results[c].status == "failed"]
            return bool(self.helps(new, on_top=0).helps) and not left
        if fixed is None or self._breaks_a_check(fixed):
            return False
        after = fixed.results[self._before.id]
        other = after.status == "failed" and _seen(after)[0] != _seen(self._before)[0]
        return other and _score(fixed.results) >= _score(self._all)

    def _with_consequences(self, tried: Tried, on_top: int) -> Tried:
        """Return a fix that helps together with one of what was told as a consequence, and still fails."""
        fixed = self._fixed(tried.files)
        if not tried.helps or fixed is None or not on_top:
            return tried
        for check, result in self._all.items():
            after = fixed.results[check]
            if result.consequence_of == self._before.id and after.status == "failed":
                further = _further(after, fixed, tried.files)
                if further is None:
                    return tried
                more = self.helps(further.files, on_top - 1, (*tried.later, *further.told))
                return more if more.helps else tried
        return tried

    def _fixed(self, new: Files) -> Evidence | None:
        """Return the judged evidence of the package with a fix; None if it cannot be tried."""
        tried = self._evidence.tried
        digest = hashlib.sha256(diff(self._old, new)).hexdigest()
        if digest not in tried:
            if self._evidence.with_fix is None or len(tried) >= MOST_TRIED:
                return None
            package = new.put_into(self._evidence.submission)
            try:
                with self._evidence.with_fix(digest, package) as made:
                    if made is None:
                        return None
                    for _ in evaluate_checks(made, self._translate):
                        pass
                    _search_further(made.results[self._before.id], made)
            except GraderError:  # (our own side failed, which says nothing about the fix)
                return None
            tried[digest] = made
        return tried[digest]

    def _breaks_a_check(self, fixed: Evidence) -> bool:
        """Whether a check fails that passes without the fix."""
        passed = [check for check, result in self._all.items() if result.status == "passed"]
        return any(fixed.results[check].status == "failed" for check in passed)


def _search_further(after: CheckResult, fixed: Evidence) -> None:
    """Look for small changes of a fixed package, if a check still fails and no fix of it is known."""
    if after.status != "failed" or not after.id.startswith(RUNS) or fixed.search is None:
        return
    if next(fixes_of(after, fixed.submission, fixed.assignment), None) is None:
        fixed.found_changes = fixed.search(fixed)


@dataclass(frozen=True)
class _Further:
    """The files after a further fix, and what it is for, if that can be told."""

    files: Files
    told: tuple[Message, ...]


def _further(after: CheckResult, fixed: Evidence, done: Files) -> _Further | None:
    """Return a fix of a check that still fails with the fixes already made."""
    found = next(fixes_of(after, fixed.submission, fixed.assignment), None)
    root, where = _root(after), after.where
    for change in [one for one in fixed.found_changes or () if one.counts][:1]:
        if found is None:
            found = change.of(Files.of(fixed.submission))
            root, where = recognised(change).mistake, recognised(change).where
    if found is None:
        return None
    code = line_at(fixed, where) if where is not None else ""
    told: tuple[Message, ...] = ()
    if root is not None and code:
        title = Message(CATALOGUE[root.id].title, {})
        told = (joined(title, shown(code), by=": "),)
    return _Further(found.moved_since(done), told)


def _root(result: CheckResult) -> Mistake | None:
    """Return the recognised mistake behind a failure; None if there is only what was seen."""
    first = result.mistakes[0] if result.mistakes else None
    return first if first is not None and first.id.startswith(WHY) else None


def _score(results: Mapping[str, CheckResult]) -> float:
    return sum(result.score for result in results.values())


def _is_error(result: CheckResult) -> bool:
    return any(mistake.id in ERRORS for mistake in result.mistakes)


def _seen(result: CheckResult) -> tuple[list[str], str]:
    """Return what a check saw, without numbers: times differ from run to run."""
    ids = [mistake.id for mistake in result.mistakes if not mistake.id.startswith(WHY)]
    return ids, re.sub(r"\d+", "", result.actual.partition("\n")[0])
