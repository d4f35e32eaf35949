"""Types, fields and values that ROS does not have are told when the assignment is loaded."""

from __future__ import annotations

import json
import re
import subprocess
from pathlib import Path

import pytest

from grader.base.errors import AssignmentError
from grader.course.assignment import Assignment
from grader.course.interface_rules import form_fault, value_fault
from grader.course.interfaces import TABLE, ros_interfaces, table_of
from grader.course.load import load_assignment
from grader.ros.interfaces import TEXTS
from grader.ros.prefix import Ros
from grader.verdict.checks.all import CHECKS
from tests.processes import ROOT
from tests.scenario_kinds import ASSIGNMENT

CIRCLE = ROOT / "lab" / "course" / "draw_circle" / "assignment.yaml"


def loaded(folder: Path, old: str, new: str, text: str) -> Assignment:
    assert text.count(old) == 1, old
    file = folder / "assignment.yaml"
    file.write_text(text.replace(old, new), encoding="utf-8")
    return load_assignment(file, known_checks=CHECKS)


KINDS = [
    (
        "{data: true}",
        "{dta: true}",
        "{",
        "std_msgs/msg/Bool has no field 'dta' (did you mean 'data'?)",
    ),
    ("{data: true}", "{data: 1}", "{", "data is of the type bool: it cannot be 1"),
    ("{data: true}", "{data: {about: 1.0, within: 0.1}}", "{", "'about' never fits"),
    ("{data: 8}", "{data: 3000000000}", "{", "it cannot be 3000000000"),
    ("{data: 8}", "{data.x: 8}", "{", "data is a int32: it has no fields"),
    ("{data: 4}", "{dat: 4}", "{", "did you mean 'data'"),
    ("{data: 4}", "{data: four}", "{", "data is of the type int32 (-2147483648 to 2147483647)"),
    ("{data: 4}", "{data: 4.5}", "{", "it cannot be 4.5"),
    ("{data: 4}", "{data: true}", "{", "it cannot be true"),
    (
        "{theta: 1.5}",
        "{thta: 1.5}",
        "{",
        "the goal of turtlesim/action/RotateAbsolute has no field",
    ),
    ("{remaining: {b", "{remainin: {b", "{", "did you mean 'remaining'"),
    ("{delta: -1.5}", "{theta: -1.5}", "{", "the result of turtlesim/action/RotateAbsolute"),
    ("{success: true, m", "{sucess: true, m", "{", "did you mean 'success'"),
    (
        "{topic: /beat, type: std_msgs/msg/Bool, at_least: 10}",
        "{topic: /beat, type: std_msgs/msg/Boool, at_least: 10}",
        "type",
        "unknown type 'std_msgs/msg/Boool' (did you mean 'std_msgs/msg/Bool'?)",
    ),
    (
        "{/doubled: std_msgs/msg/Int32}",
        "{/doubled: std_msg/msg/Int32}",
        "/doubled",
        "unknown type 'std_msg/msg/Int32' (did you mean 'std_msgs/msg/Int32'?)",
    ),
    (
        "{service: /go, type: std_srvs/srv/SetBool}",
        "{service: /go, type: std_msgs/msg/Bool}",
        "type",
        "'std_msgs/msg/Bool' is a message, but a service is needed here",
    ),
    (
        "{service: /go, type: std_srvs/srv/SetBool}",
        "{service: /go, type: std_srvs/SetBool}",
        "type",
        "did you mean 'std_srvs/srv/SetBool'",
    ),
    (
        "{service: /reset, type: std_srvs/srv/Trigger}}\n  -",
        "{service: /reset, type: Trigger}}\n  -",
        "type",
        "did you mean 'std_srvs/srv/Trigger'",
    ),
]


@pytest.mark.parametrize(("old", "new", "at", "words"), KINDS)
def test_a_wrong_type_field_or_value_is_told_with_line_and_column(
    old: str, new: str, at: str, words: str, tmp_path: Path
) -> None:
    start = ASSIGNMENT.index(old)
    text = f"{ASSIGNMENT[:start]}@{ASSIGNMENT[start + len(old) :]}"  # the first of several
    found = new.index(at) + (1 if at == "{" else 0)
    before = text[:start] + new[:found]
    line, column = before.count("\n") + 1, len(before) - before.rfind("\n")
    with pytest.raises(AssignmentError) as told:
        loaded(tmp_path, "@", new, text)
    rows = str(told.value).splitlines()
    assert any(words in row for row in rows), rows
    assert any(row.startswith(f"{tmp_path}/assignment.yaml:{line}:{column}: ") for row in rows), (
        rows
    )


def test_the_fields_that_there_are_are_named(tmp_path: Path) -> None:
    text = CIRCLE.read_text(encoding="utf-8")
    start = text.index("linear.x")
    text = f"{text[:start]}linar.x{text[start + len('linear.x') :]}"
    file = tmp_path / "assignment.yaml"
    file.write_text(text, encoding="utf-8")
    column = start - text.rfind("\n", 0, start)
    line = text.count("\n", 0, start) + 1
    with pytest.raises(AssignmentError) as told:
        load_assignment(file, known_checks=CHECKS)
    assert str(told.value).splitlines()[0] == (
        f"{file}:{line}:{column}: geometry_msgs/msg/Twist has no field 'linar' "
        "(did you mean 'linear'?); it has linear, angular"
    )


@pytest.mark.parametrize(
    ("path", "fault"),
    [
        ("ranges[0]", ""),
        ("header.stamp.sec", ""),
        ("header.stamp.nanosecs", "did you mean 'header.stamp.nanosec'"),
        ("range_min[0]", "range_min is no list: it is a float32"),
    ],
)
def test_paths_lead_through_messages_and_lists(path: str, fault: str) -> None:
    found = ros_interfaces().field("sensor_msgs/msg/LaserScan", path).fault
    assert fault in found
    assert bool(fault) == bool(found)


def test_a_list_needs_an_index_that_it_has() -> None:
    known = ros_interfaces()
    assert known.field("geometry_msgs/msg/PoseWithCovariance", "covariance[35]").type == "float64"
    far = known.field("geometry_msgs/msg/PoseWithCovariance", "covariance[36]").fault
    assert far == "covariance has 36 values: the last is covariance[35]"
    poses = known.field("geometry_msgs/msg/PoseArray", "poses.position.x").fault
    assert poses == "poses is a list: write poses[0]"
    assert known.field("geometry_msgs/msg/PoseArray", "poses[3].position.x").type == "float64"


@pytest.mark.parametrize("name", ["control_msgs/msg/JointJog", "my_own/msg/Distance"])
def test_types_of_other_packages_are_not_judged(name: str) -> None:
    assert ros_interfaces().type_fault(name, "msg") == ""
    assert ros_interfaces().field(name, "any.thing").fault == ""


@pytest.mark.parametrize(
    ("kind", "value", "fits"),
    [
        ("uint8", 255, True),
        ("uint8", 256, False),
        ("int8", -129, False),
        ("float64", 3, True),
        ("float64", "3", False),
        ("string", "3", True),
        ("string", 3, False),
        ("bool", True, True),
        ("bool", "yes", False),
        ("int32[]", (1, 2), True),
        ("int32[]", (1, "2"), False),
        ("int32[]", 1, False),
        ("geometry_msgs/msg/Vector3", 1.0, False),
        ("", object(), True),
    ],
)
def test_a_value_must_fit_its_type(kind: str, value: object, fits: bool) -> None:
    assert (value_fault(kind, value) == "") == fits


@pytest.mark.parametrize(
    ("kind", "form", "fits"),
    [
        ("int32", 8.0, True),
        ("int32", 8.5, False),
        ("string", {"matches": "a"}, True),
        ("int32", {"matches": "a"}, False),
        ("float32", {"between": (0, 1)}, True),
        ("string", {"between": (0, 1)}, False),
        ("uint8", {"one_of": (1, 2)}, True),
        ("bool", {"equal": 1}, False),
    ],
)
def test_a_form_must_be_one_that_a_field_can_have(kind: str, form: object, fits: bool) -> None:
    assert (form_fault(kind, form) == "") == fits


def test_a_hidden_check_is_told_at_its_place_in_its_own_file(tmp_path: Path) -> None:
    file, hidden = tmp_path / "assignment.yaml", tmp_path / "hidden.yaml"
    file.write_text(ASSIGNMENT + "hidden_checks: 1\n", encoding="utf-8")
    hidden.write_text(
        "checks:\n  - {id: h, check: topic.values, points: 1, with: {topic: /beat, each: {dta: true}}}\n",
        encoding="utf-8",
    )
    with pytest.raises(AssignmentError) as told:
        load_assignment(file, hidden=hidden, known_checks=CHECKS)
    column = hidden.read_text(encoding="utf-8").splitlines()[1].index("dta") + 1
    assert str(told.value).startswith(f"{hidden}:2:{column}: std_msgs/msg/Bool has no field 'dta'")


# --- the table

BUILT = tuple(f"{folder.name}/" for folder in TEXTS.iterdir())  # from texts, not in a prefix


def test_the_table_has_turtlesims_texts() -> None:
    table = json.loads(TABLE.read_text(encoding="utf-8"))
    made = table_of(TEXTS)
    assert made
    assert {name: table[name] for name in made} == made


@pytest.mark.prefix
@pytest.mark.full
@pytest.mark.parametrize("name", ["jazzy", "kilted"])
def test_the_table_is_that_of_the_prefix(name: str, request: pytest.FixtureRequest) -> None:
    ros: Ros = request.getfixturevalue(f"ros_{name}")
    table = json.loads(TABLE.read_text(encoding="utf-8"))
    made = table_of(ros.path / "share")
    assert len(made) > 200
    own = {name: fields for name, fields in table.items() if not name.startswith(BUILT)}
    assert own == made


@pytest.mark.prefix
@pytest.mark.full
def test_rclpy_has_the_same_fields_and_types(ros_jazzy: Ros) -> None:
    """The generated classes are asked, which another program made from the same texts."""
    code = """
import importlib, json, sys
told = {}
for name in json.load(sys.stdin):
    package, kind, last = name.split("/")
    whole, _, part = last.partition("_")
    made = getattr(importlib.import_module(f"{package}.{kind}"), whole)
    made = getattr(made, part) if part else made
    told[name] = made.get_fields_and_field_types()
print(json.dumps(told))
"""
    table = json.loads(TABLE.read_text(encoding="utf-8"))
    names = [name for name in table if not name.startswith(BUILT)]
    setup = ros_jazzy.path / "setup.bash"
    done = subprocess.run(
        ["bash", "-c", '. "$0"; exec python3 -c "$1"', str(setup), code],
        input=json.dumps(names),
        capture_output=True,
        text=True,
        check=True,
    )
    told = json.loads(done.stdout)
    for name in names:
        assert {field: _rosidl(kind) for field, kind in table[name].items()} == {
            field: re.sub(r"string<\d+>", "string", kind) for field, kind in told[name].items()
        }, name


def _rosidl(kind: str) -> str:
    """Return a type as `get_fields_and_field_types` writes it."""
    kind = kind.replace("/msg/", "/")
    kind = {"byte": "octet", "float64": "double", "float32": "float", "bool": "boolean"}.get(
        kind.partition("[")[0], kind.partition("[")[0]
    ) + kind[len(kind.partition("[")[0]) :]
    kind = "uint8" + kind[4:] if kind.startswith("char") else kind
    if kind.endswith("[]"):
        return f"sequence<{kind[:-2]}>"
    if bounded := re.fullmatch(r"(.+)\[<=(\d+)\]", kind):
        return f"sequence<{bounded[1]}, {bounded[2]}>"
    return kind
