"""What a failed check says: how often, when, what came instead, and which names are the student's."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.base.i18n.times import times
from grader.course.assignment import Assignment, CheckUse
from grader.course.load import load_assignment
from grader.course.values import Form
from grader.package.submission import take_in
from grader.run.observations import Done, End, Message, Observations, Role
from grader.run.observer import Event, Watch
from grader.run.probe_link import LogRecord, NodeSeen
from grader.run.run import Run
from grader.verdict.checks.all import CHECKS
from grader.verdict.evidence import Evidence
from grader.verdict.outcome import Failed, Outcome, Passed
from tests.scenario_kinds import ASSIGNMENT, FORMS, write_package
from tests.static_bench import BUILT

NODE = NodeSeen("/doubler", clock=True, rosout=True, parameters=True, answers=True)
BEAT = {"topic": "/beat", "type": "std_msgs/msg/Bool"}
RESET = {"service": "/reset", "type": "std_srvs/srv/Trigger"}
ALARMS = """\
  - {id: alarm, check: log.matches, points: 1, with: {text: Alarm on}}
  - {id: quiet.again, check: log.matches, points: 1, after: thrice, during: [0, 1], with: {text: Alarm off}}
"""


def judged(
    use: CheckUse, folder: Path, *, ends: list[End], lines: list[tuple[str, float, int]]
) -> Passed | Outcome:
    """Return what a check finds in a run of five seconds: `lines` are texts, instants and levels."""
    file = folder / "assignment.yaml"
    file.write_text(ASSIGNMENT + ALARMS, encoding="utf-8")
    assignment: Assignment = load_assignment(file, known_checks=CHECKS)
    instants = [round(0.1 * k, 6) for k in range(1, 51)]
    seen = Observations(0.1, instants=instants, ends=ends)
    seen.done = [Done("four", 1.0, heard=1), Done("thrice", 3.0, heard=1)]
    seen.messages = [Message("/doubled", 1.0, {"data": 8})] * 3
    records = [LogRecord(level, "doubler", text, "", "", 0, 0) for text, _, level in lines]
    events = [
        Event(text, at, at, "logger", None, record=record)
        for (text, at, _), record in zip(lines, records)
    ]
    watch = Watch(clock="virtual", events=events, settled=True)
    run = Run("ros2 run", watch, (NODE,), started=True, name="answers", seen=seen)
    package = write_package(FORMS[0], folder)
    evidence = Evidence(
        assignment,
        take_in(package, package="doubling", node_file="doubler.py"),
        build=lambda: BUILT,
        run=lambda: run,
        run_of=lambda _: run,
    )
    return CHECKS[use.kind].evaluate(evidence, use)


def logged(
    folder: Path, given: dict[str, object], *lines: tuple[str, float, int], id_: str = "quiet.again"
) -> Failed:
    use = {"id": id_, "points": 1, "check": "log.matches", "with": given}
    if id_ == "quiet.again":
        use |= {"after": "thrice", "during": [0, 1]}
    found = judged(CheckUse.model_validate(use), folder, ends=[], lines=list(lines))
    assert isinstance(found, Failed), found
    return found


@pytest.mark.parametrize(
    ("least", "most", "words"),
    [
        (1, 1, "exactly once"),
        (2, 2, "exactly 2 times"),
        (1, None, "at least once"),
        (3, None, "at least 3 times"),
        (0, 1, "at most once"),
        (0, 4, "at most 4 times"),
        (2, 5, "2 to 5 times"),
        (0, 0, "never"),
    ],
)
def test_how_often_something_must_happen_is_said_in_words(
    least: int, most: int | None, words: str
) -> None:
    assert times(least, most) == words


def test_a_range_of_values_is_said_in_words() -> None:
    assert str(Form(between=(0, 1.5))) == "0 to 1.5"


def test_a_line_that_another_check_asks_for_is_not_compared(tmp_path: Path) -> None:
    """'Alarm on' is no misspelt 'Alarm off'."""
    found = logged(tmp_path, {"text": "Alarm off"}, ("Alarm on", 1.0, 20), ("Alarm on", 3.5, 20))
    assert found.mistake.id == "log.missing"
    assert found.expected == "'Alarm off': at least once, from 3 s to 4 s"
    assert found.actual == "0 such lines: it logged 'Alarm on' at 3.5 s"


def test_a_misspelt_line_is_told_with_its_instant(tmp_path: Path) -> None:
    found = logged(tmp_path, {"text": "Alarm off"}, ("alarm off", 3.5, 20))
    assert found.mistake.id == "log.wrong_text"
    assert found.actual == "'alarm off' at 3.5 s\nalarm off\n^\nAlarm off"


def test_the_right_line_with_another_level_is_told_by_its_level(tmp_path: Path) -> None:
    found = logged(tmp_path, {"text": "Alarm off", "level": "warn"}, ("Alarm off", 3.5, 20))
    assert found.mistake.id == "log.wrong_level"
    assert found.expected == "'Alarm off': at least once, from 3 s to 4 s, level WARN"
    assert found.actual == "'Alarm off' at 3.5 s, level INFO"


def test_lines_that_come_too_often_are_told_with_their_instants(tmp_path: Path) -> None:
    lines = [("Alarm on", float(at), 20) for at in (1, 2, 3, 4)]
    found = logged(tmp_path, {"text": "Alarm on", "at_most": 1}, *lines, id_="alarm")
    assert found.expected == "'Alarm on': exactly once"
    shown = "'Alarm on' at 1 s, 'Alarm on' at 2 s, 'Alarm on' at 3 s, …"
    assert found.actual == f"4 such lines: {shown}"


def test_reactions_that_come_too_often_are_told_in_words(tmp_path: Path) -> None:
    given = {"topic": "/doubled", "within": 0.1, "at_most": 2}
    use = {"id": "a", "points": 1, "check": "topic.reacts", "after": "four", "with": given}
    found = judged(CheckUse.model_validate(use), tmp_path, ends=[], lines=[])
    assert isinstance(found, Failed)
    assert found.expected == "a message on /doubled within 0.1 s: 1 to 2 times"


def end(role: Role, name: str, type_: str) -> End:
    return End("/doubler", role, name, type_)


OF_ROS = [
    end("publisher", "/rosout", "rcl_interfaces/msg/Log"),
    end("publisher", "/parameter_events", "rcl_interfaces/msg/ParameterEvent"),
    end("subscription", "/clock", "rosgraph_msgs/msg/Clock"),
    end("publisher", "/doubler/transition_event", "lifecycle_msgs/msg/TransitionEvent"),
    end("publisher", "/turn/_action/feedback", "turtlesim/action/RotateAbsolute_FeedbackMessage"),
    end("publisher", "/turn/_action/status", "action_msgs/msg/GoalStatusArray"),
    end("service", "/doubler/set_parameters", "rcl_interfaces/srv/SetParameters"),
    end("service", "/doubler/change_state", "lifecycle_msgs/srv/ChangeState"),
    end("service", "/doubler/get_transition_graph", "lifecycle_msgs/srv/GetAvailableTransitions"),
    end("service", "/turn/_action/get_result", "turtlesim/action/RotateAbsolute_GetResult"),
]


@pytest.mark.parametrize(
    ("kind", "given", "mistake"),
    [
        ("topic.publishes", BEAT, "topic.no_publisher"),
        ("topic.subscribes", BEAT, "topic.no_subscription"),
        ("service.offers", RESET, "service.missing"),
        ("service.calls", RESET, "service.no_client"),
    ],
)
def test_what_rclpy_makes_by_itself_is_not_told_as_the_students(
    kind: str, given: dict[str, str], mistake: str, tmp_path: Path
) -> None:
    use = CheckUse.model_validate({"id": "a", "points": 1, "check": kind, "with": given})
    found = judged(use, tmp_path, ends=OF_ROS, lines=[])
    assert isinstance(found, Failed)
    assert found.mistake.id == mistake
    assert "/doubler/" not in found.actual and "_action" not in found.actual


@pytest.mark.parametrize(
    ("kind", "name", "type_"),
    [
        ("service.offers", "/doubler/change_state", "lifecycle_msgs/srv/ChangeState"),
        ("service.calls", "/other/set_parameters", "rcl_interfaces/srv/SetParameters"),
    ],
)
def test_what_a_check_asks_for_by_its_name_counts(
    kind: str, name: str, type_: str, tmp_path: Path
) -> None:
    given = {"service": name, "type": type_}
    use = CheckUse.model_validate({"id": "a", "points": 1, "check": kind, "with": given})
    client = end("client", "/other/set_parameters", "rcl_interfaces/srv/SetParameters")
    assert isinstance(judged(use, tmp_path, ends=[*OF_ROS, client], lines=[]), Passed)


def test_a_count_of_lines_that_nothing_can_have_is_told_when_it_is_loaded(tmp_path: Path) -> None:
    from grader.base.errors import AssignmentError

    file = tmp_path / "assignment.yaml"
    wrong = "  - {id: x, check: log.matches, points: 1, with: {text: a, at_least: 3, at_most: 2}}\n"
    file.write_text(ASSIGNMENT + wrong, encoding="utf-8")
    with pytest.raises(AssignmentError, match="at_least is 3, above at_most, which is 2"):
        load_assignment(file, known_checks=CHECKS)
