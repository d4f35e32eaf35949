"""What `package.manifest` looks at: package.xml, and whether setup.py has the same name."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from grader.checks.parsed import file_of
from grader.checks.parsed import meant
from grader.checks.parsed import names_in
from grader.checks.parsed import nearest
from grader.checks.parsed import setup_py_of
from grader.checks.registry import Failed
from grader.checks.registry import Passed
from grader.intake.notes import shown
from grader.report.model import Where
from grader.source.manifest import REQUIRED
from grader.source.manifest import Element
from grader.source.manifest import Manifest
from grader.source.manifest import ManifestError
from grader.source.manifest import read_manifest

if TYPE_CHECKING:
    from grader.evidence import Evidence

FILE = "package.xml"
BUILD_TYPE = "<export><build_type>ament_python</build_type></export>"
WHY = "colcon reads package.xml to learn the package's name and how to build it."
DEGRADES = (
    WHY + " From one that it cannot use it falls back to plain Python: the build says that it "
    "finished, and ros2 run says Package not found."
)
COMMON = (
    *("rclpy", "rclcpp", "std_msgs", "std_srvs", "geometry_msgs", "sensor_msgs", "nav_msgs"),
    *("visualization_msgs", "trajectory_msgs", "action_msgs", "builtin_interfaces"),
    *("example_interfaces", "rcl_interfaces", "rosgraph_msgs", "turtlesim", "tf2_ros", "tf2_py"),
    *("launch", "launch_ros", "ament_index_python", "ros2launch", "cv_bridge", "image_transport"),
    *("ament_copyright", "ament_flake8", "ament_pep257", "ament_xmllint", "ament_mypy"),
    *("ament_lint_auto", "ament_lint_common", "ament_cmake", "ament_python", "rviz2", "xacro"),
    *("robot_state_publisher", "joint_state_publisher", "python3-pytest", "python3-setuptools"),
)


def check_manifest(evidence: Evidence) -> Passed:
    """Judge package.xml; Failed names the first thing that is wrong."""
    manifest = _read(evidence)
    _check_build_type_place(manifest)
    _check_rules(manifest)
    _check_name(evidence, manifest)
    _check_setup_name(evidence)
    _check_build_type(manifest)
    return Passed(actual=f"{manifest.name}, ament_python", advice=_advice(manifest))


def _failed(
    mistake: str,
    actual: str,
    fix: str,
    line: int | None,
    expected: str = "a valid package.xml",
    rationale: str = DEGRADES,
    **params: str,
) -> Failed:
    return Failed(
        expected=expected,
        actual=actual,
        where=Where(file=FILE, line=line),
        rationale=rationale,
        fix=fix,
        mistake=mistake,
        params=dict(params),
    )


def _read(evidence: Evidence) -> Manifest:
    file = file_of(evidence, FILE)
    if file is None:
        close = nearest(FILE, names_in(evidence, ""), cutoff=0.75)
        raise _failed(
            "package.no_manifest",
            f"there is no package.xml{meant(close)}",
            f"Rename {shown(close)} to package.xml."
            if close
            else "Copy package.xml from a package that ros2 pkg create makes, and set its <name>.",
            None,
        )
    if file.unreadable:
        raise _failed(
            "package.manifest_unreadable",
            f"package.xml has no content here: {file.reason}",
            "Hand in a package.xml that can be read.",
            None,
        )
    try:
        return read_manifest(file.data)
    except ManifestError as error:
        raise _unusable(error, empty=not file.data.strip()) from None


def _unusable(error: ManifestError, *, empty: bool) -> Failed:
    text = shown(error.text)
    if error.kind == "doctype":
        return _failed(
            "package.manifest_doctype",
            f"{text}: it is not read any further",
            "Delete the <!DOCTYPE …> line: no package.xml needs one.",
            error.line,
        )
    if error.kind != "xml":
        return _failed("package.manifest_rules", text, "Mend what is named.", error.line)
    return _failed(
        "package.broken_xml",
        "package.xml is empty" if empty else f"it is not well-formed XML: {text}",
        "Write it anew: save it in the editor, or copy one that ros2 pkg create makes."
        if empty
        else "Look at that line and the one above: each <tag> needs its </tag>, and & is &amp;.",
        error.line,
        error=text,
    )


def _check_rules(manifest: Manifest) -> None:
    for tag in REQUIRED:
        element = manifest.first(tag)
        if element is None or (not element.text and tag != "description"):
            what = "is empty" if element else "is missing"
            raise _failed(
                "package.manifest_tag",
                f"<{tag}> {what}",
                f"Add <{tag}>…</{tag}> inside <package>."
                if element is None
                else f"Write something between <{tag}> and </{tag}>.",
                element.line if element else None,
                expected=f"<{tag}> with something in it",
                tag=tag,
            )
    if manifest.fault:
        raise _failed(
            "package.manifest_rules",
            shown_long(manifest.fault),
            "Change what is named, so that colcon accepts the file.",
            _line_of_fault(manifest),
            error=shown_long(manifest.fault),
        )


def shown_long(text: str) -> str:
    """Return a message that may be longer than a name."""
    return " ".join(shown(part) for part in text.split()[:60])


def _line_of_fault(manifest: Manifest) -> int | None:
    """Return the line of the tag that catkin_pkg's message is about, if it names one."""
    for element in manifest.elements:
        tag = element.tag
        if any(f"{mark}{tag}{mark}" in manifest.fault for mark in "\"'") or (
            f"following tags: {tag}" in manifest.fault
        ):
            return element.line
    return None


def _check_name(evidence: Evidence, manifest: Manifest) -> None:
    package = evidence.assignment.package
    if manifest.name == package:
        return
    element = manifest.first("name")
    name = shown(manifest.name)
    raise _failed(
        "package.name_mismatch",
        f"<name>{name}</name>",
        f"Write <name>{package}</name>.",
        element.line if element else None,
        expected=f"<name>{package}</name>",
        rationale="colcon and ros2 run know the package by the name in package.xml. The names in "
        "package.xml, setup.py, setup.cfg and resource/ must be equal.",
        name=name,
        file=FILE,
    )


def _check_setup_name(evidence: Evidence) -> None:
    package = evidence.assignment.package
    setup = setup_py_of(evidence)
    name = setup.name if setup is not None else None
    if name is None or name.value == package:
        return
    raise Failed(
        expected=f"setup.py: name='{package}', as in package.xml",
        actual=f"setup.py: name='{shown(name.value)}'",
        where=Where(file="setup.py", line=name.line),
        rationale="Python installs the package under setup.py's name and ROS looks for that of "
        "package.xml: the two must be equal.",
        fix=f"Give name (or package_name) in setup.py the value '{package}'.",
        mistake="package.name_mismatch",
        params={"name": shown(name.value), "file": "setup.py"},
    )


def _check_build_type_place(manifest: Manifest) -> None:
    for element in manifest.all("build_type"):
        raise _build_type(element, "<build_type> stands outside of <export>")


def _check_build_type(manifest: Manifest) -> None:
    elements = manifest.all("build_type", within="export")
    if not elements:
        raise _build_type(manifest.first("export"), "there is no <build_type>")
    if len(elements) > 1:
        raise _build_type(elements[1], f"there are {len(elements)} <build_type> tags")
    if elements[0].text != "ament_python":
        raise _build_type(elements[0], f"<build_type>{shown(elements[0].text)}</build_type>")


def _build_type(element: Element | None, actual: str) -> Failed:
    cmake = "cmake" in actual
    return _failed(
        "package.build_type",
        actual,
        "Delete the package and make it again with: ros2 pkg create --build-type ament_python, "
        "or (if only this line is wrong) write ament_python."
        if cmake
        else f"Write in package.xml: {BUILD_TYPE}",
        element.line if element else None,
        expected=BUILD_TYPE,
        rationale="The build type tells colcon how to build: without ament_python it takes the "
        "package for a C++ one and looks for a CMakeLists.txt.",
        build_type=element.text[:80] if element and element.text.isprintable() else "",
    )


def _advice(manifest: Manifest) -> list[str]:
    """Return what could be better and costs nothing."""
    names = {element.text: element.line for element in manifest.depends}
    advice = []
    if "rclpy" not in names:
        advice.append(
            "package.xml does not say that the package needs rclpy: add <depend>rclpy</depend>. It "
            "runs here because rclpy is installed anyway."
        )
    for name, line in sorted(names.items()):
        close = "" if name in COMMON else nearest(name, COMMON, cutoff=0.8)
        if close:
            advice.append(
                f"package.xml, line {line}: the dependency '{shown(name)}' is not known"
                f"{meant(close)}"
            )
        elif name in sys.stdlib_module_names:
            advice.append(
                f"package.xml, line {line}: '{name}' is part of Python and needs no dependency."
            )
    return advice[:5]
