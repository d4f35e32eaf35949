"""Mistakes with classes and their objects: what main makes, what the timer gets, what replaces what."""

from __future__ import annotations

import ast
import re

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, SILENT, STEP_LINE, example
from grader.mistakes.fixes import node_classes
from grader.mistakes.kind import Family
from grader.mistakes.order import spun_names
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import LOG_METHODS, NodeSource
from grader.package.source.place import function_at

TIMER = "        self.create_timer(1.0, self.timer_callback)\n"
NEEDED = ("create_timer", "__init__", *LOG_METHODS)
"""What a method must call, or else no line comes."""
CALLED_ON_CLASS = (
    r"TypeError: (?P<method>(?:\w{1,120}\.)?\w{1,120})\(\) missing 1 required positional "
    r"argument: 'self'"
)


def _variable(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A method uses the variable by which main knows the node."""
    name, source = match["name"], raised.source
    function = function_at(raised.module, raised.line)
    if (
        function is None
        or function not in source.own_methods
        or not node_classes.has_self(function)
    ):
        return None
    if name not in {"node", *source.node_variables, *spun_names(source)}:
        return None
    own = {c.name for c in source.family}
    made = {
        last_part(dotted(n.value.func))
        for n in source.all_nodes
        if isinstance(n, ast.Assign) and isinstance(n.value, ast.Call) and name in targets_of(n)
    }
    if made and made <= source.known_classes - own:
        return None  # (the object of another class)
    return raised.finding("variable_for_self", name=name)


def _of_class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The timer calls a method of the class without an object."""
    for timer in raised.source.timers:
        written = dotted(timer.callback) if timer.callback is not None else ""
        head, _, name = written.rpartition(".")
        if head in raised.source.class_names and last_part(match["method"]) == name:
            return raised.finding("callback_of_class", at=timer.call, name=written, method=name)
    return None


def _plain(suspect: Suspect) -> RecognisedMistake | None:
    made = node_classes.plain_node(suspect.source)
    if made is None or suspect.source.node_class is None:
        return None
    name = dotted(made.func)
    return suspect.finding("plain_node", made, name=name, made=suspect.source.node_class.name)


def _not_called(suspect: Suspect) -> RecognisedMistake | None:
    for timer in suspect.source.timers:
        body = timer.callback.body if isinstance(timer.callback, ast.Lambda) else None
        name = dotted(body) if body is not None and not isinstance(body, ast.Call) else ""
        if last_part(name) in suspect.source.methods:
            return suspect.finding("lambda_not_called", timer.callback, name=name)
    return None


def _uses(function: Function) -> set[str]:
    """Return what a function calls and assigns to."""
    called = {last_part(name) for _, name in calls_in(function)}
    return called | {name for node in ast.walk(function) for name in targets_of(node)}


def _lost(source: NodeSource, replaced: list[ast.FunctionDef]) -> set[str]:
    """Return what only the replaced definitions do of all that makes a line: timer, log, counter."""
    others = [m for m in source.own_methods if m not in replaced]
    kept = {name for m in others for name in _uses(m)}
    read = {dotted(n) for m in others for n in ast.walk(m) if isinstance(n, ast.Attribute)}
    lost: set[str] = set()
    for method in replaced:
        last = next(m for m in reversed(others) if m.name == method.name)
        lost |= {name for name in _uses(method) - _uses(last) if name in read or name not in kept}
    return {name for name in lost if name in NEEDED or (name.startswith("self.") and name in read)}


def _replaced(suspect: Suspect) -> RecognisedMistake | None:
    """A second definition of a method lacks what the first one does."""
    for found in node_classes.defined_twice(suspect.source):
        if _lost(suspect.source, found[:-1]):
            return _second(suspect, found)
    return None


def _second(suspect: Suspect, found: list[ast.FunctionDef]) -> RecognisedMistake:
    name = found[-1].name
    return suspect.finding("method_twice", found[-1], name=name, line=found[-2].lineno)


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "variable_for_self",
        "class",
        msg("A method uses a variable of another function instead of self"),
        msg(
            "A variable exists only in the function that assigns it. Inside the class, the node "
            "is self."
        ),
        msg("Write self instead of {name}."),
        raised={NAME_ERROR: _variable},
        fixed_by=(node_classes.own_object,),
        examples=(
            example(
                "node_for_self",
                Replace(NODE, TIMER, TIMER.replace("self", "node", 1)),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "callback_of_class",
        "timer",
        msg("create_timer gets the method of the class instead of the node's"),
        msg(
            "Through the class, a method does not know which object it belongs to. Through self, "
            "Python passes self on its own."
        ),
        msg("Write self.{method} instead of {name}."),
        raised={CALLED_ON_CLASS: _of_class},
        fixed_by=(node_classes.own_callback,),
        examples=(
            example(
                "callback_of_the_class",
                Replace(NODE, "self.timer_callback)", "MyFirstNode.timer_callback)"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "plain_node",
        "start",
        msg("The program creates a plain node instead of an object of your class"),
        msg(
            "{name}(…) creates a node without the timer and the callback of your class. Python "
            "runs the code of a class only for its objects."
        ),
        msg("Write {made}() instead of {name}(…)."),
        links.FIRST_NODE,
        behind={"run.no_lines": _plain},
        fixed_by=(node_classes.made,),
        examples=(
            example(
                "plain_node",
                Replace(NODE, "MyFirstNode()", "Node('my_first_node')"),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "lambda_not_called",
        "timer",
        msg("The lambda does not call the callback"),
        msg(
            "The timer calls the lambda. This lambda only returns {name} and does not call it: the "
            "() is missing."
        ),
        msg("Pass the callback itself: write {name} instead of the lambda."),
        links.FIRST_NODE,
        behind={"run.no_lines": _not_called},
        fixed_by=(node_classes.without_lambda,),
        examples=(
            example(
                "lambda_without_call",
                Replace(NODE, "self.timer_callback)", "lambda: self.timer_callback)"),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "method_twice",
        "class",
        msg("A method is defined twice"),
        msg(
            "A class has one method of each name. The second def {name} replaces the first one, "
            "which then never runs."
        ),
        msg(
            "Keep one def {name}: move the lines that you need from one to the other (the first is "
            "in line {line}), and delete the other."
        ),
        behind={
            "run.no_lines": _replaced,
            "run.constant_counter": _replaced,
        },
        fixed_by=(node_classes.second_renamed,),
        examples=(
            example(
                "init_defined_twice",
                Replace(
                    NODE,
                    TIMER,
                    f"{TIMER}\n    def __init__(self):\n        super().__init__('my_first_node')\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "callback_defined_twice",
                Replace(
                    NODE, STEP_LINE, f"{STEP_LINE}\n    def timer_callback(self):\n        pass\n"
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
)
