"""The runner: takes one submission through intake, build and run, and decides each check.

It prints nothing: it emits events, and returns the report.
"""

from __future__ import annotations

import os
import time
import traceback
from collections.abc import Sequence
from dataclasses import dataclass
from dataclasses import field
from datetime import datetime
from datetime import timezone
from pathlib import Path

import grader
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
from grader.limits import Limits
from grader.observer import Event
from grader.report import model
from grader.ros.distro import Distro
from grader.ros.prefix import Ros
from grader.running import Run
from grader.sandbox.choose import open_sandbox
from grader.session import Session
from grader.submission import Submission
from grader.submission import take_in

MOST_EVIDENCE = 40_000  # characters of build log and of transcript in the report
STAGES = {
    "package": ("intake", "looking at the package"),
    "source": ("intake", "looking at the package"),
    "build": ("build", "building with colcon"),
    "entry_point": ("build", "building with colcon"),
    "run": ("run", "running the node"),
}


@dataclass(frozen=True, kw_only=True)
class Order:
    """What is to be marked, and how."""

    path: Path
    assignment: Assignment
    distro: Distro
    sandbox: str = "auto"
    name: str | None = None
    limits: Limits = field(default_factory=Limits)
    own_code: bool = False
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
    listener(events.StageStarted("setup", f"opening the sandbox for ROS {order.distro.name}"))
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
        results = _decide(evidence, assignment, listener)
        limits = sandbox.limit_report()
    report = _report(order, evidence, results, sandbox.ros)
    environment = report.environment.model_copy(update={"sandbox": sandbox.name, "limits": limits})
    timing = model.Timing(
        setup=round(setup, 3),
        intake=round(intake, 3),
        build=round(session.timing["build"], 3),
        run=round(session.timing["run"], 3),
        total=round(time.monotonic() - begin, 3),
    )
    return report.model_copy(
        update={"environment": environment, "timing": timing, "started": started.isoformat()}
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
    evidence: Evidence, assignment: Assignment, listener: events.Listener
) -> list[model.CheckResult]:
    uses = {use.id: use for use in assignment.checks}
    stage = ""
    begin = time.monotonic()
    for check_id, check in CHECKS.items():
        if check_id not in uses:
            continue
        use = uses[check_id]
        now, title = STAGES[check_id.partition(".")[0]]
        if now != stage:
            if stage:
                listener(events.StageFinished(stage, time.monotonic() - begin))
            stage, begin = now, time.monotonic()
            listener(events.StageStarted(stage, title))
        listener(events.CheckStarted(check.id, check.title, use.visibility))
        result = _ask(check, use, evidence, uses)
        evidence.results[check_id] = result
        listener(events.CheckFinished(result))
    listener(events.StageFinished(stage, time.monotonic() - begin))
    return [evidence.results[use.id] for use in assignment.checks]


def _ask(
    check: Check, use: CheckUse, evidence: Evidence, uses: dict[str, CheckUse]
) -> model.CheckResult:
    """Ask one check; the build and the run happen in the first check that needs them."""
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
    except Failed as failed:
        found = {"status": "failed", "mistakes": failed.mistakes, "where": failed.where}
        for name in ("expected", "actual", "rationale", "fix", "advice"):
            found[name] = getattr(failed, name)
    except Blocked as blocked:
        return _skipped(common, blocked.by, evidence)
    except Inconclusive as unknown:
        found = {"status": "inconclusive", "actual": str(unknown)}
    except SurroundingsError:
        raise
    except Exception:  # a fault of ours in one check must not lose the verdict on the others
        found = {"status": "error", "actual": traceback.format_exc(limit=-4)}
    seconds = round(time.monotonic() - begin, 3)
    return model.CheckResult.model_validate({**common, **found, "seconds": seconds})


def _blocker(check: Check, evidence: Evidence) -> str:
    for dependency in check.depends:
        result = evidence.results.get(dependency)
        if result is not None and result.status != "passed":
            return result.blocked_by or dependency
    return ""


def _skipped(common: dict[str, object], by: str, evidence: Evidence) -> model.CheckResult:
    cause = evidence.results.get(by)
    root = (cause.blocked_by if cause is not None else "") or by
    title = CHECKS[root].title if root in CHECKS else root
    if evidence.is_hidden(root) and common["visibility"] == "visible":
        title = "a hidden check"
    found = {"status": "skipped", "blocked_by": root, "actual": f"not asked, because of: {title}"}
    return model.CheckResult.model_validate({**common, **found})


def _report(
    order: Order, evidence: Evidence, results: Sequence[model.CheckResult], ros: Ros
) -> model.Report:
    assignment, submission = order.assignment, evidence.submission
    build = evidence.build if evidence.was_built else None
    run = evidence.run if evidence.has_run else None
    unknown = sum(r.max_score for r in results if r.status in ("inconclusive", "error"))
    return model.Report(
        assignment=model.AssignmentInfo(
            id=assignment.id, title=assignment.title, sha256=assignment.sha256
        ),
        submission=model.SubmissionInfo(
            name=submission.name,
            student_id=order.student_id or None,
            path=_printable(submission.path),
            sha256=submission.sha256,
            package=_package_name(submission),
            origin=submission.origin,
            modes=submission.modes,
            notes=list(submission.notes),
        ),
        environment=model.Environment.model_validate(
            {
                "distro": order.distro.name,
                "ros": ros.kind,
                "sandbox": "none",
                "grader": grader.__version__,
                **ros.versions,
            }
        ),
        status="graded",
        message=f"{unknown:g} points could be neither given nor taken" if unknown else "",
        score=sum(r.score for r in results),
        max_score=assignment.max_score,
        checks=list(results),
        observed=_observed(run, assignment.output.period),
        evidence=model.Evidence(
            build_log=_cut(build.log) if build else "",
            transcript=_cut(run.transcript) if run else "",
        ),
        started="",
    )


def _printable(path: Path) -> str:
    """Return a path as text that JSON can hold; bytes that are no UTF-8 are spelled out."""
    return os.fsencode(path).decode("utf-8", "backslashreplace")


def _package_name(submission: Submission) -> str | None:
    for candidate in submission.candidates:
        if candidate.path == submission.root:
            return candidate.name
    return None


def _observed(run: Run | None, period: float) -> model.Observed:
    if run is None:
        return model.Observed()
    virtual = run.watch.clock == "virtual"
    ticks = [
        model.Tick(
            n=event.n,
            text=event.text[:500],
            virtual=round(event.virtual, 3) if virtual else None,
            wall=round(event.wall, 6),
        )
        for event in run.watch.counted[:200]
    ]
    return model.Observed(
        command=run.command,
        clock=run.watch.clock,
        ticks=ticks,
        period=period,
        due=[round(due, 3) for due in run.watch.dues[:200]],
        nodes=[node.name for node in run.nodes],
        exit=model.Exit(
            status=run.status,
            signal=run.signal,
            seconds=None if run.stop_seconds is None else round(run.stop_seconds, 3),
        ),
    )


def _cut(text: str) -> str:
    """Return a text cut in its middle: how it began and how it ended tell the most."""
    if len(text) <= MOST_EVIDENCE:
        return text
    half = MOST_EVIDENCE // 2
    return f"{text[:half]}\n… {len(text) - 2 * half} characters left out …\n{text[-half:]}"
