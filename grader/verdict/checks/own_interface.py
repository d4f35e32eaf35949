"""Why an interface of the submission cannot be used: for the checks that need one, and for the build."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from grader.base.i18n.message import Message, say
from grader.course.interfaces import ros_interfaces
from grader.package.source.interface_faults import InterfaceFault, interface_texts
from grader.report.model import Where
from grader.verdict.checks.cmake import CMAKE, cmake_error
from grader.verdict.outcome import Blocked, Failed

if TYPE_CHECKING:
    from grader.package.submission import Package
    from grader.verdict.evidence import Evidence

STOPPED = re.compile(r"^Failed +<<< (\w+)", re.MULTILINE)
NO_MODULE = re.compile(r"^ModuleNotFoundError: No module named '(\w+)(?:\.\w+)*'", re.MULTILINE)
BUILT = ("interface.field_missing", "interface.field_type")
"""What is wrong with an interface that is built all the same."""
MODULE = re.compile(r"/site-packages/(?P<package>\w+)/(?:msg|srv|action)/_\w+\.py")
"""A module that ROS generates for Python, in a traceback."""


def fault_of_type(evidence: Evidence, name: str, reason: str) -> Failed:
    """Return why a type of the submission cannot be used; `reason` is what was seen of it."""
    package_name, kind, message = name.split("/")
    package = evidence.submission.package(package_name)
    if package is None:
        return missing_package(evidence, package_name)
    path = f"{kind}/{message}.{kind}"
    if package.text(path) is None:
        return Failed(
            "interface.file_missing",
            expected=f"{package_name}/{path}",
            actual=say("there is no such file"),
            params={"path": path},
            words={"package": package_name},
        )
    return fault_in(package, path) or Failed(
        "interface.unusable",
        expected=say("an interface {type} that programs can use", type=name),
        actual=reason,
        where=Where(file=f"{package_name}/{path}"),
        words={"type": name},
    )


def fault_of_package(package: Package) -> Failed | None:
    """Return the first fault of a package's interfaces; None if there is none."""
    found = (fault_in(package, path) for path in interface_texts(package).files)
    return next((one for one in found if one is not None), None)


def fault_in(package: Package, path: str) -> Failed | None:
    """Return the fault of one interface; None if there is none, or no such file."""
    texts = interface_texts(package, _is_type)
    fault = texts.fault(path) if path in texts.files else None
    if fault is None:
        return None
    return Failed(
        f"interface.{fault.slug}",
        expected=_expected(fault),
        actual=fault.found or _size(fault),
        where=Where(file=f"{package.name}/{path}", line=fault.line),
        params={"name": fault.words["name"]} if "name" in fault.words else {},
        words=fault.words,
    )


def build_stopped(evidence: Evidence, log: str, expected: str) -> Failed | None:
    """Return why the build of a package of interfaces stopped; None if that did not stop it.

    Raises Blocked if a check of that package has said why.
    """
    stopped = STOPPED.findall(log)
    for use in evidence.assignment.checks:
        about = str(use.with_.get("package") or use.with_.get("type", "")).partition("/")[0]
        told = use.kind.startswith("interface.") and evidence.has_failed(use.id)
        if told and about in stopped and not evidence.has_mistake(use.id, *BUILT):
            raise Blocked(by=use.id)
    for name in stopped:
        package = evidence.submission.package(name)
        found = fault_of_package(package) if package is not None else None
        if found is not None:
            return found
    stop = cmake_error(log)
    if stop is None or evidence.submission.package(stop.package) is None:
        return None
    return Failed(
        "interface.cmake_error",
        expected=expected,
        actual=stop.text,
        where=Where(file=f"{stop.package}/{CMAKE}", line=stop.line),
        params={"line": stop.line},
    )


def fault_in_traceback(evidence: Evidence, text: str) -> Failed | None:
    """Return the fault of the interface that a program could not import, if that is why it ended."""
    absent = NO_MODULE.search(text)
    if absent is not None and absent[1] in evidence.assignment.interface_packages:
        name = absent[1]
        return None if evidence.submission.package(name) else missing_package(evidence, name)
    for found in reversed(list(MODULE.finditer(text))):
        package = evidence.submission.package(found["package"])
        if package is not None:
            return fault_of_package(package)
    return None


def missing_package(evidence: Evidence, name: str) -> Failed:
    """Return the failure of a package that is not in the submission."""
    names = [one.name for one in evidence.submission.candidates]
    own = evidence.assignment.package
    return Failed(
        "interface.missing",
        expected=say("a package {name} beside {package}", name=name, package=own),
        actual=", ".join(names) or "-",
        params={"name": name},
    )


def _is_type(name: str) -> bool | None:
    """Return whether ROS has a type; None for one of a package that is not known."""
    known = ros_interfaces()
    return known.has_type(name) if known.has_package(name.partition("/")[0]) else None


def _expected(fault: InterfaceFault) -> Message:
    words = fault.words
    if fault.slug == "separator":
        return say("a .{kind} file; lines of it that have only ---: {count}", **words)
    return {
        "too_long": say("a file of at most {most} bytes", most=words.get("most", "")),
        "not_utf8": say("text in UTF-8"),
        "line_unknown": say("a type and a name on each line"),
        "field_name": say("lower case letters and digits, with single _ between them"),
        "constant_name": say("capital letters and digits, with single _ between them"),
        "field_reserved": say("a name that Python and C++ do not use themselves"),
        "declared_twice": say("each name once"),
        "type_unknown": say("a type that ROS has, such as float64 or geometry_msgs/Point"),
        "value_range": say("a value that fits the type {type}", type=words.get("type", "")),
        "recursive": say("a message that does not contain itself"),
        "too_large": say("a message of at most {most} MB", most=words.get("most", "")),
    }[fault.slug]


def _size(fault: InterfaceFault) -> Message:
    if fault.slug == "too_long":
        return say("the file has {size} bytes", size=fault.words["size"])
    return say("the file is not UTF-8 text")
