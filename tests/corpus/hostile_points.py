"""Packages that want points without the behaviour: other nodes, forged records, other programs.

What each must lose is in `failed`; everything else about it may be right.
"""

from __future__ import annotations

from grader.package.edit.tree import Edit, Replace, Write

from .hostile_edits import imports, in_setup, made, only_if
from .model import AFTER_START, INNER, NODE, SETUP, TICKS, Package, hostile
from .right_node import LINE, STEP

TIMER = "        self.create_timer(1.0, self.timer_callback)\n"
COUNTER = "        self.counter_ = 0\n"
NO_ROS = "#!/usr/bin/env python3\nimport time\n\n\ndef main(args=None):\n    time.sleep(60)\n"
LEFT_BEHIND = """
import os
import sys
if 'develop' in sys.argv and os.fork() == 0:
    os.setsid()
    if os.fork() == 0:
        for number in range(3):
            os.dup2(os.open('/dev/null', os.O_RDWR), number)
        import rclpy
        from rclpy.node import Node
        rclpy.init(args=['x', '--ros-args', '-p', 'use_sim_time:=true'])
        node = Node('my_first_node')
        node.counter = 0
        def tick():
            node.get_logger().info('Hello time: ' + str(node.counter))
            node.counter += 1
        node.create_timer(1.0, tick)
        rclpy.spin(node)
    os._exit(0)
"""
SENT_AHEAD = """
import sys
if 'develop' in sys.argv:
    import time
    import rclpy
    from rclpy.node import Node
    rclpy.init()
    node = Node('my_first_node')
    for n in range(10):
        node.get_logger().info(f'Hello time: {n}')
    time.sleep(2)
"""
IMPORT_LOG = Replace(
    NODE,
    "import rclpy\nfrom",
    "import sys\nimport time\nimport rclpy\nfrom rcl_interfaces.msg import Log\nfrom",
)
BY_HAND = """\
        stamp = time.time_ns()
        text = 'Hello time: ' + str(self.counter_)
        record = Log(level={level}, name='my_first_node', msg=text)
        record.stamp.sec, record.stamp.nanosec = divmod(stamp, 10**9)
        self.records.publish(record)
        print(f'[INFO] [{{stamp // 10**9}}.{{stamp % 10**9:09d}}] [my_first_node]: {{text}}',
              file=sys.stderr, flush=True)
"""
LEVEL = "Log.INFO"
PUBLISHER = COUNTER + "        self.records = self.create_publisher(Log, '/rosout', 10)\n"
KEPT = "QoSProfile(depth=10, durability=1))"  # 1: transient local, as the logger's own
BURST = """\
    records = node.create_publisher(Log, '/rosout', 20)
    time.sleep(1)
    begin = time.time_ns()
    for n in range(12):
        stamp = begin + n * 10**9
        record = Log(level=Log.INFO, name='my_first_node', msg=f'Hello time: {n}')
        record.stamp.sec, record.stamp.nanosec = divmod(stamp, 10**9)
        records.publish(record)
        print(f'[INFO] [{stamp // 10**9}.{stamp % 10**9:09d}] [my_first_node]: Hello time: {n}',
              file=sys.stderr, flush=True)
"""
SUBSCRIBER = """\
        self.create_subscription(Clock, '/clock', self.on_clock, 10)

    def on_clock(self, message):
        while self.counter_ < message.clock.sec:
            self.timer_callback()

"""
REWRITES_SCRIPT = """
import os
path = os.path.join('..', '..', 'install', package_name, 'lib', package_name, 'test_node')
if os.path.exists(path):
    text = open(path).read().replace("import sys", "import sys, json", 1)
    open(path, 'w').write(text)
"""
REWRITES_SOURCE = """
import os
path = os.path.join(os.path.dirname(os.path.realpath(__file__)), package_name, 'my_first_node.py')
text = open(path).read().replace('Hallo', 'Hello')
open(path, 'w').write(text)
"""
REWRITES_METADATA = """
import glob
for path in glob.glob('*.egg-info/entry_points.txt') + glob.glob('*/*.egg-info/entry_points.txt'):
    text = open(path).read().replace('my_first_node:main', 'other:main')
    open(path, 'w').write(text)
"""
TO_OTHER = "{'console_scripts': ['test_node = my_robot_controller.other:main']}"
SUBCLASS = f"""
from setuptools import Distribution


class Other(Distribution):
    def finalize_options(self):
        self.entry_points = {TO_OTHER}
        super().finalize_options()

"""
PATCHED = f"""
from setuptools import Distribution

finish = Distribution.finalize_options


def other(self):
    self.entry_points = {TO_OTHER}
    finish(self)


Distribution.finalize_options = other
"""
OTHER = Write(f"{INNER}/other.py", "from .my_first_node import main\n")
DEAF_FOR_A_WHILE = """\
    def dots():
        for _ in range(1500):
            print('.', end='', flush=True)
            time.sleep(0.01)
        os._exit(0)

    def deaf(*_):
        threading.Thread(target=dots).start()

    signal.signal(signal.SIGINT, deaf)
"""


def _after_setup(code: str) -> Edit:
    return Replace(SETUP, "    },\n)\n", "    },\n)\n" + code)


ONLY_HERE = {"run.output": "run.only_when_marked"}
NOT_JUDGED = frozenset({"run.spins", "run.logger", "run.period"})
FLOODED = TICKS | {"run.spins", "run.interrupt"}
OTHER_INSTALLED = {"entry_point.mapping": "entry_point.other_installed"}
NEVER_RUN = AFTER_START | {"entry_point.executable", "run.starts"}
STOPS = {"run.output": None}
ENDS = {"run.output": None}

POINTS_ATTACKS: tuple[Package, ...] = (
    hostile("node_left_by_setup", in_setup(LEFT_BEHIND), Write(NODE, NO_ROS),
            failed={"run.starts": "node.no_ros"}, skipped=AFTER_START,
            note="a right node, started by setup.py; the program itself only sleeps"),
    hostile("records_sent_ahead", in_setup(SENT_AHEAD), Write(NODE, NO_ROS),
            failed={"run.starts": "node.no_ros"}, skipped=AFTER_START,
            note="records published while the package was built"),
    hostile("records_by_hand", IMPORT_LOG, Replace(NODE, COUNTER, PUBLISHER),
            Replace(NODE, f"        {LINE}\n", BY_HAND.format(level=LEVEL)),
            failed={"run.logger": "run.faked_log"},
            note="a publisher on /rosout beside that of the logger"),
    hostile("records_of_the_future", IMPORT_LOG,
            Replace(NODE, "super().__init__('my_first_node')",
                    "super().__init__('my_first_node', enable_rosout=False)"),
            Replace(NODE, COUNTER, PUBLISHER.replace("10)", KEPT)),
            Replace(NODE, "from rclpy.node import Node\n",
                    "from rclpy.node import Node\nfrom rclpy.qos import QoSProfile\n"),
            Replace(NODE, f"        {LINE}\n",
                    BY_HAND.format(level=LEVEL).replace("time_ns()", "time_ns() + 60 * 10**9")),
            failed={"run.logger": "run.faked_log"},
            note="a publisher on /rosout instead of that of the logger, a minute ahead"),
    hostile("records_of_before", IMPORT_LOG,
            Replace(NODE, "super().__init__('my_first_node')",
                    "super().__init__('my_first_node', enable_rosout=False)"),
            Replace(NODE, COUNTER, PUBLISHER.replace("10)", KEPT)),
            Replace(NODE, "from rclpy.node import Node\n",
                    "from rclpy.node import Node\nfrom rclpy.qos import QoSProfile\n"),
            Replace(NODE, f"        {LINE}\n",
                    BY_HAND.format(level=LEVEL).replace("time_ns()", "time_ns() - 120 * 10**9")),
            failed={"run.logger": "run.faked_log"},
            note="a publisher on /rosout instead of that of the logger, two minutes behind"),
    hostile("records_in_a_burst", IMPORT_LOG, made(BURST),
            Replace(NODE, f"        {LINE}\n", ""),
            failed={"run.output": None}, undecided=TICKS | {"run.spins", "run.interrupt"},
            note="twelve records in a millisecond, their stamps a second apart"),
    hostile("stops_after_ten", only_if("self.counter_ < 10"), failed=STOPS,
            undecided=TICKS | {"run.interrupt"}),
    hostile("goes_on_with_other_lines",
            Replace(NODE, f"        {LINE}\n",
                    f"        if self.counter_ < 4:\n            {LINE}\n        else:\n"
                    "            self.get_logger().info('and so on')\n"),
            failed={"run.output": "run.stops"}, undecided=TICKS | {"run.spins"},
            note="a line at each due instant, but not of the count"),
    hostile("goes_on_in_hexadecimal",
            Replace(NODE, LINE, "self.get_logger().info(f'Hello time: {self.counter_:x}')"),
            failed={"run.output": "run.wrong_text"}, undecided=TICKS | {"run.spins"},
            note="the first ten lines are right"),
    hostile("ends_after_ten", imports("os"),
            Replace(NODE, f"        {STEP.strip()}\n",
                    f"        {STEP.strip()}\n        if self.counter_ == 10:\n"
                    "            os._exit(0)\n"),
            failed=ENDS, undecided=TICKS, skipped=frozenset({"run.interrupt"})),
    hostile("gone_after_two_seconds", imports("os", "threading"),
            made("    threading.Timer(2.0, os._exit, [0]).start()\n"),
            failed=ENDS, undecided=TICKS, skipped=frozenset({"run.interrupt"}),
            note="ten seconds of ROS time take less than two of wall time"),
    hostile("only_with_arguments", imports("sys"), only_if("len(sys.argv) > 1"),
            failed=ONLY_HERE, skipped=NOT_JUDGED),
    hostile("only_with_its_command_line",
            only_if("'sim_time' in open('/proc/self/cmdline').read()"),
            failed=ONLY_HERE, skipped=NOT_JUDGED),
    hostile("only_if_use_sim_time_is_set",
            only_if("self.get_parameter('use_sim_time').value"),
            failed=ONLY_HERE, skipped=NOT_JUDGED),
    hostile("clock_instead_of_a_timer",
            Replace(NODE, "from rclpy.node import Node\n",
                    "from rclpy.node import Node\nfrom rosgraph_msgs.msg import Clock\n"),
            Replace(NODE, TIMER, SUBSCRIBER), failed=ONLY_HERE, skipped=NOT_JUDGED,
            note="counts the seconds of /clock, which nobody publishes at home"),
    hostile("other_script_installed", _after_setup(REWRITES_SCRIPT),
            failed=OTHER_INSTALLED, skipped=NEVER_RUN),
    hostile("source_changed_by_setup", in_setup(REWRITES_SOURCE),
            Replace(NODE, "'Hello time: '", "'Hallo time: '"),
            failed=OTHER_INSTALLED, skipped=NEVER_RUN),
    hostile("other_metadata_installed", _after_setup(REWRITES_METADATA),
            OTHER,
            failed=OTHER_INSTALLED, skipped=NEVER_RUN),
    hostile("other_distribution", in_setup(SUBCLASS),
            Replace(SETUP, "    name=", "    distclass=Other,\n    name="), OTHER,
            failed=OTHER_INSTALLED, skipped=NEVER_RUN,
            note="the class that setup() fills has another entry point"),
    hostile("setuptools_patched", in_setup(PATCHED), OTHER,
            failed=OTHER_INSTALLED, skipped=NEVER_RUN),
    hostile("sleeps_twice", imports("time"),
            Replace(NODE, f"        {LINE}\n",
                    f"        nap = 0.9\n        time.sleep(nap)\n        {LINE}\n"
                    "        time.sleep(nap)\n"),
            failed={"run.period": None},
            note="each shorter than a period, both longer: a line every 1.8 s on a terminal"),
    hostile("erases_its_lines",
            Replace(NODE, f"        {STEP}\n",
                    f"        {STEP}\n        print('\\x1b[1A\\x1b[2K', end='', flush=True)\n"),
            failed={"run.output": None}, skipped=TICKS),
    hostile("records_of_ten_megabytes", imports("threading"),
            made("    def flood():\n        while True:\n"
                  "            node.get_logger().info('x' * 10_000_000)\n\n"
                  "    threading.Thread(target=flood, daemon=True).start()\n"),
            failed={"run.output": "run.too_much_output"}, skipped=FLOODED,
            note="fills the probe's memory, if nothing bounds it"),
    hostile("records_at_full_speed", imports("threading"),
            Replace(NODE, "import rclpy\nfrom", "import rclpy\nfrom rcl_interfaces.msg import Log\nfrom"),
            made("    records = node.create_publisher(Log, '/rosout', 1000)\n\n"
                  "    def flood():\n        while True:\n"
                  "            records.publish(Log(name='my_first_node', msg='x' * 1000))\n\n"
                  "    threading.Thread(target=flood, daemon=True).start()\n"),
            failed={"run.logger": "run.faked_log"}),
    hostile("deaf_for_fifteen_seconds", imports("os", "signal", "threading", "time"),
            made(DEAF_FOR_A_WHILE), failed={"run.interrupt": None},
            note="dots after Ctrl+C, then it ends by itself"),
)  # fmt: skip
