"""The entry point in the source of setup.py or setup.cfg: which of its parts is wrong?

`entry_points` maps the executable's name, an argument of `ros2 run`, to a function in a module of
the package: `name = package.module:function`. If setup.py computes it, only the build can tell.
"""

from __future__ import annotations

import ast
import shlex
from typing import TYPE_CHECKING

from grader.base.i18n.message import say
from grader.base.nearest import nearest, there_is, with_difference
from grader.base.shown import shown
from grader.package.source.documents import document_of
from grader.package.source.python import PythonFault, parse_python
from grader.report.model import Where
from grader.verdict.checks import entry_faults
from grader.verdict.checks.inner_package import entry_in_inner_package
from grader.verdict.checks.parsed import (
    CONSOLE,
    entry_points_of,
    file_of,
    in_inner_folder,
    names_in,
    node_path,
    printable_reason,
    setup_py_of,
)
from grader.verdict.outcome import Blocked, Failed, Passed

if TYPE_CHECKING:
    from grader.package.source.setup_py import SetupPy
    from grader.verdict.evidence import Evidence


def mapping_from_source(evidence: Evidence) -> Passed | None:
    """Check the mapping in the source; None if only running setup.py would show it.

    Raises Failed with the part that is wrong.
    """
    file = file_of(evidence, "setup.py")
    if file is None or file.unreadable:
        inner = in_inner_folder(evidence, "setup.py") if file is None else ""
        close = nearest("setup.py", names_in(evidence, ""), cutoff=0.8)
        raise _no_setup_py(evidence, file.reason if file else "", inner, close)
    setup = setup_py_of(evidence)
    if setup is None or not setup.is_static:
        return None
    points = entry_points_of(evidence, setup)
    if points is None:
        return None
    assignment = evidence.assignment
    entries = points.group(CONSOLE)
    for entry in entries:
        if not entry.valid:
            right = any(other.valid and other.name == assignment.executable for other in entries)
            raise entry_faults.broken(evidence, entry, is_other=right)
    named = [entry for entry in entries if entry.name == assignment.executable]
    if len(named) > 1:
        raise entry_faults.duplicate(evidence, named)
    if not named:
        if not points.is_static:
            return None
        created_inside = entry_in_inner_package(evidence)
        raise created_inside or entry_faults.missing(evidence, points, setup)
    entry = named[0]
    if "".join(entry.target.split()) != assignment.target:
        if _comes_from_name(evidence, setup, entry.target):
            raise Blocked(by="package.manifest")
        raise entry_faults.other_target(evidence, entry)
    text = shown(f"{entry.name} = {entry.target}")
    said = say("{file}, line {line}: {entry}", file=entry.file, line=entry.line, entry=text)
    return Passed(actual=said, advice=_advice(evidence))


def _comes_from_name(evidence: Evidence, setup: SetupPy, target: str) -> bool:
    """Whether only the wrong name of the package, set once in setup.py, makes a target wrong."""
    file = file_of(evidence, "setup.py")
    if setup.name is None or file is None:
        return False
    if not evidence.has_mistake("package.manifest", "package.name_mismatch"):
        return False
    name = setup.name.value
    once = file.data.count(name.encode()) == 1
    rest = evidence.assignment.target.removeprefix(evidence.assignment.package)
    return once and "".join(target.split()) == name + rest


def _no_setup_py(evidence: Evidence, reason: str, inner: str, close: str) -> Failed:
    cannot = say("setup.py cannot be read: {reason}", reason=printable_reason(reason))
    expected = say("a setup.py with the entry point")
    other = inner or (close if not reason else "")
    there = say("there is no {path}, but {there}", path="setup.py", there=shown(other))
    return Failed(
        "setup.missing",
        expected=expected,
        actual=there if other else cannot if reason else say("there is no setup.py"),
        where=Where(file=shown(other) or "setup.py"),
        variant="renamed" if other else "",
        params={"there": shown(other)} if other else {},
        words={"package": evidence.assignment.package, "there": shlex.quote(shown(other))},
    )


def _advice(evidence: Evidence) -> list[str]:
    """Return advice if the node's file does not define the function of the mapping."""
    module, _, function = evidence.assignment.target.partition(":")
    path = module.replace(".", "/") + ".py"
    file = file_of(evidence, path)
    if file is None or path != node_path(evidence) or not file.data.strip():
        return []
    if document_of(file.data) is not None:  # Python takes a notebook for a dict
        return []
    try:
        names = _top_names(parse_python(file.data).tree)
    except PythonFault:
        return []
    if function in names or "*" in names or "__getattr__" in names:
        return []
    close = nearest(function, names)
    none = say("But {path} defines no function {function}", path=path, function=function)
    rest = say(
        ": ros2 run will stop with AttributeError. Define it: def {function}(args=None):",
        function=function,
    )
    return [with_difference(none + there_is(close) + rest, close, function)]


def _top_names(tree: ast.Module) -> set[str]:
    """Return every name that the module may define, wherever it is bound (`*` for any)."""
    names: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            names.add(node.name)
        elif isinstance(node, ast.alias):
            names.add(node.asname or node.name)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            names.add(node.id)
    return names
