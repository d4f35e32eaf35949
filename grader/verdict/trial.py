"""Judges whether a fix of a package helps a failed check: the package is built and run with it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from grader.base.errors import GraderError
from grader.base.i18n.message import Message, joined
from grader.base.i18n.translator import Translator
from grader.base.shown import shown
from grader.mistakes.catalogue import CATALOGUE
from grader.package.edit.diff import diff, digest_of
from grader.package.edit.files import Files
from grader.report.model import CheckResult, Mistake
from grader.verdict.checks.parsed import line_at
from grader.verdict.diagnose import RAISES
from grader.verdict.evaluate import evaluate_checks
from grader.verdict.evidence import Evidence
from grader.verdict.fix import fixes_of
from grader.verdict.search import recognised

MOST_TRIED = 6
"""The most fixes of one package that are tried: each takes a build and a run."""
MOST_ON_TOP = 2
"""The most fixes that are tried together with the first one."""
WHY = ("node.", "setup.", "package.", "source.", "interface.", "beside.")
"""How the ids of mistakes begin that say why something failed, and not only what was seen."""
COUNTS = ("run.starts", "run.spins", "run.output")
"""The checks that pass if the node counts."""
ERRORS = (*RAISES, "build.setup_error")
"""The mistakes that were seen as an exception."""
RUNS = "run."
"""How the ids of checks begin that a change of the node's files can let pass."""


@dataclass(frozen=True)
class Tried:
    """Whether a fix helps (None: not known), the files as tried last, and the cause of what is left.

    `later` are the mistakes for which further fixes were tried on top.
    """

    helps: bool | None
    files: Files
    left: str = ""
    later: tuple[Message, ...] = ()


class Trial:
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
        root, same = root_of(after), seen_by(after) == seen_by(self._before)
        if root is None or root == root_of(self._before) or (same and _is_error(after)):
            return Tried(False, new)
        if worse:
            return Tried(False, new)
        return Tried(None, new, root.id if same else "")

    def passes_with(self, new: Files) -> bool:
        """Whether the check passed with files that were tried already."""
        digest = digest_of(diff(self._old, new))
        fixed = self._evidence.tried.get(digest)
        return fixed is not None and fixed.results[self._before.id].status == "passed"

    def changes(self, new: Files) -> bool:
        """Whether the check sees something else with a fix, or passes."""
        fixed = self._fixed(new)
        after = fixed.results[self._before.id] if fixed is not None else None
        return after is None or after.status != "failed" or seen_by(after) != seen_by(self._before)

    def is_better(self, new: Files, *, passes: bool) -> bool:
        """Whether the check passes with a fix, or (not `passes`) sees something else, and not worse."""
        fixed = self._fixed(new)
        if passes:
            left = [c for c in COUNTS if fixed and fixed.results[c].status == "failed"]
            return bool(self.helps(new, on_top=0).helps) and not left
        if fixed is None or self._breaks_a_check(fixed):
            return False
        after = fixed.results[self._before.id]
        other = after.status == "failed" and seen_by(after)[0] != seen_by(self._before)[0]
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
        digest = digest_of(diff(self._old, new))
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
    root, where = root_of(after), after.where
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


def root_of(result: CheckResult) -> Mistake | None:
    """Return the recognised mistake behind a failure; None if there is only what was seen."""
    first = result.mistakes[0] if result.mistakes else None
    return first if first is not None and first.id.startswith(WHY) else None


def _score(results: Mapping[str, CheckResult]) -> float:
    return sum(result.score for result in results.values())


def _is_error(result: CheckResult) -> bool:
    return any(mistake.id in ERRORS for mistake in result.mistakes)


def seen_by(result: CheckResult) -> tuple[list[str], str]:
    """Return what a check saw, without numbers: times differ from run to run."""
    ids = [mistake.id for mistake in result.mistakes if not mistake.id.startswith(WHY)]
    return ids, re.sub(r"\d+", "", result.actual.partition("\n")[0])
