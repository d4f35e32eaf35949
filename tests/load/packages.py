"""The packages whose verdicts must not depend on the load: right and broken, of many assignments."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

from grader.course.assignment import Assignment
from grader.course.load import load_assignment
from grader.mistakes.catalogue import CATALOGUE
from grader.package.edit.tree import Write, write_tree
from grader.ros.distro import find_distro
from grader.validate.mutant import Mutant
from grader.validate.named import MUTANTS, read_mutants
from grader.validate.validation import solution_of
from grader.verdict.checks.all import CHECKS
from tests.corpus.build import write
from tests.corpus.model import NODE, Package
from tests.corpus.right import RIGHT
from tests.load.talking import ALARM, LISTENER, MONITOR, TALKER, TALKING, write_ros_package
from tests.processes import ROOT

LESSONS = {"draw_circle": 7, "start_stop": 6, "own_message": 6, "stay_inside": 6}
"""How many packages of each lesson are marked: its solution, and mutants from all over the file."""
OF_CORPUS = (
    "solution",
    "tutorial",
    "no_services",
    "no_global_arguments",
    "rate_in_main",
    "two_nodes",
)
BOTH = {"talker": "talker", "listener": "listener"}
FIRST_CALLBACK_RAISES = """\
import rclpy
from rclpy.node import Node


class MyFirstNode(Node):
    def __init__(self):
        super().__init__('my_first_node')
        self.counter_ = 0
        self.create_timer(1.0, self.timer_callback)

    def timer_callback(self):
        self.get_logger().info('Hello time: ' + self.counter_)
        self.counter_ += 1


def main(args=None):
    rclpy.init(args=args)
    node = MyFirstNode()
    rclpy.spin(node)
    rclpy.shutdown()


if __name__ == '__main__':
    main()
"""
SLEEPS = (
    FIRST_CALLBACK_RAISES.replace("        self.create_timer(1.0, self.timer_callback)\n", "")
    .replace("+ self.counter_)", "+ str(self.counter_))")
    .replace(
        "    rclpy.spin(node)\n",
        "    while rclpy.ok():\n        time.sleep({period})\n        node.timer_callback()\n",
    )
    .replace("import rclpy\n", "import time\n\nimport rclpy\n", 1)
)


@dataclass(frozen=True)
class Case:
    """A package and its assignment; `write` puts the package below a folder and returns its path."""

    name: str
    assignment: Callable[[Path], Assignment]
    write: Callable[[Path], Path]


def cases() -> Iterator[Case]:
    """Yield the packages: 40."""
    yield from _hello_time()
    for lesson, count in LESSONS.items():
        yield from _of_lesson(lesson, count)
    yield from _of_authors()


def _hello_time() -> Iterator[Case]:
    known = {package.name: package for package in RIGHT}
    made = [known[name] for name in OF_CORPUS]
    for name, text in (
        ("first_callback_raises", FIRST_CALLBACK_RAISES),
        ("sleeps", SLEEPS.format(period="1.0")),
        ("sleeps_too_long", SLEEPS.format(period="1.3")),
    ):
        node = "#!/usr/bin/env python3\n" + text
        made.append(Package(name=name, edits=(Write(NODE, node.encode()),)))
    for package in made:
        lesson = partial(_lesson, "hello_time")
        yield Case(f"hello_time-{package.name}", lesson, partial(write, package))


def _lesson(lesson: str, _: Path | None = None) -> Assignment:
    file = ROOT / "lab" / "course" / lesson / "assignment.yaml"
    return load_assignment(file, known_checks=CHECKS)


@cache
def _mutants(lesson: str) -> tuple[Mutant, ...]:
    assignment = _lesson(lesson)
    return read_mutants(
        ROOT / "grader" / "keys" / lesson / MUTANTS,
        checks=[use.id for use in assignment.checks],
        kinds=CATALOGUE,
        distro=find_distro("jazzy"),
        beside=bool(assignment.others),
    ).mutants


def _of_lesson(lesson: str, count: int) -> Iterator[Case]:
    assignment = partial(_lesson, lesson)
    yield Case(f"{lesson}-solution", assignment, partial(_write_mutant, lesson, None))
    mutants = _mutants(lesson)
    for k in range(count - 1):
        mutant = mutants[k * len(mutants) // (count - 1)]
        name = f"{lesson}-{mutant.name.replace(' ', '_')}"
        yield Case(name, assignment, partial(_write_mutant, lesson, mutant))


def _write_mutant(lesson: str, mutant: Mutant | None, folder: Path) -> Path:
    assignment = _lesson(lesson)
    solution = solution_of(ROOT / "grader" / "keys" / lesson, assignment)
    tree = mutant.of(solution) if mutant is not None else solution
    root = folder / "handed_in"
    write_tree(tree, root / assignment.package if assignment.others else root)
    return root


def _of_authors() -> Iterator[Case]:
    talking, alarm = partial(_written, TALKING), partial(_written, ALARM)
    right = {"talker": TALKER, "listener": LISTENER}
    silent = {**right, "listener": LISTENER.replace("    rclpy.spin(node)\n", "")}
    for name, nodes, entries in (
        ("right", right, BOTH),
        ("listener_not_in_setup", right, {"talker": "talker"}),
        ("listener_does_not_spin", silent, BOTH),
        ("listener_is_the_talker", right, {"talker": "talker", "listener": "talker"}),
    ):
        made = partial(write_ros_package, package="my_talking", nodes=nodes, entries=entries)
        yield Case(f"talking-{name}", talking, made)
    wrong = MONITOR.replace("threshold - hysteresis", "threshold + hysteresis")
    for name, text in (("right", MONITOR), ("sign", wrong)):
        made = partial(
            write_ros_package,
            package="my_monitor",
            nodes={"monitor": text},
            entries={"monitor": "monitor"},
        )
        yield Case(f"alarm-{name}", alarm, made)


def _written(text: str, folder: Path) -> Assignment:
    file = folder / "lesson" / "assignment.yaml"
    file.parent.mkdir(exist_ok=True)
    file.write_text(text, encoding="utf-8")
    return load_assignment(file, known_checks=CHECKS)
