"""Operators of names: attributes, variables, fields of messages, parameters and callbacks."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from itertools import product

from grader.base.i18n.message import msg
from grader.change.operator import Made, Operator, Site, operator, swapped
from grader.change.values import INSTEAD
from grader.package.source.module import Function
from grader.package.source.names import called_name, dotted, last_part
from grader.package.source.place import owns_lines

MOST_NAMES = 8
FIELDS = (
    ("x", "y", "z", "theta"),
    ("linear", "angular"),
    ("linear_velocity", "angular_velocity"),
    ("range_min", "range_max"),
)
"""Fields of messages that stand in each other's place."""
INTERFACES = (".msg", ".srv", ".action")
CREATES = ("create_timer", "create_subscription", "create_service")


@operator(
    "own",
    cost=1,
    why=msg(
        "{name} without self. is a variable of this function alone: it is gone when the function "
        "ends. self.{name} is what the other functions read."
    ),
    fix=INSTEAD,
)
def own(site: Site) -> Iterator[Made]:
    """Yield a local or unknown name, in all its places, as the attribute or method of self."""
    for function in site.functions:
        names = [n for n in ast.walk(function) if isinstance(n, ast.Name)]
        for name in _without_self(site, function):
            uses = [n for n in names if n.id == name]
            splices = tuple(site.module.text.swap(use, f"self.{name}") for use in uses)
            at = next((n for n in uses if isinstance(n.ctx, ast.Store)), uses[0])
            yield Made(at, name, f"self.{name}", splices)


def _without_self(site: Site, function: Function) -> Iterator[str]:
    """Yield the names of a function that only self has, or that it sets and self has too."""
    given = {each.arg for each in function.args.args}
    local, methods = set(site.locals_of(function)) - given, {*site.methods}
    unknown = {*site.attributes, *methods} - (site.module.names - methods) - local
    for node in ast.walk(function):
        name = node.id if isinstance(node, ast.Name) else ""
        if name in (local & {*site.attributes} | unknown) - given:
            local.discard(name)
            unknown.discard(name)
            yield name


@operator(
    "remembered",
    cost=1,
    why=msg(
        "{name} runs in each call of the function: what a call before has set is gone. An attribute of "
        "self keeps it."
    ),
    fix=msg("Set it once, in __init__, and use it here: {written}"),
)
def remembered(site: Site) -> Iterator[Made]:
    """Yield an attribute in place of a local name that is set to a constant first, and changed later."""
    init, text = site.methods.get("__init__"), site.module.text
    for function in site.methods.values() if init is not None else ():
        for first, uses in _states(function) if function is not init else ():
            target = first.targets[0]
            assert init is not None and isinstance(target, ast.Name)
            if target.id not in site.attributes and owns_lines(site.module, first):
                row = f"self.{target.id} = {site.code(first.value)}"
                last = init.body[-1]
                put = text.before((last.end_lineno or 0) + 1, site.indent(last) + row)
                now = (text.swap(use, f"self.{target.id}") for use in uses)
                yield Made(first, site.code(first), row, (text.without(first.lineno), put, *now))


def _states(function: Function) -> Iterator[tuple[ast.Assign, list[ast.Name]]]:
    """Yield what sets a local name to a constant at first, and the later places that read and set it."""
    names = [n for n in ast.walk(function) if isinstance(n, ast.Name)]
    for first in function.body:
        target = first.targets[0] if isinstance(first, ast.Assign) else None
        if isinstance(first, ast.Assign) and isinstance(target, ast.Name):
            later = [n for n in names if n.id == target.id and n is not target]
            is_state = {type(n.ctx) for n in later} == {ast.Load, ast.Store}
            if is_state and isinstance(first.value, ast.Constant):
                yield first, later


@operator(
    "kept",
    cost=2,
    why=msg("The new value is in {name}, and that is gone when the function ends."),
    fix=INSTEAD,
)
def kept(site: Site) -> Iterator[Made]:
    """Yield `self.a = self.a + b` in place of `b = self.a + b`."""
    for node in site.of(ast.Assign):
        assert isinstance(node, ast.Assign)
        target, value = node.targets[0], node.value
        if not isinstance(target, ast.Name) or not isinstance(value, ast.BinOp):
            continue
        first = dotted(value.left)
        if first.startswith("self.") and first.count(".") == 1:
            yield swapped(site, target, first)


@operator(
    "attribute",
    cost=3,
    hides=True,
    why=msg("{name} has another value than the one that belongs here."),
    fix=INSTEAD,
)
def attribute(site: Site) -> Iterator[Made]:
    """Yield another attribute of self, or another variable, in place of one that is read."""
    names = [f"self.{name}" for name, places in site.attributes.items() if _is_plain(site, places)]
    for function in site.functions:
        here = site.locals_of(function)
        for node in ast.walk(function):
            if not isinstance(node, ast.Name | ast.Attribute) or not isinstance(node.ctx, ast.Load):
                continue
            around = site.module.parents.get(node)
            name = dotted(node)
            inside = isinstance(around, ast.Attribute) or (
                isinstance(around, ast.Call) and around.func is node
            )
            if inside or site.code(node) != name:
                continue
            if name in names or name in here:
                for other in (*names, *here)[: 2 * MOST_NAMES]:
                    if other != name:
                        yield swapped(site, node, other)


def _is_plain(site: Site, places: list[ast.Attribute]) -> bool:
    """Whether an attribute is a value, and no object that a call makes."""
    value = getattr(site.module.parents.get(places[0]), "value", None)
    return not (isinstance(value, ast.Call) and called_name(value).startswith("create_"))


@operator(
    "base_name",
    cost=3,
    hides=True,
    why=msg("{name} is of another message than the one that is meant here."),
    fix=INSTEAD,
)
def base_name(site: Site) -> Iterator[Made]:
    """Yield another message before a field: the new one in place of the last one."""
    for function in site.functions:
        given = [a.arg for a in function.args.args if a.arg != "self"]
        for node in ast.walk(function):
            if not isinstance(node, ast.Attribute) or not isinstance(node.ctx, ast.Load):
                continue
            base = dotted(node.value)
            known = [*given, *(f"self.{name}" for name in site.attributes)]
            around = site.module.parents.get(node)
            if base not in known or (isinstance(around, ast.Call) and around.func is node):
                continue
            for other in known[:MOST_NAMES]:
                if other != base:
                    yield swapped(site, node.value, other, at=node)


@operator(
    "field",
    cost=1,
    why=msg(
        "Each field of a message means something else: x is forwards, y to the left, z upwards, and "
        "a velocity is linear (m/s) or angular (rad/s)."
    ),
    fix=INSTEAD,
)
def field(site: Site) -> Iterator[Made]:
    """Yield the fields of messages that are taken for one another.

    A field that is set is one of those that the check asks for, or becomes one.
    """
    asked = {name for path in site.wanted.paths for name in path.split(".")}
    for node in site.of(ast.Attribute):
        assert isinstance(node, ast.Attribute)
        around = (node, site.module.parents.get(node))
        is_set = any(isinstance(getattr(one, "ctx", None), ast.Store) for one in around)
        for group in FIELDS:
            if node.attr not in group:
                continue
            base = site.code(node.value)
            for other in group:
                if other != node.attr and (not is_set or asked & {node.attr, other}):
                    yield swapped(site, node, f"{base}.{other}")


@operator(
    "read_now",
    cost=1,
    why=msg(
        "{name} got the parameter's value once, when the node started. When somebody sets the "
        "parameter, only get_parameter returns the new value."
    ),
    fix=INSTEAD,
)
def read_now(site: Site) -> Iterator[Made]:
    """Yield the parameter's value now, where an attribute has the value of the start."""
    for name, places in site.attributes.items():
        made = site.module.parents.get(places[0])
        value = getattr(made, "value", None)
        if len(places) != 1 or not isinstance(value, ast.expr):
            continue
        if "get_parameter" not in site.code(value) and "declare_parameter" not in site.code(value):
            continue
        code = site.code(value)
        if "declare_parameter" in code:
            call = next((n for n in ast.walk(value) if isinstance(n, ast.Call) and n.args), None)
            if call is None:
                continue
            code = f"self.get_parameter({site.code(call.args[0])}).value"
        for node in site.of(ast.Attribute):
            assert isinstance(node, ast.Attribute)
            if dotted(node) == f"self.{name}" and isinstance(node.ctx, ast.Load):
                yield swapped(site, node, code)


@operator(
    "use_parameter",
    cost=2,
    why=msg(
        "{name} is fixed here. The value of the parameter changes nothing, because no line reads it "
        "at this place."
    ),
    fix=INSTEAD,
)
def use_parameter(site: Site) -> Iterator[Made]:
    """Yield a parameter's value, or an unread variable, in place of a number."""
    declared = [
        site.code(n.args[0])
        for n in site.of(ast.Call)
        if isinstance(n, ast.Call) and called_name(n) == "declare_parameter" and n.args
    ]
    for node in site.of(ast.Constant):
        if not isinstance(node, ast.Constant) or type(node.value) not in (int, float):
            continue
        function, around = site.function_of(node), site.module.parents.get(node)
        if function is None or function.name == "__init__":
            continue
        if isinstance(around, ast.Call) and called_name(around) != "":
            continue
        for name in _unread(function):
            yield swapped(site, node, name)
        for name in declared:
            yield swapped(site, node, f"self.get_parameter({name}).value", more=1)


def _unread(function: Function) -> list[str]:
    names = [n for n in ast.walk(function) if isinstance(n, ast.Name)]
    read = {n.id for n in names if isinstance(n.ctx, ast.Load)}
    return [n.id for n in names if isinstance(n.ctx, ast.Store) and n.id not in read]


@operator(
    "callback",
    cost=2,
    why=msg("{name} is called for this, and the lines that belong to it are in another function."),
    fix=INSTEAD,
)
def callback(site: Site) -> Iterator[Made]:
    """Yield another method of the class as a callback."""
    for call in site.of(ast.Call):
        if not isinstance(call, ast.Call) or called_name(call) not in CREATES:
            continue
        for given in (*call.args, *(k.value for k in call.keywords)):
            name = dotted(given)
            if not name.startswith("self.") or name[5:] not in site.methods:
                continue
            for other in site.methods:
                if not other.startswith("__") and f"self.{other}" != name:
                    yield swapped(site, given, f"self.{other}")


@operator(
    "data_of",
    cost=1,
    why=msg("{name} is the whole message. What was sent is in a field of it."),
    fix=INSTEAD,
)
def data_of(site: Site) -> Iterator[Made]:
    """Yield the field `data` of what a callback gets, where the whole message is used."""
    for function in site.functions:
        given = [each.arg for each in function.args.args if each.arg != "self"]
        if len(given) != 1 or function.name == "__init__":
            continue
        for node in ast.walk(function):
            is_whole = not isinstance(site.module.parents.get(node), ast.Attribute)
            if isinstance(node, ast.Name) and node.id == given[0] and is_whole:
                yield swapped(site, node, f"{node.id}.data")


@operator(
    "of_type",
    cost=1,
    why=msg("A topic, a service or an action has one type, and this line imports another one."),
    fix=INSTEAD,
    untried=True,
)
def of_type(site: Site) -> Iterator[Made]:
    """Yield the wanted type of an interface in place of an imported one, wherever that is used."""
    wanted = [one.split("/") for one in site.wanted.types if one.count("/") == 2]
    for node in site.of(ast.ImportFrom):
        if isinstance(node, ast.ImportFrom) and (node.module or "").endswith(INTERFACES):
            for alias, (package, kind, short) in product(node.names, wanted):
                if not alias.asname and (node.module, alias.name) != (f"{package}.{kind}", short):
                    yield _imported(site, node, alias, f"{package}.{kind}", short)


def _imported(site: Site, node: ast.ImportFrom, alias: ast.alias, module: str, short: str) -> Made:
    """Return the change of one imported name, in all of its places, into that of another type."""
    row = f"from {module} import {short}"
    rest = ", ".join(ast.unparse(one) for one in node.names if one is not alias)
    kept = f"from {node.module} import {rest}\n{site.indent(node)}" if rest else ""
    names = [n for n in site.of(ast.Name) if isinstance(n, ast.Name) and n.id == alias.name]
    uses = [site.module.text.swap(name, short) for name in names]
    splices = (site.module.text.swap(node, kept + row), *uses)
    old = f"from {node.module} import {alias.name}"
    return Made(node, old, row, splices, int(alias.name != short))


@operator(
    "none_yet",
    cost=1,
    certain=True,
    why=msg(
        "{name} is a message with zeros, and not None: the test for None never finds that none has come."
    ),
    fix=INSTEAD,
)
def none_yet(site: Site) -> Iterator[Made]:
    """Yield None for a new message in the constructor, if a line asks whether that is None."""
    asked = {
        dotted(node.left)
        for node in site.of(ast.Compare)
        if isinstance(node, ast.Compare) and isinstance(node.ops[0], ast.Is | ast.IsNot)
    }
    for node in site.of(ast.Assign):
        if isinstance(node, ast.Assign) and dotted(node.targets[0]) in asked:
            kind = last_part(dotted(node.value.func)) if isinstance(node.value, ast.Call) else ""
            if kind[:1].isupper():
                yield swapped(site, node.value, "None")


@operator(
    "wrapped",
    cost=1,
    certain=True,
    why=msg("{name} is no message: that is an object of its type, and what it says is in a field."),
    fix=INSTEAD,
)
def wrapped(site: Site) -> Iterator[Made]:
    """Yield a message around what is published, if the publisher's type has just the field data."""
    calls = [node for node in site.of(ast.Call) if isinstance(node, ast.Call) and node.args]
    plain = {
        alias.asname or alias.name
        for node in site.of(ast.ImportFrom)
        if isinstance(node, ast.ImportFrom) and node.module == "std_msgs.msg"
        for alias in node.names
    }
    types = {
        dotted(made.targets[0]): site.code(call.args[0])
        for call in calls
        if called_name(call) == "create_publisher"
        and isinstance(made := site.module.parents.get(call), ast.Assign)
    }
    for call in calls:
        sender, _, name = dotted(call.func).rpartition(".")
        if name == "publish" and types.get(sender) in plain:
            yield swapped(site, call.args[0], f"{types[sender]}(data={site.code(call.args[0])})")


@operator(
    "inverse",
    cost=1,
    certain=True,
    why=msg(
        "create_timer() takes the time from one call to the next, in seconds, and not how often per second."
    ),
    fix=INSTEAD,
)
def inverse(site: Site) -> Iterator[Made]:
    """Yield 1 / x in place of x as the period of a timer, and the other way round."""
    for call in site.of(ast.Call):
        if not isinstance(call, ast.Call) or called_name(call) != "create_timer" or not call.args:
            continue
        given = call.args[0]
        if isinstance(given, ast.Name | ast.Attribute):
            yield swapped(site, given, f"1.0 / {site.code(given)}")
        elif (
            isinstance(given, ast.BinOp)
            and isinstance(given.op, ast.Div)
            and getattr(given.left, "value", None) == 1
        ):
            yield swapped(site, given, site.code(given.right))


OPERATORS: tuple[Operator, ...] = (
    *(
        own,
        remembered,
        kept,
        of_type,
        field,
        data_of,
        read_now,
        use_parameter,
        callback,
        inverse,
        base_name,
        none_yet,
        wrapped,
        attribute,
    ),
)
