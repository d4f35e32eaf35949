"""The runner: takes one submission through intake, build and run, and decides each check.

It prints nothing: it emits events, and returns the report.
"""

from __future__ import annotations

import time
import traceback
from dataclasses import dataclass
from dataclasses import field
from datetime import datetime
from datetime import timezone
from pathlib import Path
from typing import cast

from grader import events
from grader.assignment import Assignment
from grader.assignment import CheckUse
from grader.checks.all import CHECKS
from grader.checks.registry import Blocked
from grader.checks.registry import Check
from grader.checks.registry import Failed
from grader.checks.registry import Inconclusive
from grader.checks.registry import Passed
from grader.errors import SurroundingsError
from grader.evidence import Evidence
from grader.fix.plan import patch_for
from grader.limits import Limits
from grader.locale.message import say
from grader.locale.speaker import Speaker
from grader.mistakes.diagnose import diagnose
from grader.observer import Event
from grader.report import model
from grader.report.compose import compose
from grader.ros.distro import Distro
from grader.sandbox.choose import open_sandbox
from grader.session import Session
from grader.submission import Submission
from grader.submission import take_in

STAGES = {
    "package": ("intake", say("looking at the package")),
    "source": ("intake", say("looking at the package")),
    "build": ("build", say("building with colcon")),
    "entry_point": ("build", say("building with colcon")),
    "run": ("run", say("running the node")),
}


@dataclass(frozen=True, kw_only=True)
class Order:
    """What is to be marked, and how; `lang` is the language of every text in the report."""

    path: Path
    assignment: Assignment
    distro: Distro
    sandbox: str = "auto"
    name: str | None = None
    limits: Limits = field(default_factory=Limits)
    own_code: bool = False
    lang: str = "en"
    student_id: str = ""
    modes_kept: bool = True
    """False where the way here lost the exec bits of the files (see `take_in`)."""


def grade(order: Order, listener: events.Listener) -> model.Report:
    """Mark one submission on one distro.

    Raises UsageError for a path that does not exist or cannot be read, SurroundingsError where
    the grader's own surroundings fail; everything else is in the report.
    """
    begin = time.monotonic()
    submission = take_in(
        order.path,
        package=order.assignment.package,
        node_file=order.assignment.node_file,
        name=order.name,
        modes_kept=order.modes_kept,
    )
    return mark(submission, order, listener, intake=time.monotonic() - begin)


def mark(
    submission: Submission, order: Order, listener: events.Listener, *, intake: float = 0
) -> model.Report:
    """Mark what was taken in before, which took `intake` seconds; all else as `grade`."""
    started = datetime.now(timezone.utc)
    begin = time.monotonic() - intake
    assignment = order.assignment
    speak = Speaker(order.lang)
    opening = say("opening the sandbox for ROS {distro}", distro=order.distro.name)
    listener(events.StageStarted("setup", speak(opening)))
    sandbox = open_sandbox(
        order.sandbox,
        order.distro,
        order.limits,
        own_code=order.own_code,
        say=lambda text: listener(events.Note(text)),
    )
    setup = time.monotonic() - begin - intake
    listener(events.StageFinished("setup", setup))
    with Session(sandbox, assignment) as session:
        evidence = _evidence(session, submission, listener)
        results = _decide(evidence, assignment, listener, speak)
        limits = sandbox.limit_report()
    report = compose(evidence, results, order.distro, sandbox.ros, speak)
    environment = report.environment.model_copy(update={"sandbox": sandbox.name, "limits": limits})
    timing = model.Timing(
        setup=round(setup, 3),
        intake=round(intake, 3),
        build=round(session.timing["build"], 3),
        run=round(session.timing["run"], 3),
        total=round(time.monotonic() - begin, 3),
    )
    whose = report.submission.model_copy(update={"student_id": order.student_id or None})
    return report.model_copy(
        update={
            "submission": whose,
            "environment": environment,
            "timing": timing,
            "started": started.isoformat(),
        }
    )


def _evidence(session: Session, submission: Submission, listener: events.Listener) -> Evidence:
    def tick(event: Event) -> None:
        listener(events.TickSeen(event.n, event.text, event.virtual))

    return Evidence(
        session.assignment,
        submission,
        build=lambda: session.build(submission),
        run=lambda: session.run(tick),
    )


def _decide(
    evidence: Evidence, assignment: Assignment, listener: events.Listener, speak: Speaker
) -> list[model.CheckResult]:
    uses = {use.id: use for use in assignment.checks}
    stage = ""
    begin = time.monotonic()
    for check_id, check in CHECKS.items():
        if check_id not in uses:
            continue
        now, title = STAGES[check_id.partition(".")[0]]
        if now != stage:
            if stage:
                listener(events.StageFinished(stage, time.monotonic() - begin))
            stage, begin = now, time.monotonic()
            listener(events.StageStarted(stage, speak(title)))
        visibility = uses[check_id].visibility
        listener(events.CheckStarted(check.id, speak(check.title), visibility))
        result = ask(check, evidence, speak)
        if result.status == "failed":
            result = result.model_copy(update={"patch": _patch(result, evidence)})
        evidence.results[check_id] = result
        listener(events.CheckFinished(result))
    listener(events.StageFinished(stage, time.monotonic() - begin))
    return [evidence.results[use.id] for use in assignment.checks]


def ask(check: Check, evidence: Evidence, speak: Speaker) -> model.CheckResult:
    """Ask one check; the build and the run happen in the first check that needs them."""
    uses = {use.id: use for use in evidence.assignment.checks}
    return _said(_found(check, uses[check.id], evidence, uses), speak)


def _said(found: dict[str, object], speak: Speaker) -> model.CheckResult:
    """Return a result with all its texts in the reader's language."""
    texts = {name: speak(text) for name, text in found.items() if isinstance(text, str)}
    advice = [speak(text) for text in cast("list[str]", found.get("advice", []))]
    return model.CheckResult.model_validate({**found, **texts, "advice": advice})


def _patch(result: model.CheckResult, evidence: Evidence) -> str:
    try:
        return patch_for(result, evidence.submission, evidence.assignment)
    except Exception:  # a fault of ours in a mend must not lose the verdict: it has no change then
        return ""


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
        passed = check.function(evidence) or Passed()
        found = {"status": "passed", "score": use.points, "actual": passed.actual}
        found["advice"] = list(passed.advice)
    except Failed as seen:
        failed, cause = diagnose(seen, evidence)
        found = {"status": "failed", "mistakes": failed.mistakes, "where": failed.where}
        found["consequence_of"] = cause
        for name in ("expected", "actual", "rationale", "fix", "advice"):
            found[name] = getattr(failed, name)
    except Blocked as blocked:
        return _skipped(common, blocked.by, evidence)
    except Inconclusive as unknown:
        found = {"status": "inconclusive", "actual": unknown.reason}
    except SurroundingsError:
        raise
    except Exception:  # a fault of ours in one check must not lose the verdict on the others
        found = {"status": "error", "actual": traceback.format_exc(limit=-4)}
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
