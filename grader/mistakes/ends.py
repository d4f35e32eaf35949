"""Mistakes at the ends of a node: topics and services, their callbacks, messages and fields.

rclpy refuses what it gets at the line of the student's that passes it: the text says what it takes.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.fixes import lines
from grader.mistakes.kind import INSTEAD, Family
from grader.mistakes.recognised import FromError, Raised, RecognisedMistake, always
from grader.package.source.module import Function
from grader.package.source.names import called_name, calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import statement_at

ENDS = ("create_subscription", "create_service")
TAKES = {
    "create_publisher": "(Type, 'name', 10)",
    "create_subscription": "(Type, 'name', self.callback, 10)",
    "create_service": "(Type, 'name', self.callback)",
    "create_client": "(Type, 'name')",
}
"""What makes an end of a topic or of a service, with what it takes."""
REFUSED = (
    r"rclpy_resolve_name\(\): incompatible function arguments|callback should be either be callable"
    r"|The service type provided is not valid|has no attribute '_TYPE_SUPPORT'"
    r"|Expected QoSProfile or int, but received|is not callable|positional argument"
    r"|Failed to create (?:subscription|publisher): "
)
SENT = (
    r"Expected <class '[\w.]*\.(?P<wanted>\w+)'>, got <class '[\w.]*?(?P<name>\w+)'>|Metaclass_"
    r"|^TypeError:?\s*$|Service classes can not be instantiated"
    r"|'(?:property|member_descriptor|getset_descriptor)'"
    r"|AttributeError: '\w{1,120}' object attribute '\w{1,120}' is read-only"
)
OF_SERVICE = "Service classes can not be instantiated"
PARTS = ("Request", "Response", "Goal", "Result", "Feedback")
ARGUMENTS = (
    r"\.?(?P<function>\w{1,120})\(\) (?:takes (?:\d+|from \d+ to \d+) positional arguments? but \d+ "
    r"(?:was|were) given|missing \d+ required positional arguments?: .*)"
)
FIELD = r"Assertion `Py\w{1,30}_Check\(field\)' failed|TypeError: bad argument type for built-in"
NO_PART = r"AttributeError: '(?:float|int|str|bool)' object has no attribute '[xyzw]'"


@dataclass(frozen=True)
class End:
    """A call that makes a subscription or a service, and what it passes as the callback."""

    call: ast.Call
    kind: str
    callback: ast.expr | None

    @property
    def method(self) -> str:
        """The name of the callback; "" if it has none."""
        given = self.callback.func if isinstance(self.callback, ast.Call) else self.callback
        return last_part(dotted(given)) if given is not None else ""


def ends(source: NodeSource) -> Iterator[End]:
    """Yield the subscriptions and services that a node makes."""
    for call, name in source.calls:
        kind = last_part(name)
        if kind in ENDS:
            named = {word.arg: word.value for word in call.keywords}
            given = call.args[2] if len(call.args) > 2 else named.get("callback")
            yield End(call, kind, given)


def _refused(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line makes an end, and rclpy refuses it; or a callback is called or in quotes there."""
    del match
    for end in ends(raised.source):
        given = end.callback
        if isinstance(given, ast.Call) and _returns_nothing(raised.source, end.method):
            text = raised.source.module_of(given).text
            params = {"name": text.code(given), "written": text.code(given.func)}
            return replace(
                raised.finding("end_arguments", at=given, params=params), variant="called"
            )
    statement = statement_at(raised.module, raised.line)
    for call, name in calls_in(statement) if statement is not None else ():
        kind = last_part(name)
        if kind in TAKES and f"{kind}() missing" not in raised.error:
            return raised.finding("end_arguments", at=call, name=kind, written=kind + TAKES[kind])
    for end in ends(raised.source):
        if isinstance(end.callback, ast.Constant):
            written = end.kind + TAKES[end.kind]
            return raised.finding("end_arguments", at=end.call, name=end.kind, written=written)
    return None


def _returns_nothing(source: NodeSource, name: str) -> bool:
    """Whether a node's files have a function of this name, and it returns no value."""
    known = [
        *source.methods.values(),
        *(f for one in source.known_modules for f in one.functions.values()),
    ]
    found = next((one for one in known if one.name == name), None)
    return found is not None and not _returns(found)


def _sent(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A type is used in place of a message, or a message of another type is sent."""
    statement = statement_at(raised.module, raised.line)
    for call, name in calls_in(statement) if statement is not None else ():
        if OF_SERVICE in raised.error and name in raised.interfaces:
            code = raised.module.text.code(call)
            written = code.replace(f"{name}(", f"{name}.Request(", 1)
            found = raised.finding(
                "other_message", at=call, params={"name": code, "written": written}
            )
            return replace(found, variant="service")
    for node in raised.source.all_nodes:
        used = _type_in(node, raised.interfaces)
        if used is not None:
            name = dotted(used)
            found = raised.finding("other_message", at=used, name=name, written=f"{name}()")
            return replace(found, variant="field" if used is node else "type")
    line = raised.module.line(raised.line)
    is_sent = (
        match[0].startswith(("Expected", "Service")) or "call_async" in line or ".call(" in line
    )
    return raised.finding("other_message") if is_sent else None


def _type_in(node: ast.AST, types: set[str]) -> ast.expr | None:
    """Return the type that is assigned or sent in place of a message, or whose field is read."""
    value = node.value if isinstance(node, ast.Assign | ast.Attribute) else None
    if isinstance(node, ast.Attribute):
        of_type = isinstance(value, ast.Name) and value.id in types and node.attr.islower()
        return node if of_type else None
    if isinstance(node, ast.Call) and called_name(node) in ("publish", "call_async", "call"):
        value = node.args[0] if node.args else None
    part = isinstance(value, ast.Attribute) and value.attr in PARTS
    return value if part or (isinstance(value, ast.Name) and value.id in types) else None


def _service_callback(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback of a service does not take request and response, or does not return the response."""
    called = match.groupdict().get("function")
    for end in ends(raised.source):
        method = raised.source.methods.get(end.method)
        if end.kind != "create_service" or method is None or called not in (None, end.method):
            continue
        if called:
            return raised.finding("service_callback", at=method, name=end.method)
        if not _returns(method):
            last, given = method.body[-1], method.args.args[-1].arg
            found = raised.finding("service_callback", at=last, name=end.method, written=given)
            return replace(found, variant="returned")
    return None


def _returns(method: Function) -> bool:
    """Whether each way through a function returns a value that is not a constant."""
    returned = [node for node in ast.walk(method) if isinstance(node, ast.Return)]
    good = all(node.value and not isinstance(node.value, ast.Constant) for node in returned)
    return good and _ends(method.body)


def _ends(body: list[ast.stmt]) -> bool:
    """Whether the last statement leaves the function, in each of its branches."""
    last = body[-1] if body else None
    if isinstance(last, ast.If):
        return _ends(last.body) and _ends(last.orelse)
    if isinstance(last, ast.With | ast.Try):
        return _ends(last.body)
    return isinstance(last, ast.Return | ast.Raise)


def _field(variant: str = "") -> FromError:
    def found(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
        del match
        if variant and not raised.interfaces:
            return None
        return replace(raised.finding("field_type"), variant=variant)

    return found


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "service_callback",
        "service",
        msg("A service's callback takes request and response, and returns the response"),
        msg(
            "A service calls its callback with two arguments after self: request and response. The "
            "answer of the service is the response that the callback returns."
        ),
        msg(
            "Write: def {name}(self, request, response): and end it with return response, on each way "
            "through it."
        ),
        links.SERVICES,
        fixes={"returned": msg("End {name} with return {written}, on each way through it.")},
        raised={ARGUMENTS: _service_callback, r"^TypeError:?\s*$": _service_callback},
    ),
    _node(
        "end_arguments",
        "topic",
        msg("What makes an end of a topic or a service does not get what it takes"),
        msg(
            "{name} takes the type first, without parentheses, then the name as a text. A callback is the "
            "method itself, without parentheses and quotes: ROS calls it later with what comes. "
            "A topic has one type in all of its ends."
        ),
        msg("Compare this line with {written}."),
        whys={
            "called": msg(
                "ROS calls a callback later, with what comes. With () after its name this line calls it "
                "now, and passes on its result (None)."
            )
        },
        fixes={"called": INSTEAD},
        raised={REFUSED: _refused},
        fixed_by=(lines.written,),
    ),
    _node(
        "other_message",
        "topic",
        msg("What is sent is no message of the right type"),
        msg(
            "A publisher sends messages of the type that create_publisher got, and a client requests of "
            "the type that create_client got. A message or a request is an object: parentheses after the "
            "type, such as Type() or Type.Request(), make one."
        ),
        msg(
            "Compare the type of what this line uses with the one that made the publisher or the client."
        ),
        fixes={
            "service": INSTEAD,
            "type": msg("Write {written} with parentheses."),
            "field": msg("Read the field of the callback's argument in place of {name}."),
        },
        raised={SENT: _sent},
        fixed_by=(lines.written,),
    ),
    _node(
        "topic_name_invalid",
        "topic",
        msg("ROS does not allow this name"),
        msg(
            "Names of topics and services consist of letters, digits and _, with / between the "
            "parts; no part begins with a digit."
        ),
        msg("Remove spaces and other characters from the name."),
        links.NAMES,
        raised={r"Invalid(?:Topic|Service)NameException": always("topic_name_invalid")},
    ),
    _node(
        "field_type",
        "topic",
        msg("A field has a value of another type"),
        msg(
            "Each field has a type, which the interface decides. ROS ends the program if the value "
            "does not fit."
        ),
        msg("Compare the values that you set with the types of the fields."),
        fixes={
            "part": msg(
                "A part such as linear has fields of its own: set linear.x, and not linear to a number."
            )
        },
        raised={FIELD: _field(), NO_PART: _field("part")},
    ),
)
