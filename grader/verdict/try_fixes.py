"""Tries the fixes of a failed check: builds and runs the package with each before one is shown.

A fix that leaves the failure as it was shows that the diagnosis does not explain it. The check is
then diagnosed again without that kind of mistake. Another diagnosis has to have a fix that helps;
if none has, the report only says what was seen. A fix of what the files alone show has to let the
package get further; what they show stays true without it.
"""

from __future__ import annotations

import keyword
import re
from collections.abc import Sequence
from itertools import islice

from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator
from grader.package.edit.files import Files
from grader.report.model import CheckResult, Mistake
from grader.verdict.checks.all import STATIC
from grader.verdict.evaluate import evaluate_again
from grader.verdict.evidence import Evidence
from grader.verdict.explained_by_run import with_change_of_run, with_fact
from grader.verdict.fix import fixes_of, patch_text
from grader.verdict.follow import fact_behind
from grader.verdict.found_change import FAR, FoundChange
from grader.verdict.search import KIND, fix_text, recognised, value_texts
from grader.verdict.trial import RUNS, Trial, Tried, root_of

MOST_ALTERNATIVES = 2
"""The most fixes of one mistake that are tried."""
VAGUE = {
    *("run.died_at_start", "run.ended_early", "run.exits_at_once", "run.stops", "run.no_lines"),
    *("run.wrong_text", "run.wrong_start", "run.wrong_step", "run.constant_counter", "run.twice"),
    *("run.wrong_period", "run.never_spins"),
}
"""What was seen that has many causes: its text alone helps little."""
CAUSED_ELSEWHERE = ("node.severity_changed",)
"""Mistakes of a line whose cause is a value from another one: a change of the line hides it."""
FURTHER = say("The change also corrects what would fail next.")
SLIGHT = 2
"""The highest cost of a change of a mistake's own line that a certain change elsewhere does not replace."""
EVERYWHERE = {*keyword.kwlist, "self", "rclpy", "node", "Node", "main", "init", "info"}
"""Names that do not tell which lines of a program a text speaks of."""


def with_tried_fix(result: CheckResult, evidence: Evidence, translate: Translator) -> CheckResult:
    """Return a failed check's result with a fix that helps, if one is known or can be found."""
    found = _with_known_fix(result, evidence, translate)
    root = root_of(found)
    if evidence.assignment.runs:
        told = found.patch or found.consequence_of
        return found if told else with_change_of_run(found, evidence, translate)
    if found.consequence_of or not found.id.startswith(RUNS):
        return found
    if found.patch and _needs_more(found, translate):
        sure = [one for one in _found_changes(evidence) if one.is_certain]
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
    fact = fact_behind(evidence, result)
    return with_fact(result, fact, evidence, translate) if fact is not None else None


def _needs_more(found: CheckResult, translate: Translator) -> bool:
    """Whether the usual fix of what was only seen helps only together with further fixes."""
    return root_of(found) is None and translate(FURTHER) in found.advice


def _with_small_change(
    result: CheckResult, evidence: Evidence, translate: Translator
) -> CheckResult | None:
    """Return the result with a small change that was found and helps; None if there is none.

    A known mistake keeps its reason with a change of its own line. If no such change helps, but a
    certain one of another place does, the mistake is elsewhere, and the change is told instead of it,
    as it is of what was only seen.
    """
    root = root_of(result)
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
    known = root_of(result) is not None

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
        if Trial(result, evidence, translate).is_better(new, passes=change.counts):
            if replaces or root_of(result) is None:
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
        str(step.line) in given or told & _names(f"{step.name} {step.written}")
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
        trial, refuted = Trial(result, evidence, translate), bool(without)
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
        root = root_of(result)
        if result.id in STATIC or not refuted:
            return result
        if root is None or root.id in without:
            return result if without else without_change(result, translate)
        without.add(root.id)
        result = evaluate_again(result.id, evidence, translate, without=without)


def without_change(result: CheckResult, translate: Translator) -> CheckResult:
    """Return the result of what was only seen, whose usual fix does not help: its text asks for it."""
    if not any(mistake.id.startswith("run.") for mistake in result.mistakes):
        return result
    follow = say(
        "The usual change for this was tried, and the check still fails with it. Follow the program step "
        "by step to the line that logs: log the values that each step uses, and compare them with what "
        "you expect."
    )
    return result.model_copy(update={"fix": translate(follow)})


def _other_cause(
    result: CheckResult, tried: Tried, evidence: Evidence, translate: Translator
) -> CheckResult | None:
    """Return the result with the cause that is left after the fix, if it can be seen without it too.

    The check sees the same with and without the fix: the other cause has to be removed anyway.
    """
    root = root_of(result)
    if tried.helps is not None or not tried.left or root is None:
        return None
    other = evaluate_again(result.id, evidence, translate, without={root.id})
    now = root_of(other)
    return other if now is not None and now.id == tried.left else None


def _without_first(
    result: CheckResult, trial: Trial, new: Files, evidence: Evidence, translate: Translator
) -> CheckResult | None:
    """Return the result of another mistake whose fix alone is enough, where the fix `new` changes nothing.

    The fix helped only with another one on top: then the other one alone may be the reason.
    """
    root = root_of(result)
    if root is None or trial.changes(new):
        return None
    other = evaluate_again(result.id, evidence, translate, without={root.id})
    if root_of(other) is None:
        return None
    again = Trial(other, evidence, translate)
    fix = next(fixes_of(other, evidence.submission, evidence.assignment), None)
    if fix is None or not again.helps(fix, on_top=0).helps:
        return None
    return _with_change(other, Files.of(evidence.submission), Tried(True, fix), fix, translate)


def _with_change(
    result: CheckResult, old: Files, tried: Tried, new: Files, translate: Translator
) -> CheckResult:
    """Return a result with its fix, and with those that the check needs after it, if that is known."""
    rest = [FURTHER, *tried.later] if tried.files is not new and not result.consequence_of else []
    patch, advice = patch_text(old, tried.files), [*result.advice, *map(translate, rest)]
    update = {"patch": patch, "advice": advice}
    return result.model_copy(update=update)
