"""Mistakes in how classes share their names: a private one, a base whose __init__ stops at itself."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.constructor import PRIVATE, is_of_node
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.rename import splices_of
from grader.mistakes.kind import Family
from grader.mistakes.recognised import OWN_ATTRIBUTE, Raised, RecognisedMistake
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted, last_part
from grader.package.source.node import read_module
from grader.package.source.place import function_at
from grader.package.source.scopes import class_of, scope_of


def _private(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A name with two leading underscores is used outside of the class that sets it."""
    name, module = match["name"], raised.module
    private = name.startswith("__") and not name.endswith("__")
    if not private:
        return None
    here = class_of(module, function_at(module, raised.line))
    owners = {_owner(module, part) for part in _set(module, name)} - {None}
    first = {_owner(module, part) for part in _set(module, name) if not _adds(module, part)}
    set_outside = here is not None and first == {None}
    if not set_outside and (not owners or (here is not None and here[0] in owners)):
        return None
    rows = sorted({part.lineno for part in _named(module, name)})
    params = {"name": name, "written": name[1:], "lines": ", ".join(map(str, rows))}
    found = raised.finding("private_name", params=params)
    if here is None or set_outside or len(owners) != 1:
        return found
    owner = next(owner.name for owner in owners if owner is not None)
    words = {**found.words, "type": owner, "class": here[0].name}
    return replace(found, words=words, variant="other")


def _named(module: Module, name: str) -> list[ast.Attribute]:
    """Return where a file names an attribute, of whatever object."""
    return [n for n in module.nodes if isinstance(n, ast.Attribute) and n.attr == name]


def _set(module: Module, name: str) -> list[ast.Attribute]:
    return [n for n in _named(module, name) if isinstance(n.ctx, ast.Store)]


def _adds(module: Module, part: ast.Attribute) -> bool:
    return isinstance(module.parents.get(part), ast.AugAssign)


def _owner(module: Module, part: ast.Attribute) -> ast.ClassDef | None:
    found = class_of(module, scope_of(module, part))
    return found[0] if found is not None else None


def _with_one_underscore(case: Case) -> Files | None:
    """Write one underscore instead of two, wherever the file names the attribute."""
    module, params = read_module(case.files.data, case.finding.file), case.finding.params
    name, new = (str(params.get(key, "")) for key in ("name", "written"))
    if module is None or not new or _named(module, new):
        return None
    splices = splices_of(module, _named(module, name), new)
    return case.changed(module, *splices) if splices else None


def _base_stops(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The __init__ of a base of the student's own does not go on to that of Node."""
    init, own = raised.source.methods.get("__init__"), raised.source.node_class
    if match["type"] not in raised.source.known_classes or init is None or own is None:
        return None
    if raised.source.super_init is None or not is_of_node(raised, match):
        return None
    for base in own.bases:
        found = raised.source.classes_by_name.get(last_part(dotted(base)))
        if found is None:
            return None  # (Node or another class of ROS comes first)
        inits = [n for n in found.body if isinstance(n, Function) and n.name == "__init__"]
        if inits and not _goes_on(inits[0]):
            return _stops_at(raised, found, inits[0])
    return None


def _goes_on(init: Function) -> bool:
    calls = [n for n in ast.walk(init) if isinstance(n, ast.Call)]
    return any(isinstance(c.func, ast.Attribute) and c.func.attr == "__init__" for c in calls)


def _stops_at(raised: Raised, base: ast.ClassDef, init: Function) -> RecognisedMistake:
    given = [argument.arg for argument in init.args.args[1:]]
    found = raised.finding("base_stops", at=init, name=base.name)
    passed = given[:1]
    if init.args.vararg is not None and init.args.kwarg is not None and not given:
        passed = [f"*{init.args.vararg.arg}", f"**{init.args.kwarg.arg}"]
    words = {**found.words, "written": f"super().__init__({', '.join(passed)})"}
    return replace(found, words=words, variant="" if passed else "no_name")


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "private_name",
        "class",
        msg("A private name is used outside of its class"),
        msg("A name that begins with two underscores is known only inside of the class."),
        msg("Write {written} instead of {name} (lines: {lines})."),
        whys={
            "other": msg(
                "A name that begins with two underscores belongs to the class whose lines use it: "
                "{name} in the class {class} is another attribute than {name} in the class {type}, "
                "and only {type} sets it."
            )
        },
        raised={OWN_ATTRIBUTE: _private},
        fixed_by=(_with_one_underscore,),
        examples=(
            example(
                "private_counter_read_by_main",
                Replace(NODE, "self.counter_ = 0", "self.__counter = 0"),
                Replace(NODE, "str(self.counter_)", "str(self.__counter)"),
                Replace(NODE, "self.counter_ += 1", "self.__counter += 1"),
                Replace(
                    NODE,
                    "        node.destroy_node()",
                    "        print(node.__counter)\n        node.destroy_node()",
                ),
                fails="run.interrupt",
            ),
            example(
                "private_counter_set_by_main",
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(NODE, "str(self.counter_)", "str(self.__counter)"),
                Replace(NODE, "self.counter_ += 1", "self.__counter += 1"),
                Replace(
                    NODE, "node = MyFirstNode()\n", "node = MyFirstNode()\n    node.__counter = 0\n"
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "private_counter_of_base",
                Replace(
                    NODE,
                    "class MyFirstNode(Node):",
                    "class CountingNode(Node):\n\n    def __init__(self, name):\n"
                    "        super().__init__(name)\n        self.__counter = 0\n\n"
                    "    def step(self):\n        self.__counter += 1\n\n\n"
                    "class MyFirstNode(CountingNode):",
                ),
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(NODE, "str(self.counter_)", "str(self.__counter)"),
                Replace(NODE, "self.counter_ += 1", "self.step()"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "base_stops",
        "class",
        msg("The __init__ of another base class does not call the one of Node"),
        msg(
            "super().__init__() calls the __init__ of the first base, {name}. That one must call "
            "super().__init__() too, or the __init__ of Node never runs."
        ),
        msg("Write {written} as the first line of the __init__ of {name}."),
        fixes={
            "no_name": msg(
                "Give the __init__ of {name} a parameter for the node's name, and write as its "
                "first line super().__init__() with this parameter."
            )
        },
        raised={PRIVATE: _base_stops},
        examples=(
            example(
                "base_takes_all_arguments_without_super",
                Replace(
                    NODE,
                    "class MyFirstNode(Node):",
                    "class Greets:\n\n    def __init__(self, *args, **kwargs):\n"
                    "        self.greeting = 'Hello'\n\n\nclass MyFirstNode(Greets, Node):",
                ),
                fails="run.starts",
            ),
            example(
                "base_without_super",
                Replace(
                    NODE,
                    "class MyFirstNode(Node):",
                    "class Greets:\n\n    def __init__(self, name):\n        self.greeting = name\n\n\n"
                    "class MyFirstNode(Greets, Node):",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
