"""Assignments of schema 2: what the loader accepts, and how it tells a mistake in the file."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.base.errors import AssignmentError, UsageError
from grader.base.i18n.translator import Translator
from grader.course.assignment import Assignment
from grader.course.find import chosen, lessons_of
from grader.course.folder import COURSE
from grader.course.load import load_assignment
from grader.verdict.checks.all import CHECKS
from grader.verdict.order import load_visible
from tests.processes import ROOT
from tests.scenario_kinds import ASSIGNMENT

CIRCLE = ROOT / "lab" / "course" / "draw_circle" / "assignment.yaml"


def loaded(folder: Path, old: str = "", new: str = "", *, text: str = ASSIGNMENT) -> Assignment:
    """Return the assignment with one text replaced."""
    assert not old or text.count(old) == 1, old
    file = folder / "assignment.yaml"
    file.write_text(text.replace(old, new) if old else text, encoding="utf-8")
    return load_assignment(file, known_checks=CHECKS)


def test_the_main_node_gives_the_names_of_schema_1(tmp_path: Path) -> None:
    found = loaded(tmp_path)
    assert (found.package, found.node_file, found.node_name) == (
        "doubling",
        "doubler.py",
        "doubler",
    )
    assert (found.executable, found.target) == ("doubler", "doubling.doubler:main")
    assert found.max_score == 34


def test_the_topics_and_periods_of_the_checks_are_recorded(tmp_path: Path) -> None:
    plan = loaded(tmp_path).runs[0]
    assert plan.topics == {
        "/doubled": "std_msgs/msg/Int32",
        "/beat": "std_msgs/msg/Bool",
    }
    assert plan.periods == {"/beat": 0.2}


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("start: [{node: doubler}]", "start: [{node: doublr}]", "did you mean 'doubler'"),
        ("name: four, at: 1.0,", "name: four, at: 9.0,", "the run ends at 5 s"),
        ("name: reset, at: 2.0,", "name: four, at: 2.0,", "listed twice"),
        (
            "type: std_msgs/msg/Int32, values: {data: 4}",
            "type: Int32, values: {data: 4}",
            "std_msgs/msg/String",
        ),
        ("set: {doubler: {factor: 3}}", "set: {double: {factor: 3}}", "did you mean 'doubler'"),
        ("after: thrice", "after: trice", "did you mean 'thrice'"),
        ("check: topic.qos", "check: topic.qso", "did you mean 'topic.qos'"),
        ("reliability: best_effort", "reliability: best", "best_effort"),
        ("{topic: /beat, period: 0.2}", "{topic: /beat, perod: 0.2}", "did you mean 'period'"),
        ("{topic: /beat, period: 0.2}", "{topic: /beat, period: -1}", "above 0"),
        (
            "{topic: /beat, period: 0.2}",
            "{topic: /bet, period: 0.2}",
            "the type of /bet is not known",
        ),
        ("{data: true}", "{data: {about: 1.0}}", "within"),
        (
            "clock: {period: 0.1, ticks: 50}",
            "clock: {period: 0.1, tick: 50}",
            "did you mean 'ticks'",
        ),
        ("    topics: {", "    world: turtlsim\n    topics: {", "did you mean 'turtlesim'"),
        (
            "  - {id: run.starts, points: 1}",
            "  - {id: run.starts, points: 1, with: {a: 1}}",
            "takes no parameters",
        ),
        (
            'check: log.counts, points: 1, with: {text: "beat {n}", at_least: 10}',
            "check: log.counts, points: 1, with: {text: beat, at_least: 10}",
            "exactly once",
        ),
        ('{text: "beat {n}", period: 0.2}', "{period: 0.2}", "missing key 'text'"),
        ('{text: "beat {n}"}}', '{text: "beat {n}", level: wran}}', "did you mean 'warn'"),
        ("with: {name: doubler}", "with: {name: 3}", "must be text"),
        (
            "id: run.stays",
            "id: run.output",
            "'run.output' needs output: of schema 1: use log.counts",
        ),
        ("executable: doubler,", "executible: doubler,", "did you mean 'executable'"),
        ("data: 4}}}", "data: 4}}, set: {}}", "exactly one of publish, call, set"),
        ("cancel: large", "cancel: larg", "did you mean 'large'"),
        (
            "goal: {action: /turn, type: turtlesim/action/RotateAbsolute, values: {theta: 1.5}}",
            "goal: {action: /turn, type: RotateAbsolute}",
            "did you mean 'turtlesim/action/RotateAbsolute'",
        ),
        ("cancel: large", "move: {x: 1.0, y: 1.0}", "needs a world"),
        ("name: four, at: 1.0,", "name: four, at: 1.04,", "a multiple of 0.1 s: write 1 or 1.1"),
        ("during: [0, 0.9]", "during: [0, 5.5]", "ends at 5.5 s, the run 'answers' at 5 s"),
        ("file: doubler.py", "file: doubling.py", "doubling/doubler.py (did you mean 'doubler.py'"),
        (
            "{name: four, at: 1.0, publish: {topic: /number,",
            "{name: four, at: 1.0, publish: {topic: /numbr,",
            "nothing else names /numbr (did you mean '/number'?)",
        ),
        ("points: 1, after: four, with", "points: 1, with", "'topic.reacts' needs `after:`"),
        ("after: reset", "after: five", "judges a stimulus with 'call', and 'five' is none: reset"),
        ("with: {service: /reset, each", "with: {service: /rest, each", "'reset' calls /reset"),
        ("after: small, with: {action: /turn}", "after: small, with: {action: /trn}", "to /turn"),
        (
            "start: [{node: doubler}]",
            "start: [{node: doubler, params_file: ../a.yaml}]",
            "a path in the package, such as config/limits.yaml, not '../a.yaml'",
        ),
        (
            "start: [{node: doubler}]",
            "start: [{node: doubler, arguments: [--ros-args, -p]}]",
            "arguments are the program's own",
        ),
        ("{factor: 3}", "{factor: 3.0}", "factor is of the type integer: it cannot be 3.0"),
    ],
)
def test_a_mistake_in_the_file_is_told_with_its_line(
    old: str, new: str, words: str, tmp_path: Path
) -> None:
    line = ASSIGNMENT[: ASSIGNMENT.index(old)].count("\n") + 1
    with pytest.raises(AssignmentError) as told:
        loaded(tmp_path, old, new)
    first = str(told.value).splitlines()[0]
    assert words in first
    assert first.startswith(f"{tmp_path}/assignment.yaml:{line}:")


def test_a_start_gives_words_and_a_file_of_parameters(tmp_path: Path) -> None:
    start = 'start: [{node: doubler, arguments: ["3", "a b"], params_file: config/l.yaml}]'
    found = loaded(tmp_path, "start: [{node: doubler}]", start)
    assert found.runs[0].start[0].words("doubling") == [
        "3",
        "a b",
        "--ros-args",
        "--params-file",
        "install/doubling/share/doubling/config/l.yaml",
        "-p",
        "use_sim_time:=true",
    ]


def test_a_whole_number_is_no_double(tmp_path: Path) -> None:
    text = ASSIGNMENT.replace("type: integer, value: 2", "type: double, value: 2.0")
    with pytest.raises(AssignmentError, match=r"type double: it cannot be 3 \(did you mean '3.0'"):
        loaded(tmp_path, text=text)


@pytest.mark.parametrize(
    ("check", "words"),
    [
        ("{id: more, check: topic.silent, points: 1, run: answer, with: {topic: /beat}}", "run"),
        (
            "{id: more, check: topic.silent, points: 1, during: [0, 6], with: {topic: /beat}}",
            "the run 'answers' at 5 s",
        ),
    ],
)
def test_a_hidden_check_is_held_to_the_runs_too(check: str, words: str, tmp_path: Path) -> None:
    hidden = tmp_path / "hidden.yaml"
    hidden.write_text(f"checks:\n  - {check}\n", encoding="utf-8")
    file = tmp_path / "assignment.yaml"
    file.write_text(f"{ASSIGNMENT}hidden_checks: 1\n", encoding="utf-8")
    with pytest.raises(AssignmentError) as told:
        load_assignment(file, known_checks=CHECKS, hidden=hidden)
    assert str(told.value).startswith(f"{hidden}:2:")
    assert words in str(told.value)


def test_schema_1_has_no_keys_of_schema_2(tmp_path: Path) -> None:
    text = (ROOT / "lab/course/hello_time/assignment.yaml").read_text(encoding="utf-8")
    with pytest.raises(AssignmentError, match=r"unknown key 'runs' \(it is of schema 2\)"):
        loaded(tmp_path, text=text + "runs: []\n")


def test_the_first_lesson_of_the_order_is_the_default(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("alpha", "beta", "gamma"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "assignment.yaml").write_text(ASSIGNMENT, encoding="utf-8")
    monkeypatch.setenv(COURSE, str(tmp_path))
    with pytest.raises(UsageError, match="several lessons"):
        chosen(None)
    order = tmp_path / "course.yaml"
    order.write_text("schema: 1\nlessons: [gamma, alpha]\n", encoding="utf-8")
    assert chosen(None) == "gamma"
    assert lessons_of(tmp_path) == ["gamma", "alpha", "beta"]
    order.write_text("schema: 1\nlessons: [gamma, delta]\n", encoding="utf-8")
    with pytest.raises(AssignmentError, match=r"course\.yaml:2:18: there is no lesson 'delta'"):
        chosen(None)


def test_the_type_of_a_parameter_is_no_interface() -> None:
    """The radius of draw_circle is a double: ROS needs no package of that name."""
    assert {*load_visible("draw_circle").types()} == {"geometry_msgs/msg/Twist"}


def test_our_own_course_begins_with_the_first_node() -> None:
    assert lessons_of(ROOT / "lab" / "course")[:2] == ["hello_time", "draw_circle"]
    assert load_assignment(CIRCLE, known_checks=CHECKS).max_score == 100


def test_a_check_can_have_a_title_of_its_own(tmp_path: Path) -> None:
    """Students read it instead of the kind's; without one the hash is that of before."""
    plain = loaded(tmp_path)
    titled = loaded(tmp_path, "id: eight, check:", 'id: eight, title: "Four {is} eight", check:')
    kind = CHECKS["topic.reacts"]
    before, after = (next(u for u in a.checks if u.id == "eight") for a in (plain, titled))
    assert Translator("ko")(kind.title_of(after)) == "Four {is} eight"
    assert "/doubled" in Translator("en")(kind.title_of(before))
    assert plain.sha256 != titled.sha256
