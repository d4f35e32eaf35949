"""Two files of the package that import each other."""

from __future__ import annotations

import re
from functools import partial
from typing import TYPE_CHECKING

from grader.mistakes.recognised import RecognisedMistake
from grader.package.source.counter import targets_of
from grader.package.source.module import Function, Module
from grader.package.source.node import read_module
from grader.package.source.own_imports import imports_of
from grader.report.model import Where
from grader.verdict.checks.parsed import data_of

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

UNFINISHED = re.compile(
    r"cannot import name '(?P<name>\w{1,120})' from partially initialized module "
    r"'(?P<module>[\w.]{1,200})'"
    r"|partially initialized module '(?P<of>[\w.]{1,200})'"
    # Python 3.13 names the file as well
    r"(?: from '[^']{1,500}')? has no attribute '(?P<attribute>\w{1,120})'"
)


def circular_import(
    error: str, where: Where | None, evidence: Evidence
) -> RecognisedMistake | None:
    """Return that a file imports from one that imports it; None if this is not the error."""
    match = UNFINISHED.search(error)
    if match is None or where is None or where.line is None:
        return None
    name, module = match["name"] or match["attribute"], match["module"] or match["of"]
    place = module.replace(".", "/")
    first = None
    for candidate in (f"{place}.py", f"{place}/__init__.py"):
        first = first or read_module(partial(data_of, evidence), candidate)
    if first is None or first.path == where.file:
        return None
    path = first.path
    line = _line_of_import(first, where.file)
    if line is None:
        return None
    values: dict[str, str | int] = {"name": name, "path": path, "line": line}
    return RecognisedMistake(
        kind="node.circular_import",
        params=values,
        words={**values, "there": where.file},
        variant=_variant(first, name),
        where=where,
    )


def _line_of_import(module: Module, path: str) -> int | None:
    """Return the line at which a file imports another one, as it is imported itself."""
    for statement in module.tree.body:
        if any(path in found.paths for found in imports_of(statement, module.path)):
            return statement.lineno
    return None


def _variant(module: Module, name: str) -> str:
    if module.path.endswith("/__init__.py"):
        return "init"
    return "" if _is_plain(module, name) else "third"


def _is_plain(module: Module, name: str) -> bool:
    """Whether a name is a value or a function of the file, which can be moved to another one."""
    for statement in module.tree.body:
        if isinstance(statement, Function) and statement.name == name and name != "main":
            return True
        if name in targets_of(statement):
            return True
    return False
