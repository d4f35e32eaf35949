"""Small assignments that somebody could write from the documentation, with packages for them.

Each has one package, `small`, that gets full marks, and broken forms of it: a text that is replaced,
the checks that must fail for it, each with its first mistake, and the place of the first one.
What else fails because of that is skipped.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

HEAD = """\
schema: 2
id: small
title: "A small assignment"
package: small
"""
BASE = """\
  - {id: run.starts, points: 1}
  - {id: run.spins, points: 1}
  - {id: run.stays, points: 1}
"""
SETUP = """\
from setuptools import find_packages, setup

setup(
    name='small', version='0.0.0', packages=find_packages(), zip_safe=True,
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/small']),
        ('share/small', ['package.xml']),
DATA_FILES    ],
    install_requires=['setuptools'], maintainer='a', maintainer_email='a@b.cd',
    description='small', license='Apache-2.0',
    entry_points={'console_scripts': [
ENTRIES    ]},
)
"""
MANIFEST = """\
<?xml version="1.0"?>
<package format="3">
  <name>small</name><version>0.0.0</version><description>small</description>
  <maintainer email="a@b.cd">a</maintainer><license>Apache-2.0</license>
  <depend>rclpy</depend><depend>std_msgs</depend><depend>std_srvs</depend>
  <export><build_type>ament_python</build_type></export>
</package>
"""
MAIN = """

def main():
    rclpy.init()
    try:
        rclpy.spin(THIS())
    except KeyboardInterrupt:
        pass
"""


@dataclass(frozen=True)
class Broken:
    """A broken form: `edits` are (file, old text, new text).

    Without an old text, the new one is the whole file; None takes the file away.
    """

    name: str
    edits: tuple[tuple[str, str, str | None], ...]
    fails: Mapping[str, str]
    where: str = ""
    says: tuple[str, ...] = ()
    never: tuple[str, ...] = ()


@dataclass(frozen=True)
class Lesson:
    """An assignment (without its head), the files of its right package, and broken ones."""

    name: str
    assignment: str
    files: Mapping[str, str]
    broken: tuple[Broken, ...] = ()
    data_files: str = ""
    entries: tuple[str, ...] = field(default=("node",))

    def write(self, folder: Path, form: Broken | None = None) -> Path:
        """Write a package and return its folder."""
        texts = {
            "package.xml": MANIFEST,
            "setup.py": SETUP.replace("DATA_FILES", self.data_files).replace(
                "ENTRIES", "".join(f"        '{n} = small.{n}:main',\n" for n in self.entries)
            ),
            "setup.cfg": "[develop]\nscript_dir=$base/lib/small\n[install]\ninstall_scripts=$base/lib/small\n",
            "resource/small": "",
            "small/__init__.py": "",
            **self.files,
        }
        for file, old, new in form.edits if form is not None else ():
            assert not old or old in texts[file], (file, old)
            if new is None:
                del texts[file]
            else:
                texts[file] = texts[file].replace(old, new) if old else new
        root = folder / "small"
        for name, text in texts.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return root


def _node(imports: str, body: str, this: str = "This", main: str = MAIN) -> str:
    return f"import rclpy\nfrom rclpy.node import Node\n{imports}\n\n{body}{main.replace('THIS', this)}"


NODE = "small/node.py"
HYSTERESIS = Lesson(
    "hysteresis",
    """\
nodes:
  alarm: {executable: node, target: small.node:main, file: node.py, name: alarm}
runs:
  - name: warms
    start: [{node: alarm}]
    clock: {period: 0.5, ticks: 10}
    do:
      - {name: cool, at: 0.5, publish: {topic: /temperature, type: std_msgs/msg/Float64, values: {data: 20.0}}}
      - {name: hot, at: 1.0, publish: {topic: /temperature, type: std_msgs/msg/Float64, values: {data: 31.0}}}
      - {name: between, at: 2.0, publish: {topic: /temperature, type: std_msgs/msg/Float64, values: {data: 27.0}}}
      - {name: cold, at: 3.0, publish: {topic: /temperature, type: std_msgs/msg/Float64, values: {data: 24.0}}}
checks:
"""
    + BASE
    + """\
  - {id: hears, check: topic.subscribes, points: 1, with: {topic: /temperature, type: std_msgs/msg/Float64}}
  - {id: says, check: topic.publishes, points: 1, with: {topic: /alarm, type: std_msgs/msg/Bool}}
  - {id: warns, check: topic.reacts, points: 1, after: hot, with: {topic: /alarm, within: 0.1, at_most: 1, each: {data: true}}}
  - {id: stays_on, check: topic.silent, points: 1, after: between, during: [0, 0.5], with: {topic: /alarm}}
  - {id: calms, check: topic.reacts, points: 1, after: cold, with: {topic: /alarm, within: 0.1, each: {data: false}}}
  - {id: tells, check: log.matches, points: 1, after: hot, with: {text: {contains: hot}}}
""",
    {
        NODE: _node(
            "from std_msgs.msg import Bool, Float64",
            """\
class This(Node):
    def __init__(self):
        super().__init__('alarm')
        self.is_on = False
        self.alarm = self.create_publisher(Bool, 'alarm', 10)
        self.create_subscription(Float64, 'temperature', self.on_temperature, 10)

    def on_temperature(self, message):
        if message.data > 30.0 and not self.is_on:
            self.get_logger().info('hot')
            self.tell(True)
        elif message.data < 25.0 and self.is_on:
            self.tell(False)

    def tell(self, is_on):
        self.is_on = is_on
        self.alarm.publish(Bool(data=is_on))
""",
        )
    },
    (
        Broken(
            "threshold_too_high",
            ((NODE, "> 30.0", "> 40.0"),),
            {"says": "topic.never_published"},
            never=("Publish on /alarm in the callback", "Call self.publisher_.publish(message)"),
        ),
        Broken(
            "no_hysteresis",
            ((NODE, "< 25.0", "< 28.0"),),
            {"stays_on": "topic.not_silent", "calms": "topic.no_reaction"},
            never=("Publish on /alarm in the callback",),
        ),
        Broken(
            "other_topic_heard",
            ((NODE, "'temperature'", "'temperatures'"),),
            {"hears": "topic.wrong_name"},
        ),
    ),
)
SERVICE = Lesson(
    "service",
    """\
nodes:
  switch: {executable: node, target: small.node:main, file: node.py, name: switch}
runs:
  - name: asks
    start: [{node: switch}]
    clock: {period: 0.5, ticks: 8}
    do:
      - {name: turn_on, at: 1.0, call: {service: /switch, type: std_srvs/srv/SetBool, values: {data: true}}}
checks:
"""
    + BASE
    + """\
  - {id: offers, check: service.offers, points: 1, with: {service: /switch, type: std_srvs/srv/SetBool}}
  - {id: answers, check: service.answers, points: 1, after: turn_on, with: {service: /switch, each: {success: true}}}
  - {id: state, check: topic.reacts, points: 1, after: turn_on, with: {topic: /state, within: 0.1, each: {data: true}}}
  - {id: says, check: topic.publishes, points: 1, with: {topic: /state, type: std_msgs/msg/Bool}}
  - {id: tells, check: log.matches, points: 1, with: {text: {contains: "switched on"}}}
""",
    {
        NODE: _node(
            "from std_msgs.msg import Bool\nfrom std_srvs.srv import SetBool",
            """\
class This(Node):
    def __init__(self):
        super().__init__('switch')
        self.state = self.create_publisher(Bool, 'state', 10)
        self.create_service(SetBool, 'switch', self.on_switch)

    def on_switch(self, request, response):
        self.state.publish(Bool(data=request.data))
        self.get_logger().info('switched on' if request.data else 'switched off')
        response.success = True
        return response
""",
        )
    },
    (
        Broken(
            "other_service",
            ((NODE, "'switch', self.on", "'swich', self.on"),),
            {"offers": "service.wrong_name"},
        ),
        Broken(
            "returns_early",
            (
                (
                    NODE,
                    "        self.state.publish",
                    "        return response\n        self.state.publish",
                ),
            ),
            {"answers": "service.wrong_answer"},
        ),
        Broken(
            "not_read",
            ((NODE, "data=request.data", "data=False"),),
            {"state": "topic.wrong_value"},
            never=("Set data to true",),
        ),
    ),
)
ACTION_IMPORTS = """\
from rclpy.action import ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.duration import Duration
from turtlesim.action import RotateAbsolute
"""
ACTION = Lesson(
    "action",
    """\
nodes:
  turner: {executable: node, target: small.node:main, file: node.py, name: turner}
runs:
  - name: turns
    start: [{node: turner}]
    clock: {period: 0.5, ticks: 16}
    do:
      - {name: short, at: 1.0, goal: {action: /turn, type: turtlesim/action/RotateAbsolute, values: {theta: 1.0}}}
      - {name: long, at: 3.0, goal: {action: /turn, type: turtlesim/action/RotateAbsolute, values: {theta: 6.0}}}
      - {name: enough, at: 4.0, cancel: long}
checks:
"""
    + BASE
    + """\
  - {id: offers, check: action.offers, points: 1, with: {action: /turn, type: turtlesim/action/RotateAbsolute}}
  - {id: accepts, check: action.accepts, points: 1, after: short, with: {action: /turn}}
  - {id: feedback, check: action.feedback, points: 1, after: short, with: {action: /turn}}
  - {id: result, check: action.result, points: 1, after: short, with: {action: /turn, within: 1.5, each: {delta: 1.0}}}
  - {id: cancels, check: action.cancels, points: 1, after: enough, with: {action: /turn, within: 1.0}}
  - {id: tells, check: log.matches, points: 1, after: enough, with: {text: {contains: cancelled}}}
""",
    {
        NODE: _node(
            ACTION_IMPORTS,
            """\
class This(Node):
    def __init__(self):
        super().__init__('turner')
        self.server = ActionServer(self, RotateAbsolute, 'turn', self.execute,
                                   cancel_callback=self.may_cancel,
                                   callback_group=ReentrantCallbackGroup())

    def may_cancel(self, handle):
        return CancelResponse.ACCEPT

    def execute(self, handle):
        left = handle.request.theta
        while left > 0.0:
            if handle.is_cancel_requested:
                handle.canceled()
                self.get_logger().info('cancelled')
                return RotateAbsolute.Result()
            handle.publish_feedback(RotateAbsolute.Feedback(remaining=left))
            self.get_clock().sleep_for(Duration(seconds=0.5))
            left -= 0.5
        handle.succeed()
        return RotateAbsolute.Result(delta=handle.request.theta)
""",
            main="""

def main():
    rclpy.init()
    executor = MultiThreadedExecutor()
    executor.add_node(This())
    try:
        executor.spin()
    except KeyboardInterrupt:
        pass
""",
        )
    },
    (
        Broken(
            "never_looks",
            ((NODE, "if handle.is_cancel_requested:", "if False:"),),
            {"cancels": "action.not_cancelled"},
            never=("Pass a cancel_callback",),
        ),
        Broken(
            "sleeps",
            (
                (
                    NODE,
                    "self.get_clock().sleep",
                    "time.sleep(3) if left < 5.0 else self.get_clock().sleep",
                ),
                (NODE, "import rclpy\n", "import time\n\nimport rclpy\n"),
            ),
            {"result": "action.no_result"},
            says=("in place of time.sleep(…), with Duration from rclpy.duration.",),
            never=("and spin the node with a MultiThreadedExecutor",),
        ),
        Broken(
            "no_result",
            ((NODE, "        handle.succeed()\n", ""),),
            {"result": "action.wrong_status"},
        ),
    ),
)
ROBOT = Lesson(
    "robot",
    """\
nodes:
  halt: {executable: node, target: small.node:main, file: node.py, name: halt}
runs:
  - name: drives
    world: robot
    start: [{node: halt}]
    clock: {period: 0.5, ticks: 18}
    topics: {/odom: nav_msgs/msg/Odometry}
checks:
"""
    + BASE
    + """\
  - {id: hears, check: topic.subscribes, points: 1, with: {topic: /scan, type: sensor_msgs/msg/LaserScan}}
  - {id: steers, check: topic.publishes, points: 1, with: {topic: /cmd_vel, type: geometry_msgs/msg/Twist}}
  - {id: stopped, check: topic.values, points: 1, during: [8, 9], with: {topic: /odom, each: {twist.twist.linear.x: {about: 0.0, within: 0.01}}}}
  - {id: drives, check: topic.values, points: 1, during: [0.5, 2], with: {topic: /cmd_vel, each: {linear.x: 1.0}}}
  - {id: halts, check: topic.values, points: 1, during: [8, 9], with: {topic: /cmd_vel, each: {linear.x: 0.0}}}
  - {id: never, check: world.event, points: 1, with: {event: bump}}
""",
    {
        NODE: _node(
            "from geometry_msgs.msg import Twist\nfrom sensor_msgs.msg import LaserScan",
            """\
class This(Node):
    def __init__(self):
        super().__init__('halt')
        self.publisher = self.create_publisher(Twist, 'cmd_vel', 10)
        self.create_subscription(LaserScan, 'scan', self.on_scan, 10)

    def on_scan(self, scan):
        message = Twist()
        message.linear.x = 1.0 if scan.ranges[0] > 1.0 else 0.0
        self.publisher.publish(message)
""",
        )
    },
    (
        Broken(
            "creeps",
            ((NODE, "else 0.0", "else -0.1"),),
            {"halts": "topic.wrong_value"},
            never=("Set twist.twist",),
        ),
        Broken(
            "scan_misspelt",
            ((NODE, "'scan'", "'scans'"),),
            {"hears": "topic.wrong_name"},
        ),
    ),
)
LIFECYCLE = Lesson(
    "lifecycle",
    """\
nodes:
  talker: {executable: node, target: small.node:main, file: node.py, name: talker}
runs:
  - name: changes
    start: [{node: talker}]
    clock: {period: 0.5, ticks: 14}
    do:
      - {name: configure, at: 1.0, call: {service: /talker/change_state, type: lifecycle_msgs/srv/ChangeState, values: {transition: {id: 1}}}}
      - {name: activate, at: 2.0, call: {service: /talker/change_state, type: lifecycle_msgs/srv/ChangeState, values: {transition: {id: 3}}}}
      - {name: deactivate, at: 5.0, call: {service: /talker/change_state, type: lifecycle_msgs/srv/ChangeState, values: {transition: {id: 4}}}}
checks:
"""
    + BASE
    + """\
  - {id: configures, check: service.answers, points: 1, after: configure, with: {service: /talker/change_state, each: {success: true}}}
  - {id: activates, check: service.answers, points: 1, after: activate, with: {service: /talker/change_state, each: {success: true}}}
  - {id: says, check: topic.publishes, points: 1, with: {topic: /chatter, type: std_msgs/msg/String}}
  - {id: quiet, check: topic.silent, points: 1, during: [0, 1.9], with: {topic: /chatter}}
  - {id: talks, check: topic.reacts, points: 1, after: activate, with: {topic: /chatter, within: 1.0}}
  - {id: quiet_again, check: topic.silent, points: 1, after: deactivate, during: [0.5, 1.5], with: {topic: /chatter}}
""",
    {
        NODE: """\
import rclpy
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from std_msgs.msg import String


class Talker(LifecycleNode):
    def __init__(self):
        super().__init__('talker')
        self.publisher = None
        self.timer = None

    def on_configure(self, state):
        self.publisher = self.create_lifecycle_publisher(String, 'chatter', 10)
        self.timer = self.create_timer(0.5, self.on_timer)
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state):
        return super().on_activate(state)

    def on_deactivate(self, state):
        return super().on_deactivate(state)

    def on_timer(self):
        self.publisher.publish(String(data='hello'))
"""
        + MAIN.replace("THIS", "Talker")
    },
    (
        Broken(
            "no_super_on_activate",
            (
                (
                    NODE,
                    "return super().on_activate(state)",
                    "return TransitionCallbackReturn.SUCCESS",
                ),
            ),
            {"says": "lifecycle.not_passed_on"},
            where="small/node.py:17",
            says=("The node is active from 2 s on", "return super().on_activate(state)"),
        ),
        Broken(
            "configure_returns_nothing",
            (
                (
                    NODE,
                    "10)\n        self.timer = self.create_timer(0.5, self.on_timer)\n        return TransitionCallbackReturn.SUCCESS",
                    "10)\n        self.timer = self.create_timer(0.5, self.on_timer)",
                ),
            ),
            {"run.stays": "lifecycle.returns_nothing"},
            where="small/node.py:12",
            says=("At 1 s the node was asked for this transition",),
        ),
        Broken(
            "configure_fails",
            (
                (
                    NODE,
                    "self.on_timer)\n        return TransitionCallbackReturn.SUCCESS",
                    "self.on_timer)\n        return TransitionCallbackReturn.FAILURE",
                ),
            ),
            {"configures": "lifecycle.failed"},
            where="small/node.py:12",
            says=("its answer was: success: false",),
        ),
        Broken(
            "plain_publisher",
            ((NODE, "create_lifecycle_publisher", "create_publisher"),),
            {"quiet": "lifecycle.plain_publisher"},
            where="small/node.py:13",
        ),
    ),
)
YAML = "config/limits.yaml"
PARAMETERS = Lesson(
    "parameters",
    f"""\
nodes:
  limiter: {{executable: node, target: small.node:main, file: node.py, name: limiter}}
runs:
  - name: given
    start: [{{node: limiter, params_file: {YAML}}}]
    clock: {{period: 0.5, ticks: 8}}
    do:
      - {{name: much, at: 1.0, publish: {{topic: /speed, type: std_msgs/msg/Float64, values: {{data: 9.0}}}}}}
checks:
"""
    + BASE
    + """\
  - {id: hears, check: topic.subscribes, points: 1, with: {topic: /speed, type: std_msgs/msg/Float64}}
  - {id: says, check: topic.publishes, points: 1, with: {topic: /limited, type: std_msgs/msg/Float64}}
  - {id: limit, check: parameter.declared, points: 1, with: {name: max_speed, type: double, value: 2.5}}
  - {id: limits, check: topic.reacts, points: 1, after: much, with: {topic: /limited, within: 0.1, each: {data: 2.5}}}
""",
    {
        NODE: _node(
            "from std_msgs.msg import Float64",
            """\
class This(Node):
    def __init__(self):
        super().__init__('limiter')
        self.declare_parameter('max_speed', 1.0)
        self.limited = self.create_publisher(Float64, 'limited', 10)
        self.create_subscription(Float64, 'speed', self.on_speed, 10)

    def on_speed(self, message):
        most = self.get_parameter('max_speed').value
        self.limited.publish(Float64(data=min(message.data, most)))
""",
        ),
        YAML: "limiter:\n  ros__parameters:\n    max_speed: 2.5\n",
    },
    (
        Broken(
            "not_installed",
            (("setup.py", "        ('share/small/config', ['config/limits.yaml']),\n", ""),),
            {"run.starts": "setup.file_not_installed"},
            where="setup.py:5",
            says=("data_files", "('share/small/config', ['config/limits.yaml'])"),
        ),
        Broken(
            "other_folder",
            (("setup.py", "'share/small/config'", "'share/small'"),),
            {"run.starts": "setup.file_not_installed"},
            where="setup.py:8",
        ),
        Broken(
            "other_node",
            ((YAML, "limiter:", "limitter:"),),
            {"limit": "parameter.file_other_node"},
            where=f"{YAML}:1",
        ),
        Broken(
            "whole_number",
            ((YAML, "2.5", "2"),),
            {"run.starts": "parameter.file_other_type"},
            where=f"{YAML}:3",
        ),
        Broken(
            "other_parameter",
            ((YAML, "max_speed", "maximum_speed"),),
            {"limit": "parameter.file_unknown"},
            where=f"{YAML}:3",
        ),
        Broken(
            "declared_otherwise",
            ((NODE, "'max_speed'", "'maximum_speed'"),),
            {"limit": "parameter.not_declared"},
            where="small/node.py:8",
        ),
    ),
    data_files=f"        ('share/small/config', ['{YAML}']),\n",
)
RELAY = Lesson(
    "relay",
    """\
nodes:
  source: {executable: source, target: small.source:main, file: source.py, name: source}
  relay: {executable: node, target: small.node:main, file: node.py, name: relay}
runs:
  - name: both
    start: [{node: source}, {node: relay}]
    clock: {period: 0.5, ticks: 8}
checks:
"""
    + BASE
    + """\
  - {id: relay_says, check: topic.values, of: relay, points: 1, with: {topic: /doubled, each: {data: 14}}}
  - {id: source_says, check: topic.values, of: source, points: 1, with: {topic: /raw, each: {data: 7}}}
  - {id: raw, check: topic.publishes, of: source, points: 1, with: {topic: /raw, type: std_msgs/msg/Int32}}
  - {id: doubled, check: topic.publishes, of: relay, points: 1, with: {topic: /doubled, type: std_msgs/msg/Int32}}
""",
    {
        "small/source.py": _node(
            "from std_msgs.msg import Int32",
            """\
class This(Node):
    def __init__(self):
        super().__init__('source')
        self.raw = self.create_publisher(Int32, 'raw', 10)
        self.create_timer(0.5, self.on_timer)

    def on_timer(self):
        self.raw.publish(Int32(data=7))
""",
        ),
        NODE: _node(
            "from std_msgs.msg import Int32",
            """\
class This(Node):
    def __init__(self):
        super().__init__('relay')
        self.doubled = self.create_publisher(Int32, 'doubled', 10)
        self.create_subscription(Int32, 'raw', self.on_raw, 10)

    def on_raw(self, message):
        self.doubled.publish(Int32(data=2 * message.data))
""",
        ),
    },
    (
        Broken(
            "wrong_source",
            (("small/source.py", "data=7", "data=8"),),
            {"source_says": "topic.wrong_value"},
            where="small/source.py:12",
        ),
        Broken(
            "wrong_relay",
            ((NODE, "data=2 *", "data=3 *"),),
            {"relay_says": "topic.wrong_value"},
            where="small/node.py:12",
        ),
    ),
    entries=("source", "node"),
)
LESSONS = (RELAY, HYSTERESIS, SERVICE, ACTION, ROBOT, LIFECYCLE, PARAMETERS)
