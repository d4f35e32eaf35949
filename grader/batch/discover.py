"""Finds the submissions of a class in what the instructor downloaded."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from datetime import tzinfo
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import say
from grader.base.shown import shown
from grader.batch.join import Pinned, join, with_lists, with_own_keys
from grader.batch.join_file import LEFT_OUT, GivenJoin
from grader.batch.loose_files import loose_file, with_loose_files
from grader.batch.model import ClassFolder, HandedIn
from grader.batch.roster import Roster, read_roster
from grader.batch.systems import plain
from grader.batch.systems.exec_bits import no_exec_bits
from grader.batch.systems.gather import Gatherer
from grader.batch.systems.known import (
    NAMED_BY_HAND,
    check_system,
    is_named_as_in,
    layouts,
    recognised,
)
from grader.batch.systems.layout import NO_SUBMISSION, FolderItem, Layout, Reading, look_at, seen
from grader.batch.systems.notes import Notes, printable
from grader.batch.systems.single_package import is_class, one_package
from grader.batch.systems.system import System
from grader.batch.unpack import Unpacked, unpack_class
from grader.batch.unpack_members import NOT_UNPACKED
from grader.package.intake.given import resolved

DEEPEST = 2  # nested folders around the class folder that contain nothing else
NO_BITS = say(
    "no submission has an executable node: the exec bits count as unknown (they were lost on the "
    "way here)"
)


@dataclass(frozen=True)
class Request:
    """What to discover: the resolved `path`; a system's name or "auto"."""

    path: Path
    system: str
    unpack: Path


def discover(
    path: Path,
    *,
    system: str = "auto",
    roster: Path | Roster | None = None,
    unpack: Path,
    zone: tzinfo | None = None,
    given: GivenJoin | None = None,
    lists: Sequence[Roster] = (),
) -> ClassFolder:
    """Return all submissions of a class; `path` is a folder, or an archive of one.

    `unpack` is the grader's folder for unpacked and gathered files, `zone` that of the times in the
    roster that have none. `given` names the students of some files, `lists` are the system's own, which
    lead from its numbers to the addresses of a roster. Raises UsageError if the path
    is not a class, the system is unknown, or the roster or `given` cannot be used.
    """
    check_system(system)
    request = Request(resolved(path), system, unpack.resolve())
    students = read_roster(roster) if isinstance(roster, Path) else roster
    if students is not None:
        students = students.in_zone(zone)
    notes = Notes()
    unpacked = Unpacked(request.path)
    if not request.path.is_dir():
        unpacked = unpack_class(request.path, request.unpack)
    layout, system_found, handed_in, files = _read(request, unpacked, notes)
    handed_in = _with_remarks(handed_in, unpacked, notes)
    handed_in = _with_modes(system_found, handed_in, unpacked, notes)
    handed_in = with_lists(system_found, handed_in, lists)
    pinned: list[Pinned] = []
    left_out: list[str] = []
    if given is not None and not (students is None and given.is_remembered):
        handed_in, pinned, files, left_out = _pinned(given, students, handed_in, layout.path, files)
        if left_out:
            notes.add_names(LEFT_OUT, left_out)
    joined = join(system_found, _numbered(handed_in), students, pinned)
    if students is not None:
        joined = with_loose_files(system_found, joined, layout.path, files, students)
    used = {one.path.name for one in joined.handed_in}
    left = [item.name for item in files if item.name not in used]
    if left:
        notes.add_names(NO_SUBMISSION, left)
    for reason, names in layout.left_out.items():
        notes.add_names(reason, names)
    return ClassFolder(
        system=system_found,
        path=request.path,
        # numbered again: a member of a group may also have handed in alone
        handed_in=tuple(_numbered(joined.handed_in)),
        missing=joined.missing,
        elsewhere=joined.elsewhere,
        on_roster=joined.on_roster,
        notes=(*notes.lines(), *joined.notes),
        unclear=joined.unclear,
        on_list=joined.on_list,
        left_out=tuple(left_out),
    )


def _pinned(
    given: GivenJoin,
    roster: Roster | None,
    handed_in: Sequence[HandedIn],
    path: Path,
    files: Sequence[FolderItem],
) -> tuple[list[HandedIn], list[Pinned], list[FolderItem], list[str]]:
    """Return the submissions to be matched, those with given students, other files, and left out."""
    if roster is None:
        raise UsageError(
            f"{given.name} names students, but there is no list of the class",
            remedy="Give it with --roster FILE (make: ROSTER=FILE).",
        )
    loose = {path / item.name: loose_file(path, item) for item in files}
    rest, pinned, out = given.pinned([*handed_in, *loose.values()], with_own_keys(roster))
    left = {one.path for one in rest}
    return (
        [one for one in rest if one.path not in loose],
        pinned,
        [item for item in files if path / item.name in left],
        out,
    )


def _look(path: Path, request: Request, unpacked: Unpacked) -> Layout:
    """List a folder of the class, without the grader's own folder and those around it."""
    below = path.relative_to(unpacked.folder).as_posix()
    own = [request.unpack, *request.unpack.parents]
    return look_at(path, lost=_lost(unpacked, below), without=own)


def _read(
    request: Request, unpacked: Unpacked, notes: Notes
) -> tuple[Layout, System, list[HandedIn], list[FolderItem]]:
    """Return the layout, its system, the submissions, and the files that are none."""
    layout = _look(unpacked.folder, request, unpacked)
    single = one_package(layout)
    if single:
        raise UsageError(
            f"{shown(str(request.path))} is {single}, not a class",
            remedy="To mark one submission: grader grade PATH.",
        )
    layout = _class_layout(layout, request, unpacked, notes)
    found = recognised(request.system, layout)
    if found is None:
        raise UsageError(
            f"{shown(str(request.path))} has no submissions of a class: {seen(layout)}",
            remedy=layouts(),
        )
    system, download = found
    reading = Reading(notes, Gatherer(request.unpack))
    read = download.reader.read(layout, reading)
    handed_in = [*read.handed_in]
    if not handed_in:
        raise UsageError(
            f"{shown(str(request.path))} is not {download.title}: {seen(layout)}", remedy=layouts()
        )
    taken = {one.student.key for one in handed_in}
    files = [item for item in read.rest if not item.may_be_submission]
    for one in plain.read_items(layout.path, read.rest):
        handed_in.append(_beside(one, taken, download.title))
    note = say("read as {title} ({name}), as requested", title=download.title, name=system.name)
    if request.system == "auto":
        note = say("read as {title} ({name}), by its names", title=download.title, name=system.name)
    notes.add(note)
    return layout, system, handed_in, files


def _beside(one: HandedIn, taken: set[str], words: str) -> HandedIn:
    """Return a submission that was added to a system's own files, under a key of its own."""
    note = say("not named as in {download}: its own name was used", download=words)
    key = one.student.key
    while key in taken:
        key = f"{key} (by hand)"
    return replace(one, student=replace(one.student, key=key), notes=(*one.notes, note))


def _lost(unpacked: Unpacked, below: str) -> dict[str, str]:
    """Return the names that are missing in a folder because they were not unpacked, and why."""
    start = "" if below == "." else f"{below}/"
    beside = (
        (where[len(start) :], what) for where, what in unpacked.remarks if where.startswith(start)
    )
    return {
        name: what
        for name, what in beside
        if name
        and "/" not in name
        and what.startswith(NOT_UNPACKED)
        and not os.path.lexists(unpacked.folder / start / name)
    }


def _class_layout(layout: Layout, request: Request, unpacked: Unpacked, notes: Notes) -> Layout:
    """Return the class in a folder that contains nothing else, or the layout itself."""
    if request.system in NAMED_BY_HAND or is_named_as_in(request.system, layout):
        return layout
    deeper, left_out = layout, dict(layout.left_out)
    for _ in range(DEEPEST):
        inner = deeper.submissions()
        if len(inner) != 1 or inner[0].kind != "folder" or inner[0].problem:
            break
        try:
            deeper = _look(deeper.path / inner[0].name, request, unpacked)
        except UsageError:
            break
        left_out.update(deeper.left_out)
        by_hand = request.system == "auto" and is_class(deeper)
        if by_hand or is_named_as_in(request.system, deeper):
            place = os.path.relpath(deeper.path, layout.path)
            notes.add(say("the class is in the folder {folder}", folder=shown(printable(place))))
            return replace(deeper, left_out=left_out)
    return layout


def _with_remarks(handed_in: list[HandedIn], unpacked: Unpacked, notes: Notes) -> list[HandedIn]:
    """Return the submissions with notes on what was not unpacked; other remarks go to `notes`."""
    if not unpacked.remarks:
        return handed_in
    places = {os.fsencode(one.path): n for n, one in enumerate(handed_in)}
    found: dict[int, list[str]] = {}
    for where, what in unpacked.remarks:
        path = unpacked.folder / where
        owners = [places.get(os.fsencode(place)) for place in (path, *path.parents)]
        owner = next((n for n in owners if n is not None), None)
        if owner is None:
            notes.add_names(what, [where])
        elif handed_in[owner].problem != what:
            found.setdefault(owner, []).append(f"{what}: {shown(printable(where))}")
    return [
        replace(one, notes=(*one.notes, *_few(found.get(n, [])))) for n, one in enumerate(handed_in)
    ]


def _few(lines: Sequence[str]) -> tuple[str, ...]:
    return tuple(lines[:5]) + ((f"and {len(lines) - 5} more like these",) if lines[5:] else ())


def _with_modes(
    system: System, handed_in: list[HandedIn], unpacked: Unpacked, notes: Notes
) -> list[HandedIn]:
    """Return the submissions with `modes_kept` False if the class lost its exec bits."""
    kept = unpacked.modes_recorded
    folders = [one.path for one in handed_in if one.modes_kept and not one.problem]
    if kept and not system.keeps_modes and no_exec_bits(folders):
        kept = False
        notes.add(NO_BITS)
    return handed_in if kept else [replace(one, modes_kept=False) for one in handed_in]


def _numbered(handed_in: Iterable[HandedIn]) -> list[HandedIn]:
    """Number each student's attempts, by time if all of them have one."""
    by_key: dict[str, list[HandedIn]] = {}
    for one in handed_in:
        by_key.setdefault(one.student.key, []).append(one)
    found = []
    for group in by_key.values():
        stamps = [one.submitted for one in group if one.submitted is not None]
        if len(stamps) == len(group):
            order = sorted(range(len(group)), key=stamps.__getitem__)
            found += [replace(group[n], attempt=a) for a, n in enumerate(order, start=1)]
        else:
            found += [replace(one, attempt=n) for n, one in enumerate(group, start=1)]
    return found
