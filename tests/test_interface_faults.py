"""Interfaces that cannot be used: each is a failed check of the student's, with file and line."""

from __future__ import annotations

import json
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest

from grader.base.i18n.translator import Translator
from grader.base.unheard import unheard
from grader.course.assignment import Assignment
from grader.course.load import load_assignment
from grader.package.source.interface_faults import LONGEST_TEXT, Texts
from grader.report.model import CheckResult, Report
from grader.ros.distro import find_distro
from grader.ros.prefix import Ros
from grader.run.observations import Message, Observations
from grader.run.probe_link import in_probe
from grader.run.run import Run
from grader.run.student_interfaces import texts_of
from grader.sandbox.limits import Limits
from grader.verdict.checks.all import CHECKS
from grader.verdict.evaluate import evaluate_checks
from grader.verdict.evidence import Evidence
from grader.verdict.mark import grade
from grader.verdict.order import Order
from grader.verdict.static import evaluate_static
from grader.verdict.take_in import take_in_for
from tests.processes import ROOT
from tests.static_bench import BUILT

SOLUTION = ROOT / "grader" / "keys" / "own_message" / "solution"
LESSON = ROOT / "lab" / "course" / "own_message" / "assignment.yaml"
MESSAGE = "my_robot_interfaces/msg/Distance.msg"
TYPE = "my_robot_interfaces/msg/Distance"
WRONG: dict[str, tuple[str, bytes, str, int | None]] = {
    "a word of Python": ("msg/A.msg", b"int8 a\nfloat64 pass\n", "field_reserved", 2),
    "a word of C++": ("msg/A.msg", b"float64 double\n", "field_reserved", 1),
    "a method": ("msg/A.msg", b"bool get_fields_and_field_types\n", "field_reserved", 1),
    "a name of the class": ("msg/A.msg", b"# one\nint8 builtins\n", "field_reserved", 2),
    "60 million elements": ("msg/A.msg", b"float64[60000000] a\n", "too_large", 1),
    "5,000 digits": ("msg/A.msg", b"int8[" + b"9" * 5000 + b"] a\n", "too_large", 1),
    "arrays in arrays": ("msg/A.msg", b"B[10000] b\n", "too_large", 1),
    "comments": ("msg/A.msg", b"# " + b"y" * LONGEST_TEXT + b"\nint8 a\n", "too_long", 1),
    "a field twice": ("msg/A.msg", b"float64 a\n\nint32 a\n", "declared_twice", 3),
    "a constant twice": ("msg/A.msg", b"int8 X=1\nint8 X=2\n", "declared_twice", 2),
    "upper case": ("msg/A.msg", b"float64 Abc\n", "field_name", 1),
    "two underscores": ("msg/A.msg", b"float64 a__b\n", "field_name", 1),
    "a small constant": ("msg/A.msg", b"int32 abc=3\n", "constant_name", 1),
    "a constant too large": ("msg/A.msg", b"uint8 X=300\n", "value_range", 1),
    "a default too large": ("msg/A.msg", b"int8 a -129\n", "value_range", 1),
    "a long constant": ("msg/A.msg", b"int64 X=" + b"9" * 5000, "value_range", 1),
    "no bool": ("msg/A.msg", b"bool a yes\n", "value_range", 1),
    "not UTF-8": ("msg/A.msg", b"int8 a\n# \xe9\n", "not_utf8", 2),
    "a type of C": ("msg/A.msg", b"float a\n", "type_unknown", 1),
    "no such type here": ("msg/A.msg", b"Thing a\n", "type_unknown", 1),
    "no such type there": ("msg/A.msg", b"geometry_msgs/Twits a\n", "type_unknown", 1),
    "itself": ("msg/A.msg", b"A[] a\n", "recursive", 1),
    "itself in another": ("msg/A.msg", b"int8 a\nC c\n", "recursive", 2),
    "no name": ("msg/A.msg", b"int32\n", "line_unknown", 1),
    "no separator": ("srv/A.srv", b"int8 a\nbool b\n", "separator", 2),
    "spaces behind it": ("srv/A.srv", b"int8 a\n--- \nbool b\n", "separator", 3),
    "too many": ("srv/A.srv", b"int8 a\n---\n---\n", "separator", 3),
    "one of an action's": ("action/A.action", b"int8 a\n---\nint8 b\n", "separator", 3),
    "one in a message": ("msg/A.msg", b"int8 a\n---\n", "separator", 2),
    "behind a separator": ("srv/A.srv", b"int8 a\n---\nint8 from\n", "field_reserved", 3),
}
RIGHT = {
    "CRLF": ("msg/A.msg", b"int8 a\r\nint8 b\r\n"),
    "nothing": ("msg/A.msg", b""),
    "an empty request": ("srv/A.srv", b"---\nbool b\n"),
    "an action": ("action/A.action", b"int8 a\n---\nint8 a\n---\nint8 a\n"),
    "a long default": ("msg/A.msg", b'string a "' + b"x" * 15_000 + b'"\n'),
    "values": ("msg/A.msg", b"bool b true\nint8 c -128\nuint8 X=0xff\nfloat32 e 1e3\nint8[] f [1]\n"),
    "other packages": ("msg/A.msg", b"geometry_msgs/Pose p\nnobody_msgs/Thing[<=3] t\n"),
}  # fmt: skip
OTHERS = {"msg/B.msg": b"float64[1000] b\n", "msg/C.msg": b"A a\n"}


def is_type(name: str) -> bool | None:
    return name == "geometry_msgs/msg/Pose" if name.startswith("geometry_msgs/") else None


@pytest.mark.parametrize("case", WRONG)
def test_what_makes_an_interface_unusable_is_found_with_its_line(case: str) -> None:
    path, data, slug, line = WRONG[case]
    fault = Texts("p", {**OTHERS, path: data}, is_type).fault(path)
    assert fault is not None
    assert (fault.slug, fault.line) == (slug, line)


@pytest.mark.parametrize("case", RIGHT)
def test_what_ros_accepts_has_no_fault(case: str) -> None:
    path, data = RIGHT[case]
    assert Texts("p", {"msg/B.msg": b"", path: data}, is_type).fault(path) is None


@pytest.mark.prefix
def test_no_interface_of_ros_itself_has_a_fault(ros_jazzy: Ros) -> None:
    found = 0
    for package in (ros_jazzy.path / "share").iterdir():
        kinds = [(kind, package / kind) for kind in ("msg", "srv", "action")]
        files = {
            f"{kind}/{file.name}": file.read_bytes()
            for kind, folder in kinds
            for file in folder.glob(f"*.{kind}")
        }
        texts = Texts(package.name, files)
        found += len(files)
        assert {path: texts.fault(path) for path in files} == dict.fromkeys(files)
    assert found > 100


def handed_in(folder: Path, *, message: bytes | None = None) -> Path:
    """Return a copy of the lesson's solution; `message` is put before its message's text."""
    copy = folder / "ana"
    shutil.copytree(SOLUTION, copy)
    if message is not None:
        file = copy / MESSAGE
        file.write_bytes(message + file.read_bytes())
    return copy


def lesson() -> Assignment:
    return load_assignment(LESSON, known_checks=CHECKS)


@pytest.mark.parametrize("case", [case for case, one in WRONG.items() if one[0] == "msg/A.msg"])
def test_each_fault_fails_the_check_of_the_fields_with_a_reason_and_a_change(
    case: str, tmp_path: Path
) -> None:
    _, data, _, _ = WRONG[case]
    path = handed_in(tmp_path, message=data.rstrip() + b"\n")
    results = {r.id: r for r in evaluate_static(take_in_for(lesson(), path), lesson())}
    found = results["message.fields"]
    assert found.status == "failed"
    assert found.where is not None
    assert found.where.file == MESSAGE
    assert found.where.line is not None
    assert found.rationale
    assert found.fix
    assert "{" not in found.rationale + found.fix + found.expected + found.actual


def observed(
    path: Path, unusable: dict[str, str], messages: list[Message] | None = None
) -> dict[str, CheckResult]:
    """Return the results of the lesson's checks after a run with types that could not be used."""
    instants = [0.5 * n for n in range(1, 60)]
    seen = Observations(0.5, unusable=unusable, instants=instants, messages=messages or [])
    run = Run(command="ros2 run", name="drives", seen=seen, started=True)
    run.watch.settled = True
    submission = take_in_for(lesson(), path)
    evidence = Evidence(
        lesson(), submission, build=lambda: BUILT, run=lambda: run, run_of=lambda _: run
    )
    uses = ("listens", "publishes", "before", "during")
    only = ("message.fields", *(f"distance.{use}" for use in uses))
    return {r.id: r for r in evaluate_checks(evidence, Translator("en"), only=only)}


def test_a_check_that_needs_the_type_is_skipped_because_of_it_and_others_go_on(
    tmp_path: Path,
) -> None:
    path = handed_in(tmp_path, message=b"float64 pass\n")
    results = observed(path, {TYPE: "SyntaxError: invalid syntax"})
    assert [m.id for m in results["message.fields"].mistakes] == ["interface.field_reserved"]
    for name in ("distance.publishes", "distance.during"):
        assert (results[name].status, results[name].blocked_by) == ("skipped", "message.fields")
    assert "interface." not in str(results["distance.listens"].mistakes)


@pytest.mark.parametrize(
    ("old", "new", "status"),
    [("float64 speed", "float64 pass", "skipped"), ("float64 speed", "int32 speed", "failed")],
)
def test_a_build_that_an_interface_stops_is_told_by_the_check_of_it(
    old: str, new: str, status: str, tmp_path: Path
) -> None:
    path = handed_in(tmp_path)
    file = path / MESSAGE
    file.write_text(file.read_text("utf-8").replace(old, new), "utf-8")
    log = "Failed   <<< my_robot_interfaces [2.1s, exited with code 2]\n"
    evidence = Evidence(
        lesson(),
        take_in_for(lesson(), path),
        build=lambda: replace(BUILT, status=1, log=log, files={}),
        run=lambda: Run("ros2 run"),
    )
    only = ("message.fields", "build.colcon")
    results = {r.id: r for r in evaluate_checks(evidence, Translator("en"), only=only)}
    assert results["message.fields"].status == "failed"
    assert results["build.colcon"].status == status
    assert status == "failed" or results["build.colcon"].blocked_by == "message.fields"


def test_values_of_a_field_with_another_type_follow_from_the_check_of_the_fields(
    tmp_path: Path,
) -> None:
    path = handed_in(tmp_path)
    file = path / MESSAGE
    file.write_text(file.read_text("utf-8").replace("float64 speed", "int32 speed"), "utf-8")
    values = {"turtle": "turtle1", "distance": 0.0, "speed": 1}
    results = observed(path, {}, [Message("/distance", 1.5, values)])
    assert [m.id for m in results["message.fields"].mistakes] == ["interface.field_type"]
    assert results["distance.before"].status == "skipped"
    assert results["distance.before"].blocked_by == "message.fields"


def test_a_type_that_cannot_be_used_for_an_unknown_reason_is_told_with_its_file(
    tmp_path: Path,
) -> None:
    results = observed(handed_in(tmp_path), {TYPE: "MemoryError"})
    found = results["distance.publishes"]
    assert [m.id for m in found.mistakes] == ["interface.unusable"]
    assert found.actual == "MemoryError"
    assert found.where is not None
    assert found.where.file == MESSAGE


def test_a_package_that_is_not_there_prevents_the_checks_that_need_it(tmp_path: Path) -> None:
    path = handed_in(tmp_path)
    shutil.rmtree(path / "my_robot_interfaces")
    results = observed(path, {TYPE: "ModuleNotFoundError: No module named 'my_robot_interfaces'"})
    assert [m.id for m in results["message.fields"].mistakes] == ["interface.missing"]
    assert results["distance.publishes"].blocked_by == "message.fields"


def test_the_probe_gets_the_right_interfaces_of_a_package_and_no_other(tmp_path: Path) -> None:
    path = handed_in(tmp_path, message=b"float64 pass\n")
    (path / "my_robot_interfaces" / "msg" / "Other.msg").write_text("int8 a\n")
    package = take_in_for(lesson(), path).packages[0]
    assert list(texts_of(package).texts) == ["msg/Other.msg"]


def marked(path: Path) -> Report:
    order = Order(
        path=path,
        assignment=lesson(),
        distro=find_distro("jazzy"),
        sandbox="bubblewrap",
        limits=Limits(build_seconds=300),
    )
    return grade(order, unheard)


@pytest.mark.long
@pytest.mark.prefix
@pytest.mark.parametrize(
    ("message", "mistake"),
    [
        (b"float64 pass\n", "field_reserved"),
        (b"float64[60000000] a\n", "too_large"),
        (b"# " + b"y" * LONGEST_TEXT + b"\n", "too_long"),
    ],
)
def test_a_verdict_with_an_unusable_message_is_decided(
    message: bytes, mistake: str, tmp_path: Path
) -> None:
    report = marked(handed_in(tmp_path, message=message))
    found = {check.id: check for check in report.checks}
    assert {check.status for check in report.checks} <= {"passed", "failed", "skipped"}
    assert [m.id for m in found["message.fields"].mistakes] == [f"interface.{mistake}"]
    assert found["distance.publishes"].status in ("failed", "skipped")
    assert "Traceback" not in report.model_dump_json(include={"checks": {"__all__": {"actual"}}})


@pytest.mark.full
@pytest.mark.prefix
def test_the_probe_tries_a_type_in_another_process(ros_jazzy: Ros, tmp_path: Path) -> None:
    """In the sandbox, whose limits cannot be raised: right types can be used, each fault is told."""
    package = tmp_path / "own" / "msg"
    package.mkdir(parents=True)
    (package.parent / "__init__.py").touch()
    wrong = {"raises": "1 / 0", "exits": "import os; os._exit(7)", "eats": "a = bytearray(1 << 40)"}
    (package / "__init__.py").write_text(
        "import sys\nwhich = sys.argv[2].rpartition('/')[2]\n"
        + "".join(f"if which == {name!r}:\n    {code}\n" for name, code in wrong.items())
    )
    right = ("std_msgs/msg/String", "rcl_interfaces/srv/GetParameters")
    _, text = in_probe("messages")
    names = [*right, *(f"own/msg/{name}" for name in (*wrong, "lacks"))]
    code = (
        f"{text}\nimport os\nos.environ['PYTHONPATH'] += ':' + {str(tmp_path)!r}\n"
        f"print(json.dumps([why_unusable(name) for name in {names!r}]))\n"
    )
    script = f'. "{ros_jazzy.path}/setup.bash"; ulimit -v 2500000; exec python3 -c "$0"'
    done = subprocess.run(
        ["bash", "-c", script, code], capture_output=True, text=True, check=True, timeout=300
    )
    first, second, raised, exited, eaten, lacking = json.loads(done.stdout)
    assert first == second == ""
    assert raised == "ZeroDivisionError: division by zero"
    assert exited == "status 7"
    assert eaten == "MemoryError"
    assert lacking.startswith("AttributeError")
