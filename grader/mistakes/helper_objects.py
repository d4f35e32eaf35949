"""Mistakes with the objects of helper classes: not made, not called, or used as if they were a node."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG_LINE, NODE, STEP_LINE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
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
        read = [n for n in read if not _is_other_branch(source, n, read)]
        codes = {dotted(n) for n in read}
        if len(added) != 1 or len(read) < 2 or len(codes) != 1:
            continue
        name, free = codes.pop(), _free(callback)
        mistake = suspect.finding("read_counts", read[0], name=name)
        rows = ", ".join(str(row) for row in sorted({n.lineno for n in read}))
        words = {**mistake.words, "line": str(added[0].lineno), "lines": rows}
        return replace(mistake, words={**words, "number": free, "count": len(read)})
    return None


def _is_other_branch(source: NodeSource, node: ast.AST, all_nodes: Sequence[ast.AST]) -> bool:
    """Whether a part is in the else of an if whose own block has another: one call runs one of them."""
    inner: ast.AST = node
    for around in source.module_of(node).around(node):
        if isinstance(around, ast.If) and inner in around.orelse:
            first = {part for statement in around.body for part in ast.walk(statement)}
            if first & set(all_nodes):
                return True
        inner = around
    return False


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
            "number, and {callback} reads it {count} times (lines: {lines})."
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
