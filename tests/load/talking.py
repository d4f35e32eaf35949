"""A talker and a listener, and an alarm with hysteresis: their assignments and packages, as text."""

from __future__ import annotations

from pathlib import Path

TALKING = """\
schema: 2
id: talking
title: "A talker and a listener"
package: my_talking
nodes:
  talker: {executable: talker, target: "my_talking.talker:main", file: talker.py, name: talker}
  listener: {executable: listener, target: "my_talking.listener:main", file: listener.py, name: listener}
runs:
  - name: chat
    start: [{node: talker}, {node: listener}]
    clock: {period: 0.25, ticks: 40}
  - name: alone
    start: [{node: listener}]
    clock: {period: 0.25, ticks: 24}
    do:
      - {name: moin, at: 1.0, publish: {topic: /chatter, type: std_msgs/msg/String, values: {data: "moin 42"}}}
      - {name: servus, at: 3.0, publish: {topic: /chatter, type: std_msgs/msg/String, values: {data: "servus"}}}
checks:
  - {id: package.found, points: 5}
  - {id: build.colcon, points: 5}
  - {id: entry_point.mapping, points: 5}
  - {id: entry_point.executable, points: 5}
  - {id: run.starts, points: 5}
  - {id: run.spins, points: 5}
  - {id: run.node_name, points: 5}
  - {id: run.stays, points: 5}
  - {id: talker.publishes, check: topic.publishes, of: talker, points: 10, with: {topic: /chatter, type: std_msgs/msg/String, at_least: 5}}
  - {id: talker.period, check: topic.period, of: talker, points: 10, with: {topic: /chatter, period: 0.5}}
  - {id: talker.values, check: topic.values, of: talker, points: 10, with: {topic: /chatter, each: {data: {matches: '^Hello World: \\d+$'}}}}
  - {id: listener.subscribes, check: topic.subscribes, of: listener, run: alone, points: 10, with: {topic: /chatter, type: std_msgs/msg/String}}
  - {id: listener.logs, check: log.matches, of: listener, run: alone, after: moin, during: [0, 1.0], points: 10, with: {text: {matches: '^I heard: .?moin 42.?$'}, level: info, at_most: 1}}
  - {id: listener.again, check: log.matches, of: listener, run: alone, after: servus, points: 5, with: {text: {matches: '^I heard: .?servus.?$'}, at_most: 1}}
  - {id: listener.hears, check: log.matches, of: listener, run: chat, points: 5, with: {text: {contains: "Hello World"}, at_least: 5}}
  - {id: run.interrupt, points: 5}
"""
TALKER = """\
#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Talker(Node):
    def __init__(self):
        super().__init__('talker')
        self.i = 0
        self.pub = self.create_publisher(String, 'chatter', 10)
        self.timer = self.create_timer(0.5, self.cb)

    def cb(self):
        msg = String()
        msg.data = 'Hello World: %d' % self.i
        self.pub.publish(msg)
        self.get_logger().info('Publishing: "%s"' % msg.data)
        self.i += 1


def main(args=None):
    rclpy.init(args=args)
    node = Talker()
    rclpy.spin(node)
    node.destroy_node()
    rclpy.shutdown()
"""
LISTENER = """\
#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Listener(Node):
    def __init__(self):
        super().__init__('listener')
        self.sub = self.create_subscription(String, 'chatter', self.cb, 10)

    def cb(self, msg):
        self.get_logger().info('I heard: "%s"' % msg.data)


def main(args=None):
    rclpy.init(args=args)
    node = Listener()
    rclpy.spin(node)
    node.destroy_node()
    rclpy.shutdown()
"""
ALARM = """\
schema: 2
id: alarm
title: "A temperature alarm with hysteresis"
package: my_monitor
nodes:
  monitor: {executable: monitor, target: "my_monitor.monitor:main", file: monitor.py, name: temp_monitor}
runs:
  - name: ramp
    start: [{node: monitor}]
    clock: {period: 0.5, ticks: 20}
    do:
      - {name: hot, at: 3.0, publish: {topic: /temperature, type: std_msgs/msg/Float64, values: {data: 50.5}}}
      - {name: dips, at: 5.0, publish: {topic: /temperature, type: std_msgs/msg/Float64, values: {data: 47.0}}}
      - {name: cooled, at: 7.0, publish: {topic: /temperature, type: std_msgs/msg/Float64, values: {data: 44.9}}}
  - name: other
    start: [{node: monitor, parameters: {threshold: 80.0, hysteresis: 20.0}}]
    clock: {period: 0.5, ticks: 12}
    topics: {/alarm: std_msgs/msg/Bool}
    do:
      - {name: above, at: 1.0, publish: {topic: /temperature, type: std_msgs/msg/Float64, values: {data: 81.0}}}
      - {name: within, at: 3.0, publish: {topic: /temperature, type: std_msgs/msg/Float64, values: {data: 61.0}}}
checks:
  - {id: package.found, points: 5}
  - {id: build.colcon, points: 5}
  - {id: run.starts, points: 5}
  - {id: run.spins, points: 5}
  - {id: run.stays, points: 5}
  - {id: hears, check: topic.subscribes, points: 5, with: {topic: /temperature, type: std_msgs/msg/Float64}}
  - {id: says, check: topic.publishes, points: 5, with: {topic: /alarm, type: std_msgs/msg/Bool}}
  - {id: threshold, check: parameter.declared, points: 5, with: {name: threshold, type: double, value: 50.0}}
  - {id: hot.alarm, check: topic.reacts, after: hot, points: 5, with: {topic: /alarm, within: 0.5, each: {data: true}, at_most: 1}}
  - {id: dips.stays, check: topic.reacts, after: dips, points: 5, with: {topic: /alarm, within: 0.5, each: {data: true}}}
  - {id: cooled.off, check: topic.reacts, after: cooled, points: 5, with: {topic: /alarm, within: 0.5, each: {data: false}}}
  - {id: other.above, check: topic.reacts, run: other, after: above, points: 3, with: {topic: /alarm, within: 0.5, each: {data: true}}}
  - {id: other.within, check: topic.reacts, run: other, after: within, points: 3, with: {topic: /alarm, within: 0.5, each: {data: true}}}
  - {id: run.interrupt, points: 5}
"""
MONITOR = """\
#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import Bool, Float64


class Monitor(Node):
    def __init__(self):
        super().__init__('temp_monitor')
        self.declare_parameter('threshold', 50.0)
        self.declare_parameter('hysteresis', 5.0)
        self.alarm = False
        self.pub = self.create_publisher(Bool, '/alarm', 10)
        self.create_subscription(Float64, '/temperature', self.on_temperature, 10)

    def on_temperature(self, msg):
        threshold = self.get_parameter('threshold').value
        hysteresis = self.get_parameter('hysteresis').value
        if msg.data > threshold:
            self.alarm = True
        elif msg.data < threshold - hysteresis:
            self.alarm = False
        self.pub.publish(Bool(data=self.alarm))


def main(args=None):
    rclpy.init(args=args)
    rclpy.spin(Monitor())
"""
SETUP = """\
from setuptools import find_packages, setup

package_name = '{package}'

setup(
    name=package_name,
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    entry_points={{
        'console_scripts': [{entries}],
    }},
)
"""
MANIFEST = """\
<?xml version="1.0"?>
<package format="3">
  <name>{package}</name>
  <version>0.0.0</version>
  <description>A talker and a listener</description>
  <maintainer email="student@todo.todo">student</maintainer>
  <license>MIT</license>
  <depend>rclpy</depend>
  <depend>std_msgs</depend>
  <export><build_type>ament_python</build_type></export>
</package>
"""
CFG = """\
[develop]
script_dir=$base/lib/{package}
[install]
install_scripts=$base/lib/{package}
"""


def write_ros_package(
    folder: Path, package: str, nodes: dict[str, str], entries: dict[str, str]
) -> Path:
    """Write a package with node files (text by name) and entry points (module by executable).

    Return the folder that is handed in, below `folder`.
    """
    root = folder / "handed_in" / package
    for part in (package, "resource"):
        (root / part).mkdir(parents=True)
    (root / "resource" / package).touch()
    (root / package / "__init__.py").touch()
    named = ", ".join(f"'{name} = {package}.{module}:main'" for name, module in entries.items())
    (root / "setup.py").write_text(SETUP.format(package=package, entries=named))
    (root / "package.xml").write_text(MANIFEST.format(package=package))
    (root / "setup.cfg").write_text(CFG.format(package=package))
    for name, text in nodes.items():
        (root / package / f"{name}.py").write_text(text)
        (root / package / f"{name}.py").chmod(0o755)
    return root.parent
