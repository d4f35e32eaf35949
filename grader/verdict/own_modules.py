"""An import of the student's own code that fails: how the package's own files are imported."""

from __future__ import annotations

import ast
import re
import shlex
import sys
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from grader.base.nearest import nearest
from grader.base.shown import shown
from grader.mistakes.entry_function import NO_FUNCTION
from grader.mistakes.imports import MODULES, OTHER_PACKAGES
from grader.mistakes.recognised import NAME_ERROR, RecognisedMistake
from grader.package.source.counter import targets_of
from grader.package.source.module import Function, Module
from grader.package.source.names import module_name
from grader.package.source.node import read_module
from grader.package.source.own_imports import imports_of, own_imports
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
        or _called_module(error, where, evidence)
        or _too_many_dots(error, where, evidence)
        or _name_of_python(error, where, evidence)
        or _part_of_file(error, where, evidence)
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


def _part_of_file(error: str, where: Where, evidence: Evidence) -> RecognisedMistake | None:
    """Return that an import names what a file defines as if it were a file of its own."""
    match = NO_MODULE.search(error)
    parent, _, name = match["name"].rpartition(".") if match is not None else ("", "", "")
    path = f"{parent.replace('.', '/')}.py"
    raising = read_module(partial(data_of, evidence), where.file)
    module = read_module(partial(data_of, evidence), path) if parent else None
    statement = statement_at(raising, where.line) if raising is not None else None
    if raising is None or module is None or f"'{parent}' is not a package" not in error:
        return None
    known, new = _defined_in(module), ""
    if isinstance(statement, ast.ImportFrom):
        above = (statement.module or "").rpartition(".")[0]
        if {alias.name for alias in statement.names} <= known:
            names = ", ".join(map(ast.unparse, statement.names))
            new = f"from {'.' * statement.level}{above} import {names}"
    elif isinstance(statement, ast.Import) and len(statement.names) == 1 and name in known:
        bound = statement.names[0].asname
        whole = any(
            isinstance(n, ast.Name) and n.id == parent.partition(".")[0] for n in raising.nodes
        )
        new = f"from {parent} import {name}{f' as {bound}' if bound else ''}"
        new = f"import {parent}" if whole and not bound else new
    if statement is None or not new:
        return None
    code = raising.text.code(statement)
    return RecognisedMistake(
        kind="node.own_module_alone",
        params={"name": code, "written": new},
        words={"name": shown(code), "written": shown(new), "path": path, "short": name},
        variant="part",
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
    if evidence.submission.file(f"{package}/{name}.py") is not None:
        return _file_as_name(name, raising, where, evidence)
    for file in names_in(evidence, package):
        path = f"{package}/{file}"
        module = read_module(partial(data_of, evidence), path) if file.endswith(".py") else None
        if module is not None and path != where.file and _offers(module, name):
            found.append(module)
    here = module_name(where.file)
    if len(found) != 1 or here in {
        part for n in found[0].imports for part in (n, f"{package}.{n}")
    }:
        return None
    if any(i.parts == tuple(here.split(".")) for i in own_imports(found[0])):
        return None  # (the two files would import each other)
    words = {"name": name, "path": found[0].path}
    for known in own_imports(raising):
        if not known.name and found[0].path in known.paths:
            return RecognisedMistake(
                kind="node.import_missing",
                params={"name": name, "written": f"{known.bound}.{name}"},
                words={**words, "written": f"{known.bound}.{name}", "statement": ""},
                variant="own_module",
                where=where,
            )
    statement = f"from {module_name(found[0].path)} import {name}"
    return RecognisedMistake(
        kind="node.import_missing",
        params={"name": name, "statement": statement},
        words={**words, "statement": statement},
        variant="own",
        where=where,
    )


def _file_as_name(
    name: str, raising: Module, where: Where, evidence: Evidence
) -> RecognisedMistake | None:
    """Return that a file of the package is named, which no import binds by its own name."""
    package = evidence.assignment.folder
    new, head = f"from {package} import {name}", package.partition(".")[0]
    if name in sys.stdlib_module_names or f"{package}/{name}.py" == where.file:
        return None
    for statement in raising.tree.body:
        if not isinstance(statement, ast.Import) or len(statement.names) != 1:
            continue
        whole = any(isinstance(n, ast.Name) and n.id == head for n in raising.nodes)
        if statement.names[0].name == f"{package}.{name}" and not whole:
            code = raising.text.code(statement)
            return RecognisedMistake(
                kind="node.own_module_alone",
                params={"name": code, "written": new},
                words={"short": f"{package}.{name}", "close": name},
                variant="whole",
                where=Where(file=where.file, line=statement.lineno),
            )
    return RecognisedMistake(
        kind="node.import_missing",
        params={"name": name, "statement": new},
        words={"name": name, "path": f"{package}/{name}.py", "statement": new},
        variant="file",
        where=where,
    )


def main_in_copy(error: str, evidence: Evidence) -> RecognisedMistake | None:
    """Return that another file has the entry function, and the node's file has no code of a node."""
    match, asked = re.match(NO_FUNCTION, error), evidence.assignment
    path = f"{asked.folder}/{asked.node_file}"
    module = read_module(partial(data_of, evidence), path)
    if match is None or match["function"] != asked.function or module is None:
        return None
    if module.classes or module.functions:
        return None
    found = []
    for file in evidence.submission.files:
        is_python = file.kind == "file" and file.path.endswith(".py")
        other = read_module(partial(data_of, evidence), file.path) if is_python else None
        if other is not None and file.path != path and asked.function in other.functions:
            found += [file.path] if other.uses_ros and other.classes else []
    if len(found) != 1:
        return None
    return RecognisedMistake(
        kind="node.main_missing",
        words={"function": asked.function, "made": "", "there": shown(found[0]), "path": path},
        variant="in_copy",
        where=Where(file=path),
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
    signs = _with_signs(name, folder, modules, where)
    if signs is not None:
        return signs
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


def _with_signs(
    name: str, folder: str, modules: list[str], where: Where
) -> RecognisedMistake | None:
    """Return that the file that is meant has a sign in its name with which it cannot be imported."""
    unfit = {m: re.sub(r"\W", "_", m) for m in modules if not m.isidentifier()}
    same = [m for m, new in unfit.items() if new == name or m.partition(".")[0] == name]
    near = same[0] if len(same) == 1 else nearest(name, unfit, cutoff=0.75)
    new = unfit.get(near, "")
    if not near or not new.isidentifier() or new in modules:
        return None
    there, path = f"{folder}/{near}.py", f"{folder}/{new}.py"
    return RecognisedMistake(
        kind="node.own_module_missing",
        params={"name": name},
        words={
            "there": shlex.quote(shown(there)),
            "path": path,
            "short": shown(f"{near}.py"),
            "wanted": new,
        },
        variant="signs" if new == name else "signs_named",
        where=where,
    )


def _too_many_dots(error: str, where: Where, evidence: Evidence) -> RecognisedMistake | None:
    """Return that an import has more dots in front than there are folders of the package above."""
    raising = read_module(partial(data_of, evidence), where.file)
    found = statement_at(raising, where.line) if raising is not None else None
    if "beyond top-level package" not in error or not isinstance(found, ast.ImportFrom):
        return None
    folder = where.file.rpartition("/")[0]
    path = f"{folder}/{(found.module or '').replace('.', '/')}.py"
    module = read_module(partial(data_of, evidence), path) if found.module else None
    if raising is None or module is None or not {n.name for n in found.names} <= module.names:
        return None
    code = raising.text.code(found)
    new = f"from .{found.module} import {', '.join(map(ast.unparse, found.names))}"
    return RecognisedMistake(
        kind="node.own_module_alone",
        params={"name": code, "written": new},
        words={"path": path},
        variant="dots",
        where=where,
    )


def _name_of_python(error: str, where: Where, evidence: Evidence) -> RecognisedMistake | None:
    """Return that an import finds a module of Python with the name of a file of the package."""
    match, written = NO_NAME.search(error), _import_at(where, evidence)
    if match is None or written is None or match["module"] not in sys.stdlib_module_names:
        return None
    path = f"{where.file.rpartition('/')[0]}/{match['module']}.py"
    here = written.module == match["module"] and path != where.file
    if not here or not _defines(path, written, evidence):
        return None
    new = written.of(module_name(path))
    return RecognisedMistake(
        kind="node.own_module_alone",
        params={"name": written.code, "written": new},
        words={"path": path, "short": match["module"]},
        variant="of_python",
        where=where,
    )


def _called_module(error: str, where: Where, evidence: Evidence) -> RecognisedMistake | None:
    """Return that the code calls a module by the name of a class or function that is in it."""
    raising = read_module(partial(data_of, evidence), where.file)
    statement = statement_at(raising, where.line) if raising is not None else None
    if "'module' object is not callable" not in error or raising is None or statement is None:
        return None
    calls = [n.func for n in ast.walk(statement) if isinstance(n, ast.Call)]
    called = {function.id for function in calls if isinstance(function, ast.Name)}
    for node in raising.tree.body:
        if not isinstance(node, ast.ImportFrom) or len(node.names) != 1:
            continue
        name = node.names[0].name
        modules = [i for i in imports_of(node, where.file) if not i.name and i.bound in called]
        for found in modules:
            module = read_module(partial(data_of, evidence), found.paths[0])
            if module is not None and name in _defined_in(module):
                code, dots = raising.text.code(node), "." * node.level
                above = f"{dots}{node.module or ''}"
                inner = f"{above}{name}" if above == dots else f"{above}.{name}"
                new = f"from {inner} import {ast.unparse(node.names[0])}"
                words = {"name": code, "written": new, "path": module.path, "short": name}
                return RecognisedMistake(
                    kind="node.own_module_alone",
                    params={"name": code, "written": new},
                    words=words,
                    variant="called",
                    where=Where(file=where.file, line=node.lineno),
                )
    return None


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
