"""Whether the build installed what the sources declare.

setup.py is a program: it can install another executable than its entry point says, write entry
point metadata by hand, or change the node's source. The mapping is judged from the source; what
runs must be the same.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from grader.base.i18n.message import msg, say
from grader.base.shown import shown
from grader.package.source.setup_faults import argument_line, source_folders
from grader.report.model import Where
from grader.run.workspace import METADATA
from grader.verdict.outcome import Failed

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

WRAPPERS = {
    # setuptools 47 to 79, `develop` and `install`
    "setuptools": "dd02a5dec664ba6788b838eab459adc2139143617203f77feef7eda80e8a54a1",
    # pip
    "pip": "12596bddd4d49b3db221b46fc3bddeac24154643942ac3bdd9b31f4685591064",
}
"""SHA-256 of the scripts that start an entry point, as `wrapper_digest` makes it."""
SECTION = re.compile(r"\s*\[(.{1,100})\]\s*")
REQUIRES = re.compile(r"^__requires__ = '([\w.-]{1,200}(?:==[\w.+!-]{1,100})?)'$", re.MULTILINE)


def must_be_as_declared(evidence: Evidence, script: str = "") -> None:
    """Raise Failed if the build installed something else than the sources declare.

    `script` is the path of the executable that is run; without it, what is judged is the entry
    point that the sources give the assignment's executable, wherever its script was installed.
    """
    build, assignment = evidence.build, evidence.named if script else evidence.assignment
    if build.altered:
        path = build.altered[0]
        raise _other(say("the build changed {path}", path=shown(path)), path)
    if build.faults and not script:
        return  # (the mapping is right; the executable is not what runs)
    _environment_must_be_colcons(evidence)
    targets = {
        target
        for text in build.entry_files.values()
        for name, target in _console_scripts(text)
        if name == assignment.executable
    }
    mapping = evidence.results.get("entry_point.mapping")
    is_declared = not script or (mapping is not None and mapping.status == "passed")
    if is_declared and targets - {assignment.target}:
        other = shown(min(targets - {assignment.target}))
        raise _other(say("its entry point leads to {target}", target=other), "setup.py")
    package = assignment.package
    there = (script,) if script else build.installed(f"lib/{package}/{assignment.executable}")
    text = build.scripts.get(there[0]) if there else None
    if text is None or not (targets or is_declared):
        return
    if (
        not _is_of_this_package(evidence, text)
        or wrapper_digest(text, assignment.executable, assignment.target) not in WRAPPERS.values()
    ):
        found = _missing_source_folder(evidence)
        if found is None:
            actual = say("{path} is not the script of its entry point", path=there[0])
            raise _other(actual, "setup.py")
        if script:  # (the mapping itself is right)
            raise found


FAULTS = {
    "script": msg("{path} is run when the workspace is sourced"),
    "variable": msg("a line of colcon's data changes the environment: {path}"),
    "hides": msg("{path} is found instead of what ROS or Python has under that name"),
}


def _environment_must_be_colcons(evidence: Evidence) -> None:
    """Raise Failed if sourcing the workspace would do more than colcon and ament make it do."""
    for fault in evidence.build.faults:
        name = fault.path.rpartition("/")[2]
        sources = [file.path for file in evidence.submission.files if file.path.endswith(name)]
        path = sources[0] if sources else "setup.py"
        raise _other(say(FAULTS[fault.kind], path=shown(fault.path)), path, variant="overlay")


def _missing_source_folder(evidence: Evidence) -> Failed | None:
    """Return that `package_dir` leads to a folder that the package does not have, if it does."""
    file = evidence.submission.file("setup.py")
    found = file.data if file is not None and file.kind == "file" else b""
    for folder, line in source_folders(found).items():
        if evidence.submission.file(folder) is None and argument_line(found, "packages"):
            return Failed(
                "entry_point.other_installed",
                expected=say("package_dir names a folder of the package"),
                actual=say("there is no folder {name}", name=shown(folder)),
                where=Where(file="setup.py", line=line),
                variant="package_dir",
                words={"name": shown(folder)},
            )
    return None


def _is_of_this_package(evidence: Evidence, text: str) -> bool:
    """Whether the distribution that a script names is one that the build made."""
    required = REQUIRES.search(text)
    if required is None:
        return True
    paths = [path for path in evidence.build.entry_files if METADATA.fullmatch(path)]
    made = {_normal(path.split("/")[-2].removesuffix(".egg-info")) for path in paths}
    return _normal(required[1].partition("==")[0]) in made


def _normal(name: str) -> str:
    """Return a distribution's name as packaging tools compare it (PEP 503)."""
    return re.sub(r"[-_.]+", "-", name).lower()


def wrapper_digest(text: str, executable: str, target: str) -> str:
    """Return the SHA-256 of a script without its names, comments and blank lines."""
    module, _, function = target.partition(":")
    required = REQUIRES.search(text)
    names = {repr(executable): "NAME", f"from {module} import {function}": "IMPORT"}
    names |= {f"sys.exit({function}())": "EXIT"}
    lines = [line.rstrip() for line in text.splitlines()]
    code = "\n".join(line for line in lines if line and not line.lstrip().startswith("#"))
    if required is not None:  # (the executable can have the name of its distribution)
        distribution = re.escape(repr(required[1]))
        code = re.sub(rf"(= |\(){distribution}($|,)", r"\1DISTRIBUTION\2", code, flags=re.MULTILINE)
    for name, placeholder in names.items():
        code = code.replace(name, placeholder)
    return hashlib.sha256(code.encode()).hexdigest()


def _console_scripts(text: str) -> Iterator[tuple[str, str]]:
    """Yield the names and targets of the console scripts in entry point metadata."""
    group = ""
    for line in text.splitlines():
        section = SECTION.fullmatch(line)
        if section is not None:
            group = section[1]
        elif group == "console_scripts" and "=" in line:
            name, _, target = line.partition("=")
            yield name.strip(), "".join(target.split())


def _other(actual: str, path: str, *, variant: str = "") -> Failed:
    return Failed(
        "entry_point.other_installed",
        variant=variant,
        expected=say("the build installs what the sources declare, and leaves them as they are"),
        actual=actual,
        where=Where(file=path),
    )
