"""Mistakes of Python that any line can have: names, attributes, calls.

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
from grader.mistakes.alike import is_typo, meant_by
from grader.mistakes.constructor import lines_of
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import (
    lines,
    node_brackets,
    node_constructor,
    node_life,
    node_names,
    node_timer,
    rename,
)
from grader.mistakes.imports import IMPORTS, RCLPY
from grader.mistakes.kind import Family
from grader.mistakes.order import spun_names
from grader.mistakes.recognised import NAME_ERROR, OWN_ATTRIBUTE, Raised, RecognisedMistake, of_self
from grader.mistakes.scope import NODE_METHODS
from grader.package.edit.tree import Replace
from grader.package.source.counter import starts_of, targets_of
from grader.package.source.module import Function, Module
from grader.package.source.names import calls_in, dotted, last_part, own_name
from grader.package.source.node import LOG_METHODS
from grader.package.source.place import function_at, statement_at
from grader.package.source.scopes import bindings, class_of, scope_of, visible_names

ATTRIBUTE = (
    r"AttributeError: (?:module |type object )?'(?P<type>[\w.]{1,200})'(?: object)? has no "
    r"attribute '(?P<name>\w{1,120})'"
)

MISSPELT = 0.85  # how like two names are of which one is the other with a typing mistake

TYPES = {
    "void": "None",
    **dict.fromkeys(("boolean", "Boolean"), "bool"),
    **dict.fromkeys(("string", "char"), "str"),
    **dict.fromkeys(("integer", "Integer", "long", "short", "unsigned"), "int"),
    **dict.fromkeys(("double", "Double"), "float"),
}
"""Types of other languages, and those of Python."""

SET_ELSEWHERE = msg(
    "self.{name} does not exist until a line assigns to it. Line {lines} does so, but had not run "
    "for this object when Python came to this line."
)
SET_IN_METHOD = msg(
    "self.{name} does not exist until a line assigns to it. Line {lines} does so, in the method "
    "{method}, which had not run for this object when Python came to this line."
)
PROPERTY = msg(
    "{method} is a property: it is read without (), so Python passes only self. A property cannot "
    "have another parameter."
)
OF_ROS = ("spin", "spin_once", *NODE_METHODS)
"""Calls of ROS: an error that comes from inside of them is not about their own brackets."""


def _close_attribute(raised: Raised, name: str) -> str:
    return meant_by(name, raised.source.attributes, cutoff=0.75)


def _close_method(raised: Raised, match: re.Match[str]) -> str:
    """Return the method that is meant: of the node, of rclpy or of the logger."""
    name = match["name"]
    if of_self(raised, match):
        if _close_attribute(raised, name) and not _is_only_called(raised, name):
            return ""
        return meant_by(name, {*NODE_METHODS, *raised.source.methods}, cutoff=0.75)
    if match["type"] == "rclpy":
        return meant_by(name, RCLPY, cutoff=0.7)
    if not _is_of_node(raised, match["type"]):
        return ""
    return meant_by(name, (*NODE_METHODS, *LOG_METHODS), cutoff=0.7)


def _is_only_called(raised: Raised, name: str) -> bool:
    """Whether each use of an attribute of self calls it."""
    parents = raised.module.parents
    uses = [n for n in raised.module.nodes if dotted(n) == f"self.{name}"]
    around = [(parents.get(use), use) for use in uses if isinstance(use, ast.Attribute)]
    return bool(around) and all(isinstance(a, ast.Call) and a.func is use for a, use in around)


def _is_of_node(raised: Raised, kind: str) -> bool:
    """Whether an object of this type can have the methods of a node or of a logger."""
    logger = kind.endswith("Logger")
    return logger or kind in ("Node", "super") or kind in raised.source.known_classes


def _is_written(raised: Raised, name: str) -> bool:
    """Whether a file of the student has a name: one that only rclpy writes is not misspelt."""
    return any(name in module.text.text for module in raised.source.modules)


def _method_misspelt(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if not _is_written(raised, match["name"]):
        return None
    close = _close_method(raised, match)
    return raised.finding("method_misspelt", name=match["name"], close=close) if close else None


def _not_set(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if not of_self(raised, match) or match["name"] in raised.module.functions:
        return None
    name, close = match["name"], _close_attribute(raised, match["name"])
    elsewhere = _set_elsewhere(raised, name)
    if elsewhere is not None:
        return elsewhere
    for timer in raised.source.timers:
        if dotted(timer.period or timer.call) == f"self.{name}" and not close:
            period = repr(raised.assignment.output.period)
            found = raised.finding("attribute_not_set", name=f"self.{name}", written=period)
            return replace(found, variant="period", words={**found.words, "name": name})
    for node in raised.source.own_nodes:
        if (
            isinstance(node, ast.AnnAssign)
            and dotted(node.target) == f"self.{name}"
            and not node.value
        ):
            value = raised.module.text.code(node)
            found = raised.finding(
                "attribute_not_set", at=node, name=value, written=_assigned(raised, node)
            )
            return replace(found, variant="annotated", words={**found.words, "attribute": name})
    called = _called(raised, name)
    if called is not None:
        return called
    return _without_value(raised, name, close)


def _without_value(raised: Raised, name: str, close: str) -> RecognisedMistake:
    """No line sets the attribute: a similar one is meant, or it needs a first value."""
    found = raised.finding("attribute_not_set", name=name, close=close)
    if not close and _is_object(raised, name):
        return replace(found, variant="object")
    owner = _of_helper(raised, name)
    if owner and not close:
        params = {"name": f"self.{name}", "written": f"self.{owner[0]}.{name}"}
        found = raised.finding("attribute_not_set", params=params)
        words = {**found.words, "attribute": owner[0], "type": owner[1]}
        return replace(found, variant="helper", words=words)
    start = node_names.start_of_other_name(raised.source, close)
    if start is not None:
        found = raised.finding("attribute_not_set", at=start, name=close, close=name)
        return replace(found, variant="start")
    if close or node_names.counts(raised.source, name):
        return found
    return replace(found, variant="value")


def _of_helper(raised: Raised, name: str) -> tuple[str, str] | None:
    """Return the attribute with the only object of a helper class that sets the name, and the class."""
    module, source = raised.module, raised.source
    helpers = {
        c.name
        for c in module.classes
        if c not in source.family and any(_sets(module, n, f"self.{name}") for n in ast.walk(c))
    }
    made = [
        (own_name(n.targets[0]), dotted(n.value.func))
        for n in source.own_nodes
        if isinstance(n, ast.Assign) and isinstance(n.value, ast.Call) and own_name(n.targets[0])
    ]
    found = [(attribute, kind) for attribute, kind in made if kind in helpers]
    return found[0] if len(found) == 1 else None


def _set_elsewhere(raised: Raised, name: str) -> RecognisedMistake | None:
    """Lines of the same class set the attribute, but none of them ran before this one."""
    module = raised.module
    here = class_of(module, function_at(module, raised.line))
    sets = [part for part in module.nodes if _sets(module, part, f"self.{name}")]
    owners = [class_of(module, scope_of(module, part)) for part in sets]
    own = {owner[1] for owner in owners if owner is not None and here and owner[0] is here[0]}
    if not sets or here is None or None in owners or len(own) != len({o for o in owners if o}):
        return None
    rows = ", ".join(map(str, sorted({getattr(part, "lineno", 0) for part in sets})))
    found = raised.finding("attribute_not_set", params={"name": name, "lines": rows})
    if len(own) != 1:
        return replace(found, variant="set_here")
    method = own.pop()
    words = {**found.words, "method": method.name}
    if method.name == "__init__":
        return replace(found, variant="set_here")
    if method is here[1]:
        return replace(found, variant="set_again", words=words)
    named = {n.attr for n in raised.source.all_nodes if isinstance(n, ast.Attribute)}
    plain = len(method.args.args) == 1 and not method.decorator_list
    uncalled = method.name not in named and plain and here[0] is raised.source.node_class
    return replace(found, variant="set_by_uncalled" if uncalled else "set_later", words=words)


def _sets(module: Module, part: ast.AST, name: str) -> bool:
    """Whether a part of the file gives a name a value that does not come from itself."""
    if not isinstance(part, ast.Attribute) or not isinstance(part.ctx, ast.Store):
        return False
    around = module.parents.get(part)
    if dotted(part) != name or isinstance(around, ast.AugAssign):
        return False
    value = around.value if isinstance(around, ast.Assign | ast.AnnAssign) else part
    return value is not None and all(dotted(n) != name for n in ast.walk(value) if n is not part)


def _called(raised: Raised, name: str) -> RecognisedMistake | None:
    """The attribute that no line sets is called: a first value in (), or a missing method."""
    module, statement = raised.module, statement_at(raised.module, raised.line)
    calls = [
        n
        for n in (ast.walk(statement) if statement is not None else ())
        if isinstance(n, ast.Call) and dotted(n.func) == f"self.{name}"
    ]
    if len(calls) != 1 or statement is None:
        return None
    call, code = calls[0], module.text.code(calls[0])
    alone = isinstance(statement, ast.Expr) and statement.value is call
    given = call.args[0] if len(call.args) == 1 and not call.keywords else None
    if alone and isinstance(given, ast.Constant) and not _is_only_called(raised, name):
        written = f"self.{name} = {module.text.code(given)}"
        found = raised.finding("attribute_not_set", params={"name": code, "written": written})
        return replace(found, variant="initialiser", words={**found.words, "attribute": name})
    return replace(raised.finding("attribute_not_set", name=name), variant="no_method")


def _assigned(raised: Raised, node: ast.AnnAssign) -> str:
    value = node.annotation.value if isinstance(node.annotation, ast.Constant) else None
    start = value if isinstance(value, int | float) else raised.assignment.output.start
    return f"{dotted(node.target)} = {start}"


def _is_object(raised: Raised, name: str) -> bool:
    """Whether the code uses something of the attribute: a method or another attribute."""
    parents = raised.module.parents
    uses = [n for n in raised.module.nodes if dotted(n) == f"self.{name}"]
    return any(isinstance(parents.get(use), ast.Attribute) for use in uses)


def _undefined(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    name = match["name"]
    statement = statement_at(raised.module, raised.line)
    if isinstance(statement, ast.Expr) and dotted(statement.value) == name:
        return replace(raised.finding("name_unknown", name=name), variant="alone")
    if name in TYPES and (types := _as_type(raised, name)) is not None:
        return types
    timers = [] if bindings(raised.module, name) else raised.source.timers
    if any(dotted(timer.period or timer.call) == name for timer in timers):
        period = repr(raised.assignment.output.period)
        found = raised.finding("name_unknown", name=name, written=period)
        return replace(found, variant="period")
    if (own := _class_for(raised, name)) is not None:
        return _instead(raised.finding("name_unknown", name=name, close=own))
    seen = {*visible_names(raised.module, raised.line, name), *IMPORTS}
    known = (_known(raised, name) & seen) - {name, "None", "True", "False"}
    close = "" if bindings(raised.module, name) else meant_by(name, known, 0.7)
    if isinstance(statement, ast.ClassDef) and close:
        return _instead(raised.finding("name_unknown", name=name, close=close, written=close))
    variables = raised.source.node_variables
    if name in spun_names(raised.source) and len(variables) == 1 and variables < seen - {name}:
        return _instead(raised.finding("name_unknown", name=name, close=min(variables)))
    found = raised.finding("name_unknown", name=name, close=close)
    return _instead(found) if close and nearest(name, [close], cutoff=MISSPELT) else found


def _as_type(raised: Raised, name: str) -> RecognisedMistake | None:
    """A def or a variable has a type of another language: all uses of the name are types."""
    module = raised.module
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    around = [(module.parents.get(use), use) for use in uses]
    types = [
        getattr(a, "annotation", None) is use or getattr(a, "returns", None) is use
        for a, use in around
    ]
    if not uses or not all(types):
        return None
    rows = ", ".join(str(row) for row in sorted({use.lineno for use in uses}))
    found = raised.finding("name_unknown", name=name, close=TYPES[name])
    return replace(found, variant="type", words={**found.words, "lines": rows})


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
        return {*made, *imported, *dir(builtins)}
    return {*(module.names - made), *imported} - {"Node"}


def _is_called(around: ast.AST | None, use: ast.Name) -> bool:
    called = isinstance(around, ast.Call) and around.func is use
    return called or isinstance(around, ast.ClassDef | ast.ExceptHandler)


def _unknown(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    known = _of_rclpy(raised, match)
    if known is not None:
        return known
    if (match["type"], match["name"]) == ("rclpy", "get_logger"):
        call = re.search(
            rf"rclpy\.{match['name']}\([^()]{{0,80}}\)", raised.module.line(raised.line)
        )
        if call is not None:
            found = raised.finding("attribute_unknown", name=call[0], written="self.get_logger()")
            return replace(found, variant="written")
    if match["type"] in ("NoneType", "rclpy"):
        found = raised.finding("attribute_unknown", name=match["name"])
        return replace(found, variant="none" if match["type"] == "NoneType" else "module")
    own = f"self.{match['name']}"
    if match["name"] in raised.module.functions and of_self(raised, match):
        found = raised.finding("attribute_unknown", name=own, written=match["name"])
        return replace(found, variant="function")
    if match["type"] == "Parameter":
        return _of_parameter(raised, match["name"])
    if match["type"] in ("int", "float") and (plain := _number(raised, match["name"])):
        found = raised.finding("attribute_unknown", name=f"{plain}.{match['name']}", written=plain)
        return replace(found, variant="number")
    if match["type"] in raised.source.class_names and match["name"] in raised.source.attributes:
        code = f"{match['type']}.{match['name']}"
        found = raised.finding("attribute_unknown", name=code, written=own)
        return replace(found, variant="written")
    return _similar(raised, match)


def _similar(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    """Python's own suggestion, if it is the same name with a typing mistake."""
    name, kind = match["name"], last_part(match["type"])
    suggested = re.search(r"Did you mean: '(\w{1,120})'", raised.error)
    other = suggested[1] if suggested and _is_written(raised, name) else ""
    if other and is_typo(name, other):
        return raised.finding("attribute_unknown", name=name, close=other)
    found = raised.finding("attribute_unknown", name=name)
    found = replace(found, words={**found.words, "type": kind})
    own = [c for m in raised.source.modules for c in m.classes if c.name == kind]
    if len(own) == 1 and own[0] not in raised.source.family:
        words = {**found.words, "line": str(own[0].lineno)}
        return replace(found, variant="own_class", words=words)
    if other:
        return replace(found, variant="similar", words={**found.words, "other": other})
    return found


def _of_parameter(raised: Raised, name: str) -> RecognisedMistake:
    """What get_parameter returns has .value, and get_parameter_value() for the value's type."""
    typed = name.endswith("_value") and name != "get_value"
    written = f".get_parameter_value().{name}" if typed else ".value"
    found = raised.finding("attribute_unknown", name=f".{name}", written=written)
    if name.lower().startswith("get_param"):
        return raised.finding("attribute_unknown", name=name)
    return replace(found, variant="parameter")


def _number(raised: Raised, attribute: str) -> str:
    """Return what the line reads an attribute of, if it is an attribute of self that counts."""
    statement = statement_at(raised.module, raised.line)
    parts = [n for n in ast.walk(statement) if isinstance(n, ast.Attribute)] if statement else []
    found = {dotted(part.value) for part in parts if part.attr == attribute}
    name = found.pop() if len(found) == 1 else ""
    return name if name in starts_of(raised.source) else ""


def _argument(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    function = last_part(match["function"])
    found = raised.finding("argument_missing", name=match["name"], function=match["function"])
    own = {n.name for n in raised.source.all_nodes if isinstance(n, Function)}
    if match["function"] == "spin":
        return replace(found, variant="spin")
    if (wanted := _wanted(raised, match)) is not None:
        return wanted
    foreign = match["function"].partition(".")[0] not in raised.source.known_classes
    if match["name"] == "self" and "." in match["function"]:
        return replace(found, variant="class")
    if function in own and not foreign:
        return _of_own_method(raised, match) or replace(found, variant="own")
    return found


def _of_own_method(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """An own method or property has a parameter for which no call has a value."""
    source, name, function = raised.source, match["name"], last_part(match["function"])
    method = source.method(function)
    if method is None or name not in [a.arg for a in method.args.args[1:]]:
        return None
    line, where = str(method.lineno), raised.where
    params = {"name": name, "method": function, "line": line}
    used = any(isinstance(n, ast.Name) and n.id == name for n in ast.walk(method))
    calls = [c for c, called in source.calls if last_part(called) == function]
    if [dotted(d) for d in method.decorator_list] in (["property"], ["cached_property"]):
        variant = "property_used" if used else "property"
    elif method.decorator_list:
        return None
    elif used or any(call.args or call.keywords for call in calls):
        here = [call for call in calls if raised.line in lines_of(call)]
        if len(here) != 1:
            return None
        params["called"] = f"{raised.module.text.code(here[0].func)}()"
        found = raised.finding("argument_missing", params=params)
        return replace(found, variant="own_call", where=where)
    else:
        variant = "own_unused"
    if not used:
        params["unused"] = "yes"
    return replace(raised.finding("argument_missing", at=method, params=params), variant=variant)


def _wanted(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The constructor of the node's class wants a value, which is known or which nothing uses."""
    owner, _, function = match["function"].rpartition(".")
    source, name = raised.source, match["name"]
    if function != "__init__" or not source.node_class or owner != source.node_class.name:
        return None
    wanted = node_constructor.wanted_by_constructor(source, raised.assignment, raised.line, name)
    if wanted is None or not (wanted.value or wanted.unused):
        return None
    params = {"name": name, "function": match["function"], "line": str(raised.line or 0)}
    if wanted.unused:
        return replace(
            raised.finding("argument_missing", at=source.methods["__init__"], params=params),
            variant="unused",
        )
    params["written"] = node_constructor.passed(source, wanted)
    return replace(raised.finding("argument_missing", params=params), variant="value")


def _super_of_other(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """super() is given the name that the class had before."""
    name, source, module = match["name"], raised.source, raised.module
    call = node_constructor.super_of(module.nodes, name, raised.line)
    around = [n for n in module.around(call) if isinstance(n, ast.ClassDef)] if call else []
    if call is None or not around or name in {*module.names, *source.known_classes}:
        return None
    row, code = module.line(call.lineno), module.text.code(call)
    written = row.replace(code, "super()") if code in row else "super()"
    params = {"name": name, "type": around[0].name, "line": str(around[0].lineno)}
    return raised.finding("super_of_other_name", at=call, params={**params, "written": written})


def _of_rclpy(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A function of rclpy is called on the node, or __init__ on super() by half its name."""
    name = match["name"]
    if match["type"] == "super" and "init" in name:
        code = re.search(r"super\(\)\.(\w{1,60})", raised.module.line(raised.line))
        found = raised.finding(
            "attribute_unknown", name=code[1] if code else name, written="__init__"
        )
        return replace(found, variant="written")
    if match["type"] not in raised.source.known_classes or name not in ("spin", "spin_once"):
        return None
    for call, called in raised.source.calls:
        before, _, method = called.rpartition(".")
        if method == name and before and before != "rclpy":
            written = f"{called}()"
            new = f"rclpy.{name}({before})"
            found = raised.finding("attribute_unknown", at=call, name=written, written=new)
            return replace(found, variant="written")
    return None


def _value_called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A value is called on that line, or by ROS, to which a timer gave it as a callback."""
    statement = statement_at(raised.module, raised.line)
    calls = [name for _, name in calls_in(statement)] if statement is not None else [""]
    if all(name.startswith("rclpy.") or last_part(name) in OF_ROS for name in calls):
        return _value_passed(raised, match)
    return raised.finding("not_callable", type=match["type"])


def _value_passed(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A timer gets a value instead of a callback."""
    for timer in raised.source.timers:
        if timer.callback is not None and timer.method not in raised.source.methods:
            found = raised.finding("not_callable", at=timer.call, type=match["type"])
            return replace(found, variant="passed")
    return None


def _constant_called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if not re.search(r"\b(?:None|True|False)\s{0,9}\(", raised.module.line(raised.line)):
        return None
    return raised.finding("not_callable", type=match["type"])


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "method_misspelt",
        "class",
        msg("A method or attribute of the node is misspelt"),
        msg("Python finds a method or an attribute only by its exact name."),
        msg("Write {close} instead of {name}."),
        links.RCLPY,
        raised={ATTRIBUTE: _method_misspelt},
        fixed_by=(node_timer.misspelt, rename.attribute),
        examples=(
            example(
                "create_timer_misspelt",
                Replace(NODE, "create_timer", "create_timmer"),
                fails="run.starts",
            ),
            example(
                "logger_misspelt",
                Replace(NODE, "self.get_logger().info", "self.get_loger().info"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "error_at_stop",
                Replace(NODE, "        node.destroy_node()\n", "        node.destroy()\n"),
                fails="run.interrupt",
            ),
        ),
    ),
    _node(
        "attribute_not_set",
        "counter",
        msg("An attribute is read that __init__ did not set"),
        msg("self.{name} does not exist until a line assigns to it."),
        msg("Give it a value in __init__: self.{name} = {start}"),
        links.PYTHON_CLASSES,
        close=msg("Write self.{close} instead of self.{name}."),
        fixes={
            "start": msg(
                "Write self.{close} on that line: the other lines use this name, not self.{name}."
            ),
            "annotated": msg("Write {written} instead of {name}."),
            "period": msg(
                "Write the period in seconds instead of self.{name}: {written}. Or write self.{name} "
                "= {written} above this line."
            ),
            "value": msg(
                "Give it a value in __init__, above the line that creates the timer: self.{name} = "
                "and the value that it has at the beginning."
            ),
            "set_here": msg(
                "See why Python did not run line {lines} before this line: it may be further down, "
                "in a branch or a loop that was not entered, or in a function that was not called. "
                "Move it to where it always runs first, as a rule to the beginning of __init__."
            ),
            "set_again": msg(
                "Set self.{name} in __init__ too, above the line that creates the timer: "
                "self.{name} = and the value that it has at the beginning."
            ),
            "set_later": msg(
                "Set self.{name} in __init__ too, before this line can run, or call {method} "
                "before this line can run."
            ),
            "set_by_uncalled": msg(
                "Write self.{method}() in __init__, before the line that creates the timer, or move "
                "line {lines} to __init__."
            ),
            "initialiser": msg("Write {written} instead of {name}."),
            "helper": msg("Write {written} instead of {name}, here and in the other lines."),
            "no_method": msg(
                "Write def {name}(self): with its lines in the class, write the name of the method "
                "that you mean, or delete the call if it is not needed."
            ),
            "object": msg(
                "Delete this line if it belongs to another example. If the node needs it, create "
                "self.{name} in __init__ first."
            ),
        },
        whys={
            "annotated": msg(
                "A colon after a name only states a type. A value is assigned with =, so "
                "self.{attribute} does not exist yet."
            ),
            "set_here": SET_ELSEWHERE,
            "set_again": SET_ELSEWHERE,
            "set_later": SET_IN_METHOD,
            "set_by_uncalled": msg(
                "self.{name} does not exist until a line assigns to it. Line {lines} does so, in the "
                "method {method}, which no line calls."
            ),
            "initialiser": msg(
                "() behind a name calls it, and self.{attribute} does not exist until a line assigns "
                "to it: with =."
            ),
            "helper": msg(
                "The class {type} sets this attribute, and self.{attribute} is an object of this "
                "class. self is another object."
            ),
            "no_method": msg("self.{name}() calls a method, and the class has no method {name}."),
        },
        raised={OWN_ATTRIBUTE: _not_set},
        fixed_by=(lines.written, node_names.close_attribute, node_names.counter),
        examples=(
            example(
                "period_attribute_not_set",
                Replace(NODE, "create_timer(1.0", "create_timer(self.timer_period"),
                fails="run.starts",
            ),
            example(
                "counter_with_colon",
                Replace(NODE, "self.counter_ = 0", "self.counter_: 0"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "counter_initialised_like_a_member",
                Replace(NODE, "self.counter_ = 0", "self.counter_(0)"),
                fails="run.starts",
            ),
            example(
                "counter_set_by_uncalled_method",
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def setup(self):\n        self.counter_ = 0\n\n    def timer_callback",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "publisher_of_another_example",
                Replace(
                    NODE,
                    "self.counter_ += 1",
                    "self.publisher_.publish(msg)\n        self.counter_ += 1",
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "counter_not_set",
                Replace(NODE, "        self.counter_ = 0\n", ""),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "counter_without_self",
                Replace(NODE, "self.counter_ = 0", "counter_ = 0"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "counter_of_other_name",
                Replace(NODE, "self.counter_ = 0", "self.counter = 0"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "counter_misspelt_in_step",
                Replace(NODE, "self.counter_ += 1", "self.counter_ = self.counter + 1"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "super_of_other_name",
        "start",
        msg("super() names a class that does not exist"),
        msg("The class is called {type} (line {line}). Nothing is called {name}."),
        msg("Write {written}: super() needs no arguments."),
        links.PYTHON_CLASSES,
        raised={NAME_ERROR: _super_of_other},
        fixed_by=(node_constructor.plain_super,),
        examples=(
            example(
                "class_renamed_half",
                Replace(NODE, "class MyFirstNode(Node)", "class HelloTimeNode(Node)"),
                Replace(NODE, "super().__init__", "super(MyFirstNode, self).__init__"),
                Replace(NODE, "node = MyFirstNode()", "node = HelloTimeNode()"),
                fails="run.starts",
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
        links.PYTHON_ERRORS,
        close=msg("Write {close} instead of {name}, or define {name} first."),
        fixes={
            "alone": msg(
                "Delete this line if it was typed by accident: it contains only {name}, which "
                "nothing defines."
            ),
            "period": msg("Write the period in seconds instead of {name}: {written}"),
            "instead": msg("Write {close} instead of {name}."),
            "type": msg("Write {close} instead of {name} in line {lines}."),
        },
        whys={
            "type": msg("{name} is a type of other programming languages. Python has no {name}."),
        },
        seen=r"NameError: name '(?P<name>\w{1,120})' is not defined",
        raised={NAME_ERROR: _undefined},
        fixed_by=(lines.written, rename.variable, lines.deleted_name),
        examples=(
            example(
                "base_in_small_letters",
                Replace(NODE, "class MyFirstNode(Node)", "class MyFirstNode(node)"),
                fails="run.starts",
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
        msg("() after a name calls it, and only functions can be called."),
        msg("Remove the () on that line."),
        links.PYTHON_ERRORS,
        whys={"passed": msg("The timer calls what create_timer gets, which must be a method.")},
        fixes={
            "passed": msg(
                "Pass the name of your method to create_timer: create_timer({period}, "
                "self.{callback})"
            )
        },
        seen=r"TypeError: '(?P<type>int|float|str)' object is not callable",
        raised={
            r"'(?P<type>int|float|str)' object is not callable": _value_called,
            r"TypeError: (?P<type>[\w.'\"-]{1,60}) is not a callable object": _value_passed,
            r"UnboundLocalError: .{0,60}'(?P<type>arg_name)'": _value_passed,
            r"'(?P<type>NoneType|bool)' object is not callable": _constant_called,
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
            example(
                "none_called",
                Replace(
                    NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.last_ = None()"
                ),
                fails="run.starts",
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
            "own": msg("Pass a value for {name} where {function} is called."),
            "own_call": msg(
                "Write a value for {name} in the () of {called} on this line. Or remove {name} from "
                "the def of {method} in line {line}."
            ),
            "own_unused": msg(
                "Remove {name} from the parameters of {method} in this line: no line of {method} "
                "uses it, and no call passes a value."
            ),
            "property": msg(
                "Remove {name} from the parameters of {method} in this line: no line of {method} "
                "uses it."
            ),
            "property_used": msg(
                "Remove {name} from the parameters of {method} in this line, and read what {method} "
                "needs from self. Or delete @property above it, and pass a value in a call: "
                "self.{method}(…)."
            ),
            "class": msg(
                "This line uses the class itself. Create an object of it: write () after the name of "
                "the class where the value comes from."
            ),
            "value": msg("Pass a value for {name}: write {written} in line {line}."),
            "unused": msg(
                "Remove {name} from the parameters in this line: nothing in __init__ uses it, and "
                "line {line} passes no value."
            ),
            "spin": msg("Write rclpy.spin({node}): spin needs the node that was created."),
        },
        whys={
            "property": PROPERTY,
            "property_used": PROPERTY,
            "class": msg(
                "{function} works on an object: Python passes the object as self. Nothing is passed "
                "if the method is called on the class."
            ),
        },
        raised={
            r"TypeError: (?P<function>[\w.]{1,200})\(\) missing \d{1,3} required positional arguments?: '(?P<name>\w{1,120})'": _argument
        },
        fixed_by=(node_life.spin, node_constructor.argument, node_brackets.without_parameter),
        examples=(
            example(
                "init_wants_name",
                Replace(NODE, "def __init__(self)", "def __init__(self, name)"),
                Replace(NODE, "super().__init__('my_first_node')", "super().__init__(name)"),
                fails="run.starts",
            ),
            example(
                "init_wants_more",
                Replace(NODE, "def __init__(self)", "def __init__(self, name)"),
                fails="run.starts",
            ),
            example(
                "property_with_parameter",
                Replace(NODE, "str(self.counter_))", "self.number)"),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    @property\n"
                    "    def number(self, start):\n"
                    "        return str(self.counter_)\n\n"
                    "    def timer_callback",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "class_passed_to_function",
                Replace(
                    NODE,
                    "def main(args=None):",
                    "def run(node):\n    node.get_name()\n    rclpy.spin(node)\n\n\ndef main(args=None):",
                ),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n    except",
                    "        run(MyFirstNode)\n    except",
                ),
                fails="run.starts",
            ),
            example(
                "log_without_text",
                Replace(NODE, ".info('Hello time: ' + str(self.counter_))", ".info()"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "attribute_unknown",
        "callback",
        msg("An object has no attribute with that name"),
        msg(
            "{name} is read from an object behind a dot, and the object on this line has nothing "
            "with this name."
        ),
        msg(
            "Look up what this object can do: in the documentation of its class, or in the class if "
            "it is your own. There may be another name for {name}, or no such thing. Or another "
            "object is meant."
        ),
        links.RCLPY,
        close=msg("Write {close} instead of {name}."),
        whys={
            "function": msg(
                "{written} is a function of the file, and no method of the class. It is called "
                "without self."
            ),
            "parameter": msg(
                "get_parameter returns an object of the type Parameter. Its value is in .value, or in "
                "get_parameter_value()."
            ),
            "number": msg("{written} is a number, and a number has no such attribute."),
            "none": msg(
                "A value on that line is None: nothing was assigned to it, or a function returned "
                "nothing."
            ),
            "module": msg("The module rclpy has nothing with the name {name}."),
        },
        fixes={
            "written": msg("Write {written} instead of {name}."),
            "similar": msg(
                "Look up what a {type} can do. It has the similar name {other}: write that only if "
                "it does what you want."
            ),
            "own_class": msg(
                "Write a name that the class {type} has (line {line}), or let its __init__ set "
                "self.{name}."
            ),
            "function": msg("Write {written} instead of {name}."),
            "parameter": msg("Write {written} instead of {name} behind get_parameter(…)."),
            "number": msg("Write {written} instead of {name}."),
            "none": msg("Find the line that should give it its value, and see what that does."),
            "module": msg(
                "Compare the name with the documentation of rclpy. Many of a node's functions are "
                "methods of the node: self.name(…) in the class."
            ),
        },
        seen=r"AttributeError: (?:'\w{1,120}' object|type object '\w{1,120}'|module "
        r"'[\w.]{1,200}') has no attribute '(?P<name>\w{1,120})'",
        raised={ATTRIBUTE: _unknown},
        fixed_by=(lines.written,),
        examples=(
            example(
                "logger_of_rclpy",
                Replace(NODE, "self.get_logger()", "rclpy.get_logger('my_first_node')"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "class_for_self",
                Replace(NODE, "self.counter_ += 1", "MyFirstNode.counter_ += 1"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "node_spins_itself",
                Replace(NODE, "rclpy.spin(node)", "node.spin()"),
                fails="run.starts",
            ),
            example(
                "init_of_super_half",
                Replace(NODE, "super().__init__(", "super().__init("),
                fails="run.starts",
            ),
        ),
    ),
)
