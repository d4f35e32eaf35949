"""Mistakes in where the counter is kept: a name without self., a variable of the file."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.counted import has_text
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import node_count
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.counter import adds_to, outer_word, targets_of
from grader.package.source.module import Function
from grader.package.source.place import function_at

UNBOUND = r"UnboundLocalError: .{0,60}'(?P<name>\w{1,120})'"


def _local(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A method of the node adds to a name that it does not set: an attribute is meant."""
    name, function = match["name"], _function(raised)
    if function is None or not _adds(function, name) or _word(raised, function, name):
        return None
    first = [a.arg for a in function.args.args[:1]]
    if function not in raised.source.methods.values() or first != ["self"]:
        return None
    found = raised.finding("counter_local", name=name)
    words = {**found.words, "function": function.name}
    is_set = name in raised.source.attributes or any(
        name in targets_of(statement) for statement in raised.source.class_body
    )
    variant = "set" if is_set else "" if function is raised.source.callback else "method"
    return replace(found, words=words, variant=variant)


def _global(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A function adds to a name that it does not set: a variable of outside is meant."""
    name, function = match["name"], _function(raised)
    word = _word(raised, function, name) if function is not None else ""
    if function is None or not word or not _adds(function, name):
        return None
    return raised.finding("counter_global", name=name, word=word)


def _function(raised: Raised) -> Function | None:
    return function_at(raised.module, raised.line) or raised.source.callback


def _word(raised: Raised, function: Function, name: str) -> str:
    source = raised.source
    return outer_word(source, function, name) if name not in source.attributes else ""


def _adds(function: Function, name: str) -> bool:
    """Whether a function adds only numbers to a variable that it never sets, and not in a loop."""
    changed = [n for n in ast.walk(function) if name in targets_of(n)]
    loops = any(isinstance(n, ast.For | ast.While) for n in ast.walk(function))
    return (
        bool(changed)
        and not loops
        and all(
            isinstance(n, ast.Assign | ast.AugAssign) and adds_to(n, name) and not has_text(n.value)
            for n in changed
        )
    )


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "counter_local",
        "counter",
        msg("The counter is used without self."),
        msg(
            "An attribute (self.…) keeps its value from one callback to the next; a name without self. is "
            "gone when the function ends."
        ),
        msg("Write self.{name} in the callback and in __init__."),
        links.PYTHON_CLASSES,
        fixes={
            "set": msg("Write self.{name} instead of {name} in {function}."),
            "method": msg(
                "Write self.{name} instead of {name} in {function}, and self.{name} = 0 in "
                "__init__ of the same class."
            ),
        },
        seen=r"UnboundLocalError: .{0,60}'(?P<name>(?!\w{0,60}node)\w{1,120})'",
        raised={UNBOUND: _local},
        fixed_by=(node_count.self_dot,),
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
        ),
    ),
    _node(
        "counter_global",
        "counter",
        msg("The function changes an outer variable without declaring it"),
        msg(
            "A name that a function assigns to is a variable of that function, unless the "
            "function declares it."
        ),
        msg("Write {word} {name} as the first line of the function."),
        links.PYTHON_CLASSES,
        raised={UNBOUND: _global},
        fixed_by=(node_count.outer,),
        examples=(
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
