"""Mistakes in the first number of the counter: its start, and counting before the log line."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.counted import Counter, counter_in
from grader.mistakes.example import LOG_LINE, NODE, STEP_LINE, example
from grader.mistakes.fixes import node_count, node_worked_out
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect, first_of
from grader.mistakes.worked_out import INSTEAD, change_of, worked_out
from grader.package.edit.tree import Replace
from grader.package.source.counter import (
    adds_to,
    parts_of_callback,
    starts_of,
    targets_of,
    texts_of,
)
from grader.package.source.module import Function
from grader.package.source.names import dotted
from grader.package.source.place import blocks_in
from grader.package.source.plain_counter import plain_start


def _adds_before_log(suspect: Suspect) -> RecognisedMistake | None:
    counter, callback = counter_in(suspect), suspect.source.callback
    if counter is None or callback is None:
        return None
    if (grown := _grows_before_log(callback, counter)) is not None:
        return _before_log(suspect, grown, counter)
    texts = texts_of(callback, counter.logged)
    read = min([counter.logged.lineno, *(text.lineno for text in texts)])
    gone = {n for block in _left_blocks(callback) for s in block for n in ast.walk(s)}
    added = [n for n in ast.walk(callback) if adds_to(n, counter.name) and n not in gone]
    first = min(added, key=lambda n: getattr(n, "lineno", 0), default=None)
    if not isinstance(first, ast.Assign | ast.AugAssign) or first.lineno >= read:
        return None
    return _before_log(suspect, first, counter)


def _left_blocks(callback: Function) -> Iterator[list[ast.stmt]]:
    """Yield the blocks of a callback after which the lines below them do not run."""
    for node in ast.walk(callback):
        for block in blocks_in(node) if node is not callback else ():
            if isinstance(block[-1], ast.Return | ast.Raise | ast.Continue):
                yield block


def _before_log(suspect: Suspect, added: ast.stmt, counter: Counter) -> RecognisedMistake:
    found = suspect.finding("adds_before_log", added, name=counter.name)
    start = plain_start(suspect.source, counter.name)
    other = start is not None and start.number != suspect.output.start
    written = suspect.source.module_of(added).text.code(added)
    words = {**found.words, "written": written[:80], "line": str(counter.logged.lineno)}
    if other and start is not None:
        words["first"] = str(start.at.lineno)
    return replace(found, words=words, variant="other" if other else "")


def _added_before(suspect: Suspect) -> RecognisedMistake | None:
    """Look for an addition before a call that logs, or in a function before its return."""
    change = change_of(suspect, "before", "returned")
    if change is None:
        return None
    found = suspect.finding("adds_before_log", change.at, name=change.name)
    if change.sort == "before":
        words = {**found.words, "written": change.name, "line": change.written}
        module = suspect.source.module_of(change.at)
        yields = any(isinstance(n, ast.Yield) and str(n.lineno) == change.written
                     for n in module.nodes)  # fmt: skip
        return replace(found, words=words, variant="yields" if yields else "")
    around = suspect.source.function_around(change.at)
    function = around.name if around is not None else ""
    words = {**found.words, "written": change.written, "function": function}
    return replace(found, words=words, variant="returned")


def _grows_before_log(callback: Function, counter: Counter) -> ast.stmt | None:
    """Return the statement that adds to a list, the length of which the callback logs below it."""
    lengths = [n for n in ast.walk(counter.logged) if _is_length(n, counter.name)]
    for statement in callback.body if lengths else ():
        call = statement.value if isinstance(statement, ast.Expr) else None
        grows = isinstance(call, ast.Call) and dotted(call.func) == f"{counter.name}.append"
        if grows and statement.lineno < counter.logged.lineno:
            return statement
    return None


def _is_length(node: ast.AST, name: str) -> bool:
    called = isinstance(node, ast.Call) and dotted(node.func) == "len" and len(node.args) == 1
    return isinstance(node, ast.Call) and called and dotted(node.args[0]) == name


def _is_number(suspect: Suspect, name: str, value: ast.AST) -> bool:
    """Return whether a counter is the number itself, not an object that has it in it."""
    objects = (ast.List, ast.Tuple, ast.Dict, ast.Set, ast.ListComp, ast.Lambda, ast.GeneratorExp)
    if isinstance(value, objects):
        return False
    for part in parts_of_callback(suspect.source):
        for node in ast.walk(part):
            if isinstance(node, ast.Subscript | ast.Attribute) and dotted(node.value) == name:
                return False
            if not isinstance(node, ast.Call):
                continue
            used = dotted(node.func) in ("len", "next", "iter", "sum", "max", "min")
            if dotted(node.func) == name or (used and name in map(dotted, node.args)):
                return False
    return True


def _is_written(value: ast.AST) -> bool:
    """Return whether the source itself says which number a value is: 1, -1, 2 - 1, int('1')."""
    if isinstance(value, ast.UnaryOp):
        return _is_written(value.operand)
    if isinstance(value, ast.BinOp):
        return _is_written(value.left) and _is_written(value.right)
    if isinstance(value, ast.Call) and dotted(value.func) in ("int", "float"):
        return all(isinstance(given, ast.Constant) for given in value.args)
    return isinstance(value, ast.Constant) and isinstance(value.value, int | float)


def _starts_elsewhere(suspect: Suspect) -> RecognisedMistake | None:
    counter = counter_in(suspect)
    if counter is None:
        return None
    init = suspect.source.methods.get("__init__")
    at: ast.stmt | ast.expr | None = starts_of(suspect.source).get(counter.name)
    for node in ast.walk(init) if init else ():
        if isinstance(node, ast.Assign) and counter.name in targets_of(node):
            at = node
            break
    if at is None:
        return None
    start = suspect.output.start
    value = at.value if isinstance(at, ast.Assign) else at
    if isinstance(value, ast.Constant) and value.value == start:
        return None
    if not _is_written(value):
        return None
    if not _is_number(suspect, counter.name, value):
        return None
    name = counter.name
    around = suspect.source.module_of(at).parents.get(at)
    if isinstance(around, ast.Assign):
        name = next(targets_of(around), name)
    return suspect.finding("starts_elsewhere", at, name=name, start=start)


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "adds_before_log",
        "counter",
        msg("The callback adds to the counter before it logs"),
        msg("The first line must show the counter's first value."),
        msg(
            "Move this line ({written}) below line {line}, which logs: log first, and then count. "
            "Then the first line shows {start}."
        ),
        fixes={
            "other": msg(
                "Move this line ({written}) below line {line}, which logs: log first, and then count. "
                "In line {first}, write {start} as the first value of {name}."
            ),
            "yields": msg(
                "Move this line ({written}) below line {line}: yield the number first, and then count. "
                "Then the first line shows {start}."
            ),
            "returned": msg(
                "{function} adds to {name} before it returns the number. Keep the old value "
                "first, and return that: {written}"
            ),
        },
        behind={"run.wrong_start": first_of(_adds_before_log, _added_before)},
        fixed_by=(node_count.start, node_worked_out.change("before", "returned")),
        deletes=("", "other", "yields"),
        examples=(
            example(
                "adds_before_logging",
                Replace(
                    NODE,
                    (
                        "self.get_logger().info('Hello time: ' + str(self.counter_))\n"
                        "        self.counter_ += 1"
                    ),
                    (
                        "self.counter_ += 1\n"
                        "        self.get_logger().info('Hello time: ' + str(self.counter_))"
                    ),
                ),
                fails="run.output",
            ),
            example(
                "adds_before_text",
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    "        self.counter_ = self.counter_ + 1\n"
                    "        text = 'Hello time: ' + str(self.counter_)\n"
                    "        self.get_logger().info(text)\n",
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "starts_elsewhere",
        "counter",
        msg("The counter starts at a different number"),
        msg("The first line shows the first value of the counter."),
        msg("Write on that line: {name} = {start}"),
        fixes={"written": INSTEAD},
        behind={
            "run.wrong_start": first_of(
                _starts_elsewhere, worked_out("starts_elsewhere", "first", variant="written")
            )
        },
        fixed_by=(node_count.start, node_worked_out.change("first")),
        examples=(
            example(
                "starts_at_one",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 1"),
                fails="run.output",
            ),
        ),
    ),
)
