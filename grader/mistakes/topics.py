"""The catalogue: topics, services and parameters, as a run shows them from outside."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family, Step
from grader.mistakes.parameters import parameter_object, undeclared
from grader.package.edit.tree import Replace
from grader.package.source.follows_already import publishes

UNDECLARED = r"ParameterNotDeclaredException: .*?: (?P<name>[\w.]{1,100})$"
OPERAND = (
    r"unsupported operand type\(s\) for .*'Parameter'|'Parameter' and '|' and 'Parameter'"
    r"|(?:must be|number,) (?:real number, )?not '?Parameter"
)


CALL_PUBLISH = msg(
    "Call publish(…) of this publisher, with the message, at the end of the function that fills the "
    "message."
)
PUBLISH_THERE = msg("Publish on {topic} in the callback of the subscription.")
NAMED = msg(
    "A publisher and a subscription meet only if the names of their topics are equal, to the letter. "
    "If they are not, no error comes."
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
        "parameter_object",
        "parameter",
        msg(".value is missing behind a parameter"),
        msg(
            "get_parameter and declare_parameter return an object that has the name, the type and "
            "the value."
        ),
        msg("Write {written} instead of {name}."),
        links.PARAMETERS,
        raised={OPERAND: parameter_object},
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
        ),
    ),
    _topic(
        "int_in_float",
        "topic",
        msg("A whole number is in a field for floating-point numbers"),
        msg(
            "ROS does not convert a whole number for a field of the type float: it arrives as a number near 0, "
            "or ROS ends the program, as ROS from Ubuntu's packages does."
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
        of_shape=True,
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
        of_shape=True,
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
        of_shape=True,
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
        of_shape=True,
    ),
    _topic(
        "wrong_type",
        "topic",
        msg("The topic has a different type"),
        TYPED,
        msg("Pass {short} as the first argument, and import it ({wanted})."),
        of_shape=True,
    ),
    _topic(
        "never_published",
        "topic",
        msg("Nothing is ever published"),
        msg(
            "create_publisher only announces the topic. A message goes out each time publish() is "
            "called."
        ),
        CALL_PUBLISH,
        steps={"": (Step(CALL_PUBLISH, publishes),)},
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
        msg(
            "A message goes out with the values that its fields have when publish() is called. A field "
            "that no line sets is 0."
        ),
        msg(
            "Here {field} must be {wanted}. Look at the lines that set it, and at the values in them."
        ),
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
            ),
            "reaction": msg(
                "Here {field} must be {wanted}. Look at the lines that set it, and at what they make of "
                "what came in."
            ),
        },
    ),
    _topic(
        "foreign_sender",
        "topic",
        msg("Another node sends the messages"),
        msg(
            "Who listens to {topic} sees in the graph which node publishes there. Each publisher is of "
            "the node whose create_publisher made it."
        ),
        msg(
            "Make the publisher of {topic} with create_publisher of the node {judged}, and only there."
        ),
        of_shape=True,
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
        of_shape=True,
    ),
    _topic(
        "not_silent",
        "topic",
        msg("A message at a time when none may come"),
        msg("publish() was called at that time: each condition on the way to it was true."),
        msg(
            "Look at the conditions on the way to publish() on {topic}, and at the values in them. If "
            "there is no condition, add one."
        ),
    ),
    _topic(
        "no_reaction",
        "topic",
        msg("The node does not react to a message"),
        msg("A subscription calls its callback for each message, while the node spins."),
        PUBLISH_THERE,
        steps={"": (Step(PUBLISH_THERE, publishes),)},
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
            "Give this line the QoS of the other side: 10 in place of a profile is reliable, "
            "qos_profile_sensor_data from rclpy.qos is best effort."
        ),
        links.QOS,
        of_shape=True,
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
        of_shape=True,
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
            "late": msg(
                "A parameter exists from the line on that declares it. Line {row} declares '{name}', but it has "
                "not run for this node when this line reads it."
            ),
        },
        fixes={
            "declared": msg("Declare '{written}' in this line, not '{name}'."),
            "misspelt": msg("The node declares '{close}': write this name instead of '{name}'."),
            "late": msg(
                "Declare '{name}' in __init__, before anything reads it: move line {row} there."
            ),
        },
        raised={UNDECLARED: undeclared},
        fixed_by=(lines.written,),
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
        ),
        of_shape=True,
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
        of_shape=True,
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
    _parameter(
        "no_effect",
        "parameter",
        msg("The node accepts a change of the parameter and does not make it"),
        msg(
            "A node that declares a parameter keeps its value, answers for it, and tells each change on "
            "/parameter_events. Services of these names that a program makes itself only say so."
        ),
        msg(
            "Declare '{name}' with declare_parameter, and read it with get_parameter. The node makes "
            "the services for it."
        ),
    ),
    _parameter(
        "foreign_server",
        "parameter",
        msg("Another node answers for the node's parameters"),
        msg("Each node offers the services of its own parameters; rclpy makes them with the node."),
        msg("Remove the services that {node} offers under the name of {judged}."),
        of_shape=True,
    ),
    _service(
        "foreign_server",
        "service",
        msg("Another node offers the service too"),
        msg(
            "If two nodes offer a service of one name, a client cannot know which of them answers."
        ),
        msg("Offer {service} in {judged} only; remove it from {node}."),
        of_shape=True,
    ),
    _service(
        "foreign_client",
        "service",
        msg("Another node calls the service too"),
        msg(
            "A service does not learn which of two clients calls it. This node must call it itself."
        ),
        msg("Make the client of {service} in {judged} only; remove it from {node}."),
        of_shape=True,
    ),
    _service(
        "missing",
        "service",
        msg("The node does not offer the service"),
        msg("A service exists as soon as create_service is called; clients find it by its name."),
        msg("Write self.create_service({short}, '{service}', self.callback) in __init__."),
        of_shape=True,
    ),
    _service(
        "no_client",
        "service",
        msg("The node has no client of the service"),
        msg("A client finds a service by its name and type."),
        msg("Write self.client_ = self.create_client({short}, '{service}') in __init__."),
        of_shape=True,
    ),
    _service(
        "wrong_name",
        "service",
        msg("The service has a different name"),
        msg("A client and a service meet if their names are equal, to the letter."),
        msg("Use '{service}' in place of '{name}'."),
        of_shape=True,
    ),
    _service(
        "wrong_type",
        "service",
        msg("The service has a different type"),
        msg("A client and a service of different types never meet."),
        msg("Pass {short} as the first argument of {make}."),
        of_shape=True,
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
        msg(
            "Look at the lines that set the fields of the response in the callback of {service}, and at "
            "what they make of the request."
        ),
    ),
)
