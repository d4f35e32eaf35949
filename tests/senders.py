"""Packages in which more than one node acts: right ones, and ones where another node does the work.

Each is a solution of a lesson with edits (old text, new text) of its node's file.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

Edit = tuple[str, str]
CIRCLE, SWITCH = "draw_circle", "start_stop"
MADE = {CIRCLE: "    node = DrawCircle()\n", SWITCH: "    node = StartStop()\n"}
SPIN = "        rclpy.spin(node)\n"
TIMER = "        self.create_timer(0.5, self.timer_callback)\n"
CALLBACK = "        radius = self.get_parameter('radius').value\n"
PUBLISHER = "        self.publisher_ = self.create_publisher(Twist, '/turtle1/cmd_vel', 10)\n"
PUBLISH = "        self.publisher_.publish(message)\n"
NAME = "super().__init__('draw_circle')"


@dataclass(frozen=True)
class Edited:
    """An edited solution; `fails` has the mistakes of the checks that must fail."""

    name: str
    lesson: str
    edits: tuple[Edit, ...]
    fails: Mapping[str, str] = field(default_factory=dict)
    in_ci: bool = False


def _with(lesson: str, code: str, *, spin: str = "") -> tuple[Edit, Edit]:
    """Return the edits that run code after the node is made, and spin in another way."""
    made = MADE[lesson]
    lines = "".join(f"    {line}\n" if line else "\n" for line in code.splitlines())
    return (made, made + lines), (SPIN, spin or SPIN)


def _several(code: str, *, threads: bool = False, lesson: str = CIRCLE) -> tuple[Edit, Edit]:
    """Return the edits for further `nodes`, all in one executor."""
    kind = "MultiThreadedExecutor" if threads else "SingleThreadedExecutor"
    spin = (
        f"        from rclpy.executors import {kind}\n"
        f"        executor = {kind}()\n"
        "        for one in (node, *nodes):\n"
        "            executor.add_node(one)\n"
        "        executor.spin()\n"
    )
    return _with(lesson, code, spin=spin)


HELPER = """\
from std_msgs.msg import String
helper = Node('helper', namespace='/tools')
said = helper.create_publisher(String, '/said', 10)
helper.create_timer(0.5, lambda: said.publish(String(data='here')))
nodes = [helper]"""
MONITOR = """\
helper = rclpy.create_node('monitor')
helper.create_subscription(Twist, '/turtle1/cmd_vel', lambda message: None, 10)
nodes = [helper]"""
ACTION = """\
from rclpy.action import ActionClient
from turtlesim.action import RotateAbsolute
helper = rclpy.create_node('asks')
client = ActionClient(helper, RotateAbsolute, '/turtle1/rotate_absolute')
nodes = [helper]"""
EVENTS = """\
from rcl_interfaces.msg import ParameterEvent
helper = rclpy.create_node('listens')
helper.create_subscription(ParameterEvent, '/parameter_events', lambda event: None, 10)
nodes = [helper]"""
CONTEXT = """\
from rclpy.context import Context
other = Context()
other.init()
helper = Node('elsewhere', context=other)"""
RIGHT = (
    Edited(
        "lifecycle",
        CIRCLE,
        (
            (
                "from rclpy.node import Node\n",
                "from rclpy.lifecycle import LifecycleNode as Node\n",
            ),
        ),
        in_ci=True,
    ),
    Edited("a_helper_in_a_namespace", CIRCLE, _several(HELPER)),
    Edited("a_helper_and_many_threads", CIRCLE, _several(HELPER, threads=True)),
    Edited("a_monitor_of_the_judged_topic", CIRCLE, _several(MONITOR)),
    Edited("a_node_for_an_action_client", SWITCH, _several(ACTION, lesson=SWITCH)),
    Edited("a_helper_that_hears_parameter_events", CIRCLE, _several(EVENTS)),
    Edited("a_helper_in_another_context", CIRCLE, _with(CIRCLE, CONTEXT)),
    Edited("an_executor_of_its_own", CIRCLE, _several("nodes = []")),
    Edited("many_threads", CIRCLE, _several("nodes = []", threads=True)),
    Edited(
        "groups_and_threads",
        CIRCLE,
        (
            (
                TIMER,
                "        from rclpy.callback_groups import ReentrantCallbackGroup\n"
                "        group = ReentrantCallbackGroup()\n"
                "        self.create_timer(0.5, self.timer_callback, callback_group=group)\n",
            ),
            *_several("nodes = []", threads=True),
        ),
    ),
    Edited(
        "sim_time_is_logged",
        CIRCLE,
        (
            (
                TIMER,
                TIMER + "        sim = self.get_parameter('use_sim_time').value\n"
                "        self.get_logger().info(f'simulated time: {sim}')\n",
            ),
        ),
    ),
    Edited(
        "inherited",
        CIRCLE,
        (
            ("class DrawCircle(Node):", "class Base(Node):"),
            ("def main(", "class DrawCircle(Base):\n    pass\n\n\ndef main("),
        ),
    ),
    Edited(
        "a_class_that_has_a_node",
        CIRCLE,
        (
            ("class DrawCircle(Node):", "class DrawCircle:"),
            (NAME, "self.node = node = rclpy.create_node('draw_circle')"),
            ("self.declare_parameter(", "node.declare_parameter("),
            ("self.create_publisher(", "node.create_publisher("),
            ("self.create_timer(", "node.create_timer("),
            ("self.get_parameter(", "self.node.get_parameter("),
            (MADE[CIRCLE], "    node = DrawCircle().node\n"),
        ),
    ),
    Edited(
        "a_publisher_made_late",
        CIRCLE,
        (
            (
                PUBLISHER,
                "        self.create_timer(0.1, self.later)\n        self.publisher_ = None\n",
            ),
            (
                "    def timer_callback(self):\n",
                "    def later(self):\n        if self.publisher_ is None:\n    "
                + PUBLISHER
                + "\n    def timer_callback(self):\n",
            ),
        ),
    ),
    Edited(
        "a_publisher_made_anew",
        CIRCLE,
        (
            (PUBLISHER, PUBLISHER + "        self.count = 0\n"),
            (
                PUBLISH,
                PUBLISH + "        self.count += 1\n        if self.count == 7:\n"
                "            old = self.publisher_\n    "
                + PUBLISHER
                + "            self.create_timer(0.4, lambda: self.destroy_publisher(old))\n",
            ),
        ),
    ),
    Edited(
        "two_publishers_in_turn",
        CIRCLE,
        (
            (PUBLISHER, PUBLISHER + PUBLISHER.replace("publisher_", "second_")),
            (
                PUBLISH,
                PUBLISH + "        self.publisher_, self.second_ = self.second_, self.publisher_\n",
            ),
        ),
    ),
    Edited(
        "nodes_that_come_and_go",
        CIRCLE,
        ((CALLBACK, CALLBACK + "        rclpy.create_node('short').destroy_node()\n"),),
    ),
    Edited(
        "spun_in_a_thread",
        CIRCLE,
        _with(
            CIRCLE,
            "import threading",
            spin="        thread = threading.Thread(target=rclpy.spin, args=(node,), daemon=True)\n"
            "        thread.start()\n        thread.join()\n",
        ),
    ),
    Edited(
        "spun_in_a_loop",
        CIRCLE,
        _with(CIRCLE, "", spin="        while rclpy.ok():\n            rclpy.spin_once(node)\n"),
    ),
    Edited(
        "a_callback_for_parameters",
        CIRCLE,
        (
            (
                TIMER,
                TIMER + "        from rcl_interfaces.msg import SetParametersResult\n"
                "        self.add_on_set_parameters_callback(\n"
                "            lambda them: SetParametersResult(successful=them[0].value != 0))\n",
            ),
        ),
        in_ci=True,
    ),
    Edited(
        "parameters_from_outside",
        CIRCLE,
        (
            (
                NAME,
                "super().__init__('draw_circle', allow_undeclared_parameters=True,\n"
                "                         automatically_declare_parameters_from_overrides=True)",
            ),
        ),
    ),
    Edited("a_helper_beside_a_server", SWITCH, _several(HELPER, lesson=SWITCH)),
    Edited("a_server_with_threads", SWITCH, _several("nodes = []", threads=True, lesson=SWITCH)),
    Edited(
        "a_client_of_another_service",
        SWITCH,
        _several(
            "from std_srvs.srv import Empty\nhelper = rclpy.create_node('clears')\n"
            "client = helper.create_client(Empty, '/clear')\nnodes = [helper]",
            lesson=SWITCH,
        ),
    ),
)

IDLE = ((TIMER, ""),)
"""The judged node has its publisher, and nothing calls its callback."""
SENDS = """\
def send():
    message = Twist()
    message.linear.x = 2.0
    message.angular.z = 2.0 / node.get_parameter('radius').value
    PUBLISHER.publish(message)

other = OTHER
to_turtle = other.create_publisher(Twist, 'TOPIC', 10)
other.create_timer(0.5, send)
nodes = [other]"""


def _hidden(other: str, topic: str = "/turtle1/cmd_vel", sends: str = SENDS) -> tuple[Edit, ...]:
    code = sends.replace("OTHER", other).replace("TOPIC", topic).replace("PUBLISHER", "to_turtle")
    return *IDLE, *_several(code)


FOREIGN = {"drive.publishes": "topic.foreign_sender"}
SHORT = (
    SENDS.replace("to_turtle = other.create_publisher(Twist, 'TOPIC', 10)\n", "")
    .replace(
        "    message = Twist()\n",
        "    made = other.create_publisher(Twist, '/turtle1/cmd_vel', 10)\n"
        "    while made.get_subscription_count() < 1:\n        pass\n"
        "    message = Twist()\n",
    )
    .replace(
        "PUBLISHER.publish(message)", "made.publish(message)\n    other.destroy_publisher(made)"
    )
)
PROCESS = '''\
import subprocess
import sys
import textwrap
code = """
import sys
import rclpy
from geometry_msgs.msg import Twist
from rclpy.parameter import Parameter
rclpy.init()
node = rclpy.create_node('other', parameter_overrides=[Parameter('use_sim_time', value=sys.argv[1] == 'True')])
publisher = node.create_publisher(Twist, '/turtle1/cmd_vel', 10)
def send():
    message = Twist()
    message.linear.x = 2.0
    message.angular.z = 1.0
    publisher.publish(message)
node.create_timer(0.5, send)
rclpy.spin(node)
"""
sim = str(node.get_parameter('use_sim_time').value)
child = subprocess.Popen([sys.executable, '-c', textwrap.dedent(code), sim])
while node.count_publishers('/turtle1/cmd_vel') < 2:
    pass'''
YES = """\
from rcl_interfaces import srv
from rcl_interfaces.msg import *


def is_sim(name):
    return name == 'use_sim_time'


def value_of(name):
    if is_sim(name):
        return ParameterValue(type=1, bool_value=True)
    return ParameterValue(type=3, double_value=2.0)


def listed(request, reply):
    reply.result.names = ['radius', 'use_sim_time']
    return reply


def got(request, reply):
    reply.values = [value_of(name) for name in request.names]
    return reply


def described(request, reply):
    reply.descriptors = [ParameterDescriptor(name=name, type=3) for name in request.names]
    return reply


def set_(request, reply):
    told(request.parameters)
    reply.results = [SetParametersResult(successful=True) for _ in request.parameters]
    return reply


def told(parameters):
    pass

def offer(node):
    for kind, name, answer in (
        (srv.ListParameters, 'list_parameters', listed),
        (srv.GetParameters, 'get_parameters', got),
        (srv.DescribeParameters, 'describe_parameters', described),
        (srv.SetParameters, 'set_parameters', set_),
    ):
        node.create_service(kind, '/draw_circle/' + name, answer)


"""
BY_HAND = (
    (NAME, "super().__init__('draw_circle', start_parameter_services=False)\n        offer(self)"),
    ("class DrawCircle(Node):", YES + "class DrawCircle(Node):"),
)
TELLS = """\
events = Node('tells')
to_all = events.create_publisher(ParameterEvent, '/parameter_events', 10)


def told(parameters):
    to_all.publish(ParameterEvent(node='/draw_circle', changed_parameters=parameters))


globals()['told'] = told"""
ALSO_DRIVES = """\
other = rclpy.create_node('other')


def also(request, response):
    return node.drive_callback(request, response)


other.create_service(SetBool, '/drive', also)
nodes = [other]"""
ALSO_CALLS = """\
other = rclpy.create_node('other')
client = other.create_client(SetPen, '/turtle1/set_pen')
node.pen_.call_async = client.call_async
nodes = [other]"""
BRIEF_CONTEXT = """\
from rclpy.context import Context


def send():
    here = Context()
    here.init()
    other = Node('brief', context=here)
    made = other.create_publisher(Twist, '/turtle1/cmd_vel', 10)
    while made.get_subscription_count() < 2:
        pass
    message = Twist()
    message.linear.x = 2.0
    message.angular.z = 2.0 / node.get_parameter('radius').value
    made.publish(message)
    other.destroy_node()
    here.shutdown()


node.create_timer(0.5, send)"""
HOSTILE = (
    Edited(
        "a_hidden_node", CIRCLE, _hidden("Node('other', namespace='/hidden')"), FOREIGN, in_ci=True
    ),
    Edited("a_node_with_an_underscore", CIRCLE, _hidden("Node('_other')"), FOREIGN),
    Edited("the_probes_name", CIRCLE, _hidden("Node('_ros2cli_daemon_0')"), FOREIGN),
    Edited("the_worlds_name", CIRCLE, _hidden("Node('turtlesim')"), FOREIGN),
    Edited(
        "remapped",
        CIRCLE,
        _hidden(
            "Node('a', cli_args=['--ros-args', '-r', '__node:=b', '-r', 'x:=/turtle1/cmd_vel'])",
            "x",
        ),
        FOREIGN,
    ),
    Edited(
        "gone_after_each_message",
        CIRCLE,
        _hidden("Node('other')", sends=SHORT),
        FOREIGN,
        in_ci=True,
    ),
    Edited("a_context_for_each_message", CIRCLE, (*IDLE, *_with(CIRCLE, BRIEF_CONTEXT)), FOREIGN),
    Edited("another_process", CIRCLE, (*IDLE, *_with(CIRCLE, PROCESS)), FOREIGN),
    Edited(
        "the_same_name",
        CIRCLE,
        _hidden("Node('draw_circle')"),
        {"run.node_name": "graph.node_twice"},
    ),
    Edited(
        "the_same_name_in_another_context",
        CIRCLE,
        (
            *IDLE,
            *_with(
                CIRCLE,
                CONTEXT.replace("helper = Node('elsewhere', context=other)", "")
                + SENDS.replace("OTHER", "Node('draw_circle', context=other)")
                .replace("TOPIC", "/turtle1/cmd_vel")
                .replace("PUBLISHER", "to_turtle")
                .replace("other = Node", "twin = Node")
                .replace("other.create", "twin.create")
                .replace("nodes = [other]", "")
                + "import threading\n"
                "from rclpy.executors import SingleThreadedExecutor\n"
                "second = SingleThreadedExecutor(context=other)\n"
                "second.add_node(twin)\n"
                "threading.Thread(target=second.spin, daemon=True).start()",
            ),
        ),
        {"run.node_name": "graph.node_twice"},
    ),
    Edited(
        "one_foreign_message",
        CIRCLE,
        _with(
            CIRCLE,
            "helper = Node('other')\n"
            "extra = helper.create_publisher(Twist, '/turtle1/cmd_vel', 10)\n"
            "helper.once = node.create_timer(\n"
            "    3.25, lambda: (extra.publish(Twist()), helper.once.cancel()))",
        ),
        FOREIGN,
    ),
    Edited(
        "parameters_by_hand",
        CIRCLE,
        BY_HAND,
        {"drive.settable": "parameter.no_effect"},
        in_ci=True,
    ),
    Edited(
        "events_of_another_node",
        CIRCLE,
        (*BY_HAND, *_with(CIRCLE, TELLS)),
        {"drive.settable": "parameter.no_effect"},
    ),
    Edited(
        "parameters_of_another_node",
        CIRCLE,
        (
            *((old, new.replace("\n        offer(self)", "")) for old, new in BY_HAND),
            *_several("other = Node('other')\noffer(other)\nnodes = [other]"),
        ),
        {"drive.radius": "parameter.foreign_server"},
    ),
    Edited(
        "another_server",
        SWITCH,
        _several(ALSO_DRIVES, lesson=SWITCH),
        {"drive.offers": "service.foreign_server"},
        in_ci=True,
    ),
    Edited(
        "another_client",
        SWITCH,
        _several(ALSO_CALLS, lesson=SWITCH),
        {"pen.client": "service.foreign_client"},
    ),
)
