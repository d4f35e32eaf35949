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
from tests.mistakes.test_from_source import line_of, look, node_in, raised
from tests.static_bench import NODE, Bench

SPIN = "        rclpy.spin(node)\n"
INIT = "    rclpy.init(args=args)\n"
MADE = "    node = MyFirstNode()\n"
THREADING = ("import rclpy\n", "import threading\nimport time\nimport rclpy\n")
LOG = "        self.get_logger().info('Hello time: ' + str(self.counter_))\n"
NO_TIMER = (f"        {TIMER}\n", "")
NOT_INITIALIZED = "rclpy.exceptions.NotInitializedException: rclpy.init() has not been called"


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
    assert (found.kind, found.variant) == ("node.spin_missing", "loop")


def test_a_loop_that_does_the_work_is_named_and_not_the_countdown_above_it() -> None:
    loop = "        while rclpy.ok():\n            time.sleep(1.0)\n            node.timer_callback()\n"
    text = changed(RIGHT, THREADING, NO_TIMER, (SPIN, loop), (MADE, COUNTDOWN + MADE))
    found = look("run.never_spins", text)
    assert found is not None
    assert found.kind == "node.sleep_loop"
    assert found.where is not None
    assert found.where.line == line_of(text, "time.sleep(1.0)")


RUN = """\
    def run(self):
        while rclpy.ok():
            self.timer_callback()
            time.sleep(1.0)

    def timer_callback"""
START = "        thread = threading.Thread(target=node.run)\n        thread.start()\n"


@pytest.mark.parametrize(
    ("before", "beside"),
    [
        ("        node.run()\n", False),
        (f"{START}        thread.join()\n", False),
        (START, True),
    ],
)
def test_only_a_loop_in_a_thread_is_beside_spin(before: str, beside: bool) -> None:
    text = changed(
        RIGHT, THREADING, NO_TIMER, ("    def timer_callback", RUN), (SPIN, before + SPIN)
    )
    suspect = Suspect(node_in(text), ASSIGNMENT)
    kind = CATALOGUE["node.sleep_loop"]
    why, fix = texts(kind.behind["run.never_spins"](suspect))
    assert ("beside rclpy.spin" in why) is beside
    assert "main spins the node already" in fix


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


@pytest.mark.parametrize(("spin", "again"), [("spin", False), ("spin_once", True)])
def test_a_loop_around_spin_has_no_second_round(spin: str, again: bool) -> None:
    loop = f"        while rclpy.ok():\n            node = MyFirstNode()\n            rclpy.{spin}(node)\n"
    text = changed(RIGHT, (MADE, ""), (SPIN, loop))
    assert (kind_of("run.no_lines", text) == "node.made_each_round") is again


def test_a_node_that_is_an_attribute_may_be_spun_outside_of_the_class() -> None:
    helper = "self.helper = rclpy.create_node('helper')\n        self.helper."
    executor = (
        "        executor = rclpy.executors.SingleThreadedExecutor()\n        executor.add_node(node)\n"
        "        executor.add_node(node.helper)\n        executor.spin()\n"
    )
    other = changed(RIGHT, ("self.create_timer", helper + "create_timer"))
    assert kind_of("run.no_lines", other) == "node.timer_of_other_node"
    assert kind_of("run.no_lines", changed(other, (SPIN, executor))) != "node.timer_of_other_node"


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


def test_a_class_that_only_super_names_is_not_made() -> None:
    text = changed(
        RIGHT,
        ("super()", "super(MyFirstNode, self)"),
        ("node = MyFirstNode()", "node = None"),
        (SPIN, "        pass\n"),
    )
    assert kind_of("run.exits_at_once", text) == "node.main_empty"


def test_a_coroutine_that_nothing_awaits_spins_in_no_thread() -> None:
    own = "async def run(node):\n    await asyncio.to_thread(rclpy.spin, node)\n\n\ndef main("
    text = changed(RIGHT, ("def main(", own), (SPIN, "        run(node)\n"))
    assert kind_of("run.exits_at_once", text) != "node.spin_elsewhere"


def test_what_waits_before_the_end_does_not_end_at_once() -> None:
    own = "def run_node(node):\n    rclpy.spin(node)\n\n\ndef main("
    start = "        threading.Thread(target=run_node, args=(node,), daemon=True).start()\n"
    text = changed(RIGHT, THREADING, ("def main(", own), (SPIN, f"{start}        time.sleep(5)\n"))
    why, _ = texts(look("run.ended_early", text))
    assert "at once" not in why
    text = changed(RIGHT, THREADING, (SPIN, start.replace("run_node", "rclpy.spin").replace(
        ", daemon=True", "")))  # fmt: skip
    why, _ = texts(look("run.ended_early", text))
    assert "at once" not in why


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


def test_an_end_in_an_except_that_shows_the_error_is_not_to_be_deleted() -> None:
    tried = TRIED.format("print(e)\n            sys.exit(1)").replace("Exception", "Exception as e")
    text = changed(RIGHT, (f"{LOG}        self.counter_ += 1\n", tried))
    found = look("run.ended_early", text)
    assert found is not None
    assert found.kind == "node.exits"
    assert texts(found)[1].startswith("Write raise instead of this line")


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
        assert kind_of(symptom, text) == "node.ends_in_callback"


def test_spin_once_in_a_helper_is_not_told_to_be_followed_by_the_end() -> None:
    own = "def step(node):\n    rclpy.spin_once(node)\n\n\ndef main("
    loop = "        for _ in range(5):\n            step(node)\n"
    why, _ = texts(look("run.ended_early", changed(RIGHT, ("def main(", own), (SPIN, loop))))
    assert "main ends" not in why


def test_two_nodes_that_are_spun_at_once_get_one_executor() -> None:
    thread = (
        "        thread = threading.Thread(target=rclpy.spin, args=(watcher,))\n"
        "        thread.start()\n"
    )
    text = changed(
        RIGHT, THREADING, (MADE, f"{MADE}    watcher = Watcher()\n"), (SPIN, thread + SPIN)
    )
    error = "ValueError: generator already executing"
    found = raised(error, text, line_of(text, "rclpy.spin(node)"), "rclpy")
    assert found is not None
    assert found.kind == "node.two_spun_at_once"
    why, fix = texts(found)
    assert "spins watcher" in why
    assert "executor.add_node(watcher), executor.add_node(node)" in fix
    same = text.replace("(watcher,)", "(node,)")
    found = raised(error, same, line_of(same, "rclpy.spin(node)"), "rclpy")
    assert found is not None
    assert found.kind == "node.spun_twice"


def test_a_timer_in_init_does_not_need_a_method_that_nothing_calls() -> None:
    unused = "    def restart(self):\n        {}\n\n    def __init__"
    text = changed(
        RIGHT,
        ("    def __init__", unused.format(TIMER)),
    )
    assert kind_of("run.no_lines", text) != "node.method_not_called"
    text = changed(RIGHT, NO_TIMER, ("    def __init__", unused.format(TIMER)))
    assert kind_of("run.no_lines", text) == "node.method_not_called"


def test_the_end_of_another_node_is_no_clean_up() -> None:
    check = "    {0} = rclpy.create_node('check')\n    {0}.destroy_node()\n"
    text = changed(RIGHT, (INIT, INIT + check.format("check")))
    assert kind_of("run.no_lines", text) != "node.cleanup_early"
    text = changed(RIGHT, (MADE, f"{MADE}    node.destroy_node()\n"))
    assert kind_of("run.no_lines", text) == "node.cleanup_early"


# rclpy.init()


def test_an_init_in_a_method_runs_for_each_object() -> None:
    twice = "RuntimeError: Context.init() must only be called once"
    text = changed(
        RIGHT, (INIT, "    watcher = Watcher()\n"), ("        super()", "        rclpy.init()\n        super()")
    )  # fmt: skip
    why, fix = texts(raised(twice, text, line_of(text, "rclpy.init()")))
    assert "__init__" in why
    assert "in a loop" not in fix
    assert "rclpy.init(args=args) as the first line of main" in fix


def test_an_init_under_another_name_is_called() -> None:
    text = changed(
        RIGHT,
        ("import rclpy\n", "import rclpy\nfrom rclpy import init as start_ros\n"),
        (INIT + MADE, f"{MADE}    start_ros(args=args)\n"),
    )
    found = raised(NOT_INITIALIZED, text, line_of(text, "super()"))
    assert found is not None
    assert found.kind == "node.init_late"
    assert texts(found)[1] == "Move start_ros(args=args) to the first line of main."


def test_an_init_that_is_alone_in_its_block_leaves_a_pass() -> None:
    text = changed(RIGHT, (INIT, f"    if args is not None:\n    {INIT}"))
    _, fix = texts(raised(NOT_INITIALIZED, text, line_of(text, "super()")))
    assert "write pass instead of this line" in fix


@pytest.mark.parametrize(
    ("block", "line", "wanted"),
    [
        ("START = 0", "self.counter_ = START", "to the top of the file"),
        ("node = MyFirstNode()", "node.destroy_node()", "to the beginning of main."),
        ("start = 0\n    START = start", "self.counter_ = START", "Give START as an argument"),
    ],
)
def test_what_needs_ros_is_not_moved_above_the_class(block: str, line: str, wanted: str) -> None:
    guard = "if __name__ == '__main__':\n"
    text = changed(
        RIGHT,
        (MADE, ""),
        ("self.counter_ = 0", "self.counter_ = START"),
        (f"{guard}    main()", f"{guard}    {block}\n    main()"),
    )
    name = block.rpartition("\n")[2].split()[0]
    error = f"NameError: name '{name}' is not defined"
    found = raised(error, text, line_of(text, line))
    assert found is not None
    assert found.kind == "node.set_under_guard"
    assert wanted in texts(found)[1]


# imports and files


def test_a_module_that_is_imported_too_is_not_told_to_be_missing() -> None:
    text = changed(
        RIGHT,
        ("import rclpy\n", "import time\nfrom time import time\nimport rclpy\n"),
        (TIMER, f"time.sleep(0.1)\n        {TIMER}"),
    )
    error = "AttributeError: 'builtin_function_or_method' object has no attribute 'sleep'"
    why, fix = texts(raised(error, text, line_of(text, "time.sleep")))
    assert "does not import" not in why
    assert "out of the import in line" in fix


def test_a_file_beside_the_node_is_not_told_to_be_missing() -> None:
    read = "config = configparser.ConfigParser()\n        config.read({} 'settings.ini')\n"
    error = "KeyError: 'timer'"
    for path, missing in (("pathlib.Path(__file__).parent /", False), ("'/home/me/' +", True)):
        text = changed(
            RIGHT, (TIMER, f"{read.format(path)}        config['timer']\n        {TIMER}")
        )
        found = raised(error, text, line_of(text, "config['timer']"), "Python")
        kind = "" if found is None else found.kind
        assert (kind == "node.config_not_read") is missing


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
