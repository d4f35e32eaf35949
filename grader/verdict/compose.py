"""Composes the report."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from datetime import datetime
from pathlib import Path, PurePath

from grader.base.i18n.message import Message, msg, say
from grader.base.i18n.translator import Translator
from grader.base.shown import shown
from grader.course.assignment import Assignment
from grader.package.intake.model import SourceFile
from grader.package.source.remarks import remarks_on
from grader.package.source.telling import telling
from grader.package.submission import Submission
from grader.report import model
from grader.run.run import Program, Run
from grader.verdict import causes
from grader.verdict.checks.world import Path as WantedPath
from grader.verdict.checks.world import circle_from
from grader.verdict.evidence import Evidence
from grader.verdict.plots import topic_plots

REMARKS = {
    "asks": msg(
        "To look at: {place} has {what}. A program can learn from it that it is being marked, and no "
        "run without our arguments showed that it works."
    ),
    "hides": msg("To look at: {place} has {what}: the source does not show what it does."),
    "rosout": msg("To look at: {place} has {what}: the node may publish log records by hand."),
}
MOST_POINTS = 400  # of a turtle's path
MOST_EVIDENCE = 40_000  # characters, of the build log and of the transcript each


def compose(
    evidence: Evidence,
    results: Sequence[model.CheckResult],
    *,
    student_id: str,
    environment: model.Environment,
    timing: model.Timing,
    started: datetime,
    translate: Translator,
) -> model.Report:
    """Return the report of one submission; its texts are in the language of `translate`.

    No point is lost in it without a check that failed.
    """
    results = causes.with_causes(results, translate)
    assignment, submission = evidence.assignment, evidence.submission
    build = evidence.build if evidence.was_built else None
    run = evidence.run if evidence.has_run else None
    programs = [
        program for made in evidence.runs or ([run] if run else ()) for program in _programs(made)
    ]
    transcripts = [program.transcript for program in programs]
    parts = [
        model.Transcript(
            run=made.name, node=_node(program, made, assignment), text=program.transcript
        )
        for made in evidence.runs
        for program in _programs(made)
    ]
    open_ = sum(r.max_score for r in results if r.status in ("inconclusive", "error"))
    unknown = say("{points} points could be neither given nor taken", points=f"{open_:g}")
    return model.Report(
        assignment=model.AssignmentInfo(
            id=assignment.id,
            title=assignment.title,
            sha256=assignment.sha256,
            due=assignment.policy.deadline,
            feedback=assignment.feedback,
        ),
        submission=model.SubmissionInfo(
            name=submission.name,
            student_id=student_id or None,
            path=_printable(submission.path),
            sha256=submission.sha256,
            package=_package_name(submission),
            origin=submission.origin,
            modes=submission.modes,
            notes=[translate(note) for note in (*submission.notes, *_to_look_at(evidence))],
        ),
        environment=environment,
        status="graded",
        message=translate(unknown) if open_ else "",
        lang=translate.lang,
        score=sum(r.score for r in results),
        max_score=assignment.max_score,
        checks=list(results),
        observed=_observed(run, assignment.output.period),
        runs=[_run_info(made, assignment) for made in evidence.runs],
        evidence=model.Evidence(
            build_log=_cut(build.log, translate) if build else "",
            transcript=_cut("\n".join(transcripts), translate),
            programs=[_cut_part(part, translate, len(parts)) for part in parts if len(parts) > 1],
        ),
        timing=timing,
        started=started.isoformat(),
    )


def _to_look_at(evidence: Evidence) -> Iterator[str]:
    """Yield what the grader cannot judge for certain, for a person to look at."""
    submission, run = evidence.submission, evidence.run if evidence.has_run else None
    remarks = remarks_on(submission.files)
    if run is not None and not _is_told_plainly(evidence, run):
        hidden = {(one.path, one.line) for one in remarks if one.kind == "hides"}
        files = [*submission.files, *(file for one in submission.packages for file in one.files)]
        files = list(_named(evidence, files))
        remarks += [one for one in telling(files) if (one.path, one.line) not in hidden]
    for remark in remarks:
        if remark.kind == "ends" or (remark.kind == "rosout" and run is None):
            continue
        place = remark.path
        if remark.line is not None:
            place = say("{file}, line {line}", file=remark.path, line=remark.line)
        yield Message(REMARKS[remark.kind], {"place": place, "what": remark.what})
    for program in _programs(run) if run is not None else ():
        for command in program.beside:
            yield say(
                "To look at: the node started another program: {command}", command=shown(command)
            )


def _named(evidence: Evidence, files: Sequence[SourceFile]) -> Iterator[SourceFile]:
    """Yield the files but modules that only entry points of other lessons name: they do not run."""
    asked = evidence.assignment
    own = {asked.executable, *(node.executable for node in asked.nodes.values())}
    paths = {asked.node_file, *(node.file for node in asked.nodes.values())}
    known = {PurePath(path).name for path in paths}
    python = [one for one in files if one.path.endswith(".py")]
    for file in files:
        is_other = file in python and PurePath(file.path).name not in known
        if not is_other or not _is_of_entries(file, python, own):
            yield file


def _is_of_entries(file: SourceFile, python: Sequence[SourceFile], own: set[str]) -> bool:
    """Whether a module is named only in entry points of setup.py, and in none of the executables `own`."""
    stem = PurePath(file.path).stem.encode()
    entry = re.compile(rb"(\w+)\s*=\s*[\w.]*\b" + re.escape(stem) + rb":\w+")
    setups = [one.data for one in python if PurePath(one.path).name == "setup.py"]
    entries = [found[1].decode() for data in setups for found in entry.finditer(data)]
    if not entries or not own.isdisjoint(entries):
        return False
    return sum(one.data.count(stem) for one in python if one is not file) == len(entries)


def _is_told_plainly(evidence: Evidence, run: Run) -> bool:
    """Whether plain runs told of each node whether it works without our arguments.

    They tell nothing if the machine was too busy, or if nothing happens that could be waited for.
    """
    if not evidence.assignment.runs:
        return run.confirmed is not None or run.plain
    plans = evidence.assignment.runs
    told = {one.name for one in evidence.runs if one.confirmed is not None}
    known = {begin.node for plan in plans if plan.name in told for begin in plan.start}
    return {begin.node for plan in plans for begin in plan.start} <= known


def _printable(path: Path) -> str:
    """Return a path as text for JSON; bytes that are not UTF-8 are escaped."""
    return os.fsencode(path).decode("utf-8", "backslashreplace")


def _package_name(submission: Submission) -> str | None:
    for candidate in submission.candidates:
        if candidate.path == submission.root:
            return candidate.name
    return None


def _programs(run: Run) -> list[Run | Program]:
    """Return the programs of a run, those first that ended by themselves: what they say matters."""
    return sorted((run, *run.others), key=lambda program: not _ended_by_itself(program))


def _node(program: Run | Program, run: Run, assignment: Assignment) -> str:
    """Return the assignment's node that a program of a run is."""
    return program.node if isinstance(program, Program) else assignment.plan(run.name).start[0].node


def _ended_by_itself(program: Run | Program) -> bool:
    return program.ended_by_itself if isinstance(program, Run) else program.by_itself


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
        exit=_exit(run),
    )


def _exit(program: Run | Program) -> model.Exit:
    seconds = program.stop_seconds
    return model.Exit(
        status=program.status,
        signal=program.signal,
        seconds=None if seconds is None else round(seconds, 3),
    )


def _run_info(run: Run, assignment: Assignment) -> model.RunInfo:
    plan, seen = assignment.plan(run.name), run.seen
    observed = _observed(run, plan.clock.period)
    drawn = {name: assignment.drawn[name] for name in plan.drawn if name in assignment.drawn}
    if seen is None:
        return model.RunInfo(name=run.name, drawn=drawn, world=plan.world, observed=observed)
    topics = [
        model.TopicInfo(name=topic, type=kind, count=seen.counts.get(topic, 0))
        for topic, kind in plan.topics.items()
    ]
    turtles = dict.fromkeys(pose.turtle for pose in seen.path)
    return model.RunInfo(
        name=run.name,
        drawn=drawn,
        node=plan.start[0].node,
        world=plan.world,
        observed=observed.model_copy(update={"ticks": [], "due": []}),
        others=[
            model.OtherProgram(
                node=other.node,
                command=other.command,
                ended_by_itself=other.by_itself,
                exit=_exit(other),
            )
            for other in run.others
        ],
        instants=len(seen.instants),
        topics=topics,
        path={
            turtle: _thinned([(p.x, p.y) for p in seen.path if p.turtle == turtle])
            for turtle in turtles
        },
        wanted=_wanted(run, assignment),
        plots=topic_plots(run, assignment),
    )


def _wanted(run: Run, assignment: Assignment) -> dict[str, list[tuple[float, float]]]:
    """Return the path that the checks of a run want of a turtle, from where it begins to move."""
    found = {}
    for use in assignment.checks:
        here = assignment.plan(use.run).name == run.name and use.visibility == "visible"
        if use.kind == "world.path" and here and run.seen is not None:
            given = WantedPath.model_validate(use.with_)
            own = [pose for pose in run.seen.path if pose.turtle == given.turtle]
            if own:
                found[given.turtle] = _thinned(circle_from(own, given.circle.radius))
    return found


def _thinned(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return at most MOST_POINTS of the points, the last one included."""
    step = max(1, -(-len(points) // MOST_POINTS))
    kept = points[::step]
    return [(round(x, 3), round(y, 3)) for x, y in kept]


def _cut_part(part: model.Transcript, translate: Translator, count: int) -> model.Transcript:
    """Return what one of `count` programs printed, cut to its share."""
    text = _cut(part.text, translate, MOST_EVIDENCE // count)
    return part.model_copy(update={"text": text})


def _cut(text: str, translate: Translator, most: int = MOST_EVIDENCE) -> str:
    """Return a text without its middle if it is too long: start and end say the most."""
    if len(text) <= most:
        return text
    half = most // 2
    left_out = say("… {count} characters left out …", count=len(text) - 2 * half)
    return f"{text[:half]}\n{translate(left_out)}\n{text[-half:]}"
