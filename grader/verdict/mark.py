"""Marks one submission: intake, build, run and checks.

It prints nothing: it emits events and returns the report.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import datetime, timezone
from typing import TYPE_CHECKING

import grader
from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator
from grader.base.unheard import unheard
from grader.course.assignment import Assignment
from grader.package.submission import Submission
from grader.report import events, model
from grader.ros.distro import distros
from grader.run.known_interfaces import require_interfaces
from grader.run.observer import Event
from grader.run.session import Session
from grader.run.unforeseen import drawn_for
from grader.sandbox.base import Sandbox
from grader.sandbox.choose import open_sandbox
from grader.verdict.compose import compose
from grader.verdict.evaluate import AssignedCheck, evaluate_checks
from grader.verdict.evidence import Evidence, Follow, Search, Seek, WithFix
from grader.verdict.follows import with_same_cause, without_repeated
from grader.verdict.order import Order
from grader.verdict.take_in import take_in_for

if TYPE_CHECKING:
    from grader.run.variants import Trace
    from grader.verdict.evidence_file import Judged
    from grader.verdict.found_change import FoundChange, Sought
    from grader.verdict.recording import Recording

ISOLATING = ("bubblewrap", "docker")
"""The sandboxes in which changed code of a student's may run: it may delete what the student's does not."""
Keep = Callable[["Judged"], None]


def grade(order: Order, listener: events.Listener, *, keep: Keep | None = None) -> model.Report:
    """Mark one submission on one distro; `keep` is called with its evidence.

    Raises UsageError if the path does not exist or cannot be read, SurroundingsError if the
    grader's own surroundings fail; everything else is in the report.
    """
    begin = time.monotonic()
    submission = take_in_for(
        order.assignment,
        order.path,
        name=order.name,
        modes_kept=order.modes_kept,
        at_work=order.own_code,
    )
    return mark(submission, order, listener, intake=time.monotonic() - begin, keep=keep)


def mark(
    submission: Submission,
    order: Order,
    listener: events.Listener,
    *,
    intake: float = 0,
    keep: Keep | None = None,
) -> model.Report:
    """Mark a submission whose intake took `intake` seconds; see `grade`."""
    started = datetime.now(timezone.utc)
    begin = time.monotonic() - intake
    assignment = _with_drawn(order, submission).on(order.distro)
    translate = Translator(order.lang)
    opening = say("opening the sandbox for ROS {distro}", distro=order.distro.name)
    listener(events.StageStarted("setup", translate(opening)))

    def note(text: str) -> None:
        listener(events.Note(text))

    sandbox = _open(order, assignment, note)
    setup = time.monotonic() - begin - intake
    listener(events.StageFinished("setup", setup))
    with Session(sandbox, assignment, note=note, is_kept=order.tries_fixes) as session:
        require_interfaces(sandbox, assignment)
        evidence = _evidence(session, submission, listener)
        evidence.distro = order.distro
        if order.tries_fixes:
            evidence.with_fix = _with_fix(order, session, listener, translate)
            if sandbox.name in ISOLATING:
                evidence.search = _search(session, listener, translate)
                evidence.follow = _follow(session)
                evidence.seek = _seek(session, listener, translate) if assignment.runs else None
        results = _decide(evidence, listener, translate)
        environment = _environment(sandbox)
    if keep is not None:
        from grader.verdict.evidence_file import Judged  # noqa: PLC0415 - not before the build
        from grader.verdict.recording import record  # noqa: PLC0415

        keep(Judged(submission, record(evidence, environment)))
    timing = model.Timing(
        setup=round(setup, 3),
        intake=round(intake, 3),
        build=round(session.timing["build"], 3),
        run=round(session.timing["run"], 3),
        total=round(time.monotonic() - begin, 3),
    )
    return compose(
        evidence,
        results,
        student_id=order.student_id,
        environment=environment,
        timing=timing,
        started=started,
        translate=translate,
    )


def _with_drawn(order: Order, submission: Submission) -> Assignment:
    """Return the assignment with the values that are drawn for a submission."""
    assignment = order.assignment
    if not assignment.draw:
        return assignment
    return assignment.with_drawn({**drawn_for(submission.sha256, assignment.draw), **order.drawn})


def replay(
    recording: Recording,
    submission: Submission,
    assignment: Assignment,
    listener: events.Listener = unheard,
    *,
    lang: str = "en",
    student_id: str = "",
) -> model.Report:
    """Judge recorded evidence again and return the report; its times are 0.

    Raises RecordingError if the recording is not of this submission and assignment.
    """
    from grader.verdict.recording import as_drawn, evidence_of  # noqa: PLC0415 - slow

    translate = Translator(lang)
    assignment = as_drawn(recording, assignment)
    known = distros().get(recording.environment.distro)
    if known is not None:
        assignment = assignment.on(known)
    evidence = evidence_of(recording, submission, assignment)
    evidence.distro = known
    return compose(
        evidence,
        _decide(evidence, listener, translate),
        student_id=student_id,
        environment=recording.environment,
        timing=model.Timing(),
        started=datetime.now(timezone.utc),
        translate=translate,
    )


def _environment(sandbox: Sandbox) -> model.Environment:
    ros = sandbox.ros
    return model.Environment.model_validate(
        {
            "distro": ros.distro.name,
            "ros": ros.kind,
            "sandbox": sandbox.name,
            "limits": sandbox.limit_report(),
            "grader": grader.__version__,
            **ros.versions,
        }
    )


def _evidence(session: Session, submission: Submission, listener: events.Listener) -> Evidence:
    def tick(event: Event) -> None:
        listener(events.TickSeen(event.n, event.text, event.virtual))

    evidence = Evidence(
        session.assignment,
        submission,
        build=lambda: session.build(submission),
        run=lambda: session.run(tick, named=evidence.named),
        run_of=lambda plan: session.run_plan(plan, tick, named=evidence.named),
    )
    return evidence


def _open(order: Order, assignment: Assignment, notify: Callable[[str], None]) -> Sandbox:
    return open_sandbox(
        order.sandbox,
        order.distro,
        order.limits,
        interfaces=assignment.interfaces,
        own_code=order.own_code,
        notify=notify,
    )


def _with_fix(
    order: Order, session: Session, listener: events.Listener, translate: Translator
) -> WithFix:
    """Return what builds and runs the package with a fix, in a sandbox of its own."""

    @contextmanager
    def opened(_digest: str, fixed: Submission) -> Iterator[Evidence | None]:
        listener(events.StageStarted("fix", translate(say("Trying a fix of this package"))))
        sandbox = _open(order, session.assignment, unheard)
        left = session.deadline - session.run_clock.now()
        until = sandbox.run_clock.now() + left
        with Session(sandbox, session.assignment, deadline=until, like=session.built) as again:
            evidence = _evidence(again, fixed, unheard)
            evidence.distro = order.distro
            if sandbox.name in ISOLATING:
                evidence.search = _search(again, unheard, translate)
            yield evidence

    return opened


def _search(session: Session, listener: events.Listener, translate: Translator) -> Search:
    """Return what looks for small changes after which the node counts, in the session's sandbox."""

    def search(evidence: Evidence) -> list[FoundChange]:
        from grader.verdict.search import search_in  # noqa: PLC0415 - only a failed check needs it

        listener(events.StageStarted("search", translate(say("Trying small changes of the node"))))
        return search_in(session.sandbox, session.deadline)(evidence)

    return search


def _seek(session: Session, listener: events.Listener, translate: Translator) -> Seek:
    """Return what looks for facts and changes that explain a failed check of a scenario's run."""
    from grader.verdict.goal import Seeker  # noqa: PLC0415 - only an assignment with runs needs it

    seeker = Seeker(session.sandbox, session.deadline)

    def seek(evidence: Evidence, result: model.CheckResult) -> Sought:
        listener(events.StageStarted("search", translate(say("Trying small changes of the node"))))
        return seeker(evidence, result)

    return seek


def _follow(session: Session) -> Follow:
    """Return what follows a short run of the node, in the session's sandbox."""

    def follow(evidence: Evidence) -> Trace | None:
        from grader.verdict.follow import trace_in  # noqa: PLC0415 - only a failed check needs it

        return trace_in(session.sandbox, session.deadline, evidence)

    return follow


def _decide(
    evidence: Evidence, listener: events.Listener, translate: Translator
) -> list[model.CheckResult]:
    stages = _Stages(listener, translate)
    for result in evaluate_checks(evidence, translate, announce=stages.announce):
        if result.status == "failed":
            evidence.results[result.id] = _with_patch(result, evidence, listener, translate)
        listener(events.CheckFinished(evidence.results[result.id]))
    stages.finish()
    results = [evidence.results[use.id] for use in evidence.assignment.checks]
    return without_repeated(with_same_cause(results, evidence, translate), evidence)


class _Stages:
    """Emits the events for each check and for the stage that it belongs to."""

    def __init__(self, listener: events.Listener, translate: Translator) -> None:
        self._listener = listener
        self._translate = translate
        self._stage = ""
        self._begin = 0.0

    def announce(self, assigned: AssignedCheck) -> None:
        stage = assigned.check.stage
        if stage.name != self._stage:
            self.finish()
            self._stage, self._begin = stage.name, time.monotonic()
            self._listener(events.StageStarted(stage.name, self._translate(stage.title)))
        self._listener(
            events.CheckStarted(
                assigned.use.id, self._translate(assigned.title), assigned.visibility
            )
        )

    def finish(self) -> None:
        if self._stage:
            seconds = time.monotonic() - self._begin
            self._listener(events.StageFinished(self._stage, seconds))


def _with_patch(
    result: model.CheckResult,
    evidence: Evidence,
    listener: events.Listener,
    translate: Translator,
) -> model.CheckResult:
    from grader.verdict.try_fixes import with_tried_fix  # noqa: PLC0415 - it imports all mistakes

    try:
        return with_tried_fix(result, evidence, translate)
    except Exception as fault:  # a bug of ours must not lose the verdict, which has no fix then
        listener(events.Note(f"{result.id}: no fix was made because of a fault of ours: {fault!r}"))
        return result
