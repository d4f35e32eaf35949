"""The check `package.depends`: does package.xml name the packages that the code imports?"""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

from grader.base.i18n.message import say
from grader.base.nearest import nearest, with_difference
from grader.course.assignment import TURTLESIM
from grader.course.interfaces import ros_interfaces
from grader.package.source.manifest import RUNTIME, ManifestError, read_manifest
from grader.package.source.python import PythonFault, can_parse, parse_python
from grader.package.source.ros_imports import CLIENT, RosImport, ros_imports
from grader.report.model import Where
from grader.verdict.checks.actual_node import actual_path, other_path
from grader.verdict.checks.declare import INTAKE, check
from grader.verdict.checks.parsed import data_of, file_of, node_path
from grader.verdict.outcome import Blocked, Failed, Passed

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

FILE = "package.xml"


@check(
    "package.depends",
    stage=INTAKE,
    depends=["package.found"],
    after=["package.manifest", "source.node_file"],
)
def depends(evidence: Evidence) -> Passed:
    """package.xml names the packages that the code imports."""
    if evidence.has_failed("package.manifest"):
        raise Blocked(by="package.manifest")
    if evidence.has_failed("source.node_file") and not _is_elsewhere(evidence):
        raise Blocked(by="source.node_file")
    try:
        manifest = read_manifest(data_of(evidence, FILE) or b"")
    except ManifestError:
        raise Blocked(by="package.manifest") from None
    named = {element.text: element for tag in RUNTIME for element in manifest.effective(tag)}
    elsewhere = {element.text for element in manifest.depends}
    imported = _imported(evidence)
    for name, place in imported.items():
        if not _names(named, name):
            free = [text for text in named if text not in imported]
            close = "" if name in elsewhere else nearest(name, free, cutoff=0.8) or ""
            tag = "exec_depend" if name in elsewhere else "depend"
            actual = say(
                "{path}, line {line}, imports {package}; package.xml does not say so",
                path=place.file,
                line=place.line or 1,
                package=name,
            )
            raise Failed(
                "package.depend_missing",
                expected=f"<{tag}>{name}</{tag}>",
                actual=with_difference(actual, close, name) if close else actual,
                where=Where(file=FILE, line=named[close].line if close else None),
                variant="misspelt" if close else "other_tag" if name in elsewhere else "",
                params={"needed": name, "found": close},
                words={"lines": _lines(imported, named, elsewhere)},
            )
    return Passed(actual=", ".join(imported))


def _lines(imported: Collection[str], named: Collection[str], elsewhere: Collection[str]) -> str:
    """Return the lines that are missing in package.xml."""
    missing = [one for one in imported if not _names(named, one) and one not in elsewhere]
    return " ".join(f"<depend>{one}</depend>" for one in missing)


def _names(named: Collection[str], package: str) -> bool:
    """Whether a package is among those that are named; turtlesim's interfaces have two."""
    return any(one in named for one in (package, *(TURTLESIM if package in TURTLESIM else ())))


def _is_elsewhere(evidence: Evidence) -> bool:
    """Whether the node's file only has another name or place, and Python can read it."""
    there = data_of(evidence, other_path(evidence))
    missing = file_of(evidence, node_path(evidence)) is None
    return missing and there is not None and can_parse(there)


def _imported(evidence: Evidence) -> dict[str, Where]:
    """Return the packages that the package's modules import from, and the first place of each.

    A misspelt import is left out: the run tells it, and a line for it would be wrong.
    """
    folder, found = evidence.assignment.folder, dict[str, Where]()
    node = actual_path(evidence)
    for file in evidence.submission.files:
        inside = file.path.startswith(f"{folder}/") and file.path.endswith(".py")
        if not (inside or file.path == node) or file.kind != "file" or file.unreadable:
            continue
        try:
            tree = parse_python(file.data).tree
        except PythonFault:
            continue
        for one in ros_imports(tree):
            if one.package != evidence.assignment.package and _is_there(one, evidence):
                found.setdefault(one.package, Where(file=file.path, line=one.line))
    return found


def _is_there(one: RosImport, evidence: Evidence) -> bool:
    """Whether there is such a package, and such a type in it."""
    if one.package == CLIENT or one.package in evidence.assignment.interface_packages:
        return True
    known = ros_interfaces()
    return known.has_type(one.type) if one.type else known.has_package(one.package)
