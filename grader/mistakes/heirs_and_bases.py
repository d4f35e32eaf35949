"""Mistakes with classes of the student's that inherit: the base is created, or starts first alone."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import Value, msg
from grader.mistakes import links
from grader.mistakes.example import NODE, SILENT, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.module import Function
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import function_at, statement_at
from grader.package.source.scopes import class_of


def _classes(source: NodeSource) -> dict[str, ast.ClassDef]:
    return {c.name: c for module in source.modules for c in module.classes}


def _bases(owner: ast.ClassDef) -> list[str]:
    return [last_part(dotted(base)) for base in owner.bases]


def _init(owner: ast.ClassDef) -> Function | None:
    found = [s for s in owner.body if isinstance(s, Function) and s.name == "__init__"]
    return found[0] if len(found) == 1 else None


def _base_created(suspect: Suspect) -> RecognisedMistake | None:
    """The class with the timer is not created, but the class from which it inherits."""
    source, classes = suspect.source, _classes(suspect.source)
    for timer in source.timers:
        around = source.module_of(timer.call).around(timer.call)
        owner = next((n for n in around if isinstance(n, ast.ClassDef)), None)
        bases = [n for n in (_bases(owner) if owner is not None else []) if n in classes]
        if owner is None or len(bases) != 1:
            continue
        heirs = {owner.name} | {c.name for c in classes.values() if owner.name in _bases(c)}
        named = [last_part(dotted(n)) for n in source.all_nodes if isinstance(n, ast.Name)]
        used = [n for n in heirs if n in named and not _is_base_only(source, n)]
        calls = [c for c, name in source.calls if name == bases[0]]
        if used or len(calls) != 1 or calls[0].args or calls[0].keywords:
            continue
        init = _init(owner)
        if init is not None and len(init.args.args) - len(init.args.defaults) > 1:
            continue
        params = {"name": f"{bases[0]}()", "written": f"{owner.name}()"}
        found = suspect.finding("base_created", calls[0], **params)
        words: dict[str, Value] = {"type": owner.name, "line": timer.call.lineno}
        return replace(found, words={**found.words, **words})
    return None


def _is_base_only(source: NodeSource, name: str) -> bool:
    """Whether the only uses of a class are in the heads of classes that inherit from it."""
    heads = {n for c in _classes(source).values() for base in c.bases for n in ast.walk(base)}
    uses = [n for n in source.all_nodes if isinstance(n, ast.Name) and n.id == name]
    return all(use in heads for use in uses)


def _first_base_alone(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """super() is the first base class, which is no node and takes no name of a node."""
    classes = _classes(raised.source)
    here = class_of(raised.module, function_at(raised.module, raised.line))
    first = classes.get(match["type"])
    statement = statement_at(raised.module, raised.line)
    call = statement.value if isinstance(statement, ast.Expr) else None
    if here is None or first is None or not isinstance(call, ast.Call):
        return None
    bases, init = _bases(here[0]), _init(first)
    others = [n for n in bases[1:] if n == "Node"]
    alone = not first.bases and init is not None and len(init.args.args) == 1
    if bases[:1] != [first.name] or not others or not alone:
        return None
    if dotted(call.func) != "super().__init__" or not call.args:
        return None
    code = raised.module.text.code
    given = ", ".join([*map(code, call.args), *map(code, call.keywords)])
    node = next(code(base) for base in here[0].bases if last_part(dotted(base)) == "Node")
    params = {"name": code(call), "written": f"{node}.__init__(self, {given})"}
    found = raised.finding("first_base_alone", at=statement, params=params)
    words = {"type": first.name, "called": f"{first.name}.__init__(self)"}
    return replace(found, words={**found.words, **words})


MIXED = "class Counting:\n    def __init__(self):\n        self.counter_ = 0\n\n\n"
_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "base_created",
        "class",
        msg("The base class is created instead of the class that inherits from it"),
        msg(
            "The timer is created by {type} (line {line}), and no object of {type} is created: its "
            "lines do not run."
        ),
        msg("Write {written} instead of {name}."),
        behind={"run.no_lines": _base_created},
        fixed_by=(lines.written,),
        examples=(
            example(
                "base_class_is_created",
                Replace(
                    NODE,
                    "class MyFirstNode(Node):",
                    "class Base(Node):\n    def __init__(self, name='my_first_node'):\n"
                    "        super().__init__(name)\n\n\nclass MyFirstNode(Base):",
                ),
                Replace(NODE, "node = MyFirstNode()", "node = Base()"),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "first_base_alone",
        "class",
        msg("super() is the first of several base classes, and not Node"),
        msg(
            "super() is the first class in the () of the class: {type}. Its __init__ takes no name, and "
            "does not call that of Node."
        ),
        msg(
            "Write {written} instead of {name}, and {called} on a line of its own below it. So both base "
            "classes are set up."
        ),
        raised={r"TypeError: (?P<type>\w{1,120})\.__init__\(\) takes": _first_base_alone},
        examples=(
            example(
                "class_without_node_first",
                Replace(
                    NODE, "class MyFirstNode(Node):", f"{MIXED}class MyFirstNode(Counting, Node):"
                ),
                fails="run.starts",
            ),
        ),
    ),
)
