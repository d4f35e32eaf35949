"""What can be wrong with an entry of console_scripts: each fault told apart, with its one fix."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from grader.checks.parsed import meant
from grader.checks.parsed import names_in
from grader.checks.parsed import nearest
from grader.checks.registry import Failed
from grader.intake.notes import shown
from grader.report.model import Where
from grader.source.entry_points import Entry
from grader.source.entry_points import EntryPoints

if TYPE_CHECKING:
    from grader.evidence import Evidence
    from grader.source.setup_py import SetupPy

WHY = (
    "An entry of console_scripts reads: name = package.module:function. From it colcon makes the "
    "executable that ros2 run starts: <name> is what you type after the package."
)
WHY_STOPS = (
    WHY + " setuptools stops at an entry that it cannot read; colcon then only says that "
    "distutils.core.setup() was never called."
)
WHY_DIES = WHY + " The build does not look into the module: a wrong part shows only at ros2 run."
WHY_NOT_FOUND = WHY + " Without it ros2 run answers: No executable found."


def _wanted(evidence: Evidence) -> str:
    return f"{evidence.assignment.executable} = {evidence.assignment.target}"


def _failed(
    evidence: Evidence,
    entry: Entry,
    mistake: str,
    *,
    because: str,
    rationale: str,
    fix: str = "",
    **params: str,
) -> Failed:
    return Failed(
        expected=f"'{_wanted(evidence)}'",
        actual=f"'{shown(entry.text)}': {because}",
        where=Where(file=entry.file, line=entry.line),
        rationale=rationale,
        fix=fix or f"Write '{_wanted(evidence)}',",
        mistake=mistake,
        params={"entry": shown(entry.text), **params},
    )


def broken(evidence: Evidence, entry: Entry) -> Failed:
    """Return what keeps setuptools from reading an entry (ours or another: it stops the build)."""
    text, target = entry.text, entry.target
    pieces = [piece for piece, _ in entry.pieces]
    if len(pieces) > 1 and sum("=" in piece or ":" in piece for piece in pieces) > 1:
        return _failed(
            evidence,
            entry,
            "setup.missing_comma",
            because="two entries run into one, because there is no comma between them",
            rationale="Python joins two texts that stand side by side into one. " + WHY_STOPS,
            fix=f"Put a comma after '{shown(pieces[0])}'.",
            line=str(entry.pieces[0][1]),
        )
    mistake, because = _fault_of(text, target)
    asked = entry.name == evidence.assignment.executable or evidence.assignment.executable in text
    return _failed(
        evidence,
        entry,
        mistake,
        because=because,
        rationale=WHY_STOPS,
        fix="" if asked else f"Mend this entry, or delete it: '{shown(text)}'",
    )


def _fault_of(text: str, target: str) -> tuple[str, str]:
    """Return the mistake's id and the reason for an entry that is not `name = module:function`."""
    if "=" not in text:
        if re.match(r"\s{0,9}[\w-]{1,80}\s{0,9}:", text):
            return "setup.colon_for_equals", "after the name comes '=', not ':'"
        return "setup.no_equals", "there is no '=' between the name and the module"
    faults = (
        (not text.partition("=")[0].strip(), "setup.no_name", "there is no name before the '='"),
        (not target, "setup.no_target", "there is nothing after the '='"),
        ("=" in target, "setup.two_equals", "there is more than one '=' in it"),
        ("/" in target or "\\" in target, "setup.slash_in_target", "folders are joined with dots"),
        ("(" in target, "setup.brackets", "the function is only named, not called: no ()"),
        ("-" in target, "setup.dash_in_target", "a dash cannot be in the name of a Python module"),
        (target.count(":") > 1, "setup.two_colons", "there is more than one ':' in it"),
        (" " in target, "setup.space_in_target", "there is a space in the module or function"),
    )
    for holds, mistake, because in faults:
        if holds:
            return mistake, because
    return "setup.bad_entry", "it is not of the form name = package.module:function"


def duplicate(evidence: Evidence, entries: list[Entry]) -> Failed:
    """Return the fault of several entries of one name."""
    lines = " and ".join(str(entry.line) for entry in entries[:3])
    return _failed(
        evidence,
        entries[1],
        "setup.duplicate_entry",
        because=f"the name is there {len(entries)} times, on lines {lines}",
        rationale=WHY + " One name can stand for one function only.",
        fix=f"Keep one line: '{_wanted(evidence)}',",
    )


def missing(evidence: Evidence, points: EntryPoints, setup: SetupPy) -> Failed:
    """Return why there is no executable of the name: another name, another group, or no entry."""
    wanted = evidence.assignment.executable
    entries = points.group("console_scripts")
    same = [e for e in entries if "".join(e.target.split()) == evidence.assignment.target]
    names = [entry.name for entry in entries]
    close = nearest(wanted, names, cutoff=0.7)
    meant_here = same or [e for e in entries if e.name == close]
    if meant_here:
        entry = meant_here[0]
        spaced = "".join(entry.name.split()) != entry.name
        return _failed(
            evidence,
            entry,
            "setup.space_in_name" if spaced else "setup.other_executable",
            because="there is a space in the executable's name"
            if spaced
            else f"the executable is called '{shown(entry.name)}', not '{wanted}'",
            rationale=WHY_NOT_FOUND,
            name=shown(entry.name),
        )
    for group, others in points.groups.items():
        holds_it = any(entry.name == wanted for entry in others)
        if holds_it or nearest("console_scripts", [group], cutoff=0.75):
            return _other_group(evidence, points, group)
    return _no_entry(evidence, points, setup)


def _other_group(evidence: Evidence, points: EntryPoints, group: str) -> Failed:
    others = points.group(group)
    line = points.lines.get(group)
    return Failed(
        expected=f"'{_wanted(evidence)}' in the group 'console_scripts'",
        actual=f"the group is called '{shown(group)}'",
        where=Where(file=others[0].file if others else "setup.py", line=line),
        rationale="setuptools makes executables from the group console_scripts; a group that it "
        "does not know it takes without a word, and ros2 run says: No executable found.",
        fix="Write 'console_scripts', with the s at its end.",
        mistake="setup.group_misspelt",
        params={"group": shown(group)},
    )


def _no_entry(evidence: Evidence, points: EntryPoints, setup: SetupPy) -> Failed:
    wanted = evidence.assignment.executable
    marks = re.compile(rf"['\"]?{re.escape(wanted)}\s{{0,9}}=")
    comment = next((row for row in setup.comments if marks.match(row[1])), None)
    names = ", ".join(shown(entry.name) for entry in points.group("console_scripts")[:4])
    line = points.lines.get("console_scripts", setup.line)
    actual = f"there are only: {names}" if names else "console_scripts has no entry"
    fix = f"Add to console_scripts the line '{_wanted(evidence)}', and build again."
    if comment is not None:
        line = comment[0]
        actual = f"the entry is commented out: # {shown(comment[1])}"
        fix = f"Take away the # in front of '{_wanted(evidence)}', and build again."
    elif not points.groups:
        actual = "setup() is given no entry_points"
        fix = f"Add to setup(): entry_points={{'console_scripts': ['{_wanted(evidence)}']}},"
    return Failed(
        expected=f"'{_wanted(evidence)}' among the console_scripts",
        actual=actual,
        where=Where(file="setup.py", line=line),
        rationale=WHY_NOT_FOUND,
        fix=fix,
        mistake="setup.no_entry",
    )


def other_target(evidence: Evidence, entry: Entry) -> Failed:
    """Return which part of the target is not what was asked for."""
    mistake, because = _part(evidence, "".join(entry.target.split()))
    return _failed(
        evidence, entry, mistake, because=because, rationale=WHY_DIES, target=shown(entry.target)
    )


def _part(evidence: Evidence, target: str) -> tuple[str, str]:
    wanted, _, function = evidence.assignment.target.partition(":")
    package, _, stem = wanted.rpartition(".")
    module, colon, given = target.partition(":")
    given = re.sub(r"\[.*\]", "", given)
    if module == wanted:
        if not colon:
            return "setup.no_function", f"':{function}' is left out: a module cannot be called"
        hint = meant(function if nearest(given, [function]) else "")
        return "setup.other_function", f"the function is '{shown(given)}', not '{function}'{hint}"
    if module == f"{wanted}.{function}" and not colon:
        return "setup.dot_for_colon", "between module and function comes ':', not '.'"
    if module.endswith(".py") or ".py." in module:
        return "setup.py_in_target", "a module is named without its file's ending .py"
    if module in (stem, f".{stem}"):
        return "setup.no_package_prefix", f"the package's name and a dot are missing: '{wanted}'"
    first, _, rest = module.partition(".")
    if rest == stem:
        return "setup.other_package", f"the package is '{shown(first)}', not '{package}'"
    path = module.replace(".", "/")
    submission = evidence.submission
    if submission.file(f"{path}.py") or submission.file(f"{path}/__init__.py"):
        return "setup.other_module", f"it leads to another module: '{shown(module)}'"
    modules = {n.removesuffix(".py") for n in names_in(evidence, package) if n.endswith(".py")}
    hint = meant(nearest(module.rpartition(".")[2], {*modules, stem}))
    return "setup.misspelt_module", f"there is no module '{shown(module)}'{hint}"
