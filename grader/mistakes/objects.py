"""Mistakes in what stands at a place: a module for a class, a text for a node, a name of Node's."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.constructor import lines_of
from grader.mistakes.example import DEAD, NODE, STEP_LINE, example
from grader.mistakes.fixes import lines, node_objects
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, on_line
from grader.mistakes.scope import NODE_METHODS
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.imported import full_name
from grader.package.source.module import Function
from grader.package.source.names import called_name, dotted, last_part, own_name
from grader.package.source.node_here import node_here
from grader.package.source.place import statement_at

NO_BASE = (
    r"TypeError: (?:module|str|int)\(\) takes at most|metaclass conflict|argument: 'node_name'"
    r"|module 'rclpy(?:\.node)?' has no attribute '[Nn]ode'"
)
NO_SETTER = (
    r"property '(?P<name>\w{1,120})' of '\w{1,120}' object has no setter"
    r"|can't set attribute '(?P<old>\w{1,120})'|(?P<only>handle) cannot be modified after"
)
IN_NODE = (
    r"AttributeError: '\w{1,120}' object has no attribute "
    r"'(?:add_node|append|remove|handle|get_child|now|clock|wake)'"
    r"|'(?!RcutilsLogger)\w{1,120}' object is not callable$"
)
BUILTINS = ("int", "float", "str", "list", "dict", "Timer", "Publisher", "NoneType")
"""The types of what a class sets most often."""
OF_NODE = (
    *("executor", "_executor", "_timers", "_clients", "_publishers", "_subscriptions", "_services"),
    *("_logger", "_clock", "_handle", "_context", "_parameters", "_default_callback_group"),
)
"""What Node keeps for itself under names that a class can set."""
OWN_METHOD = r"TypeError: \w{1,120}\.(?P<name>\w{1,120})\(\) (?:takes|missing|got)"
NOT_A_NODE = r"'(?P<type>\w{1,120})' object has no attribute '(?:executor|handle|context)'"
NOT_A_NUMBER = (
    r"can only concatenate (?:tuple|list) \(not \"int\"\)"
    r"|unsupported operand type\(s\) for [+-]=?: '(?!str)\w{1,120}' and '(?:int|float)'"
)
NOT_CALLABLE = (
    r"TypeError: (?:'(?P<type>\w{1,120})' object is not callable|.{1,60} is not a callable object)"
    r"|UnboundLocalError: .{0,60}'arg_name'"  # kilted's rclpy, of a callback like 0 or None
)
METHOD_AS_VALUE = (
    r"unsupported operand type\(s\) for .{1,3}: '(?P<type>method)' and"
    r"|can only concatenate str \(not \"(?P<added>method)\"\)"
)


def _no_base(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The base in the line of a class is a module, or an object that a call makes."""
    del match
    for found in raised.module.classes:
        for base in found.bases:
            called = isinstance(base, ast.Call) and last_part(dotted(base.func)) == "Node"
            if raised.line not in (found.lineno, base.lineno):
                continue
            if not called and not _is_module(raised, base):
                continue
            name = raised.module.text.code(base)
            mistake = raised.finding("base_not_class", at=base, name=name, written="Node")
            known = "Node" in raised.module.imports
            return replace(mistake, variant="imported" if known else "")
    return None


def _is_module(raised: Raised, base: ast.expr) -> bool:
    name, modules = dotted(base), {"rclpy", "rclpy.node", "rclpy.Node"}
    if full_name(raised.module, base) in modules:
        return True
    for node in raised.module.nodes:
        if isinstance(node, ast.ImportFrom) and node.module == "rclpy":
            modules |= {a.asname or a.name for a in node.names if a.name.islower()}
    return name in modules


def _not_spun(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The call of spin that fails gets something that is no node."""
    del match
    variables = sorted(raised.source.node_variables)
    for call, name in raised.source.calls:
        if last_part(name) not in ("spin", "spin_once") or raised.line not in lines_of(call):
            continue
        given = call.args[0] if call.args else None
        if given is None or dotted(given) in variables:
            continue
        code = raised.module.text.code(given)
        node = node_here(raised.source, raised.module, raised.line)
        if node and not _is_seen_by(raised, call, node):
            return None  # (a variable of another function)
        if not node and not isinstance(given, ast.Constant):
            return None  # (what it is has to be followed)
        if not node:
            return replace(raised.finding("spin_of_other", at=call), variant="no_variable")
        return raised.finding("spin_of_other", at=call, name=code, written=node)
    return None


def _is_seen_by(raised: Raised, call: ast.Call, name: str) -> bool:
    """Whether a name is known in the function that has a call, or in the file."""
    function = raised.source.function_around(call)
    inside = list(ast.walk(function)) if function is not None else []
    passed = any(isinstance(n, ast.arg) and n.arg == name for n in inside)
    known = (targets_of(n) for n in (*inside, *raised.module.tree.body))
    return "." in name or passed or any(name in names for names in known)


def _name_not_text(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The call of super().__init__ that fails gets something that is no text."""
    del match
    call = raised.source.super_init
    if call is None or raised.line not in lines_of(call) or len(call.args) != 1:
        return None
    if dotted(call.args[0]) == "self":
        return None
    code = raised.module.text.code(call.args[0])
    return raised.finding(
        "name_not_text", at=call, name=code, written=repr(raised.assignment.node_name)
    )


def _callback_text(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A timer gets the name of its callback in quotes."""
    del match
    for timer in raised.source.timers:
        given = timer.callback
        if not isinstance(given, ast.Constant) or not isinstance(given.value, str):
            continue
        name = given.value.removesuffix("()").removeprefix("self.")
        if name not in raised.source.methods:
            continue
        code = raised.source.module_of(given).text.code(given)
        return raised.finding("callback_text", at=timer.call, name=code, written=f"self.{name}")
    return None


def _taken(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The class sets an attribute, or has a method, with the name of one of Node's."""
    given = match.groupdict()
    name = given.get("name") or given.get("old") or given.get("only") or "get_logger"
    method = raised.source.methods.get(name)
    if method is not None:
        if name not in node_objects.METHODS:
            return None
        return _own_method(raised, method, name)
    for part in raised.source.own_nodes:
        stored = isinstance(part, ast.Attribute) and isinstance(part.ctx, ast.Store)
        if stored and isinstance(part, ast.Attribute) and own_name(part) == name:
            found = raised.finding("name_taken", at=part, name=name, written=f"{name}_")
            return replace(found, variant="property") if name in given.values() else found
    return None


def _taken_inside(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The class sets what the methods of Node work with, or one of these methods."""
    used = {
        own_name(part)
        for part in ast.walk(statement_at(raised.module, raised.line) or raised.module.tree)
    }
    called = match.string.endswith("is not callable")
    own = re.search(r"AttributeError: '(\w{1,120})' object", match.string)
    if own is not None and own[1] not in (*BUILTINS, *raised.source.classes_by_name):
        return None
    for part in raised.source.own_nodes:
        name = own_name(part) if isinstance(part, ast.Attribute) else ""
        if not isinstance(part, ast.Attribute) or not isinstance(part.ctx, ast.Store):
            continue
        if (called and name in used & {*NODE_METHODS}) or (not called and name in OF_NODE):
            return raised.finding("name_taken", at=part, name=name, written=f"{name}_")
    return None


def _own_method(raised: Raised, method: Function, name: str) -> RecognisedMistake:
    """Return that a method has the name of one of Node's."""
    found = raised.finding("name_taken", at=method, name=name, written=f"my_{name}")
    timed = any(own_name(timer.callback) == name for timer in raised.source.timers)
    return replace(found, variant="method" if timed else "method_only")


def _shares_name(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A method that the line or the timer uses has the name of an attribute."""
    source, statement = raised.source, statement_at(raised.module, raised.line)
    passed = [own_name(timer.callback) for timer in source.timers]
    used = [own_name(part) for part in ast.walk(statement)] if statement is not None else []
    for name in dict.fromkeys([*used, *passed]):
        method = source.method(name) if name else None
        values = [n for n in source.own_nodes if f"self.{name}" in targets_of(n)]
        at = next((n for n in values if _explains(n, match["type"])), None)
        if method is None or method.decorator_list or not isinstance(at, ast.stmt):
            continue
        new = node_objects.NEW_CALLBACK if name in passed else f"{name.rstrip('_')}_value"
        line = str(at.lineno)
        found = raised.finding("name_shared", at=method, name=name, line=line, written=new)
        return replace(found, variant="" if name in passed else "attribute")
    return None


def _explains(statement: ast.AST, kind: str | None) -> bool:
    """Whether what an attribute gets can be of the type that an error names."""
    value = getattr(statement, "value", None)
    if isinstance(value, ast.Constant) and isinstance(statement, ast.Assign):
        return kind in (type(value.value).__name__, "method", None)
    if isinstance(value, ast.Call) and called_name(value) == "create_timer":
        return kind == "Timer"
    return value is not None


def _not_a_number(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line that fails adds to an attribute that __init__ sets to something else."""
    del match
    statement = statement_at(raised.module, raised.line)
    init = raised.source.method("__init__")
    for part in ast.walk(statement) if statement is not None else ():
        name = dotted(part)
        part_of = isinstance(raised.module.parents.get(part), ast.Subscript | ast.Attribute)
        if not name.startswith("self.") or name.count(".") != 1 or part_of:
            continue
        set_here = [n for n in ast.walk(init) if isinstance(n, ast.Assign)] if init else []
        starts = [n for n in set_here if name in targets_of(n)]
        if starts:
            return _start_of(raised, name, starts[-1])
    return None


def _start_of(raised: Raised, name: str, start: ast.Assign) -> RecognisedMistake | None:
    value = start.value
    number = isinstance(value, ast.Constant) and type(value.value) in (int, float)
    if number or isinstance(value, ast.Call):
        return None
    code = raised.source.module_of(value).text.code(value)
    params = {"name": code, "written": str(raised.assignment.output.start), "attribute": name}
    found = raised.finding("counter_not_number", at=start, params=params)
    return replace(found, variant="comma" if isinstance(value, ast.Tuple) else "")


_node = Family("node", links.PYTHON_CLASSES)
INSTEAD = msg("Write {written} instead of {name}.")
KINDS = (
    _node(
        "base_not_class",
        "class",
        msg("The class inherits from something that is not a class"),
        msg(
            "The brackets of a class line contain the name of the base class. {name} is not a "
            "class: the class Node is in the module rclpy.node."
        ),
        msg(
            "Write {written} instead of {name}, and import it at the top of the file: from "
            "rclpy.node import Node"
        ),
        links.NODES,
        fixes={
            "imported": INSTEAD,
        },
        raised={NO_BASE: _no_base},
        fixed_by=(node_objects.base,),
        examples=(
            example(
                "base_is_module",
                Replace(NODE, "from rclpy.node import Node", "from rclpy import node"),
                Replace(NODE, "(Node)", "(node)"),
                fails="run.starts",
            ),
            example("base_is_package", Replace(NODE, "(Node)", "(rclpy)"), fails="run.starts"),
            example(
                "base_of_rclpy",
                Replace(NODE, "from rclpy.node import Node\n", ""),
                Replace(NODE, "(Node)", "(rclpy.Node)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "spin_of_other",
        "spin",
        msg("rclpy.spin gets something that is not the node"),
        msg("spin needs the node that was created."),
        INSTEAD,
        links.EXECUTORS,
        fixes={
            "no_variable": msg(
                "spin needs a name for the node: write node = before the call that creates the node, and "
                "node into the () of spin."
            )
        },
        raised={
            NOT_A_NODE: _not_spun,
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "spin_of_name_of_a_node_without_variable",
                Replace(NODE, "node = MyFirstNode()", "MyFirstNode()"),
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin('my_first_node')"),
                Replace(NODE, "        node.destroy_node()\n", ""),
                fails="run.starts",
            ),
            example(
                "spin_of_name",
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin('my_first_node')"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "name_not_text",
        "class",
        msg("The node's name is not a string"),
        msg("super().__init__() takes the node's name as a string, in quotes."),
        msg("Write super().__init__('{node_name}')."),
        links.NODES,
        fixes=dict.fromkeys(("given", "member"), msg("Write {written} instead of {name}.")),
        raised={"incompatible constructor arguments": _name_not_text},
        fixed_by=(lines.written,),
        examples=(
            example(
                "class_for_node_name",
                Replace(NODE, "('my_first_node')", "(MyFirstNode)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "callback_text",
        "timer",
        msg("create_timer gets the callback's name as a string"),
        msg("The timer calls what create_timer gets, and a string cannot be called."),
        msg("Write {written} instead of {name}: the callback itself, without quotes."),
        links.FIRST_NODE,
        raised={"'str' object is not callable|' is not a callable object": _callback_text},
        fixed_by=(lines.written,),
        examples=(
            example(
                "callback_in_quotes",
                Replace(NODE, "self.timer_callback)", "'self.timer_callback')"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "name_taken",
        "class",
        msg("A name that Node uses gets another meaning"),
        msg(
            "Your class inherits {name} from Node. If you define {name} again, your own replaces "
            "the one of Node, which the node needs."
        ),
        msg(
            "Give the attribute another name where it is set, for example self.{name}_ instead of self.{name}."
        ),
        whys={
            "property": msg(
                "Each node has self.{name} already: your class inherits it from Node. ROS keeps its "
                "own value there, and it cannot be set."
            ),
        },
        fixes={
            "property": msg(
                "Use another name for your value, for example self.{name}_, on this line and "
                "wherever you use it."
            ),
            "method": msg(
                "Give your method another name than {name}, here and where the timer gets it."
            ),
            "method_only": msg(
                "Give your method another name, for example {written}. Calls of Node's {name} keep "
                "theirs."
            ),
        },
        raised={
            NO_SETTER: _taken,
            OWN_METHOD: _taken,
            "'RcutilsLogger' object is not callable": _taken,
            IN_NODE: _taken_inside,
        },
        fixed_by=(
            node_objects.other_attribute,
            node_objects.other_method,
        ),
        examples=(
            example(
                "attribute_timers",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.timers = []"),
                fails="run.starts",
            ),
            example(
                "timer_in_timers",
                Replace(NODE, "self.create_timer", "self.timers = self.create_timer"),
                fails="run.starts",
            ),
            example(
                "attribute_handle",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.handle = 0"),
                fails="run.starts",
            ),
            example(
                "attribute_with_underscore",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self._timers = 0"),
                fails="run.starts",
            ),
            example(
                "get_logger_is_a_number",
                Replace(
                    NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.get_logger = 0"
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "callback_is_create_timer",
                Replace(NODE, "def timer_callback", "def create_timer"),
                Replace(NODE, "self.timer_callback)", "self.create_timer)"),
                fails="run.starts",
            ),
            example(
                "own_create_timer",
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "        self.create_timer()\n\n"
                    "    def create_timer(self):\n"
                    "        self.timer_ = self.create_timer(1.0, self.timer_callback)\n",
                ),
                fails="run.starts",
            ),
            example(
                "logger_for_get_logger",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = 0\n        self.get_logger = self.get_logger()",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "name_shared",
        "class",
        msg("An attribute and a method have the same name"),
        msg(
            "self.{name} can mean only one thing. Line {line} gives a value to self.{name}, so the "
            "method {name} cannot be used under that name."
        ),
        msg(
            "Give the method another name, for example {written}: write def {written}(self): and "
            "pass self.{written} to create_timer."
        ),
        fixes={
            "attribute": msg(
                "Give the attribute another name, for example self.{written}, in line {line} and "
                "where you use its value."
            )
        },
        raised={NOT_CALLABLE: _shares_name, METHOD_AS_VALUE: on_line(_shares_name)},
        fixed_by=(node_objects.shared_method,),
        examples=(
            example(
                "callback_named_as_counter",
                Replace(NODE, "def timer_callback", "def counter_"),
                Replace(NODE, "self.timer_callback)", "self.counter_)"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "method_named_as_counter",
                Replace(NODE, "str(self.counter_)", "str(self.counter_())"),
                Replace(
                    NODE,
                    STEP_LINE,
                    f"{STEP_LINE}\n    def counter_(self):\n        return self.counter_\n",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "counter_not_number",
        "counter",
        msg("The counter does not start as a number"),
        msg("Python can only add a number to a number."),
        msg("Write {written} instead of {name}: {attribute} must start as a number."),
        whys={"comma": msg("A comma after a value makes a tuple, and not a number.")},
        fixes={
            "comma": msg("Remove the comma: write {attribute} = {written}"),
        },
        raised={NOT_A_NUMBER: on_line(_not_a_number)},
        fixed_by=(lines.written,),
        examples=(
            example(
                "counter_is_tuple",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0,"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "counter_is_none",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = None"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
