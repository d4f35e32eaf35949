"""Which failed check explains another one, and which advice a source follows, without a real run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from grader.base.i18n.translator import Translator
from grader.course.load import load_assignment
from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.kind import FOLLOWED
from grader.package.source.node import NodeSource, read_node
from grader.package.source.parameter_file import sections_of
from grader.package.submission import take_in
from grader.report.model import CheckResult
from grader.run.observations import Done, End, Message, Observations, Parameter
from grader.run.observer import Event
from grader.run.probe_link import NodeSeen
from grader.run.run import Run
from grader.run.workspace import Build, Installed
from grader.verdict.checks.all import CHECKS
from grader.verdict.evaluate import evaluate_checks
from grader.verdict.evidence import Evidence
from tests.small_lessons import (
    ACTION,
    HEAD,
    HYSTERESIS,
    NODE,
    PARAMETERS,
    ROBOT,
    YAML,
    Broken,
    Lesson,
)

ENTRY = "[console_scripts]\nnode = small.node:main\n"
PREFIX = "install/small"


def built(*files: str) -> Build:
    """Return a build that installed the package, and these files of its share folder."""
    paths = (
        "lib/small/node",
        "share/ament_index/resource_index/packages/small",
        "share/small/hook/ament_prefix_path.sh",
        *(f"share/small/{file}" for file in files),
    )
    there = {f"{PREFIX}/{path}": Installed("f", 0o755, 1) for path in paths}
    return Build("colcon build", 0, "", 1.0, files=there, entry_points=ENTRY)


def results(
    lesson: Lesson,
    folder: Path,
    seen: Observations,
    *,
    node: str,
    form: Broken | None = None,
    build: Build | None = None,
    events: Sequence[Event] = (),
    transcript: str = "",
) -> dict[str, CheckResult]:
    """Return the results of a lesson's checks for a run in which its node showed this.

    With a transcript, the program ended with it before a node was there.
    """
    file = folder / "assignment.yaml"
    file.write_text(HEAD + lesson.assignment, encoding="utf-8")
    assignment = load_assignment(file, known_checks=CHECKS)
    package = take_in(lesson.write(folder, form), package="small", node_file="node.py")
    plan = assignment.runs[0]
    seen.instants = [0.5 * n for n in range(1, plan.clock.ticks + 1)]
    seen.complete = True
    run = Run("ros2 run", name=plan.name, seen=seen, started=True, interrupted=True)
    run.nodes = (NodeSeen(node, True, True, True, services=True, answers=True),)
    run.watch.settled, run.watch.events = True, list(events)
    if transcript:
        run = Run("ros2 run", name=plan.name, transcript=transcript, ended_by_itself=True, status=1)
    evidence = Evidence(
        assignment,
        package,
        build=lambda: build or built("config/limits.yaml"),
        run=lambda: run,
        run_of=lambda _: run,
    )
    return {one.id: one for one in evaluate_checks(evidence, Translator("en"))}


def failed(found: dict[str, CheckResult]) -> dict[str, str]:
    return {
        name: one.mistakes[0].id if one.mistakes else one.actual
        for name, one in found.items()
        if one.status in ("failed", "error")
    }


def robot(commands: list[tuple[float, float]], speed: float) -> Observations:
    """Return a run in the room: the commands (instant, m/s), and the robot's speed at the end."""
    scan = "sensor_msgs/msg/LaserScan"
    ends = [
        End("/halt", "publisher", "/cmd_vel", "geometry_msgs/msg/Twist"),
        End("/halt", "subscription", "/scan", scan),
        End("/room", "publisher", "/scan", scan),
    ]
    odom = {"twist": {"twist": {"linear": {"x": speed}}}}
    messages = [Message("/cmd_vel", at, {"linear": {"x": x}}) for at, x in commands]
    return Observations(0.5, ends=ends, messages=[*messages, Message("/odom", 8.5, odom)])


def test_what_the_world_says_follows_from_what_the_node_sends(tmp_path: Path) -> None:
    seen = robot([(1.0, 1.0), (8.5, -0.1)], -0.1)
    found = results(ROBOT, tmp_path, seen, node="/halt")
    assert failed(found) == {"halts": "topic.wrong_value"}
    assert (found["stopped"].status, found["stopped"].blocked_by) == ("skipped", "halts")


def test_nobody_is_told_to_set_a_field_of_the_worlds_topic(tmp_path: Path) -> None:
    seen = robot([(1.0, 1.0), (8.5, 0.0)], -0.1)
    found = results(ROBOT, tmp_path, seen, node="/halt")
    assert failed(found) == {"stopped": "world.other_state"}
    assert "Set " not in found["stopped"].fix


def test_a_publisher_that_offers_too_little_is_why_the_robot_does_not_move(tmp_path: Path) -> None:
    seen = robot([(1.0, 1.0), (8.5, 0.0)], -0.1)
    twist = ("/cmd_vel", "geometry_msgs/msg/Twist")
    seen.ends[0] = End("/halt", "publisher", *twist, "best_effort", "volatile")
    seen.ends.append(End("/room", "subscription", *twist, "reliable", "volatile"))
    found = results(ROBOT, tmp_path, seen, node="/halt")
    assert failed(found) == {"stopped": "topic.qos_mismatch"}
    assert found["stopped"].fix.startswith("Give this line the QoS of the other side: 10")
    assert found["stopped"].where is not None and found["stopped"].where.line


FLOAT, BOOL = "std_msgs/msg/Float64", "std_msgs/msg/Bool"


def test_what_the_node_does_follows_from_what_it_does_not_hear(tmp_path: Path) -> None:
    ends = [
        End("/alarm", "publisher", "/alarm", BOOL),
        End("/alarm", "subscription", "/temperatures", FLOAT),
    ]
    done = [Done(name, at, heard=0) for name, at in [("cool", 0.5), ("hot", 1), ("cold", 3)]]
    done.insert(2, Done("between", 2.0))
    messages = [Message("/alarm", 2.0, {"data": True})]
    found = results(
        HYSTERESIS,
        tmp_path,
        Observations(0.5, ends=ends, messages=messages, done=done),
        node="/alarm",
    )
    assert failed(found) == {"hears": "topic.wrong_name"}
    assert {one.blocked_by for one in found.values() if one.status == "skipped"} == {"hears"}


def alarms() -> Observations:
    """Return what the right node of the lesson about a threshold does."""
    ends = [
        End("/alarm", "publisher", "/alarm", BOOL),
        End("/alarm", "subscription", "/temperature", FLOAT),
    ]
    times = [("cool", 0.5), ("hot", 1.0), ("between", 2.0), ("cold", 3.0)]
    messages = [Message("/alarm", at, {"data": at < 2}) for at in (1.0, 3.0)]
    return Observations(
        0.5, ends=ends, messages=messages, done=[Done(name, at, heard=1) for name, at in times]
    )


@pytest.mark.parametrize(
    ("source", "mistake"), [("print", "run.print_not_logger"), ("", "log.missing")]
)
def test_a_line_that_was_printed_is_told_as_that(source: str, mistake: str, tmp_path: Path) -> None:
    events = [Event("so hot", 1.0, 1.0, "print", None)] if source else []
    other = ((NODE, "class This", "print('starts')\n\n\nclass This"),)
    form = Broken("form", ((NODE, ".get_logger().info", ".get_logger().debug"), *other), {})
    found = results(HYSTERESIS, tmp_path, alarms(), node="/alarm", form=form, events=events)
    seen = found["tells"].mistakes
    assert [one.id for one in seen][-1] == mistake
    assert seen[0].id == ("node.print_used" if source else "node.debug_level")


MAPPING = replace(
    HYSTERESIS, assignment=HYSTERESIS.assignment + "  - {id: entry_point.mapping, points: 1}\n"
)


def test_what_another_file_of_the_package_does_follows_from_the_entry_point(
    tmp_path: Path,
) -> None:
    other = Broken(
        "other",
        (
            ("small/other.py", "", MAPPING.files[NODE].replace("'alarm'", "'other'")),
            ("setup.py", "small.node:main", "small.other:main"),
        ),
        {},
    )
    entry = ENTRY.replace("small.node", "small.other")
    build = replace(built(), entry_points=entry)
    seen = Observations(0.5, done=[Done("hot", 1.0), Done("between", 2.0), Done("cold", 3.0)])
    found = results(MAPPING, tmp_path, seen, node="/other", form=other, build=build)
    assert failed(found) == {"entry_point.mapping": "setup.other_module"}
    skipped = {one.blocked_by for one in found.values() if one.status == "skipped"}
    assert skipped == {"entry_point.mapping"}


@pytest.mark.parametrize(
    ("file", "fix"), [("resource/small", "touch resource/small"), ("notes.txt", "Correct the name")]
)
def test_what_data_files_lists_and_is_not_there_is_told(
    file: str, fix: str, tmp_path: Path
) -> None:
    rest = "  - {id: build.colcon, points: 1}\n"
    lesson = replace(HYSTERESIS, assignment=HYSTERESIS.assignment + rest)
    said = f"error: can't copy '/ws/build/small/{file}': doesn't exist or not a regular file"
    log = f"--- stderr: small\n{said}\n---\nFailed   <<< small [1.0s, exited with code 1]\n"
    build = Build("colcon build", 1, log, 1.0)
    found = results(lesson, tmp_path, Observations(0.5), node="/alarm", build=build)
    assert fix in found["build.colcon"].fix


def test_a_node_file_beside_setup_py_is_told_where_its_import_fails(tmp_path: Path) -> None:
    moved = Broken("moved", ((NODE, "", None), ("node.py", "", HYSTERESIS.files[NODE])), {})
    traceback = (
        "Traceback (most recent call last):\n"
        '  File "/home/student/ws/install/small/lib/small/node", line 33, in <module>\n'
        "ModuleNotFoundError: No module named 'small.node'\n"
    )
    found = results(
        HYSTERESIS, tmp_path, Observations(0.5), node="/x", form=moved, transcript=traceback
    )
    assert failed(found) == {"run.starts": "source.misplaced_node_file"}


def limited(name: str, value: Any, said: float) -> Observations:
    ends = [
        End("/limiter", "publisher", "/limited", FLOAT),
        End("/limiter", "subscription", "/speed", FLOAT),
    ]
    return Observations(
        0.5,
        ends=ends,
        parameters={"/limiter": [Parameter(name, "double", value)]},
        done=[Done("much", 1.0, heard=1)],
        messages=[Message("/limited", 1.0, {"data": said})],
    )


@pytest.mark.parametrize(
    ("old", "new", "mistake", "line"),
    [
        ("limiter:", "limitter:", "parameter.file_other_node", 1),
        ("limiter:", "/other/limiter:", "parameter.file_other_node", 1),
        ("max_speed", "maximum_speed", "parameter.file_unknown", 3),
        ("limiter:", "/**:", "parameter.wrong_value", 0),
        ("2.5", "1.0", "parameter.wrong_value", 0),
    ],
)
def test_what_a_file_of_parameters_has_wrong_is_told_in_the_file(
    old: str, new: str, mistake: str, line: int, tmp_path: Path
) -> None:
    form = Broken("form", ((YAML, old, new),), {})
    seen = limited("max_speed", 1.0, 1.0)
    found = results(PARAMETERS, tmp_path, seen, node="/limiter", form=form)
    assert failed(found) == {"limit": mistake}
    assert found["limits"].blocked_by == "limit"
    where = found["limit"].where
    assert where is not None
    assert not line or (where.file, where.line) == (YAML, line)


CMAKE = "CMakeLists.txt"
INSTALLED = "        ('share/small/config', ['config/limits.yaml']),\n"


@pytest.mark.parametrize(
    ("edits", "files", "mistake", "place", "fix"),
    [
        (
            (("setup.py", INSTALLED, ""),),
            (),
            "setup.file_not_installed",
            ("setup.py", 5),
            "('share/small/config', ['config/limits.yaml'])",
        ),
        (
            (("setup.py", "'share/small/config'", "'share/small'"),),
            ("limits.yaml",),
            "setup.file_not_installed",
            ("setup.py", 8),
            "write this line for the file, then build again: ('share/small/config'",
        ),
        (
            (("config/other.yaml", "", "limiter: {}\n"), (YAML, "", None)),
            (),
            "files.missing",
            ("config/other.yaml", None),
            "Create config/limits.yaml",
        ),
        (
            ((CMAKE, "", "project(small)\n"), ("setup.py", "", None)),
            (),
            "setup.file_not_installed",
            (CMAKE, None),
            "install(DIRECTORY config DESTINATION share/${PROJECT_NAME})",
        ),
    ],
)
def test_a_file_that_is_not_installed_is_told_with_the_line_that_is_missing(
    edits: Any, files: tuple[str, ...], mistake: str, place: Any, fix: str, tmp_path: Path
) -> None:
    form, seen = Broken("form", edits, {}), limited("max_speed", 2.5, 2.5)
    found = results(PARAMETERS, tmp_path, seen, node="/limiter", form=form, build=built(*files))
    assert failed(found)["run.starts"] == mistake
    where = found["run.starts"].where
    assert where is not None
    assert (where.file, where.line) == place
    assert fix in found["run.starts"].fix
    assert found["limits"].blocked_by == "run.starts"


def test_a_section_is_for_the_nodes_that_ros_means() -> None:
    text = b"""\
/**: {ros__parameters: {a: 1}}
front: {ros__parameters: {a: 1.5}, left: {ros__parameters: {b: {c: x, d: [true]}}}}
/*/left: {ros__parameters: {}}
"""
    found = {one.node: one for one in sections_of(text)}
    assert list(found) == ["/**", "/front", "/front/left", "/*/left"]
    mine = [name for name, one in found.items() if one.is_for("/front/left")]
    assert mine == ["/**", "/front/left", "/*/left"]
    values = [(v.name, v.type, v.line) for v in found["/front/left"].values]
    assert values == [("b.c", "string", 2), ("b.d", "bool_array", 2)]
    assert [one.values[0].type for one in list(found.values())[:2]] == ["integer", "double"]


@pytest.mark.parametrize("text", [b"", b"a: [", b"- a\n", b"a: &a {b: *a}\n", b"[" * 5000])
def test_a_file_that_is_no_file_of_parameters_has_no_sections(text: bytes) -> None:
    assert sections_of(text) == []


def source(lesson: Lesson, old: str, new: str) -> NodeSource:
    text = lesson.files[NODE].replace(old, new)
    assert old in lesson.files[NODE]
    found = read_node(lambda path: text.encode() if path == NODE else None, NODE, "main")
    assert found is not None
    return found


@pytest.mark.parametrize(
    ("mistake", "lesson", "edit", "told", "untold"),
    [
        ("topic.never_published", HYSTERESIS, ("Bool", "Bool"), FOLLOWED, "Call "),
        ("topic.never_published", HYSTERESIS, (".publish(Bool(data=is_on))", ".publish"), "Call", ""),
        ("topic.never_published", HYSTERESIS, ("self.alarm.publish", "self.other.publish"), "Call", ""),
        ("topic.no_reaction", HYSTERESIS, ("Bool", "Bool"), FOLLOWED, "Publish on"),
        ("action.not_cancelled", ACTION, ("is_cancel_requested", "is_active"), "Check", "cancel_callback"),
        ("action.not_cancelled", ACTION, ("cancel_callback=", "goal_callback="), "Pass a", "Check"),
    ],
)  # fmt: skip
def test_advice_that_the_source_follows_is_not_told(
    mistake: str, lesson: Lesson, edit: tuple[str, str], told: str, untold: str
) -> None:
    values = {"topic": "/alarm", "service": "/turn"}
    fix = CATALOGUE[mistake].fix_for(source(lesson, *edit), values, "")
    text = Translator("en")(fix)
    assert told in text
    assert not untold or untold not in text
