"""A decorator that must be called first: without its () it gets the method as its own argument."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import INNER, NODE, SILENT, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace, Write
from grader.package.source.module import Function
from grader.package.source.names import dotted


def _not_called(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a method below the name of a function that returns a decorator."""
    source = suspect.source
    makers = {
        node.name: node
        for module in source.known_modules
        for node in module.tree.body
        if isinstance(node, Function) and _makes_decorator(node)
    }
    for method in source.own_methods:
        for found in method.decorator_list:
            name = dotted(found).rpartition(".")[2]
            if isinstance(found, ast.Name | ast.Attribute) and name in makers:
                code = dotted(found)
                mistake = suspect.finding(
                    "decorator_not_called", found, name=f"@{code}", written=f"@{code}()"
                )
                words = {**mistake.words, "method": method.name, "function": name}
                return replace(mistake, words=words)
    return None


def _makes_decorator(function: Function) -> bool:
    """Whether a function returns an inner function that itself returns an inner function."""
    inner = _returned(function)
    given = [*function.args.args, *function.args.kwonlyargs]
    optional = len(function.args.defaults) + sum(d is not None for d in function.args.kw_defaults)
    return inner is not None and _returned(inner) is not None and optional == len(given)


def _returned(function: Function) -> Function | None:
    """Return the inner function that a function returns by its name."""
    inner = {s.name: s for s in function.body if isinstance(s, Function)}
    names = [dotted(s.value) for s in function.body if isinstance(s, ast.Return) and s.value]
    return inner.get(names[-1]) if names else None


DECORATORS = """\
import functools


def log_errors(reraise=False):
    def decorator(function):
        @functools.wraps(function)
        def wrapper(*args):
            return function(*args)

        return wrapper

    return decorator
"""
_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "decorator_not_called",
        "callback",
        msg("A decorator is not called"),
        msg(
            "{function} is a function that returns a decorator, so it has to be called. Without (), it "
            "gets {method} as its argument, and the lines of {method} never run."
        ),
        msg("Write {written} instead of {name}."),
        behind={"run.no_lines": _not_called},
        fixed_by=(lines.written,),
        examples=(
            example(
                "decorator_without_its_call",
                Write(f"{INNER}/decorators.py", DECORATORS),
                Replace(
                    NODE,
                    "from rclpy.node import Node\n",
                    "from rclpy.node import Node\n\nfrom my_robot_controller.decorators import log_errors\n",
                ),
                Replace(NODE, "    def timer_callback", "    @log_errors\n    def timer_callback"),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
)
