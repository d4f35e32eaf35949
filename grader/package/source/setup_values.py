"""The values of setup() that setuptools refuses, as far as the source shows them."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from grader.package.source.module import Module
from grader.package.source.names import dotted
from grader.package.source.setup_packages import resolved
from grader.package.source.values import Evaluator, Listing, Table, Text, Value

VERSION = re.compile(
    r"\s*v?(?:\d+!)?\d+(?:\.\d+)*(?:[-_.]?(?:alpha|a|beta|b|preview|pre|c|rc)[-_.]?\d*)?"
    r"(?:-\d+|[-_.]?(?:post|rev|r)[-_.]?\d*)?(?:[-_.]?dev[-_.]?\d*)?"
    r"(?:\+[a-z0-9]+(?:[-_.][a-z0-9]+)*)?\s*",
    re.IGNORECASE,
)
"""The form of a version (PEP 440)."""
CONDITION = re.compile(r"\s*(?:===|==|~=|!=|<=|>=|<|>)\s*[\w.*+!-]+\s*")
REQUIREMENT = re.compile(
    r"\s*[A-Za-z0-9](?:[\w.-]*[A-Za-z0-9])?\s*(?:\[[\w\s,.-]*\])?\s*"
    r"(?:@.*|\(?\s*(?:(?:===|==|~=|!=|<=|>=|<|>)[^;]*)?\)?\s*(?:;.*)?)",
)
"""A requirement (PEP 508), told generously: only what does not match is refused for certain."""
LISTS = ("install_requires", "tests_require", "setup_requires")
BOOLEANS = ("zip_safe", "include_package_data")
DICTS = ("package_data", "extras_require", "package_dir", "exclude_package_data")
TEXTS = ("name", "license", "description", "long_description", "url", "python_requires")
SEQUENCES = ("packages", "data_files", "py_modules", "scripts", *LISTS)
NUMBERS = (int, float, complex)


@dataclass(frozen=True)
class RefusedValue:
    """An argument, the line and the text of its value, and which form it should have."""

    variant: str
    argument: str
    line: int
    found: str


@dataclass(frozen=True)
class _Given:
    module: Module
    argument: str
    node: ast.expr
    value: Value

    def refused(self, variant: str, text: Text | None = None) -> RefusedValue:
        found = text.value if text is not None else self.module.text.code(self.node)
        line = text.line if text is not None else self.node.lineno
        return RefusedValue(f"refused_{variant}", self.argument, line, found)


def refused_version(module: Module, call: ast.Call) -> RefusedValue | None:
    """Return the version, if setuptools refuses it."""
    return next((r for g in _given(module, call) if (r := _version(g)) is not None), None)


def path_object(module: Module, call: ast.Call) -> RefusedValue | None:
    """Return the argument of setup() that has an object of pathlib in it."""
    return _first(module, call, (_path,))


def refused_value(module: Module, call: ast.Call) -> RefusedValue | None:
    """Return the first argument whose value setuptools refuses; None if none is known."""
    looks = (_condition, _requirements, _boolean, _dict)
    return _first(module, call, looks)


def wrong_form(module: Module, call: ast.Call) -> RefusedValue | None:
    """Return the first argument whose value has another form than setuptools can use."""
    looks = (_text, _sequence, _dict, _pairs)
    return _first(module, call, looks)


def _first(
    module: Module, call: ast.Call, looks: tuple[Callable[[_Given], RefusedValue | None], ...]
) -> RefusedValue | None:
    found = (look(given) for given in _given(module, call) for look in looks)
    return next((one for one in found if one is not None), None)


def _given(module: Module, call: ast.Call) -> Iterator[_Given]:
    evaluator = Evaluator(module.tree, module.text.text)
    for keyword in call.keywords:
        if keyword.arg is not None:
            node = resolved(module, keyword.value)
            yield _Given(module, keyword.arg, node, evaluator.value(keyword.value))


def _version(given: _Given) -> RefusedValue | None:
    if given.argument != "version":
        return None
    if isinstance(given.value, Text):
        accepted = VERSION.fullmatch(given.value.value)
        return None if accepted else given.refused("version", given.value)
    is_list = isinstance(given.node, ast.List | ast.Tuple | ast.Dict)
    return given.refused("version") if is_list else None


def _condition(given: _Given) -> RefusedValue | None:
    """A python_requires such as 'three'."""
    if given.argument != "python_requires":
        return None
    if isinstance(given.value, Text):
        parts = [part for part in given.value.value.split(",") if part.strip()]
        accepted = all(CONDITION.fullmatch(part) for part in parts)
        return None if accepted else given.refused("condition", given.value)
    return given.refused("condition") if _is_number(given.node) else None


def _requirements(given: _Given) -> RefusedValue | None:
    if given.argument not in LISTS:
        return None
    if _is_number(given.node):
        return given.refused("list")
    value = given.value
    items = value.items if isinstance(value, Listing) else (value,)
    for item in items:
        rows = item.value.splitlines() if isinstance(item, Text) else []
        for row in rows:
            plain = re.split(r"(?:^|\s)#", row, maxsplit=1)[0]
            if plain.strip() and not REQUIREMENT.fullmatch(plain) and isinstance(item, Text):
                return given.refused("requirement", Text(row.strip(), item.line))
    return None


def _boolean(given: _Given) -> RefusedValue | None:
    if given.argument not in BOOLEANS or not isinstance(given.value, Text):
        return None
    return given.refused("boolean", given.value)


def _dict(given: _Given) -> RefusedValue | None:
    if given.argument not in DICTS:
        return None
    other = isinstance(given.node, ast.List | ast.Tuple | ast.Set | ast.Constant)
    none = isinstance(given.node, ast.Constant) and given.node.value is None
    return given.refused("dict") if other and not none else None


def _text(given: _Given) -> RefusedValue | None:
    other = isinstance(given.node, ast.List | ast.Tuple | ast.Dict | ast.Set)
    if given.argument in TEXTS and (other or _is_number(given.node)):
        return given.refused("text")
    return None


def _sequence(given: _Given) -> RefusedValue | None:
    if given.argument not in SEQUENCES or isinstance(given.value, Table):
        return given.refused("list") if given.argument in SEQUENCES else None
    is_text = isinstance(given.value, Text) and given.argument not in LISTS
    return given.refused("list") if is_text or _is_number(given.node) else None


def _pairs(given: _Given) -> RefusedValue | None:
    """A line of `data_files` that is not a folder and its files."""
    if given.argument != "data_files" or not isinstance(given.node, ast.List | ast.Tuple):
        return None
    for item in given.node.elts:
        if isinstance(item, ast.Tuple | ast.List) and len(item.elts) != 2:
            code = given.module.text.code(item)
            starred = any(isinstance(part, ast.Starred) for part in item.elts)
            return (
                None if starred else RefusedValue("refused_pair", "data_files", item.lineno, code)
            )
    return None


def _path(given: _Given) -> RefusedValue | None:
    module = given.module
    made = {
        target.id
        for statement in module.tree.body
        if isinstance(statement, ast.Assign) and _makes_path(statement.value)
        for target in statement.targets
        if isinstance(target, ast.Name)
    }
    names = [n for n in ast.walk(given.node) if isinstance(n, ast.Name)]
    if _makes_path(given.node) or any(name.id in made for name in names):
        return RefusedValue(
            "path_object", given.argument, given.node.lineno, module.text.code(given.node)
        )
    return None


def _makes_path(node: ast.AST) -> bool:
    calls = (n for n in ast.walk(node) if isinstance(n, ast.Call))
    return any(dotted(call.func) in ("Path", "pathlib.Path") for call in calls)


def _is_number(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, NUMBERS)
