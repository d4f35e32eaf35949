"""Mistakes at the ends of a node: callbacks of subscriptions and services, requests, fields.

A topic or a service calls its callback with arguments, and gets an answer from it: that is where
these differ from a timer.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.callback import never_ends_in
from grader.mistakes.kind import Family
from grader.mistakes.order import attribute_needed_early
from grader.mistakes.recognised import OWN_ATTRIBUTE, Raised, RecognisedMistake, Suspect
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.sleeps import SLEEPS

ENDS = {"create_subscription": "callback", "create_service": "callback"}
BARE = r"^TypeError:?\s*$"  # rclpy raises it without a text
ARGUMENTS = (
    r"\.?(?P<function>\w{1,120})\(\) (?:takes (?:\d+|from \d+ to \d+) positional arguments? but \d+ "
    r"(?:was|were) given|missing \d+ required positional arguments?: .*)"
)
ASSERTION = r"Assertion `Py(?P<kind>\w{1,30})_Check\(field\)' failed"
BAD_ARGUMENT = r"TypeError: bad argument type for built-in operation"
NO_SERVICE_TYPE = r"The service type provided is not valid"
STR_TYPE = (
    r"(?:type object 'str'|'str' object) has no attribute '_TYPE_SUPPORT'"  # (kilted: object)
)
NOT_INSTANTIATED = r"Service classes can not be instantiated"
TWO_TYPES = r"RCLError: Failed to create (?:subscription|publisher): "
NO_DEPTH = r"Expected QoSProfile or int, but received <class '(?:method|function)'>"
OF_TYPE = (
    r"'(?:property|member_descriptor|getset_descriptor)'|"
    r"AttributeError: '\w{1,120}' object attribute '\w{1,120}' is read-only"
)
NO_PART = r"AttributeError: '(?:float|int|str|bool)' object has no attribute '(?P<name>\w{1,120})'"
PARTS = ("Request", "Response", "Goal", "Result", "Feedback")
VALUES = {
    "Float": "2.0",
    "Long": "1",
    "Unicode": "'text'",
    "Bool": "True",
    "Bytes": "b'a'",
}


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
            given = call.args[2] if len(call.args) > 2 else named.get(ENDS[kind])
            yield End(call, kind, given)


def _called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback is called where the end is made."""
    del match
    for end in ends(raised.source):
        here = raised.line is None or end.call.lineno <= raised.line <= _last(end.call)
        if here and isinstance(end.callback, ast.Call) and end.method in raised.source.methods:
            return raised.finding("end_callback_called", at=end.call, name=end.method)
    return None


def _called_early(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback is called in __init__, before the line that sets what it needs."""
    early = attribute_needed_early(raised, match)
    for end in ends(raised.source) if early is not None else ():
        inside = early is not None and end.call in ast.walk(early.needs)
        if inside and isinstance(end.callback, ast.Call) and end.method in raised.source.methods:
            return raised.finding("end_callback_called", at=end.call, name=end.method)
    return None


def _last(node: ast.expr) -> int:
    return node.end_lineno or node.lineno


def _text(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback is a text."""
    del match
    for end in ends(raised.source):
        if isinstance(end.callback, ast.Constant) and isinstance(end.callback.value, str):
            return raised.finding("end_callback_text", at=end.call, name=end.callback.value)
    return None


def _arguments(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback of a service does not take the request and the response."""
    for end in ends(raised.source):
        method = raised.source.methods.get(end.method)
        if end.kind == "create_service" and method is not None and end.method == match["function"]:
            return raised.finding("service_callback", at=method, name=end.method)
    return None


def _no_response(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback of a service does not return the response, at least not always."""
    del match
    for end in ends(raised.source):
        method = raised.source.methods.get(end.method)
        if end.kind == "create_service" and method is not None and not _returns(method):
            return raised.finding("response_not_returned", at=method, name=end.method)
    return None


def _returns(method: Function) -> bool:
    """Whether each way through a function returns a value that is not a constant."""
    returned = [node for node in ast.walk(method) if isinstance(node, ast.Return)]
    good = all(node.value and not isinstance(node.value, ast.Constant) for node in returned)
    return bool(returned) and good and _ends(method.body)


def _ends(body: list[ast.stmt]) -> bool:
    """Whether the last statement returns, in each of its branches."""
    last = body[-1] if body else None
    if isinstance(last, ast.If):
        return _ends(last.body) and _ends(last.orelse)
    if isinstance(last, ast.With):
        return _ends(last.body)
    if isinstance(last, ast.Try):
        return _ends(last.body) or _ends(last.finalbody)
    return isinstance(last, ast.Return | ast.Raise)


def _class_of_part(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A variable was set to SetPen.Request without parentheses."""
    del match
    for node in raised.source.all_nodes:
        value = node.value if isinstance(node, ast.Assign) else None
        if isinstance(value, ast.Attribute) and value.attr in PARTS:
            return raised.finding("service_part_class", at=value, name=dotted(value))
    return None


def _class_published(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """publish() gets the type itself."""
    del match
    for call in raised.source.calls_of("publish"):
        if call.args and isinstance(call.args[0], ast.Name) and call.args[0].id[:1].isupper():
            return raised.finding("published_class", at=call, name=call.args[0].id)
    types = raised.interfaces
    for node in raised.source.own_nodes:
        value = node.value if isinstance(node, ast.Assign) else None
        if isinstance(value, ast.Name) and value.id in types:
            return raised.finding("message_class", at=value, name=value.id)
    return None


def _other_request(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A request is sent to a client of another type."""
    del match
    code = raised.module.line(raised.line)
    if "call_async" not in code and ".call(" not in code:
        return None
    return raised.finding("request_of_other_type")


def _type_and_name(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A service or a client gets its name first."""
    del match
    for call, name in raised.source.calls:
        first = call.args[0] if call.args else None
        if last_part(name) in ("create_service", "create_client") and isinstance(
            first, ast.Constant
        ):
            return raised.finding("service_arguments", at=call, name=last_part(name))
    return None


def _no_service_type(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    for call, name in raised.source.calls:
        first = call.args[0] if call.args else None
        if last_part(name) not in ("create_service", "create_client") or first is None:
            continue
        if isinstance(first, ast.Attribute) and first.attr in PARTS:
            return raised.finding("service_type", at=call, name=dotted(first.value))
    return None


def _instantiated(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A service's type is called as if it were a message."""
    del match
    line = raised.line
    for call, name in raised.source.calls:
        if line == call.lineno and isinstance(call.func, ast.Name):
            return raised.finding("service_instantiated", at=call, name=name)
    return None


def _two_types(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Two ends of the node use one topic with different types."""
    del match
    types: dict[str, tuple[str, ast.Call]] = {}
    for call, name in raised.source.calls:
        if last_part(name) not in ("create_publisher", "create_subscription"):
            continue
        topic = call.args[1] if len(call.args) > 1 else None
        if not isinstance(topic, ast.Constant):
            continue
        kind, key = dotted(call.args[0]), str(topic.value).strip("/")
        if key in types and types[key][0] != kind:
            return raised.finding("topic_of_two_types", at=call, name=str(topic.value))
        types.setdefault(key, (kind, call))
    return None


def _depth(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    for end in ends(raised.source):
        if isinstance(end.callback, ast.Constant) and isinstance(end.callback.value, int):
            return raised.finding("end_order", at=end.call)
    return None


def _type_in_place(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A field is read of a message's type, not of the message that came."""
    del match
    types = raised.interfaces
    for node in raised.source.own_nodes:
        whole = node.value if isinstance(node, ast.Attribute) else None
        if not isinstance(node, ast.Attribute) or not isinstance(whole, ast.Name):
            continue
        if whole.id in types and node.attr.islower():
            return raised.finding("field_of_type", at=node, name=f"{whole.id}.{node.attr}")
    return None


def _replaced(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A part of a message that has fields of its own is replaced by a number."""
    part = match["name"]
    targets: dict[str, ast.Assign] = {}
    for node in raised.source.own_nodes:
        target = node.targets[0] if isinstance(node, ast.Assign) else None
        if isinstance(node, ast.Assign) and isinstance(target, ast.Attribute):
            targets.setdefault(dotted(target), node)
    for node in raised.source.own_nodes:
        if isinstance(node, ast.Attribute) and node.attr == part:
            whole = dotted(node.value)
            if whole in targets and _is_number_for_part(raised, targets[whole]):
                return raised.finding("field_replaced", at=targets[whole], name=f"{whole}.{part}")
    for whole, node in targets.items():
        value = node.value
        is_number = isinstance(value, ast.Constant) and isinstance(value.value, int | float)
        if is_number and part in ("x", "y", "z", "w") and "." in whole:
            return raised.finding("field_replaced", at=node, name=f"{whole}.{part}")
    return None


def _is_number_for_part(raised: Raised, set_by: ast.Assign) -> bool:
    """Whether a line can set a part of a message, and gives it a number or another plain value."""
    whole, value = set_by.targets[0], set_by.value
    known = bool(raised.interfaces) and isinstance(whole, ast.Attribute)
    text = isinstance(value, ast.Constant) and isinstance(value.value, str)
    own = isinstance(whole, ast.Attribute) and dotted(whole.value) == "self"
    return known and not own and not text and not isinstance(value, ast.JoinedStr)


def _field_type(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    wanted = VALUES.get(match.groupdict().get("kind") or "", "")
    found = raised.finding("field_type", wanted=wanted)
    return RecognisedMistake(
        kind=found.kind,
        params=found.params,
        words=found.words,
        variant="" if wanted else "unknown",
        where=found.where,
    )


def _callbacks(source: NodeSource) -> list[Function]:
    """Return the methods that ROS calls: those of timers, subscriptions and services."""
    names = [timer.method for timer in source.timers] + [end.method for end in ends(source)]
    return [source.methods[name] for name in dict.fromkeys(names) if name in source.methods]


def _stuck(suspect: Suspect) -> RecognisedMistake | None:
    """Look for what keeps a callback from returning."""
    for method in _callbacks(suspect.source):
        for call, name in calls_in(method):
            if last_part(name) in ("spin", "spin_once", "spin_until_future_complete"):
                return suspect.finding("spins_inside", call, name=last_part(name))
            if last_part(name) == "call" and name.startswith("self."):
                return suspect.finding("waits_for_service", call, name=name)
        for node in ast.walk(method):
            if isinstance(node, ast.While) and ".done()" in ast.unparse(node.test):
                return suspect.finding("waits_for_service", node, name="while")
        loop = never_ends_in(method)
        if loop is not None:
            return suspect.finding("waits_inside", loop, name=_word(loop))
        slept = [call for call, name in calls_in(method) if name in SLEEPS]
        if slept:
            return suspect.finding("waits_inside", slept[0], name=dotted(slept[0].func))
    return None


def _spins_in_callback(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a callback that spins the node which calls it."""
    found = _stuck(suspect)
    return found if found is not None and found.kind == "node.spins_inside" else None


def _word(node: ast.AST) -> str:
    return dotted(node.func) if isinstance(node, ast.Call) else "while"


def _printed(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a print() in a callback, where a log line is missing."""
    for method in _callbacks(suspect.source):
        for call, name in calls_in(method):
            if name == "print":
                return suspect.finding("prints_inside", call, name=method.name)
            if name.endswith("get_logger().debug"):
                return suspect.finding("debug_inside", call, name=method.name)
    return None


_node = Family("node", links.FIRST_NODE)
RETURNS = msg(
    "The answer of a service is what its callback returns: the response that it was given."
)
BLOCKS = msg(
    "A node runs one callback at a time. Nothing else of it runs until the callback returns: no "
    "timer, no subscription, no answer to a call."
)
LATER = msg("ROS calls the callback later, when something comes. It needs the method itself.")
KINDS = (
    _node(
        "end_callback_called",
        "topic",
        msg("The callback is called, not passed on"),
        LATER,
        msg("Write self.{name} without parentheses."),
        raised={r"Error|Exception": _called, OWN_ATTRIBUTE: _called_early},
    ),
    _node(
        "end_callback_text",
        "topic",
        msg("The callback is a text"),
        LATER,
        msg("Write self.{name} without quotes."),
        raised={r"Error|Exception": _text},
    ),
    _node(
        "service_callback",
        "service",
        msg("The callback of the service does not take request and response"),
        msg("A service calls its callback with two arguments after self: request and response."),
        msg("Write: def {name}(self, request, response):"),
        links.SERVICES,
        raised={ARGUMENTS: _arguments},
    ),
    _node(
        "response_not_returned",
        "service",
        msg("The callback of the service does not return the response"),
        RETURNS,
        msg("End {name} with: return response, on each way through it."),
        links.SERVICES,
        raised={BARE: _no_response},
    ),
    _node(
        "service_part_class",
        "service",
        msg("The type of a request or response is used in place of an object"),
        msg("A request is an object: the parentheses after the type make one."),
        msg("Write {name}() with parentheses."),
        links.SERVICES,
        raised={BARE: _class_of_part},
    ),
    _node(
        "published_class",
        "topic",
        msg("publish() gets the type of the message"),
        msg("A message is an object: the parentheses after the type make one."),
        msg("Make a message with {name}(), fill it, and publish it."),
        raised={r"Metaclass_": _class_published},
    ),
    _node(
        "request_of_other_type",
        "service",
        msg("The request has another type than the client"),
        msg("A client sends requests of the service type that create_client got, and no other."),
        msg("Make the request with the Request() of the type that you gave create_client."),
        links.SERVICES,
        raised={BARE: _other_request},
    ),
    _node(
        "service_arguments",
        "service",
        msg("The type and the name of the service are in the wrong order"),
        msg("create_service and create_client take the type first, then the name as a text."),
        msg("Write {name}(Type, 'name', …): first the type, then the name in quotes."),
        links.SERVICES,
        raised={STR_TYPE: _type_and_name},
    ),
    _node(
        "service_type",
        "service",
        msg("The type of the service is only a part of it"),
        msg("create_service and create_client need the whole type, request and response."),
        msg("Pass {name} alone."),
        links.SERVICES,
        raised={NO_SERVICE_TYPE: _no_service_type},
    ),
    _node(
        "service_instantiated",
        "service",
        msg("The type of the service is used as if it were a message"),
        msg("A service has two messages: what is asked, and what is answered."),
        msg("Write {name}.Request() for a request, {name}.Response() for an answer."),
        links.SERVICES,
        raised={NOT_INSTANTIATED: _instantiated},
    ),
    _node(
        "topic_of_two_types",
        "topic",
        msg("The node uses one topic with two types"),
        msg("A topic has one type, in the whole ROS graph."),
        msg("Compare the names: one of the two ends on {name} needs another topic."),
        raised={TWO_TYPES: _two_types},
    ),
    _node(
        "end_order",
        "topic",
        msg("The callback and the depth are in the wrong order"),
        msg("create_subscription takes the type, the name, the callback, and then the depth."),
        msg("Write create_subscription(Type, 'name', self.callback, 10)."),
        raised={NO_DEPTH: _depth},
    ),
    _node(
        "field_of_type",
        "topic",
        msg("A field is read of the type, not of the message"),
        msg("The type has no values. The message that came is the argument of the callback."),
        msg("Read the field of the callback's argument in place of {name}."),
        raised={OF_TYPE: _type_in_place},
    ),
    _node(
        "field_replaced",
        "topic",
        msg("A part of the message is replaced by a number"),
        msg("A part such as linear has fields of its own. A number in its place has none."),
        msg("Set the field inside: {name}."),
        raised={NO_PART: _replaced},
    ),
    _node(
        "field_type",
        "topic",
        msg("A field has a value of another type"),
        msg(
            "Each field has a type, which the interface decides. ROS ends the program if the value "
            "does not fit."
        ),
        msg("Set the fields to values of their types; here a value such as {wanted} is expected."),
        fixes={"unknown": msg("Compare the values that you set with the types of the fields.")},
        raised={ASSERTION: _field_type, BAD_ARGUMENT: _field_type},
    ),
    _node(
        "spins_inside",
        "spin",
        msg("A callback spins the node"),
        BLOCKS,
        msg("Remove {name} from the callback: {function} spins the node."),
        links.EXECUTORS,
        behind={"run.stuck": _stuck, "run.stops": _spins_in_callback},
    ),
    _node(
        "waits_for_service",
        "service",
        msg("A callback waits for the answer of a service"),
        msg(
            "The answer can only be read while the node spins, and it does not spin until the "
            "callback returns: it waits for ever."
        ),
        msg(
            "Use call_async(request), and read the answer in a callback given to add_done_callback."
        ),
        links.SERVICES,
    ),
    _node(
        "waits_inside",
        "callback",
        msg("A callback does not return"),
        BLOCKS,
        msg("Remove {name} from the callback: a timer does the repeating and the waiting."),
        links.EXECUTORS,
    ),
    _node(
        "prints_inside",
        "logger",
        msg("print() is used in place of the logger"),
        msg("print() only writes to this terminal; no other program sees it on /rosout."),
        msg("Write self.get_logger().info(…) in place of print(…)."),
        links.LOGGING,
        behind={"log.missing": _printed},
    ),
    _node(
        "debug_inside",
        "logger",
        msg("The line is logged at the level DEBUG"),
        msg("By default, records of the level DEBUG are neither shown nor published."),
        msg("Write self.get_logger().info(…) in place of .debug(…)."),
        links.LOGGING,
    ),
)
