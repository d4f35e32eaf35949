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
from grader.mistakes.constructor import lines_of
from grader.mistakes.example import DEAD, NODE, STEP_LINE, example
from grader.mistakes.fixes import lines, node_brackets, node_constructor, node_life, rename
from grader.mistakes.imports import IMPORTS, RCLPY
from grader.mistakes.kind import Family
from grader.mistakes.order import spun_names
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake
from grader.mistakes.scope import CALLBACK, NODE_METHODS, OUTSIDE
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


PROPERTY = msg(
    "{method} is a property: it is read without (), so Python passes only self. A property cannot "
    "have another parameter."
)


ON_CLASS = msg(
    "{function} works on an object: Python passes the object as self. Nothing is passed if the method "
    "is called on the class."
)


BLOCK_ENDS = (
    *(
        "end",
        "fi",
        "done",
        "esac",
        "wend",
        "endif",
        "endfor",
        "endwhile",
        "endfunction",
        "endclass",
    ),
    *("end_if", "end_for", "end_while", "end_function"),
)
"""Words that end a block in MATLAB, shell, Basic, structured text and others."""

OF_MODULE = ("init", "spin", "spin_once", "ok", "shutdown", "try_shutdown")
"""Functions of rclpy's module, which a file calls through the module."""
OF_ROS = ("spin", "spin_once", *NODE_METHODS)
"""Calls of ROS: an error that comes from inside of them is not about their own brackets."""


def _undefined(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    name = match["name"]
    statement = statement_at(raised.module, raised.line)
    if isinstance(statement, ast.Expr) and dotted(statement.value) == name:
        return _alone(raised, name)
    if name == lines.NOTEBOOK:
        return replace(raised.finding("name_unknown", name=name), variant="notebook")
    if (joined := _joined(raised, name)) is not None:
        return joined
    if name in TYPES and (types := _as_type(raised, name)) is not None:
        return types
    ways_of_use = (_guard, _alias_of_rclpy, _name_of_node)
    used = next(filter(None, (way(raised, name) for way in ways_of_use)), None)
    if used is not None:
        return used
    timers = [] if bindings(raised.module, name) else raised.source.timers
    if any(dotted(timer.period or timer.call) == name for timer in timers):
        return _period(raised, name)
    ways = (_class_for(raised, name), _of_module(raised, name), _of_rclpy(raised.module, name))
    certain = next((way for way in (*ways, _in_other_case(name)) if way), None)
    if certain is not None:
        return _instead(raised.finding("name_unknown", name=name, close=certain))
    seen = {*visible_names(raised.module, raised.line, name), *IMPORTS}
    known = (_known(raised, name) & seen) - {name, "None", "True", "False"}
    if bindings(raised.module, name):
        known = {other for other in known if other.lower() == name.lower()}
    known |= {other for other in dir(builtins) if other.lower() == name.lower() != name}
    close = meant_by(name, known, 0.7)
    if isinstance(statement, ast.ClassDef) and close:
        return _instead(raised.finding("name_unknown", name=name, close=close, written=close))
    variables = raised.source.node_variables
    if name in spun_names(raised.source) and len(variables) == 1 and variables < seen - {name}:
        return _instead(raised.finding("name_unknown", name=name, close=min(variables)))
    binding = _binding(raised, name, close) if close else None
    if binding is not None:
        return binding
    begun = [n for n in seen & raised.module.names if len(name) > 2 and n.startswith(name)]
    whole = [] if close else [n for n in begun if n != name]
    if len(whole) == 1 and raised.module.line(raised.line).rstrip().endswith(name):
        found = raised.finding("name_unknown", name=name)
        return replace(found, variant="cut", words={**found.words, "written": whole[0]})
    found = raised.finding("name_unknown", name=name, close=close)
    return _instead(found) if close and nearest(name, [close], cutoff=MISSPELT) else found


def _name_of_node(raised: Raised, name: str) -> RecognisedMistake | None:
    """The node's name is a name that nothing defines, as of a parameter that is missing."""
    call = raised.source.super_init
    uses = [n for n in raised.module.nodes if isinstance(n, ast.Name) and n.id == name]
    if (
        call is None
        or len(uses) != 1
        or uses[0] not in call.args[:1]
        or bindings(raised.module, name)
    ):
        return None
    quote = raised.module.text.quote
    written = f"{quote}{raised.assignment.node_name}{quote}"
    found = raised.finding("name_unknown", name=name, written=written)
    return replace(found, variant="node_name")


def _alone(raised: Raised, name: str) -> RecognisedMistake:
    """The name is the whole statement: a misspelt word, the end of a block, or a slip."""
    word = nearest(name.lower(), ALONE, cutoff=0.7)
    if word:
        return _instead(raised.finding("name_unknown", name=name, close=word, written=word))
    found = raised.finding("name_unknown", name=name)
    if name.lower() not in BLOCK_ENDS:
        return replace(found, variant="alone")
    rows = ", ".join(str(row) for row in lines.rows_with_only(raised.module, name))
    return replace(found, variant="block_end", words={**found.words, "lines": rows})


def _period(raised: Raised, name: str) -> RecognisedMistake:
    """The period is a name that nothing defines; other lines may use the name too."""
    period = raised.assignment.seconds
    uses = [n for n in raised.module.nodes if isinstance(n, ast.Name) and n.id == name]
    if len(uses) == 1:
        found = raised.finding("name_unknown", name=name, written=period)
        return replace(found, variant="period")
    found = raised.finding("name_unknown", name=name)
    return replace(found, variant="period_named", words={**found.words, "written": period})


def _binding(raised: Raised, name: str, close: str) -> RecognisedMistake | None:
    """The line that gives the value has the misspelt name: other lines use the right one."""
    names = [n for n in raised.module.nodes if isinstance(n, ast.Name) and n.id in (name, close)]
    set_as = [n for n in names if n.id == close]
    used = [n for n in names if n.id == name and isinstance(n.ctx, ast.Load)]
    if len(set_as) != 1 or not isinstance(set_as[0].ctx, ast.Store) or len(used) < 2:
        return None
    params = {"name": close, "written": name, "close": ""}
    found = raised.finding("name_unknown", at=set_as[0], params=params)
    lines = ", ".join(str(row) for row in sorted({n.lineno for n in used}))
    return replace(found, variant="binding", words={**found.words, "lines": lines})


def _of_module(raised: Raised, name: str) -> str | None:
    """Return the full name of an imported module that is used by its last part alone."""
    parts = [full for _, full, _ in imports(raised.module) if full.rpartition(".")[2] == name]
    plain = [p for p in parts if f"import {p}" in raised.module.text.text and "." in p]
    return plain[0] if plain and f"{name}." in raised.module.line(raised.line) else None


def _of_rclpy(module: Module, name: str) -> str | None:
    """Return a function of rclpy with the name by which the file knows rclpy."""
    known = [bound for bound, full, _ in imports(module) if full == "rclpy"]
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    called = any(isinstance(module.parents.get(use), ast.Call) for use in uses)
    return f"{known[0]}.{name}" if known and called and name in OF_MODULE else None


def _alias_of_rclpy(raised: Raised, name: str) -> RecognisedMistake | None:
    """Rclpy is imported, and the unknown name only stands before its functions."""
    module = raised.module
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    read = {getattr(module.parents.get(use), "attr", "") for use in uses}
    known = any(bound == full == "rclpy" for bound, full, _ in imports(module))
    if not known or not read or not read <= set(RCLPY):
        return None
    rows = ", ".join(str(row) for row in sorted({use.lineno for use in uses}))
    found = raised.finding("name_unknown", name=name, close="rclpy")
    return replace(found, variant="alias", words={**found.words, "lines": rows})


def _in_other_case(name: str) -> str | None:
    """Return the exception of Python that is written like this, but for small and capital letters."""
    alike = [n for n in dir(builtins) if n.lower() == name.lower()]
    kinds = [n for n in alike if isinstance(getattr(builtins, n), type) and n[0].isupper()]
    return kinds[0] if len(kinds) == 1 and name[0].isupper() and name not in alike else None


def _joined(raised: Raised, name: str) -> RecognisedMistake | None:
    """The name is an object and its part, with no dot between them: selfcounter."""
    for at in range(1, len(name)):
        owner, part = name[:at], name[at:]
        uses = [n for n in raised.module.nodes if isinstance(n, ast.Attribute) and n.attr == part]
        known = any(dotted(use) == f"{owner}.{part}" for use in uses)
        known = known or (owner == "self" and part in {*raised.source.methods, *NODE_METHODS})
        known = known or (owner == "rclpy" and part in RCLPY)
        if known and (owner == "self" or owner in visible_names(raised.module, raised.line, name)):
            return _instead(raised.finding("name_unknown", name=name, close=f"{owner}.{part}"))
    return None


def _as_type(raised: Raised, name: str) -> RecognisedMistake | None:
    """A def or a variable has a type of another language: all uses of the name are types."""
    module = raised.module
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    around = [(module.parents.get(use), use) for use in uses]
    types = [
        getattr(a, "annotation", None) is use or getattr(a, "returns", None) is use
        for a, use in around
    ]
    called = [isinstance(a, ast.Call) and a.func is use for a, use in around]
    if uses and all(called) and TYPES[name] in NUMBERS_AND_TEXTS:
        return raised.finding("name_unknown", name=name, close=TYPES[name])
    if not uses or not all(types):
        return None
    rows = ", ".join(str(row) for row in sorted({use.lineno for use in uses}))
    found = raised.finding("name_unknown", name=name, close=TYPES[name])
    return replace(found, variant="type", words={**found.words, "lines": rows})


def _guard(raised: Raised, name: str) -> RecognisedMistake | None:
    """The line is meant as if __name__ == '__main__':, and the underscores are missing."""
    row = raised.module.line(raised.line or 0)
    match = re.match(r"if\s+(?P<test>_?name_?\s*==\s*(['\"])_{0,2}main_{0,2}\2)\s*:", row)
    if match is None or not re.fullmatch(r"_?name_?", name):
        return None
    rows = enumerate(raised.module.text.lines, 1)
    bare = re.compile(r"\bdef _?init_?\(self|\bsuper\(\)\._?init_?\(")
    others = [str(n) for n, _ in rows if bare.search(raised.module.line(n))]
    found = raised.finding("name_unknown", name=match["test"], written="__name__ == '__main__'")
    if not others:
        return replace(found, variant="guard")
    words = {**found.words, "lines": ", ".join(others)}
    return replace(found, variant="guard_init", params={"name": name}, words=words)


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
    function = last_part(match["function"])
    found = raised.finding("argument_missing", name=match["name"], function=match["function"])
    own = {n.name for n in raised.source.all_nodes if isinstance(n, Function)}
    if match["function"] == "spin":
        return _spin_without_node(raised, found)
    names = re.findall(r"'(\w{1,120})'", match["names"])
    if len(names) > 1 and function not in own:
        params = {"name": ", ".join(names), "function": match["function"]}
        return replace(raised.finding("argument_missing", params=params), variant="several")
    if (wanted := _wanted(raised, match)) is not None:
        return wanted
    if match["function"] == "get_logger" and _in_method(raised):
        found = raised.finding("argument_missing", name="get_logger()", written="self.get_logger()")
        return replace(found, variant="logger", words={**found.words, "function": "get_logger"})
    if match["function"].startswith("RcutilsLogger."):
        return replace(found, words={**found.words, "function": function}, variant="log")
    foreign = match["function"].partition(".")[0] not in raised.source.known_classes
    timers = [t for t in raised.source.timers if t.callback is not None]
    outside = [t for t in timers if t.callback and dotted(t.callback) == match["function"]]
    if match["name"] == "self" and outside and match["function"] in raised.module.functions:
        words = {"name": function, "written": f"self.{function}", "function": function}
        found = raised.finding("argument_missing", at=outside[0].call)
        return replace(found, variant="outside", words={**found.words, **words})
    of_timer = _timer_without_object(raised, match) or _function_of_timer(raised, match)
    if of_timer is not None:
        return of_timer
    if match["name"] == "self" and "." in match["function"]:
        return _through_object(raised, match["function"]) or replace(found, variant="class")
    if "." in match["function"] and _on_class(raised, match):
        return replace(found, variant="class")
    if function in own and not foreign:
        return _of_own_method(raised, match) or replace(found, variant="own")
    return found


def _on_class(raised: Raised, match: re.Match[str]) -> bool:
    """Whether the line calls a method with self on its class, so that a value goes to self."""
    owner, _, name = match["function"].rpartition(".")
    made = [
        s
        for module in raised.source.known_modules
        for c in module.classes
        for s in c.body
        if c.name == owner and isinstance(s, Function) and s.name == name
    ]
    calls = [c for c, called in raised.source.calls if called == match["function"]]
    here = [c for c in calls if raised.line in lines_of(c) and c.args]
    plain = len(made) == 1 and has_self(made[0]) and not made[0].decorator_list
    return plain and len(here) == 1 and dotted(here[0].args[0]) != "self"


def _timer_without_object(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A timer calls a method as the function of its class, so that nothing is passed as self."""
    statement = statement_at(raised.module, raised.line)
    names = [name for _, name in calls_in(statement)] if statement is not None else []
    timers = [c for c, name in raised.source.calls if last_part(name) == "create_timer"]
    spun = any(last_part(name).startswith("spin") for name in names)
    if match["name"] != "self" or not spun or len(timers) != 1 or len(timers[0].args) < 2:
        return None
    code = raised.source.module_of(timers[0]).text.code(timers[0].args[1])
    method = last_part(match["function"])
    if code == f"self.{method}":
        return None
    found = raised.finding("argument_missing", at=timers[0], params={"name": code})
    owner = match["function"].rpartition(".")[0]
    words = {**found.words, "function": match["function"], "method": method, "type": owner}
    own = {each.name for each in raised.source.family}
    return replace(found, variant="of_timer" if owner in own else "of_timer_other", words=words)


def _function_of_timer(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A timer calls a function of the file, which needs a value: a timer passes none."""
    at = raised.module.functions.get(match["function"])
    timers = [
        t
        for t in raised.source.timers
        if t.callback is not None and dotted(t.callback) == match["function"]
    ]
    calls = [c for c, name in raised.source.calls if name == match["function"]]
    if at is None or len(timers) != 1 or any(raised.line in lines_of(c) for c in calls):
        return None
    found = raised.finding("argument_missing", at=timers[0].call)
    module = raised.source.module_of(timers[0].call)
    node = node_here(raised.source, module, timers[0].call.lineno)
    least = len(at.args.args) - len(at.args.defaults)
    words = {**found.words, "name": match["name"], "function": match["function"]}
    if least != 1 or not node:
        return replace(found, variant="of_timer_values", words=words)
    params = {"name": match["function"], "written": f"lambda: {match['function']}({node})"}
    found = raised.finding("argument_missing", at=timers[0].call, params=params)
    words = {**found.words, "parameter": match["name"], "function": match["function"], "node": node}
    return replace(found, variant="of_timer_node", words=words)


def _spin_without_node(raised: Raised, found: RecognisedMistake) -> RecognisedMistake:
    """Nothing is in the () of spin: name the node, which may have no variable yet."""
    source = raised.source
    here = node_here(source, raised.module, raised.line)
    if here:
        return replace(found, words={**found.words, "node": here}, variant="spin")
    alone = [
        n
        for n in raised.module.nodes
        if isinstance(n, ast.Expr)
        and isinstance(n.value, ast.Call)
        and source.is_node_class(n.value.func)
        and function_at(raised.module, n.lineno) is function_at(raised.module, raised.line)
    ]
    if len(alone) != 1 or "node" in raised.module.names:
        return replace(found, variant="spin_nothing")
    words = {"written": f"node = {raised.module.text.code(alone[0])}", "line": str(alone[0].lineno)}
    return replace(found, words={**found.words, **words}, variant="spin_unnamed")


def _through_object(raised: Raised, function: str) -> RecognisedMistake | None:
    """A method of the node is called on its class where the node itself is at hand."""
    here = node_here(raised.source, raised.module, raised.line)
    statement = statement_at(raised.module, raised.line)
    called = [name for _, name in calls_in(statement)] if statement is not None else []
    owner, _, method = function.partition(".")
    if not here or called.count(function) != 1 or method.startswith("__"):
        return None
    if method not in raised.source.methods or owner not in {c.name for c in raised.source.family}:
        return None
    params = {"name": function, "written": f"{here}.{method}"}
    found = raised.finding("argument_missing", params=params)
    return replace(found, variant="class_object", words={**found.words, "function": function})


def _in_method(raised: Raised) -> bool:
    """Whether the line is in a method of the node's class."""
    function = function_at(raised.module, raised.line)
    bodies = [s for c in raised.source.family for s in c.body]
    return function is not None and function in bodies and has_self(function)


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
        variant = "own_call_used" if used else "own_call"
        return replace(found, variant=variant, where=where)
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
    named = node_constructor.named_node(module, source, raised.assignment)
    if named is not None:
        written = written.replace(module.text.code(named[0]), named[1])
    params = {"name": name, "type": around[0].name, "line": str(around[0].lineno)}
    return raised.finding("super_of_other_name", at=call, params={**params, "written": written})


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


def _constant_called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if not re.search(r"\b(?:None|True|False)\s{0,9}\(", raised.module.line(raised.line)):
        return None
    name = {"NoneType": "None", "bool": "True or False"}.get(match["type"], match["type"])
    return raised.finding("not_callable", type=match["type"], name=name)


_node = Family("node", links.FIRST_NODE)
KINDS = (
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
            "binding": msg(
                "Write {written} instead of {name} here: lines {lines} use the name {written}."
            ),
            "alone": msg(
                "Delete this line if it was typed by accident: it contains only {name}, which "
                "nothing defines."
            ),
            "block_end": msg(
                "Delete each line that contains only {name} (lines: {lines}): Python has no word that "
                "ends a block."
            ),
            "notebook": msg(
                "Delete this line, and every other line that calls {name}(): the node does not need "
                "them."
            ),
            "node_name": msg(
                "Write {written} instead of {name} on this line: it is the name that the node gets."
            ),
            "period": msg("Write the period in seconds instead of {name}: {written}"),
            "period_named": msg(
                "Give {name} its value on a line of its own below the imports: {name} = {written}"
            ),
            "instead": msg("Write {close} instead of {name}."),
            "type": msg("Write {close} instead of {name} (lines: {lines})."),
            "alias": msg(
                "The file knows {close} by its own name. Write {close} instead of {name} (lines: {lines}). Or "
                "write import {close} as {name} instead of import {close}."
            ),
            "cut": msg(
                "The line ends with {name}, and the file has {written}. If {written} is meant, write it "
                "here, with all that belongs behind it."
            ),
            "guard": msg(
                "Write {written} instead of {name}, with two underscores before and behind both words."
            ),
            "guard_init": msg(
                "Write {written} instead of {name}, with two underscores before and behind both words. "
                "Do the same with __init__ (lines: {lines})."
            ),
        },
        whys={
            **dict.fromkeys(
                ("guard", "guard_init"),
                msg(
                    "Python's own names have two underscores on both sides. Some programs take them "
                    "for bold type and remove them."
                ),
            ),
            "type": msg("{name} is a type of other programming languages. Python has no {name}."),
            "block_end": msg(
                "Other languages end a block with {name}. In Python, the indentation alone shows where "
                "a block ends, so {name} is a name here, and nothing defines it."
            ),
            "notebook": msg(
                "This line was exported from a Jupyter notebook, where it was a command with % or !. "
                "Only IPython and its notebooks have a {name}."
            ),
        },
        seen=r"NameError: name '(?P<name>\w{1,120})' is not defined",
        raised={NAME_ERROR: _undefined},
        fixed_by=(lines.written, rename.variable, lines.deleted_name, lines.without_notebook),
        deletes=("alone", "block_end", "notebook"),
        examples=(
            example(
                "period_named_twice_and_unknown",
                Replace(NODE, "create_timer(1.0", "create_timer(PERIOD"),
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = 0\n        self.get_logger().debug(f'{PERIOD} s')",
                ),
                fails="run.starts",
            ),
            example(
                "end_of_other_languages",
                Replace(NODE, STEP_LINE, f"{STEP_LINE}    end\n"),
                Replace(NODE, "    def timer_callback", "    end\n\n    def timer_callback"),
                fails="run.starts",
            ),
            example(
                "lines_of_a_notebook",
                Replace(
                    NODE,
                    "import rclpy\nfrom",
                    "get_ipython().run_line_magic('load_ext', 'autoreload')\n"
                    "get_ipython().system('pwd')\n\nimport rclpy\nfrom",
                ),
                fails="run.starts",
            ),
            example(
                "unknown_name_alone_in_except",
                Replace(NODE, "        pass\n", "        ignored\n"),
                fails="run.interrupt",
            ),
            example(
                "node_set_by_another_case",
                Replace(NODE, "    node = MyFirstNode()", "    Node_ = MyFirstNode()"),
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin(node_)"),
                Replace(NODE, "node.destroy_node()", "node_.destroy_node()"),
                fails="run.starts",
            ),
            example(
                "base_in_small_letters",
                Replace(NODE, "class MyFirstNode(Node)", "class MyFirstNode(node)"),
                fails="run.starts",
            ),
            example(
                "dot_behind_self_lost",
                Replace(NODE, "str(self.counter_)", "str(selfcounter_)"),
                fails="run.output",
                blocks=DEAD,
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
                "underscores_of_the_guard_lost",
                Replace(NODE, "if __name__ == '__main__':", "if name == 'main':"),
                Replace(NODE, "def __init__(", "def init("),
                Replace(NODE, "super().__init__(", "super().init("),
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
            "log": msg("Write the text in the () of {function} on this line: {sum}"),
            "several": msg("Write a value for each of these in the () of {function}: {name}"),
            "own": msg("Pass a value for {name} where {function} is called."),
            "own_call": msg(
                "Write a value for {name} in the () of {called} on this line. Or remove {name} from "
                "the def of {method} in line {line}."
            ),
            "own_call_used": msg(
                "Write a value for {name} in the () of {called} on this line. Or give {name} a default in "
                "the def of {method} in line {line}: {name}=…"
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
                "This line uses the class itself, and not an object of it. Pass the object, if one was "
                "made before, such as the node. If none was, write () after the name of the class."
            ),
            "value": msg("Pass a value for {name}: write {written} in line {line}."),
            "unused": msg(
                "Remove {name} from the parameters in this line: nothing in __init__ uses it, and "
                "line {line} passes no value."
            ),
            "logger": msg("Write {written} instead of {name}."),
            "outside": msg(
                "Indent {function} and its lines by 4 more spaces and move them into the class, among "
                "its methods. Write {written} instead of {name} on this line."
            ),
            "class_object": msg("Write {written} instead of {name}."),
            "of_timer_node": msg(
                "If {parameter} is the node, write {written} instead of {name} in this line: then the timer "
                "calls {function} with the node."
            ),
            "of_timer_values": msg(
                "Give each parameter of {function} a default in its def. Or write lambda: {function}(…) "
                "instead of {function} in this line, with a value for each parameter in its ()."
            ),
            "of_timer": msg(
                "Write self.{method} instead of {name}. If {name} can be several functions, write "
                "functools.partial({name}, self), and import functools at the top of the file."
            ),
            "of_timer_other": msg(
                "Create an object of {type} and keep it under a name: write {type}(…), with what its __init__ "
                "needs in the (). Then give the timer the method of that object."
            ),
            "spin": msg("Write rclpy.spin({node}): spin needs the node that was created."),
            "spin_unnamed": msg(
                "Give the node that line {line} creates a name: write {written} there. Write "
                "rclpy.spin(node) on this line."
            ),
            "spin_nothing": msg(
                "spin needs the node that was created: write what has it into the () of spin."
            ),
        },
        whys={
            "class_object": ON_CLASS,
            **dict.fromkeys(
                ("of_timer_node", "of_timer_values"),
                msg(
                    "The timer that this line creates calls {function} without a value, and {function} has "
                    "a parameter that needs one."
                ),
            ),
            "of_timer_other": msg(
                "This line gives the timer {name}, and that is {function} as a function of the class {type}: "
                "no object belongs to it, so Python has nothing to pass as self."
            ),
            "of_timer": msg(
                "This line gives the timer {name}, and that is {function} as a function of the class: no "
                "object belongs to it. Python passes self only if the method is read from an object, as in "
                "self.{method}."
            ),
            "outside": msg(
                "The timer calls {function} without arguments. Only a method of an object gets self, "
                "and {function} is outside of the class."
            ),
            "property": PROPERTY,
            "property_used": PROPERTY,
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
            node_constructor.argument,
            node_brackets.without_parameter,
            lines.written,
        ),
        examples=(
            example(
                "callback_called_on_its_class",
                Replace(NODE, "self.timer_callback)", "lambda: MyFirstNode.timer_callback())"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "spin_without_node_that_has_no_name",
                Replace(NODE, "node = MyFirstNode()", "MyFirstNode()"),
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin()"),
                Replace(NODE, "        node.destroy_node()\n", ""),
                fails="run.starts",
            ),
            example(
                "callback_with_self_outside",
                Replace(NODE, CALLBACK, ""),
                Replace(NODE, "class MyFirstNode(Node)", f"{OUTSIDE}\n\nclass MyFirstNode(Node)"),
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    "self.create_timer(1.0, timer_callback)",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
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
                "functions_of_the_class_as_callbacks",
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "        for job in (MyFirstNode.timer_callback,):\n"
                    "            self.create_timer(1.0, job)\n",
                ),
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
