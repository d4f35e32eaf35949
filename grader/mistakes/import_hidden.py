"""Mistakes in which a variable takes the name of an import, a function or a class of its file."""

from __future__ import annotations

import ast
import datetime
import logging
import math
import os
import random
import re
import sys
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from types import MappingProxyType

from grader.base.i18n.message import msg
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.brackets import OF_FUNCTION
from grader.mistakes.example import NODE, example
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, on_line
from grader.package.edit.tree import Replace
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted
from grader.package.source.place import statement_at
from grader.package.source.scopes import Bound, bindings, scope_of, seen_from

UNBOUND = r"UnboundLocalError: .{0,60}'(?P<name>\w{1,120})'"
CALLED = r"TypeError: '\w{1,120}' object is not callable"
NO_ATTRIBUTE = r"AttributeError: '\w{1,120}' object has no attribute '(?P<attribute>\w{1,120})'"
OF_MODULES = MappingProxyType(
    {
        m.__name__: frozenset(dir(m))
        for m in (datetime, logging, math, os, random, sys, threading, time)
    }
    | {"rclpy": frozenset(("init", "spin", "spin_once", "ok", "shutdown", "try_shutdown"))}
)
"""What modules have that beginners import under their own names."""


@dataclass(frozen=True)
class _Taken:
    """A use of a name, the part that gives it its first meaning, and the one that takes it."""

    use: ast.Name
    first: Bound
    taker: Bound


def _unbound(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A function uses the name before the line at which it gives it a value."""
    uses = [use for use in _on_line(raised) if use.id == match["name"]]
    return _told(raised, uses)


def _called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line calls the name, which means a value now."""
    del match
    parents = raised.module.parents
    return _told(raised, [u for u in _on_line(raised) if getattr(parents.get(u), "func", 0) is u])


def _read(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line reads from the name what the module of this name has."""
    parents, attribute = raised.module.parents, match["attribute"]
    uses = [use for use in _on_line(raised) if attribute in OF_MODULES.get(use.id, ())]
    return _told(raised, [u for u in uses if getattr(parents.get(u), "attr", "") == attribute])


def _on_line(raised: Raised) -> Iterator[ast.Name]:
    """Yield the names that the statement of the error reads."""
    statement = statement_at(raised.module, raised.line)
    for part in ast.walk(statement) if statement is not None else ():
        if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Load):
            yield part


def _told(raised: Raised, uses: list[ast.Name]) -> RecognisedMistake | None:
    found = [taken for use in uses if (taken := _taken(raised.module, use)) is not None]
    if not found or len({taken.use.id for taken in found}) > 1:
        return None
    taken, module = found[0], raised.module
    if isinstance(taken.first.part, ast.ClassDef) and taken.taker.line == taken.use.lineno:
        return None  # (a class and its object: see which_node.py)
    at = taken.taker.part
    if not isinstance(at, ast.Name):
        return None
    words = {"line": str(taken.first.line), "row": str(taken.use.lineno)}
    words["written"] = shown(module.line(taken.first.line).strip())
    return raised.finding("name_reused", at=at, params={"name": at.id, **words})


def _taken(module: Module, use: ast.Name) -> _Taken | None:
    """Return what takes a name that the file imports or defines, if that is what a use sees."""
    bound = bindings(module, use.id)
    first = [b for b in bound if b.scope is None and _defines(b.part)]
    for scope in seen_from(module, scope_of(module, use)):
        here = [b for b in bound if b.scope is scope]
        if not here:
            continue
        takers = [b for b in here if isinstance(b.part, ast.Name)]
        if not first or not takers or len(takers) < len(here) - len(first) * (scope is None):
            return None
        late = scope is not None or takers[-1].line > first[-1].line
        return _Taken(use, first[-1], takers[0]) if late else None
    return None


def _defines(part: ast.AST) -> bool:
    return isinstance(part, ast.Import | ast.ImportFrom | Function | ast.ClassDef)


def _of_module(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The name is a function that has the name of its module: `from random import random`."""
    statement = statement_at(raised.module, raised.line)
    owners = [
        dotted(part.value)
        for part in (ast.walk(statement) if statement is not None else ())
        if isinstance(part, ast.Attribute) and part.attr == match["name"]
    ]
    for node in raised.module.nodes:
        if not isinstance(node, ast.ImportFrom) or node.module not in owners:
            continue
        if any((alias.asname or alias.name) == node.module for alias in node.names):
            params = {"name": node.module, "line": str(node.lineno), "attribute": match["name"]}
            found = raised.finding("function_of_module", params=params)
            plain = [a for n in raised.module.nodes if isinstance(n, ast.Import) for a in n.names]
            whole = any((a.asname or a.name) == node.module for a in plain)
            return replace(found, variant="both") if whole else found
    return None


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "function_of_module",
        "start",
        msg("A name is a function of a module, and not the module"),
        msg(
            "Line {line} imports the function {name} that is in the module {name}. {attribute} is in the "
            "module, which the file does not import."
        ),
        msg(
            "Write import {name} in line {line}. Then write {name}.{name} wherever the function {name} is "
            "called, and leave {name}.{attribute} as it is."
        ),
        links.PYTHON_MODULES,
        whys={
            "both": msg(
                "Line {line} imports the function {name} that is in the module {name}. From there on, the "
                "name {name} means the function. {attribute} is in the module."
            )
        },
        fixes={
            "both": msg(
                "Take the function {name} out of the import in line {line}; if it imports nothing else, "
                "delete the line. Then write {name}.{name} wherever the function {name} is called, and "
                "leave {name}.{attribute} as it is."
            )
        },
        raised={OF_FUNCTION: _of_module},
        examples=(
            example(
                "random_of_random",
                Replace(
                    NODE, "import rclpy\nfrom", "from random import random\n\nimport rclpy\nfrom"
                ),
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = random.choice([0]) if random() else 0",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "name_reused",
        "start",
        msg("A variable has the name of an import, a function or a class"),
        msg(
            "This line makes {name} the name of a variable. Line {row} needs what line {line} gives this "
            "name: {written}"
        ),
        msg(
            "Give the variable another name than {name}, in this line and wherever its value is meant. "
            "Where {name} means what line {line} gives it, as in line {row}, leave it."
        ),
        raised={
            UNBOUND: _unbound,
            CALLED: on_line(_called),
            NO_ATTRIBUTE: on_line(_read),
        },
        examples=(
            example(
                "executor_named_like_the_library",
                Replace(
                    NODE,
                    "        rclpy.spin(node)",
                    "        rclpy = SingleThreadedExecutor()\n"
                    "        rclpy.add_node(node)\n"
                    "        rclpy.spin()",
                ),
                Replace(
                    NODE,
                    "from rclpy.node",
                    "from rclpy.executors import SingleThreadedExecutor\nfrom rclpy.node",
                ),
                fails="run.starts",
            ),
            example(
                "number_named_like_an_import",
                Replace(
                    NODE, "import rclpy\nfrom", "from itertools import count\nimport rclpy\nfrom"
                ),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = next(count(0))"),
                Replace(NODE, "def main(", "count = 0\n\n\ndef main("),
                fails="run.starts",
            ),
        ),
    ),
)
