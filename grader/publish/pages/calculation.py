"""How a student's final points were calculated, in sentences."""

from __future__ import annotations

from grader.base.i18n.message import joined, say
from grader.base.plain_text import points
from grader.batch.model import GradebookEntry, Override
from grader.batch.points import in_points
from grader.batch.words import duration, instant, local_instant
from grader.report.blocks import UNSEEN
from grader.report.model import Report


def calculation(entry: GradebookEntry, visible: set[str]) -> list[str]:
    """Return how the final points were calculated, one step per line."""
    report = entry.report
    marked = report if entry.status != "ungradable" else None
    lines = _given(marked) if marked is not None else []
    lines += [_correction(override, entry, visible) for override in entry.overrides]
    if entry.overrides and entry.score is not None:
        lines.append(say("The score is then {score}.", score=points(entry.score)))
    lines += _granted(entry)
    if late := _lateness(entry):
        lines.append(late)
    if entry.attempts > 1:
        counts = say(
            "Attempt {number} of {count} is the one that counts.",
            number=entry.attempt,
            count=entry.attempts,
        )
        lines.append(counts)
    graded = report is not None and report.status == "graded"
    if len(lines) == 1 and graded and entry.final == entry.score:
        return [say("These are the points that the checks gave.")]
    if entry.final is None:
        return [*lines, say("Nothing goes into the gradebook yet.")]
    final, most = points(entry.final), points(entry.max_score)
    return [*lines, say("{points} of {most} go into the gradebook.", points=final, most=most)]


def _given(report: Report) -> list[str]:
    """Return the lines about the points that the checks gave."""
    if report.status == "error":
        ours = say("Not graded: the fault is in the grader or its machine, not in the submission.")
        return [ours]
    score, most = points(report.score), points(report.max_score)
    lines: list[str] = [say("The checks gave {score} of {most}.", score=score, most=most)]
    if report.inconclusive:
        open_ = in_points(report.inconclusive)
        lines.append(say("{points} could be neither given nor taken.", points=open_))
    return lines


def _granted(entry: GradebookEntry) -> list[str]:
    """Return the lines about the student's own due date and slip days."""
    lines: list[str] = []
    if entry.is_extended:
        lines.append(say("Your due date was extended until {time}.", time=local_instant(entry.due)))
    if entry.slip_days:
        used, most = entry.slip_days_used, entry.slip_days
        lines.append(say("Slip days used: {used} of {most}.", used=used, most=most))
    return lines


def _lateness(entry: GradebookEntry) -> str:
    """Return the line about the late penalty, "" if there is none."""
    taken = in_points(entry.penalty)
    if entry.late_seconds is None:
        unknown = say("The time of submission is unknown: no points taken for lateness.")
        return unknown if entry.is_lateness_open else ""
    if not entry.late_seconds:
        return say("Penalty: {points} taken.", points=taken) if entry.penalty else ""
    late = duration(entry.late_seconds)
    if not entry.penalty:
        return say("Late by {duration}: no points taken.", duration=late)
    return say("Late by {duration}: {points} taken.", duration=late, points=taken)


def _correction(override: Override, entry: GradebookEntry, visible: set[str]) -> str:
    known = {check.id: check for check in entry.report.checks} if entry.report else {}
    hidden = override.check in known and override.check not in visible
    check = known.get(override.check)
    what = UNSEEN if hidden else override.check or say("the total")
    given, why = points(override.points), override.because
    before = points(check.score) if check is not None else ""
    if hidden:
        text = say(
            "Corrected: {what} gives {points} instead of {before}.",
            what=what,
            points=given,
            before=before,
        )
    elif before:
        text = say(
            "Corrected: {what} gives {points} instead of {before}, because: {why}",
            what=what,
            points=given,
            before=before,
            why=why,
        )
    else:
        text = say(
            "Corrected: {what} gives {points}, because: {why}", what=what, points=given, why=why
        )
    signed = ", ".join(part for part in (override.by, instant(override.at)) if part)
    return joined(text, f"({signed})" if signed else "")
