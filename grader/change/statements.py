"""Operators of calls and statements: called or not, missing, too much, in the wrong place."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from grader.base.i18n.message import msg
from grader.change.operator import (
    Made,
    Operator,
    Site,
    above,
    inserted,
    is_text,
    moved,
    operator,
    swapped,
)
from grader.change.values import INSTEAD
from grader.package.source.module import Function
from grader.package.source.names import called_name, dotted, last_part

USES = ast.Assign | ast.Attribute | ast.BinOp | ast.Return | ast.Lambda
GETTERS = ("get_logger", "get_clock", "get_name")
LOGS = ("debug", "info", "warn", "warning", "error", "fatal")
ENDS = ("create_timer", "create_subscription", "create_service", "create_publisher")
BELOW = msg("Below {name}, insert the line {written}.")


@operator(
    "called",
    cost=1,
    certain=True,
    why=msg(
        "{name} without parentheses is only the name of a function: nothing is called, and no error "
        "is reported."
    ),
    fix=INSTEAD,
)
def called(site: Site) -> Iterator[Made]:
    """Yield a call in place of a statement that only names a function."""
    for node in site.of(ast.Expr):
        assert isinstance(node, ast.Expr)
        if not isinstance(node.value, ast.Attribute | ast.Name):
            continue
        code, function = site.code(node.value), site.function_of(node)
        yield swapped(site, node, f"{code}()")
        if function is not None:
            for name, _ in _messages(site, function):
                yield swapped(site, node, f"{code}({name})")
    known = {*site.module.functions, *(c.name for c in site.module.classes)}
    known |= {f"self.{name}" for name in (*site.methods, *GETTERS)}
    for value in site.of((ast.Name, ast.Attribute)):
        around = site.module.parents.get(value)
        used = isinstance(around, USES)
        if isinstance(value, ast.expr) and used and dotted(value) in known:
            yield swapped(site, value, f"{dotted(value)}()", more=1)


@operator(
    "not_called",
    cost=1,
    certain=True,
    why=msg("ROS gets the function itself and calls it later. With parentheses it is called now."),
    fix=INSTEAD,
)
def not_called(site: Site) -> Iterator[Made]:
    """Yield a callback without parentheses."""
    for call in site.of(ast.Call):
        assert isinstance(call, ast.Call)
        for given in call.args if called_name(call) in ENDS else ():
            if isinstance(given, ast.Call) and dotted(given.func).startswith("self."):
                yield swapped(site, given, site.code(given.func))


@operator(
    "async_call",
    cost=1,
    why=msg(
        "call() waits for the answer in the thread that would have to bring it: the node stands "
        "still from then on. call_async() goes on at once."
    ),
    fix=INSTEAD,
)
def async_call(site: Site) -> Iterator[Made]:
    """Yield call_async in place of call."""
    for node in site.of(ast.Call):
        function = node.func if isinstance(node, ast.Call) and node.args else None
        if isinstance(function, ast.Attribute) and function.attr == "call":
            yield swapped(site, function, f"{site.code(function.value)}.call_async")


@operator(
    "swapped",
    cost=2,
    why=msg("The order of the values decides which is which."),
    fix=INSTEAD,
)
def arguments(site: Site) -> Iterator[Made]:
    """Yield the first two arguments of a call in the other order."""
    for node in site.of(ast.Call):
        if not isinstance(node, ast.Call) or len(node.args) < 2:
            continue
        first, second = node.args[:2]
        if _fits(site, node):
            continue
        one, other = site.code(first), site.code(second)
        text = site.module.text
        splices = (text.swap(first, other), text.swap(second, one))
        written = site.code(node).replace(one, "\0", 1).replace(other, one, 1).replace("\0", other)
        yield Made(node, site.code(node), written, splices)


def _fits(site: Site, call: ast.Call) -> bool:
    """Whether an argument has the name of the parameter that gets it."""
    name = dotted(call.func).rpartition(".")[2]
    called = next((one for one in site.functions if one.name == name), None)
    taken = [a.arg for a in called.args.args if a.arg != "self"] if called is not None else []
    return any(dotted(given).rpartition(".")[2] == name for given, name in zip(call.args, taken))


@operator(
    "returned",
    cost=1,
    why=msg(
        "The callback of a service has to return the response: what it returns is the answer, and "
        "without it there is none."
    ),
    fix=BELOW,
)
def returned(site: Site) -> Iterator[Made]:
    """Yield a function of two arguments that returns the last one."""
    for function in site.functions:
        given = [a.arg for a in function.args.args if a.arg != "self"]
        last = function.body[-1]
        if len(given) == 2 and not isinstance(last, ast.Return):
            yield inserted(site, last, f"return {given[-1]}")
        for node in ast.walk(function):
            if not isinstance(node, ast.Return) or len(given) != 2:
                continue
            if node.value is None or dotted(node.value) != given[-1]:
                yield swapped(site, node, f"return {given[-1]}", more=1)


def _messages(site: Site, function: Function) -> list[tuple[str, ast.Assign]]:
    """Return the variables of a function that are set to a new message, with that statement."""
    found = []
    for node in site.simple(function):
        value = node.value if isinstance(node, ast.Assign) else None
        target = dotted(node.targets[0]) if isinstance(node, ast.Assign) else ""
        made = isinstance(value, ast.Call) and last_part(dotted(value.func))[:1].isupper()
        if isinstance(node, ast.Assign) and made and target.isidentifier():
            found.append((target, node))
    return found


@operator(
    "sent",
    cost=2,
    why=msg("No line of this function sends the message that it makes."),
    fix=BELOW,
)
def sent(site: Site) -> Iterator[Made]:
    """Yield a call that publishes or asks below the last line of a new message."""
    senders = _senders(site)
    for function in site.functions:
        names = [name for name, _ in _messages(site, function)]
        for name in (*names, *_filled_attributes(function)):
            uses = [
                s
                for s in site.simple(function)
                if any(isinstance(n, ast.expr) and dotted(n) == name for n in ast.walk(s))
            ]
            for sender in senders:
                if uses and f"{sender}({name})" not in site.code(uses[-1]):
                    yield inserted(site, uses[-1], f"{sender}({name})")


def _senders(site: Site) -> list[str]:
    """Return what sends a message or a request: the methods of publishers and clients."""
    senders = []
    for name, places in site.attributes.items():
        made = getattr(site.module.parents.get(places[0]), "value", None)
        if isinstance(made, ast.Call) and called_name(made) == "create_publisher":
            senders.append(f"self.{name}.publish")
        elif isinstance(made, ast.Call) and called_name(made) == "create_client":
            senders.append(f"self.{name}.call_async")
    return senders


def _filled_attributes(function: Function) -> list[str]:
    """Return the attributes of self whose fields a function sets: messages that are kept."""
    targets = [
        dotted(n) for n in ast.walk(function) if isinstance(getattr(n, "ctx", None), ast.Store)
    ]
    parts = [target.split(".") for target in targets if target.startswith("self.")]
    return list(dict.fromkeys(f"self.{part[1]}" for part in parts if len(part) > 2))


@operator(
    "filled",
    cost=3,
    hides=True,
    why=msg("A field that no line sets is 0, False or an empty text."),
    fix=BELOW,
)
def filled(site: Site) -> Iterator[Made]:
    """Yield a line that sets a field of a message which no line of the function sets."""
    for function in site.functions:
        given = [a.arg for a in function.args.args if a.arg != "self"]
        targets = [(name, node, node) for name, node in _messages(site, function)]
        if len(given) == 2 and function.body:
            targets.append((given[-1], None, function.body[0]))  # type: ignore[arg-type]
        for name, below, first in targets:
            for path, value in site.wanted.fields:
                if f"{name}.{path}" in site.code(function):
                    continue
                row = f"{name}.{path} = {value!r}"
                if below is not None:
                    yield inserted(site, below, row)
                elif not is_text(first):
                    yield above(site, first, row)
                elif len(function.body) > 1:
                    yield above(site, function.body[1], row)


@operator(
    "field_of",
    cost=1,
    why=msg("This line replaces the message by a value. The value belongs into a field of it."),
    fix=INSTEAD,
)
def field_of(site: Site) -> Iterator[Made]:
    """Yield a field of a message as the target, where a statement replaces the message."""
    fields = [path for path, _ in site.wanted.fields] or ["data"]
    for function in site.functions:
        for name, made in _messages(site, function):
            for node in site.simple(function):
                target = node.targets[0] if isinstance(node, ast.Assign) else None
                if target is None or node is made or dotted(target) != name:
                    continue
                for path in fields:
                    yield swapped(site, target, f"{name}.{path}")


@operator(
    "once",
    cost=2,
    why=msg(
        "{name} runs in each call of this function, and each time makes another one beside those "
        "that are there."
    ),
    fix=msg("Move the line {name} to __init__, so that it runs once."),
)
def once(site: Site) -> Iterator[Made]:
    """Yield what makes an end or a timer, moved to __init__."""
    init = site.methods.get("__init__")
    if init is None:
        return
    for name, method in site.methods.items():
        for statement in site.simple(method) if name != "__init__" else ():
            code = site.code(statement)
            if any(f"{end}(" in code for end in ENDS):
                end = (init.end_lineno or init.lineno) + 1
                yield moved(site, statement, end, site.indent(init.body[-1]))


@operator(
    "state",
    cost=3,
    hides=True,
    why=msg("No line keeps what happened last time, so each call decides as the first one did."),
    fix=BELOW,
)
def state(site: Site) -> Iterator[Made]:
    """Yield a line that sets an attribute which is only set in __init__ to a variable."""
    for name, places in site.attributes.items():
        functions = {site.function_of(place) for place in places}
        if any(f is None or f.name != "__init__" for f in functions):
            continue
        value = getattr(site.module.parents.get(places[0]), "value", None)
        if not isinstance(value, ast.Constant):
            continue
        for function in site.functions:
            if function.name == "__init__" or f"self.{name}" not in site.code(function):
                continue
            last = _last_use(site, function, name)
            for local in [*site.locals_of(function), *(["True", "False"])][:6]:
                if last is not None:
                    yield inserted(
                        site, last, f"self.{name} = {local}", more=local in ("True", "False")
                    )


def _last_use(site: Site, function: Function, name: str) -> ast.stmt | None:
    for statement in reversed(function.body):
        if f"self.{name}" in site.code(statement):
            return statement
    return None


@operator(
    "also_when",
    cost=3,
    why=msg("The lines of the block run each time, not only when something changes."),
    fix=INSTEAD,
)
def also_when(site: Site) -> Iterator[Made]:
    """Yield a condition together with that of a flag of the node."""
    flags = [
        name
        for name, places in site.attributes.items()
        if isinstance(getattr(site.module.parents.get(places[0]), "value", None), ast.Constant)
        and isinstance(site.module.parents[places[0]].value.value, bool)  # type: ignore[attr-defined]
    ]
    for node in site.of(ast.If):
        assert isinstance(node, ast.If)
        for name in flags:
            if f"self.{name}" not in site.code(node.test) and site.function_of(node) is not None:
                for word in ("not ", ""):
                    yield swapped(site, node.test, f"{site.code(node.test)} and {word}self.{name}")


@operator(
    "reset",
    cost=3,
    why=msg("Nothing sets this back: once it has changed, it stays so."),
    fix=INSTEAD,
)
def reset(site: Site) -> Iterator[Made]:
    """Yield `self.a = condition` in place of `if condition: self.a = True`."""
    for node in site.of(ast.If):
        assert isinstance(node, ast.If)
        only = node.body[0] if len(node.body) == 1 and not node.orelse else None
        value = only.value if isinstance(only, ast.Assign) else None
        fixed = value.value if isinstance(value, ast.Constant) else None
        if not isinstance(only, ast.Assign) or not isinstance(fixed, bool):
            continue
        test = site.code(node.test)
        new = test if fixed else f"not ({test})"
        yield swapped(site, node, f"{site.code(only.targets[0])} = {new}", more=-1)


@operator(
    "asked_data",
    cost=1,
    why=msg("What was asked for is in the argument, and this line does not read it."),
    fix=INSTEAD,
)
def asked_data(site: Site) -> Iterator[Made]:
    """Yield the first argument's `data` in place of a fixed value, in a callback."""
    for function in site.functions:
        given = [a.arg for a in function.args.args if a.arg != "self"]
        if not given or function.name == "__init__":
            continue
        for node in site.simple(function):
            value = getattr(node, "value", None)
            target = node.targets[0] if isinstance(node, ast.Assign) else None
            own = dotted(target).startswith("self.") if target is not None else False
            opposite = isinstance(value, ast.UnaryOp) and isinstance(value.op, ast.Not)
            if (
                own
                and isinstance(value, ast.expr)
                and (isinstance(value, ast.Constant) or opposite)
            ):
                yield swapped(site, value, f"{given[0]}.data")


@operator(
    "none_first",
    cost=1,
    why=msg("These lines use what is still None: nothing has come yet when they run first."),
    fix=msg("Above {name}, insert {written} and, indented below it, return."),
)
def none_first(site: Site) -> Iterator[Made]:
    """Yield a function that returns while an attribute is None."""
    empty = [
        name
        for name, places in site.attributes.items()
        if any(
            isinstance(value := getattr(site.module.parents.get(p), "value", None), ast.Constant)
            and value.value is None
            for p in places
        )
    ]
    for function in site.functions:
        for name in empty if function.name != "__init__" else ():
            body = [s for s in function.body if not is_text(s)]
            if body and f"self.{name}." in site.code(function):
                rows = (f"if self.{name} is None:", "    return")
                yield above(site, body[0], *rows)


@operator(
    "deleted",
    cost=4,
    hides=True,
    why=msg("Without this line the check passes: it undoes what other lines do."),
    fix=msg("Look at the line {name}: delete it, or make it run at another time."),
    shows=True,
)
def deleted(site: Site) -> Iterator[Made]:
    """Yield the file without one of its plain statements."""
    for function in site.functions:
        for node in site.simple(function):
            if len(site.block(node)) > 1:
                rows = range(node.lineno, (node.end_lineno or node.lineno) + 1)
                gone = tuple(site.module.text.without(row) for row in rows)
                yield Made(node, site.module.line(node.lineno), "", gone)


@operator(
    "shown",
    cost=1,
    certain=True,
    why=msg(
        "Lines of the level debug are not shown, unless the node is started with another level."
    ),
    fix=INSTEAD,
)
def shown(site: Site) -> Iterator[Made]:
    """Yield info in place of debug."""
    for node in site.of(ast.Attribute):
        if isinstance(node, ast.Attribute) and node.attr == "debug":
            yield swapped(site, node, f"{site.code(node.value)}.info")


@operator(
    "argument",
    cost=3,
    certain=True,
    why=msg("{name} passes one value more than is needed here."),
    fix=INSTEAD,
)
def argument(site: Site) -> Iterator[Made]:
    """Yield calls without one of their arguments."""
    for node in site.of(ast.Call):
        assert isinstance(node, ast.Call)
        given: list[ast.expr | ast.keyword] = [*node.args, *node.keywords]
        for gone in given:
            rest = ", ".join(site.module.text.code(one) for one in given if one is not gone)
            yield swapped(site, node, f"{site.code(node.func)}({rest})")


@operator(
    "counted",
    cost=3,
    hides=True,
    why=msg("No line of this function changes the number, so each call logs the same one."),
    fix=BELOW,
)
def counted(site: Site) -> Iterator[Made]:
    """Yield a line that counts at the end of a function that logs a number which it does not change."""
    for function in site.functions:
        code = site.code(function)
        if not any(f".{level}(" in code for level in LOGS):
            continue
        for name, places in site.attributes.items():
            start = getattr(site.module.parents.get(places[0]), "value", None)
            is_number = isinstance(start, ast.Constant) and type(start.value) is int
            is_set = any(site.function_of(place) is function for place in places)
            if is_number and f"self.{name}" in code and not is_set:
                for step in dict.fromkeys((1, *site.wanted.numbers)):
                    yield inserted(site, function.body[-1], f"self.{name} += {step}")


OPERATORS: tuple[Operator, ...] = (
    *(shown, argument, counted),
    *(called, not_called, async_call, returned, none_first, field_of, asked_data, once),
    *(reset, arguments, sent, filled, state, also_when, deleted),
)
