"""A package that reads real time is not judged by a clock that runs faster."""

from __future__ import annotations

import time
from itertools import pairwise

import pytest

from grader.package.intake.model import SourceFile
from grader.package.source.ends_after import counts_to, ends_after
from grader.package.source.real_time import reads_real_time
from grader.report.blocks import quotation
from grader.report.page import Page
from grader.run.clock import REAL, VirtualClock
from grader.run.observer import Observer, Watch
from grader.run.terminal import Terminal
from tests.test_clock import OUTPUT, Node, SlowConsole

NODE = "my_robot_controller/my_first_node.py"
SHORT = OUTPUT.model_copy(update={"period": 0.1, "ticks": 6})


@pytest.mark.parametrize(
    ("text", "reads"),
    [
        ("self.get_logger().info(text, throttle_duration_sec=0.5)", True),
        ("self.get_logger().info(text, once=True)", False),
        ("late = time.monotonic() - self.last > 1", True),
        ("now = time()", True),
        ("print(datetime.datetime.now())", True),
        ("now = self.get_clock().now()", False),
        ("clock = Clock(clock_type=ClockType.STEADY_TIME)", True),
        ("time.sleep(1.0)", False),
        ("# throttle_duration_sec=0.5, time.time()", False),
        ("print(", False),
    ],
)
def test_what_reads_real_time(text: str, reads: bool) -> None:
    assert reads_real_time([SourceFile(NODE, "file", data=text.encode())]) == reads


def test_setup_py_does_not_count_and_each_module_does() -> None:
    text = b"import time\nbegun = time.time()\n"
    assert not reads_real_time([SourceFile("setup.py", "file", data=text)])
    assert reads_real_time(
        [
            SourceFile(NODE, "file", data=b"import helper\n"),
            SourceFile("my_robot_controller/helper.py", "file", data=text),
        ]
    )


@pytest.mark.parametrize("real_time", [True, False])
def test_a_clock_in_real_time_keeps_the_lines_apart(real_time: bool) -> None:
    console = SlowConsole()
    node = Node(console, period=SHORT.period)
    observer = Observer(Terminal(console, most=1_000_000), node, SHORT)
    watch, begin = Watch(), time.monotonic()
    clock = VirtualClock(observer, SHORT, deadline=begin + 30, real_time=real_time)
    clock.drive(watch, lambda event: None)
    assert (watch.early, watch.missing) == ([], [])
    assert [event.due for event in watch.counted] == list(range(SHORT.ticks))
    walls = [event.wall for event in watch.counted]
    assert (walls[-1] - walls[0] > 0.9 * REAL * SHORT.period * (SHORT.ticks - 1)) == real_time
    if real_time:
        assert min(b - a for a, b in pairwise(walls)) > SHORT.period / 2  # (of a busy machine)


def test_a_clock_in_real_time_sees_lines_between_the_instants() -> None:
    console = SlowConsole()
    node = Node(console, period=SHORT.period / 2)
    observer = Observer(Terminal(console, most=1_000_000), node, SHORT)
    watch = Watch()
    clock = VirtualClock(observer, SHORT, deadline=time.monotonic() + 30, real_time=True)
    clock.drive(watch, lambda event: None)
    assert watch.period == pytest.approx(SHORT.period / 2)


@pytest.mark.parametrize(("gap", "faster"), [(0.01, True), (1.0, False)])
def test_only_lines_that_are_closer_than_a_real_clock_makes_them_are_explained(
    gap: float, faster: bool
) -> None:
    lines = [f"[INFO] [{1000 + n * gap:.9f}] [my_first_node]: Hello time: {n}" for n in range(4)]
    page = Page(width=200, styled=False)
    quotation(page, "\n".join(lines), "ros2 run printed", lines=10, whole=True, faster=True)
    assert ("grader's clock runs faster" in str(page)) == faster


@pytest.mark.parametrize(
    ("text", "seconds"),
    [
        ("rclpy.spin_until_future_complete(node, done, timeout_sec=10)", 10.0),
        ("rclpy.spin_until_future_complete(node, done, None, 2 * 4)", 8.0),
        ("executor.spin_until_future_complete(done, 8)", 8.0),
        ("END = 12.5\nrclpy.spin_until_future_complete(node, done, timeout_sec=END)", 12.5),
        ("END = 1\nEND = 9\nrclpy.spin_until_future_complete(node, done, timeout_sec=END)", 0.0),
        ("rclpy.spin_until_future_complete(node, done)", 0.0),
        ("while time.time() - start < 15:\n    rclpy.spin_once(node)", 15.0),
        ("end = time.time() + 7\nwhile time.time() < end:\n    rclpy.spin_once(node)", 7.0),
        ("end = now() + delta(seconds=7)\nwhile now() < end:\n    rclpy.spin_once(node)", 7.0),
        ("threading.Timer(6.0, rclpy.shutdown).start()\nrclpy.spin(node)", 6.0),
        ("signal.alarm(5)\nrclpy.spin(node)", 5.0),
        ("while self.count < 15:\n    rclpy.spin_once(node)", 0.0),
        ("rclpy.spin(node)", 0.0),
    ],
)
def test_the_time_after_which_a_node_ends_is_read(text: str, seconds: float) -> None:
    assert ends_after([SourceFile(NODE, "file", data=text.encode())]) == seconds


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("self.n += 1\nif self.n == 30:\n    rclpy.shutdown()", 30),
        ("n = n + 1\nwhile n < 2 * 20:\n    rclpy.spin_once(node)", 40),
        ("LAST = 25\nself.n += 1\nif node.n >= LAST:\n    quit()", 25),
        ("self.n = (self.n + 1) % 60", 60),
        ("self.n = (self.n + 1) & 0x1F", 31),
        ("self.n += 1\nif self.n == 3600:\n    rclpy.shutdown()", 0),
        ("self.n += 1\nif self.other == 30:\n    rclpy.shutdown()", 0),
    ],
)
def test_the_number_at_which_a_count_ends_is_read(text: str, number: int) -> None:
    assert counts_to([SourceFile(NODE, "file", data=text.encode())]) == number
