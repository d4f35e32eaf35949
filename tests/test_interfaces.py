"""Packages of interfaces: what is built of them, by whom, and what a package cannot change."""

from __future__ import annotations

import io
import shutil
import tarfile
from dataclasses import replace
from pathlib import Path

import pytest

from grader.base.cache import cache_root
from grader.base.errors import AssignmentError, SurroundingsError
from grader.base.unheard import unheard
from grader.cli.main import main
from grader.course.load import load_assignment
from grader.package.source.interface import message_text
from grader.package.source.interface_faults import MOST_TEXTS
from grader.package.submission import take_in
from grader.report.model import Report
from grader.ros import interfaces
from grader.ros.distro import find_distro
from grader.ros.interface_package import interface_package
from grader.ros.prefix import Ros
from grader.run.student_interfaces import texts_of
from grader.verdict.checks.all import CHECKS, STATIC
from grader.verdict.evidence_file import changed_files
from grader.verdict.mark import grade
from grader.verdict.order import Order
from grader.verdict.static import evaluate_static
from grader.verdict.take_in import take_in_for
from tests.marking import LIMITS
from tests.processes import ROOT

SOLUTION = ROOT / "grader" / "keys" / "own_message" / "solution"
ASSIGNMENT = ROOT / "lab" / "course" / "own_message" / "assignment.yaml"
MESSAGE = "my_robot_interfaces/msg/Distance.msg"
CMAKE = "my_robot_interfaces/CMakeLists.txt"
MANIFEST = "my_robot_interfaces/package.xml"
NODE = "my_robot_controller/my_robot_controller/measure_distance.py"


def changed(folder: Path, *edits: tuple[str, str, str]) -> Path:
    """Return a copy of the solution with texts replaced: file, old, new."""
    copy = folder / "ana"
    shutil.copytree(SOLUTION, copy)
    for path, old, new in edits:
        file = copy / path
        text = file.read_text(encoding="utf-8")
        assert text.count(old) == 1, (path, old)
        file.write_text(text.replace(old, new), encoding="utf-8")
    return copy


def marked(path: Path, *, distro: str = "jazzy") -> Report:
    order = Order(
        path=path,
        assignment=load_assignment(ASSIGNMENT, known_checks=CHECKS),
        distro=find_distro(distro),
        sandbox="bubblewrap",
        limits=replace(LIMITS, build_seconds=300),
    )
    return grade(order, unheard)


def test_a_machine_without_a_compiler_is_told_what_to_install(
    ros_jazzy: Ros, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GRADER_CACHE", str(tmp_path))
    folder = tmp_path / "prefixes" / ros_jazzy.path.name
    folder.mkdir(parents=True)
    monkeypatch.setattr(shutil, "which", lambda _: None)
    with pytest.raises(SurroundingsError) as told:
        interfaces.with_interfaces(replace(ros_jazzy, path=folder), notify=unheard)
    assert "no g++, make" in str(told.value)
    assert "apt-get install python3-dev g++ make" in str(told.value.remedy)
    assert [p.name for p in folder.parent.iterdir()] == [folder.name]


def test_a_lab_that_does_not_need_turtlesim_opens_without_it(
    ros_jazzy: Ros, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def no_network(*_: object) -> None:
        raise SurroundingsError("pip reaches no index")

    monkeypatch.setenv("GRADER_CACHE", str(tmp_path))
    folder = tmp_path / "prefixes" / ros_jazzy.path.name
    folder.mkdir(parents=True)
    monkeypatch.setattr(interfaces, "install", no_network)
    monkeypatch.setattr(interfaces, "missing_for_building", list)
    monkeypatch.setattr(interfaces, "_require_compiler", lambda _: None)
    ros, said = replace(ros_jazzy, path=folder), list[str]()
    assert interfaces.with_turtlesim(ros, notify=said.append) == ros
    assert said[-1] == "turtlesim is not in this lab: pip reaches no index"
    system = replace(ros, kind="system", path=tmp_path)
    assert interfaces.with_turtlesim(system, notify=unheard) == system


def test_a_system_installation_is_not_changed(ros_jazzy: Ros, tmp_path: Path) -> None:
    system = replace(ros_jazzy, kind="system", path=tmp_path)
    with pytest.raises(SurroundingsError) as told:
        interfaces.with_interfaces(system, notify=unheard)
    assert "ros-jazzy-turtlesim" in str(told.value.remedy)
    kilted = replace(system, distro=find_distro("kilted"))
    with pytest.raises(SurroundingsError) as told:
        interfaces.with_interfaces(kilted, notify=unheard)
    assert "ros-kilted-turtlesim-msgs" in str(told.value.remedy)


@pytest.mark.parametrize(
    "path",
    ["CMakeLists.txt", "../a.msg", "msg/lower.msg", "msg/A.srv", 'msg/A".msg', "msg/A b.msg"],
)
def test_only_texts_of_interfaces_get_into_our_package(path: str) -> None:
    with pytest.raises(ValueError, match="not the files"):
        interface_package("a_package", {path: "int32 a"})
    with pytest.raises(ValueError, match="not the files"):
        interface_package("a;package", {"msg/A.msg": "int32 a"})


def test_texts_are_bounded_and_the_rest_of_the_package_is_left_out(tmp_path: Path) -> None:
    copy = changed(tmp_path)
    folder = copy / "my_robot_interfaces"
    (folder / "msg" / "Huge.msg").write_text("int32 a\n" * 10_000)
    for n in range(2 * MOST_TEXTS):
        (folder / "msg" / f"M{n}.msg").write_text("geometry_msgs/Twist a\n")
    found = take_in(
        copy,
        package="my_robot_controller",
        node_file="measure_distance.py",
        others=["my_robot_interfaces"],
    )
    texts = texts_of(found.packages[0])
    assert len(texts.texts) == MOST_TEXTS - 1  # (Huge.msg is among the first files)
    assert "msg/Huge.msg" not in texts.texts
    assert texts.uses == ("geometry_msgs",)


def test_the_other_package_is_part_of_the_submissions_hash(tmp_path: Path) -> None:
    def digest(path: Path, *others: str) -> str:
        found = take_in(
            path, package="my_robot_controller", node_file="measure_distance.py", others=others
        )
        return found.sha256

    before = digest(SOLUTION, "my_robot_interfaces")
    copy = changed(tmp_path, (MESSAGE, "float64 speed", "float32 speed"))
    assert digest(copy, "my_robot_interfaces") != before
    assert digest(copy) == digest(SOLUTION) != before


def test_a_changed_message_is_named_by_its_file(tmp_path: Path) -> None:
    assignment = load_assignment(ASSIGNMENT, known_checks=CHECKS)
    copy = changed(tmp_path, (MESSAGE, "float64 speed", "float32 speed"))
    versions = [take_in_for(assignment, path) for path in (SOLUTION, copy)]
    assert changed_files(*versions) == [f"../{MESSAGE}"]


def test_fix_sees_the_interface_package_too(capsys: pytest.CaptureFixture[str]) -> None:
    main(["fix", "--no-run", "--assignment", "own_message", str(SOLUTION)])
    said = capsys.readouterr()
    assert "message." not in said.out + said.err


@pytest.mark.prefix
@pytest.mark.long
def test_fix_builds_the_interface_package_too() -> None:
    assert main(["fix", "--assignment", "own_message", str(SOLUTION)]) == 0


def test_the_lines_of_a_message() -> None:
    found = message_text(
        "# a comment\nfloat64 x  # m\nstring<=10 name 'a'\nint32[<=3] few\n"
        "uint8 ON = 1\ngeometry_msgs/Twist[2] two\nfloat64\n"
    )
    assert [(one.type, one.name, one.constant) for one in found.declared] == [
        ("float64", "x", ""),
        ("string<=10", "name", ""),
        ("int32[<=3]", "few", ""),
        ("uint8", "ON", "1"),
        ("geometry_msgs/Twist[2]", "two", ""),
    ]
    assert found.unknown == (7,)


@pytest.mark.parametrize(
    ("edit", "check", "mistake"),
    [
        (
            (MANIFEST, "<build_type>ament_cmake", "<build_type>ament_python"),
            "message.package",
            "interface.not_cmake",
        ),
        (
            (MANIFEST, "  <member_of_group>rosidl_interface_packages</member_of_group>\n", ""),
            "message.package",
            "interface.no_group",
        ),
        (
            (MANIFEST, "  <buildtool_depend>rosidl_default_generators</buildtool_depend>\n", ""),
            "message.package",
            "interface.no_generators",
        ),
        ((MANIFEST, "</package>", ""), "message.package", "interface.manifest"),
        ((CMAKE, '  "msg/Distance.msg"\n', ""), "message.package", "interface.not_generated"),
        (
            (CMAKE, '  "msg/Distance.msg"', '#  "msg/Distance.msg"'),
            "message.package",
            "interface.not_generated",
        ),
        (
            (CMAKE, "find_package(rosidl_default_generators REQUIRED)\n", ""),
            "message.package",
            "interface.not_found_in_cmake",
        ),
        ((MESSAGE, "float64 speed", "float64 Speed"), "message.fields", "interface.field_name"),
        ((MESSAGE, "float64 speed", "float64 sped"), "message.fields", "interface.field_missing"),
        (
            (MESSAGE, "float64 distance", "float32 distance"),
            "message.fields",
            "interface.field_type",
        ),
        ((MESSAGE, "string turtle", "string turtle;"), "message.fields", "interface.line_unknown"),
    ],
)
def test_what_the_files_of_an_interface_package_show(
    edit: tuple[str, str, str], check: str, mistake: str, tmp_path: Path
) -> None:
    assignment = load_assignment(ASSIGNMENT, known_checks=CHECKS)
    found = take_in(
        changed(tmp_path, edit),
        package=assignment.package,
        node_file=assignment.node_file,
        others=assignment.interface_packages,
    )
    results = evaluate_static(found, assignment, only=STATIC)
    failed = {one.id: one.mistakes[0].id for one in results if one.status == "failed"}
    assert failed == {check: mistake}


@pytest.mark.parametrize(
    ("written", "told"),
    [
        ("float64 sped", "If sped is meant to be this field, rename it to speed"),
        ("float64 metres_a_second", "If metres_a_second is meant to be this field, rename it"),
        ("bool moves", "Add the line: float64 speed"),
    ],
)
def test_a_field_with_another_name_is_to_be_renamed(
    written: str, told: str, tmp_path: Path
) -> None:
    assignment = load_assignment(ASSIGNMENT, known_checks=CHECKS)
    found = take_in(
        changed(tmp_path, (MESSAGE, "float64 speed", written)),
        package=assignment.package,
        node_file=assignment.node_file,
        others=assignment.interface_packages,
    )
    (failed,) = (r for r in evaluate_static(found, assignment, only=STATIC) if r.status == "failed")
    assert failed.fix.startswith(told)
    assert failed.where is not None
    assert (failed.where.line is not None) == told.startswith("If")


HOSTILE = """
ament_package()
file(WRITE ${CMAKE_INSTALL_PREFIX}/../../.cache/evil "evil")
install(CODE "file(GLOB_RECURSE all ${CMAKE_INSTALL_PREFIX}/lib/*.so)
foreach(one \\${all})
  file(WRITE \\${one} evil)
endforeach()")
"""


@pytest.mark.prefix
@pytest.mark.long
def test_what_a_students_cmake_makes_does_not_get_into_the_cache(tmp_path: Path) -> None:
    place = cache_root() / "interfaces"
    before = set(place.glob("*.tar"))
    report = marked(
        changed(
            tmp_path,
            (CMAKE, "\nament_package()\n", HOSTILE),
            (MESSAGE, "float64 speed # m/s", f"float64 speed # {tmp_path.name}"),
        )
    )
    failed = {c.id for c in report.checks if c.status == "failed"}
    assert failed & {"run.starts", "build.colcon"}  # the node's own libraries are spoilt
    (made,) = set(place.glob("*.tar")) - before
    try:
        with tarfile.open(fileobj=io.BytesIO(made.read_bytes())) as tar:
            libraries = [m for m in tar.getmembers() if m.name.endswith(".so") and m.isfile()]
            heads = {tar.extractfile(m).read(4) for m in libraries}  # type: ignore[union-attr]
        assert heads == {b"\x7fELF"}
        assert len(libraries) >= 5
    finally:
        made.unlink()


@pytest.mark.parametrize(
    ("fields", "actual", "line"),
    [
        ({"led": "int64", "state": "bool", "success": "bool"}, None, None),
        ({"request.led": "int64", "response.success": "bool"}, None, None),
        ({"request.success": "bool"}, "response.success", 5),
        ({"response.led": "int64"}, "request.led", 2),
        ({"response.sucess": "bool"}, "success", 5),
        ({"response.success": "string"}, "bool response.success", 5),
    ],
)
def test_the_fields_of_a_service_are_judged_in_their_part(
    fields: dict[str, str], actual: str | None, line: int | None, tmp_path: Path
) -> None:
    copy = changed(tmp_path, (CMAKE, '  "msg/Distance.msg"', '  "srv/SetLed.srv"'))
    folder = copy / "my_robot_interfaces" / "srv"
    folder.mkdir()
    text = "# the LED\nint64 led\nbool state\n---\nbool success\n"
    (folder / "SetLed.srv").write_text(text, encoding="utf-8")
    assignment = load_assignment(ASSIGNMENT, known_checks=CHECKS)
    use = next(one for one in assignment.checks if one.kind == "interface.fields")
    given = {"type": "my_robot_interfaces/srv/SetLed", "fields": fields}
    uses = (assignment.checks[0], use.model_copy(update={"with_": given}))
    found = take_in_for(assignment, copy)
    (*_, result) = evaluate_static(
        found, assignment.model_copy(update={"checks": uses}), only=STATIC
    )
    if actual is None:
        assert result.status == "passed"
    else:
        assert result.status == "failed"
        assert actual in result.actual
        assert result.where is not None
        assert result.where.line == line


def test_a_part_that_a_service_does_not_have_is_told_when_the_file_is_loaded(
    tmp_path: Path,
) -> None:
    text = ASSIGNMENT.read_text(encoding="utf-8").replace(
        "type: my_robot_interfaces/msg/Distance, fields: {turtle: string",
        "type: my_robot_interfaces/srv/Distance, fields: {respons.turtle: string",
    )
    file = tmp_path / "assignment.yaml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(AssignmentError, match=r"no part 'respons' .did you mean 'response'"):
        load_assignment(file, known_checks=CHECKS)


@pytest.mark.prefix
@pytest.mark.full
def test_a_package_that_only_a_wrong_import_needs_is_not_asked_for(tmp_path: Path) -> None:
    old = (
        "try:\n    from turtlesim.msg import Pose\nexcept ImportError:\n"
        "    from turtlesim_msgs.msg import Pose  # from ROS kilted on\n"
    )
    report = marked(changed(tmp_path, (NODE, old, "from geometry_msgs.msg import Pose\n")))
    hears = report.check("distance.listens")
    assert "+from turtlesim.msg import Pose\n" in hears.patch
    depends = report.check("package.depends")
    assert depends.status == "failed"
    assert depends.consequence_of == "distance.listens"
    assert "<depend>" not in depends.fix + depends.patch
