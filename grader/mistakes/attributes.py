"""Mistakes in what is read behind a dot: attributes and methods that an object does not have.

These come late: their patterns also match errors that have a more precise cause.
"""

from __future__ import annotations

import ast
import re
from dataclasses import replace
from typing import TypeGuard

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.alike import is_typo, meant_by, plain_letters
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines, node_names, node_timer, rename
from grader.mistakes.fixes.case import Case
from grader.mistakes.imports import RCLPY
from grader.mistakes.kind import Family
from grader.mistakes.recognised import OWN_ATTRIBUTE, Raised, RecognisedMistake, of_self
from grader.mistakes.scope import NODE_METHODS
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.counter import logged_counter, starts_of, targets_of
from grader.package.source.imported import imports
from grader.package.source.module import Function, Module
from grader.package.source.names import calls_in, dotted, last_part, own_name
from grader.package.source.node import LOG_METHODS
from grader.package.source.node_here import node_here
from grader.package.source.place import function_at, statement_at
from grader.package.source.scopes import class_of, scope_of

ATTRIBUTE = (
    r"AttributeError: (?:module |type object )?'(?P<type>[\w.]{1,200})'(?: object)? has no "
    r"attribute '(?P<name>\w{1,120})'"
)


ELSEWHERE = {
    "create_wall_timer": "create_timer",
    "createTimer": "create_timer",
    "createWallTimer": "create_timer",
    "add_timer": "create_timer",
    "advertise": "create_publisher",
    "create_subscriber": "create_subscription",
    "getLogger": "get_logger",
    "logger": "get_logger",
}
"""Methods of nodes in C++, in ROS 1 and in other libraries, and those of rclpy."""
NO_LOGGER = msg(
    "No line of the class gives self.{attribute} a value. The node gets its logger with get_logger()."
)
OF_FILE = msg(
    "This is a function of the file, and no method of the class. It is called without self. before its name."
)
SET_ELSEWHERE = msg(
    "self.{name} does not exist until a line assigns to it. Line {lines} does so, but had not run "
    "for this object when Python came to this line."
)


SET_IN_METHOD = msg(
    "self.{name} does not exist until a line assigns to it. Line {lines} does so, in the method "
    "{method}, which had not run for this object when Python came to this line."
)


def _through_node(raised: Raised, node: str, name: str) -> dict[str, str]:
    """Return a call of rclpy's module and that of the node; the node is no argument of the latter."""
    code = raised.module.text.code
    params = {"name": f"rclpy.{name}", "written": f"{node}.{name}"}
    for call, called in calls_in(raised.module.tree):
        if call.lineno != raised.line or called != params["name"]:
            continue
        first = dotted(call.args[0]) if call.args else ""
        if first in ("self", node) and "\n" not in code(call):
            rest: list[ast.expr | ast.keyword] = [*call.args[1:], *call.keywords]
            given = ", ".join(code(value) for value in rest)
            return {"name": code(call), "written": f"{params['written']}({given})"}
    return params


def _close_attribute(raised: Raised, name: str) -> str:
    attributes = raised.source.attributes
    spelt = [
        other
        for other in attributes
        if other != name and plain_letters(other) == plain_letters(name)
    ]
    return spelt[0] if len(spelt) == 1 else meant_by(name, attributes, cutoff=0.75)


def _close_method(raised: Raised, match: re.Match[str]) -> str:
    """Return the method that is meant: of the node, of rclpy or of the logger."""
    name = match["name"]
    if name == "logger" and not _is_only_called(raised, name):
        return ""  # (get_logger would lack its ())
    if _is_of_node(raised, match["type"]) and name in ELSEWHERE:
        return ELSEWHERE[name]
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
    if not _is_written(raised, match["name"]) or _without_dot(raised, match["name"]) is not None:
        return None
    close = _close_method(raised, match)
    return raised.finding("method_misspelt", name=match["name"], close=close) if close else None


def _private(raised: Raised, name: str) -> RecognisedMistake | None:
    """A name with two underscores that only another class of the files sets."""
    node_class = raised.source.node_class
    if name.startswith("__") and node_class is not None:
        name = f"_{node_class.name.lstrip('_')}{name}"
    told = re.fullmatch(r"_+(?P<type>\w+?)__(?P<rest>\w+)", name)
    if told is None:
        return None
    own = f"self.__{told['rest']}"
    for module in raised.source.modules:
        for node in module.nodes:
            owner = class_of(module, scope_of(module, node)) if own in targets_of(node) else None
            if owner is None or owner[0].name.lstrip("_") == told["type"]:
                continue
            return _told_private(raised, own, owner[0].name)
    bases = node_class.bases if node_class is not None else []
    mine = node_class is not None and node_class.name.lstrip("_") == told["type"]
    base = last_part(dotted(bases[0])) if bases and mine else ""
    if not base or base == "Node":
        return None
    return _told_private(raised, own, base)


def _told_private(raised: Raised, name: str, kind: str) -> RecognisedMistake:
    found = raised.finding("attribute_not_set")
    words = {"name": name, "written": name.replace("__", "_", 1), "type": kind}
    return replace(found, variant="private", words={**found.words, **words})


def _without_dot(raised: Raised, name: str) -> ast.stmt | None:
    """Return the line that assigns to the name with self and without a dot: `selfname = 0`."""
    for node in raised.module.nodes:
        if isinstance(node, ast.stmt) and f"self{name}" in targets_of(node):
            return node
    return None


def _node_of_init(raised: Raised, owner: ast.ClassDef) -> str:
    """Return the parameter of __init__ on which methods of a node are called; "" if none.

    A parameter that gets the node where the object is made is one too.
    """
    inits = [s for s in owner.body if isinstance(s, ast.FunctionDef) and s.name == "__init__"]
    given = {a.arg for init in inits for a in init.args.args[1:]}
    called = [dotted(n.value) for i in inits for n in ast.walk(i) if _is_node_method(n)]
    known = next((name for name in called if name in given), "")
    return known or _given_as_self(raised, owner, inits)


def _given_as_self(raised: Raised, owner: ast.ClassDef, inits: list[ast.FunctionDef]) -> str:
    """Return the parameter for which the only call of a class gives the node; "" if none."""
    calls = [c for c, name in raised.source.calls if last_part(name) == owner.name]
    if len(calls) != 1 or len(inits) != 1:
        return ""
    nodes = {"self", *raised.source.node_variables}
    names = [a.arg for a in inits[0].args.args[1:]]
    places = [names[at] for at, v in enumerate(calls[0].args[: len(names)]) if dotted(v) in nodes]
    places += [k.arg for k in calls[0].keywords if k.arg in names and dotted(k.value) in nodes]
    return places[0] if len(places) == 1 else ""


def _is_node_method(part: ast.AST) -> TypeGuard[ast.Attribute]:
    return isinstance(part, ast.Attribute) and part.attr in NODE_METHODS


def _counts_instead(raised: Raised, name: str) -> str:
    """Return the number that is logged and never counted, if the line only counts another one."""
    source, statement = raised.source, statement_at(raised.module, raised.line)
    counts = isinstance(statement, ast.AugAssign) and dotted(statement.target) == f"self.{name}"
    uses = [
        n for n in source.own_nodes if isinstance(n, ast.Attribute) and dotted(n) == f"self.{name}"
    ]
    shown = logged_counter(source)
    logged = shown[1].removeprefix("self.") if shown is not None else ""
    start = starts_of(source).get(f"self.{logged}")
    counted = {t for n in source.own_nodes if isinstance(n, ast.AugAssign) for t in targets_of(n)}
    if not counts or len(uses) != 1 or start is None or f"self.{logged}" in counted:
        return ""
    return logged if start.value == raised.assignment.output.start else ""


def _not_set(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if not of_self(raised, match) or match["name"] in raised.module.functions:
        return None
    private = _private(raised, match["name"])
    if private is not None:
        return private
    name, close = match["name"], _close_attribute(raised, match["name"])
    close = close or _counts_instead(raised, name)
    owner = class_of(raised.module, function_at(raised.module, raised.line))
    held = raised.source.held_node
    helper = owner is not None and not owner[0].bases
    if owner is not None and owner[0] in raised.source.family and held:
        helper = False
    if owner is not None and helper and name in NODE_METHODS:
        found = raised.finding("attribute_not_set", name=name)
        words = {**found.words, "type": owner[0].name, "parameter": _node_of_init(raised, owner[0])}
        return replace(
            found, variant="no_node_kept" if words["parameter"] else "no_node", words=words
        )
    if held and name in NODE_METHODS:
        params = {"name": f"self.{name}", "written": f"{held}.{name}"}
        found = raised.finding("attribute_not_set", params=params)
        return replace(found, variant="held", words={**found.words, "held": held})
    ways = (_deleted, _set_elsewhere, _set_in_base, _set_in_heir, _without_self)
    elsewhere = next(filter(None, (way(raised, name) for way in ways)), None)
    if elsewhere is not None:
        return elsewhere
    for timer in raised.source.timers:
        if dotted(timer.period or timer.call) == f"self.{name}" and not close:
            period = raised.assignment.seconds
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
    dot = _without_dot(raised, name)
    if dot is not None:
        params = {"name": f"self{name}", "written": f"self.{name}"}
        found = raised.finding("attribute_not_set", at=dot, params=params)
        return replace(found, variant="dot", words={**found.words, "attribute": name})
    called = _called(raised, name)
    if called is not None:
        return called
    return _without_value(raised, name, close)


def _without_value(raised: Raised, name: str, close: str) -> RecognisedMistake:
    """No line sets the attribute: a similar one is meant, or it needs a first value."""
    found = raised.finding("attribute_not_set", name=name, close=close)
    if not close and (logger := _as_logger(raised, name)) is not None:
        return logger
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
        return raised.finding("attribute_other_name", at=start, name=close, close=name)
    counts = node_names.counts(raised.source, name)
    here = class_of(raised.module, function_at(raised.module, raised.line))
    if not close and here is not None and not _has_init(raised, here[0]):
        words = {**found.words, "type": here[0].name}
        return replace(found, variant="no_init" if counts else "no_init_value", words=words)
    return found if close or counts else replace(found, variant="value")


def _has_init(raised: Raised, owner: ast.ClassDef) -> bool:
    """Whether a class of the files has an __init__, in itself or in a base of the files."""
    bodies = (
        [s for c in raised.source.family for s in c.body] if owner in raised.source.family else []
    )
    return any(isinstance(s, Function) and s.name == "__init__" for s in (*owner.body, *bodies))


def _as_logger(raised: Raised, name: str) -> RecognisedMistake | None:
    """An attribute of the node that no line sets is used only as a logger."""
    module, own = raised.module, f"self.{name}"
    uses = [n for n in module.nodes if isinstance(n, ast.Attribute) and dotted(n) == own]
    read = {getattr(module.parents.get(use), "attr", "") for use in uses}
    if (
        not uses
        or not read <= set(LOG_METHODS)
        or node_here(raised.source, module, raised.line) != "self"
    ):
        return None
    params = {"name": own, "written": "self.get_logger()"}
    found = raised.finding("attribute_not_set", params={} if len(uses) > 1 else params)
    words = {**found.words, **params, "attribute": name}
    return replace(found, words=words, variant="logger" if len(uses) == 1 else "logger_lines")


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
    only_named = [
        n
        for n in raised.source.own_nodes
        if isinstance(n, ast.Expr) and dotted(n.value) == f"self.{method.name}"
    ]
    if len(only_named) == 1:
        code = f"self.{method.name}"
        found = raised.finding(
            "attribute_not_set", at=only_named[0], name=code, written=f"{code}()"
        )
        words = {**found.words, "attribute": name, "method": method.name}
        return replace(found, variant="set_by_named", words=words)
    named = {n.attr for n in raised.source.all_nodes if isinstance(n, ast.Attribute)}
    plain = len(method.args.args) == 1 and not method.decorator_list
    uncalled = method.name not in named and plain and here[0] is raised.source.node_class
    return replace(found, variant="set_by_uncalled" if uncalled else "set_later", words=words)


def _deleted(raised: Raised, name: str) -> RecognisedMistake | None:
    """A line deletes the attribute: what reads it afterwards finds none."""
    for node in raised.source.own_nodes:
        if isinstance(node, ast.Delete) and f"self.{name}" in map(dotted, node.targets):
            found = raised.finding("attribute_not_set", name=name)
            words = {**found.words, "line": str(node.lineno)}
            return replace(found, words=words, variant="deleted")
    return None


def _without_self(raised: Raised, name: str) -> RecognisedMistake | None:
    """A parameter or a variable of __init__, or a name of the file, has the name of the attribute."""
    module, own = raised.module, f"self.{name}"
    here = class_of(module, function_at(module, raised.line))
    if here is None or here[0] not in raised.source.family:
        return None
    init = next((s for s in here[0].body if isinstance(s, Function) and s.name == "__init__"), None)
    inside = list(ast.walk(init)) if init is not None else []
    if init is not None and any(a.arg == name for a in (*init.args.args, *init.args.kwonlyargs)):
        found = raised.finding("attribute_not_set", name=name, written=f"{own} = {name}")
        return replace(found, variant="parameter")
    sets = [n for n in inside if isinstance(n, ast.Assign) and list(targets_of(n)) == [name]]
    read = any(
        isinstance(n, ast.Name) and n.id == name and isinstance(n.ctx, ast.Load) for n in inside
    )
    if len(sets) == 1 and not read:
        params = {"name": name, "written": own}
        found = raised.finding("attribute_not_set", at=sets[0], params=params)
        return replace(found, variant="local", words={**found.words, "line": str(raised.line)})
    tops = [s for s in module.tree.body if isinstance(s, ast.Assign) and name in targets_of(s)]
    stored = any(own in targets_of(n) for n in module.nodes)
    if len(tops) != 1 or stored:
        return None
    found = raised.finding("attribute_not_set", params={"name": own, "written": name})
    return replace(found, variant="of_file", words={**found.words, "line": str(tops[0].lineno)})


def _set_in_heir(raised: Raised, name: str) -> RecognisedMistake | None:
    """The __init__ of a class that inherits from this one sets the attribute, but later."""
    here = class_of(raised.module, function_at(raised.module, raised.line))
    if here is None or here[0] not in raised.source.family:
        return None
    for heir in raised.source.family:
        if here[0].name not in [last_part(dotted(base)) for base in heir.bases]:
            continue
        inits = [s for s in heir.body if isinstance(s, Function) and s.name == "__init__"]
        sets = [n for i in inits for n in ast.walk(i) if _sets(raised.module, n, f"self.{name}")]
        if not sets:
            continue
        rows = ", ".join(str(row) for row in sorted({getattr(part, "lineno", 0) for part in sets}))
        found = raised.finding("attribute_not_set", params={"name": name, "lines": rows})
        words = {**found.words, "type": heir.name}
        return replace(found, words=words, variant="set_in_heir")
    return None


def _set_in_base(raised: Raised, name: str) -> RecognisedMistake | None:
    """The __init__ of an own base class sets the attribute, and the class does not call it."""
    here = class_of(raised.module, function_at(raised.module, raised.line))
    call = raised.source.super_init
    if here is None or call is None or here[0] not in raised.source.family:
        return None
    for base in here[0].bases:
        owners = [c for c in raised.source.family if c.name == last_part(dotted(base))]
        for init in (s for c in owners for s in c.body if isinstance(s, Function)):
            sets = [n for n in ast.walk(init) if _sets(raised.module, n, f"self.{name}")]
            if init.name != "__init__" or not sets or dotted(call.func) == "super().__init__":
                continue
            if dotted(call.func) == f"{owners[0].name}.__init__":
                continue
            code, values = raised.module.text.code, call.args[1:]
            given = ", ".join([*map(code, values), *map(code, call.keywords)])
            params = {"name": code(call), "written": f"super().__init__({given})"}
            found = raised.finding("attribute_not_set", at=call, params=params)
            words = {
                "attribute": name,
                "type": owners[0].name,
                "line": str(getattr(sets[0], "lineno", 0)),
            }
            return replace(found, variant="base_skipped", words={**found.words, **words})
    return None


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


def _self_in_capitals(raised: Raised, name: str) -> RecognisedMistake | None:
    """The line has Self, of another module, before the dot."""
    statement = statement_at(raised.module, raised.line)
    for node in ast.walk(statement) if statement is not None else ():
        owner = dotted(node.value) if isinstance(node, ast.Attribute) and node.attr == name else ""
        if owner != "self" and owner.lower() == "self":
            params = {"name": f"{owner}.{name}", "written": f"self.{name}"}
            return replace(raised.finding("attribute_unknown", params=params), variant="self")
    return None


def _function_through_self(raised: Raised, own: str, name: str) -> RecognisedMistake:
    """A function of the file is called as a method: it may need the node as its first value."""
    needed = raised.module.functions[name].args
    least = len(needed.args) - len(needed.defaults)
    calls = [n for n in raised.module.nodes if isinstance(n, ast.Call) and dotted(n.func) == own]
    here = [n for n in calls if raised.line in range(n.lineno, (n.end_lineno or n.lineno) + 1)]
    found = raised.finding("attribute_unknown", name=own, written=name)
    if len(here) != 1 or len(here[0].args) + len(here[0].keywords) >= least:
        return replace(found, variant="function")
    given = [raised.module.text.code(part) for part in here[0].args]
    if len(given) + 1 != least or here[0].keywords:
        return replace(raised.finding("attribute_unknown", name=own), variant="function_more")
    code, written = raised.module.text.code(here[0]), f"{name}({', '.join(['self', *given])})"
    return replace(
        raised.finding("attribute_unknown", name=code, written=written), variant="function"
    )


def _unknown(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if raised.inside and match["name"] not in raised.module.line(raised.line):
        return None  # (no name of the student's)
    known = _of_rclpy(raised, match) or _self_in_capitals(raised, match["name"])
    if known is not None:
        return known
    if (match["type"], match["name"]) == ("rclpy", "get_logger"):
        call = re.search(
            rf"rclpy\.{match['name']}\([^()]{{0,80}}\)", raised.module.line(raised.line)
        )
        if call is not None:
            node = node_here(raised.source, raised.module, raised.line) or "self"
            written = f"{node}.get_logger()"
            found = raised.finding("attribute_unknown", name=call[0], written=written)
            return replace(found, variant="written")
    node = node_here(raised.source, raised.module, raised.line)
    if match["type"] == "rclpy" and match["name"] in NODE_METHODS and node:
        params = _through_node(raised, node, match["name"])
        return replace(raised.finding("attribute_unknown", params=params), variant="of_node")
    if match["type"] in ("NoneType", "rclpy"):
        found = raised.finding("attribute_unknown", name=match["name"])
        return replace(found, variant="none" if match["type"] == "NoneType" else "module")
    own = f"self.{match['name']}"
    if match["name"] in raised.module.functions and of_self(raised, match):
        return _function_through_self(raised, own, match["name"])
    if match["type"] == "Parameter":
        return _of_parameter(raised, match["name"])
    uncalled = _class_kept(raised, match)
    if uncalled is not None:
        return uncalled
    made = _from_its_making(raised, match)
    if made is not None:
        return made
    if match["type"] in ("int", "float") and (number := _number(raised, match["name"])):
        found = raised.finding("attribute_unknown", name=number[0], written=number[1])
        return replace(found, variant="number", words={**found.words, "number": number[2]})
    if match["type"] in raised.source.class_names and match["name"] in raised.source.attributes:
        code = f"{match['type']}.{match['name']}"
        found = raised.finding("attribute_unknown", name=code, written=own)
        return replace(found, variant="written")
    return _similar(raised, match)


def _class_kept(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """An attribute or a variable has a class of the file, where an object of it is meant."""
    name = match["type"]
    if not match.string.startswith("AttributeError: type object") or not any(
        c.name == name for module in raised.source.modules for c in module.classes
    ):
        return None
    for node in raised.source.all_nodes:
        value = node.value if isinstance(node, ast.Assign) else None
        if isinstance(node, ast.Assign) and isinstance(value, ast.Name) and value.id == name:
            params = {"name": f"= {name}", "written": f"= {name}()"}
            found = raised.finding("attribute_unknown", at=node, params=params)
            return replace(found, variant="class_kept", words={**found.words, "type": name})
    return None


def _from_its_making(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line that makes the object explains why it does not have the attribute."""
    kind, name = match["type"], match["name"]
    statement = statement_at(raised.module, raised.line)
    parts = ast.walk(statement) if statement is not None else ()
    owners = {dotted(n.value) for n in parts if isinstance(n, ast.Attribute) and n.attr == name}
    owner = owners.pop() if len(owners) == 1 else ""
    for node in raised.module.nodes if owner else ():
        value = node.value if isinstance(node, ast.Assign) else None
        if not isinstance(node, ast.Assign) or not isinstance(value, ast.Call):
            continue
        if [dotted(target) for target in node.targets] != [owner]:
            continue
        if kind == "object" and dotted(value.func) == "object" and not value.args:
            found = raised.finding("attribute_unknown", at=node, name=name)
            return replace(found, variant="bare_object")
        method = value.func if isinstance(value.func, ast.Attribute) else None
        if method is not None and method.attr == "add_node" and kind in ("bool", "NoneType"):
            text = raised.module.text
            first = f"{owner} = {text.code(method.value)}"
            second = f"{owner}.add_node({', '.join(map(text.code, value.args))})"
            found = raised.finding("attribute_unknown", at=node, name=owner)
            words = {**found.words, "statement": first, "step": second}
            return replace(found, variant="of_add_node", words=words)
    return None


def _annotated(raised: Raised, own: ast.ClassDef, name: str) -> RecognisedMistake | None:
    """The class of the object has the name with a colon where = belongs."""
    for row in own.body:
        if (
            not isinstance(row, ast.AnnAssign)
            or row.value is not None
            or dotted(row.target) != name
        ):
            continue
        if not isinstance(row.annotation, ast.Constant):
            return None
        module = raised.source.module_of(row)
        value = module.text.code(row.annotation)
        params = {"name": module.text.code(row), "written": f"{name} = {value}"}
        found = raised.finding("attribute_unknown", at=row, params=params)
        return replace(found, variant="annotated", words={**found.words, "attribute": name})
    return None


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
    if len(own) == 1 and (annotated := _annotated(raised, own[0], name)) is not None:
        return annotated
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


def _number(raised: Raised, attribute: str) -> tuple[str, str, str] | None:
    """Return what the line reads from an attribute that counts, what it should say, and its name."""
    module = raised.module
    statement = statement_at(module, raised.line)
    parts = [n for n in ast.walk(statement) if isinstance(n, ast.Attribute)] if statement else []
    found = [part for part in parts if part.attr == attribute]
    name = dotted(found[0].value) if len(found) == 1 else ""
    if not name or name not in starts_of(raised.source):
        return None
    read: ast.expr = found[0]
    outer = module.parents.get(read)
    if isinstance(outer, ast.Call) and outer.func is read:
        read, outer = outer, module.parents.get(outer)
    if isinstance(outer, ast.Expr):
        return module.text.code(read), f"{name} += 1", name
    in_text = isinstance(outer, ast.BinOp) and isinstance(outer.op, ast.Add)
    value = f"str({name})" if in_text and read is not found[0] else name
    return module.text.code(read), value, name


ENDS = (
    *("cleanup", "clean_up", "close", "delete", "dispose", "end", "exit", "finalize", "kill"),
    *("quit", "release", "shutdown", "stop", "terminate"),
)
BEGINS = ("begin", "execute", "loop", "run", "run_forever", "start")


def _other_word(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Main ends or runs the node by a word of another library."""
    name, source = match["name"], raised.source
    if match["type"] not in source.known_classes or name in source.methods:
        return None
    spins = any(called.rpartition(".")[2].startswith("spin") for _, called in source.calls)
    rclpy = next((bound for bound, full, _ in imports(raised.module) if full == "rclpy"), "rclpy")
    for call, called in source.calls:
        before, _, method = called.rpartition(".")
        if method != name or before not in source.node_variables or call.args or call.keywords:
            continue
        if name in BEGINS and spins:
            return None
        written = f"{rclpy}.spin({before})" if name in BEGINS else f"{before}.destroy_node()"
        found = raised.finding("attribute_unknown", at=call, name=f"{called}()", written=written)
        return replace(found, variant="written")
    return None


def _of_rclpy(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A function of rclpy is called on the node, or __init__ on super() by half its name."""
    name = match["name"]
    if match["type"] == "super" and "init" in name:
        code = re.search(r"super\(\)\.(\w{1,60})", raised.module.line(raised.line))
        found = raised.finding(
            "attribute_unknown", name=code[1] if code else name, written="__init__"
        )
        return replace(found, variant="written")
    if name in ENDS or name in BEGINS:
        return _other_word(raised, match)
    if match["type"] not in raised.source.known_classes or name not in ("spin", "spin_once"):
        return None
    rclpy = next((bound for bound, full, _ in imports(raised.module) if full == "rclpy"), "rclpy")
    for call, called in raised.source.calls:
        before, _, method = called.rpartition(".")
        if method == name and before and before not in ("rclpy", rclpy):
            written = f"{called}()"
            new = f"{rclpy}.{name}({before})"
            found = raised.finding("attribute_unknown", at=call, name=written, written=new)
            return replace(found, variant="written")
    return None


def _through_helper(case: Case) -> Files | None:
    """Read the attribute through the helper object in all lines of the node's class."""
    node, params = case.node, case.finding.params
    name, new = (str(params.get(key, "")) for key in ("name", "written"))
    if node is None or not new.startswith("self.") or new.count(".") != 2 or "(" in new:
        return None
    module = node.module
    uses = [n for n in node.own_nodes if isinstance(n, ast.Attribute) and dotted(n) == name]
    if any(not module.has(use) or module.text.code(use) != name for use in uses):
        return None
    return case.changed(module, *(module.text.swap(use, new) for use in uses))


NO_NODE = msg(
    "{name} belongs to the node. The class {type} does not inherit from Node, so its objects "
    "do not have it."
)
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
        "attribute_other_name",
        "counter",
        msg("__init__ sets an attribute under another name than the other lines read"),
        msg(
            "This line sets self.{name}, and the other lines use self.{close}, which no line sets. For "
            "Python, names that differ in one letter, or in upper and lower case, are two names."
        ),
        msg("Write self.{close} on that line: the other lines use this name, not self.{name}."),
        links.PYTHON_CLASSES,
        fixed_by=(node_names.close_attribute, node_names.counter),
        examples=(
            example(
                "counter_of_other_name",
                Replace(NODE, "self.counter_ = 0", "self.counter = 0"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "counter_with_an_umlaut",
                Replace(NODE, "self.counter_ = 0", "self.z\u00e4hler = 0"),
                Replace(NODE, "str(self.counter_)", "str(self.zaehler)"),
                Replace(NODE, "self.counter_ += 1", "self.zaehler += 1"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "counter_set_with_a_capital",
                Replace(NODE, "self.counter_ = 0", "self.Counter_ = 0"),
                fails="run.output",
                blocks=DEAD,
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
            **dict.fromkeys(
                ("annotated", "base_skipped"), msg("Write {written} instead of {name}.")
            ),
            "private": msg(
                "Write {written} instead of {name} in all lines of both classes: one underscore is enough."
            ),
            "no_node": msg(
                "Pass the node to {type} when it is made, as self in {type}(self). Keep it in its "
                "__init__(self, node) with self.node = node, and write self.node.{name} here."
            ),
            "no_node_kept": msg(
                "Write self.{parameter} = {parameter} in the __init__ of {type}, and "
                "self.{parameter}.{name} instead of self.{name}."
            ),
            "held": msg(
                "Write {written} instead of {name}. Do the same wherever self. stands before another "
                "method of the node."
            ),
            "deleted": msg("Delete self.{name} from line {line}, or the whole line."),
            "dot": msg("A dot is missing. Write {written} instead of {name}."),
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
            "parameter": msg("Write in __init__, above the line that creates the timer: {written}"),
            "local": msg("Write {written} instead of {name} on that line."),
            "of_file": msg("Write {written} instead of {name}."),
            "set_in_heir": msg(
                "Give self.{name} its value before this line can run: above the call of super().__init__() "
                "in {type}, or in the class that has this line."
            ),
            "set_again": msg(
                "Set self.{name} in __init__ too, above the line that creates the timer: "
                "self.{name} = and the value that it has at the beginning."
            ),
            "set_later": msg(
                "Set self.{name} in __init__ too, before this line can run, or call {method} "
                "before this line can run."
            ),
            "set_by_named": msg(
                "This line only names the method, and does not call it. Write {written} instead of "
                "{name}."
            ),
            "set_by_uncalled": msg(
                "Write self.{method}() in __init__, before the line that creates the timer. Or move "
                "line {lines} there, and delete def {method} if nothing is left in it."
            ),
            "initialiser": msg("Write {written} instead of {name}."),
            "no_init": msg(
                "The class {type} has no __init__. Give self.{name} a first value in the class: write "
                "{name} = {start} above the first def of {type}, indented like that def."
            ),
            "no_init_value": msg(
                "The class {type} has no __init__. Give self.{name} a first value in the class: write "
                "{name} = and the value that it has at the beginning above the first def of {type}, indented "
                "like that def."
            ),
            "helper": msg("Write {written} instead of {name}, here and in the other lines."),
            "logger": msg("Write {written} instead of {name}."),
            "logger_lines": msg("Write {written} instead of {name}, here and in the other lines."),
            "no_method": msg(
                "If {name} is a method of yours, write its def in the class. If it is one of ROS, look it up "
                "in the documentation of your distro: it may have another name there, as from one release "
                "to the next. If nothing needs the call, delete it."
            ),
            "object": msg(
                "Delete this line if it belongs to another example. If the node needs it, create "
                "self.{name} in __init__ first."
            ),
        },
        whys={
            "private": msg(
                "A name that begins with two underscores belongs to its class alone. The class {type} sets "
                "{name}, and a class that inherits from it does not see that attribute."
            ),
            "parameter": msg(
                "{name} is a parameter of __init__, which is known only inside of __init__. self.{name} does not "
                "exist until a line assigns to it."
            ),
            "local": msg(
                "Without self., {name} is a variable of __init__ alone. Line {line} reads {written}, which no line "
                "sets."
            ),
            "of_file": msg(
                "Line {line} sets {written} outside of the class. A name of the file is used without self."
            ),
            "set_in_heir": msg(
                "self.{name} does not exist until a line assigns to it. Line {lines} does so, in the "
                "__init__ of {type}, but had not run for this object when Python came to this line."
            ),
            "deleted": msg(
                "Line {line} deletes self.{name}: del takes away the attribute, and not only its value. "
                "Then self.{name} does not exist until a line assigns to it again."
            ),
            "base_skipped": msg(
                "Line {line}, in the __init__ of {type}, sets self.{attribute}. This line calls the __init__ of "
                "another class, so that of {type} does not run."
            ),
            "no_node": NO_NODE,
            "no_node_kept": NO_NODE,
            "held": msg(
                "This class is no node: it does not inherit from Node. Its node is {held}, which has "
                "this method."
            ),
            "dot": msg(
                "{name} is a name of its own, and no attribute, so self.{attribute} does not exist."
            ),
            "annotated": msg(
                "A colon after a name only states a type. A value is assigned with =, so "
                "self.{attribute} does not exist yet."
            ),
            "set_here": SET_ELSEWHERE,
            "set_again": SET_ELSEWHERE,
            "set_later": SET_IN_METHOD,
            "set_by_named": msg(
                "self.{attribute} does not exist until a line assigns to it. The method {method} does so, "
                "and only a call with () runs it."
            ),
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
            "logger": NO_LOGGER,
            "logger_lines": NO_LOGGER,
            "no_method": msg("self.{name}() calls a method, and the class has no method {name}."),
        },
        raised={OWN_ATTRIBUTE: _not_set},
        fixed_by=(_through_helper, lines.written, node_names.close_attribute, node_names.counter),
        examples=(
            example(
                "logger_in_an_attribute_that_is_not_set",
                Replace(NODE, "self.get_logger().info", "self.logger_.info"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "counter_not_set_in_a_class_without_init",
                Replace(
                    NODE,
                    "    def __init__(self):\n",
                    "    def prepare(self):\n",
                ),
                Replace(NODE, "        super().__init__('my_first_node')\n", ""),
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(
                    NODE,
                    "node = MyFirstNode()",
                    "node = MyFirstNode('my_first_node')\n    node.prepare()",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
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
                "private_name_of_a_base_class",
                Replace(
                    NODE,
                    "class MyFirstNode(Node):",
                    "class Counting(Node):\n    def __init__(self, name):\n        super().__init__(name)\n"
                    "        self.__count = 0\n\n\nclass MyFirstNode(Counting):",
                ),
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(NODE, "str(self.counter_)", "str(self.__count)"),
                Replace(NODE, "self.counter_ += 1", "self.__count += 1"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "helper_without_a_node",
                Replace(NODE, "self.get_logger().info(", "Speaker().speak("),
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class Speaker:\n    def speak(self, text):\n        self.get_logger().info(text)\n\n\nclass MyFirstNode",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "node_kept_in_an_attribute",
                Replace(NODE, "class MyFirstNode(Node)", "class MyFirstNode"),
                Replace(
                    NODE, "super().__init__('my_first_node')", "self.node = Node('my_first_node')"
                ),
                Replace(NODE, "node = MyFirstNode()", "node = MyFirstNode().node"),
                fails="run.starts",
            ),
            example(
                "counter_set_by_named_method",
                Replace(NODE, "self.counter_ = 0", "self.start_from_zero"),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def start_from_zero(self):\n        self.counter_ = 0\n\n    def timer_callback",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "counter_set_without_a_dot",
                Replace(NODE, "self.counter_ = 0", "selfcounter_ = 0"),
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
                "another_counter_is_raised",
                Replace(NODE, "self.counter_ += 1", "self.i += 1"),
                fails="run.output",
                blocks=("run.interrupt",),
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
        "attribute_unknown",
        "callback",
        msg("An object has no attribute with that name"),
        msg("The object before the dot has no such attribute: {name}"),
        msg(
            "Look up what this object can do: in the documentation of its class, or in the class if "
            "it is your own. There may be another name for {name}, or no such thing. Or another "
            "object is meant."
        ),
        links.RCLPY,
        close=msg("Write {close} instead of {name}."),
        whys={
            "written": msg(
                "What stands before the dot has nothing of that name. Here it is meant in another way than "
                "{name}."
            ),
            "function": OF_FILE,
            "function_more": OF_FILE,
            "parameter": msg(
                "get_parameter returns an object of the type Parameter. Its value is in .value, or in "
                "get_parameter_value()."
            ),
            "number": msg("{number} is a number, and a number has no such attribute."),
            "none": msg(
                "A value on that line is None: nothing was assigned to it, or a function returned "
                "nothing."
            ),
            "self": msg(
                "Small and capital letters are different names in Python: in a method, self is the "
                "object, and the name before the dot here is another one."
            ),
            "class_kept": msg(
                "Without (), {type} is the class itself. Only an object of it has what its __init__ sets."
            ),
            "of_node": msg("This is a method of the node, and no function of the module rclpy."),
            "module": msg("The module rclpy has nothing with the name {name}."),
            "bare_object": msg(
                "An object that object() makes cannot get attributes, such as {name}."
            ),
            "of_add_node": msg(
                "add_node does not give back the executor, so {name} is no executor here."
            ),
            "annotated": msg(
                "A colon after a name only states a type. A value is assigned with =, so the class "
                "has no {attribute}."
            ),
        },
        fixes={
            **dict.fromkeys(("written", "self"), msg("Write {written} instead of {name}.")),
            "of_node": msg("Write {written} instead of {name}."),
            "class_kept": msg("Write {written} instead of {name}."),
            "similar": msg(
                "Look up what a {type} can do. It has the similar name {other}: write that only if "
                "it does what you want."
            ),
            "own_class": msg(
                "Write a name that the class {type} has (line {line}), or let its __init__ set "
                "self.{name}."
            ),
            "function": msg("Write {written} instead of {name}."),
            "function_more": msg(
                "Call the function without self. before its name, and give it a value for each of its "
                "parameters."
            ),
            "parameter": msg("Write {written} instead of {name} behind get_parameter(…)."),
            "number": msg("Write {written} instead of {name}."),
            "none": msg("Find the line that should give it its value, and see what that does."),
            "bare_object": msg(
                "Write SimpleNamespace() instead of object(), and add the line from types import "
                "SimpleNamespace at the top of the file."
            ),
            "of_add_node": msg(
                "Write two lines instead of this one. The first: {statement} The second: {step}"
            ),
            "annotated": msg("Write {written} instead of {name}."),
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
                "create_timer_of_rclpy_with_the_node",
                Replace(NODE, "self.create_timer(1.0,", "rclpy.create_timer(self, 1.0,"),
                fails="run.starts",
            ),
            example(
                "function_that_needs_the_node_called_as_a_method",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "def say(node, text):\n    node.get_logger().info(text)\n\n\nclass MyFirstNode",
                ),
                Replace(NODE, "self.get_logger().info(", "self.say("),
                fails="run.output",
                blocks=DEAD,
            ),
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
                "class_kept_for_an_object",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class Texts:\n    def __init__(self):\n        self.text = 'Hello time: '\n\n\nclass MyFirstNode",
                ),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.texts = Texts"),
                Replace(NODE, "'Hello time: ' + str", "self.texts.text + str"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "number_to_text_as_a_column",
                Replace(NODE, "str(self.counter_)", "self.counter_.astype(str)"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "number_adds_by_a_method",
                Replace(NODE, "self.counter_ += 1", "self.counter_.increment()"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "values_in_an_object",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = 0\n        self.state = object()\n        self.state.text = 'a'",
                ),
                fails="run.starts",
            ),
            example(
                "executor_is_what_add_node_returns",
                Replace(
                    NODE,
                    "rclpy.spin(node)",
                    "executor = rclpy.executors.SingleThreadedExecutor().add_node(node)\n"
                    "        executor.spin()",
                ),
                fails="run.starts",
            ),
            example(
                "value_of_a_class_with_a_colon",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class Texts:\n    hello: 'Hello time: '\n\n\nclass MyFirstNode",
                ),
                Replace(NODE, "'Hello time: ' + str", "Texts().hello + str"),
                fails="run.output",
                blocks=DEAD,
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
