"""What makes the text of an interface unusable, although it reads like one.

The rules are those of rosidl_adapter (`rosidl_adapter/parser.py`), of the languages into which an
interface is translated, and the bounds within which the probe uses it.
"""

from __future__ import annotations

import keyword
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

from grader.package.intake.model import Package
from grader.package.source.interface import FIELD_NAME, Declared, message_text

PATH = re.compile(r"(msg|srv|action)/[A-Z][A-Za-z0-9]*\.\1")
MOST_TEXTS = 60  # files of a package
LONGEST_TEXT = 20_000  # bytes of a file
MOST_BYTES = 10_000_000  # of a message, from its arrays of a fixed length
SEPARATORS = {"msg": 0, "srv": 1, "action": 2}
SIZES = {
    "bool": 1, "byte": 1, "char": 1, "float32": 4, "float64": 8, "int8": 1, "uint8": 1, "int16": 2,
    "uint16": 2, "int32": 4, "uint32": 4, "int64": 8, "uint64": 8, "string": 32, "wstring": 32,
}  # fmt: skip
"""The bytes of the types that need no package; of a text without its characters."""
OF_ROS = 64  # bytes that are assumed for a message of another package
CONSTANT_NAME = re.compile(r"[A-Z](?:_?[A-Z0-9])*")
PLAIN = re.compile(r"[a-z][a-z0-9]*")
PARTS = re.compile(r"(?P<type>[\w/]+?)(?:<=\d+)?(?P<array>\[(?P<length>[^\]]*)\])?")
LONGEST_NUMBER = 40  # characters of a number that is read
OF_CLASS = ("builtins", "get_fields_and_field_types")
"""What the Python class of a message needs in its body, or has as a method."""
OF_C = """
    alignas alignof asm auto bool case catch char class compl const constexpr decltype default
    delete do double enum explicit export extern float friend goto inline int long mutable
    namespace new noexcept nullptr operator private protected public register restrict short
    signed sizeof static struct switch template this throw typedef typeid typename union
    unsigned using virtual void volatile
"""
"""Words of C and C++ that Python does not reserve too."""


@dataclass(frozen=True)
class InterfaceFault:
    """A fault: its name in the catalogue (`interface.…`), the line (None: the whole file), what is
    written there, and the values of the texts' placeholders.
    """

    slug: str
    line: int | None = None
    found: str = ""
    words: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Texts:
    """The interface texts of a package by their paths, such as msg/Distance.msg.

    `is_type` tells whether ROS has a message of another package; None if that is not known.
    """

    package: str
    files: Mapping[str, bytes]
    is_type: Callable[[str], bool | None] = lambda _: None
    _read: dict[str, tuple[Declared, ...]] = field(default_factory=dict, repr=False)
    _inside: dict[str, set[str]] = field(default_factory=dict, repr=False)
    _sizes: dict[str, int] = field(default_factory=dict, repr=False)

    def fault(self, path: str) -> InterfaceFault | None:
        """Return the first fault of a file; None if there is none."""
        return next(self._faults(path, self.files[path]), None)

    def _faults(self, path: str, data: bytes) -> Iterator[InterfaceFault]:
        if len(data) > LONGEST_TEXT:
            size = {"size": f"{len(data):,}", "most": f"{LONGEST_TEXT:,}"}
            yield InterfaceFault("too_long", _line_of(data, LONGEST_TEXT), words=size)
            return
        try:
            text = data.decode("utf-8")
        except UnicodeDecodeError as error:
            yield InterfaceFault("not_utf8", _line_of(data, error.start))
            return
        kind = path.rpartition(".")[2]
        lines = text.splitlines()
        separators = [n for n, line in enumerate(lines, start=1) if line == "---"]
        if len(separators) != SEPARATORS[kind]:
            last = separators[SEPARATORS[kind]] if len(separators) > SEPARATORS[kind] else None
            count = {"count": str(SEPARATORS[kind]), "kind": kind}
            yield InterfaceFault(
                "separator", last or len(lines) or None, str(len(separators)), count
            )
            return
        start = 0
        for end in (*separators, len(lines) + 1):
            part = "\n" * start + "\n".join(lines[start : end - 1])
            yield from self._part(part, path)
            start = end

    def _part(self, text: str, path: str) -> Iterator[InterfaceFault]:
        read = message_text(text)
        rows = text.split("\n")
        for line in read.unknown:
            yield InterfaceFault("line_unknown", line, rows[line - 1].strip()[:100])
        names: set[str] = set()
        for one in read.declared:
            yield from _name_fault(one)
            if one.name in names:
                yield InterfaceFault("declared_twice", one.line, one.name, {"name": one.name})
            names.add(one.name)
            yield from self._type_fault(one, path)
            given = one.constant or one.default
            if given and not _fits(one.type, given):
                yield InterfaceFault(
                    "value_range", one.line, f"{one.type} {given}"[:100], {"type": one.type}
                )

    def _type_fault(self, one: Declared, path: str) -> Iterator[InterfaceFault]:
        base = _base(one.type)
        if one.constant and (base not in SIZES or "[" in one.type):
            yield InterfaceFault("type_unknown", one.line, one.type[:100], {"type": one.type[:100]})
            return
        own = self._own(base)
        known = base in SIZES or own is not None
        if not known and not PLAIN.fullmatch(base):
            owner, _, name = base.rpartition("/")
            package = owner.removesuffix("/msg") or self.package
            there = package != self.package and self.is_type(f"{package}/msg/{name}")
            known = there is None or there
        if not known:
            yield InterfaceFault("type_unknown", one.line, base[:100], {"type": base[:100]})
        elif own is not None and self._is_inside(path, own):
            yield InterfaceFault("recursive", one.line, one.type[:100], {"type": base})
        elif self._size(one.type) > MOST_BYTES:
            most = {"most": f"{MOST_BYTES // 1_000_000}"}
            yield InterfaceFault("too_large", one.line, one.type[:100], most)

    def _own(self, base: str) -> str | None:
        """Return the file of a type of this package; None if there is none."""
        owner, _, name = base.rpartition("/")
        path = f"msg/{name}.msg"
        mine = owner.removesuffix("/msg") in ("", self.package)
        return path if mine and path in self.files else None

    def _is_inside(self, other: str, path: str) -> bool:
        """Whether the message of a file contains another one, directly or not."""
        found, waiting = {path}, [path]
        while waiting:
            new = self._inner(waiting.pop()) - found
            found |= new
            waiting += new
        return other in found

    def _inner(self, path: str) -> set[str]:
        """Return the files of the messages that are fields of a message."""
        if path not in self._inside:
            bases = {_base(one.type) for one in self._declared(path)}
            self._inside[path] = {own for own in map(self._own, bases) if own is not None}
        return self._inside[path]

    def _declared(self, path: str) -> tuple[Declared, ...]:
        if path not in self._read:
            data = self.files[path][:LONGEST_TEXT]
            self._read[path] = message_text(data.decode("utf-8", errors="replace")).declared
        return self._read[path]

    def _size(self, kind: str) -> int:
        """Return about how many bytes a new value of a type has; arrays without a length have none."""
        parts = PARTS.fullmatch(kind)
        if parts is None or (parts["array"] and not (parts["length"] or "").isdecimal()):
            return 0
        length = parts["length"] or "1"
        count = int(length) if len(length) < LONGEST_NUMBER else MOST_BYTES + 1
        own = self._own(parts["type"])
        size = SIZES.get(parts["type"], OF_ROS) if own is None else self._size_of_file(own)
        return min(size * count, MOST_BYTES + 1)

    def _size_of_file(self, path: str) -> int:
        if path not in self._sizes:
            self._sizes[path] = 0  # (of one that contains itself)
            inner = sum(self._size(one.type) for one in self._declared(path) if not one.constant)
            self._sizes[path] = min(inner, MOST_BYTES + 1)
        return self._sizes[path]


def interface_texts(
    package: Package, is_type: Callable[[str], bool | None] = lambda _: None
) -> Texts:
    """Return the interface texts of a package, those of the first `MOST_TEXTS` files."""
    found = [(f.path, f.data) for f in package.files if f.kind == "file" and PATH.fullmatch(f.path)]
    return Texts(package.name, dict(found[:MOST_TEXTS]), is_type)


def _name_fault(one: Declared) -> Iterator[InterfaceFault]:
    name = {"name": one.name[:100]}
    if one.constant:
        if not CONSTANT_NAME.fullmatch(one.name):
            yield InterfaceFault("constant_name", one.line, one.name[:100], name)
    elif not FIELD_NAME.fullmatch(one.name):
        yield InterfaceFault("field_name", one.line, one.name[:100], name)
    elif keyword.iskeyword(one.name) or one.name in OF_CLASS or one.name in OF_C.split():
        yield InterfaceFault("field_reserved", one.line, one.name[:100], name)


def _fits(kind: str, text: str) -> bool:
    """Whether a constant or a default can be a value of a type; what is not judged can."""
    if kind == "bool":
        return text.lower() in ("true", "false", "0", "1")
    if kind in ("float32", "float64"):
        try:
            return bool(text) and float(text) is not None
        except ValueError:
            return False
    match = re.fullmatch(r"(?:(u?)int(\d+)|byte|char)", kind)
    if match is None:
        return True
    bits = int(match[2] or 8)
    signed = match[2] is not None and not match[1]
    most = 1 << (bits - 1 if signed else bits)
    low, high = -most if signed else 0, most - 1
    if len(text) > LONGEST_NUMBER:
        return False
    prefixed = re.match(r"[+-]?0[box]", text.lower()) is not None
    try:
        return low <= int(text, 0 if prefixed else 10) <= high
    except ValueError:
        return False


def _base(kind: str) -> str:
    """Return a field's type without its bounds: `Pose` of `Pose[<=5]`, `string` of `string<=9`."""
    return kind.partition("[")[0].partition("<=")[0]


def _line_of(data: bytes, place: int) -> int:
    return data.count(b"\n", 0, place) + 1
