"""Mistakes in how the counter changes: its step, and what sets it back."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.counted import counter_in, text_added
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines, node_count
from grader.mistakes.kind import INSTEAD, Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.counter import (
    declares,
    outer_word,
    parts_of_callback,
    starts_of,
    targets_of,
    without_effect,
    wrapped_at,
)
from grader.package.source.names import dotted, last_part, own_name
from grader.package.source.node import NodeSource
from grader.package.source.place import statement_at
from grader.package.source.plain_counter import plain_start
from grader.package.source.sure_errors import is_never_set

SUM = ast.Add | ast.Sub
NUMBER = re.compile(r"-?\d{1,20}")
BRANCHES = ast.If | ast.Match | ast.Try | ast.ExceptHandler | ast.For | ast.While


def _step_is_text(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line adds a number in quotes; without a line, the only place of the files that does."""
    del match
    statement = statement_at(raised.module, raised.line)
    nodes = raised.source.all_nodes if raised.line is None else [statement]
    found = [
        (node, name, step)
        for node in nodes
        if isinstance(node, ast.AugAssign | ast.Assign)
        for name, step in [_text_added(node)]
        if name and step.isascii() and step.isdigit()
    ]
    if len(found) != 1:
        return None
    at, name, step = found[0]
    return raised.finding("step_is_text", at=at, name=name, step=step)


def _text_added(statement: ast.AugAssign | ast.Assign) -> tuple[str, str]:
    """Return the name to which a statement adds a text, and that text; "" for what is not there."""
    if isinstance(statement, ast.Assign):
        return next(targets_of(statement), ""), text_added(statement)
    step = statement.value.value if isinstance(statement.value, ast.Constant) else None
    added = step if isinstance(step, str) and isinstance(statement.op, ast.Add) else ""
    return dotted(statement.target), added


def _plus_reversed(suspect: Suspect) -> RecognisedMistake | None:
    counter = counter_in(suspect)
    for node in counter.set if counter is not None else ():
        if isinstance(node.value, ast.UnaryOp) and isinstance(node.value.op, ast.UAdd):
            return suspect.finding("plus_reversed", node, name=counter.name if counter else "")
    return None


def _reset(suspect: Suspect) -> RecognisedMistake | None:
    """A line of the callback, in no branch, sets the counter to a number in each call."""
    counter, callback = counter_in(suspect), suspect.source.callback
    for node in counter.set if counter is not None else ():
        around = suspect.source.function_around(node)
        if not isinstance(node.value, ast.Constant) or counter is None or around is None:
            continue
        if _is_in_branch(suspect, node) or declares(around, counter.name):
            continue
        value = str(node.value.value)[:40]
        found = suspect.finding("counter_reset", node, name=counter.name, value=value)
        words = {**found.words, "function": around.name}
        if "." not in counter.name:
            own = around in suspect.source.own_methods
            return replace(found, words=words, variant="local") if own else None
        if around is not callback:
            return replace(found, words=words, variant="helper")
        first = starts_of(suspect.source).get(counter.name)
        there = first is not None and first.lineno != node.lineno
        words["first"] = str(first.lineno) if first is not None else ""
        return replace(found, words=words, variant="there" if there else "")
    return None


def _is_in_branch(suspect: Suspect, node: ast.stmt) -> bool:
    """Whether a statement is in a block of its function: under an if, in a loop or in a try."""
    return isinstance(suspect.source.module_of(node).parents.get(node), BRANCHES)


def _wrapped(suspect: Suspect) -> RecognisedMistake | None:
    """The counter starts again: by the rest of a division, or under an if."""
    found, counter = wrapped_at(suspect.source), counter_in(suspect)
    numbers = [int(n[-1]) for n in map(NUMBER.findall, suspect.lines) if n]
    if found is None or counter is None or numbers == sorted(numbers):
        return None
    at, limit = found
    if isinstance(at, ast.Assign) and isinstance(at.value, ast.Constant):
        return replace(suspect.finding("counter_reset", at, name=counter.name), variant="if")
    rest = at.value if isinstance(at, ast.Assign) else at
    if not isinstance(rest, ast.BinOp):
        return None
    code = suspect.source.module_of(at).text.code
    name, written = code(rest), code(rest.left).removeprefix("(").removesuffix(")")
    mistake = suspect.finding("counter_reset", at, name=name, written=written)
    return replace(mistake, words={**mistake.words, "form": str(limit)}, variant="modulo")


def _not_increased(suspect: Suspect) -> RecognisedMistake | None:
    counter, source = counter_in(suspect), suspect.source
    if counter is None or counter.added or plain_start(source, counter.name) is None:
        return None
    if any(not _is_in_branch(suspect, node) for node in counter.set):
        return None
    if _changes_elsewhere(suspect, counter.name):
        return None
    parts = parts_of_callback(source)
    if any(_is_misspelt_step(source, node) for part in parts for node in ast.walk(part)):
        return None
    nothing = without_effect(source)
    if nothing is not None:
        at, name = nothing
        code = source.module_of(at).text.code(at)
        written = f"{name} += {suspect.output.step}"
        found = suspect.finding("counter_not_increased", at, name=code, written=written)
        return replace(found, words={**found.words, "attribute": name}, variant="nothing")
    around = source.function_around(counter.logged)
    statement = source.module_of(counter.logged).parents.get(counter.logged)
    if around is None or not isinstance(statement, ast.Expr) or _is_in_branch(suspect, statement):
        return None
    found = suspect.finding("counter_not_increased", counter.logged, name=counter.name)
    word = outer_word(source, around, counter.name)
    if not word or declares(around, counter.name):
        return found
    words = {**found.words, "word": word, "function": around.name}
    return replace(found, words=words, variant="outer")


def _is_misspelt_step(source: NodeSource, node: ast.AST) -> bool:
    """Whether a statement adds to an attribute that nothing sets: it raises an error, hidden or not."""
    name = own_name(node.target) if isinstance(node, ast.AugAssign) else ""
    return bool(name) and is_never_set(source, name)


def _changes_elsewhere(suspect: Suspect, name: str) -> bool:
    """Whether a sum is assigned to the counter, or to an attribute of its name of another object."""
    source = suspect.source
    own = set(source.own_nodes)
    for node in source.all_nodes:
        value = node.value if isinstance(node, ast.Assign) else None
        if not isinstance(node, ast.AugAssign) and not isinstance(value, ast.BinOp):
            continue
        same = [n for n in targets_of(node) if last_part(n) == last_part(name)]
        if same and (node in own or not same[0].startswith("self.")):
            return True
    return False


def _adds_twice(suspect: Suspect) -> RecognisedMistake | None:
    """Two lines of the callback, in no branch, add to the counter."""
    counter, step = counter_in(suspect), suspect.output.step
    if counter is None or plain_start(suspect.source, counter.name) is None:
        return None
    plain = [
        isinstance(node.op, SUM) and not _is_in_branch(suspect, node) for node in counter.added
    ]
    if len(plain) < 2 or not all(plain):
        return None
    return suspect.finding("adds_twice", counter.added[1], name=counter.name, step=step)


def _other_step(suspect: Suspect) -> RecognisedMistake | None:
    counter, step = counter_in(suspect), suspect.output.step
    if counter is None or plain_start(suspect.source, counter.name) is None:
        return None
    for node in counter.added:
        value = node.value.value if isinstance(node.value, ast.Constant) else None
        if not isinstance(node.op, SUM) or not isinstance(value, int | float):
            continue
        if not isinstance(node.op, ast.Add) or value != step:
            return suspect.finding("other_step", node, name=counter.name, step=step)
    return None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "step_is_text",
        "counter",
        msg("A string is added to the counter"),
        msg("A number in quotes is a string, and Python cannot add a string to a number."),
        msg("Write {name} += {step}, without quotes."),
        links.PYTHON_CLASSES,
        seen=r"TypeError: unsupported operand type\(s\) for \+=: '(?:int|float)' and 'str'",
        raised={
            r"unsupported operand type\(s\) for \+=?: '(?:int|float)' and 'str'": _step_is_text
        },
        fixed_by=(node_count.number_step,),
        examples=(
            example(
                "step_is_text_in_sum",
                Replace(NODE, "self.counter_ += 1", "self.counter_ = self.counter_ + '1'"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "step_is_text",
                Replace(NODE, "self.counter_ += 1", "self.counter_ += '1'"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "plus_reversed",
        "counter",
        msg("=+ is written instead of +="),
        msg("x =+ 1 sets x to +1; x += 1 adds one to it."),
        msg("Write {name} += {step}"),
        links.PYTHON_CLASSES,
        behind={"run.constant_counter": _plus_reversed, "run.wrong_step": _plus_reversed},
        fixed_by=(node_count.plus,),
        examples=(
            example(
                "plus_reversed_below_a_slow_timer",
                Replace(NODE, "create_timer(1.0,", "create_timer(10,"),
                Replace(NODE, "self.counter_ += 1", "self.counter_ =+ 1"),
                fails="run.output",
                also={"run.period": "run.wrong_period"},
                note="the third line shows it, after 30 s of ROS time",
            ),
            example(
                "counter_plus_is_plus",
                Replace(NODE, "self.counter_ += 1", "self.counter_ =+ 1"),
                fails="run.output",
                note="0, 1, 1, 1: =+ for +=",
            ),
        ),
    ),
    _node(
        "counter_reset",
        "counter",
        msg("The callback resets the counter"),
        msg(
            "A value that the callback sets is set again in each call. The first value belongs "
            "in __init__."
        ),
        msg("Move {name} = {value} to __init__."),
        whys={
            "local": msg(
                "{name} is a variable of {function}: each call creates it again, with the value "
                "{value}. Only an attribute (self.…) keeps its value from one call to the next."
            ),
            "if": msg("Each time the condition above this line is true, {name} starts again."),
            "helper": msg(
                "{callback} calls {function}, and each call sets {name} to {value} again."
            ),
            "modulo": msg(
                "% {form} gives the rest of a division by {form}: after the numbers below {form} comes "
                "0 again."
            ),
        },
        fixes={
            "local": msg(
                "Write self.{name} = {value} in __init__ instead of this line, and self.{name} "
                "instead of {name} in {function}."
            ),
            "if": msg("Delete this line: the counter never starts again."),
            "there": msg("Delete this line: line {first} sets {name} already."),
            "helper": msg(
                "Set {name} only once: __init__ may do it, or call {function}, but {callback} must "
                "not. Delete the call of {function} from {callback}, or the line that sets {name} "
                "if {function} has other work to do for {callback}."
            ),
            "modulo": INSTEAD,
        },
        deletes=("", "local", "if", "there"),
        behind={"run.constant_counter": _reset, "run.wrong_step": _wrapped},
        fixed_by=(lines.written, node_count.moved),
        examples=(
            example(
                "counter_reset",
                Replace(
                    NODE,
                    "self.get_logger().info('Hello time: ' + str(self.counter_))",
                    (
                        "self.counter_ = 0\n"
                        "        self.get_logger().info('Hello time: ' + str(self.counter_))"
                    ),
                ),
                fails="run.output",
            ),
            example(
                "counter_starts_again",
                Replace(
                    NODE,
                    "self.counter_ += 1",
                    "self.counter_ += 1\n"
                    "        if self.counter_ == 5:\n"
                    "            self.counter_ = 0",
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "counter_not_increased",
        "counter",
        msg("Nothing is added to the counter"),
        msg("The callback logs the counter; without += every line shows the same number."),
        msg("Add to the callback, after the log line: {name} += {step}"),
        whys={
            "nothing": msg(
                "{name} works out a value and keeps it nowhere, so {attribute} stays as it is."
            )
        },
        fixes={
            "nothing": INSTEAD,
            "outer": msg(
                "Write {word} {name} as the first line of {function}, and after the log line: "
                "{name} += {step}"
            ),
        },
        behind={"run.constant_counter": _not_increased},
        fixed_by=(lines.written, node_count.step),
        examples=(
            example(
                "counter_constant",
                Replace(NODE, "        self.counter_ += 1\n", ""),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "adds_twice",
        "counter",
        msg("The counter is increased more than once in the callback"),
        msg("Each += counts."),
        msg("Keep only one {name} += {step}."),
        behind={"run.wrong_step": _adds_twice},
        fixed_by=(node_count.twice, lines.deleted),
        deletes=("",),
        examples=(
            example(
                "adds_twice",
                Replace(
                    NODE, "self.counter_ += 1", "self.counter_ += 1\n        self.counter_ += 1"
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "other_step",
        "counter",
        msg("A different number is added to the counter"),
        msg("The number after += is what each line increases by."),
        msg("Write {name} += {step}"),
        behind={"run.wrong_step": _other_step},
        fixed_by=(node_count.by,),
        examples=(
            example(
                "counts_by_two",
                Replace(NODE, "self.counter_ += 1", "self.counter_ += 2"),
                fails="run.output",
            ),
            example(
                "counts_down",
                Replace(NODE, "self.counter_ += 1", "self.counter_ -= 1"),
                fails="run.output",
            ),
        ),
    ),
)
