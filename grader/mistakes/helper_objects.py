"""Mistakes with the objects of helper classes: not made, not called, or used as if they were a node."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, LOG_LINE, NODE, STEP_LINE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect, on_line
from grader.mistakes.scope import NODE_METHODS
from grader.package.edit.tree import Replace
from grader.package.source.counter import adds_to, parts_of_callback, targets_of
from grader.package.source.module import Function
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource

HELPER = (
    "class HelperOfCount:\n\n    def __init__(self):\n        self.total = 0\n\n"
    "    def one_more(self):\n        self.total += 1\n\n\nclass MyFirstNode"
)
PROPERTY = (
    "class CountOnRead:\n\n    def __init__(self):\n        self._n = -1\n\n    @property\n"
    "    def number(self):\n        self._n += 1\n        return self._n\n\n\nclass MyFirstNode"
)
GREETER = (
    "class Speaker:\n\n    def __init__(self):\n        self.n = 0\n\n    def speak(self):\n"
    "        self.get_logger().info('Hello time: ' + str(self.n))\n"
    "        self.n += 1\n\n\nclass MyFirstNode"
)


def _class_itself(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A class of the student's is used where one of its objects is meant: the () is missing."""
    kind, name = match["type"], match["name"]
    owners = {
        dotted(n.value)
        for n in raised.module.nodes
        if isinstance(n, ast.Attribute) and n.attr == name and n.lineno == raised.line
    }
    found = [
        n
        for n in raised.source.all_nodes
        if isinstance(n, ast.Assign)
        and owners & set(targets_of(n))
        and last_part(dotted(n.value)) == kind
    ]
    own = [c for m in raised.source.modules for c in m.classes if c.name == kind]
    if len(found) != 1 or len(own) != 1 or not _needs_nothing(own[0]):
        return None
    code = raised.source.module_of(found[0]).text.code(found[0])
    target = next(iter(owners & set(targets_of(found[0]))))
    params = {"name": code, "written": f"{code}()"}
    mistake = raised.finding("helper_not_made", at=found[0], params=params)
    return replace(mistake, words={**mistake.words, "type": kind, "attribute": target})


def _needs_nothing(own: ast.ClassDef) -> bool:
    """Whether an object of a class can be made without arguments, as far as the class shows it."""
    inits = [s for s in own.body if isinstance(s, Function) and s.name == "__init__"]
    given = [i.args for i in inits]
    return all(len(a.args) - len(a.defaults) <= 1 and not a.kwonlyargs for a in given)


def _needs_node(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A method of Node is called on self in a class that is no node."""
    kind, name = match["type"], match["name"]
    own = [c for m in raised.source.modules for c in m.classes if c.name == kind]
    if len(own) != 1 or name not in NODE_METHODS or own[0] in raised.source.family:
        return None
    if own[0].bases or f"self.{name}" not in raised.module.line(raised.line):
        return None
    mistake = raised.finding("helper_is_no_node", name=f"self.{name}", written=f"self.node.{name}")
    words = {**mistake.words, "type": kind, "method": name}
    made = [call for call, called in raised.source.calls if last_part(called) == kind]
    function = raised.source.function_around(made[0]) if len(made) == 1 else None
    inside = function is not None and function in raised.source.own_methods
    inits = [s for s in own[0].body if isinstance(s, Function) and s.name == "__init__"]
    plain = len(inits) == 1 and len(inits[0].args.args) == 1 and not made[0].args if made else False
    if not inside or not plain or made[0].keywords:
        return replace(mistake, words=words)
    words |= {"line": str(made[0].lineno), "row": str(inits[0].lineno)}
    return replace(mistake, words=words, variant="made")


def _only_named(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a statement of the callback that names a method of a helper, and does not call it."""
    source = suspect.source
    for part in parts_of_callback(source):
        for node in ast.walk(part):
            value = node.value if isinstance(node, ast.Expr) else None
            if not isinstance(node, ast.Expr) or not isinstance(value, ast.Attribute):
                continue
            method = _method(source, value.attr)
            if method is None or not dotted(value) or not _changes_something(method):
                continue
            code = dotted(value)
            mistake = suspect.finding("helper_not_called", node, name=code, written=f"{code}()")
            return replace(mistake, words={**mistake.words, "line": str(method.lineno)})
    return None


def _method(source: NodeSource, name: str) -> Function | None:
    """Return the only method of this name in the files, if it needs no arguments."""
    found = [n for n in source.all_nodes if isinstance(n, Function) and n.name == name]
    plain = len(found) == 1 and len(found[0].args.args) == 1 and not found[0].decorator_list
    return found[0] if plain else None


def _changes_something(function: Function) -> bool:
    parts = list(ast.walk(function))
    return any(isinstance(n, ast.AugAssign) or _sets_attribute(n) for n in parts)


def _sets_attribute(node: ast.AST) -> bool:
    return isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store)


def _read_counts(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a property that adds to the number, and that the callback reads several times."""
    source, callback = suspect.source, suspect.source.callback
    for method in source.all_nodes:
        if not isinstance(method, Function) or callback is None:
            continue
        if [dotted(d) for d in method.decorator_list] != ["property"]:
            continue
        added = [n for n in ast.walk(method) if isinstance(n, ast.AugAssign)]
        read = [
            n
            for n in ast.walk(callback)
            if isinstance(n, ast.Attribute) and n.attr == method.name and _is_read(n)
        ]
        codes = {dotted(n) for n in read}
        if len(added) != 1 or len(read) < 2 or len(codes) != 1:
            continue
        name, free = codes.pop(), _free(callback)
        mistake = suspect.finding("read_counts", read[0], name=name)
        rows = ", ".join(str(row) for row in sorted({n.lineno for n in read}))
        words = {**mistake.words, "line": str(added[0].lineno), "lines": rows}
        return replace(mistake, words={**words, "number": free, "count": len(read)})
    return None


def _setter_adds(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a setter that adds the value which it gets, where a sum is assigned to its property."""
    source = suspect.source
    for method in (n for n in source.all_nodes if isinstance(n, Function)):
        marks = [dotted(d) for d in method.decorator_list]
        given = [a.arg for a in method.args.args]
        if marks != [f"{method.name}.setter"] or len(given) != 2:
            continue
        adds = [n for n in method.body if isinstance(n, ast.AugAssign)]
        value = adds[0].value if len(adds) == 1 else None
        if value is None or dotted(value) != given[1] or not isinstance(adds[0].op, ast.Add):
            continue
        sums = [
            name
            for n in source.all_nodes
            for name in targets_of(n)
            if last_part(name) == method.name and adds_to(n, name)
        ]
        if sums:
            code, target = source.module_of(method).text.code, dotted(adds[0].target)
            params = {"name": code(adds[0]), "written": f"{target} = {given[1]}"}
            mistake = suspect.finding("setter_adds", adds[0], **params)
            return replace(mistake, words={**mistake.words, "attribute": sums[0]})
    return None


def _is_read(node: ast.Attribute) -> bool:
    return isinstance(node.ctx, ast.Load)


def _free(function: Function) -> str:
    """Return a name for a variable that a function does not use."""
    used = {n.id for n in ast.walk(function) if isinstance(n, ast.Name)}
    return next(name for name in ("number", "shown_number", "number_to_show") if name not in used)


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "helper_not_made",
        "class",
        msg("The class itself is used instead of an object"),
        msg(
            "An object is made by a call of its class, with (). This line gives {attribute} the class "
            "{type} itself, and the __init__ of {type} does not run."
        ),
        msg("Write {written} instead of {name}."),
        raised={
            r"AttributeError: type object '(?P<type>\w{1,120})' has no attribute "
            r"'(?P<name>\w{1,120})'": on_line(_class_itself)
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "class_of_the_helper",
                Replace(NODE, "class MyFirstNode", HELPER),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = HelperOfCount"),
                Replace(NODE, "str(self.counter_)", "str(self.counter_.total)"),
                Replace(NODE, "self.counter_ += 1", "self.counter_.one_more()"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "helper_is_no_node",
        "class",
        msg("A method of Node is called on an object that is no node"),
        msg(
            "{method} is a method of Node. The class {type} is not derived from Node, so its objects "
            "do not have it."
        ),
        msg(
            "Give the object the node: the __init__ of {type} gets it as one more argument, node, and "
            "keeps it with self.node = node. Where the object is made, pass the node, which is self in "
            "the methods of the node. Then write {written} instead of {name}."
        ),
        fixes={
            "made": msg(
                "Give the object the node: write {type}(self) instead of {type}() in line {line}, and "
                "def __init__(self, node): with the first line self.node = node in line {row}. Then "
                "write {written} instead of {name}."
            )
        },
        raised={
            r"AttributeError: '(?P<type>\w{1,120})' object has no attribute "
            r"'(?P<name>\w{1,120})'": on_line(_needs_node)
        },
        examples=(
            example(
                "helper_logs_without_node",
                Replace(NODE, "class MyFirstNode", GREETER),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = Speaker()"),
                Replace(NODE, LOG_LINE + STEP_LINE, "        self.counter_.speak()\n"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "helper_not_called",
        "counter",
        msg("A method is named, and not called"),
        msg(
            "A method runs only when it is called, with (). This line names {name}, so the lines of "
            "the method (from line {line} on) do not run."
        ),
        msg("Write {written} instead of {name}."),
        behind=dict.fromkeys(("run.constant_counter", "run.wrong_step"), _only_named),
        fixed_by=(lines.written,),
        examples=(
            example(
                "method_of_helper_named",
                Replace(NODE, "class MyFirstNode", HELPER),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = HelperOfCount()"),
                Replace(NODE, "str(self.counter_)", "str(self.counter_.total)"),
                Replace(NODE, "self.counter_ += 1", "self.counter_.one_more"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "setter_adds",
        "counter",
        msg("The setter adds the value that it gets"),
        msg(
            "Another line assigns a sum to {attribute}: the number with the step already in it. This "
            "setter adds that whole sum to the number."
        ),
        msg("Write {written} instead of {name}."),
        behind=dict.fromkeys(("run.wrong_step", "run.wrong_start"), _setter_adds),
        fixed_by=(lines.written,),
        examples=(
            example(
                "setter_of_the_count_adds",
                Replace(NODE, "self.counter_ = 0", "self._number = 0"),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    @property\n    def counter_(self):\n        return self._number\n\n"
                    "    @counter_.setter\n    def counter_(self, value):\n"
                    "        self._number += value\n\n    def timer_callback",
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "read_counts",
        "counter",
        msg("Each read of the property changes the number"),
        msg(
            "A property is a method that runs in each read. {name} runs line {line}, which changes the "
            "number, and {callback} reads it {count} times (line {lines})."
        ),
        msg(
            "Read it once: write {number} = {name} as the first line of {callback}, and {number} instead "
            "of {name} in the lines below it."
        ),
        behind=dict.fromkeys(("run.wrong_start", "run.wrong_step"), _read_counts),
        examples=(
            example(
                "property_read_twice",
                Replace(NODE, "class MyFirstNode", PROPERTY),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = CountOnRead()"),
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    "        if self.counter_.number >= 0:\n"
                    "            self.get_logger().info('Hello time: ' + str(self.counter_.number))\n",
                ),
                fails="run.output",
            ),
        ),
    ),
)
