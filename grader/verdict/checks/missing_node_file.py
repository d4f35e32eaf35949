"""A node's file that is not where it must be: another place or name, a notebook, or no file at all."""

from __future__ import annotations

import re
import shlex
from typing import TYPE_CHECKING

from grader.base.i18n.message import joined, say
from grader.base.nearest import with_difference
from grader.base.shown import shown
from grader.package.source.documents import code_cells
from grader.report.model import Where
from grader.verdict.checks.actual_node import is_the_node, near_name, other_path, possible_paths
from grader.verdict.checks.inner_package import node_in_inner_package
from grader.verdict.checks.parsed import file_of, names_in, node_path
from grader.verdict.outcome import Failed

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

MOST_NOTEBOOKS = 9


def lone_node(evidence: Evidence, path: str) -> str:
    """Return the one other file with the node, in the inner folder or beside setup.py; or ""."""
    inner = evidence.assignment.folder
    saved = re.compile(rf"{re.escape(evidence.assignment.node_file)}(?:~|\.\w{{2,6}})")
    inside = [n for n in names_in(evidence, inner) if n.endswith(".py") or saved.fullmatch(n)]
    beside = [name for name in names_in(evidence, "") if name.endswith(".py")]
    others = {f"{inner}/{name}" for name in inside}.union(beside)
    others -= {path, f"{inner}/__init__.py", "setup.py"}
    found = [there for there in others if is_the_node(evidence, there)]
    return found[0] if len(found) == 1 else ""


def notebook_of(evidence: Evidence) -> str:
    """Return the one notebook of the package whose code imports ROS; "" if there is none."""
    files = [f for f in evidence.submission.files if f.path.endswith(".ipynb")]
    found = [
        file.path
        for file in files[:MOST_NOTEBOOKS]
        if file.kind == "file" and "rclpy" in "".join(code_cells(file.data) or ())
    ]
    return found[0] if len(found) == 1 else ""


def _is_inner(evidence: Evidence, path: str) -> bool:
    """Whether a node's file is in an inner folder, which only has a wrong name."""
    folder, _, name = path.partition("/")
    has_init = file_of(evidence, f"{folder}/__init__.py") is not None
    same = name == evidence.assignment.node_file
    return has_init and same and evidence.submission.file(evidence.assignment.folder) is None


def in_init(path: str, init: str, actual: str) -> Failed:
    """Return the fault of a node that is in the package's __init__.py."""
    return Failed(
        "source.misplaced_node_file",
        expected=say("your node's code in {path}", path=path),
        actual=actual,
        where=Where(file=init),
        variant="init",
        params={"path": init},
        words={"wanted": path, "init": init},
    )


def node_file_must_be_there(evidence: Evidence) -> None:
    """Raise the fault of a missing node's file: another place or name, or no file at all."""
    if file_of(evidence, node_path(evidence)) is None:
        raise not_there(evidence, node_path(evidence))


def not_there(evidence: Evidence, path: str) -> Failed:
    """Return the fault of a file that is not at its path."""
    submission, name = evidence.submission, evidence.assignment.node_file
    inner = evidence.assignment.folder
    expected = say("a file {path} in the package", path=path)
    if path in submission.links_out:
        return Failed(
            "source.node_file_is_link",
            expected=expected,
            actual=say("it is a link to a place outside of the package"),
            where=Where(file=path),
        )
    init, found = f"{inner}/__init__.py", other_path(evidence)
    if found == init:
        return in_init(path, init, say("your node is in {path}", path=init))
    possible = [] if found else possible_paths(evidence)
    if len(possible) > 1:
        return several(path, possible, expected)
    inside = [f.path for f in submission.files if f.path.rpartition("/")[2] == name]
    inside = [found] if found else [p for p in inside if file_of(evidence, p)]
    elsewhere = inside or list(submission.node_files)
    created_inside = node_in_inner_package(evidence, inside[0]) if inside else None
    if created_inside is not None:
        return created_inside
    if elsewhere and not (inside and inside[0].rpartition("/")[0] == inner):
        return _misplaced(evidence, elsewhere[0], is_inside=bool(inside))
    close = found or near_name(evidence)
    notebook = close if close.endswith(".ipynb") else "" if close else notebook_of(evidence)
    if notebook:
        return Failed(
            "source.no_node_file",
            expected=expected,
            actual=say("there is {path}", path=shown(notebook)),
            where=Where(file=shown(notebook)),
            variant="notebook",
            params={"notebook": shown(notebook)},
            words={"path": path, "copy": ""},
        )
    if close:
        there = say("there is {path}", path=shown(close))
        other = close.rpartition("/")[2]
        return Failed(
            "source.misnamed_node_file",
            expected=expected,
            actual=with_difference(there, other, name),
            where=Where(file=shown(close)),
            params={"name": shown(other)},
            words={"there": shlex.quote(shown(close)), "path": path},
        )
    beside = [n for n in names_in(evidence, inner) if n != "__init__.py"]
    files = ", ".join(shown(n) for n in beside[:4]) or say("no file of yours yet")
    actual = say("{inner}/ contains {files}", inner=inner, files=files)
    if not submission.file(inner):
        actual = say("there is no folder {inner} in the package", inner=inner)
    copy = shown(submission.newer_copy)
    if copy:
        actual = joined(actual, say("but the build has a copy: {copy}", copy=copy), by=", ")
    return Failed(
        "source.no_node_file",
        expected=expected,
        actual=actual,
        where=Where(file=path),
        variant="built" if copy else "",
        words={"path": path, "copy": copy},
    )


def _misplaced(evidence: Evidence, place: str, *, is_inside: bool) -> Failed:
    """Return the fault of a node's file in another folder; `is_inside` of the package."""
    path, inner = node_path(evidence), evidence.assignment.folder
    actual, place = say("it is in {path}", path=shown(place)), shown(place)
    movable = is_inside and evidence.submission.file(inner) is not None
    if "/" not in place:
        actual = say("{path} is beside setup.py, and not in the inner folder", path=place)
    if not is_inside:
        actual = say("it is in {path}, outside of the package", path=place)
    variant = "folder" if _is_inner(evidence, place) else "inside" if movable else ""
    return Failed(
        "source.misplaced_node_file",
        expected=say("a file {path} in the package", path=path),
        actual=actual,
        where=Where(file=place) if is_inside else None,
        variant=variant,
        params={"path": place},
        words={
            "wanted": path,
            "folder": place.partition("/")[0],
            "inner": inner,
            "there": shlex.quote(place),
        },
    )


def several(path: str, paths: list[str], expected: str) -> Failed:
    """Return the fault of a missing file, if more than one other file can be the node's."""
    files = ", ".join(shown(found) for found in paths[:4])
    return Failed(
        "source.no_node_file",
        expected=expected,
        actual=say("there is no such file, but: {files}", files=files),
        where=Where(file=path),
        variant="several",
        words={"path": path, "copy": "", "files": files},
    )
