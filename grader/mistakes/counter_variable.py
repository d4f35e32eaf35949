"""Mistakes in where the counter is kept: a name without self., a variable of the file."""

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
from grader.package.source.counter import adds_to, declares, names_given, outer_word, targets_of
from grader.package.source.module import Function
from grader.package.source.names import called_name, dotted, last_part
from grader.package.source.place import function_at

COUNTER = msg(
    "An attribute (self.…) keeps its value from one callback to the next; a name without self. is "
    "gone when the function ends."
)
OF_OWNER = msg("Write {written} instead of {name} everywhere in {function}.")
UNBOUND = r"UnboundLocalError: .{0,60}'(?P<name>\w{1,120})'"


def _local(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A function adds to a name that it does not set: an attribute is meant."""
    name, function = match["name"], _function(raised)
    if function is None or not _adds(function, name) or _word(raised, function, name):
        return None
    if is_built(raised, function, name):
        return None
    found = raised.finding("counter_local", name=name)
    step = raised.assignment.output.step
    words = {**found.words, "function": function.name, "step": step}
    own, owner = _class_of(raised, function), _owner(raised, function)
    if own is not None and owner != "self":
        of_class = any(name in targets_of(statement) for statement in own.body)
        of_object = owner != own.name and name in raised.source.attributes
        words = {**words, "type": own.name, "written": f"{owner}.{name}"}
        if not of_class and not of_object:
            return None
        return replace(found, words=words, variant="of_class" if of_class else "of_object")
    return replace(found, words=words, variant=_form_of_local(raised, function, name))


def _class_of(raised: Raised, function: Function) -> ast.ClassDef | None:
    around = raised.module.parents.get(function)
    return around if isinstance(around, ast.ClassDef) else None


def _owner(raised: Raised, function: Function) -> str:
    """Return what a method has its class or its object by: self, cls, or the name of the class."""
    own, arguments = _class_of(raised, function), function.args.args
    if own is None:
        return ""
    if not arguments or any(dotted(d) == "staticmethod" for d in function.decorator_list):
        return own.name
    return arguments[0].arg


def _form_of_local(raised: Raised, function: Function, name: str) -> str:
    """Return the variant for a counter without self: what the function has, and what is set."""
    around = raised.module.parents.get(function)
    if not isinstance(around, ast.ClassDef):
        if not isinstance(around, ast.Module):
            return ""
        return "apart" if name in raised.source.attributes else "outside"
    arguments = function.args.args
    if not arguments or arguments[0].arg != "self":
        return ""
    attribute = f"self.{name}"
    own = any(name in targets_of(statement) for statement in around.body)
    if own or any(_sets(n, attribute) for n in ast.walk(around)):
        return "set"
    return "" if function is raised.source.callback else "method"


def _sets(node: ast.AST, name: str) -> bool:
    return isinstance(node, ast.Assign | ast.AnnAssign) and name in targets_of(node)


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
    """Whether a function changes a variable that it never sets to something new."""
    changed = [n for n in ast.walk(function) if name in targets_of(n)]
    return bool(changed) and all(
        isinstance(n, ast.AugAssign) or (isinstance(n, ast.Assign) and _reads(n.value, name))
        for n in changed
    )


def is_built(raised: Raised, function: Function, name: str) -> bool:
    """Whether a function puts a text together, or a sum in a loop: each call has to begin anew.

    That does not hold for the name of an attribute, which may be meant.
    """
    if name in raised.source.attributes:
        return False
    changed = [n for n in ast.walk(function) if name in targets_of(n)]
    loops = (n for n in ast.walk(function) if isinstance(n, ast.For | ast.While))
    inside = {part for loop in loops for part in ast.walk(loop)}
    return any(n in inside or (isinstance(n, ast.stmt) and has_text(n)) for n in changed)


def has_text(statement: ast.stmt) -> bool:
    """Whether one of the parts that a statement adds is a text for certain."""
    value = statement.value if isinstance(statement, ast.Assign | ast.AugAssign) else None
    return value is not None and any(map(_is_text, _parts_of_sum(value)))


def _parts_of_sum(value: ast.expr) -> list[ast.expr]:
    if not isinstance(value, ast.BinOp) or not isinstance(value.op, ast.Add):
        return [value]
    return [*_parts_of_sum(value.left), *_parts_of_sum(value.right)]


def _is_text(value: ast.expr) -> bool:
    made = isinstance(value, ast.Call) and called_name(value) in ("str", "format", "join")
    filled = isinstance(value, ast.BinOp) and isinstance(value.op, ast.Mod) and _is_text(value.left)
    plain = isinstance(value, ast.Constant) and isinstance(value.value, str)
    return made or filled or plain or isinstance(value, ast.JoinedStr)


def _reads(value: ast.expr, name: str) -> bool:
    return any(isinstance(n, ast.Name) and n.id == name for n in ast.walk(value))


def _anew(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a variable of the callback that is shown and counted, and is set anew in each call."""
    source, callback = suspect.source, suspect.source.callback
    logs = source.logs(callback) if callback is not None else []
    if callback is None or len(logs) != 1 or callback not in source.own_methods:
        return None
    changed = [n for n in ast.walk(callback) if isinstance(n, ast.Assign | ast.AugAssign)]
    for name in names_given(logs[0]):
        steps = [n for n in changed if adds_to(n, name)]
        others = [n for n in changed if name in targets_of(n) and n not in steps]
        if "." in name or declares(callback, name) or len(steps) != 1:
            continue
        step = f"self.{name} += {suspect.output.step}"
        mistake = suspect.finding("counts_in_variable", steps[0], name=name)
        words = {**mistake.words, "function": callback.name, "written": step}
        if name in _with_default(callback) and not others:
            if not _is_called_bare(suspect, callback):
                continue
            back = [n for n in ast.walk(callback) if isinstance(n, ast.Return) and n.value]
            if not back:
                return replace(mistake, words=words, variant="default")
            rows = ", ".join(str(n.lineno) for n in back)
            return replace(mistake, words={**words, "line": rows}, variant="default_returned")
        given = others[0].value if len(others) == 1 else None
        if given is not None and "get_parameter" in ast.unparse(given):
            return replace(mistake, words={**words, "line": str(others[0].lineno)})
    return None


def _is_called_bare(suspect: Suspect, callback: Function) -> bool:
    """Whether a timer gets the callback itself, not what gives it values: a lambda or a partial."""
    source = suspect.source
    named = [
        n
        for n in source.all_nodes
        if isinstance(n, ast.Name | ast.Attribute) and last_part(dotted(n)) == callback.name
    ]
    for node in named:
        parents = source.module_of(node).parents
        around = parents.get(node)
        call = parents.get(around) if isinstance(around, ast.keyword) else around
        if not isinstance(call, ast.Call) or called_name(call) != "create_timer":
            return False
    return bool(named)


def _with_default(function: Function) -> set[str]:
    """Return the parameters of a function that have a default value."""
    given = function.args.args
    return {a.arg for a in given[len(given) - len(function.args.defaults) :]}


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "counter_local",
        "counter",
        msg("The counter is used without self."),
        COUNTER,
        msg("Write self.{name} in the callback and in __init__."),
        links.PYTHON_CLASSES,
        whys={
            "of_class": msg(
                "The class {type} sets {name} outside of its functions. A function of the class finds "
                "this variable only with the class or the object in front of it: {written}."
            )
        },
        fixes={
            "of_object": OF_OWNER,
            "of_class": OF_OWNER,
            "set": msg("Write self.{name} instead of {name} in {function}."),
            "method": msg(
                "Write self.{name} instead of {name} in {function}, and self.{name} = 0 in "
                "__init__ of the same class."
            ),
            "apart": msg(
                "{function} is outside of the class and has no self. Write self.{name} += {step} "
                "in {callback} instead of the call of {function}."
            ),
            "outside": msg(
                "Write {name} = 0 below the imports of the file, and global {name} as the first "
                "line of {function}."
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
            example(
                "method_with_this_adds_to_bare_name",
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def add(this):\n        counter_ += 1\n\n    def timer_callback",
                ),
                Replace(NODE, "        self.counter_ += 1", "        self.add()"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "static_method_adds_to_bare_name",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class Ticks:\n    value = 0\n\n    @staticmethod\n    def add():\n"
                    "        value += 1\n\n\nclass MyFirstNode",
                ),
                Replace(NODE, "str(self.counter_)", "str(Ticks.value)"),
                Replace(NODE, "self.counter_ += 1", "Ticks.add()"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "counts_in_variable",
        "counter",
        msg("The number is kept in a variable of the function"),
        msg(
            "{name} is a variable of {function}, and line {line} sets it to the value of the parameter "
            "in each call. Adding to it does not change the parameter of the node."
        ),
        msg(
            "Write self.{name} = {start} in __init__, and delete line {line}. In {function}, write "
            "self.{name} instead of {name} in the log line, and {written} in this line."
        ),
        links.PYTHON_CLASSES,
        whys={
            "default": msg(
                "{name} is a parameter of {function}. The timer gives it no value, so each call begins "
                "with its default value again."
            ),
            "default_returned": msg(
                "{name} is a parameter of {function}. The timer gives it no value, so each call begins "
                "with its default value again. Nobody keeps what {function} returns (line {line})."
            ),
        },
        fixes={
            "default": msg(
                "Write self.{name} = {start} in __init__. In {function}, delete the parameter {name}, "
                "and write self.{name} instead of {name} in the log line, and {written} in this line."
            ),
            "default_returned": msg(
                "Set self.{name} = {start} in __init__, if no line does. In {function}, delete the "
                "parameter {name} and line {line}, and write self.{name} instead of {name} in the log "
                "line, and {written} in this line."
            ),
        },
        behind={"run.constant_counter": _anew},
        examples=(
            example(
                "counts_in_a_default_and_returns_it",
                Replace(NODE, "def timer_callback(self)", "def timer_callback(self, number=0)"),
                Replace(NODE, "str(self.counter_)", "str(number)"),
                Replace(
                    NODE,
                    "        self.counter_ += 1\n",
                    "        number = number + 1\n        return number\n",
                ),
                fails="run.output",
            ),
            example(
                "counts_in_a_default",
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(NODE, "def timer_callback(self)", "def timer_callback(self, number=0)"),
                Replace(NODE, "str(self.counter_)", "str(number)"),
                Replace(NODE, "self.counter_ += 1", "number += 1"),
                fails="run.output",
            ),
            example(
                "counts_beside_a_parameter",
                Replace(NODE, "self.counter_ = 0", "self.declare_parameter('count', 0)"),
                Replace(
                    NODE,
                    "        self.get_logger().info('Hello time: ' + str(self.counter_))",
                    "        number = self.get_parameter('count').value\n"
                    "        self.get_logger().info('Hello time: ' + str(number))",
                ),
                Replace(NODE, "self.counter_ += 1", "number = number + 1"),
                fails="run.output",
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
