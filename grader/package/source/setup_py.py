"""setup.py: the arguments of setup(), read without running the file."""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass
from itertools import pairwise

from grader.base.i18n.message import say
from grader.package.source.kept import keep_small
from grader.package.source.module import parse_module
from grader.package.source.names import dotted
from grader.package.source.python import PythonFault, PythonFile, parse_python
from grader.package.source.values import Computed, Evaluator, Table, Text, Value

INDEX = "share/ament_index/resource_index/packages"
"""The folder into which `data_files` installs the package's marker."""

MOST_COMMENTS = 200
EMPTY = re.compile(r"[ \t]{0,80}(['\"])console_scripts\1 ?: ?\[[ \t]{0,20}\],?[ \t]*")
"""A list of executables that is closed on its own line, and is empty."""
ENTRY = re.compile(r"[ \t]{0,80}(['\"])[\w.-]{1,80} ?= ?[\w.]{1,200}:\w{1,80}\1,?[ \t]*")
IMPORTS = {
    "os": "import os",
    "glob": "from glob import glob",
    "sys": "import sys",
    "setup": "from setuptools import setup",
    "find_packages": "from setuptools import find_packages",
}
"""Imports that a setup.py often lacks, by the name that is then not defined."""


@dataclass(frozen=True)
class SetupPy:
    """The arguments of the one call of setup().

    `is_static` is False if the arguments are known only by running the file.
    `line` is the line of the call, `comments` the comment lines (number, text).
    """

    arguments: Table
    is_static: bool
    line: int | None
    comments: tuple[tuple[int, str], ...] = ()

    def argument(self, name: str) -> Value | None:
        """Return an argument's value; None if it is not given, Computed if it is unknown."""
        if not self.is_static:
            return Computed(self.line or 1)
        found = self.arguments.get(name)
        if found is None and not self.arguments.complete:
            return Computed(self.line or 1)  # setup(**settings) may contain it
        return found

    @property
    def name(self) -> Text | None:
        """The package's name, if it is known."""
        found = self.argument("name")
        return found if isinstance(found, Text) else None


@keep_small
def read_setup_py(found: bytes) -> SetupPy:
    """Read a setup.py; PythonFault if Python cannot read it."""
    file = parse_python(found)
    try:
        return _arguments(file)
    except RecursionError:
        raise PythonFault("syntax", say("too deeply nested to be read")) from None


def _arguments(file: PythonFile) -> SetupPy:
    calls = [node for node in ast.walk(file.tree) if is_setup_call(node)]
    comments = tuple(
        (number, line.strip().lstrip("# "))
        for number, line in enumerate(file.text.splitlines(), start=1)
        if line.strip().startswith("#")
    )[:MOST_COMMENTS]
    nothing = Table((), 1)
    if not calls or not isinstance(calls[0], ast.Call):
        return SetupPy(nothing, is_static=False, line=None, comments=comments)
    call = calls[0]
    plain = len(calls) == 1 and call in _always_run(file.tree) and not _defines_setup(file.tree)
    if not plain or call.args:
        return SetupPy(nothing, is_static=False, line=call.lineno, comments=comments)
    evaluator = Evaluator(file.tree, file.text)
    pairs: list[tuple[Value, Value]] = []
    for keyword in call.keywords:
        value = evaluator.value(keyword.value)
        if keyword.arg is not None:
            pairs.append((Text(keyword.arg, keyword.value.lineno), value))
        elif isinstance(value, Table):
            pairs.extend(value.pairs)
        else:
            pairs.append((Computed(keyword.value.lineno), value))
    table = Table(tuple(pairs), call.lineno)
    return SetupPy(table, is_static=True, line=call.lineno, comments=comments)


def literal_name(found: bytes) -> str | None:
    """Return the package's name in a setup.py, or None if it is unknown."""
    try:
        name = read_setup_py(found).name
    except PythonFault:
        return None
    return name.value if name else None


def is_setup_call(node: ast.AST) -> bool:
    """Whether this calls a function named setup, of any module."""
    if not isinstance(node, ast.Call):
        return False
    function = node.func
    if isinstance(function, ast.Attribute):
        return function.attr == "setup"
    return isinstance(function, ast.Name) and function.id == "setup"


def _always_run(tree: ast.Module) -> list[ast.expr]:
    """Return the expression statements of the module and of its `__main__` guard."""
    body: list[ast.stmt] = list(tree.body)
    for statement in tree.body:
        if isinstance(statement, ast.If) and "__name__" in ast.dump(statement.test):
            body += statement.body
    return [statement.value for statement in body if isinstance(statement, ast.Expr)]


def _defines_setup(tree: ast.Module) -> bool:
    """Whether the file defines its own `setup`, about which nothing is known."""
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and node.name == "setup":
            return True
        if isinstance(node, ast.Name) and node.id == "setup" and not _is_read(node):
            return True
    return False


def _is_read(node: ast.Name) -> bool:
    return isinstance(node.ctx, ast.Load)


def called_value(found: bytes) -> ast.expr | None:
    """Return the first tuple, list or string of a file that is called: a comma is missing."""
    try:
        tree = parse_python(found).tree
    except PythonFault:
        return None
    calls = [n for n in ast.walk(tree) if isinstance(n, ast.Call)]
    values = [c.func for c in calls if isinstance(c.func, ast.Tuple | ast.List | ast.Constant)]
    return min(values, key=lambda n: (n.lineno, n.col_offset), default=None)


@dataclass(frozen=True)
class OutsideEntry:
    """An entry of console_scripts below the end of its list, and the line with that end."""

    line: int
    above: int


def entry_outside(found: bytes) -> OutsideEntry | None:
    """Return the entry of a file that Python cannot read, if it is below the end of its list."""
    rows = found.decode("utf-8", "replace").splitlines()
    filled = [number for number, row in enumerate(rows, 1) if row.strip()]
    for above, line in pairwise(filled):
        closed = rows[above - 1].strip() in ("]", "],") or EMPTY.fullmatch(rows[above - 1])
        if closed and ENTRY.fullmatch(rows[line - 1]):
            return OutsideEntry(line, above)
    return None


def missing_imports(found: bytes, error: str) -> list[str]:
    """Return the imports that the file lacks, if that is why it stops with an error."""
    match = re.search(r"NameError: name '(\w{1,80})' is not defined", error)
    try:
        module = parse_module("setup.py", found)
    except (PythonFault, RecursionError, MemoryError):
        return []
    if match is None or match[1] not in IMPORTS:
        return []
    used = {n.id for n in module.nodes if isinstance(n, ast.Name)} - module.names
    whole = any(dotted(n) == "glob.glob" for n in module.nodes)
    known = {**IMPORTS, "glob": "import glob"} if whole else IMPORTS
    return [statement for name, statement in known.items() if name in used]
