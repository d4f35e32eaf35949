"""The check `package.manifest`: package.xml, and whether setup.py has the same name."""

from __future__ import annotations

import re
import shlex
import sys
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from grader.base.i18n.message import Message, Value, joined, say
from grader.base.nearest import meant, nearest, there_is, with_difference
from grader.base.shown import shown
from grader.package.source.broken_xml import TAGS, xml_fault
from grader.package.source.manifest import (
    DEPENDS,
    REQUIRED,
    Element,
    Manifest,
    ManifestError,
    meant_package,
    read_manifest,
)
from grader.package.source.manifest_rules import line_of_rule
from grader.report.model import Where
from grader.verdict.checks.parsed import (
    file_of,
    in_inner_folder,
    names_in,
    printable_reason,
    setup_py_of,
)
from grader.verdict.outcome import Failed, Passed

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

FILE = "package.xml"
OF_ROS_1 = {"rospy": "rclpy", "roscpp": "rclcpp"}
BUILD_TYPE = "<export><build_type>ament_python</build_type></export>"
XML_FAULTS = {  # expat's most frequent messages, so that they can be translated
    str(fault): fault
    for fault in (
        say("mismatched tag"),
        say("not well-formed (invalid token)"),
        say("no element found"),
        say("unclosed token"),
        say("undefined entity"),
        say("junk after document element"),
        say("duplicate attribute"),
        say("XML or text declaration not at start of entity"),
    )
}


def check_manifest(evidence: Evidence) -> Passed:
    """Check package.xml; raise Failed for the first fault."""
    manifest = _read(evidence)
    _check_build_type_place(manifest)
    _check_rules(evidence, manifest)
    _check_name(evidence, manifest)
    _check_setup_name(evidence)
    _check_build_type(evidence, manifest)
    asked = any(use.kind == "package.depends" for use in evidence.assignment.checks)
    own = {one.name for one in evidence.submission.packages}
    own |= {*evidence.assignment.interface_packages}
    advice = _advice(manifest, own, asked=asked)
    return Passed(actual=f"{manifest.name}, ament_python", advice=advice)


def _failed(
    mistake: str,
    actual: str,
    line: int | None,
    *,
    expected: str = "",
    variant: str = "",
    params: Mapping[str, str | int | float] | None = None,
    words: Mapping[str, Value] | None = None,
    file: str = FILE,
) -> Failed:
    return Failed(
        mistake,
        expected=expected or say("a valid package.xml"),
        actual=actual,
        where=Where(file=file, line=line),
        variant=variant,
        params=params,
        words=words,
    )


def _read(evidence: Evidence) -> Manifest:
    file = file_of(evidence, FILE)
    if file is None:
        inner = in_inner_folder(evidence, FILE)
        close = nearest(FILE, names_in(evidence, ""), cutoff=0.75)
        said = with_difference(say("there is no package.xml") + there_is(close), close, FILE)
        if inner:
            said = say("there is no {path}, but {there}", path=FILE, there=shown(inner))
        other = shown(inner or close)
        raise _failed(
            "package.no_manifest",
            said,
            None,
            variant="renamed" if other else "",
            params={"there": other},
            words={"there": shlex.quote(other), "package": evidence.assignment.package},
            file=other or FILE,
        )
    if file.unreadable:
        reason = printable_reason(file.reason)
        raise _failed(
            "package.manifest_unreadable",
            say("package.xml cannot be read: {reason}", reason=reason),
            None,
        )
    try:
        found = read_manifest(file.data)
    except ManifestError as error:
        raise _unusable(error, file.data) from None
    try:
        file.data.decode("utf-8")
    except UnicodeDecodeError:
        raise _failed(
            "package.manifest_unreadable",
            say("package.xml cannot be read: {reason}", reason=say("not UTF-8 text")),
            1,
            variant="encoding",
        ) from None
    return found


def _unusable(error: ManifestError, found: bytes) -> Failed:
    text = XML_FAULTS.get(error.text) or printable_reason(error.text)
    if error.kind == "doctype":
        actual: str = say("{text}: the rest of the file is not read", text=text)
        return _failed("package.manifest_doctype", actual, error.line)
    if error.kind != "xml":
        return _failed("package.manifest_rules", text, error.line)
    fault, params = xml_fault(found), {"error": str(text)}
    if not found.strip():
        said = say("package.xml is empty")
        return _failed("package.broken_xml", said, error.line, params=params)
    if fault is None:
        return _failed("package.broken_xml", text, error.line, params=params)
    tag, wanted = shown(fault.tag), shown(fault.wanted)
    words = {"tag": tag, "name": tag.removeprefix("/"), "wanted": wanted}
    texts = {
        "unclosed": say("<{tag}> is not closed: its </{tag}> is missing", **words),
        "unopened": say("<{tag}> closes nothing: its <{name}> is missing", **words),
        "misspelt": say("<{tag}> should be <{wanted}>", **words),
    }
    return _failed(
        "package.broken_xml",
        texts[fault.variant],
        fault.line,
        variant=fault.variant,
        params=params,
        words=words,
    )


WANTED = {
    "version": "<version>0.0.0</version>",
    "maintainer": '<maintainer email="student@todo.todo">student</maintainer>',
    "license": "<license>Apache-2.0</license>",
}
"""How a required tag can be written."""


def _check_rules(evidence: Evidence, manifest: Manifest) -> None:
    for tag in REQUIRED:
        element = manifest.first(tag)
        if element is None:
            _check_tag_name(manifest, tag, within="package")
        if element is None or (not element.text and tag != "description"):
            has_tags = any(inside.within == tag for inside in manifest.elements)
            actual = say("<{tag}> is missing", tag=tag)
            if element is not None:
                actual = say("<{tag}> is empty", tag=tag)
            if has_tags:
                actual = say("<{tag}> contains only other tags", tag=tag)
            package = evidence.asked.package
            wanted = f"<name>{package}</name>" if tag == "name" else f"<{tag}>…</{tag}>"
            raise _failed(
                "package.manifest_tag",
                actual,
                element.line if element else None,
                expected=say("<{tag}> that is not empty", tag=tag),
                params={"tag": tag},
                words={"wanted": WANTED.get(tag, wanted)},
            )
    if manifest.fault:
        said = shown_long(manifest.fault)
        params = {"error": said}
        raise _failed("package.manifest_rules", said, line_of_rule(manifest), params=params)


def _check_tag_name(manifest: Manifest, tag: str, *, within: str) -> None:
    """Raise Failed if an unknown tag's name is nearly that of a missing tag."""
    unknown = {e.tag: e for e in manifest.elements if e.within == within and e.tag not in TAGS}
    close = nearest(tag, unknown, cutoff=0.75)
    if not close:
        return
    missing = say("<{tag}> is missing", tag=tag) + there_is(close)
    raise _failed(
        "package.build_type" if tag == "build_type" else "package.manifest_tag",
        with_difference(missing, close, tag),
        unknown[close].line,
        expected=BUILD_TYPE if tag == "build_type" else say("<{tag}> that is not empty", tag=tag),
        variant="renamed",
        params={"tag": tag, "close": shown(close)},
    )


def shown_long(text: str) -> str:
    """Return a message in printable form; unlike `shown`, it may be longer than a name."""
    return " ".join(shown(part) for part in text.split()[:60])


def _check_name(evidence: Evidence, manifest: Manifest) -> None:
    package = evidence.asked.package
    if manifest.name == package:
        return
    element = manifest.first("name")
    name = shown(manifest.name)
    throughout = evidence.assignment.package != package
    raise _failed(
        "package.name_mismatch",
        with_difference(Message("<name>{name}</name>", {"name": name}), name, package),
        element.line if element else None,
        expected=f"<name>{package}</name>",
        variant="throughout" if throughout else "",
        params={"name": name, "file": FILE},
        words={"package": package},
    )


def _check_setup_name(evidence: Evidence) -> None:
    package = evidence.assignment.package
    setup = setup_py_of(evidence)
    name = setup.name if setup is not None else None
    if name is None or name.value == package:
        return
    found = shown(name.value)
    raise Failed(
        "package.name_mismatch",
        expected=say("setup.py: name='{package}', as in package.xml", package=package),
        actual=with_difference(f"setup.py: name='{found}'", found, package),
        where=Where(file="setup.py", line=name.line),
        variant="setup",
        params={"name": found, "file": "setup.py"},
        words={"package": package},
    )


def _check_build_type_place(manifest: Manifest) -> None:
    """Raise Failed for a <build_type> that is not in <export>."""
    for element in manifest.elements:
        if element.tag != "build_type" or element.within == "export":
            continue
        if element.within not in TAGS and nearest("export", [element.within], cutoff=0.75):
            continue  # the name of the tag around it is wrong
        outside = say("<build_type> is outside of <export>")
        if element.within != "package":
            outside = say(
                "<build_type> is in <{within}>, and not directly in <export>", within=element.within
            )
        raise _build_type(element, outside)


def _check_build_type(evidence: Evidence, manifest: Manifest) -> None:
    elements = manifest.effective("build_type", within="export")
    if not elements:
        _check_tag_name(manifest, "build_type", within="export")
        export, missing = manifest.first("export"), say("there is no <build_type>")
        if left_out := manifest.all("build_type", within="export"):
            named = min(left_out, key=lambda element: element.text != "ament_python")
            condition = shown(named.attributes.get("condition", ""))
            never = say("the condition {condition} is not true in ROS 2", condition=condition)
            raise _build_type(named, never)
        raise _build_type(export, missing)
    if len(elements) > 1:
        many = say("there are {count} <build_type> tags", count=len(elements))
        raise _build_type(elements[1], many)
    if elements[0].text != "ament_python":
        _check_created(evidence, elements[0])
        said = f"<build_type>{shown(elements[0].text)}</build_type>"
        differs = with_difference(said, elements[0].text, "ament_python")
        created = "cmake" in elements[0].text and bool(_not_there(evidence))
        raise _build_type(elements[0], differs, "cmake" if created else "")


def _check_created(evidence: Evidence, element: Element) -> None:
    """Raise Failed if the whole package was created for C++, and not only this line is wrong."""
    assignment = evidence.assignment
    missing = _not_there(evidence)
    has_cmake = evidence.submission.file("CMakeLists.txt") is not None
    if not missing or not has_cmake or "cmake" not in element.text:
        return
    raise _failed(
        "package.created_as_cmake",
        joined(
            f"<build_type>{shown(element.text)}</build_type>",
            say("there is a CMakeLists.txt, but no {files}", files=", ".join(missing)),
            by=", ",
        ),
        element.line,
        expected=BUILD_TYPE,
        params={"missing": missing[0]},
        words={
            "package": assignment.package,
            "node_file": assignment.node_file,
            "entry": f"{assignment.executable} = {assignment.target}",
        },
    )


def _not_there(evidence: Evidence) -> list[str]:
    """Return the files of a Python package that are missing."""
    files = ("setup.py", "setup.cfg", f"resource/{evidence.assignment.package}")
    return [path for path in files if evidence.submission.file(path) is None]


def _build_type(element: Element | None, actual: str, variant: str = "") -> Failed:
    return _failed(
        "package.build_type",
        actual,
        element.line if element else None,
        expected=BUILD_TYPE,
        variant=variant,
        params={"build_type": element.text[:80] if element and element.text.isprintable() else ""},
    )


def _of_ros_1(names: Mapping[str, int]) -> list[str]:
    """Return advice on dependencies that only ROS 1 has."""
    return [
        say(
            "package.xml, line {line}: '{name}' belongs to ROS 1. Delete each line with {name}: the "
            "package depends on {wanted} already.",
            line=names[name],
            name=name,
            wanted=wanted,
        )
        if wanted in names
        else say(
            "package.xml, line {line}: '{name}' belongs to ROS 1. Write {wanted} instead.",
            line=names[name],
            name=name,
            wanted=wanted,
        )
        for name, wanted in OF_ROS_1.items()
        if name in names
    ]


def _misplaced_depend(manifest: Manifest) -> Message | None:
    """Return advice on a dependency on rclpy that is inside of another tag."""
    inside = (e for e in manifest.elements if DEPENDS.fullmatch(e.tag) and e.within != "package")
    element = next((e for e in inside if e.text == "rclpy"), None)
    if element is None:
        return None
    return say(
        "package.xml, line {line}: <{tag}>{name}</{tag}> does not count inside of <{within}>. Move "
        "it out of that tag, so that it is directly inside of <package>. It runs here because "
        "rclpy is installed anyway.",
        line=element.line,
        tag=shown(element.tag),
        name=element.text,
        within=shown(element.within),
    )


def _cpp_library(names: Mapping[str, int]) -> Message | None:
    """Return advice on a dependency on ROS's library for C++, if there is none on Python's."""
    if "rclcpp" not in names:
        return None
    return say(
        "package.xml, line {line}: '{name}' is the library of ROS for C++. A node in Python needs "
        "rclpy: write <depend>rclpy</depend> instead. It runs here because rclpy is installed anyway.",
        line=names["rclcpp"],
        name="rclcpp",
    )


def _advice(manifest: Manifest, own: set[str], *, asked: bool) -> list[str]:
    """Return advice that costs no points; `asked`: a check asks for the dependencies.

    `own` are the packages that are handed in together.
    """
    names = _without(manifest.depends, own)
    advice = _of_ros_1(names)
    parts = {part for name in names for part in re.split(r"[\s,;]+", name)}
    is_named = "rclpy" in parts or any(meant_package(name) == "rclpy" for name in names)
    if not is_named and not asked and not advice:
        advice.append(
            _misplaced_depend(manifest)
            or _cpp_library(names)
            or say(
                "package.xml does not say that the package needs rclpy: add "
                "<depend>rclpy</depend>. It runs here because rclpy is installed anyway."
            )
        )
    for name, line in sorted(names.items()):
        close = meant_package(name)
        if re.search(r"\s", name) and not all(
            re.match("[A-Za-z]", part) for part in re.split(r"[\s,;]+", name)
        ):
            advice.append(
                say(
                    "package.xml, line {line}: '{name}' is not the name of a package: a name has no "
                    "spaces and begins with a letter. Delete this line if the package needs no other "
                    "one.",
                    line=line,
                    name=shown(name),
                )
            )
        elif re.search(r"\S[\s,;]+\S", name):
            advice.append(
                say(
                    "package.xml, line {line}: '{name}' is more than one name. Write a <depend> of "
                    "its own for each package.",
                    line=line,
                    name=shown(name),
                )
            )
        elif close:
            unknown = say(
                "package.xml, line {line}: the dependency '{name}' is not known",
                line=line,
                name=shown(name),
            )
            advice.append(with_difference(unknown + meant(close), name, close))
        elif name in sys.stdlib_module_names:
            advice.append(
                say(
                    "package.xml, line {line}: '{name}' is part of Python and needs no dependency.",
                    line=line,
                    name=name,
                )
            )
    return advice[:5]


def _without(depends: Iterable[Element], own: set[str]) -> dict[str, int]:
    """Return the dependencies that are not handed in together, with their lines."""
    return {element.text: element.line for element in depends if element.text not in own}
