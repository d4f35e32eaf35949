"""A package that does a little of everything, the assignment of schema 2 for it, and broken forms.

Every kind of check is used at least once. Each broken form changes one thing for many checks, so
that a few runs show three wrong packages for each kind.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

ASSIGNMENT = """\
schema: 2
id: doubling
title: "A node that doubles"
package: doubling
nodes:
  doubler: {executable: doubler, target: doubling.doubler:main, file: doubler.py, name: doubler}
runs:
  - name: answers
    start: [{node: doubler}]
    clock: {period: 0.1, ticks: 50}
    topics: {/doubled: std_msgs/msg/Int32}
    do:
      - {name: four, at: 1.0, publish: {topic: /number, type: std_msgs/msg/Int32, values: {data: 4}}}
      - {name: reset, at: 2.0, call: {service: /reset, type: std_srvs/srv/Trigger}}
      - {name: thrice, at: 3.0, set: {doubler: {factor: 3}}}
      - name: five
        at: 3.5
        publish: {topic: /number, type: std_msgs/msg/Int32, values: {data: 5}}
      - {name: small, at: 2.2, goal: {action: /turn, type: turtlesim/action/RotateAbsolute, values: {theta: 1.5}}}
      - {name: large, at: 2.4, goal: {action: /turn, type: turtlesim/action/RotateAbsolute, values: {theta: 6.0}}}
      - {name: enough, at: 2.8, cancel: large}
      - {name: excessive, at: 3.2, goal: {action: /turn, type: turtlesim/action/RotateAbsolute, values: {theta: 20.0}}}
checks:
  - {id: package.found, points: 1}
  - {id: readme, check: files.exists, points: 1, with: {path: README.md}}
  - {id: readme.text, check: files.matches, points: 1, with: {path: README.md, text: {contains: doubles}}}
  - {id: run.starts, points: 1}
  - {id: run.spins, points: 1}
  - {id: name, check: graph.node_name, points: 1, with: {name: doubler}}
  - {id: run.stays, points: 1}
  - {id: beat, check: topic.publishes, points: 1, with: {topic: /beat, type: std_msgs/msg/Bool, at_least: 10}}
  - {id: beat.period, check: topic.period, points: 1, with: {topic: /beat, period: 0.2}}
  - {id: beat.values, check: topic.values, points: 1, with: {topic: /beat, each: {data: true}}}
  - {id: beat.qos, check: topic.qos, points: 1, with: {topic: /beat, reliability: best_effort}}
  - {id: hears, check: topic.subscribes, points: 1, with: {topic: /number, type: std_msgs/msg/Int32}}
  - {id: eight, check: topic.reacts, points: 1, after: four, with: {topic: /doubled, within: 0.1, at_most: 1, each: {data: 8}}}
  - {id: fifteen, check: topic.reacts, points: 1, after: five, with: {topic: /doubled, within: 0.1, each: {data: 15}}}
  - {id: factor, check: parameter.declared, points: 1, with: {name: factor, type: integer, value: 2}}
  - {id: factor.set, check: parameter.accepts, points: 1, after: thrice, with: {name: factor}}
  - {id: offers, check: service.offers, points: 1, with: {service: /reset, type: std_srvs/srv/Trigger}}
  - {id: answers, check: service.answers, points: 1, after: reset, with: {service: /reset, each: {success: true, message: {contains: reset}}}}
  - {id: calls, check: service.calls, points: 1, with: {service: /go, type: std_srvs/srv/SetBool}}
  - {id: says, check: log.matches, points: 1, with: {text: {matches: '^got \\d+$'}, level: info, at_least: 2, at_most: 2}}
  - {id: nodes, check: graph.nodes, points: 1, with: {names: [/doubler], others: false}}
  - {id: itself, check: graph.connects, points: 1, with: {topic: /doubled, sender: /doubler, receiver: /doubler}}
  - {id: quiet, check: topic.silent, points: 1, during: [0, 0.9], with: {topic: /doubled}}
  - {id: count, check: log.counts, points: 1, with: {text: "beat {n}", at_least: 10}}
  - {id: count.period, check: log.period, points: 1, with: {text: "beat {n}", period: 0.2}}
  - {id: count.logger, check: log.logger, points: 1, with: {text: "beat {n}"}}
  - {id: turn, check: action.offers, points: 1, with: {action: /turn, type: turtlesim/action/RotateAbsolute}}
  - {id: turn.small, check: action.accepts, points: 1, after: small, with: {action: /turn}}
  - {id: turn.excessive, check: action.accepts, points: 1, after: excessive, with: {action: /turn, accepted: false}}
  - {id: turn.feedback, check: action.feedback, points: 1, after: small, with: {action: /turn, at_least: 2, each: {remaining: {between: [0, 1.5]}}}}
  - {id: turn.result, check: action.result, points: 1, after: small, with: {action: /turn, within: 0.1, each: {delta: -1.5}}}
  - {id: turn.cancel, check: action.cancels, points: 1, after: enough, with: {action: /turn, within: 0.3}}
  - {id: silent, check: log.never, points: 1, with: {text: {contains: lost}}}
  - {id: run.interrupt, points: 1}
"""

NODE = """\
#!/usr/bin/env python3
import rclpy
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.node import Node
from rclpy.task import Future
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import Bool, Int32
from std_srvs.srv import SetBool, Trigger
from turtlesim.action import RotateAbsolute


class Doubler(Node):
    def __init__(self):
        super().__init__('doubler')
        self.declare_parameter('factor', 2)
        best = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
        self.beat = self.create_publisher(Bool, '/beat', best)
        self.create_timer(0.2, self.on_timer)
        self.doubled = self.create_publisher(Int32, '/doubled', 10)
        self.create_subscription(Int32, '/number', self.on_number, 10)
        self.create_service(Trigger, '/reset', self.on_reset)
        self.go = self.create_client(SetBool, '/go')
        self.create_subscription(Int32, '/doubled', lambda _: None, 1)
        self.beats = 0
        self.waiting = None
        self.turn = ActionServer(self, RotateAbsolute, '/turn', self.on_goal,
                                 goal_callback=self.may,
                                 cancel_callback=lambda _: CancelResponse.ACCEPT)

    def may(self, goal):
        return GoalResponse.ACCEPT if goal.theta < 10 else GoalResponse.REJECT

    async def on_goal(self, handle):
        theta = handle.request.theta
        for part in (1.0, 0.5):
            handle.publish_feedback(RotateAbsolute.Feedback(remaining=part * theta))
        if theta > 5:
            self.goal, self.waiting = handle, Future()
            await self.waiting
            handle.canceled()
            return RotateAbsolute.Result()
        handle.succeed()
        return RotateAbsolute.Result(delta=-theta)

    def on_timer(self):
        if self.waiting and self.goal.is_cancel_requested:
            self.waiting.set_result(True)
            self.waiting = None
        self.get_logger().info(f'beat {self.beats}')
        self.beats += 1
        self.beat.publish(Bool(data=True))

    def on_number(self, message):
        self.get_logger().info(f'got {message.data}')
        factor = self.get_parameter('factor').value
        self.doubled.publish(Int32(data=message.data * factor))

    def on_reset(self, request, response):
        response.success = True
        response.message = 'reset'
        return response


def main(args=None):
    rclpy.init(args=args)
    node = Doubler()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass


if __name__ == '__main__':
    main()
"""

SETUP = """\
from setuptools import find_packages, setup
setup(
    name='doubling', version='0.0.0', packages=find_packages(), zip_safe=True,
    data_files=[('share/ament_index/resource_index/packages', ['resource/doubling']),
                ('share/doubling', ['package.xml'])],
    install_requires=['setuptools'], maintainer='a', maintainer_email='a@b.cd',
    description='doubles', license='Apache-2.0',
    entry_points={'console_scripts': ['doubler = doubling.doubler:main']},
)
"""

MANIFEST = """\
<?xml version="1.0"?>
<package format="3">
  <name>doubling</name><version>0.0.0</version><description>doubles</description>
  <maintainer email="a@b.cd">a</maintainer><license>Apache-2.0</license>
  <depend>rclpy</depend><depend>std_msgs</depend><depend>std_srvs</depend>
  <export><build_type>ament_python</build_type></export>
</package>
"""


@dataclass(frozen=True)
class Form:
    """A form of the package: texts of the node that are replaced, and the checks that must fail.

    `fails` has the mistake of each failed check; `skipped` the checks that it blocks.
    """

    name: str
    edits: tuple[tuple[str, str], ...]
    fails: dict[str, str]
    skipped: tuple[str, ...] = ()
    readme: tuple[str, str] = ("README.md", "A node that doubles.")


TURNS = ("turn.small", "turn.excessive", "turn.feedback", "turn.result", "turn.cancel")
OTHER_NAME = {
    "name": "run.wrong_node_name",
    "nodes": "graph.node_missing",
    "itself": "graph.not_connected",
}
FORMS = (
    Form("right", (), {}),
    Form(
        "names",
        (
            ("'/beat'", "'/beats'"),
            ("'/number'", "'/numbers'"),
            ("'factor', 2", "'Factor', 2"),
            ("get_parameter('factor')", "get_parameter('Factor')"),
            ("'/reset'", "'/rest'"),
            ("'/go'", "'/Go'"),
            ("f'got {message.data}'", "f'Got {message.data}'"),
            ("'/turn'", "'/Turn'"),
            ("super().__init__('doubler')", "super().__init__('Doubler')"),
        ),
        {
            **OTHER_NAME,
            "readme": "files.missing",
            "turn": "action.wrong_name",
            "beat": "topic.wrong_name",
            "hears": "topic.wrong_name",
            "factor": "parameter.not_declared",
            "offers": "service.wrong_name",
            "calls": "service.wrong_name",
        },
        (
            "beat.period",
            "beat.values",
            "beat.qos",
            "eight",
            "fifteen",
            "factor.set",
            "answers",
            "says",
            "readme.text",
            *TURNS,
        ),
        ("Readme.md", "A node that doubles."),
    ),
    Form(
        "types",
        (
            ("import Bool, Int32", "import Bool, Int32, Int64"),
            ("create_publisher(Bool, '/beat'", "create_publisher(Int32, '/beat'"),
            ("Bool(data=True)", "Int32(data=1)"),
            ("create_subscription(Int32, '/number'", "create_subscription(Int64, '/number'"),
            ("'factor', 2", "'factor', 2.0"),
            ("import SetBool, Trigger", "import Empty, SetBool, Trigger"),
            ("create_service(Trigger", "create_service(Empty"),
            ("response.success = True\n        response.message = 'reset'", "pass"),
            ("create_client(SetBool", "create_client(Trigger"),
            ("super().__init__('doubler')", "super().__init__('doubling')"),
            (
                "self.get_logger().info(f'beat {self.beats}')",
                "print(f'beat {self.beats}', flush=True)",
            ),
        ),
        {
            **OTHER_NAME,
            "count": "node.print_used",
            "count.logger": "node.print_used",
            "readme": "files.missing",
            "beat": "topic.wrong_type",
            "hears": "topic.wrong_type",
            "factor": "parameter.wrong_type",
            "offers": "service.wrong_type",
            "calls": "service.wrong_type",
        },
        (
            *("beat.period", "beat.values", "eight", "fifteen", "factor.set", "answers", "says"),
            *("readme.text", "count.period"),
        ),
        ("docs/README.md", "A node that doubles."),
    ),
    Form(
        "missing",
        (
            ("        self.beat.publish(Bool(data=True))", "        pass"),
            ("create_timer(0.2", "create_timer(0.3"),
            ("        self.create_subscription(Int32, '/number', self.on_number, 10)\n", ""),
            ("        self.declare_parameter('factor', 2)\n", ""),
            ("        self.create_service(Trigger, '/reset', self.on_reset)\n", ""),
            ("        self.go = self.create_client(SetBool, '/go')\n", ""),
            ("reliability=ReliabilityPolicy.BEST_EFFORT", "reliability=ReliabilityPolicy.RELIABLE"),
        ),
        {
            "readme.text": "files.no_match",
            "beat": "topic.never_published",
            "count.period": "log.wrong_period",
            "beat.qos": "topic.wrong_qos",
            "hears": "topic.no_subscription",
            "factor": "parameter.not_declared",
            "offers": "service.missing",
            "calls": "service.no_client",
        },
        ("beat.period", "beat.values", "eight", "fifteen", "factor.set", "answers", "says"),
        ("README.md", "A node that Doubles."),
    ),
    Form(
        "values",
        (
            ("create_timer(0.2", "create_timer(0.4"),
            ("'factor', 2", "'factor', 5"),
            (
                "QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)",
                "QoSProfile(depth=10)",
            ),
            (
                "super().__init__('doubler')",
                "super().__init__('doubler')\n        self.helper = Node('doubler_helper')",
            ),
            ("Bool(data=True)", "Bool(data=False)"),
            ("message.data * factor", "message.data + factor"),
            ("response.success = True", "response.success = False"),
            (
                "f'got {message.data}')",
                "f'got {message.data}')\n        self.get_logger().warn('lost')",
            ),
        ),
        {
            "readme.text": "files.no_match",
            "nodes": "graph.node_unexpected",
            "beat.qos": "topic.wrong_qos",
            "beat.period": "topic.wrong_period",
            "beat.values": "topic.wrong_value",
            "eight": "topic.wrong_value",
            "factor": "parameter.wrong_value",
            "answers": "service.wrong_answer",
            "silent": "log.forbidden",
            "count.period": "log.wrong_period",
            "turn.cancel": "action.not_cancelled",
        },
        ("fifteen",),
        ("README.md", ""),
    ),
    Form(
        "twice",
        (
            (
                "self.doubled.publish(Int32(data=message.data * factor))",
                "[self.doubled.publish(Int32(data=message.data * factor)) for _ in (0, 1)]",
            ),
        ),
        {"eight": "topic.reacts_too_often"},
    ),
    Form(
        "more",
        (
            ("info(f'beat", "warn(f'beat"),
            (
                "self.beat.publish(Bool(data=True))",
                "[self.beat.publish(Bool(data=i == 0)) for i in (0, 1)]",
            ),
            (
                "        factor = ",
                "        if message.data == 5:\n            return\n        factor = ",
            ),
            (
                "        self.declare_parameter('factor', 2)\n",
                "        self.declare_parameter('factor', 2)\n        self.set_parameters_callback_()\n",
            ),
            (
                "    def on_timer",
                "    def set_parameters_callback_(self):\n        self.add_on_set_parameters_callback(lambda _: SetParametersResult(successful=False, reason='no'))\n\n    def on_timer",
            ),
            (
                "import rclpy\n",
                "import rclpy\nfrom rcl_interfaces.msg import SetParametersResult\n",
            ),
            ("        response.message = 'reset'\n", ""),
            (
                "super().__init__('doubler')",
                "super().__init__('doubler')\n        self.other = Node('doubler', namespace='/lab')",
            ),
            (
                "f'got {message.data}')",
                "f'got {message.data}')\n        self.get_logger().info(f'got {message.data}')\n        self.get_logger().error('all lost')",
            ),
        ),
        {
            "count.logger": "run.wrong_level",
            "beat.period": "topic.several_at_once",
            "beat.values": "topic.wrong_value",
            "fifteen": "topic.no_reaction",
            "factor.set": "parameter.refused",
            "answers": "service.wrong_answer",
            "says": "log.too_often",
            "nodes": "graph.node_unexpected",
            "silent": "log.forbidden",
        },
    ),
    Form(
        "stops",
        (
            (
                "        self.beat.publish(Bool(data=True))",
                "        self.n = getattr(self, 'n', 0) + 1\n        if self.n < 12:\n            self.beat.publish(Bool(data=self.n < 11))",
            ),
            (
                "        self.doubled.publish(",
                "        self.create_client(Trigger, '/nobody').wait_for_service(0.1)\n        print(",
            ),
            ("        return response", "        return None"),
            ("f'got {message.data}'", "str(message.data)"),
            (
                "        response.success = True",
                "        self.get_logger().info('lost it')\n        response.success = True",
            ),
        ),
        {
            "run.stays": "node.service_callback",
            "eight": "topic.no_reaction",
            "silent": "log.forbidden",
        },
        (
            *("beat.period", "beat.values", "fifteen", "factor.set", "says"),
            *("answers", "count", "count.period", "count.logger", "run.interrupt", *TURNS),
        ),
    ),
    Form(
        "no_action",
        (
            (
                "        self.turn = ActionServer(self, RotateAbsolute, '/turn', self.on_goal,\n"
                "                                 goal_callback=self.may,\n"
                "                                 cancel_callback=lambda _: CancelResponse.ACCEPT)\n",
                "",
            ),
            ("self.beats = 0", "self.beats = 1"),
            ("create_subscription(Int32, '/doubled'", "create_subscription(Int32, '~/doubled'"),
            (
                "        self.get_logger().info(f'beat",
                "        if not self.beats:\n            self.doubled.publish(Int32())\n"
                "        self.get_logger().info(f'beat",
            ),
            (
                "super().__init__('doubler')",
                "super().__init__('doubler')\n        self.other = Node('other')",
            ),
        ),
        {
            "turn": "action.missing",
            "count": "log.wrong_count",
            "itself": "graph.not_connected",
            "nodes": "graph.node_unexpected",
            "readme.text": "files.no_match",
        },
        TURNS,
        ("README.md", "A node."),
    ),
    Form(
        "action_named_otherwise",
        (
            ("'/turn'", "'/turns'"),
            ("f'beat {self.beats}'", "f'Beat {self.beats}'"),
            ("        self.create_subscription(Int32, '/doubled', lambda _: None, 1)\n", ""),
            (
                "        self.get_logger().info(f'Beat",
                "        if not self.beats:\n            self.doubled.publish(Int32())\n"
                "        self.get_logger().info(f'Beat",
            ),
        ),
        {
            "turn": "action.wrong_name",
            "count": "log.missing",
            "itself": "graph.not_connected",
            "quiet": "topic.not_silent",
            "readme": "files.missing",
        },
        ("readme.text", "count.period", "count.logger", *TURNS),
        ("readme.txt", "A node that doubles."),
    ),
    Form(
        "action_refuses",
        (
            (
                "GoalResponse.ACCEPT if goal.theta < 10 else GoalResponse.REJECT",
                "GoalResponse.REJECT",
            ),
            ("self.beats += 1", "self.beats += 2"),
            ("'/doubled', lambda _: None", "'/doubles', lambda _: None"),
            (
                "        self.beat.publish",
                "        self.doubled.publish(Int32())\n        self.beat.publish",
            ),
        ),
        {
            "turn.small": "action.refused",
            "count": "log.wrong_count",
            "itself": "graph.not_connected",
            "quiet": "topic.not_silent",
            "eight": "topic.reacts_too_often",
        },
        ("turn.feedback", "turn.result", "turn.cancel"),
    ),
    Form(
        "action_takes_all",
        (
            (
                "GoalResponse.ACCEPT if goal.theta < 10 else GoalResponse.REJECT",
                "GoalResponse.ACCEPT",
            ),
            (
                "        for part in (1.0, 0.5):\n            handle.publish_feedback(RotateAbsolute.Feedback(remaining=part * theta))\n",
                "",
            ),
            ("Result(delta=-theta)", "Result(delta=theta)"),
            ("self.get_logger().info(f'beat", "rclpy.logging.get_logger('beats').info(f'beat"),
            ("CancelResponse.ACCEPT)", "CancelResponse.REJECT)"),
            (
                "        self.declare_parameter('factor', 2)\n",
                "        self.declare_parameter('factor', 2)\n        self.add_on_set_parameters_callback(self.on_set)\n",
            ),
            (
                "    def on_timer",
                "    def on_set(self, new):\n        even = all(one.value % 2 == 0 for one in new)\n        return SetParametersResult(successful=even, reason='odd')\n\n    def on_timer",
            ),
            (
                "import rclpy\n",
                "import rclpy\nfrom rcl_interfaces.msg import SetParametersResult\n",
            ),
            ("response.message = 'reset'", "response.message = 'done'"),
            (  # before the clock starts: whether anybody hears it is chance
                "        self.turn = ",
                "        self.doubled.publish(Int32())\n        self.turn = ",
            ),
        ),
        {
            "count": "log.missing",
            "count.logger": "node.logger_by_name",
            "factor.set": "parameter.refused",
            "fifteen": "topic.wrong_value",
            "answers": "service.wrong_answer",
            "turn.excessive": "action.accepted",
            "turn.feedback": "action.no_feedback",
            "turn.result": "action.wrong_result",
            "turn.cancel": "action.not_cancelled",
        },
        ("count.period",),
    ),
    Form(
        "action_aborts",
        (
            ("        handle.succeed()\n", ""),
            ("remaining=part * theta", "remaining=-part * theta"),
            ("            handle.canceled()\n", "            handle.succeed()\n"),
            ("goal.theta < 10", "goal.theta < 30"),
            ("'factor', 2)", "'factor', 2, ParameterDescriptor(read_only=True))"),
            (
                "import rclpy\n",
                "import rclpy\nfrom rcl_interfaces.msg import ParameterDescriptor\n",
            ),
            ("info(f'got", "warn(f'got"),
        ),
        {
            "factor.set": "parameter.refused",
            "fifteen": "topic.wrong_value",
            "says": "log.wrong_level",
            "turn.excessive": "action.accepted",
            "turn.feedback": "action.wrong_feedback",
            "turn.result": "action.wrong_status",
            "turn.cancel": "action.not_cancelled",
        },
    ),
    Form(
        "action_never_ends",
        (
            ("        if theta > 5:", "        if theta > 0:"),
            ("for part in (1.0, 0.5)", "for part in (1.0,)"),
            ("if self.waiting and self.goal.is_cancel_requested", "if False"),
            ("create_publisher(Bool, '/beat', best)", "create_publisher(Bool, '/beat', 10)"),
            ("f'got {message.data}'", "f'got: {message.data}'"),
            ("Bool(data=True)", "Bool(data=self.beats % 2 == 0)"),
            ("create_timer(0.2", "create_timer(0.1"),
            ("super().__init__('doubler')", "super().__init__('doubler', namespace='/lab')"),
        ),
        {
            **OTHER_NAME,
            "beat.qos": "topic.wrong_qos",
            "beat.values": "topic.wrong_value",
            "beat.period": "topic.wrong_period",
            "count.period": "log.wrong_period",
            "says": "log.missing",
            "turn.feedback": "action.no_feedback",
            "turn.result": "action.no_result",
            "turn.cancel": "action.not_cancelled",
        },
    ),
)


def write_course(folder: Path) -> Path:
    """Write the assignment's file and return its path."""
    file = folder / "doubling" / "assignment.yaml"
    file.parent.mkdir(parents=True)
    file.write_text(ASSIGNMENT, encoding="utf-8")
    return file


def write_package(form: Form, folder: Path) -> Path:
    """Write a form of the package and return its folder."""
    root = folder / form.name / "doubling"
    node = NODE
    for old, new in form.edits:
        assert node.count(old) == 1, (form.name, old)
        node = node.replace(old, new)
    write_files(root, node)
    readme = root / form.readme[0]
    readme.parent.mkdir(exist_ok=True)
    readme.write_text(form.readme[1], encoding="utf-8")
    return root


def write_files(root: Path, node: str) -> None:
    """Write the package `doubling` with the text of its node."""
    texts = {
        "package.xml": MANIFEST,
        "setup.py": SETUP,
        "setup.cfg": "[develop]\nscript_dir=$base/lib/doubling\n"
        "[install]\ninstall_scripts=$base/lib/doubling\n",
        "resource/doubling": "",
        "doubling/__init__.py": "",
        "doubling/doubler.py": node,
    }
    for path, text in texts.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text, encoding="utf-8")
    (root / "doubling/doubler.py").chmod(0o755)
