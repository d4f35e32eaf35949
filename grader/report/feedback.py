"""The report as a student may see it: a pure function, used before anything is rendered for them.

A renderer shows what is in the report. So what a student must not read is taken out of the report,
and no renderer can show it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import datetime, timezone

from grader.base.i18n.translator import Translator
from grader.report.blocks import UNSEEN, roots
from grader.report.detail import AS_POLICY, Detail, FeedbackRules
from grader.report.model import CheckResult, Evidence, Mistake, Report, RunInfo

OF_DETAIL: Mapping[Detail, Mapping[str, object]] = {  # what a level adds: the fields it fills
    Detail.WHERE: {
        "expected": "",
        "actual": "",
        "where": None,
        "mistakes": [],
        "consequence_of": "",
    },
    Detail.WHY: {"rationale": ""},
    Detail.KIND: {"fix": "", "advice": []},
    Detail.LINE: {"patch": ""},
}


MISNAMED = "source.misnamed_node_file"
NO_ENTRY = "setup.no_entry"
OF_FILE = {MISNAMED, "source.misplaced_node_file", "source.no_node_file", "source.empty_node_file"}
"""The mistakes because of which there is no node that an entry point could name."""


def with_feedback(
    report: Report,
    detail: Detail,
    *,
    of: Mapping[str, Detail] | None = None,
    show_hidden: bool = False,
) -> Report:
    """Return the report with what a student may know about each check.

    `of` has other levels for some checks, by their ids. Checks that are not `visible` keep only
    their points, unless `of` or `show_hidden` says otherwise. The parameters of a mistake may
    contain the line that fixes it: they need `Detail.LINE`. The advice of a check that passed may
    say how another one is fixed: it needs `Detail.KIND` as long as a check fails.
    """
    levels = dict(of or {})
    checks = []
    some_fail = any(check.status == "failed" for check in report.checks)
    for check in report.checks:
        seen = show_hidden or check.visibility == "visible"
        level = levels.get(check.id, detail if seen else Detail.POINTS)
        checks.append(_with_detail(check, level, some_fail=some_fail))
    update: dict[str, object] = {"checks": checks}
    if detail < Detail.WHERE:
        update["evidence"] = Evidence()
        update["runs"] = [_without_wanted(run) for run in report.runs]
    return report.model_copy(update=update)


def without_hidden(report: Report) -> Report:
    """Return a report whose JSON names no hidden check: they are `hidden.1` and so on."""
    hidden = [check.id for check in report.checks if check.visibility != "visible"]
    names = {check_id: f"hidden.{n}" for n, check_id in enumerate(hidden, 1)}
    title = Translator(report.lang)(UNSEEN)

    def named(check: CheckResult) -> CheckResult:
        update: dict[str, object] = {
            "depends": [names.get(other, other) for other in check.depends],
            "blocked_by": names.get(check.blocked_by, check.blocked_by),
            "consequence_of": names.get(check.consequence_of, check.consequence_of),
        }
        if check.id in names:
            update |= {"id": names[check.id], "title": title, "actual": "", "seconds": 0}
        return check.model_copy(update=update)

    return report.model_copy(update={"checks": [named(check) for check in report.checks]})


def handed_back(
    report: Report, *, now: datetime | None = None, show_hidden: bool = False
) -> Report:
    """Return the report as it is handed back at `now` (default: the present), by its own rules."""
    due, rules = report.assignment.due, report.assignment.feedback
    detail = rules.handed_back(due, now or datetime.now(timezone.utc))
    return with_feedback(report, detail, show_hidden=show_hidden)


def with_rules(report: Report, word: str) -> Report:
    """Return the report with a feedback word in place of its assignment's rules.

    `AS_POLICY` keeps them. The word is one of `detail.WORDS`.
    """
    if word == AS_POLICY:
        return report
    rules = FeedbackRules.model_validate(word)
    info = report.assignment.model_copy(update={"feedback": rules})
    return report.model_copy(update={"assignment": info})


def for_lab(
    report: Report, rules: FeedbackRules, *, hints: int = 0, explain: bool = False
) -> Report:
    """Return what a student sees of their own package: the next hints only when they ask.

    `hints` (0 to `HINTS`) is how many they asked for about the first failure; `explain` shows
    everything about all failures, if the rules allow hints.
    """
    if rules.lab == "hints" and explain:
        return with_feedback(report, Detail.LINE)
    first = first_failure(report.checks)
    of = {first.id: rules.in_lab(hints)} if first is not None else {}
    return with_feedback(report, rules.in_lab(0), of=of)


def first_failure(checks: Sequence[CheckResult]) -> CheckResult | None:
    """Return the failed check to look at first, of the visible ones; None if none failed.

    It is the one because of which most checks were skipped; of equals, the first. A failure that is
    only the consequence of another one comes after all others.
    """
    failed = [c for c in checks if c.status == "failed" and c.visibility == "visible"]
    return most_stopping(failed, checks) if failed else None


def most_stopping(failed: Sequence[CheckResult], checks: Sequence[CheckResult]) -> CheckResult:
    """Return that check of some failed ones; see `first_failure`.

    A file of another name comes before the entry point that names it: the entry follows the file.
    Where there is no entry yet, the file that it will name comes first, too. Of the checks that judge
    the messages, answers and lines of runs, the first one that explains itself is nearest to the cause.
    """
    causes = [cause.id for c in checks if c.status == "skipped" for cause in roots(c, checks)]
    found = max(failed, key=lambda check: (not check.consequence_of, causes.count(check.id)))
    if found.run:
        found = next((one for one in failed if one.run and not one.consequence_of), found)
    of_entry = found.where is not None and found.where.file == "setup.py"
    first = OF_FILE if any(m.id == NO_ENTRY for m in found.mistakes) else {MISNAMED}
    named = [c for c in failed if any(m.id in first for m in c.mistakes)]
    named = [c for c in named if c.node == found.node]
    return named[0] if of_entry and named else found


def _with_detail(check: CheckResult, level: Detail, *, some_fail: bool) -> CheckResult:
    update: dict[str, object] = {}
    if check.status in ("failed", "error"):
        for needed, fields in OF_DETAIL.items():
            update |= fields if level < needed else {}
        if level < Detail.LINE:
            update["fault"] = ""
            update.setdefault("mistakes", [Mistake(id=one.id) for one in check.mistakes])
    elif level < Detail.WHERE:
        update = {"advice": [], "actual": check.actual if check.status != "passed" else ""}
    elif level < Detail.KIND and some_fail:
        update = {"advice": []}
    return check.model_copy(update=update)


def _without_wanted(run: RunInfo) -> RunInfo:
    return run.model_copy(update={"wanted": {}, "plots": [], "drawn": {}})
