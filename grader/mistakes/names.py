"""Names that have no value: not imported, without self., misspelt, or used too early."""

from __future__ import annotations

import ast
import builtins
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.mistakes import links
from grader.mistakes.alike import meant_by
from grader.mistakes.example import DEAD, INNER, NODE, example
from grader.mistakes.fixes import lines, node_life, node_names, node_order, node_scope, rename
from grader.mistakes.imports import IMPORTS, RCLPY, ROS_1, import_of
from grader.mistakes.kind import Family
from grader.mistakes.order import spun_names
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake
from grader.package.edit.tree import Replace, Write
from grader.package.source.imported import imports
from grader.package.source.module import Function
from grader.package.source.node import NODE_METHODS
from grader.package.source.node_here import node_here
from grader.package.source.place import function_at, method_above
from grader.package.source.scopes import bindings, class_of, has_self, visible_names

ALONE = ("pass", "return", "break", "continue")
"""Words that are a statement by themselves."""
DUNDERS = ("__init__", "__name__", "__main__")
"""The names of Python with two underscores on both sides that a first node has."""


def _unknown(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    """Return what is meant by a name that has no value, the most certain way first."""
    name = match["name"]
    for way in (_self, _of_node, _import, _certain, _close):
        found = way(raised, name)
        if found is not None:
            return found
    return raised.finding("name_unknown", name=name)


def _instead(raised: Raised, name: str, close: str) -> RecognisedMistake:
    """Return that another name is meant for certain."""
    found = raised.finding("name_unknown", name=name, close=close, written=close)
    return replace(found, variant="instead")


def _is_method(raised: Raised, function: Function) -> bool:
    return any(function in found.body for found in raised.module.classes)


def _self(raised: Raised, name: str) -> RecognisedMistake | None:
    """Self is used outside of a method, or in one whose first parameter has another name."""
    if name != "self" or raised.line is None:
        return None
    function = function_at(raised.module, raised.line)
    if function is None:
        method = method_above(raised.module, raised.line)
        found = raised.finding("self_outside", name=method.name if method is not None else "")
        return replace(found, variant="method") if method is not None else found
    first = (*function.args.posonlyargs, *function.args.args)[:1]
    if _is_method(raised, function) and first:
        found = raised.finding("self_outside", at=function, name=first[0].arg, written="self")
        return replace(found, variant="parameter")
    return None


def _import(raised: Raised, name: str) -> RecognisedMistake | None:
    statement = import_of(raised, name)
    return raised.finding("import_missing", name=name, statement=statement) if statement else None


def _of_node(raised: Raised, name: str) -> RecognisedMistake | None:
    """A method or an attribute of the node is meant, or the node itself."""
    source, function = raised.source, function_at(raised.module, raised.line)
    if function is None:
        return None
    inside = _is_method(raised, function) and has_self(function)
    if not inside and name != "self":  # (a function in a method knows its self)
        inside = "self" in visible_names(raised.module, raised.line, name)
    owner = class_of(raised.module, function)
    inside = inside and (owner is None or owner[0] in {*source.family})
    if inside and name in {*NODE_METHODS, *source.methods, *source.attributes}:
        return raised.finding("self_missing", name=name)
    if inside and name in {"node", *source.node_variables, *spun_names(source)}:
        return _instead(raised, name, "self")
    variables = sorted(source.node_variables)
    if len(variables) != 1 or variables[0] not in visible_names(raised.module, raised.line, name):
        return None
    if name == "self":
        return _instead(raised, name, variables[0])
    own = name in {*NODE_METHODS, *source.methods}
    return _instead(raised, name, f"{variables[0]}.{name}") if own else None


def _certain(raised: Raised, name: str) -> RecognisedMistake | None:
    """A word of Python is meant, a text that lacks its quotes, or something of ROS."""
    line, dunder = raised.module.line(raised.line), f"__{name.strip('_')}__"
    word = nearest(name.lower(), ALONE, cutoff=0.7) if line == name else ""
    if name.startswith("_") and dunder in DUNDERS and dunder != name:
        word = dunder
    bound = name in raised.module.names or bindings(raised.module, name)
    if name == "__main__" or (name == raised.assignment.node_name and not bound):
        word = repr(name)
    return _instead(raised, name, word) if word else _of_rclpy(raised, name, line)


def _of_rclpy(raised: Raised, name: str, line: str) -> RecognisedMistake | None:
    """A function of rclpy is called without its module, or one of ROS 1."""
    used = re.search(r"\brospy\.(\w{1,60})", line)
    if name == "rospy" and used is not None:
        node = node_here(raised.source, raised.module, raised.line) or "node"
        new = f"{node}.{ROS_1[used[1]]}" if used[1] in ROS_1 else f"rclpy.{used[1]}"
        return _instead(raised, used[0], new)
    known = [bound for bound, full, _ in imports(raised.module) if full == "rclpy"]
    own = name in raised.module.names or not known or f"{name}(" not in line
    return None if own or name not in RCLPY else _instead(raised, name, f"{known[0]}.{name}")


def _close(raised: Raised, name: str) -> RecognisedMistake | None:
    """A known name is like it, or is the only one that the code can mean."""
    seen = {*visible_names(raised.module, raised.line, name), *IMPORTS}
    known = (_known(raised, name) & seen) - {name, "None", "True", "False"}
    if bindings(raised.module, name):
        known = {other for other in known if other.lower() == name.lower()}
    known |= {other for other in dir(builtins) if other.lower() == name.lower() != name}
    variables = raised.source.node_variables
    if name in spun_names(raised.source) and len(variables) == 1 and variables < seen - {name}:
        return _instead(raised, name, min(variables))
    close = meant_by(name, known, 0.7)
    if not close:
        return None
    if nearest(name, [close], cutoff=0.85):
        return _instead(raised, name, close)
    return raised.finding("name_unknown", name=name, close=close)


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


def _used_before_set(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name, function = match["name"], function_at(raised.module, raised.line)
    later = node_order.set_after_use(function, name) if function is not None else None
    imported = {n.asname or n.name for n in raised.module.nodes if isinstance(n, ast.alias)}
    if function is None or later is None or name in raised.source.attributes or name in imported:
        return None
    use = node_order.first_use(function, name)
    return raised.finding("used_before_set", at=use, name=name, line=str(later.lineno))


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "self_outside",
        "class",
        msg("self is used outside of a method"),
        msg(
            "self is the first parameter of a method and exists only inside it. This line is "
            "outside of every method."
        ),
        msg("Move the line into the method that it belongs to."),
        links.PYTHON_CLASSES,
        whys={
            "parameter": msg(
                "The first parameter of a method is the object, whatever its name is. Here it is "
                "called {name}, so nothing is called self."
            )
        },
        fixes={
            "method": msg(
                "Indent the line as far as the other lines of {name}, the method above it."
            ),
            "parameter": msg("Write self instead of {name} in the brackets of this def."),
        },
        seen=r"NameError: name 'self' is not defined",
        fixed_by=(node_scope.indented, lines.written),
        examples=(
            example(
                "step_outside_callback",
                Replace(NODE, "        self.counter_ += 1\n", "    self.counter_ += 1\n"),
                fails="run.starts",
            ),
            example(
                "self_misspelt",
                Replace(NODE, "def timer_callback(self)", "def timer_callback(slef)"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "self_missing",
        "class",
        msg("self. is missing"),
        msg("Methods and attributes of the node are reached through the node: self.name."),
        msg("Write self.{name} instead of {name}."),
        links.PYTHON_CLASSES,
        fixed_by=(node_scope.self_dot,),
        examples=(
            example(
                "create_timer_without_self",
                Replace(NODE, "self.create_timer", "create_timer"),
                fails="run.starts",
            ),
            example(
                "counter_logged_without_self",
                Replace(NODE, "str(self.counter_)", "str(counter_)"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "import_missing",
        "start",
        msg("A name is used without being imported"),
        msg("Python knows only names that the file imports or defines."),
        msg("Add the import at the top of the file: {statement}"),
        whys={
            "own": msg(
                "{path}, another file of your package, defines {name}. A file knows a name of another file "
                "only after it has imported it."
            )
        },
        fixed_by=(node_life.node_import, node_names.missing_import),
        examples=(
            example(
                "import_of_module_missing",
                Replace(NODE, "self.counter_ += 1", "self.counter_ += 1\n        time.sleep(0.1)"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "function_of_other_file_not_imported",
                Write(f"{INNER}/helpers.py", "def text_of(number):\n    return str(number)\n"),
                Replace(NODE, "str(self.counter_)", "text_of(self.counter_)"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "import_node_missing",
                Replace(NODE, "from rclpy.node import Node\n", ""),
                fails="run.starts",
                note="NameError while the class is defined",
            ),
        ),
    ),
    _node(
        "used_before_set",
        "start",
        msg("A variable is used before it has a value"),
        msg(
            "Python runs the lines of a function from top to bottom, and {name} has no value "
            "until a line gives it one."
        ),
        msg("Move line {line} ({name} = …) above this line."),
        seen=r"UnboundLocalError: .{0,60}'(?P<name>\w{0,60}node\w{0,60})'",
        raised={r"UnboundLocalError: .{0,60}'(?P<name>\w{1,120})'": _used_before_set},
        fixed_by=(node_order.moved_up,),
        examples=(
            example(
                "node_made_after_try",
                Replace(NODE, "    node = MyFirstNode()\n", ""),
                Replace(
                    NODE,
                    "        rclpy.try_shutdown()\n",
                    "        rclpy.try_shutdown()\n    node = MyFirstNode()\n",
                ),
                fails="run.starts",
                note="the finally raises the same error once more",
            ),
        ),
    ),
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
        close=msg("Write {close} instead of {name}, or define {name} first."),
        fixes={"instead": msg("Write {close} instead of {name}.")},
        seen=r"NameError: name '(?P<name>\w{1,120})' is not defined",
        raised={NAME_ERROR: _unknown},
        fixed_by=(rename.variable, lines.written),
        examples=(
            example(
                "base_in_small_letters",
                Replace(NODE, "class MyFirstNode(Node)", "class MyFirstNode(node)"),
                fails="run.starts",
            ),
            example(
                "period_not_defined",
                Replace(NODE, "create_timer(1.0,", "create_timer(timer_period,"),
                fails="run.starts",
            ),
            example(
                "node_name_without_quotes",
                Replace(NODE, "'my_first_node'", "my_first_node"),
                fails="run.starts",
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
)
