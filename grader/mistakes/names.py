"""Mistakes of Python that any line can have: names and calls.

These come last: their patterns also match errors that have a more precise cause.
"""

from __future__ import annotations

import ast
import builtins
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.mistakes import links
from grader.mistakes.alike import meant_by
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines, node_life, rename
from grader.mistakes.imports import IMPORTS
from grader.mistakes.kind import Family
from grader.mistakes.order import spun_names
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake
from grader.mistakes.scope import NODE_METHODS
from grader.package.edit.tree import Replace, Write
from grader.package.source.counter import targets_of
from grader.package.source.imported import imports
from grader.package.source.module import Function, Module
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node_here import node_here
from grader.package.source.place import function_at, statement_at
from grader.package.source.scopes import bindings, has_self, visible_names

MISSPELT = 0.85  # how like two names are of which one is the other with a typing mistake


ALONE = ("pass", "return", "break", "continue")
"""Words that are a statement by themselves."""
TYPES = {
    "void": "None",
    **dict.fromkeys(("boolean", "Boolean"), "bool"),
    **dict.fromkeys(("string", "char"), "str"),
    **dict.fromkeys(("integer", "Integer", "long", "short", "unsigned"), "int"),
    **dict.fromkeys(("double", "Double"), "float"),
}
"""Types of other languages, and those of Python."""
NUMBERS_AND_TEXTS = ("bool", "int", "float", "str")


ON_CLASS = msg(
    "{function} works on an object: Python passes the object as self. Nothing is passed if the method "
    "is called on the class."
)


OF_MODULE = ("init", "spin", "spin_once", "ok", "shutdown", "try_shutdown")
"""Functions of rclpy's module, which a file calls through the module."""
OF_ROS = ("spin", "spin_once", *NODE_METHODS)
"""Calls of ROS: an error that comes from inside of them is not about their own brackets."""


def _undefined(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    """Nothing defines the name: tell the one that is meant, if one is like it."""
    name = match["name"]
    statement = statement_at(raised.module, raised.line)
    if isinstance(statement, ast.Expr) and raised.module.line(raised.line) == name:
        return _alone(raised, name)
    ways = (_class_for(raised, name), _of_rclpy(raised.module, name), _as_type(raised, name))
    certain = next(filter(None, ways), None)
    if certain is not None:
        return _instead(raised.finding("name_unknown", name=name, close=certain))
    seen = {*visible_names(raised.module, raised.line, name), *IMPORTS}
    known = (_known(raised, name) & seen) - {name, "None", "True", "False"}
    if bindings(raised.module, name):
        known = {other for other in known if other.lower() == name.lower()}
    known |= {other for other in dir(builtins) if other.lower() == name.lower() != name}
    close = meant_by(name, known, 0.7)
    variables = raised.source.node_variables
    if name in spun_names(raised.source) and len(variables) == 1 and variables < seen - {name}:
        return _instead(raised.finding("name_unknown", name=name, close=min(variables)))
    found = raised.finding("name_unknown", name=name, close=close)
    return _instead(found) if close and nearest(name, [close], cutoff=MISSPELT) else found


def _alone(raised: Raised, name: str) -> RecognisedMistake:
    """The name is the whole statement: a misspelt word, or a slip."""
    word = nearest(name.lower(), ALONE, cutoff=0.7)
    if word:
        return _instead(raised.finding("name_unknown", name=name, close=word, written=word))
    return replace(raised.finding("name_unknown", name=name), variant="alone")


def _of_rclpy(module: Module, name: str) -> str | None:
    """Return a function of rclpy with the name by which the file knows rclpy."""
    known = [bound for bound, full, _ in imports(module) if full == "rclpy"]
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    called = any(isinstance(module.parents.get(use), ast.Call) for use in uses)
    return f"{known[0]}.{name}" if known and called and name in OF_MODULE else None


def _as_type(raised: Raised, name: str) -> str | None:
    """Return the type of Python for that of another language, if all uses of the name are types."""
    module = raised.module
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    around = [(module.parents.get(use), use) for use in uses]
    types = [
        use in (getattr(a, "annotation", None), getattr(a, "returns", None))
        or (isinstance(a, ast.Call) and a.func is use and TYPES.get(name) in NUMBERS_AND_TEXTS)
        for a, use in around
    ]
    return TYPES.get(name) if types and all(types) else None


def _instead(found: RecognisedMistake) -> RecognisedMistake:
    """Ask for the other name alone: it is certain that nothing else was meant."""
    return replace(found, variant="instead")


def _class_for(raised: Raised, name: str) -> str | None:
    """Return the node's class if the unknown name stands where a node is created."""
    source, statement = raised.source, statement_at(raised.module, raised.line)
    value = statement.value if isinstance(statement, ast.Assign | ast.Expr) else None
    made = isinstance(value, ast.Call) and dotted(value.func) == name and not value.args
    if source.node_class is None or not name[:1].isupper() or len(source.family) != 1:
        return None
    made = made and not source.makes_node()
    return source.node_class.name if made or _of_class(raised, name) else None


def _of_class(raised: Raised, name: str) -> bool:
    """Whether everything that is read from the unknown name is set in the node's class."""
    module, source = raised.module, raised.source
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    set_there = {target for s in source.class_body for target in targets_of(s)}
    read = [getattr(module.parents.get(use), "attr", "") for use in uses]
    return bool(read) and set(read) <= set_there


def _known(raised: Raised, name: str) -> set[str]:
    """Return the names that can stand where the unknown one stands.

    What is called, or is a base class or an exception, is a class or a function; anything else
    can be a variable or a module.
    """
    module = raised.module
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    made = {n.name for n in module.nodes if isinstance(n, Function | ast.ClassDef)}
    imported = {*module.imports, *IMPORTS}
    if not uses:
        return {*module.names, *imported, *dir(builtins)}
    if any(_is_called(module.parents.get(use), use) for use in uses):
        modules = {n for n, line in IMPORTS.items() if line.startswith("import ")}
        modules |= {b for b, full, s in imports(module) if isinstance(s, ast.Import) and b == full}
        return {*made, *(imported - modules), *dir(builtins)}
    return {*(module.names - made), *imported} - {"Node"}


def _is_called(around: ast.AST | None, use: ast.Name) -> bool:
    called = isinstance(around, ast.Call) and around.func is use
    return called or isinstance(around, ast.ClassDef | ast.ExceptHandler)


def _argument(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    """A call has too few values: tell for which parameter, and of which function."""
    function, owner = last_part(match["function"]), match["function"].rpartition(".")[0]
    found = raised.finding("argument_missing", name=match["name"], function=match["function"])
    own = {n.name for n in raised.source.all_nodes if isinstance(n, Function)}
    if match["function"] == "spin":
        node = node_here(raised.source, raised.module, raised.line)
        words = {**found.words, "node": node}
        return replace(found, words=words, variant="spin" if node else "spin_nothing")
    names = re.findall(r"'(\w{1,120})'", match["names"])
    if len(names) > 1 and function not in own:
        params = {"name": ", ".join(names), "function": match["function"]}
        return replace(raised.finding("argument_missing", params=params), variant="several")
    if match["function"] == "get_logger" and _in_method(raised):
        found = raised.finding("argument_missing", name="get_logger()", written="self.get_logger()")
        return replace(found, variant="logger", words={**found.words, "function": "get_logger"})
    if owner == "RcutilsLogger":
        return replace(found, words={**found.words, "function": function}, variant="log")
    if match["name"] == "self" and owner and owner in raised.module.line(raised.line):
        return replace(found, variant="class")
    known = function in own and (not owner or owner in raised.source.known_classes)
    return replace(found, variant="own") if known else found


def _in_method(raised: Raised) -> bool:
    """Whether the line is in a method of the node's class."""
    function = function_at(raised.module, raised.line)
    bodies = [s for c in raised.source.family for s in c.body]
    return function is not None and function in bodies and has_self(function)


def _value_called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A value is called on that line, or by ROS, to which a timer gave it as a callback."""
    statement = statement_at(raised.module, raised.line)
    calls = [name for _, name in calls_in(statement)] if statement is not None else [""]
    if all(name.startswith("rclpy.") or last_part(name) in OF_ROS for name in calls):
        return _value_passed(raised, match)
    value = _called_value(raised, calls)
    found = raised.finding("not_callable", type=match["type"], name=value)
    return found if value else replace(found, variant="open")


def _called_value(raised: Raised, calls: list[str]) -> str:
    """Return the only attribute of the node that is called and is no method; "" if there is none."""
    attributes = [own for name in calls if (own := name.removeprefix("self.")) != name]
    source = raised.source
    known = [a for a in attributes if a in source.attributes and a not in source.methods]
    return f"self.{known[0]}" if len(known) == 1 else ""


def _value_passed(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A timer gets a value instead of a callback."""
    for timer in raised.source.timers:
        if timer.callback is not None and timer.method not in raised.source.methods:
            found = raised.finding("not_callable", at=timer.call, type=match["type"])
            return replace(found, variant="passed")
    return None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "name_unknown",
        "callback",
        msg("A name is used that is not defined"),
        msg(
            "Python knows a name only after a line has imported or defined it, and what a function "
            "defines is known only inside of this function. Case matters."
        ),
        msg(
            "Look where {name} is defined. If no line does, write the right name, or import or "
            "define {name} first. If a line does, it must run before this line, and outside of "
            "other functions."
        ),
        links.PYTHON_ERRORS,
        close=msg("Write {close} instead of {name}, or define {name} first."),
        fixes={
            "alone": msg(
                "Delete this line if it was typed by accident: it contains only {name}, which "
                "nothing defines."
            ),
            "instead": msg("Write {close} instead of {name}."),
        },
        seen=r"NameError: name '(?P<name>\w{1,120})' is not defined",
        raised={NAME_ERROR: _undefined},
        fixed_by=(lines.written, rename.variable, lines.deleted_name),
        deletes=("alone",),
        examples=(
            example(
                "unknown_name_alone_in_except",
                Replace(NODE, "        pass\n", "        ignored\n"),
                fails="run.interrupt",
            ),
            example(
                "base_in_small_letters",
                Replace(NODE, "class MyFirstNode(Node)", "class MyFirstNode(node)"),
                fails="run.starts",
            ),
            example(
                "pass_misspelt",
                Replace(
                    NODE,
                    "    except KeyboardInterrupt:\n        pass",
                    "    except KeyboardInterrupt:\n        pas",
                ),
                fails="run.interrupt",
            ),
            example(
                "returns_void",
                Replace(NODE, "def timer_callback(self):", "def timer_callback(self) -> void:"),
                fails="run.starts",
            ),
            example(
                "period_not_defined",
                Replace(NODE, "create_timer(1.0,", "create_timer(timer_period,"),
                fails="run.starts",
            ),
            example(
                "letter_alone",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        s"),
                fails="run.starts",
            ),
            example(
                "class_of_another_example",
                Replace(NODE, "node = MyFirstNode()", "node = MinimalPublisher()"),
                fails="run.starts",
            ),
            example(
                "name_error_in_callback",
                Replace(
                    NODE,
                    "self.get_logger().info('Hello time: ' + str(self.counter_))",
                    "self.get_logger().info('Hello time: ' + string(self.counter_))",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "interrupt_misspelt",
                Replace(NODE, "except KeyboardInterrupt:", "except KeyboardInterupt:"),
                fails="run.interrupt",
            ),
            example(
                "node_of_other_name",
                Replace(NODE, "node = MyFirstNode()", "my_node = MyFirstNode()"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "not_callable",
        "callback",
        msg("A value is called like a function"),
        msg("() after a name calls it, and a value of this type cannot be called."),
        msg("Remove the () after {name}: it is a value, and no function."),
        links.PYTHON_ERRORS,
        whys={
            "passed": msg(
                "The timer calls what create_timer gets, so it must be a method or a function."
            )
        },
        fixes={
            "open": msg(
                "This line calls a value of the type {type}. If the value is meant, remove the () behind "
                "its name. If a function is meant, a line has given its name this value: give the value "
                "another name there."
            ),
            "passed": msg(
                "Pass the name of your method to create_timer: create_timer({period}, "
                "self.{callback})"
            ),
        },
        seen=r"TypeError: '(?P<type>int|float|str)' object is not callable",
        raised={
            r"'(?P<type>int|float|str)' object is not callable": _value_called,
            r"TypeError: (?P<type>[\w.'\"-]{1,60}) is not a callable object": _value_passed,
            r"UnboundLocalError: .{0,60}'(?P<type>arg_name)'": _value_passed,
        },
        examples=(
            example(
                "counter_called",
                Replace(NODE, "str(self.counter_)", "str(self.counter_())"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "timer_gets_counter",
                Replace(NODE, "self.timer_callback)", "self.counter_)"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "argument_missing",
        "callback",
        msg("A call has too few arguments"),
        msg("A parameter without a default needs a value in each call."),
        msg("Write a value for {name} in the () of {function} on this line."),
        links.PYTHON_ERRORS,
        fixes={
            "log": msg("Write the text in the () of {function} on this line: {sum}"),
            "several": msg("Write a value for each of these in the () of {function}: {name}"),
            "own": msg("Pass a value for {name} where {function} is called."),
            "class": msg(
                "This line uses the class itself, and not an object of it. Pass the object, if one was "
                "made before, such as the node. If none was, write () after the name of the class."
            ),
            "logger": msg("Write {written} instead of {name}."),
            "spin": msg("Write rclpy.spin({node}): spin needs the node that was created."),
            "spin_nothing": msg(
                "spin needs the node that was created: write what has it into the () of spin."
            ),
        },
        whys={
            "logger": msg(
                "Without self., get_logger is a function that this file imports, and it needs a name. "
                "The node has a logger of its own."
            ),
            "class": ON_CLASS,
        },
        raised={
            r"TypeError: (?P<function>[\w.]{1,200})\(\) missing \d{1,3} required positional arguments?: (?P<names>'(?P<name>\w{1,120})'.{0,400})": _argument
        },
        fixed_by=(
            node_life.spin,
            lines.written,
        ),
        examples=(
            example(
                "method_called_on_its_class",
                Write(
                    "my_robot_controller/speaker.py",
                    "class Speaker:\n    def words(self, number):\n"
                    "        return 'Hello time: ' + str(number)\n",
                ),
                Replace(
                    NODE,
                    "import rclpy\n",
                    "import rclpy\n\nfrom my_robot_controller.speaker import Speaker\n",
                ),
                Replace(
                    NODE, "'Hello time: ' + str(self.counter_)", "Speaker.words(self.counter_)"
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "init_wants_name",
                Replace(NODE, "def __init__(self)", "def __init__(self, name)"),
                Replace(NODE, "super().__init__('my_first_node')", "super().__init__(name)"),
                fails="run.starts",
            ),
            example(
                "get_logger_of_the_library",
                Replace(
                    NODE,
                    "import rclpy\nfrom",
                    "import rclpy\nfrom rclpy.logging import get_logger\nfrom",
                ),
                Replace(NODE, "self.get_logger()", "get_logger()"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "log_without_text",
                Replace(NODE, ".info('Hello time: ' + str(self.counter_))", ".info()"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
