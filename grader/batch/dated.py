"""Finds when the submissions of a class were handed in, in the lists that its system exported."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from datetime import timezone, tzinfo
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import say
from grader.base.shown import shown
from grader.batch.match import Match, is_participant, match_more, rules_for_people
from grader.batch.model import ClassFolder, HandedIn, Student
from grader.batch.roster import Roster, read_roster
from grader.batch.systems.system import System
from grader.batch.times import timed
from grader.course.policy import Policy

NO_ZONE = say(
    "the times in the files' names are not used: they are local times, and the policy has no time_zone"
)
MOST_LISTS = 50  # beside a download
MOST_BYTES = 5_000_000


def with_times(folder: ClassFolder, lists: Sequence[Roster], policy: Policy) -> ClassFolder:
    """Return the class with the times of submission that its lists tell.

    `lists` are those that the instructor gave. If none has times, one beside the download is used
    that names all its participants. A system's word that a submission is not late counts only if
    the system has a due date at all, or if there is none here.
    """
    notes: list[str] = []
    known = [one for one in lists if one.has_times]
    if not known and not any(one.has_times for one in folder.handed_in):
        beside = list(_beside(folder))
        if len(beside) == 1:
            known = [beside[0][1]]
            file = shown(str(beside[0][0]))
            notes.append(say("the times of submission are from {file}", file=file))
        elif beside:
            names = ", ".join(shown(path.name) for path, _ in beside)
            notes.append(
                say(
                    "times of submission: several lists fit, name one (--worksheet): {names}",
                    names=names,
                )
            )
    for one in known:
        folder = _with_times_of(folder, one, policy.zone)
    if known and policy.deadline is not None and not any(_shows_due_date(one) for one in known):
        folder = replace(
            folder,
            handed_in=tuple(replace(one, late_seconds=None) for one in folder.handed_in),
        )
    return replace(folder, notes=(*folder.notes, *notes))


def in_zone(folder: ClassFolder, policy: Policy) -> ClassFolder:
    """Return the class with all times in UTC: a system's local times are in the class' zone.

    Without a time zone they are not used, which a note says.
    """
    naive = [one for one in folder.handed_in if one.submitted and one.submitted.tzinfo is None]
    if not naive:
        return folder
    zone = policy.zone

    def zoned(one: HandedIn) -> HandedIn:
        if one.submitted is None or one.submitted.tzinfo is not None:
            return one
        at = one.submitted.replace(tzinfo=zone).astimezone(timezone.utc) if zone else None
        return replace(one, submitted=at)

    notes = folder.notes if zone else (*folder.notes, NO_ZONE)
    return replace(folder, handed_in=tuple(map(zoned, folder.handed_in)), notes=notes)


def _with_times_of(folder: ClassFolder, one: Roster, zone: tzinfo | None) -> ClassFolder:
    students = [*{given.student.key: given.student for given in folder.handed_in}.values()]
    lines = one.in_zone(zone).lines
    rows = _match(folder.system, [*students, *folder.missing], one).rows
    times = {key: lines[row].times for key, row in rows.items()}
    return replace(folder, handed_in=tuple(timed(folder.handed_in, times)))


def _match(system: System, students: Sequence[Student], one: Roster) -> Match:
    match = Match()
    match_more(match, rules_for_people(system, students, one), students, one)
    return match


def _shows_due_date(one: Roster) -> bool:
    return any(line.times.shows_due_date for line in one.lines)


def _beside(folder: ClassFolder) -> Iterator[tuple[Path, Roster]]:
    """Yield the lists beside a download that have each of its participants, by number."""
    if not folder.system.numbered:
        return
    students = {one.student.key: one.student for one in folder.handed_in}
    numbered = [one for key, one in students.items() if key.isdecimal()]
    if not numbered:
        return
    places = [folder.path.parent, folder.path] if folder.path.is_dir() else [folder.path.parent]
    for path in (path for place in places for path in _files(place)):
        try:
            one = read_roster(path)
        except UsageError:
            continue
        if one.system is folder.system and one.has_times:
            lines = {line.student.key: line.student for line in one.lines}
            if all(is_participant(student, lines.get(student.key)) for student in numbered):
                yield path, one


def _files(place: Path) -> list[Path]:
    try:
        found = sorted(path for path in place.iterdir() if path.suffix.lower() == ".csv")
        return [p for p in found[:MOST_LISTS] if p.is_file() and p.stat().st_size <= MOST_BYTES]
    except OSError:
        return []
