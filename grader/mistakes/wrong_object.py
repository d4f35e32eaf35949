"""Mistakes in what a variable holds that is used as a node or an executor: a tuple, a list, a class."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, on_line
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import called_name, dotted, last_part
from grader.package.source.place import statement_at

EXECUTORS = ("SingleThreadedExecutor", "MultiThreadedExecutor", "EventsExecutor")
GIVEN_TO = ("spin", "spin_once", "spin_until_future_complete", "add_node", "remove_node")
OF_OTHERS = r"AttributeError: '(?P<type>tuple|list|set)' object has no attribute"
OF_NOTHING = r"AttributeError: 'NoneType' object has no attribute"
OF_CLASS = (
    r"TypeError: .{1,200} missing \d{1,3} required positional argument"
    r"|AttributeError: (?:type object '|'property' object)"
)
SELF_MISSING = "argument: 'self'|'property' object is not iterable"
UNPACKED = r"TypeError: cannot unpack non-iterable \w{1,120} object"
TYPES = {ast.Tuple: "tuple", ast.List: "list", ast.Set: "set"}


@dataclass(frozen=True)
class _Held:
    """A name that the line uses as an object, and the only statement that sets it."""

    name: str
    set_by: ast.Assign

    @property
    def value(self) -> ast.expr:
        return self.set_by.value


def _held(raised: Raised) -> Iterator[_Held]:
    module, source = raised.module, raised.source
    statement = statement_at(module, raised.line)
    for part in ast.walk(statement) if statement is not None else ():
        around = module.parents.get(part)
        read = isinstance(around, ast.Attribute) and around.value is part
        given = isinstance(around, ast.Call) and part in around.args
        given = given and isinstance(around, ast.Call) and called_name(around) in GIVEN_TO
        name = dotted(part) if isinstance(part, ast.Name | ast.Attribute) else ""
        if not name or not (read or given):
            continue
        setting = [n for n in source.all_nodes if isinstance(n, ast.stmt) and name in targets_of(n)]
        stored = [
            n
            for n in source.all_nodes
            if isinstance(n, ast.Name | ast.Attribute)
            and isinstance(n.ctx, ast.Store)
            and dotted(n) == name
        ]
        only = setting[0] if len(setting) == len(stored) == 1 else None
        if isinstance(only, ast.Assign) and len(only.targets) == 1:
            yield _Held(name, only)


def _in_brackets(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The object is the only element of a tuple, a list or a set."""
    for held in _held(raised):
        value = held.value
        if not isinstance(value, ast.Tuple | ast.List | ast.Set) or len(value.elts) != 1:
            continue
        if TYPES[type(value)] != match["type"] or not isinstance(value.elts[0], ast.Call):
            continue
        text = raised.source.module_of(value).text
        code, inner = text.code(value), text.code(value.elts[0])
        params = {"name": code, "written": inner, "variable": held.name, "type": match["type"]}
        found = raised.finding("object_in_tuple", at=held.set_by, params=params)
        plain = isinstance(value, ast.Tuple) and code.startswith(inner)
        return found if plain else replace(found, variant="brackets")
    return None


def _unpacked(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A comma behind the variable makes a tuple of what is left of the `=`."""
    del match
    statement = statement_at(raised.module, raised.line)
    target = statement.targets[0] if isinstance(statement, ast.Assign) else None
    if not isinstance(target, ast.Tuple) or len(target.elts) != 1:
        return None
    text = raised.module.text
    name = text.code(target.elts[0])
    params = {"name": text.code(target), "written": name, "variable": name}
    return replace(raised.finding("object_in_tuple", at=target, params=params), variant="unpacked")


def _is_class(raised: Raised, value: ast.expr) -> bool:
    name = last_part(dotted(value)) if isinstance(value, ast.Name | ast.Attribute) else ""
    own = name in raised.source.known_classes and raised.source.is_node_class(value)
    return own or (name in EXECUTORS and name in raised.module.imports | {name})


def _class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The variable holds the class, which the line that sets it does not call."""
    del match
    for held in _held(raised):
        if not _is_class(raised, held.value):
            continue
        text = raised.source.module_of(held.value).text
        code = text.code(held.value)
        if "\n" in text.code(held.set_by):
            continue
        params = {"name": text.code(held.set_by), "variable": held.name, "type": code}
        params["written"] = f"{params['name']}()"
        return raised.finding("class_not_called", at=held.set_by, params=params)
    return None


def _nothing(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The variable of the node holds None, and no line makes a node."""
    del match
    source = raised.source
    made = source.node_class.name if source.node_class is not None else ""
    init = source.methods.get("__init__")
    if not made or source.makes_node() or len(source.family) != 1 or _wants_more(init):
        return None
    for held in _held(raised):
        value = held.value
        if not isinstance(value, ast.Constant) or value.value is not None:
            continue
        used = statement_at(raised.module, raised.line)
        calls = {called_name(n) for n in ast.walk(used or value) if isinstance(n, ast.Call)}
        if not calls & {*GIVEN_TO, "destroy_node"}:
            continue
        params = {"name": "None", "written": f"{made}()", "variable": held.name}
        return raised.finding("node_is_none", at=held.set_by, params=params)
    return None


def _wants_more(init: Function | None) -> bool:
    if init is None:
        return False
    given = init.args
    return len(given.args) - len(given.defaults) > 1 or None in given.kw_defaults


def _some_class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A name that the line does not use directly holds the class."""
    del match
    called = {name for _, name in raised.source.calls}
    found = [
        node
        for node in raised.source.all_nodes
        if isinstance(node, ast.Assign)
        and _is_class(raised, node.value)
        and not called & set(targets_of(node))
    ]
    if len(found) != 1:
        return None
    mistake = raised.finding("class_not_called", at=found[0], name=dotted(found[0].value))
    return replace(mistake, variant="somewhere")


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "object_in_tuple",
        "start",
        msg("The variable has a tuple or a list instead of the object"),
        msg(
            "A comma at the end of a value makes a tuple of it. {variable} is then a tuple, which "
            "has the object in it, and not the object itself."
        ),
        msg("Delete the comma at the end of this line: write {written} instead of {name}"),
        whys={
            "brackets": msg(
                "With these brackets, {variable} is a {type} that has the object in it, and not the "
                "object itself."
            ),
            "unpacked": msg(
                "With a comma behind the name, Python takes what is on the right for a list of one "
                "value, and gives that to {variable}. On the right is an object, and no list."
            ),
        },
        fixes={
            "brackets": msg("Write {written} instead of {name} on this line."),
            "unpacked": msg("Delete the comma before the = on this line."),
        },
        raised={OF_OTHERS: _in_brackets, UNPACKED: on_line(_unpacked)},
        fixed_by=(lines.written,),
        examples=(
            example(
                "node_with_comma",
                Replace(NODE, "node = MyFirstNode()", "node = MyFirstNode(),"),
                fails="run.starts",
            ),
            example(
                "node_in_list",
                Replace(NODE, "node = MyFirstNode()", "node = [MyFirstNode()]"),
                fails="run.starts",
            ),
            example(
                "node_unpacked",
                Replace(NODE, "node = MyFirstNode()", "node, = MyFirstNode()"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "class_not_called",
        "start",
        msg("The () after the class is missing"),
        msg("The name of a class creates no object; only calling it does."),
        msg("Write {written} on this line."),
        fixes={"somewhere": msg("Write {name}() where the node is created.")},
        raised={OF_CLASS: _class, SELF_MISSING: _some_class},
        fixed_by=(lines.written,),
        examples=(
            example(
                "node_not_made",
                Replace(NODE, "node = MyFirstNode()", "node = MyFirstNode"),
                fails="run.starts",
            ),
            example(
                "executor_class_not_called",
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        executor = SingleThreadedExecutor\n"
                    "        executor.add_node(node)\n"
                    "        executor.spin()\n",
                ),
                Replace(
                    NODE,
                    "from rclpy.node",
                    "from rclpy.executors import SingleThreadedExecutor\nfrom rclpy.node",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "node_is_none",
        "start",
        msg("No node is made: the variable is None"),
        msg("{variable} is None on this line, and no other line makes a node."),
        msg("Write {written} instead of {name} on this line."),
        raised={OF_NOTHING: _nothing},
        fixed_by=(lines.written,),
        examples=(
            example(
                "node_is_none",
                Replace(NODE, "node = MyFirstNode()", "node = None"),
                fails="run.starts",
            ),
        ),
    ),
)
