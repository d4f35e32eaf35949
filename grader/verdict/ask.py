"""Asks a check, and puts what it says into a result in the reader's language."""

from __future__ import annotations

import time
import traceback
from typing import cast

from grader.base.errors import SurroundingsError
from grader.base.i18n.message import say
from grader.base.i18n.translator import Speaker
from grader.course.assignment import CheckUse
from grader.report import model
from grader.verdict.checks.all import CHECKS
from grader.verdict.diagnose import diagnose
from grader.verdict.evidence import Evidence
from grader.verdict.registry import Blocked
from grader.verdict.registry import Check
from grader.verdict.registry import Failed
from grader.verdict.registry import Inconclusive
from grader.verdict.registry import Passed


def ask(check: Check, evidence: Evidence, speak: Speaker) -> model.CheckResult:
    """Ask one check; the build and the run happen in the first check that needs them."""
    uses = {use.id: use for use in evidence.assignment.checks}
    return spoken(_found(check, uses[check.id], evidence, uses), speak)


def told(said: Passed | Failed | Inconclusive) -> dict[str, object]:
    """Return what a check said as fields of its result, not yet in the reader's language."""
    if isinstance(said, Passed):
        return {"status": "passed", "actual": said.actual, "advice": list(said.advice)}
    if isinstance(said, Failed):
        texts = ("expected", "actual", "rationale", "fix", "advice")
        found: dict[str, object] = {name: getattr(said, name) for name in texts}
        return {"status": "failed", "mistakes": said.mistakes, "where": said.where, **found}
    return {"status": "inconclusive", "actual": said.reason}


def spoken(found: dict[str, object], speak: Speaker) -> model.CheckResult:
    """Return a result with all its texts in the reader's language."""
    texts = {name: speak(text) for name, text in found.items() if isinstance(text, str)}
    advice = [speak(text) for text in cast("list[str]", found.get("advice", []))]
    return model.CheckResult.model_validate({**found, **texts, "advice": advice})


def _found(
    check: Check, use: CheckUse, evidence: Evidence, uses: dict[str, CheckUse]
) -> dict[str, object]:
    common = {
        "id": check.id,
        "title": check.title,
        "max_score": use.points,
        "visibility": use.visibility,
        "depends": [dependency for dependency in check.depends if dependency in uses],
    }
    blocker = _blocker(check, evidence)
    if blocker:
        return _skipped(common, blocker, evidence)
    begin = time.monotonic()
    found: dict[str, object]
    try:
        said = check.ask(evidence)
        if isinstance(said, Blocked):
            return _skipped(common, said.by, evidence)
        if isinstance(said, Failed):
            failed, cause = diagnose(said, evidence)
            found = {**told(failed), "consequence_of": cause}
        else:
            found = told(said)
    except SurroundingsError:
        raise
    except Exception:  # a fault of ours in one check must not lose the verdict on the others
        found = {"status": "error", "actual": traceback.format_exc(limit=-4)}
    if found["status"] == "passed":
        found["score"] = use.points
    seconds = round(time.monotonic() - begin, 3)
    return {**common, **found, "seconds": seconds}


def _blocker(check: Check, evidence: Evidence) -> str:
    for dependency in check.depends:
        result = evidence.results.get(dependency)
        if result is not None and result.status != "passed":
            return result.blocked_by or dependency
    return ""


def _skipped(common: dict[str, object], by: str, evidence: Evidence) -> dict[str, object]:
    cause = evidence.results.get(by)
    root = (cause.blocked_by if cause is not None else "") or by
    title = CHECKS[root].title if root in CHECKS else root
    if evidence.is_hidden(root) and common["visibility"] == "visible":
        title = say("a hidden check")
    actual = say("not asked, because of: {title}", title=title)
    return {**common, "status": "skipped", "blocked_by": root, "actual": actual}
