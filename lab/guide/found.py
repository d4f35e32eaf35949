"""What is there but wrong, misspelt or elsewhere: recognised by the same records as the marking."""

from __future__ import annotations

import os
from collections.abc import Iterator
from difflib import unified_diff
from pathlib import Path

from grader.base.i18n.message import joined, say
from grader.base.nearest import nearest
from grader.base.shown import shown
from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.slips import description
from grader.package.source.broken_python import Slip
from grader.package.source.manifest import name_in
from grader.package.source.python import PythonFault, can_parse, parse_python
from grader.package.source.slips import slip_of
from grader.report.model import CheckResult, Where
from grader.verdict.checks.build import unreadable_setup as unreadable_setup_py
from grader.verdict.checks.not_python import without_guess
from lab.guide.action import Action
from lab.guide.changes import changes_in
from lab.guide.state import StudentState

NOT_STARTED = {
    *("package.empty", "package.no_manifest", "package.only_build", "source.no_node_file"),
    *("source.empty_node_file", "setup.missing", "setup.no_entry", "interface.missing"),
}
"""The mistakes that only say that a step is still to do."""
COMMANDS = {"package.found", "source.node_file"}
"""The kinds of check whose fix is said at once, not as a hint: a command, or one character."""
MOST_ENTRIES = 500  # of the home folder, that are looked at
UNREADABLE = "build.colcon"  # the kind of check that fails if Python cannot read setup.py


def mistake(state: StudentState, *kinds: str) -> Action | None:
    """Return the action for the first mistake that these kinds of check find in the files."""
    for kind in kinds:
        result = state.results.get(kind)
        found = None if result is None else _mistake_in(result, kind, state)
        if found is not None:
            return found
    return None


def first_mistake(state: StudentState) -> tuple[str, str, Action] | None:
    """Return the first mistake that the files show: its kind of check, its file, what to do."""
    if not state.workspace.is_dir():
        return None
    for kind, result in state.each_result:
        if (found := _mistake_in(result, kind, state)) is not None:
            return kind, result.where.file if result.where is not None else "", found
    broken = unreadable_setup(state)
    return (UNREADABLE, "setup.py", broken) if broken is not None else None


def unreadable_setup(state: StudentState) -> Action | None:
    """Return the action for a setup.py that Python cannot read, in the words of the build's check."""
    text = state.read(state.package / "setup.py")
    try:
        parse_python(text)
    except PythonFault as fault:
        error, stops = f"{fault.text}", fault.line
    else:
        return None
    failed = unreadable_setup_py(text, error, Where(file="setup.py", line=stops))
    kind, values = CATALOGUE[failed.mistake.id], {**failed.mistake.params, **failed.words}
    line = failed.where.line if failed.where is not None else None
    place: str = "setup.py"
    if line:
        place = say("{file}, line {line}", file=place, line=line)
    slip = slip_of(text)
    reason: str = error
    if slip is not None:
        reason = joined(without_guess(error), description(slip), by=", ")
    found: str = say("{file} cannot be read: {reason}", file="setup.py", reason=reason)
    if stops and stops != line:
        found = joined(found, say("(Python stops at line {line}.)", line=stops))
    return Action(
        say("Correct {place}.", place=place),
        failed.mistake.id,
        found,
        _texts(
            kind.rationale(values, failed.variant),
            kind.fix_text(values, failed.variant),
            _corrected(text, slip),
        ),
        place=f"setup.py:{line}" if line else "setup.py",
    )


def _corrected(text: bytes, slip: Slip | None) -> str:
    """Return the change that corrects a file which Python cannot read; "" if none is certain."""
    if slip is None or not slip.fixed or not can_parse(slip.fixed):
        return ""
    old, new = (t.decode("utf-8", "replace").splitlines(keepends=True) for t in (text, slip.fixed))
    return changes_in("".join(unified_diff(old, new, "a/setup.py", "b/setup.py", n=0)))


def _mistake_in(result: CheckResult, kind: str, state: StudentState) -> Action | None:
    if result.status != "failed" or not result.actual or result.consequence_of:
        return None
    if any(each.id in NOT_STARTED for each in result.mistakes):
        return None
    return _action(result, kind, state)


def _action(result: CheckResult, kind: str, state: StudentState) -> Action:
    file = result.where.file if result.where is not None else ""
    line = result.where.line if result.where is not None else None
    place = say("{file}, line {line}", file=file, line=line) if line else file
    spot = f"{file}:{line}" if line else file
    found = result.actual.partition("\n")[0]
    name = result.mistakes[0].id if result.mistakes else result.id
    if kind in COMMANDS or not (file and (state.package / file).exists()):
        found = joined(found, " (", place, ")", by="") if line else found
        return Action(result.fix, name, found, _texts(result.rationale), difference(result), spot)
    correct = say("Correct {place}.", place=place)
    return Action(correct, name, found, hints_in(result), difference(result), spot)


def hints_in(result: CheckResult) -> tuple[str, ...]:
    """Return what a failed check tells, hint by hint: why, what kind of change, the change."""
    return _texts(result.rationale, result.fix, changes_in(result.patch))


def difference(result: CheckResult) -> str:
    """Return what a failed check found, and what it expected."""
    wanted = say("expected: {text}", text=result.expected) if result.expected else ""
    return joined(result.actual, wanted, by="\n")


def _texts(*texts: str) -> tuple[str, ...]:
    return tuple(text for text in texts if text)


def package_elsewhere(state: StudentState) -> Action | None:
    """Return the action for a package that is outside of src, nested or misspelt."""
    name = state.assignment.package
    root = state.submission.root if state.workspace.is_dir() else None
    if root is not None:
        own = _own_name(state.workspace / root)
        place = f"~/ros2_ws/{root}"
        if own == name or not own:
            return _move(place, state)
        if nearest(own, [name]):
            return _misspelt(own, place, state)
    for folder in _in_home(state):
        if name in (folder.name, _own_name(folder)):
            return _move(f"~/{folder.name}", state)
    return None


def nested_package(state: StudentState) -> Action | None:
    """Return the action for a package that lies in a folder of its own name."""
    root = state.submission.root if state.workspace.is_dir() else None
    name = state.assignment.package
    inner = None if root is None else state.workspace / root
    if inner is None or inner.parent != state.package or _own_name(inner) != name:
        return None
    wanted, outer = f"~/ros2_ws/src/{name}", f"{name}_outer"
    place = f"{wanted}/{inner.name}"
    command = (
        f"cd ~/ros2_ws/src && mv {name} {outer} && mv {outer}/{shown(inner.name)} {name} "
        f"&& rmdir {outer}"
    )
    found = say("the package is in {place}; it belongs in {wanted}", place=place, wanted=wanted)
    why = say(
        "ros2 pkg create makes the package's folder itself, in the folder in which it is called."
    )
    return Action(command, "package.nested", found, (why,))


def other_package(state: StudentState) -> Action | None:
    """Return the action for a copy of the package that colcon would find too."""
    for path in state.submission.copies:
        place = f"~/ros2_ws/{path}"
        found = say("{place} has the same package name", place=shown(place))
        why = say("colcon stops if two packages have one name. It skips a folder with this file.")
        return Action(f"touch {shown(place)}/COLCON_IGNORE", "package.copy", found, (why,))
    return None


def _misspelt(own: str, place: str, state: StudentState) -> Action:
    name = state.assignment.package
    return Action(
        say(
            "Change the name in package.xml, setup.py, setup.cfg, resource/ and both folders. If "
            "{place} has no code of yours yet, delete it and create it again.",
            place=shown(place),
        ),
        "package.name_mismatch",
        found=say("the package is called {own}; it must be {name}", own=shown(own), name=name),
        hints=(say("The lesson, ros2 run and the checks ask for the package by its name."),),
        where=say("In {place}, and in its own folder {own}.", place=shown(place), own=shown(own)),
    )


def _move(place: str, state: StudentState) -> Action:
    wanted = f"~/ros2_ws/src/{state.assignment.package}"
    return Action(
        f"mv {shown(place)} {wanted}",
        "package.elsewhere",
        found=say("the package is in {place}; it belongs in {wanted}", place=place, wanted=wanted),
        hints=(say("colcon builds what is in ~/ros2_ws/src, one folder for each package."),),
    )


def node_elsewhere(state: StudentState) -> Action | None:
    """Return the action for a node file that has another name or is in another folder."""
    name = state.assignment.node_file
    inner = f"~/ros2_ws/src/{state.assignment.package}/{state.assignment.package}"
    if state.node.is_dir():
        found = say("{file} is a folder", file=name)
        why = say("mkdir makes folders; touch makes empty files.")
        command = f"rmdir {inner}/{name} && touch {inner}/{name} && chmod +x {inner}/{name}"
        return Action(command, "source.node_is_folder", found, (why,))
    result = state.results.get("source.node_file")
    place, mistakes, why = "", "source.node_in_home", say("Python imports a node from this folder.")
    if state.home is not None and (state.home / name).is_file():
        place = f"~/{name}"
    elif result is not None and result.status == "failed" and result.mistakes:
        if result.mistakes[0].id in NOT_STARTED:
            return None
        mistakes = result.mistakes[0].id
        if result.where is not None and result.where.file:
            place = f"~/ros2_ws/{state.submission.root}/{result.where.file}"
        elif state.submission.node_files:
            place = f"~/ros2_ws/{state.submission.node_files[0]}"
    if not place:
        return None
    found = say(
        "there is {place}; it must be {wanted}", place=shown(place), wanted=f"{inner}/{name}"
    )
    return Action(f"mv {shown(place)} {inner}/{name}", mistakes, found, (why,))


def _in_home(state: StudentState) -> Iterator[Path]:
    """Yield the packages that lie in the home folder, beside the workspace."""
    if state.home is None:
        return
    try:
        with os.scandir(state.home) as entries:
            names = sorted(e.name for _, e in zip(range(MOST_ENTRIES), entries))
    except OSError:
        return
    for name in names:
        folder = state.home / name
        if not name.startswith(".") and (folder / "package.xml").is_file():
            yield folder


def _own_name(folder: Path) -> str:
    """Return the name in a package's package.xml; "" if it has none."""
    try:
        with (folder / "package.xml").open("rb") as stream:
            return name_in(stream.read(64_000)) or ""
    except OSError:
        return ""
