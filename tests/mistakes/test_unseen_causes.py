"""Causes that sets of unseen packages had, and that the grader did not know or told wrongly."""

from __future__ import annotations

import pytest

from grader.mistakes.recognise import behind_error, behind_symptom
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.source.node import NodeSource, read_node
from grader.report.model import Where
from grader.verdict.checks.timing import told_of_period
from tests.marking import ASSIGNMENT
from tests.mistakes.other_forms import RIGHT, TIMER, changed
from tests.mistakes.test_spun_and_ended import texts

FOLDER = "my_robot_controller"
NODE = f"{FOLDER}/my_first_node.py"
STEP = "        self.counter_ += 1\n"
START = "        self.counter_ = 0\n"


def source_of(**files: str) -> NodeSource:
    """Return the node of the files in the inner folder, by their names without the ending."""
    encoded = {f"{FOLDER}/{name}.py": text.encode() for name, text in files.items()}
    source = read_node(encoded.get, NODE, "main")
    assert source is not None
    return source


def look(symptom: str, text: str, **others: str) -> RecognisedMistake | None:
    return behind_symptom(symptom, Suspect(source_of(my_first_node=text, **others), ASSIGNMENT))


def at_error(error: str, text: str, code: str, **others: str) -> RecognisedMistake | None:
    """Return the mistake of an error that rclpy raised in the line with this code."""
    row = next(n for n, line in enumerate(text.split("\n"), 1) if code in line)
    source = source_of(my_first_node=text, **others)
    return behind_error(
        Raised(error, Where(file=NODE, line=row), source, ASSIGNMENT, inside="rclpy")
    )


def named(found: RecognisedMistake | None) -> str:
    return "" if found is None else f"{found.kind}/{found.variant}"


def test_a_base_in_another_file_ends_the_chain_of_init() -> None:
    text = changed(
        RIGHT,
        ("(Node):", "(TickSource, Node):"),
        ("import rclpy\n", "import rclpy\nfrom .ticks import TickSource\n"),
    )
    ticks = "class TickSource:\n    def __init__(self, tag):\n        self.tag = tag\n"
    error = "AttributeError: 'MyFirstNode' object has no attribute '_default_callback_group'"
    found = at_error(error, text, "create_timer", ticks=ticks)
    assert named(found) == "node.base_stops/"
    assert found is not None
    assert found.where == Where(file=f"{FOLDER}/ticks.py", line=2)
    goes_on = ticks + "        super().__init__(tag)\n"
    assert named(at_error(error, text, "create_timer", ticks=goes_on)) != "node.base_stops/"


@pytest.mark.parametrize("decorator", ["", "    @property\n"])
def test_timers_as_an_own_property_replaces_that_of_the_node(decorator: str) -> None:
    method = f"{decorator}    def timers(self):\n        return {{}}\n\n    def timer_callback"
    text = changed(RIGHT, ("    def timer_callback", method))
    error = "AttributeError: 'str' object has no attribute '_executor_event'"
    assert named(at_error(error, text, "rclpy.spin(node)")) == "node.name_taken/method_only"


def test_use_sim_time_is_taken_out_of_the_names_that_a_loop_declares() -> None:
    loop = "        for name in ('speed', 'use_sim_time'):\n            self.declare_parameter(name, 1)\n"
    text = changed(RIGHT, (START, START + loop))
    error = "rclpy.exceptions.ParameterAlreadyDeclaredException: Parameter(s) already declared: ['use_sim_time']"
    found = at_error(error, text, "self.declare_parameter(name")
    assert named(found) == "node.declared_twice/each_listed"
    row = next(n for n, line in enumerate(text.split("\n"), 1) if "'use_sim_time'" in line)
    assert texts(found)[1].endswith(f"delete it in line {row}.")
    other = error.replace("use_sim_time", "speed")
    assert (
        named(at_error(other, text, "self.declare_parameter(name"))
        != "node.declared_twice/each_listed"
    )


BASE = (
    "class Ticking(Node):\n    period_ = 0.5\n\n    def __init__(self, name):\n"
    "        super().__init__(name)\n        self.counter_ = 0\n"
    "        self.create_timer(self.period_, self.timer_callback)\n\n\nclass MyFirstNode(Ticking):"
)


@pytest.mark.parametrize(("row", "variant"), [(0, "named"), (1, "late")])
def test_a_period_that_is_set_after_the_timer_of_the_base(row: int, variant: str) -> None:
    late = "        self.period_ = 1.0\n"
    text = changed(RIGHT, (START, ""), (f"        {TIMER}\n", late))
    text = changed(text, ("class MyFirstNode(Node):", BASE))
    if not row:
        text = text.replace(late, "")
    told = told_of_period(source_of(my_first_node=text), 1.0)
    assert told.variant == variant


def test_a_flag_that_is_imported_with_from_keeps_its_value() -> None:
    text = changed(
        RIGHT,
        ("import rclpy\n", f"import rclpy\nfrom {FOLDER}.flags import due, tick\n"),
        ("self.timer_callback)", "tick)"),
        (
            "rclpy.spin(node)",
            "while rclpy.ok():\n            rclpy.spin_once(node)\n            if due:\n                node.timer_callback()",
        ),
    )
    flags = "due = False\n\n\ndef tick():\n    global due\n    due = True\n"
    assert named(look("run.no_lines", text, flags=flags)) == "node.number_imported/"
    constant = flags.replace("    global due\n    due = True\n", "    pass\n")
    assert named(look("run.no_lines", text, flags=constant)) != "node.number_imported/"


def test_what_counts_and_then_calls_the_callback_counts_each_line() -> None:
    text = changed(
        RIGHT,
        ("self.timer_callback)", "self.tick)"),
        (STEP, ""),
        (
            "    def timer_callback",
            f"    def tick(self):\n{STEP}        self.timer_callback()\n\n    def timer_callback",
        ),
    )
    assert not named(look("run.wrong_start", text)).startswith("node.counts_elsewhere")


def test_a_global_of_another_method_than_init_becomes_an_attribute() -> None:
    text = changed(
        RIGHT,
        (START, "        self.setup()\n\n    def setup(self):\n        counter_ = 0\n"),
        (
            "    def timer_callback(self):\n",
            "    def timer_callback(self):\n        global counter_\n",
        ),
    ).replace("self.counter_", "counter_")
    found = at_error("NameError: name 'counter_' is not defined", text, "get_logger")
    assert named(found) == "node.name_local/global_attribute"
    assert "delete global counter_" in texts(found)[1]


def test_a_method_of_the_base_that_makes_the_timer_is_called_twice() -> None:
    base = (
        "class Cyclic(Node):\n    def __init__(self, name):\n        super().__init__(name)\n"
        f"        self.start()\n\n    def start(self):\n        {TIMER}\n\n\nclass MyFirstNode(Cyclic):"
    )
    text = changed(RIGHT, (f"        {TIMER}\n", "        self.start()\n"))
    text = changed(text, ("class MyFirstNode(Node):", base))
    found = look("run.twice", text)
    assert named(found) == "node.two_timers/called_line"
    first = text.split("\n").index("        self.start()") + 1
    assert texts(found)[1] == f"Delete this line: line {first} calls start."


def test_all_that_stands_under_the_guard_moves_if_main_makes_no_node() -> None:
    body = RIGHT[RIGHT.index("    node = ") : RIGHT.index("\n\nif __name__")]
    text = changed(RIGHT, (body, ""), ("\n    main()\n", f"\n    main()\n{body}\n"))
    found = look("run.exits_at_once", text)
    assert found is not None
    assert found.kind == "node.spin_missing"
    assert texts(found)[1].startswith(
        "Move the lines that create the node, spin it and clean up into"
    )


def test_a_context_of_its_own_is_told_with_the_error_of_kilted_too() -> None:
    text = changed(
        RIGHT,
        ("class MyFirstNode(", "CONTEXT = rclpy.Context()\n\n\nclass MyFirstNode("),
        ("rclpy.init(args=args)", "rclpy.init(args=args, context=CONTEXT)"),
    )
    error = "RuntimeError: Context must be initialized a GuardCondition can be created"
    found = at_error(error, text, "rclpy.spin(")
    assert found is not None
    assert (found.kind, found.variant) == ("node.ros_not_running", "context")


def test_a_loop_over_levels_is_told_where_a_distro_allows_it() -> None:
    log = next(line for line in RIGHT.split("\n") if ".info(" in line)
    value = log.partition(".info")[2]
    loop = f"        for level in ('info', 'warn'):\n            getattr(self.get_logger(), level){value}"
    text = changed(RIGHT, (log, loop))
    found = look("run.twice", text)
    assert found is not None
    assert (found.kind, found.variant) == ("node.severity_changed", "loop")
    assert found.where is not None
    assert "for level in" in text.split("\n")[(found.where.line or 0) - 1]
