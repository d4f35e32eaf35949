"""Which file is the node's, if it has another name or is in another folder of the package?

It is judged where it is, so that a wrong name or place costs the points of one check only. If
several files could be the node's, none is: a guess could judge the wrong one.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from grader.base.nearest import nearest
from grader.package.source.node import read_module, read_node
from grader.package.source.node_class import derives_from_node
from grader.package.source.python import can_parse
from grader.verdict.checks.parsed import (
    CONSOLE,
    data_of,
    entry_points_of,
    file_of,
    names_in,
    node_path,
    setup_py_of,
)

if TYPE_CHECKING:
    from grader.package.source.entry_points import Entry
    from grader.verdict.evidence import Evidence

MOST_FILES = 30
"""The most Python files in which a node is looked for; a package with more has none that is certain."""


def actual_path(evidence: Evidence) -> str:
    """Return the path of the node's file where it is: the required one, or that of another file."""
    path = node_path(evidence)
    return path if file_of(evidence, path) is not None else other_path(evidence) or path


def other_path(evidence: Evidence) -> str:
    """Return the path of the one other file that is the node's; "" if none is certain.

    It is the file that the entry point leads to, else the only one with the node, else the one
    with nearly the right name, else the package's __init__.py.
    """
    paths = _python_files(evidence)
    if len(paths) > MOST_FILES or node_path(evidence) in evidence.submission.links_out:
        return ""
    nodes = [path for path in paths if is_the_node(evidence, path)]
    entry = of_entry(evidence)
    if entry and (entry in nodes or _imports_one_of(evidence, entry, nodes)):
        return entry
    found = possible_paths(evidence)
    if found:
        return found[0] if len(found) == 1 else ""
    if entry and _is_sole_entry(evidence, entry):
        return entry
    near, init = near_name(evidence), f"{evidence.assignment.folder}/__init__.py"
    if near and _can_be_node(evidence, near):
        return near
    return init if has_node(evidence, init) else ""


def possible_paths(evidence: Evidence) -> list[str]:
    """Return the files that have the required node, or its file's name in another folder."""
    paths = _python_files(evidence)[:MOST_FILES]
    nodes = [path for path in paths if is_the_node(evidence, path)]
    return list(dict.fromkeys((*nodes, *_same_name(evidence))))


def of_entry(evidence: Evidence) -> str:
    """Return the other Python file that the executable's only entry leads to; "" if there is none."""
    found = [e for e in _entries(evidence) if e.name == evidence.assignment.executable]
    path, paths = _module_of(found[0]) if len(found) == 1 else "", _python_files(evidence)
    return next((p for p in (f"{path}.py", f"{path}/__init__.py") if p in paths), "")


def other_entries(evidence: Evidence) -> set[str]:
    """Return the paths of the files that the other executables of the package lead to."""
    others = [e for e in _entries(evidence) if e.name != evidence.assignment.executable]
    return {f"{_module_of(entry)}.py" for entry in others}


def near_name(evidence: Evidence) -> str:
    """Return the path of the file in the inner folder with nearly the node's name; "" if none."""
    inner, name = evidence.assignment.folder, evidence.assignment.node_file
    beside = [n for n in names_in(evidence, inner) if n not in ("__init__.py", name)]
    stem = name.removesuffix(".py").lower()
    close = next((n for n in beside if n.partition(".")[0].lower() == stem), "")
    close = close or nearest(name, beside, cutoff=0.75)
    return f"{inner}/{close}" if close else ""


def has_node(evidence: Evidence, path: str) -> bool:
    """Whether a file has a class that derives from a node, or the entry point's function."""
    module = read_module(partial(data_of, evidence), path)
    if module is None:
        return False
    function = evidence.assignment.function
    return function in module.functions or any(map(derives_from_node, module.classes))


def is_the_node(evidence: Evidence, path: str) -> bool:
    """Whether a file has a node with the name that the assignment requires."""
    file = file_of(evidence, path)
    named = file is not None and evidence.assignment.node_name.encode() in file.data
    return named and has_node(evidence, path)


def _python_files(evidence: Evidence) -> list[str]:
    """Return the package's Python files without the required one and those of other nodes."""
    assignment = evidence.assignment
    others = {f"{assignment.folder}/{node.file}" for node in assignment.nodes.values()}
    left_out = {node_path(evidence), "setup.py", *others}
    return [
        file.path
        for file in evidence.submission.files
        if file.kind == "file" and file.path.endswith(".py") and file.path not in left_out
    ]


def _same_name(evidence: Evidence) -> list[str]:
    """Return the files with the node's name in other folders, without empty ones."""
    name, wanted = evidence.assignment.node_file, node_path(evidence)
    return [
        file.path
        for file in evidence.submission.files
        if file.kind == "file" and file.path.rpartition("/")[2] == name
        if file.path != wanted and file.data.strip()
    ]


def _entries(evidence: Evidence) -> list[Entry]:
    setup = setup_py_of(evidence)
    points = entry_points_of(evidence, setup) if setup is not None and setup.is_static else None
    return points.group(CONSOLE) if points is not None else []


def _module_of(entry: Entry) -> str:
    return "".join(entry.target.split()).partition(":")[0].replace(".", "/")


def _is_sole_entry(evidence: Evidence, path: str) -> bool:
    """Whether no other executable leads to a file, which can have the node."""
    same = [e for e in _entries(evidence) if path.startswith(f"{_module_of(e)}.")]
    return len(same) == 1 and _can_be_node(evidence, path)


def _can_be_node(evidence: Evidence, path: str) -> bool:
    """Whether a file has a node, or is Python code with an error."""
    code = data_of(evidence, path) or b""
    broken = path.endswith(".py") and bool(code.strip()) and not can_parse(code)
    return broken or has_node(evidence, path)


def _imports_one_of(evidence: Evidence, path: str, nodes: list[str]) -> bool:
    """Whether the function in a file is started with the node of another one."""
    source = read_node(partial(data_of, evidence), path, evidence.assignment.function)
    return source is not None and source.main is not None and bool({*source.paths} & {*nodes})
