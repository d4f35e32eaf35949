"""Mistakes in the counter: nothing adds to it, or the function that does takes it for its own variable.

What else goes wrong with a count is told by the lines that make its number (run.py).
"""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import node_count
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.counter import (
    adds_to,
    logged_counter,
    outer_word,
    parts_of_callback,
    starts_of,
    targets_of,
)
from grader.package.source.names import last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import function_at


def _not_increased(suspect: Suspect) -> RecognisedMistake | None:
    """The callback logs a number that it keeps in an attribute, and no line changes that."""
    source, logged = suspect.source, logged_counter(suspect.source)
    if logged is None or logged[1] not in starts_of(source):
        return None
    call, name = logged
    inside = [n for part in parts_of_callback(source) for n in ast.walk(part)]
    adds = any(isinstance(n, ast.AugAssign) for n in inside)  # (perhaps under another name)
    is_line = isinstance(source.module_of(call).parents.get(call), ast.Expr)
    if adds or not is_line or "." not in name or _times_set(source, name) != 1:
        return None
    return suspect.finding("counter_not_increased", call, name=name)


def _times_set(source: NodeSource, name: str) -> int:
    """Return how many lines set an attribute of this name; that of self in a helper is another one."""
    own = set(source.own_nodes)
    nodes = [node for module in source.known_modules for node in module.nodes]
    targets = [(node, target) for node in nodes for target in targets_of(node)]
    same = [pair for pair in targets if last_part(pair[1]) == last_part(name)]
    return sum(node in own or not target.startswith("self.") for node, target in same)


def _local(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A function adds to a name before it gives it a value: one of outside is meant."""
    name, source = match["name"], raised.source
    function = function_at(raised.module, raised.line) or source.callback
    changed = [n for n in ast.walk(function) if name in targets_of(n)] if function else []
    if function is None or not changed or not all(adds_to(n, name) for n in changed):
        return None
    found = raised.finding("counter_local", name=name)
    word = "" if name in source.attributes else outer_word(source, function, name)
    words = {**found.words, "function": function.name, "word": word}
    if word:
        return replace(found, variant="outer", words=words)
    is_method = function in source.methods.values() and bool(function.args.args)
    variant = "set" if name in source.attributes else ""
    return replace(found, words=words, variant=variant) if is_method else None


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "counter_not_increased",
        "counter",
        msg("Nothing is added to the counter"),
        msg("The callback logs the counter; without += every line shows the same number."),
        msg("Add to the callback, after the log line: {name} += {step}"),
        behind={"run.constant_counter": _not_increased},
        fixed_by=(node_count.step,),
        examples=(
            example(
                "counter_constant",
                Replace(NODE, "        self.counter_ += 1\n", ""),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "counter_local",
        "counter",
        msg("A function adds to a variable that it takes for its own"),
        msg(
            "A name that a function assigns to is a variable of that function, which has no value when "
            "this line runs. An attribute (self.…) keeps its value from one callback to the next."
        ),
        msg("Write self.{name} instead of {name} in {function}, and self.{name} = … in __init__."),
        fixes={
            "set": msg("Write self.{name} instead of {name} in {function}."),
            "outer": msg("Write {word} {name} as the first line of {function}."),
        },
        seen=r"UnboundLocalError: .{0,60}'(?P<name>(?!\w{0,60}node)\w{1,120})'",
        raised={r"UnboundLocalError: .{0,60}'(?P<name>\w{1,120})'": _local},
        fixed_by=(node_count.outer, node_count.self_dot),
        examples=(
            example(
                "counter_local",
                Replace(
                    NODE,
                    "self.get_logger().info('Hello time: ' + str(self.counter_))",
                    "self.get_logger().info('Hello time: ' + str(counter_))",
                ),
                Replace(NODE, "self.counter_ += 1", "counter_ += 1"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "counter_not_declared",
                Replace(NODE, "class MyFirstNode", "counter = 0\n\n\nclass MyFirstNode"),
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(NODE, "str(self.counter_)", "str(counter)"),
                Replace(NODE, "self.counter_ += 1", "counter += 1"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
