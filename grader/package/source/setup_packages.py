"""The packages that a setup.py installs: what is to be written, if it does not install the node's."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.base.nearest import nearest
from grader.package.edit.text import Splice
from grader.package.source.module import Module, parse_module
from grader.package.source.names import dotted
from grader.package.source.python import PythonFault, can_parse
from grader.package.source.setup_py import is_setup_call
from grader.package.source.values import Evaluator, Listing, Text

FINDERS = ("find_packages", "find_namespace_packages")


@dataclass(frozen=True)
class Packages:
    """The argument `packages` as it should be, its line, and the import that it needs, if any.

    `fixed` is the file after the change; None if no change is certain. `is_there` is whether the
    source says it already.
    """

    wanted: str
    line: int | None
    statement: str = ""
    fixed: bytes | None = None
    is_there: bool = False


def setup_call(module: Module) -> ast.Call | None:
    """Return the call of setup(), if there is exactly one."""
    calls = [n for n in module.nodes if isinstance(n, ast.Call) and is_setup_call(n)]
    return calls[0] if len(calls) == 1 else None


def parsed_setup(found: bytes) -> Module | None:
    """Return a setup.py; None if Python cannot read it."""
    try:
        return parse_module("setup.py", found)
    except (PythonFault, RecursionError, MemoryError):
        return None


def value_of(module: Module, node: ast.expr | None) -> object:
    """Return the value of a constant, in place or assigned once to a name; None if it is neither."""
    if isinstance(node, ast.Name):
        sets = [n for n in module.nodes if isinstance(n, ast.Assign)]
        found = [n.value for n in sets if node.id in [dotted(t) for t in n.targets]]
        node = found[0] if len(found) == 1 else None
    return node.value if isinstance(node, ast.Constant) else None


def packages_of(found: bytes, package: str, *, nested: bool) -> Packages:
    """Return what `packages` should be; `nested`: the package contains others."""
    module = parsed_setup(found)
    q = "'" if module is None else module.text.quote
    finds = f"packages=find_packages(exclude=[{q}test{q}])"
    imports = "from setuptools import find_packages"
    if module is None:
        return Packages(finds, None, imports)
    call, known = setup_call(module), "find_packages" in module.imports
    keywords = call.keywords if call is not None else []
    names = [k.arg or "" for k in keywords if k.arg != "package_data"]
    close = nearest("packages", names, cutoff=0.75)
    keyword = next((k for k in keywords if k.arg == "packages"), None)
    keyword = keyword or next((k for k in keywords if close and k.arg == close), None)
    named = value_of(module, ast.Name("package_name", ast.Load())) == package
    name = "package_name" if named else f"{q}{package}{q}"
    wanted = finds if known or nested else f"packages=[{name}]"
    statement = imports if nested and not known else ""
    line = keyword.value.lineno if keyword else call.lineno if call else None
    code = module.text.code(keyword) if keyword is not None else ""
    is_there = keyword is not None and package in _named(module, keyword.value)
    is_there = code == wanted or (is_there and code.startswith("packages"))
    fixed = _fixed(module, call, keyword, wanted, statement) if code != wanted else None
    return Packages(wanted, line, statement, fixed, is_there)


def _named(module: Module, node: ast.expr) -> list[str]:
    """Return the names in a list of packages, as far as they are known."""
    value = Evaluator(module.tree, module.text.text).value(node)
    items = value.items if isinstance(value, Listing) else ()
    return [item.value for item in items if isinstance(item, Text)]


def _fixed(
    module: Module, call: ast.Call | None, old: ast.keyword | None, wanted: str, statement: str
) -> bytes | None:
    keywords = call.keywords if call is not None else []
    if call is None or not module.exact or any(k.arg in (None, "package_dir") for k in keywords):
        return None
    if old is not None:
        splices = [module.text.swap(old, wanted)]
    elif keywords:
        at = module.text.span(keywords[0])[0]
        first = module.text.line(keywords[0].lineno)
        own = not first[: keywords[0].col_offset].strip()
        gap = module.text.newline + first[: keywords[0].col_offset] if own else " "
        splices = [Splice(at, at, f"{wanted},{gap}")]
    else:
        return None
    if statement:
        splices.append(module.text.before(1, statement))
    new = module.text.spliced(splices)
    return new if new is not None and can_parse(new) else None
