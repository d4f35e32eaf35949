"""The catalogue: topics, services and parameters, as a run shows them from outside."""

from __future__ import annotations

import ast
import re
from collections.abc import Collection
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines, node_parameters
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.declared import Parameter, declared, declares_others, with_namespace
from grader.package.source.names import called_name, calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import place_of, statement_at

UNDECLARED = r"ParameterNotDeclaredException: .*?: (?P<name>[\w.]{1,100})$"
OTHER_TYPE = r"Expected <class '[\w.]*\.(?P<wanted>\w+)'>, got <class '[\w.]*?(?P<name>\w+)'>"
NO_TEXT = r"rclpy_resolve_name\(\): incompatible function arguments"
INVALID_NAME = r"Invalid(?:Topic|Service)NameException: Invalid (?:topic|service) name"
OF_CLASS = r"'(?:property|member_descriptor|getset_descriptor)' object has no attribute"
OPERAND = r"unsupported operand type\(s\) for .*'Parameter'|'Parameter' and '|must be real number, not Parameter"
NO_MESSAGE = r"callback should be either be callable with one argument"
ENDS = ("create_publisher", "create_subscription", "create_service", "create_client")


def _undeclared(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    """A parameter is used that the node has not declared."""
    name, source, module = match["name"], raised.source, raised.module
    words = {**raised.words, "name": name, "close": "", "type": ""}
    found = RecognisedMistake(kind="parameter.not_declared", words=words, where=raised.where)
    within = with_namespace(source)
    if within is not None:
        words["row"] = within.lineno
        return replace(found, words=words, variant="namespace")
    parameter = node_parameters.reading(source, module, name, raised.line)
    if parameter is None:
        return found
    found = replace(found, where=place_of(source, parameter.call))
    known = {p.name: p for p in declared(source)}
    if name in known:
        return _declared_late(raised, found, parameter, known[name])
    close = nearest(name, known, cutoff=0.7) or _renamed(source, name, known)
    if close and not declares_others(source):
        return _misspelt(raised, found, parameter, known[close])
    declaration = node_parameters.declaration(source, raised.assignment, module, parameter)
    if declaration is None:
        return found
    words |= {"written": declaration.written, "row": declaration.above.lineno}
    variant = "above" if declaration.in_place else "start"
    if "…" in declaration.written:
        variant += "_open"
    return replace(found, params={"parameter": name}, words=words, variant=variant)


def _renamed(source: NodeSource, name: str, known: Collection[str]) -> str:
    """Return the one declared name that no line reads, if it has a word of another name."""
    texts = [n.value for n in source.all_nodes if isinstance(n, ast.Constant)]
    unread = [other for other in known if texts.count(other) == 1]
    words = set(name.lower().split("_"))
    alike = [other for other in unread if words & set(other.lower().split("_"))]
    return alike[0] if len(alike) == 1 else ""


def _misspelt(
    raised: Raised, found: RecognisedMistake, parameter: Parameter, known: Parameter
) -> RecognisedMistake:
    """The name that is read is nearly that of a declared parameter."""
    code = raised.module.text.code(parameter.written)
    written = f"{code[0]}{known.name}{code[-1]}" if code[:1] in "'\"" else repr(known.name)
    params: dict[str, str] = {"name": code, "written": written}
    words = {**found.words, **params, "row": known.call.lineno}
    return replace(found, params=params, words=words, variant="misspelt")


def _declared_late(
    raised: Raised, found: RecognisedMistake, parameter: Parameter, known: Parameter
) -> RecognisedMistake:
    """The parameter is declared by another line, which runs later."""
    source, line = raised.source, known.call.lineno
    same = source.function_around(known.call) is source.function_around(parameter.call)
    later = same and raised.module.has(known.call) and line > parameter.call.lineno
    words = {**found.words, "row": line}
    if not later:
        owner = parameter.call.func
        if known.default is not None and isinstance(owner, ast.Attribute):
            code, of_known = raised.module.text.code, source.module_of(known.call).text.code
            given = f"{code(parameter.written)}, {of_known(known.default)}"
            words["written"] = f"{code(owner.value)}.declare_parameter({given})"
            return replace(found, words=words, variant="elsewhere_known")
        return replace(found, words=words, variant="elsewhere")
    params = {"parameter": known.name, "late": str(line)}
    return replace(found, params=params, words=words, variant="late")


def _other_type(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    return raised.finding("other_message", name=match["name"], wanted=match["wanted"])


def _swapped(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The call that makes an end of a topic or service has something else in place of the name."""
    del match
    for call, name in raised.source.calls:
        if last_part(name) in ENDS and call.lineno == raised.line:
            return raised.finding("end_arguments", at=call, name=last_part(name))
    return None


def _invalid_name(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    del match
    return raised.finding("topic_name_invalid")


def _of_class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A variable was set to a message's class without parentheses."""
    del match
    types = raised.interfaces
    for node in raised.module.nodes:
        named = node.value if isinstance(node, ast.Assign) else None
        if isinstance(named, ast.Name) and named.id in types:
            return raised.finding("message_class", name=named.id)
    return None


def _no_message(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback of a subscription does not take the message."""
    del match
    for call, name in raised.source.calls:
        if last_part(name) == "create_subscription" and call.lineno == raised.line:
            given = call.args[2] if len(call.args) > 2 else None
            callback = dotted(given).rpartition(".")[2] if given is not None else ""
            return raised.finding("callback_without_message", at=call, name=callback or "callback")
    return None


def _parameter_object(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    """A Parameter is used as a number: name the call on this line that returns it."""
    del match
    statement = statement_at(raised.module, raised.line)
    calls = [call for call, _ in calls_in(statement)] if statement is not None else []
    found = [c for c in calls if called_name(c) in ("get_parameter", "declare_parameter")]
    named = {dotted(n) for n in ast.walk(statement)} - {""} if statement is not None else set()
    sets = [
        n.value
        for n in raised.source.all_nodes
        if isinstance(n, ast.Assign)
        and named & set(targets_of(n))
        and isinstance(n.value, ast.Call)
        and called_name(n.value) in ("get_parameter", "declare_parameter")
    ]
    if not found and len(sets) == 1 and raised.module.has(sets[0]):
        code = " ".join(raised.module.text.code(sets[0]).split())
        params = {"name": code, "written": f"{code}.value"}
        return replace(
            raised.finding("parameter_object", at=sets[0], params=params), variant="written"
        )
    if len(found) != 1:
        return raised.finding("parameter_object")
    code = " ".join(raised.module.text.code(found[0]).split())
    found_call = raised.finding("parameter_object", name=code, written=f"{code}.value")
    return replace(found_call, variant="written")


ELSEWHERE = msg(
    "A parameter exists from the line on that declares it. Line {row} declares '{name}', but it has "
    "not run for this node when this line reads it."
)
NAMED = msg(
    "Nodes find each other by the name of the topic alone: a publisher and a subscription meet if "
    "their names are equal, to the letter."
)
TYPED = msg(
    "A topic has one type. A publisher and a subscription of different types never exchange a "
    "message, and neither of them reports an error."
)

_node = Family("node", links.FIRST_NODE)
_topic = Family("topic", links.TOPICS)
_parameter = Family("parameter", links.PARAMETERS)
_service = Family("service", links.SERVICES)
KINDS = (
    _node(
        "other_message",
        "topic",
        msg("The message has another type than its publisher"),
        msg("A publisher sends messages of the type that create_publisher gets, and no other."),
        msg("Make the message with {wanted}(), or pass {name} to create_publisher."),
        raised={OTHER_TYPE: _other_type},
    ),
    _node(
        "end_arguments",
        "topic",
        msg("The type and the name are in the wrong order"),
        msg(
            "create_publisher, create_subscription, create_service and create_client take the type "
            "first, then the name as a text."
        ),
        msg("Write {name}(Type, 'name', …): first the type, then the name in quotes."),
        raised={NO_TEXT: _swapped},
    ),
    _node(
        "callback_without_message",
        "topic",
        msg("The callback does not take the message"),
        msg("A subscription calls its callback with one argument: the message that came."),
        msg("Write def {name}(self, message): the message is the argument after self."),
        raised={NO_MESSAGE: _no_message},
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
        raised={INVALID_NAME: _invalid_name},
    ),
    _node(
        "message_class",
        "topic",
        msg("The type of the message is used in place of a message"),
        msg("A message is an object: the parentheses after the type make one."),
        msg("Write {name}() with parentheses."),
        raised={OF_CLASS: _of_class},
    ),
    _node(
        "parameter_object",
        "parameter",
        msg(".value is missing behind a parameter"),
        msg(
            "get_parameter and declare_parameter return an object that has the name, the type and "
            "the value."
        ),
        msg("Write self.get_parameter('…').value."),
        links.PARAMETERS,
        fixes={"written": msg("Write {written} instead of {name}.")},
        raised={OPERAND: _parameter_object},
        fixed_by=(lines.written,),
        examples=(
            example(
                "period_is_parameter",
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        self.declare_parameter('period', 1.0)\n"
                    "        period = self.get_parameter('period')\n"
                    "        self.create_timer(period,",
                ),
                fails="run.starts",
            ),
            example(
                "parameter_in_text",
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        self.declare_parameter('text', 'Hello time: ')\n"
                    "        self.text = self.get_parameter('text')\n"
                    "        self.create_timer(1.0,",
                ),
                Replace(
                    NODE, "'Hello time: ' + str(self.counter_)", "f'{self.text}{self.counter_}'"
                ),
                fails="run.output",
            ),
        ),
    ),
    _topic(
        "int_in_float",
        "topic",
        msg("A whole number is in a field for floating-point numbers"),
        msg(
            "ROS copies the value to a field of the type float without a conversion: a whole number "
            "arrives as a number near 0."
        ),
        msg("Write a number with a point, such as 2.0, or float(…)."),
    ),
    _topic(
        "no_publisher",
        "topic",
        msg("The node has no publisher"),
        NAMED,
        msg(
            "Write self.publisher_ = self.create_publisher({short}, '{topic}', 10) in __init__, and "
            "import {short}."
        ),
    ),
    _topic(
        "no_subscription",
        "topic",
        msg("The node has no subscription"),
        NAMED,
        msg(
            "Write self.create_subscription({short}, '{topic}', self.callback, 10) in __init__, and "
            "import {short}."
        ),
    ),
    _topic(
        "wrong_end",
        "topic",
        msg("The node has the other end of the topic"),
        msg(
            "create_publisher is for a topic on which the node sends messages, create_subscription "
            "for one on which it receives them."
        ),
        msg("Use {call} for '{topic}'. Are two topics swapped?"),
    ),
    _topic(
        "wrong_name",
        "topic",
        msg("The topic has a different name"),
        NAMED,
        msg(
            "Use '{topic}' in place of '{name}'. A name without a slash in front begins with the "
            "node's namespace."
        ),
    ),
    _topic(
        "wrong_type",
        "topic",
        msg("The topic has a different type"),
        TYPED,
        msg("Pass {short} as the first argument, and import it ({wanted})."),
    ),
    _topic(
        "never_published",
        "topic",
        msg("Nothing is ever published"),
        msg(
            "create_publisher only announces the topic. A message goes out each time publish() is "
            "called."
        ),
        msg(
            "Call self.publisher_.publish(message) in the callback of the timer or of the "
            "subscription, with parentheses."
        ),
    ),
    _topic(
        "too_few",
        "topic",
        msg("Too few messages"),
        msg("A message goes out each time publish() is called."),
        msg("Make sure that every call of the callback reaches publish()."),
    ),
    _topic(
        "several_at_once",
        "topic",
        msg("Several messages at the same instant"),
        msg("Each call of publish() is a message, and each timer calls its callback."),
        msg("Call publish() once in the callback, and create the timer once."),
    ),
    _topic(
        "wrong_period",
        "topic",
        msg("The messages come at a different rate"),
        msg("The first argument of create_timer is the period in seconds: 2 Hz is 0.5 s."),
        msg("Write self.create_timer({wanted}, …)."),
    ),
    _topic(
        "stops",
        "topic",
        msg("The messages stop"),
        msg("A timer calls its callback until the node ends, unless it is cancelled."),
        msg("Look for a condition, a counter or a cancel() that ends the publishing."),
    ),
    _topic(
        "wrong_value",
        "topic",
        msg("A message has a different value"),
        msg("Fields that are not set are 0. Velocities are in m/s and rad/s, distances in m."),
        msg("Set {field} to {wanted}, each time before publish()."),
        whys={
            "changed": msg(
                "A value that is read in __init__ stays as it was. The callback has to read it "
                "each time to see a change."
            )
        },
        fixes={
            "changed": msg(
                "Read the value in the callback, for example with "
                "self.get_parameter('…').value, and set {field} to {wanted}."
            )
        },
    ),
    _topic(
        "none_then",
        "topic",
        msg("No message at that time"),
        msg("A message goes out each time publish() is called."),
        msg("Make sure that the callback publishes at that time too."),
    ),
    _topic(
        "other_definition",
        "topic",
        msg("The message was built from other fields than its file has"),
        TYPED,
        msg(
            "Build the package of {short} again from its .msg file, without changing what is built."
        ),
    ),
    _topic(
        "not_silent",
        "topic",
        msg("A message at a time when none may come"),
        msg(
            "A message goes out each time publish() is called, also if it says the same as before."
        ),
        msg("Check in the callback whether to publish on {topic}, and return if not."),
    ),
    _topic(
        "no_reaction",
        "topic",
        msg("The node does not react to a message"),
        msg("A subscription calls its callback for each message, while the node spins."),
        msg("Publish on {topic} in the callback of the subscription."),
    ),
    _topic(
        "reacts_too_often",
        "topic",
        msg("The node reacts more than once to one message"),
        msg(
            "Each call of publish sends a message: two calls, a loop, or a second subscription with "
            "the same callback send two."
        ),
        msg("Publish on {topic} once for each message that the callback gets."),
    ),
    _topic(
        "qos_mismatch",
        "topic",
        msg("The QoS of publisher and subscription do not fit"),
        msg(
            "A subscription that asks for more than the publisher offers gets nothing: reliable "
            "does not fit best effort, transient local does not fit volatile."
        ),
        msg(
            "Create the subscription with the QoS that the publisher offers; for sensors this is "
            "qos_profile_sensor_data from rclpy.qos."
        ),
        links.QOS,
    ),
    _topic(
        "wrong_qos",
        "topic",
        msg("The topic has a different QoS"),
        msg(
            "The QoS says whether messages may be lost, and whether late subscribers get old ones."
        ),
        msg("Pass a QoSProfile with {wanted} in place of the depth."),
        links.QOS,
    ),
    _parameter(
        "not_declared",
        "parameter",
        msg("The parameter is not declared"),
        msg(
            "A node has only the parameters that it declares. A value from the command line or a "
            "file counts only for a declared parameter."
        ),
        msg("Write self.declare_parameter('{name}', …) in __init__, with the default value."),
        close=msg("The name is '{name}', not '{close}'."),
        whys={
            "misspelt": msg(
                "A node has only the parameters that it declares, by exactly that name: line {row} "
                "declares {written}, and this line reads {name}."
            ),
            "namespace": msg(
                "declare_parameters puts its first argument and a dot before each name. The call in line "
                "{row} has such a first argument, so that no parameter is called only {name}."
            ),
            "late": msg(
                "A parameter exists from the line on that declares it. Line {row} declares '{name}', "
                "and it runs after this line."
            ),
            "elsewhere_known": ELSEWHERE,
            "elsewhere": ELSEWHERE,
        },
        fixes={
            "misspelt": msg("Write {written} instead of {name} in this line."),
            "namespace": msg(
                "Read the parameter by its whole name, as in 'group.{name}' for the first argument 'group'. "
                "Or write '' as the first argument in line {row}."
            ),
            "late": msg("Move line {row}, which declares '{name}', above this line."),
            "elsewhere": msg(
                "Declare '{name}' in __init__, before anything reads it: move line {row} there."
            ),
            "elsewhere_known": msg(
                "Write this line in __init__, before anything reads the parameter: {written} Then "
                "delete line {row}: a parameter can be declared once only."
            ),
            "above": msg("Write this line above line {row}: {written}"),
            "above_open": msg(
                "Write this line above line {row}, with the default value in the place of …: {written}"
            ),
            "start": msg("Write this line in __init__, above line {row}: {written}"),
            "start_open": msg(
                "Write this line in __init__, above line {row}, with the default value in the place of …: {written}"
            ),
        },
        raised={UNDECLARED: _undeclared},
        fixed_by=(
            lines.written,
            node_parameters.moved_up,
            node_parameters.declared_above,
        ),
        examples=(
            example(
                "parameter_not_declared",
                Replace(
                    NODE,
                    "create_timer(1.0,",
                    "create_timer(self.get_parameter('period').value,",
                ),
                fails="run.starts",
            ),
            example(
                "parameter_renamed_in_one_place",
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        self.declare_parameter('timer_period', 1.0)\n"
                    "        period = self.get_parameter('period').value\n"
                    "        self.create_timer(period,",
                ),
                fails="run.starts",
            ),
            example(
                "parameter_misspelt",
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        self.declare_parameter('period', 1.0)\n"
                    "        period = self.get_parameter('periode').value\n"
                    "        self.create_timer(period,",
                ),
                fails="run.starts",
            ),
            example(
                "parameter_in_a_namespace",
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        self.declare_parameters('hello', [('period', 1.0)])\n"
                    "        period = self.get_parameter('period').value\n"
                    "        self.create_timer(period,",
                ),
                fails="run.starts",
            ),
            example(
                "parameter_declared_late",
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        period = self.get_parameter('period').value\n"
                    "        self.declare_parameter('period', 1.0)\n"
                    "        self.create_timer(period,",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _parameter(
        "wrong_type",
        "parameter",
        msg("The parameter has a different type"),
        msg(
            "The default value decides the type: 2 is an integer, 2.0 a double, '2.0' a string. A "
            "value of another type is refused later."
        ),
        msg("Declare '{name}' with a default value of the type {type}."),
    ),
    _parameter(
        "wrong_value",
        "parameter",
        msg("The parameter has a different value"),
        msg("Without a value from the command line, a parameter has its default value."),
        msg("Declare '{name}' with the default value {wanted}."),
    ),
    _parameter(
        "refused",
        "parameter",
        msg("The node refuses to change the parameter"),
        msg(
            "A node can refuse a change: the parameter is read-only, the value has another type or "
            "is out of range, or a callback of the node does not return a successful result."
        ),
        msg(
            "Let '{name}' be changed. A callback for changes must return "
            "SetParametersResult(successful=True)."
        ),
    ),
    _service(
        "missing",
        "service",
        msg("The node does not offer the service"),
        msg("A service exists as soon as create_service is called; clients find it by its name."),
        msg("Write self.create_service({short}, '{service}', self.callback) in __init__."),
    ),
    _service(
        "no_client",
        "service",
        msg("The node has no client of the service"),
        msg("A client finds a service by its name and type."),
        msg("Write self.client_ = self.create_client({short}, '{service}') in __init__."),
    ),
    _service(
        "wrong_name",
        "service",
        msg("The service has a different name"),
        msg("A client and a service meet if their names are equal, to the letter."),
        msg("Use '{service}' in place of '{name}'."),
    ),
    _service(
        "wrong_type",
        "service",
        msg("The service has a different type"),
        msg("A client and a service of different types never meet."),
        msg("Pass {short} as the first argument of {make}."),
    ),
    _service(
        "no_answer",
        "service",
        msg("The service does not answer"),
        msg(
            "The answer goes out when the callback returns. A callback that waits for something "
            "which only spinning brings waits for ever."
        ),
        msg("Let the callback of {service} return the response, without waiting in it."),
    ),
    _service(
        "wrong_answer",
        "service",
        msg("The service answers something else"),
        msg("The callback fills the response that it gets, and returns it."),
        msg("Set the fields of the response in the callback of {service}, and return it."),
    ),
)
