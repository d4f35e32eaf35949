"""Fixes of package.xml. They work on its bytes: expat gives the byte offset of each tag."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from xml.parsers import expat

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.source.broken_xml import xml_fault
from grader.package.source.manifest import DEPENDS, MOST_BYTES, RUNTIME, meant_package
from grader.package.source.ros_imports import CLIENT

FILE = "package.xml"
TYPE = b"<build_type>ament_python</build_type>"


@dataclass
class Tag:
    """An element in the bytes: from `start` (its `<`) to `end` (after its last `>`).

    `inside` is the start and end of its content; `inside[0]` is -1 for an empty tag `<a/>`.
    """

    name: str
    within: str
    start: int
    end: int = -1
    inside: tuple[int, int] = (-1, -1)


class _Places:
    """Finds the elements; `open` holds those that broken XML leaves open."""

    def __init__(self, found: bytes) -> None:
        self.found = found
        self.closed: list[Tag] = []
        self.open: list[Tag] = []
        self.parser = expat.ParserCreate()
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.StartDoctypeDeclHandler = self._doctype

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        del attributes
        within = self.open[-1].name if self.open else ""
        self.open.append(Tag(name, within, self.parser.CurrentByteIndex))

    def _end(self, name: str) -> None:
        del name
        tag = self.open.pop()
        at = self.parser.CurrentByteIndex
        head = _head_end(self.found, tag.start)
        if at <= tag.start or self.found[head - 2 : head] == b"/>":
            tag.end = head
        else:
            tag.inside = (head, at)
            tag.end = self.found.find(b">", at) + 1
        self.closed.append(tag)

    def _doctype(self, *_: object) -> None:
        raise ValueError


def _head_end(found: bytes, start: int) -> int:
    """Return the end of a start tag; a `>` inside a quoted attribute does not end it."""
    match = re.compile(rb"<(?:[^<>\"']|\"[^\"]*\"|'[^']*')*>").match(found, start)
    return match.end() if match else start


def _places(found: bytes | None) -> _Places | None:
    """Return the places of the elements; None for UTF-16 and for anything but valid XML."""
    if found is None or len(found) > MOST_BYTES or found[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return None
    places = _Places(found)
    try:
        places.parser.Parse(found, True)
    except (expat.ExpatError, ValueError, LookupError):
        return None
    return places


def _one(places: _Places, name: str, within: str = "package") -> Tag | None:
    found = [t for t in places.closed if t.name == name and t.within == within]
    return found[0] if len(found) == 1 else None


def _newline(found: bytes) -> bytes:
    return b"\r\n" if b"\r\n" in found else b"\n"


def _indent(found: bytes, at: int) -> bytes:
    """Return the indentation before a position, b"" if other characters come before it."""
    line = found[found.rfind(b"\n", 0, at) + 1 : at]
    return line if not line.strip(b" \t") else b""


def _put(case: Case, start: int, end: int, new: bytes) -> Files | None:
    found = case.files.data(FILE) or b""
    return case.with_data(FILE, found[:start] + new + found[end:])


def rename(case: Case) -> Files | None:
    """Rename a manifest with a nearly right name to package.xml."""
    if case.finding.mistake != "package.no_manifest" or FILE in case.files.by_path:
        return None
    there = str(case.finding.params.get("there", ""))
    places = _places(case.files.data(there)) if there else None
    if places is None or _one(places, "name") is None:
        return None
    return case.files.with_move(there, FILE)


def name(case: Case) -> Files | None:
    """Write the package's name between <name> and </name>."""
    places = _places(case.files.data(FILE))
    tag = _one(places, "name") if places else None
    if places is None or tag is None or tag.inside[0] < 0:
        return None
    inside = places.found[slice(*tag.inside)]
    text = inside.strip()
    if b"<" in text or text == case.package.encode():
        return None
    start = tag.inside[0] + (inside.find(text) if text else 0)
    return _put(case, start, start + len(text), case.package.encode())


def build_type(case: Case) -> Files | None:
    """Make <export> contain the build type ament_python once."""
    places = _places(case.files.data(FILE))
    if places is None or "CMakeLists.txt" in case.files.by_path:
        return None
    tags = [tag for tag in places.closed if tag.name == "build_type"]
    inside = [tag for tag in tags if tag.within == "export"]
    outside = [tag for tag in tags if tag.within != "export"]
    root, export = _one(places, "package", ""), _one(places, "export")
    if root is None or root.inside[0] < 0 or len(inside) > 1 or len(outside) > 1:
        return None
    others = any(tag.name == "export" for tag in places.closed) and export is None
    if inside and not outside:
        return _put(case, inside[0].start, inside[0].end, TYPE)
    if others:
        return None
    if outside and export is None and outside[0].within == "package":  # wrap it
        return _put(case, outside[0].start, outside[0].end, b"<export>" + TYPE + b"</export>")
    changes = [_whole_line(places.found, tag) for tag in outside]
    changes += [] if inside else [_typed(places.found, root, export)]
    new = places.found
    for start, end, text in sorted(changes, reverse=True):
        new = new[:start] + text + new[end:]
    return case.with_data(FILE, new)


def _typed(found: bytes, root: Tag, export: Tag | None) -> tuple[int, int, bytes]:
    """Return the change that writes the build type into <export>, which is added if there is none."""
    newline = _newline(found)
    if export is None:
        end = root.inside[1]
        end -= len(_indent(found, end))
        rows = (b"  <export>", b"    " + TYPE, b"  </export>")
        return end, end, b"".join(row + newline for row in rows)
    if export.inside[0] < 0:
        return export.start, export.end, b"<export>" + TYPE + b"</export>"
    indent, at = _indent(found, export.start), export.inside[0]
    return at, at, newline + indent * 2 + TYPE if indent else TYPE


def depend(case: Case) -> Files | None:
    """Add a dependency: the one that is missing, or rclpy."""
    name = str(case.finding.params.get("needed", CLIENT)).encode()
    places = _places(case.files.data(FILE))
    licence = [t for t in places.closed if t.name == "license"] if places else []
    if places is None or not licence:
        return None
    found = places.found
    depends = [t for t in places.closed if DEPENDS.fullmatch(t.name) and t.within == "package"]
    named = [t.name for t in depends if found[slice(*t.inside)].strip() == name]
    if {*named} & {*RUNTIME}:
        return None
    tag = b"exec_depend" if named else b"depend"  # catkin_pkg refuses both depend and build_depend
    last = [t for t in depends if t.name == "depend"] or licence
    indent = _indent(found, last[-1].start)
    new = _newline(found) + indent + b"<" + tag + b">" + name + b"</" + tag + b">"
    return _put(case, last[-1].end, last[-1].end, new)


def version(case: Case) -> Files | None:
    """Add a missing version: 0.0.0, as `ros2 pkg create` does."""
    places = _places(case.files.data(FILE))
    tag = _one(places, "name") if places else None
    if places is None or tag is None or case.finding.params.get("tag") != "version":
        return None
    there = [t for t in places.closed if t.name == "version"]
    if there and (len(there) > 1 or there[0].within != "package"):
        return None
    if there:
        return _put(case, there[0].start, there[0].end, b"<version>0.0.0</version>")
    indent = _indent(places.found, tag.start)
    new = _newline(places.found) + indent + b"<version>0.0.0</version>"
    return _put(case, tag.end, tag.end, new)


def _whole_line(found: bytes, tag: Tag) -> tuple[int, int, bytes]:
    """Return the change that deletes a tag, with its lines if nothing else is on them."""
    start = tag.start - len(_indent(found, tag.start))
    rest = re.compile(rb"[ \t]*\r?\n").match(found, tag.end)
    own = (start == 0 or found[start - 1 : start] == b"\n") and rest is not None
    return (start, rest.end(), b"") if own and rest is not None else (tag.start, tag.end, b"")


def well_formed(case: Case) -> Files | None:
    """Close a tag, correct its name or its quotes, or remove what is around the XML."""
    found = case.files.data(FILE)
    if found is None or case.finding.mistake != "package.broken_xml":
        return None
    fault = xml_fault(found)
    return case.with_data(FILE, fault.fixed) if fault is not None else None


def tag_name(case: Case) -> Files | None:
    """Correct a tag whose name is nearly the one that is missing."""
    places = _places(case.files.data(FILE))
    tag, close = (str(case.finding.params.get(name, "")) for name in ("tag", "close"))
    found = [t for t in places.closed if t.name == close] if places and close else []
    if places is None or len(found) != 1 or found[0].inside[0] < 0:
        return None
    wrong, (head, foot) = found[0], found[0].inside
    start = places.found[wrong.start : head].replace(close.encode(), tag.encode(), 1)
    end = places.found[foot : wrong.end].replace(close.encode(), tag.encode(), 1)
    return _put(case, wrong.start, wrong.end, start + places.found[head:foot] + end)


def depend_name(case: Case) -> Files | None:
    """Correct the name of a dependency that is nearly that of a package which the code imports."""
    wanted, written = (str(case.finding.params.get(key, "")) for key in ("needed", "found"))
    return _with_names(case, lambda name: wanted if name == written else "") if written else None


def dependencies(case: Case) -> Files | None:
    """Correct the names of dependencies that are nearly those of a known package."""
    return _with_names(case, meant_package)


def _with_names(case: Case, meant: Callable[[str], str]) -> Files | None:
    """Give dependencies other names: what `meant` returns for the name, unless it is empty."""
    places = _places(case.files.data(FILE))
    if places is None:
        return None
    new = places.found
    for tag in sorted(places.closed, key=lambda t: t.start, reverse=True):
        name = places.found[slice(*tag.inside)]
        close = meant(name.decode("utf-8", "replace").strip())
        if DEPENDS.fullmatch(tag.name) and tag.within == "package" and close:
            new = new[: tag.inside[0]] + close.encode() + new[tag.inside[1] :]
    return case.with_data(FILE, new)
