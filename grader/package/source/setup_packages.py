"""The packages that a setup.py installs: what is to be written, if it does not install the node's."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from dataclasses import dataclass, field

from grader.base.nearest import nearest
from grader.package.edit.text import Splice
from grader.package.source.module import Module, parse_module
from grader.package.source.python import PythonFault, can_parse
from grader.package.source.setup_py import is_setup_call
from grader.package.source.values import Evaluator, Listing, Text

FINDERS = ("find_packages", "find_namespace_packages")


@dataclass(frozen=True)
class Packages:
    """The argument `packages` as it should be, its line, and the import that it needs, if any.

    `is_text` is whether it is a text: setuptools takes each of its letters for a folder.
    `misspelt` is the argument that was meant. `fixed` is the file after the change; None if no
    change is certain. `is_there` is whether the source says it already, `extra` the line of the
    other names in the list, by the name. `is_moved`: something else can change the folders.
    `variable` is the name that both `name` and `packages` get, if code works out its value: then
    `wanted` is its assignment.
    """

    wanted: str
    line: int | None
    statement: str = ""
    is_text: bool = False
    fixed: bytes | None = None
    misspelt: str = ""
    is_there: bool = False
    extra: Mapping[str, int] = field(default_factory=dict)
    is_moved: bool = False
    variable: str = ""


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
    node = resolved(module, node) if node is not None else None
    return node.value if isinstance(node, ast.Constant) else None


def resolved(module: Module, node: ast.expr) -> ast.expr:
    """Return the value of a name that is assigned once; any other expression itself."""
    if not isinstance(node, ast.Name):
        return node
    stores = [
        n
        for n in module.nodes
        if isinstance(n, ast.Assign)
        and any(isinstance(t, ast.Name) and t.id == node.id for t in n.targets)
    ]
    return stores[0].value if len(stores) == 1 else node


def packages_of(found: bytes, package: str, *, nested: bool) -> Packages:
    """Return what `packages` should be; `nested`: the package contains others."""
    module = parsed_setup(found)
    q = "'" if module is None else module.text.quote
    finds = f"packages=find_packages(exclude=[{q}test{q}])"
    imports = "from setuptools import find_packages"
    if module is None:
        return Packages(finds, None, imports)
    keyword = next((k for k in _keywords(module) if k.arg == "packages"), None)
    if keyword is None and (meant := _meant(module)) is not None:
        start = module.text.span(meant)[0]
        name = meant.arg or ""
        new = module.text.spliced([Splice(start, start + len(name), "packages")])
        given = f"packages={module.text.code(meant.value)}"
        return Packages(given, meant.value.lineno, fixed=new, misspelt=name)
    made = _made_name(module, package)
    if made is not None:
        return made
    call, known = setup_call(module), "find_packages" in module.imports
    named = value_of(module, ast.Name("package_name", ast.Load())) == package
    name = "package_name" if named else f"{q}{package}{q}"
    wanted = finds if known or nested else f"packages=[{name}]"
    statement = imports if nested and not known else ""
    line = keyword.value.lineno if keyword else call.lineno if call else None
    is_text = isinstance(value_of(module, keyword.value), str) if keyword else False
    items = {} if keyword is None else _named(module, keyword.value)
    same = keyword is not None and wanted == f"packages={module.text.code(keyword.value)}"
    is_there = same or package in items
    changes = not is_there or len(items) == 2  # (the other one is deleted)
    fixed = _fixed(module, call, keyword, wanted, statement) if changes else None
    return Packages(
        wanted, line, statement, is_text, fixed, is_there=is_there,
        extra={name: at for name, at in items.items() if name != package},
        is_moved=any(k.arg in (None, "package_dir") for k in _keywords(module)),
    )  # fmt: skip


def _made_name(module: Module, package: str) -> Packages | None:
    """Return what to assign, if name and packages get one variable whose value code works out."""
    given = {keyword.arg: keyword.value for keyword in _keywords(module)}
    name, packages = given.get("name"), given.get("packages")
    items = packages.elts if isinstance(packages, ast.List | ast.Tuple) else []
    if not isinstance(name, ast.Name) or len(items) != 1:
        return None
    same = isinstance(items[0], ast.Name) and items[0].id == name.id
    value = resolved(module, name)
    known = isinstance(Evaluator(module.tree, module.text.text).value(value), Text)
    plain = [s for s in module.tree.body if isinstance(s, ast.Assign) and s.value is value]
    if not same or known or not plain:
        return None
    code = f"{module.text.quote}{package}{module.text.quote}"
    new = module.text.spliced([module.text.swap(value, code)]) if module.exact else None
    fixed = new if new is not None and can_parse(new) else None
    return Packages(f"{name.id} = {code}", value.lineno, fixed=fixed, variable=name.id)


def _named(module: Module, node: ast.expr) -> dict[str, int]:
    """Return the names in a list of packages and their lines, as far as they are known."""
    value = Evaluator(module.tree, module.text.text).value(node)
    items = value.items if isinstance(value, Listing) else ()
    return {item.value: item.line for item in items if isinstance(item, Text)}


def _meant(module: Module) -> ast.keyword | None:
    """Return the argument of setup() whose name is nearly packages."""
    names = [k.arg or "" for k in _keywords(module)]
    close = nearest("packages", [n for n in names if n != "package_data"], cutoff=0.75)
    return next((k for k in _keywords(module) if close and k.arg == close), None)


def _keywords(module: Module) -> list[ast.keyword]:
    call = setup_call(module)
    return call.keywords if call is not None else []


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
