"""Diagnoses of what spins, starts and ends a node: each statement is true of the program."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.verdict.checks.source import node_file
from tests.marking import ASSIGNMENT
from tests.mistakes.other_forms import RIGHT, TIMER, changed
from tests.mistakes.test_from_source import line_of, look, node_in
from tests.static_bench import NODE, Bench

SPIN = "        rclpy.spin(node)\n"
INIT = "    rclpy.init(args=args)\n"
MADE = "    node = MyFirstNode()\n"
THREADING = ("import rclpy\n", "import threading\nimport time\nimport rclpy\n")
LOG = "        self.get_logger().info('Hello time: ' + str(self.counter_))\n"
NO_TIMER = (f"        {TIMER}\n", "")


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path / "my_robot_controller")


def texts(found: RecognisedMistake | None) -> tuple[str, str]:
    """Return the reason and the fix."""
    assert found is not None
    kind, words = CATALOGUE[found.kind], {**found.params, **found.words}
    return str(kind.rationale(words, found.variant)), str(kind.fix_text(words, found.variant))


def kind_of(symptom: str, text: str) -> str:
    found = look(symptom, text)
    return "" if found is None else found.kind


IDLE = "        while rclpy.ok():\n            time.sleep(0.1)\n"
COUNTDOWN = "    for i in range(3):\n        print(3 - i)\n        time.sleep(0.2)\n"


def test_a_countdown_before_the_node_does_not_do_the_work_of_a_timer() -> None:
    text = changed(RIGHT, THREADING, (SPIN, IDLE), (MADE, COUNTDOWN + MADE))
    found = look("run.never_spins", text)
    assert found is not None
    assert found.kind == "node.spin_missing"


def test_a_loop_that_does_the_work_is_named_and_not_the_countdown_above_it() -> None:
    loop = "        while rclpy.ok():\n            time.sleep(1.0)\n            node.timer_callback()\n"
    text = changed(RIGHT, THREADING, NO_TIMER, (SPIN, loop), (MADE, COUNTDOWN + MADE))
    found = look("run.never_spins", text)
    assert found is not None
    assert found.kind == "node.sleep_loop"
    assert found.where is not None
    assert found.where.line == line_of(text, "time.sleep(1.0)")


@pytest.mark.parametrize(
    "written",
    [
        "threading.Thread(target=lambda: rclpy.spin(self), daemon=True).start()",
        "rclpy.spin(self)  # the last line",
    ],
)
def test_init_that_comes_to_its_end_is_not_told_to_wait(written: str) -> None:
    text = changed(RIGHT, THREADING, (TIMER, f"{TIMER}\n        {written}"))
    assert kind_of("run.no_lines", text) != "node.spin_in_init"


def test_a_spin_above_other_lines_of_init_is_told() -> None:
    text = changed(RIGHT, (TIMER, f"rclpy.spin(self)\n        {TIMER}"))
    assert kind_of("run.no_lines", text) == "node.spin_in_init"


def test_an_executor_that_a_function_gets_may_get_the_node_there() -> None:
    own = "def add_all(ex, *nodes):\n    for n in nodes:\n        ex.add_node(n)\n\n\ndef main("
    executor = (
        "        executor = rclpy.executors.SingleThreadedExecutor()\n{}        executor.spin()\n"
    )
    text = changed(RIGHT, (SPIN, executor.format("")))
    assert kind_of("run.never_spins", text) == "node.executor_without_node"
    text = changed(
        RIGHT, ("def main(", own), (SPIN, executor.format("        add_all(executor, node)\n"))
    )
    assert kind_of("run.never_spins", text) != "node.executor_without_node"


@pytest.mark.parametrize(
    ("above", "made"),
    [
        (
            "    @classmethod\n    def create(cls):\n        return cls()\n\n",
            "MyFirstNode.create()",
        ),
        ("", "next(make() for make in (MyFirstNode,))"),
    ],
)
def test_a_node_that_is_made_without_its_name_is_made(above: str, made: str) -> None:
    text = changed(
        RIGHT,
        ("    def __init__", f"{above}    def __init__"),
        ("MyFirstNode()\n", f"{made}\n"),
        (SPIN, "        pass\n"),
    )
    assert kind_of("run.exits_at_once", text) == "node.spin_missing"


TRIED = """\
        try:
            self.get_logger().info('Hello time: ' + self.counter_)
            self.counter_ += 1
        except Exception:
            {}
"""


@pytest.mark.parametrize("end", ["sys.exit(1)", "rclpy.shutdown()"])
def test_an_end_in_a_silent_except_is_not_the_cause(end: str) -> None:
    text = changed(RIGHT, (f"{LOG}        self.counter_ += 1\n", TRIED.format(end)))
    assert kind_of("run.ended_early", text) == "node.error_hidden"


def test_an_exit_of_its_own_is_named_before_one_in_an_except() -> None:
    step = "        self.counter_ += 1\n"
    text = changed(
        RIGHT,
        (f"{LOG}{step}", f"{TRIED.format('sys.exit(1)')}        quit()\n"),
    )
    found = look("run.ended_early", text)
    assert found is not None
    assert found.where is not None
    assert (found.kind, found.where.line) == ("node.exits", line_of(text, "quit()"))


def test_a_loop_that_ros_ends_is_not_ended_by_spin_once() -> None:
    loop = "        while rclpy.ok():\n            rclpy.spin_once(node)\n"
    end = (
        "        self.counter_ += 1\n        if self.counter_ == 5:\n            rclpy.shutdown()\n"
    )
    text = changed(RIGHT, (SPIN, loop), ("        self.counter_ += 1\n", end))
    for symptom in ("run.ended_early", "run.exits_at_once"):
        assert kind_of(symptom, text) == "node.exits"


def test_spin_once_in_a_helper_is_not_told_to_be_followed_by_the_end() -> None:
    own = "def step(node):\n    rclpy.spin_once(node)\n\n\ndef main("
    loop = "        for _ in range(5):\n            step(node)\n"
    why, _ = texts(look("run.ended_early", changed(RIGHT, ("def main(", own), (SPIN, loop))))
    assert "main ends" not in why


def test_the_end_of_another_node_is_no_clean_up() -> None:
    check = "    {0} = rclpy.create_node('check')\n    {0}.destroy_node()\n"
    text = changed(RIGHT, (INIT, INIT + check.format("check")))
    assert kind_of("run.no_lines", text) != "node.cleanup_early"
    text = changed(RIGHT, (MADE, f"{MADE}    node.destroy_node()\n"))
    assert kind_of("run.no_lines", text) == "node.cleanup_early"


# rclpy.init()


# imports and files


def test_the_symptoms_of_these_texts_are_known() -> None:
    for symptom in ("run.never_spins", "run.ended_early", "run.exits_at_once", "run.no_lines"):
        assert behind_symptom(symptom, Suspect(node_in(RIGHT), ASSIGNMENT)) is None


@pytest.mark.parametrize(
    ("packages", "said"),
    [
        ("find_packages(exclude=['test'])", "finds nothing to install"),
        ("[package_name]", "without find_packages()"),
    ],
)
def test_a_folder_that_setup_names_is_installed_without_init(
    bench: Bench, packages: str, said: str
) -> None:
    bench.change("setup.py", "find_packages(exclude=['test'])", packages)
    if packages == "[package_name]":
        bench.change("setup.py", "import find_packages, setup", "import setup")
    (bench.root / "my_robot_controller/__init__.py").unlink()
    bench.write(NODE, RIGHT)
    assert said in " ".join(bench.passes(node_file).advice)
