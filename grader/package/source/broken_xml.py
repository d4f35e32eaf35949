"""Why a package.xml is not well-formed XML: the tag that is wrong, and the one change, if certain.

expat names the place at which it stops. If a tag is not closed, that is the end of the tag around
it, often many lines below. Of any other error, expat's own message and its line are told.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal
from xml.parsers import expat

from grader.base.nearest import nearest

MOST_BYTES = 50_000
TAGS = (
    *("package", "name", "version", "description", "maintainer", "license", "url", "author"),
    *("depend", "build_depend", "build_export_depend", "buildtool_depend", "exec_depend"),
    *("buildtool_export_depend", "test_depend", "doc_depend", "conflict", "replace"),
    *("group_depend", "member_of_group", "export", "build_type"),
)
"""The tags of REP 149."""
Variant = Literal["unclosed", "unopened", "misspelt"]
END_TAG = re.compile(rb"</\s{0,9}(?P<name>[^<>\s]{1,100})\s{0,9}>")
Change = tuple[int, int, bytes]


@dataclass(frozen=True)
class XmlFault:
    """What is wrong: the tag, its line (from 1), and how it should be written, if it is misspelt.

    `fixed` is the file after the change; None if no change is certain.
    """

    variant: Variant
    tag: str
    line: int
    wanted: str = ""
    fixed: bytes | None = None


class _Reader:
    """Parses until the error; `open` are the tags that are open there with their positions."""

    def __init__(self, found: bytes) -> None:
        self.found = found
        self.open: list[tuple[str, int]] = []
        self.parser = expat.ParserCreate()
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.StartDoctypeDeclHandler = self._doctype

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        del attributes
        self.open.append((name, self.parser.CurrentByteIndex))

    def _end(self, name: str) -> None:
        del name
        self.open.pop()

    def _doctype(self, *_: object) -> None:
        raise ValueError

    def stop(self) -> tuple[str, int] | None:
        """Return the name and the position of the error; None if it is XML or not examined."""
        try:
            self.parser.Parse(self.found, True)
        except expat.ExpatError as error:
            return expat.errors.messages.get(error.code, ""), self.parser.ErrorByteIndex
        except (ValueError, LookupError):
            return None
        return None

    def fault(
        self, variant: Variant, tag: str, at: int, change: Change | None = None, wanted: str = ""
    ) -> XmlFault:
        """Return a fault; the change is kept only if the file is XML afterwards."""
        new = None
        if change is not None:
            start, end, text = change
            new = self.found[:start] + text + self.found[end:]
        fixed = new if new is not None and _is_xml(new) else None
        return XmlFault(variant, tag, self.found.count(b"\n", 0, max(at, 0)) + 1, wanted, fixed)


def _is_xml(found: bytes) -> bool:
    reader = _Reader(found)
    return reader.stop() is None and not reader.open


def xml_fault(found: bytes) -> XmlFault | None:
    """Return the tag with which a file is not well-formed; None if it is, or if no tag is known."""
    if len(found) > MOST_BYTES or found[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return None
    reader = _Reader(found)
    error, at = reader.stop() or ("", 0)
    if error == expat.errors.XML_ERROR_TAG_MISMATCH:
        return _mismatch(reader, at)
    if error == expat.errors.XML_ERROR_NO_ELEMENTS and reader.open:
        return _unclosed(reader)
    return None


def _mismatch(reader: _Reader, at: int) -> XmlFault | None:
    found, (top, top_start) = reader.found, reader.open[-1]
    start = found.rfind(b"</", max(0, at - 200), at + 3)
    end = END_TAG.match(found, start) if start >= 0 else None
    if end is None:
        return None
    name = end["name"].decode("utf-8", "replace")
    if name in [tag for tag, _ in reader.open]:
        return _unclosed(reader)
    inside = found[found.find(b">", top_start) + 1 : start]
    own = b"<" not in inside and b"\n" not in inside and len(reader.open) > 1
    if not own and nearest(top, [name]) != name:
        return reader.fault("unopened", f"/{name}", start)
    if name in TAGS and top not in TAGS:
        place = (top_start + 1, top_start + 1 + len(top.encode()), name.encode())
        return reader.fault("misspelt", top, top_start, place, name)
    fault = reader.fault(
        "misspelt", f"/{name}", start, (*end.span("name"), top.encode()), f"/{top}"
    )
    # (two known tags on one line: <export>ament_python</build_type></export> lacks one)
    both = name in TAGS and top in TAGS and fault.fixed is None
    return reader.fault("unopened", f"/{name}", start) if both else fault


def _unclosed(reader: _Reader) -> XmlFault:
    """Return the innermost open tag: it is closed nowhere."""
    tag, start = reader.open[-1]
    head = reader.found.find(b">", start) + 1
    text = reader.found[head:].partition(b"\n")[0].rstrip()
    end, closing = head + len(text), f"</{tag}>".encode()
    change = (end, end, closing) if text.strip() and b"<" not in text else None
    if len(reader.open) == 1:
        end = len(reader.found.rstrip())
        change = (end, end, b"\n" + closing)
    return reader.fault("unclosed", tag, start, change)
