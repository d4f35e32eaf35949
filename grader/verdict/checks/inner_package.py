"""A package of the same name inside the package: ros2 pkg create was run in the wrong folder."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grader.base.i18n.message import say
from grader.base.shown import shown
from grader.report.model import Where
from grader.verdict.checks.parsed import data_of, node_path
from grader.verdict.outcome import Failed

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

CREATED_INSIDE = "package.created_inside"
CREATED = ("package.xml", "setup.py", "setup.cfg", "CMakeLists.txt", "resource", "test")
"""What `ros2 pkg create` makes beside the folder of the code."""


def _inner_package(evidence: Evidence) -> str:
    """Return the folder of the inner package, relative to the outer one; "" if there is none."""
    submission = evidence.submission
    start = "" if submission.root == "." else f"{submission.root}/"
    for found in submission.candidates:
        inner = found.path.removeprefix(start)
        inside = found.path.startswith(start) and found.path not in (submission.root, ".")
        if inside and found.name == evidence.assignment.package:
            return inner
    return ""


def node_in_inner_package(evidence: Evidence, path: str) -> Failed | None:
    """Return the fault of a node's file at `path`, if that is in an inner package."""
    inner = _inner_package(evidence)
    if not inner or not path.startswith(f"{inner}/"):
        return None
    wanted = node_path(evidence)
    return Failed(
        CREATED_INSIDE,
        expected=say("a file {path} in the package", path=wanted),
        actual=say("it is in {path}, in a second package", path=shown(path)),
        where=Where(file=shown(path)),
        variant="has_entry" if _names_target(evidence, "setup.py") else "",
        params={"inner": shown(inner), "path": shown(path)},
        words={"wanted": wanted, "entry": _entry(evidence), "extra": _extra(evidence, inner)},
    )


def entry_in_inner_package(evidence: Evidence) -> Failed | None:
    """Return the fault of an entry point that is missing, if an inner package has it."""
    inner = _inner_package(evidence)
    path = f"{inner}/setup.py"
    if not inner or not _names_target(evidence, path) or _names_target(evidence, "setup.py"):
        return None
    if data_of(evidence, node_path(evidence)) is None:
        return None
    if data_of(evidence, f"{inner}/package.xml") is None:
        return None  # (only a stray setup.py)
    lines = (data_of(evidence, path) or b"").splitlines()
    target = evidence.assignment.target.encode()
    line = next((n for n, text in enumerate(lines, 1) if target in text), None)
    return Failed(
        CREATED_INSIDE,
        expected=say("'{entry}' among the console_scripts", entry=_entry(evidence)),
        actual=say("the entry is in the setup.py of a second package, {inner}", inner=shown(inner)),
        where=Where(file=shown(path), line=line),
        variant="entry",
        params={"inner": shown(inner)},
        words={"entry": _entry(evidence), "extra": _extra(evidence, inner)},
    )


def _extra(evidence: Evidence, inner: str) -> str:
    """Return what is to be deleted of an inner package, without the student's own code.

    If the command was run in the package's folder, the inner package is the folder of its code.
    """
    folder = evidence.assignment.folder
    inside = [f.path for f in evidence.submission.files if f.path.startswith(f"{inner}/")]
    code = f"{inner}/{folder}"
    expendable = (f"{code}/__init__.py", f"{code}/{evidence.assignment.node_file}")
    gone = [f"{inner}/{name}" for name in CREATED]
    if all(path in expendable for path in inside if path.startswith(f"{code}/")):
        gone.append(code)
    there = [path for path in gone if any(p == path or p.startswith(f"{path}/") for p in inside)]
    covered = all(any(p == path or p.startswith(f"{path}/") for path in there) for p in inside)
    return " ".join(map(shown, [inner] if covered and inner != folder else there))


def _names_target(evidence: Evidence, path: str) -> bool:
    return evidence.assignment.target.encode() in (data_of(evidence, path) or b"")


def _entry(evidence: Evidence) -> str:
    return f"{evidence.assignment.executable} = {evidence.assignment.target}"
