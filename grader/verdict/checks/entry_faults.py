"""The faults of an entry of console_scripts: each is a mistake of its own, with one fix."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from grader.base.i18n.message import Message, say
from grader.base.nearest import meant, nearest, there_is, with_difference
from grader.base.shown import shown
from grader.package.source.entry_points import Entry, EntryPoints, Misplaced, misplaced
from grader.package.source.in_class import line_in_class
from grader.package.source.python import PythonFault, parse_python
from grader.package.source.values import Table, Text
from grader.report.model import Where
from grader.verdict.checks.parsed import data_of, file_of, names_in, node_path
from grader.verdict.outcome import Failed

if TYPE_CHECKING:
    from grader.package.source.setup_py import SetupPy
    from grader.verdict.evidence import Evidence


def wanted_entry(evidence: Evidence) -> str:
    """Return the entry that the assignment asks for."""
    return f"{evidence.assignment.executable} = {evidence.assignment.target}"


def title_of(mistake: str) -> Message:
    """Return a mistake's title in the catalogue."""
    from grader.mistakes.catalogue import CATALOGUE  # noqa: PLC0415 - slow, rarely needed

    return Message(CATALOGUE[mistake].title)


def _failed(
    evidence: Evidence,
    entry: Entry,
    mistake: str,
    because: str = "",
    *,
    found: str = "",
    meant_to_be: str = "",
    variant: str = "",
    words: dict[str, str] | None = None,
    **params: str,
) -> Failed:
    """Return the fault of an entry; `found` is the part that should be `meant_to_be`."""
    text, fix = shown(entry.text), ""
    if entry.file == "setup.cfg" and not variant:
        fix = say(
            "Write in setup.cfg, without quotes: {wanted}. Then build again.",
            wanted=wanted_entry(evidence),
        )
    said = say("'{entry}': {because}", entry=text, because=because or title_of(mistake))
    return Failed(
        mistake,
        expected=f"'{wanted_entry(evidence)}'",
        actual=with_difference(said, found or text, meant_to_be or wanted_entry(evidence)),
        where=Where(file=entry.file, line=entry.line),
        variant=variant,
        params={"entry": text, **params},
        fix=fix,
        words={"wanted": wanted_entry(evidence), **(words or {})},
    )


def broken(evidence: Evidence, entry: Entry, *, is_other: bool) -> Failed:
    """Return the fault of an entry that setuptools cannot read; any such entry stops the build.

    With `is_other` the required entry is there too.
    """
    pieces = [piece for piece, _ in entry.pieces]
    if len(pieces) > 1 and sum("=" in piece or ":" in piece for piece in pieces) > 1:
        return _failed(
            evidence,
            entry,
            "setup.missing_comma",
            words={"before": shown(pieces[0])},
            line=str(entry.pieces[0][1]),
        )
    executable = evidence.assignment.executable
    is_wanted = entry.name == executable or (executable in entry.text and not is_other)
    because = _fault_of(entry.text, entry.target)
    variant, wanted = ("", "") if is_wanted else ("other", shown(entry.text))
    return _failed(evidence, entry, "setup.bad_entry", because, variant=variant, meant_to_be=wanted)


def _fault_of(text: str, target: str) -> str:
    """Return what is wrong with an entry that is not `name = module:function`."""
    colon = re.match(r"\s{0,9}[\w-]{1,80}\s{0,9}:", text)
    faults = (
        ("=" not in text and colon, say("after the name comes '=', not ':'")),
        ("=" not in text, say("the '=' between the name and the module is missing")),
        (not text.partition("=")[0].strip(), say("the name before the '=' is missing")),
        (not target, say("there is nothing after the '='")),
        ("=" in target, say("there is more than one '='")),
        ("/" in target or "\\" in target, say("folders are separated by dots, not slashes")),
        ("(" in target, say("the function is named, not called: no ()")),
        ("-" in target, say("a Python module's name cannot contain a dash")),
        (target.count(":") > 1, say("there is more than one ':'")),
        (
            " " in target and target[:1] not in ">~:|",
            say("there is a space in the module or function"),
        ),
    )
    return next((said for holds, said in faults if holds), "")


def duplicate(evidence: Evidence, entries: list[Entry]) -> Failed:
    """Return the fault of several entries with one name."""
    lines = ", ".join(str(entry.line) for entry in entries[:3])
    said = say("the name is used {count} times, on lines {lines}", count=len(entries), lines=lines)
    return _failed(evidence, entries[1], "setup.duplicate_entry", said)


def missing(evidence: Evidence, points: EntryPoints, setup: SetupPy) -> Failed:
    """Return why no executable has the name: another name, another group, or no entry."""
    wanted = evidence.assignment.executable
    entries = points.group("console_scripts")
    same = [e for e in entries if "".join(e.target.split()) == evidence.assignment.target]
    of_others = {(node.executable, node.target) for node in evidence.assignment.nodes.values()}
    names = [e.name for e in entries if (e.name, "".join(e.target.split())) not in of_others]
    close = nearest(wanted, names, cutoff=0.7)
    meant_here = same or [e for e in entries if e.name == close]
    if meant_here and not any(entry.name == wanted for entry in points.lost):
        entry = meant_here[0]
        name = shown(entry.name)
        said = say("the executable is called '{name}', not '{wanted}'", name=name, wanted=wanted)
        return _failed(
            evidence,
            entry,
            "setup.other_executable",
            said,
            found=name,
            meant_to_be=wanted,
            name=name,
        )
    at_margin = _at_margin(evidence, points)
    if at_margin is not None:
        return at_margin
    for group, others in points.groups.items():
        holds_it = any(entry.name == wanted for entry in others)
        if holds_it or nearest("console_scripts", [group], cutoff=0.75):
            return _other_group(evidence, points, group)
    return _no_entry(evidence, points, setup)


def _at_margin(evidence: Evidence, points: EntryPoints) -> Failed | None:
    """Return that the entry begins at the margin of setup.cfg, so that it is a group of its own."""
    wanted = evidence.assignment.executable
    rows = points.group(wanted)
    if "console_scripts" not in points.groups or [row.file for row in rows] != ["setup.cfg"]:
        return None
    text = shown(f"{wanted} = {rows[0].text}")
    return Failed(
        "setup.entry_at_margin",
        expected=say("an indented line below console_scripts ="),
        actual=say("the line begins at the left margin: {entry}", entry=text),
        where=Where(file="setup.cfg", line=points.lines.get(wanted)),
        words={"code": text},
    )


def _other_group(evidence: Evidence, points: EntryPoints, group: str) -> Failed:
    others = points.group(group)
    line = points.lines.get(group)
    said = say("the group is called '{group}'", group=shown(group))
    near = nearest("console_scripts", [group], cutoff=0.75)
    return Failed(
        "setup.group_misspelt",
        expected=say("'{entry}' in the group 'console_scripts'", entry=wanted_entry(evidence)),
        actual=with_difference(said, group, "console_scripts"),
        where=Where(file=others[0].file if others else "setup.py", line=line),
        variant="" if near else "other",
        params={"group": shown(group)},
        words={"wanted": wanted_entry(evidence)},
    )


def _no_entry(evidence: Evidence, points: EntryPoints, setup: SetupPy) -> Failed:
    wanted = evidence.assignment.executable
    marks = re.compile(rf"['\"]?{re.escape(wanted)}\s{{0,9}}=")
    comment = next((row for row in setup.comments if marks.match(row[1])), None)
    names = ", ".join(shown(entry.name) for entry in points.group("console_scripts")[:4])
    line = points.lines.get("console_scripts", setup.line)
    lost = [entry.line for entry in points.lost if entry.name == wanted]
    actual = say("console_scripts has no entry")
    in_cfg = bool(points.groups) and _has_no_points(setup)
    variant = "cfg" if in_cfg else "" if "console_scripts" in points.groups else "group"
    if names:
        actual = say("there are only: {names}", names=names)
    stray = f"{evidence.assignment.folder}/setup.py"
    if evidence.assignment.target.encode() in (data_of(evidence, stray) or b""):
        actual = say(
            "console_scripts has no entry; it is in {path}, which colcon does not read: delete that file",
            path=stray,
        )
    if lost:
        actual = say("this console_scripts replaces the one with line {line}", line=lost[0])
    elif comment is not None:
        line = comment[0]
        actual = say("the entry is commented out: # {comment}", comment=shown(comment[1]))
    elif not points.groups and (close := _near_argument(setup)):
        none = say("setup() has no entry_points argument") + there_is(close)
        actual, variant = with_difference(none, close, "entry_points"), "nothing"
    elif (entry := _elsewhere(evidence)) is not None:
        return _misplaced(evidence, entry)
    elif not points.groups and setup.argument("entry_points") is None:
        actual, variant = say("setup() has no entry_points argument"), "nothing"
    elif not points.groups:
        actual, variant = say("entry_points has no group console_scripts"), "nothing"
    elif variant == "group":
        actual = say("entry_points has no group console_scripts")
    return Failed(
        "setup.no_entry",
        expected=say("'{entry}' among the console_scripts", entry=wanted_entry(evidence)),
        actual=actual,
        where=Where(file="setup.cfg" if in_cfg else "setup.py", line=line),
        variant=variant,
        words={"wanted": wanted_entry(evidence)},
    )


def _has_no_points(setup: SetupPy) -> bool:
    """Whether setup() has no entry points, so that those of setup.cfg count."""
    given = setup.argument("entry_points")
    return given is None or (isinstance(given, Table) and not given.pairs)


def _near_argument(setup: SetupPy) -> str:
    """Return the argument of setup() whose name is nearly entry_points; "" if there is none."""
    names = [key.value for key, _ in setup.arguments.pairs if isinstance(key, Text)]
    return nearest("entry_points", names, cutoff=0.75)


def _elsewhere(evidence: Evidence) -> Misplaced | None:
    file = file_of(evidence, "setup.py")
    try:
        tree = parse_python(file.data).tree if file is not None else None
    except PythonFault:
        return None
    return misplaced(tree, evidence.assignment.executable) if tree is not None else None


def _misplaced(evidence: Evidence, entry: Misplaced) -> Failed:
    """Return the fault of an entry that is in another argument of setup(), or outside of it."""
    argument = shown(entry.argument)
    actual, variant = say("it is in {argument} instead", argument=argument), ""
    if entry.variable:
        variant = "variable"
        actual = say("setup() does not get {name}", name=shown(entry.variable))
    elif not argument:
        actual = say("it is outside of setup()")
    elif argument == "console_scripts":
        actual = say("console_scripts is outside of entry_points")
    return Failed(
        "setup.misplaced_entry",
        expected=say("'{entry}' among the console_scripts", entry=wanted_entry(evidence)),
        actual=actual,
        where=Where(file="setup.py", line=entry.line),
        variant=variant,
        words={"wanted": wanted_entry(evidence), "name": shown(entry.variable)},
    )


def other_target(evidence: Evidence, entry: Entry) -> Failed:
    """Return which part of the target is wrong."""
    target = "".join(entry.target.split())
    mistake, because = _part(evidence, target)
    wanted = evidence.assignment
    file = file_of(evidence, f"{wanted.package}/{wanted.node_file}")
    data = file.data if file is not None else b""
    line = line_in_class(data, target.partition(":")[2], wanted.function)
    in_class = mistake == "setup.other_function" and line > 0
    return _failed(
        evidence,
        entry,
        mistake,
        because,
        found=shown(target),
        meant_to_be=wanted.target,
        variant="in_class" if in_class else "",
        words={"function": wanted.function, "line": str(line), "path": node_path(evidence)},
        target=shown(entry.target),
    )


def _part(evidence: Evidence, target: str) -> tuple[str, str]:
    wanted, _, function = evidence.assignment.target.partition(":")
    package, _, stem = wanted.rpartition(".")
    module, colon, given = target.partition(":")
    given = re.sub(r"\[.*\]", "", given)
    if module == wanted:
        if not colon:
            return "setup.no_function", say(
                "':{function}' is missing: a module cannot be called", function=function
            )
        other = say(
            "it names '{given}', not the function '{function}'",
            given=shown(given),
            function=function,
        )
        return "setup.other_function", other + meant(function if nearest(given, [function]) else "")
    if module == f"{wanted}.{function}" and not colon:
        return "setup.dot_for_colon", ""
    if module.endswith(".py") or ".py." in module:
        return "setup.py_in_target", ""
    if module in (stem, f".{stem}"):
        return "setup.no_package_prefix", say(
            "the package's name and a dot are missing: '{wanted}'", wanted=wanted
        )
    first, _, rest = module.partition(".")
    if rest == stem:
        return "setup.other_package", say(
            "the package is '{found}', not '{package}'", found=shown(first), package=package
        )
    path = module.replace(".", "/")
    submission = evidence.submission
    if submission.file(f"{path}.py") or submission.file(f"{path}/__init__.py"):
        return "setup.other_module", say(
            "it names another module: '{module}'", module=shown(module)
        )
    modules = {n.removesuffix(".py") for n in names_in(evidence, package) if n.endswith(".py")}
    hint = meant(nearest(module.rpartition(".")[2], {*modules, stem}))
    none = say("there is no module '{module}'", module=shown(module))
    return "setup.misspelt_module", none + hint
