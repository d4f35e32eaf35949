"""Automatic mutants of setup.py: its keywords, its data files, its entry point.

Each function yields (name, new source, checks), and one of these checks must fail.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

from grader.base.errors import AssignmentError
from grader.course.assignment import Assignment
from grader.validate.in_source import Made
from grader.validate.spots import Code, misspelt
from grader.verdict.checks.all import FAMILIES

ANY = FAMILIES
ENTRY = ("entry_point.mapping", "build.colcon")
# the other arguments of setup() are descriptive and do not affect the build
DECISIVE = ("name", "packages", "data_files", "entry_points")


def mutants_of(code: Code, assignment: Assignment) -> Iterator[Made]:
    """Yield every mutant of setup.py."""
    yield from _keywords(code)
    yield from _elements(code)
    yield from _commas(code)
    yield from _names(code)
    yield from _entry(code, assignment)
    yield from _calls(code)


def _setup(code: Code) -> ast.Call:
    for node in code.walk():
        if isinstance(node, ast.Call) and code.of(node.func).endswith("setup"):
            return node
    raise AssignmentError("the solution's setup.py does not call setup()")


def _decisive(code: Code) -> Iterator[ast.AST]:
    """Yield the nodes of the values of the keywords in DECISIVE."""
    for keyword in _setup(code).keywords:
        if keyword.arg in DECISIVE:
            yield from ast.walk(keyword.value)


def _keywords(code: Code) -> Iterator[Made]:
    """Drop a keyword, or misspell it."""
    for keyword in _setup(code).keywords:
        if keyword.arg in DECISIVE:
            text = code.put(keyword, "")
            gone = "\n".join(line for line in text.split("\n") if line.strip() != ",")
            yield f"setup.py without {keyword.arg}", gone, ANY
            new = f"{misspelt(keyword.arg)}={code.of(keyword.value)}"
            yield f"setup.py misspells {keyword.arg}", code.put(keyword, new), ANY


def _elements(code: Code) -> Iterator[Made]:
    """Drop an element of a list: a data file, an entry."""
    for node in _decisive(code):
        if isinstance(node, ast.List):
            for element in node.elts:
                rest = ", ".join(code.of(other) for other in node.elts if other is not element)
                name = f"setup.py list without {code.shown(element)}"
                yield name, code.put(node, f"[{rest}]"), ANY


def _commas(code: Code) -> Iterator[Made]:
    """Leave out the comma after a keyword (one on a single line, one on several)."""
    lines = code.text.split("\n")
    keywords = [k for k in _setup(code).keywords if k.arg in ("name", "data_files")]
    for keyword in keywords:
        end = (keyword.end_lineno or 0) - 1
        changed = lines[end].rstrip().removesuffix(",")
        text = "\n".join([*lines[:end], changed, *lines[end + 1 :]])
        yield f"setup.py no comma after {keyword.arg}", text, ("build.colcon",)


def _names(code: Code) -> Iterator[Made]:
    """Misspell the strings that hold names and paths."""
    names = [node for node in code.tree.body if isinstance(node, ast.Assign)]
    for node in [*(node.value for node in names), *_decisive(code)]:
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and len(node.value) > 3:
            if " = " in node.value or id(node) in code.docstrings:
                continue
            new = repr(misspelt(node.value))
            yield f"setup.py misspells {node.value!r}", code.put(node, new), ANY


def _entry(code: Code, assignment: Assignment) -> Iterator[Made]:
    name, target = assignment.executable, assignment.target
    module, _, function = target.partition(":")
    file = module.rpartition(".")[2]
    for node in ast.walk(_setup(code)):
        if not (isinstance(node, ast.Constant) and isinstance(node.value, str)):
            continue
        if target not in node.value:
            continue
        for label, new in {
            "name lost": f"= {target}",
            "name and sign lost": target,
            "target lost": f"{name} =",
            "sides swapped": f"{target} = {name}",
            "file as name": f"{file} = {target}",
            "node as name": f"{assignment.node_name}.py = {target}",
            "capital name": f"{name.capitalize()} = {target}",
            "dash in name": f"{name.replace('_', '-')} = {target}",
            "blank in name": f"{name.replace('_', ' ')} = {target}",
            "letter lost in name": f"{name[:-1]} = {target}",
            "letter added to name": f"{name}s = {target}",
            "colon for equals": f"{name}: {target}",
            "two equals": f"{name} == {target}",
            "arrow for equals": f"{name} -> {target}",
            "two colons": f"{name} = {module}::{function}",
            "dot for colon": f"{name} = {module}.{function}",
            "function lost": f"{name} = {module}",
            "function lost after colon": f"{name} = {module}:",
            "brackets": f"{name} = {target}()",
            "function is the class": f"{name} = {module}:Main",
            "function misspelt": f"{name} = {module}:{function[:-1]}",
            "py in module": f"{name} = {module}.py:{function}",
            "slash for dot": f"{name} = {module.replace('.', '/')}:{function}",
            "dash in module": f"{name} = {module.replace('_', '-')}:{function}",
            "package lost": f"{name} = {file}:{function}",
            "package doubled": f"{name} = {module.partition('.')[0]}.{target}",
            "package only": f"{name} = {module.partition('.')[0]}:{function}",
            "module misspelt": f"{name} = {misspelt(module)}:{function}",
            "module capital": f"{name} = {module.partition('.')[0]}.{file.title()}:{function}",
            "blank in target": f"{name} = {module} :{function} x",
            "quote in entry": f"'{name} = {target}'",
        }.items():
            yield f"entry {label}", code.put(node, repr(new)), ENTRY
        yield "entry unquoted", code.put(node, node.value), ("build.colcon", *ENTRY)
        yield "entry quote lost", code.put(node, code.of(node)[:-1]), ("build.colcon", *ENTRY)
        second = f"{code.of(node)}\n'other = {target}'"
        yield "entry without comma", code.put(node, second), ENTRY


def _calls(code: Code) -> Iterator[Made]:
    call = _setup(code)
    yield "setup.py does not call setup", code.put(call.func, "dict"), ANY
    yield "setup.py no bracket at the end", code.put(call, code.of(call)[:-1]), ("build.colcon",)
    for line in ("print('hello')", "import numpi", "raise SystemExit(1)"):
        yield f"setup.py {line}", code.put(call, f"{line}\n{code.of(call)}"), ("build.colcon",)
