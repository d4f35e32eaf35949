"""A failed check names the root cause first, with its line; finding it takes little time."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, cast

import pytest

from grader.base.i18n.message import say
from grader.course.assignment import Assignment
from grader.mistakes.placeholders import placeholder_values
from grader.package.submission import Submission
from grader.report.model import CheckResult, Where
from grader.run.run import Run
from grader.verdict.checks import source
from grader.verdict.diagnose import Diagnosis, diagnose
from grader.verdict.outcome import Failed
from tests.corpus.build import SOLUTION
from tests.marking import ASSIGNMENT
from tests.static_bench import NODE, Bench

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

RIGHT = (SOLUTION / NODE).read_text(encoding="utf-8")
SPIN = "rclpy.spin(node)"
RCLPY = "/opt/ros/jazzy/lib/python3.12/site-packages/rclpy/executors.py"
TRACEBACK = """\
Traceback (most recent call last):
  File "/ws/install/my_robot_controller/lib/my_robot_controller/test_node", line 33, in <module>
    sys.exit(load_entry_point('my-robot-controller', 'console_scripts', 'test_node')())
  File "/ws/build/my_robot_controller/my_robot_controller/my_first_node.py", line {line}, in main
{error}
"""
FALSE_CALLBACK = (
    "UnboundLocalError: cannot access local variable 'arg_name' where it is not associated with a "
    "value"
)


@dataclass
class StandIn:
    """The part of the evidence that a diagnosis uses."""

    assignment: Assignment
    submission: Submission
    run: Run
    results: dict[str, CheckResult] = field(default_factory=dict)


def evidence(bench: Bench, source: str, transcript: str = "") -> Evidence:
    bench.write(NODE, source)
    static = bench.evidence()
    run = Run(command="ros2 run", transcript=transcript)
    return cast("Evidence", StandIn(static.assignment, static.submission, run))


def failed(mistake: str) -> Failed:
    return Failed(
        mistake,
        expected="a line",
        actual="no line",
        where=Where(file=NODE),
        params={"text": "Hello time: {self.counter_}"} if mistake == "run.wrong_text" else {},
        words={**placeholder_values(ASSIGNMENT), "wanted": ASSIGNMENT.node_name},
    )


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path / "my_robot_controller")


def test_the_root_cause_is_first_the_symptom_second_and_the_line_is_shown(bench: Bench) -> None:
    source = RIGHT.replace("self.timer_callback)", "self.timer_calback)")
    line = next(n for n, text in enumerate(source.splitlines(), 1) if "timer_calback" in text)
    error = "AttributeError: 'MyFirstNode' object has no attribute 'timer_calback'"
    seen = evidence(bench, source, TRACEBACK.format(line=line, error=error))
    shown_text = diagnose(failed("run.died_at_start"), seen)
    assert [m.id for m in shown_text.mistakes] == ["node.callback_misspelt", "run.died_at_start"]
    assert shown_text.where == Where(file=NODE, line=line)
    assert "self.create_timer(1.0, self.timer_calback)" in shown_text.actual
    assert "self.timer_callback" in shown_text.fix
    lines = shown_text.actual.split("\n")
    at = lines.index("timer_calback")
    assert set(lines[at + 1]) <= {" ", "^"}
    assert lines[at + 2] == "timer_callback"
    assert shown_text.consequence_of == ""


@pytest.mark.parametrize(
    "error",
    [
        "AttributeError: type object 'str' has no attribute '_TYPE_SUPPORT'",
        "AttributeError: 'str' object has no attribute '_TYPE_SUPPORT' This might be a ROS 1 message "
        "type but it should be a ROS 2 message type.",
    ],
    ids=["jazzy", "kilted"],
)
def test_a_services_type_and_name_in_the_wrong_order(bench: Bench, error: str) -> None:
    timer = "self.create_timer(1.0, self.timer_callback)"
    source = RIGHT.replace(timer, f"{timer}\n        self.create_client('/pen', SetPen)")
    line = next(n for n, text in enumerate(source.splitlines(), 1) if "create_client" in text)
    seen = evidence(bench, source, TRACEBACK.format(line=line, error=error))
    shown_text = diagnose(failed("run.died_at_start"), seen)
    assert shown_text.mistakes[0].id == "node.end_arguments"
    assert shown_text.where == Where(file=NODE, line=line)


@pytest.mark.parametrize("symptom", ["run.died_at_start", "run.ended_early", "run.error_at_stop"])
@pytest.mark.parametrize(
    ("at", "asks"),
    [
        ("rclpy.spin(", "The line shown spins the node"),
        ("", "No line of your files raised it"),
        ("self.counter_ += 1", "the line shown"),
    ],
)
def test_an_unknown_error_is_not_blamed_on_a_line_that_only_spins(
    symptom: str, at: str, asks: str, bench: Bench
) -> None:
    line = next(n for n, text in enumerate(RIGHT.splitlines(), 1) if at in text) if at else None
    inside = f'  File "{RCLPY}", line 9, in spin\n' if "spin" in at else ""
    trace = TRACEBACK.format(line=line, error=f"{inside}RuntimeError: an unknown one")
    seen = evidence(bench, RIGHT, trace.replace("my_first_node.py", NODE if at else "other.py"))
    found = failed(symptom)
    found.variant = "callback" if symptom == "run.ended_early" else ""
    found.where = Where(file=NODE, line=line) if line else None
    shown_text = diagnose(found, seen)
    assert [m.id for m in shown_text.mistakes] == [symptom]
    assert asks in shown_text.fix


def test_an_error_of_the_call_of_spin_itself_is_about_that_line(bench: Bench) -> None:
    line = next(n for n, text in enumerate(RIGHT.splitlines(), 1) if "rclpy.spin(" in text)
    trace = TRACEBACK.format(line=line, error="RuntimeError: an unknown one")
    found = failed("run.died_at_start")
    found.where = Where(file=NODE, line=line)
    fix = diagnose(found, evidence(bench, RIGHT, trace)).fix
    assert "what is wrong with the line shown" in fix
    assert "callbacks" not in fix


def test_a_status_without_an_error_asks_for_no_line(bench: Bench) -> None:
    status = failed("run.error_at_stop")
    status.where, status.variant = None, "status"
    assert "sys.exit()" in diagnose(status, evidence(bench, RIGHT)).fix


@pytest.mark.parametrize(
    ("callback", "error", "mistake"),
    [
        (
            "'self.timer_callback'",
            "TypeError: 'self.timer_callback' is not a callable object",
            "node.not_callable",
        ),
        ("self.counter_", FALSE_CALLBACK, "node.not_callable"),
        ("0", FALSE_CALLBACK, "node.not_callable"),
    ],
)
def test_kilteds_errors_for_what_is_no_callback(
    bench: Bench, callback: str, error: str, mistake: str
) -> None:
    wrong = f"create_timer(1.0, {callback})"
    source = RIGHT.replace("create_timer(1.0, self.timer_callback)", wrong)
    lines = source.splitlines()
    spin = next(n for n, text in enumerate(lines, 1) if "rclpy.spin(" in text)
    seen = evidence(bench, source, TRACEBACK.format(line=spin, error=error))
    shown_text = diagnose(failed("run.ended_early"), seen)
    timer = next(n for n, text in enumerate(lines, 1) if wrong in text)
    assert shown_text.mistakes[0].id == mistake
    assert shown_text.where == Where(file=NODE, line=timer)


def test_the_same_root_cause_at_another_check_is_a_consequence(bench: Bench) -> None:
    source = RIGHT.replace("self.timer_callback)", "self.timer_callback())")
    seen = evidence(bench, source)
    first = diagnose(failed("run.by_hand"), seen)
    seen.results["run.output"] = CheckResult(
        id="run.output",
        title="",
        status="failed",
        max_score=1,
        mistakes=first.mistakes,
        where=first.where,
    )
    assert diagnose(failed("run.by_hand"), seen).consequence_of == "run.output"
    assert diagnose(failed("run.no_lines"), evidence(bench, RIGHT)).consequence_of == ""


def test_a_hidden_check_is_never_named_as_the_cause(bench: Bench) -> None:
    seen = evidence(bench, RIGHT.replace("self.timer_callback)", "self.timer_callback())"))
    first = diagnose(failed("run.by_hand"), seen)
    seen.results["run.output"] = CheckResult(
        id="run.output",
        title="",
        status="failed",
        max_score=1,
        visibility="hidden",
        mistakes=first.mistakes,
        where=first.where,
    )
    assert diagnose(failed("run.by_hand"), seen).consequence_of == ""


def test_an_uninstalled_module_is_distinguished_from_a_missing_one(bench: Bench) -> None:
    error = "ModuleNotFoundError: No module named 'my_robot_controller.my_first_node'"
    printed = TRACEBACK.format(line=5, error=error)
    text = diagnose(failed("run.died_at_start"), evidence(bench, RIGHT, printed))
    assert text.mistakes[0].id != "setup.not_packaged"  # (what it asks for is there)
    bench.change("setup.py", "find_packages(exclude=['test'])", "[]")
    text = diagnose(failed("run.died_at_start"), evidence(bench, RIGHT, printed))
    assert text.mistakes[0].id == "setup.not_packaged"
    (bench.root / "my_robot_controller/__init__.py").unlink()
    text = diagnose(failed("run.died_at_start"), evidence(bench, RIGHT, printed))
    assert text.mistakes[0].id == "source.no_init_file"
    assert "touch my_robot_controller/__init__.py" in text.fix


@pytest.mark.parametrize("source", ["def broken(:\n", "\0\0", "x = (\n" * 1000])
def test_an_unreadable_source_leaves_the_symptom(bench: Bench, source: str) -> None:
    text = diagnose(failed("run.no_lines"), evidence(bench, source))
    assert [m.id for m in text.mistakes] == ["run.no_lines"]
    assert text.consequence_of == ""


def test_a_node_in_a_separate_module_is_examined_there(bench: Bench) -> None:
    own = RIGHT.replace("        self.counter_ += 1\n", "")
    bench.write("my_robot_controller/talker.py", own)
    left = (
        "from my_robot_controller.talker import main\n\n\nif __name__ == '__main__':\n    main()\n"
    )
    text = diagnose(failed("run.constant_counter"), evidence(bench, left))
    assert text.mistakes[0].id == "node.counter_not_increased"
    assert text.where is not None
    assert text.where.file == "my_robot_controller/talker.py"
    for symptom in ("run.exits_at_once", "run.no_node"):
        text = diagnose(failed(symptom), evidence(bench, left))
        assert [m.id for m in text.mistakes] == [symptom], "not looked at: nobody is accused"


def test_a_check_of_another_stage_is_left_unchanged(bench: Bench) -> None:
    seen = Failed("package.manifest_doctype", expected=say("pass"), actual="x")
    text = diagnose(seen, evidence(bench, RIGHT))
    assert text == Diagnosis.of(seen)


def test_a_harmless_mistake_is_advice(bench: Bench) -> None:
    for old, new, output in (
        ("'__main__'", "'main'", "if __name__ == '__main__':"),
        ("'__main__'", "'__mian__'", "if __name__ == '__main__':"),
        ("rclpy.try_shutdown()", "rclpy.shutdown", "rclpy.try_shutdown()"),
    ):
        assert RIGHT.count(old) == 1
        bench.write(NODE, RIGHT.replace(old, new))
        (advice,) = bench.passes(source.node_file).advice
        assert output in advice
    bench.write(NODE, RIGHT)
    assert not bench.passes(source.node_file).advice


@pytest.mark.parametrize(
    ("symptom", "old", "new", "mistake", "fix"),
    [
        # what the callback returns is kept by the code that calls it: nothing is accused
        (
            "run.constant_counter",
            "self.counter_ += 1",
            "return self.counter_ + 1\n\n    def run(self):\n"
            "        self.counter_ = self.timer_callback()",
            "",
            "",
        ),
        # the loop waits, or what it calls is not known
        (
            "run.too_much_output",
            SPIN,
            "while True:\n            wait()\n            print(1)",
            "",
            "",
        ),
        ("run.too_much_output", SPIN, "while rclpy.ok():\n            pass", "", ""),
        # input() is not reached before spin, or only if the file is started directly
        ("run.never_spins", SPIN, f"{SPIN}\n        input()", "", ""),
        (
            "run.no_node",
            SPIN,
            f"node.destroy_node()\n        print(1)\n        {SPIN}",
            "node.cleanup_early",
            "Move node.destroy_node() to the end of main, below the line that spins.",
        ),
        (
            "run.exits_at_once",
            SPIN,
            "executor = rclpy.executors.SingleThreadedExecutor()\n"
            "        executor.add_node(node)\n        executor.spin",
            "node.spin_missing",
            "Write executor.spin() instead of executor.spin.",
        ),
        (
            "run.exits_at_once",
            SPIN,
            "rclpy.spin_once",
            "node.spin_missing",
            "Write rclpy.spin(node) instead of rclpy.spin_once.",
        ),
    ],
)
def test_a_cause_is_named_only_if_it_is_certain(
    bench: Bench, symptom: str, old: str, new: str, mistake: str, fix: str
) -> None:
    assert old in RIGHT
    found = diagnose(failed(symptom), evidence(bench, RIGHT.replace(old, new, 1)))
    names = {"node.sum_not_kept", "node.cleanup_early"}
    names |= {"node.spin_missing", "node.executor_without_node"}
    assert {m.id for m in found.mistakes} & names == ({mistake} if mistake else set())
    assert fix in str(found.fix)
