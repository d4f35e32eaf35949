"""The installed stage: is the executable where `ros2 run` looks for it?

"No executable found" has four causes (docs/architecture.md); each is a mistake of its own.
"""

from __future__ import annotations

import ast
import contextlib
from typing import TYPE_CHECKING

from grader.base.i18n.message import joined, say
from grader.base.nearest import nearest, with_difference
from grader.base.shown import shown
from grader.package.source.setup_packages import parsed_setup
from grader.report.model import Where
from grader.verdict.checks.as_declared import must_be_as_declared
from grader.verdict.checks.build_log import setup_error
from grader.verdict.checks.declare import BUILD, check
from grader.verdict.checks.entry_faults import wanted_entry
from grader.verdict.checks.entry_point import mapping_from_source
from grader.verdict.checks.parsed import file_of
from grader.verdict.outcome import Blocked, Failed, Inconclusive, Passed
from grader.verdict.own_names import GROUP, SCRIPTS, scripts

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence


@check(
    "entry_point.mapping",
    stage=BUILD,
    needs="files",  # (if setup.py computes the entry point, the build decides)
    depends=["package.found"],
    quotes="transcript",
    covers="files",
)
def mapping(evidence: Evidence) -> Passed:
    """setup.py maps the executable's name to the function that starts the node."""
    passed = mapping_from_source(evidence)
    if passed is not None:
        with contextlib.suppress(Inconclusive):  # (without a build, the source alone decides)
            must_be_as_declared(evidence)
        return passed
    assignment = evidence.assignment
    if not evidence.build.is_installed(assignment.package):
        raise Blocked(by="build.colcon")
    for name, target in scripts(evidence.build.entry_points):
        if name == assignment.executable:
            if target == assignment.target:
                must_be_as_declared(evidence)
                entry = f"{name} = {target}"
                return Passed(actual=say("{entry} (as setup.py computes it)", entry=entry))
            found = f"{name} = {target}"
            raise _computed(evidence, with_difference(found, found, wanted_entry(evidence)))
    if evidence.build.status != 0 and setup_error(evidence.build.log)[0]:
        raise Blocked(by="build.colcon")
    raise _in_other_group(evidence) or _computed(evidence, _other_names(evidence))


def _in_other_group(evidence: Evidence) -> Failed | None:
    """Return that the build has the entry in a group with nearly the name of console_scripts."""
    name, wanted, group = evidence.assignment.executable, wanted_entry(evidence), ""
    for row in evidence.build.entry_points.splitlines():
        heading = GROUP.fullmatch(row.strip())
        group = heading[1].strip() if heading else group
        line = _line_of_group(evidence, group)
        meant = line is not None and nearest("console_scripts", [group], cutoff=0.75)
        if heading or not meant or row.partition("=")[0].strip() != name:
            continue
        said = say("the group is called '{group}'", group=shown(group))
        return Failed(
            "setup.group_misspelt",
            expected=say("'{entry}' in the group 'console_scripts'", entry=wanted),
            actual=with_difference(said, group, SCRIPTS),
            where=Where(file="setup.py", line=line),
            params={"group": shown(group)},
            words={"wanted": wanted},
        )
    return None


def _other_name(evidence: Evidence) -> list[str]:
    """Return which executable is run, if it is not the one that the assignment names."""
    name, wanted = evidence.named.executable, evidence.assignment.executable
    if name in ("", wanted):
        return []
    targets = dict(scripts(evidence.build.entry_points))
    if wanted in targets:
        return [
            say(
                "{wanted} starts '{target}', not '{right}'. {name} leads to the right function "
                "and was run instead.",
                wanted=wanted,
                target=shown(targets[wanted]),
                right=evidence.assignment.target,
                name=name,
            )
        ]
    return [
        say(
            "There is no executable {wanted}. {name} leads to the right function and was run "
            "instead.",
            wanted=wanted,
            name=name,
        )
    ]


def _other_names(evidence: Evidence) -> str:
    """Return that no entry has the name, and the names that setup.py makes."""
    names = ", ".join(shown(name) for name, _ in scripts(evidence.build.entry_points)[:4])
    none = say("no entry named {executable}", executable=evidence.assignment.executable)
    return joined(none, say("there are only: {names}", names=names), by=", ") if names else none


def _computed(evidence: Evidence, actual: str) -> Failed:
    entry = wanted_entry(evidence)
    return Failed(
        "entry_point.computed_mapping",
        expected=say("'{entry}' among the console_scripts", entry=entry),
        actual=actual,
        where=Where(file="setup.py", line=_line_of_group(evidence)),
        words={"wanted": entry},
    )


def _line_of_group(evidence: Evidence, group: str = SCRIPTS) -> int | None:
    """Return the one line of setup.py that names a group; None if there are others."""
    file = file_of(evidence, "setup.py")
    module = parsed_setup(file.data) if file is not None else None
    texts = [n for n in module.nodes if isinstance(n, ast.Constant)] if module is not None else []
    lines = [text.lineno for text in texts if text.value == group]
    return lines[0] if len(lines) == 1 else None


@check(
    "entry_point.executable",
    stage=BUILD,
    depends=["build.colcon"],
    after=["package.setup_cfg", "entry_point.mapping"],
    quotes="transcript",
    covers="files",
)
def executable(evidence: Evidence) -> Passed:
    """The executable is where ros2 run looks for it."""
    package = evidence.assignment.package
    name = evidence.named.executable or evidence.assignment.executable
    files = evidence.build.files
    place = f"install/{package}/lib/{package}/{name}"
    there = evidence.build.installed(f"lib/{package}/{name}")
    found = files[there[0]] if there else None
    if found is not None and found.kind == "f" and found.mode & 0o111:
        if evidence.has_mistake("entry_point.mapping", "entry_point.other_installed"):
            raise Blocked(by="entry_point.mapping")
        must_be_as_declared(evidence, there[0])
        return Passed(actual=there[0], advice=_other_name(evidence))
    if found is not None and found.kind == "f":
        raise Failed(
            "entry_point.no_exec_bit",
            expected=say("{place} with the exec bit", place=place),
            actual=say(
                "its mode is {mode}: ros2 run says No executable found", mode=f"{found.mode:04o}"
            ),
        )
    for cause in ("entry_point.mapping", "package.setup_cfg"):
        if evidence.has_failed(cause):
            raise Blocked(by=cause)
    elsewhere = sorted(p for p in files if p.startswith("install/") and p.endswith(f"/{name}"))
    if elsewhere:
        raise Failed(
            "entry_point.elsewhere",
            expected=place,
            actual=say(
                "it was installed as {path}: ros2 run says No executable found", path=elsewhere[0]
            ),
            where=Where(file="setup.cfg"),
            params={"path": elsewhere[0]},
            words={"package": package},
        )
    error, _ = setup_error(evidence.build.log)
    nothing = say(
        "nothing named {name} was installed: ros2 run says No executable found", name=name
    )
    nothing = joined(nothing, there_are(evidence), by="\n")
    with_error = say(
        "nothing named {name} was installed ({error}): ros2 run says No executable found",
        name=name,
        error=error,
    )
    raise Failed(
        "entry_point.not_installed",
        expected=place,
        actual=with_error if error else nothing,
        where=Where(file="setup.py"),
    )


def there_are(evidence: Evidence) -> str:
    """Return the names of the executables that the build made of the package; "" if there are none."""
    folder = f"lib/{evidence.assignment.package}/"
    made = evidence.build.files
    names = {path.partition(f"/{folder}")[2] for path in made if path.startswith("install/")}
    known = ", ".join(shown(name) for name in sorted(names) if name and "/" not in name)
    return say("there are only: {names}", names=known) if known else ""


def executable_must_be_there(evidence: Evidence) -> None:
    """Raise why `ros2 run` finds no executable of the node: what a check of it found, or would find."""
    for found in (mapping, executable):
        if evidence.has_failed(found.id):
            raise Blocked(by=found.id)
        if found.id not in evidence.results:
            found.function(evidence)
