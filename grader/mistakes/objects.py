"""Mistakes in what stands at a place: a module for a class, a text for a node, a name of Node's."""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.constructor import lines_of
from grader.mistakes.example import DEAD, INNER, NODE, SILENT, STEP_LINE, example
from grader.mistakes.fixes import lines, node_objects
from grader.mistakes.kind import Family
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake, Suspect, on_line
from grader.mistakes.scope import NODE_METHODS
from grader.package.edit.tree import Replace, Write
from grader.package.source.counter import starts_of, targets_of
from grader.package.source.imported import full_name, imports, name_of_node
from grader.package.source.module import Function
from grader.package.source.names import (
    called_name,
    dotted,
    is_enum,
    last_part,
    module_name,
    own_name,
)
from grader.package.source.node_here import node_here
from grader.package.source.place import function_at, statement_at

NO_BASE = (
    r"TypeError: (?:module|str|int)\(\) takes at most|metaclass conflict"
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
ALSO_OF_NODE = (
    *("timers", "clients", "services", "publishers", "subscriptions", "guards", "waitables"),
    *("context", "handle", "default_callback_group", "get_parameters", "declare_parameters"),
    *("get_parameter_or", "get_parameters_by_prefix", "set_parameters", "has_parameter"),
    *("undeclare_parameter", "describe_parameter", "describe_parameters", "get_parameter_type"),
    *("get_parameter_types", "destroy_publisher", "destroy_subscription", "destroy_client"),
    *("destroy_service", "destroy_rate", "get_node_names", "get_fully_qualified_name"),
    *("count_publishers", "count_subscribers", "count_clients", "count_services", "add_waitable"),
    *("remove_waitable", "create_guard_condition", "destroy_guard_condition"),
    *("set_parameters_atomically", "add_on_set_parameters_callback", "resolve_topic_name"),
    *("resolve_service_name", "get_topic_names_and_types", "get_service_names_and_types"),
)
"""Attributes and methods of Node that a node seldom uses."""
OWN_METHOD = r"TypeError: \w{1,120}\.(?P<name>\w{1,120})\(\) (?:takes|missing|got)"
NOT_A_NODE = r"'(?P<type>\w{1,120})' object has no attribute '(?:executor|handle|context)'"
NOT_AN_EXECUTOR = (
    r"AttributeError: '(?:int|float|str|NoneType|bool)' object has no attribute "
    r"'(?:add_node|remove_node)'"
)
OWN_IMPORT = r"cannot import name '(?P<name>\w{1,120})' from partially initialized module '(?P<module>[\w.]{1,200})'"
OPERATOR = r"unsupported operand type\(s\) for (?P<name>[-&|^/%@]|//|<<|>>): '(?:str|int|float)' and '(?:str|int|float)'"
SIGNS: Mapping[str, type[ast.operator]] = {
    "&": ast.BitAnd,
    "|": ast.BitOr,
    "^": ast.BitXor,
    "<<": ast.LShift,
    ">>": ast.RShift,
    "@": ast.MatMult,
}
"""Signs that join nothing in Python, with what they are in its syntax tree."""
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
ANY_NAME = r"incompatible constructor arguments|node_name|TypeError"


def _no_base(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The base in the line of a class is a module."""
    del match
    for found in raised.module.classes:
        for base in found.bases:
            name = dotted(base)
            if raised.line not in (found.lineno, base.lineno) or not _is_module(raised, base):
                continue
            imported = _imported_as(raised, found, base)
            if imported is not None:
                return imported
            mistake = raised.finding("base_not_class", at=base, name=name, written="Node")
            known = "Node" in raised.module.imports
            return replace(mistake, variant="imported" if known else "")
    return None


def _imported_as(raised: Raised, found: ast.ClassDef, base: ast.expr) -> RecognisedMistake | None:
    """The base is the module rclpy.node under a name of the student's own, or by its full name."""
    module, name = raised.module, dotted(base)
    statement = next((s for bound, _, s in imports(module) if bound == name), None)
    if full_name(module, base) != "rclpy.node" or not isinstance(
        statement, ast.Import | ast.ImportFrom
    ):
        return None
    parents = module.parents
    uses = [
        n for n in module.nodes if dotted(n) == name and isinstance(n, ast.Name | ast.Attribute)
    ]
    around = [parents.get(use) for use in uses]
    as_module = [n for n in around if isinstance(n, ast.Attribute) and n.attr != "__init__"]
    if len(statement.names) == 1 and name[:1].isupper() and not as_module:
        alias = "" if name == "Node" else f" as {name}"
        code, new = module.text.code(statement), f"from rclpy.node import Node{alias}"
        mistake = raised.finding("base_not_class", at=statement, name=code, written=new)
        words = {**mistake.words, "module": name, "type": found.name}
        return replace(mistake, variant="module", words=words)
    if isinstance(statement, ast.ImportFrom) and statement.names[0].asname is None:
        return None
    known = name_of_node(module)
    written = known if known and not known.startswith(f"{name}.") else f"{name}.Node"
    mistake = raised.finding("base_not_class", at=base, name=name, written=written)
    return replace(mistake, variant="imported")


def _own_base(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A class names itself as its base."""
    for found in raised.module.classes:
        for base in found.bases:
            if dotted(base) == found.name == match["name"] and raised.line == found.lineno:
                mistake = raised.finding("base_not_class", at=base, name=found.name, written="Node")
                return replace(mistake, variant="itself")
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


def _executor_spun(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """rclpy.spin gets an executor that has the node."""
    del match
    calls = [(call, name) for call, name in raised.source.calls if raised.module.has(call)]
    kept = {
        dotted(call.func.value)
        for call, name in calls
        if isinstance(call.func, ast.Attribute) and call.func.attr == "add_node"
    }
    for call, name in calls:
        alone = len(call.args) == 1 and not call.keywords and raised.line in lines_of(call)
        if name == "rclpy.spin" and alone and dotted(call.args[0]) in kept:
            text = raised.module.text
            params = {"name": text.code(call), "written": f"{text.code(call.args[0])}.spin()"}
            return replace(
                raised.finding("spin_of_other", at=call, params=params), variant="executor"
            )
    return None


def _spin_with_more(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The call of spin that fails gets a second value that is no executor."""
    del match
    for call, name in raised.source.calls:
        at = raised.source.module_of(call) is raised.module and raised.line in lines_of(call)
        if not at or name not in ("rclpy.spin", "rclpy.spin_once", "spin", "spin_once"):
            continue
        if len(call.args) != 2 or call.keywords:
            continue
        text = raised.module.text
        new = f"{text.code(call.func)}({text.code(call.args[0])})"
        found = raised.finding("spin_of_other", at=call, name=text.code(call), written=new)
        return replace(found, variant="second")
    return None


def _name_not_text(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The call of super().__init__ that fails gets something that is no text."""
    call = raised.source.super_init
    if call is None or raised.line not in lines_of(call) or not call.args:
        return None
    given = call.args[0]
    text = isinstance(given, ast.Constant | ast.JoinedStr | ast.BinOp | ast.Call)
    typed = "incompatible constructor" in match.string
    if dotted(given) == "self" or (text and not typed) or len(call.args) > 1 or not typed:
        return None
    code = raised.module.text.code(given)
    new = repr(raised.assignment.node_name)
    passed = _passed_name(raised, dotted(given))
    if passed is not None:
        return passed
    owner = dotted(given).rpartition(".")[0]
    for module in raised.source.known_modules:
        for found in module.classes:
            if found.name == owner and is_enum(found):
                params = {"name": code, "written": f"{code}.value"}
                mistake = raised.finding("name_not_text", at=call, params=params)
                return replace(mistake, words={**mistake.words, "type": owner}, variant="member")
    return raised.finding("name_not_text", at=call, name=code, written=new)


def _passed_name(raised: Raised, name: str) -> RecognisedMistake | None:
    """The name is a parameter of __init__, for which the only call gives no text."""
    source, init = raised.source, raised.source.methods.get("__init__")
    parameters = [a.arg for a in init.args.args][1:] if init is not None else []
    calls = [call for call, _ in source.calls if source.is_node_class(call.func)]
    if name not in parameters or len(calls) != 1 or calls[0].keywords:
        return None
    at, text = parameters.index(name), source.module_of(calls[0]).text
    if at >= len(calls[0].args) or _has_more_use(init, name):
        return None
    codes = [text.code(given) for given in calls[0].args]
    texts = [n for n, given in enumerate(calls[0].args) if is_text(given)]
    call, old = text.code(calls[0]), codes[at]
    if len(texts) == 1 and texts[0] != at:
        codes[at], codes[texts[0]] = codes[texts[0]], old
    else:
        codes[at] = repr(raised.assignment.node_name)
    written = f"{text.code(calls[0].func)}({', '.join(codes)})"
    if "\n" in call:
        return None
    params = {"name": call, "written": written}
    found = raised.finding("name_not_text", at=calls[0], params=params)
    words = {**found.words, "parameter": name, "value": old}
    return replace(found, words=words, variant="given")


def _has_more_use(init: Function | None, name: str) -> bool:
    """Whether __init__ uses the parameter for more than the node's name: it has several values."""
    parts = ast.walk(init) if init is not None else ()
    return sum(isinstance(n, ast.Name) and n.id == name for n in parts) > 1


def is_text(given: ast.expr) -> bool:
    """Whether an expression is a text as it is written."""
    return isinstance(given, ast.Constant) and isinstance(given.value, str)


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


def _operator(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A text and something else are joined with another sign than +."""
    statement = statement_at(raised.module, raised.line)
    texts = match["name"] in SIGNS and "'str' and 'str'" in match[0]
    for part in ast.walk(statement) if statement is not None else ():
        if isinstance(part, ast.BinOp) and (_is_text(part.left) or (texts and _is(part, match))):
            return raised.finding("text_operator", at=part, name=match["name"], written="+")
    return None


def _is(part: ast.BinOp, match: re.Match[str]) -> bool:
    """Whether a part of the line is the operation of the error."""
    return isinstance(part.op, SIGNS[match["name"]])


def _is_text(part: ast.expr) -> bool:
    return isinstance(part, ast.Constant) and isinstance(part.value, str)


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


def _own_logger(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a class that gives another value to what get_logger() returns."""
    for module in suspect.source.known_modules:
        for own in (found for found in module.classes if found.bases):
            for part in ast.walk(own):
                stored = isinstance(part, ast.Attribute) and isinstance(part.ctx, ast.Store)
                if stored and isinstance(part, ast.Attribute) and dotted(part) == "self._logger":
                    return suspect.finding("name_taken", part, name="_logger", written="_logger_")
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


def _executor_replaced(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The class gives the node's own property executor something that is no executor of ROS."""
    del match
    statement = statement_at(raised.module, raised.line)
    for part in ast.walk(statement) if statement is not None else ():
        stored = isinstance(part, ast.Attribute) and isinstance(part.ctx, ast.Store)
        if stored and isinstance(part, ast.Attribute) and dotted(part) == "self.executor":
            found = raised.finding("name_taken", at=part, name="executor", written="executor_")
            return replace(found, variant="executor")
    return None


def _hides_property(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A method has the name of what rclpy reads from the node, and the error comes from rclpy."""
    del match
    here = function_at(raised.module, raised.line)
    own = raised.source.methods.get(here.name) if here is not None else None
    started = raised.source.super_init
    replaces = own is here and here is not None and here.name in {*ALSO_OF_NODE, *NODE_METHODS}
    if own is not None and replaces and started is not None and not raised.inside:
        return _own_method(raised, own, own.name)
    for name in node_objects.PROPERTIES if raised.inside else ():
        method = raised.source.methods.get(name)
        decorators = [dotted(one) for one in method.decorator_list] if method is not None else []
        if method is not None and decorators in ([], ["property"]):
            return _own_method(raised, method, name)
    return None


def _own_method(raised: Raised, method: Function, name: str) -> RecognisedMistake:
    """Return that a method has the name of one of Node's: it is a callback, or called."""
    found = raised.finding("name_taken", at=method, name=name, written=f"my_{name}")
    if any(own_name(timer.callback) == name for timer in raised.source.timers):
        return replace(found, variant="method")
    calls = node_objects.calls_of_own(raised.source, name)
    if not calls:
        return replace(found, variant="method_only")
    lines = ", ".join(str(call.lineno) for call in calls)
    return replace(found, variant="method_called", words={**found.words, "line": lines})


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


def _inherited(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line works with a method of Node as if it were a value of the student's."""
    del match
    source, statement = raised.source, statement_at(raised.module, raised.line)
    parts = [n for n in ast.walk(statement) if own_name(n)] if statement is not None else []
    names = {own_name(n) for n in parts} & {*NODE_METHODS, *ALSO_OF_NODE}
    set_here = {t for n in source.own_nodes if isinstance(n, ast.Assign) for t in targets_of(n)}
    names -= {*source.methods, *(name.removeprefix("self.") for name in set_here)}
    called = {
        own_name(n.func) for n in ast.walk(statement or ast.Pass()) if isinstance(n, ast.Call)
    }
    if len(names - called) != 1:
        return None
    name = (names - called).pop()
    counters = sorted(name for name in starts_of(source) if name.startswith("self."))
    if len(counters) == 1:
        found = raised.finding("inherited_method", name=f"self.{name}", written=counters[0])
        return replace(found, variant="counter", words={**found.words, "method": name})
    return raised.finding("inherited_method", params={"name": f"self.{name}", "method": name})


def _explains(statement: ast.AST, kind: str | None) -> bool:
    """Whether what an attribute gets can be of the type that an error names."""
    value = getattr(statement, "value", None)
    if isinstance(value, ast.Constant) and isinstance(statement, ast.Assign):
        return kind in (type(value.value).__name__, "method", None)
    if isinstance(value, ast.Call) and called_name(value) == "create_timer":
        return kind == "Timer"
    return value is not None


def _own_import(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    statement = statement_at(raised.module, raised.line)
    if not isinstance(statement, ast.ImportFrom):
        return None
    own = module_name(raised.module.path)
    if match["module"] != own or last_part(statement.module or "") != last_part(own):
        return None
    return raised.finding("import_own", at=statement, name=match["name"])


def _comma(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    statement = statement_at(raised.module, raised.line)
    target = statement.targets[0] if isinstance(statement, ast.Assign) else None
    names = [dotted(e) for e in target.elts] if isinstance(target, ast.Tuple) else []
    if target is None or len(names) != 2 or names[0] != "self" or "." in names[1]:
        return None
    code = raised.module.text.code(target)
    return raised.finding("comma_for_dot", at=target, name=code, written=f"self.{names[1]}")


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
            return _start_of(raised, name, starts)
    return None


def _start_of(raised: Raised, name: str, starts: list[ast.Assign]) -> RecognisedMistake | None:
    *before, start = starts
    value = start.value
    if isinstance(value, ast.Call):
        if not before:
            return None  # (nothing is overwritten)
        other = "timer_" if called_name(value) == "create_timer" else f"{last_part(name)}_other"
        found = raised.finding("counter_not_number", at=start, name=name, written=f"self.{other}")
        return replace(found, variant="overwritten")
    if isinstance(value, ast.Constant) and type(value.value) in (int, float):
        return None
    code = raised.source.module_of(value).text.code(value)
    number = str(raised.assignment.output.start)
    params = {"name": code, "written": number, "attribute": name}
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
        whys={
            "module": msg(
                "This line gives the module rclpy.node the name {module}. The class {type} inherits "
                "from {module}, which must be a class: the class Node in that module."
            ),
            "itself": msg(
                "The brackets of a class line contain the name of the base class. {name} is the "
                "class that this line begins, so it does not exist yet."
            ),
        },
        fixes={
            "imported": INSTEAD,
            "module": msg("Write {written} instead of {name} in this line."),
            "itself": msg("Write {written} instead of {name} in the brackets."),
        },
        raised={NO_BASE: _no_base, NAME_ERROR: _own_base},
        fixed_by=(node_objects.import_of_module, node_objects.base),
        examples=(
            example(
                "module_imported_as_node",
                Replace(NODE, "from rclpy.node import Node", "import rclpy.node as Node"),
                fails="run.starts",
            ),
            example(
                "base_is_module",
                Replace(NODE, "from rclpy.node import Node", "from rclpy import node"),
                Replace(NODE, "(Node)", "(node)"),
                fails="run.starts",
            ),
            example("base_is_itself", Replace(NODE, "(Node)", "(MyFirstNode)"), fails="run.starts"),
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
        whys={
            "executor": msg(
                "rclpy.spin takes a node. An executor that has the node spins it with its own method."
            ),
            "second": msg(
                "rclpy.spin takes the node. A second value is an executor, not a period: "
                "the timer has the period."
            ),
        },
        raised={
            NOT_A_NODE: _not_spun,
            NOT_AN_EXECUTOR: _spin_with_more,
            r"'\w{0,120}Executor' object has no attribute '\w{1,120}'": _executor_spun,
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "spin_of_an_executor_with_the_node",
                Replace(
                    NODE,
                    "        rclpy.spin(node)",
                    "        executor = rclpy.executors.SingleThreadedExecutor()\n"
                    "        executor.add_node(node)\n        rclpy.spin(executor)",
                ),
                fails="run.starts",
            ),
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
            example(
                "spin_with_a_period",
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin(node, 1.0)"),
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
        whys={
            "given": msg(
                "The parameter {parameter} of __init__ is the node's name. This call gives {value} for "
                "it, which is no text."
            ),
            "member": msg(
                "{type} is an Enum: its member {name} has a name and a value, and only the value is a text."
            ),
        },
        fixes=dict.fromkeys(("given", "member"), msg("Write {written} instead of {name}.")),
        raised={"incompatible constructor arguments": _name_not_text},
        fixed_by=(lines.written,),
        examples=(
            example(
                "arguments_of_the_class_swapped",
                Replace(NODE, "def __init__(self):", "def __init__(self, name, period):"),
                Replace(NODE, "('my_first_node')", "(name)"),
                Replace(NODE, "create_timer(1.0", "create_timer(period"),
                Replace(NODE, "node = MyFirstNode()", "node = MyFirstNode(1.0, 'my_first_node')"),
                fails="run.starts",
            ),
            example(
                "member_of_an_enum_for_node_name",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class Names(Enum):\n    FIRST = 'my_first_node'\n\n\nclass MyFirstNode",
                ),
                Replace(NODE, "import rclpy\nfrom", "from enum import Enum\n\nimport rclpy\nfrom"),
                Replace(NODE, "('my_first_node')", "(Names.FIRST)"),
                fails="run.starts",
            ),
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
        "text_operator",
        "text",
        msg("Two texts are joined with a sign other than +"),
        msg("In Python, + joins strings. The sign {name} does not work with a string."),
        INSTEAD,
        links.PYTHON_STRINGS,
        raised={OPERATOR: on_line(_operator)},
        fixed_by=(node_objects.plus,),
        examples=(
            example(
                "stream_sign_for_plus",
                Replace(NODE, "'Hello time: ' +", "'Hello time: ' <<"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "ampersand_for_plus",
                Replace(NODE, "'Hello time: ' +", "'Hello time: ' &"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "ampersand_behind_a_name",
                Replace(NODE, "class MyFirstNode", "HELLO = 'Hello time: '\n\n\nclass MyFirstNode"),
                Replace(NODE, "'Hello time: ' +", "HELLO &"),
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
            "executor": msg(
                "Each node has self.{name} already: your class inherits it from Node. To set it gives the "
                "node's executor another value, and ROS calls the add_node of that, which only an executor "
                "of ROS has."
            ),
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
            "executor": msg(
                "Use another name for your value, for example self.{name}_, on this line and "
                "wherever you use it."
            ),
            "method": msg(
                "Give your method another name than {name}, here and where the timer gets it."
            ),
            "method_called": msg(
                "Give your method another name, for example {written}: here, and where you call it "
                "(line {line}). If {name} is used elsewhere too, that is the one of Node: leave it."
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
            r"has no attribute 'add_node'": _executor_replaced,
            r"(?:Type|Attribute)Error: ": _hides_property,
        },
        behind={"run.no_lines": _own_logger},
        fixed_by=(
            node_objects.other_attribute,
            node_objects.other_method,
            node_objects.called_method,
        ),
        examples=(
            example(
                "attribute_timers",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.timers = []"),
                fails="run.starts",
            ),
            example(
                "executor_of_python_in_executor",
                Replace(
                    NODE,
                    "import rclpy\nfrom",
                    "from concurrent.futures import ThreadPoolExecutor\n\nimport rclpy\nfrom",
                ),
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = 0\n        self.executor = ThreadPoolExecutor(max_workers=1)",
                ),
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
                "logger_of_python_in_a_base_class",
                Write(
                    f"{INNER}/base.py",
                    "import logging\n\nfrom rclpy.node import Node\n\n\nclass Base(Node):\n"
                    "    def __init__(self, name):\n        super().__init__(name)\n"
                    "        self._logger = logging.getLogger(name)\n",
                ),
                Replace(
                    NODE,
                    "from rclpy.node import Node\n",
                    "\nfrom my_robot_controller.base import Base\n",
                ),
                Replace(NODE, "class MyFirstNode(Node)", "class MyFirstNode(Base)"),
                fails="run.output",
                blocks=SILENT,
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
                "callback_is_handle",
                Replace(NODE, "def timer_callback", "def handle"),
                Replace(NODE, "self.timer_callback)", "self.handle)"),
                fails="run.starts",
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
        "inherited_method",
        "counter",
        msg("A method of Node stands where a value is needed"),
        msg(
            "{method} is a method that your class inherits from Node, not a value. An editor may "
            "have completed the name so."
        ),
        msg("Write the name of your own attribute instead of {name}."),
        fixes={"counter": msg("Write {written} instead of {name}.")},
        raised={METHOD_AS_VALUE: on_line(_inherited)},
        fixed_by=(lines.written,),
        examples=(
            example(
                "completed_to_a_method",
                Replace(NODE, "self.counter_ += 1", "self.count_publishers += 1"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "import_own",
        "start",
        msg("The file imports itself"),
        msg(
            "This import names the file that it is in. Python has not run the rest of the file "
            "yet, so {name} does not exist at this line."
        ),
        msg("Delete this import: the file defines {name} itself."),
        links.PYTHON_ERRORS,
        raised={OWN_IMPORT: _own_import},
        fixed_by=(lines.deleted,),
        examples=(
            example(
                "import_of_itself",
                Replace(
                    NODE,
                    "from rclpy.node import Node\n",
                    "from rclpy.node import Node\n"
                    "from my_robot_controller.my_first_node import MyFirstNode\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "comma_for_dot",
        "counter",
        msg("There is a comma between self and the name"),
        msg("self.name is an attribute of the node. With a comma these are two names."),
        INSTEAD,
        raised={"cannot unpack non-iterable": on_line(_comma)},
        fixed_by=(lines.written,),
        examples=(
            example(
                "comma_after_self",
                Replace(NODE, "self.counter_ = 0", "self,counter_ = 0"),
                fails="run.starts",
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
            "overwritten": msg(
                "This line overwrites the number in {name}. Write {written} on the left of this "
                "line instead of {name}."
            ),
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
            example(
                "timer_in_counter",
                Replace(NODE, "self.create_timer", "self.counter_ = self.create_timer"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
