"""Kinds of check for packages of interfaces: their manifest, their CMakeLists.txt, their fields."""

from __future__ import annotations

import re
from bisect import bisect
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from pydantic import Field

from grader.base.i18n.message import say
from grader.base.nearest import nearest, with_difference
from grader.course.interfaces import part_names
from grader.package.source.interface import message_text
from grader.package.source.manifest import ManifestError, read_manifest
from grader.report.model import Where
from grader.verdict.checks.cmake import CMAKE
from grader.verdict.checks.declare import INTAKE, kind
from grader.verdict.checks.own_interface import fault_in, missing_package
from grader.verdict.checks.parameters import Parameters
from grader.verdict.outcome import Blocked, Failed, Passed

if TYPE_CHECKING:
    from grader.course.assignment import Assignment
    from grader.package.source.interface import Declared
    from grader.package.source.manifest import Manifest
    from grader.package.submission import Package
    from grader.verdict.use import Use

GROUP = "rosidl_interface_packages"
GENERATE = re.compile(r"rosidl_generate_interfaces\s*\((?P<words>[^)]*)\)")
COMMENT = re.compile(r"#[^\n]*")
NAMED = re.compile(r"\b(?:msg|srv|action)/\w+\.(?:msg|srv|action)\b")
MANIFEST = "package.xml"
SEPARATOR = "---"  # of the parts of a service or an action


class Interfaces(Parameters):
    """A package of interfaces: built by ament_cmake, in the group of such packages.

    Its CMakeLists.txt generates the `files`, such as msg/Distance.msg.
    """

    package: str
    files: tuple[str, ...] = Field(min_length=1)


class Fields(Parameters):
    """The fields of a message, a service or an action and their types; there may be others.

    `response.success` is a field of that part. Without a part, the field may be in any, or, of a service
    that the assignment calls, in the part in which a call sets it or a check reads it.
    """

    type: str
    fields: dict[str, str] = Field(min_length=1)


@kind("interface.package", Interfaces, stage=INTAKE, depends=["package.found"])
def package(use: Use[Interfaces]) -> Passed:
    """{package} is a package of interfaces with the files {files}"""
    given = use.given
    found = _package(use, given.package)
    own = use.evidence.submission.root or "."
    if own != "." and found.root.startswith(f"{own}/"):
        raise Failed(
            "interface.inside",
            expected=say(
                "a package {name} beside {package}", name=given.package, package=_own(use)
            ),
            actual=found.root,
            words={"package": given.package},
        )
    words = {"package": given.package}
    manifest = _manifest(found)
    place = Where(file=f"{found.name}/{MANIFEST}")
    kinds = [one.text for one in manifest.all("build_type", "export")]
    if kinds != ["ament_cmake"]:
        raise Failed(
            "interface.not_cmake",
            expected="<build_type>ament_cmake</build_type>",
            actual=", ".join(kinds) or "-",
            where=place,
            words=words,
        )
    if GROUP not in [one.text for one in manifest.effective("member_of_group")]:
        raise Failed(
            "interface.no_group",
            expected=f"<member_of_group>{GROUP}</member_of_group>",
            actual=say("there is no such line"),
            where=place,
            words=words,
        )
    if "rosidl_default_generators" not in [one.text for one in manifest.depends]:
        raise Failed(
            "interface.no_generators",
            expected="<buildtool_depend>rosidl_default_generators</buildtool_depend>",
            actual=say("there is no such line"),
            where=place,
            words=words,
        )
    for path in given.files:
        if found.text(path) is None:
            others = [file.path for file in found.files if file.path.endswith(path[-4:])]
            close = nearest(path, others) or next(iter(others), "")
            raise Failed(
                "interface.file_missing",
                expected=f"{found.name}/{path}",
                actual=with_difference(close, close, path)
                if close
                else say("there is no such file"),
                where=Where(file=f"{found.name}/{close}") if close else None,
                params={"path": path},
                words=words,
            )
    _generated(found, given.files)
    return Passed()


def _generated(found: Package, files: tuple[str, ...]) -> None:
    """Raise Failed if CMakeLists.txt does not generate one of the files."""
    text = found.text(CMAKE)
    place = Where(file=f"{found.name}/{CMAKE}")
    if text is None:
        raise Failed(
            "interface.file_missing",
            expected=f"{found.name}/{CMAKE}",
            actual=say("there is no such file"),
            params={"path": CMAKE},
            words={"package": found.name},
        )
    code = COMMENT.sub("", text)
    listed = " ".join(match["words"] for match in GENERATE.finditer(code))
    for path in files:
        if path not in listed and (path not in code or not listed):
            raise Failed(
                "interface.not_generated",
                expected=f'rosidl_generate_interfaces(${{PROJECT_NAME}} "{path}")',
                actual=" ".join(listed.split()) or say("there is no such line"),
                where=place,
                params={"path": path},
                words={"package": found.name},
            )
    for path in NAMED.findall(listed):
        if found.text(path) is None:
            raise Failed(
                "interface.file_missing",
                expected=f"{found.name}/{path}",
                actual=say("there is no such file"),
                where=place,
                params={"path": path},
                words={"package": found.name},
            )
    before = code[: code.find("rosidl_generate_interfaces")].replace(" ", "")
    if "find_package(rosidl_default_generators" not in before:
        raise Failed(
            "interface.not_found_in_cmake",
            expected="find_package(rosidl_default_generators REQUIRED)",
            actual=say("there is no such line"),
            where=place,
        )


@kind(
    "interface.fields",
    Fields,
    stage=INTAKE,
    depends=["package.found"],
    after=["interface.package"],
)
def fields(use: Use[Fields]) -> Passed:
    """The interface {type} has the right fields"""
    name, folder, message = use.given.type.split("/")
    found, path = _package(use, name), f"{folder}/{message}.{folder}"
    text = found.text(path)
    if text is None:
        use.blocked_by("interface.package")
        raise Blocked(by="package.found")
    fault = fault_in(found, path)
    if fault is not None:
        raise fault
    lines = text.splitlines()
    ends = [n for n, line in enumerate(lines, start=1) if line.rstrip() == SEPARATOR]
    declared = message_text("\n".join("" if n in ends else one for n, one in enumerate(lines, 1)))
    file = f"{name}/{path}"
    parts = part_names(folder)
    for field, kind_ in _asked(use).items():
        part, _, last = field.rpartition(".")
        same = [one for one in declared.declared if (one.name, one.constant) == (last, "")]
        in_part = {id(one): parts[bisect(ends, one.line)] for one in same} if part else {}
        own = next((one for one in same if in_part.get(id(one), "") == part), None)
        if own is None:
            there = f"{in_part[id(same[0])]}.{last}" if same else ""
            raise _field_missing(use, declared.declared, field, kind_, there, same, file)
        if own.type != kind_:
            raise Failed(
                "interface.field_type",
                expected=f"{kind_} {field}",
                actual=f"{own.type} {field}",
                where=Where(file=file, line=own.line),
                params={"field": last},
                words={"type": kind_},
            )
    return Passed()


def _asked(use: Use[Fields]) -> dict[str, str]:
    """Return the fields that are asked for, with their parts as far as they are known, and their types."""
    parts = _asked_parts(use.evidence.assignment, use.given.type)
    given = use.given.fields.items()
    return {f"{parts[name]}.{name}" if name in parts else name: kind_ for name, kind_ in given}


def _asked_parts(assignment: Assignment, type_: str) -> dict[str, str]:
    """Return the part of a service's fields that calls of it set, and that checks of its answers read."""
    calls = [one.call for plan in assignment.runs for one in plan.do if one.call is not None]
    calls = [call for call in calls if call.type == type_]
    services = {call.service for call in calls}
    found = {name: {"request"} for call in calls for name in call.values}
    for use in assignment.checks:
        if use.kind == "service.answers" and use.with_.get("service") in services:
            for path in use.with_.get("each", {}):
                found.setdefault(str(path).partition(".")[0], set()).add("response")
    return {name: min(parts) for name, parts in found.items() if len(parts) == 1}


def _field_missing(
    use: Use[Fields],
    declared: Sequence[Declared],
    field: str,
    kind_: str,
    there: str,
    same: Sequence[Declared],
    file: str,
) -> Failed:
    """Return that a field is missing: `there` is what has its name in another part, if anything has."""
    last = field.rpartition(".")[2]
    names = [one.name for one in declared]
    close = "" if same else nearest(last, names) or ""
    alike = [one for one in declared if one.name == close]
    near = same or alike or _unasked(declared, kind_, use.given.fields)
    there = there or ", ".join(names) or "-"
    return Failed(
        "interface.field_missing",
        expected=f"{kind_} {field}",
        actual=with_difference(close, close, last) if close else there,
        where=Where(file=file, line=near[0].line if near else None),
        params={"field": last},
        words={"type": kind_, "there": near[0].name if near else ""},
        variant="other_name" if near and not same else "",
    )


def _unasked(declared: Sequence[Declared], kind_: str, asked: Iterable[str]) -> Sequence[Declared]:
    """Return the only field of a type that nobody asks for: it has the right place and another name."""
    known = {field.rpartition(".")[2] for field in asked}
    found = [
        one for one in declared if (one.type, one.constant) == (kind_, "") and one.name not in known
    ]
    return found if len(found) == 1 else ()


def _package(use: Use[Parameters], name: str) -> Package:
    """Return another package of the submission. Raises Failed if it is not there."""
    found = use.evidence.submission.package(name)
    if found is not None:
        return found
    use.blocked_by("interface.package")
    raise missing_package(use.evidence, name)


def _own(use: Use[Parameters]) -> str:
    return use.evidence.assignment.package


def _manifest(found: Package) -> Manifest:
    """Return its manifest. Raises Failed if that cannot be read."""
    text = found.text(MANIFEST)
    try:
        return read_manifest((text or "").encode())
    except ManifestError as error:
        raise Failed(
            "interface.manifest",
            expected=say("a package.xml that can be read"),
            actual=error.text[:200] if text is not None else say("there is no such file"),
            where=Where(file=f"{found.name}/{MANIFEST}", line=error.line),
        ) from None
