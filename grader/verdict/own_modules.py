"""An import of the student's own code that fails: how the package's own files are imported."""

from __future__ import annotations

import ast
import re
import sys
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from grader.base.nearest import nearest
from grader.base.shown import shown
from grader.mistakes.imports import MODULES, OTHER_PACKAGES
from grader.mistakes.recognised import NAME_ERROR, RecognisedMistake
from grader.package.source.counter import targets_of
from grader.package.source.module import Function, Module
from grader.package.source.names import module_name
from grader.package.source.node import read_module
from grader.package.source.own_imports import own_imports
from grader.package.source.place import statement_at
from grader.package.source.scopes import bindings
from grader.report.model import Where
from grader.verdict.checks.parsed import data_of, names_in

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

NO_MODULE = re.compile(r"No module named '(?P<name>\w{1,120}(?:\.\w{1,120}){0,9})'")
OF_FILE = re.compile(
    r"cannot import name '(?P<name>\w{1,120})' from '(?P<module>\w{1,120}(?:\.\w{1,120}){1,9})'"
)
OF_ROS = re.compile(
    r"(?:No module named|cannot import name '\w{1,120}' from|module) '(?P<name>rclpy(?:\.\w{1,120}){0,3})'"
)
NO_NAME = re.compile(r"cannot import name '(?P<name>\w{1,120})' from '(?P<module>\w{1,120})'")


def own_module(error: str, where: Where | None, evidence: Evidence) -> RecognisedMistake | None:
    """Return why an import of a module of the own package fails; None if it is another module."""
    package = evidence.assignment.folder
    if (found := _hidden(error, evidence)) is not None:
        return found
    if where is None or not where.file.startswith(f"{package}/"):
        return None
    return (
        _of_other_file(error, where, evidence)
        or _without_package(error, where, evidence)
        or _of_package(error, where, evidence)
        or _not_handed_in(error, where, evidence)
        or _not_in_file(error, where, evidence)
    )


def _hidden(error: str, evidence: Evidence) -> RecognisedMistake | None:
    """Return that the package has a folder or a file rclpy, which Python takes for the one of ROS."""
    if OF_ROS.search(error) is None:
        return None
    for name, path in (("rclpy", "rclpy/__init__.py"), ("rclpy.py", "rclpy.py")):
        if evidence.submission.file(path) is not None:
            return RecognisedMistake(
                kind="node.ros_hidden", params={"name": name}, where=Where(file=path)
            )
    return None


@dataclass(frozen=True)
class _Import:
    """An import statement of one name, and the module that it names."""

    statement: ast.Import | ast.ImportFrom
    module: str
    code: str

    def of(self, module: str) -> str:
        """Return the statement that imports the same from another module."""
        given = self.statement.names[0]
        bound = f" as {given.asname}" if given.asname else ""
        if isinstance(self.statement, ast.ImportFrom):
            return f"from {module} import {', '.join(map(ast.unparse, self.statement.names))}"
        before, _, last = module.rpartition(".")
        return f"from {before} import {last}{bound}"


def _import_at(where: Where, evidence: Evidence) -> _Import | None:
    module = read_module(partial(data_of, evidence), where.file)
    found = statement_at(module, where.line) if module is not None else None
    if module is None or not isinstance(found, ast.Import | ast.ImportFrom):
        return None
    code = module.text.code(found)
    if isinstance(found, ast.ImportFrom):
        return _Import(found, found.module or "", code) if not found.level else None
    return _Import(found, found.names[0].name, code) if len(found.names) == 1 else None


def _without_package(error: str, where: Where, evidence: Evidence) -> RecognisedMistake | None:
    """Return that the code imports a file of its package without the package's name."""
    package, written = evidence.assignment.folder, _import_at(where, evidence)
    match = NO_MODULE.search(error)
    if match is None or written is None:
        return None
    parts = written.module.split(".")
    if parts[0] != match["name"].partition(".")[0]:
        return None
    twice = parts[:2] == [package, package]
    if parts[0] == package and not twice:
        return None
    parts = parts[2:] if twice else parts
    if not parts or parts[0] in OTHER_PACKAGES:
        return None
    folder = where.file.rpartition("/")[0]
    for inner in dict.fromkeys((folder, package)):
        name = _file_of(parts[0], inner, evidence)
        path = f"{inner}/{name}"
        right = name == parts[0] or _defines(f"{path}.py", written, evidence)
        if name and f"{path}.py" != where.file and right:
            module = ".".join((*path.split("/"), *parts[1:]))
            return _imported(written, module, where, variant="")
    there = [f.path for f in evidence.submission.files if f.path.endswith(f"/{parts[-1]}.py")]
    there = there or [f.path for f in evidence.submission.files if f.path == f"{parts[-1]}.py"]
    if len(parts) != 1 or not there or there[0] in ("setup.py", where.file):
        return None
    found = _imported(written, f"{package}.{parts[0]}", where, variant="elsewhere")
    words = {"there": shown(there[0]), "path": f"{package}/{parts[0]}.py"}
    return RecognisedMistake(
        kind=found.kind,
        params={"name": written.code},
        words={**found.words, **words},
        variant="elsewhere",
        where=where,
    )


def _file_of(name: str, folder: str, evidence: Evidence) -> str:
    """Return the module or the folder of a folder that a name means; "" if there is none."""
    known = {n.removesuffix(".py") for n in names_in(evidence, folder) if n.endswith(".py")}
    if name in known or evidence.submission.file(f"{folder}/{name}/__init__.py") is not None:
        return name
    if nearest(name, (*MODULES, *sys.stdlib_module_names), cutoff=0.75):
        return ""
    return nearest(name, known - {"__init__"}, cutoff=0.75)


def _defines(path: str, written: _Import, evidence: Evidence) -> bool:
    """Whether a file has the names that an import takes from it."""
    module = read_module(partial(data_of, evidence), path)
    if isinstance(written.statement, ast.Import):
        return True
    return module is not None and {n.name for n in written.statement.names} <= module.names


def _of_package(error: str, where: Where, evidence: Evidence) -> RecognisedMistake | None:
    """Return that the code imports from the package what one of its files defines."""
    package, written = evidence.assignment.folder, _import_at(where, evidence)
    match = NO_NAME.search(error)
    if match is None or match["module"] != package or written is None:
        return None
    for name in names_in(evidence, package):
        path = f"{package}/{name}"
        module = read_module(partial(data_of, evidence), path) if name.endswith(".py") else None
        if module is None:
            continue
        names = {*module.functions, *(c.name for c in module.classes)}
        if match["name"] in names and path != where.file:
            return _imported(written, f"{package}.{name[:-3]}", where, variant="class")
    return None


def _imported(written: _Import, module: str, where: Where, *, variant: str) -> RecognisedMistake:
    new = written.of(module)
    return RecognisedMistake(
        kind="node.own_module_alone",
        params={"name": written.code, "written": new},
        words={
            "name": shown(written.code),
            "written": shown(new),
            "package": module.partition(".")[0],
        },
        variant=variant,
        where=where,
    )


def _defined_in(module: Module) -> set[str]:
    """Return the names that the lines at the margin of a file define."""
    tops = module.tree.body
    known = {target for s in tops for target in targets_of(s) if "." not in target}
    return known | {s.name for s in tops if isinstance(s, Function | ast.ClassDef)}


def _offers(module: Module, name: str) -> bool:
    """Whether a file that is no program of its own defines a function, a class or a constant."""
    made = {*module.functions, *(c.name for c in module.tree.body if isinstance(c, ast.ClassDef))}
    constant = name.isupper() and name in _defined_in(module)
    return "main" not in module.functions and (name in made or constant)


def _of_other_file(error: str, where: Where, evidence: Evidence) -> RecognisedMistake | None:
    """Return that the file uses a name which only another file of the package defines."""
    match, package = re.search(NAME_ERROR, error), evidence.assignment.folder
    raising = read_module(partial(data_of, evidence), where.file)
    if match is None or raising is None or bindings(raising, match["name"]):
        return None
    name, found = match["name"], []
    for file in names_in(evidence, package):
        path = f"{package}/{file}"
        module = read_module(partial(data_of, evidence), path) if file.endswith(".py") else None
        if module is not None and path != where.file and _offers(module, name):
            found.append(module)
    known = {path for known in own_imports(raising) for path in known.paths if not known.name}
    if len(found) != 1 or found[0].path in known:
        return None
    here = tuple(module_name(where.file).split("."))
    if any(i.parts[: len(here)] == here for i in own_imports(found[0])):
        return None  # (the two files would import each other)
    statement = f"from {module_name(found[0].path)} import {name}"
    return RecognisedMistake(
        kind="node.import_missing",
        params={"name": name, "statement": statement},
        words={"name": name, "path": found[0].path, "statement": statement},
        variant="own",
        where=where,
    )


def _is_bound(name: str, package: str, evidence: Evidence) -> bool:
    """Whether an import finds a name in a folder of the package, or whether this is not certain."""
    folder = package.replace(".", "/")
    if evidence.submission.file(f"{folder}.py") is not None:
        return True  # (it is no folder)
    if any(file.path.startswith(f"{folder}/{name}/") for file in evidence.submission.files):
        return True
    module = read_module(partial(data_of, evidence), f"{folder}/__init__.py")
    if module is None:
        return False
    given = [i for i in own_imports(module) if i.bound == name and module.path not in i.paths]
    files = [path for i in given for path in i.paths]
    return name in _defined_in(module) or any(map(evidence.submission.file, files))


def _not_handed_in(error: str, where: Where, evidence: Evidence) -> RecognisedMistake | None:
    """Return that the code imports a module of its own package that the package does not have."""
    package = evidence.assignment.folder
    match = re.search(rf"No module named '({re.escape(package)}(?:\.\w{{1,120}}){{1,9}})'", error)
    part = re.search(
        r"cannot import name '(\w{1,120})' from (?:partially initialized module )?"
        rf"'({re.escape(package)}(?:\.\w{{1,120}}){{0,9}})'",
        error,
    )
    if match is None and (part is None or _is_bound(part[1], part[2], evidence)):
        return None
    named = match[1] if match is not None else f"{part[2]}.{part[1]}" if part is not None else ""
    path = named.replace(".", "/")
    submission = evidence.submission
    if any(submission.file(found) for found in (path, f"{path}.py")):
        return None
    if submission.file(f"{path.rpartition('/')[0]}.py") is not None:
        return None  # (what is above it is a file, and no folder)
    folder, _, name = path.rpartition("/")
    modules = [n.removesuffix(".py") for n in names_in(evidence, folder) if n.endswith(".py")]
    close = nearest(name, [m for m in modules if m.isidentifier()], cutoff=0.75)
    elsewhere = [f.path for f in submission.files if f.path.rpartition("/")[2] == f"{name}.py"]
    there = shown(elsewhere[0]) if elsewhere else ""
    init = "init" if _is_init(where) else ""
    return RecognisedMistake(
        kind="node.own_module_missing",
        params={"name": name, "close": close, "written": close} if close else {"name": name},
        words={"path": f"{path}.py", "there": there, "close": shown(close), "file": where.file},
        variant="close" if close else "elsewhere" if there else init,
        where=where,
    )


def _is_init(where: Where) -> bool:
    return where.file.endswith("/__init__.py")


def _not_in_file(error: str, where: Where, evidence: Evidence) -> RecognisedMistake | None:
    """Return that a file of the own package does not define a name that the code imports."""
    match = OF_FILE.search(error)
    if match is None or match["module"].partition(".")[0] != evidence.assignment.folder:
        return None
    path, name = f"{match['module'].replace('.', '/')}.py", match["name"]
    module = read_module(partial(data_of, evidence), path)
    if module is None:
        return None
    close = nearest(name, _defined_in(module), cutoff=0.6)
    return RecognisedMistake(
        kind="node.import_name",
        params={"name": name, "close": close} if close else {"name": name},
        words={"name": name, "close": close, "path": path, "file": where.file},
        variant="own_close" if close else "own_init" if _is_init(where) else "own",
        where=where,
    )
