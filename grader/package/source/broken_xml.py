"""Why a package.xml is not well-formed XML: the tag that is wrong, and the one change, if certain.

expat names the place at which it stops. If a tag is not closed, that is the end of the tag around
it, often many lines below.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
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
Variant = Literal[
    "unclosed", "again", "unopened", "closed_twice", "misspelt", "unfinished", "quotes", "ampersand", "before",
    "after", "outside", "bare", "comment", "declaration", "blank", "declared_twice", "package_twice", "no_tags", "end_twice", "root_first", "typed", "typed_lines", "line_twice", "lines_swapped",
    "hyphens", "hyphens_lines", "comment_start", "less", "version",
]  # fmt: skip
END_TAG = re.compile(rb"</\s{0,9}(?P<name>[^<>\s]{1,100})\s{0,9}>")
TYPOGRAPHIC = re.compile(rb"\xe2\x80[\x98-\x9f]")  # U+2018 to U+201F in UTF-8
BARE = re.compile(rb"\s(?P<name>[\w:.-]{1,60})=(?P<value>[^\s\"'<>=]{1,200})")
DECLARATION = re.compile(rb"<\?xml\s[^<>]{0,200}\?>")
BOM = b"\xef\xbb\xbf"
DASH = rb"(?:-|\xe2\x80[\x90-\x95])"  # with U+2010 to U+2015 in UTF-8
COMMENT_START = re.compile(rb"<!?" + DASH + rb"{1,3}")
COMMENT_END = re.compile(rb"[ \t]*" + DASH + rb"{1,3}!?>")
BARE_LESS = re.compile(rb"<(?=[\s\d=<-]|[\w.+-]{1,60}@[\w.-]{1,60}>)")
VERSIONS = re.compile(
    rb"<[a-z_]{0,30}depend>\s*(?P<name>[\w-]{1,60})"
    rb"(?P<versions>\s*[<>=~!]=?[^\n]{0,60}?)(?P<end></[a-z_]{0,30}depend>)"
)
MOST_SHOWN = 120
ENTITY = re.compile(rb"&(#?\w{1,30});")


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


@dataclass(frozen=True)
class _Open:
    name: str
    start: int


class _Reader:
    """Parses until the error; `open` are the tags that are open there, the innermost last."""

    def __init__(self, found: bytes) -> None:
        self.found = found
        self.open: list[_Open] = []
        self.parser = expat.ParserCreate()
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.StartDoctypeDeclHandler = self._doctype

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        del attributes
        self.open.append(_Open(name, self.parser.CurrentByteIndex))

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

    def line(self, at: int) -> int:
        """Return the line of a position."""
        return self.found.count(b"\n", 0, max(at, 0)) + 1

    def line_end(self, at: int) -> int:
        """Return where the text of a line ends, without blanks at its end."""
        end = self.found.find(b"\n", at)
        end = len(self.found) if end < 0 else end
        return at + len(self.found[at:end].rstrip())

    def fault(
        self,
        variant: Variant,
        tag: str,
        at: int,
        *change: tuple[int, int, bytes],
        wanted: str = "",
    ) -> XmlFault:
        """Return a fault; the change is kept only if the file is XML afterwards."""
        new: bytes | None = self.found
        for start, end, text in sorted(change, reverse=True):
            new = (new or b"")[:start] + text + (new or b"")[end:]
        if not change or new is None or not _is_xml(new):
            new = None
        return XmlFault(variant, tag, self.line(at), wanted, new)


def _is_xml(found: bytes) -> bool:
    reader = _Reader(found)
    return reader.stop() is None and not reader.open


def xml_fault(found: bytes) -> XmlFault | None:
    """Return why a file is not well-formed; None if it is, or if the cause is unknown."""
    if len(found) > MOST_BYTES or found[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return None
    reader = _Reader(found)
    error = reader.stop()
    typed = _typed(reader) or _rows(reader) if error is not None else None
    if typed is not None:
        return typed
    look = LOOKS.get(error[0]) if error is not None else None
    return look(reader, error[1]) if error is not None and look is not None else None


NAME = "|".join(TAGS).encode()
TYPED = (
    (re.compile(rb"<[ \t]+(?=/?(?:%s)\b)" % NAME), b"<"),
    (re.compile(rb"</[ \t]+(?=(?:%s)[ \t]*>)" % NAME), b"</"),
    (re.compile(rb"<[ \t]*\\(?=(?:%s)[ \t]*>)" % NAME), b"</"),
    (re.compile(rb"(?<![<\w/.-])(?=(?:%s)(?:[ \t]+\w+=[^<>]*)?>)" % NAME), b"<"),
    (re.compile(rb"(?<!<)/(?=(?:%s)>)" % NAME), b"</"),
    (re.compile(rb"(?<=[^<>])<(?=(?P<name>%s)/>)" % NAME), b"</"),
    (re.compile(rb"(?P<start><\w+(?:[ \t]+\w+=(?:\"[^\"<>]*\"|'[^'<>]*'))*[ \t]+\w+=(?P<quote>[\"'])[^\"'<>]*)(?=>)"),
     rb"\g<start>\g<quote>"),
    (re.compile(rb"(?P<start><\w+(?:[ \t]+\w+=(?:\"[^\"<>]*\"|'[^'<>]*'))*[ \t]+\w+=(?P<quote>[\"'])[^\"'<>]*)[\"'](?=[ \t]*/?>)"),
     rb"\g<start>\g<quote>"),
    (re.compile(rb"(?P<start></?)[ \t]+(?=(?:%s)\b)" % NAME), rb"\g<start>"),
)  # fmt: skip
"""A sign of a tag that is missing or wrong, and what to write instead."""
MOST_TRIED = 20
MOST_ROWS = 100


def _typed(reader: _Reader) -> XmlFault | None:
    """Return a tag with one sign missing or wrong, if the file is well-formed after the change."""
    for pattern, new in TYPED:
        changes = [_written(pattern, match, new) for match in pattern.finditer(reader.found)]
        for change in changes[:MOST_TRIED]:
            fault = _if_right(reader, change)
            if fault is not None:
                return fault
        if 1 < len(changes) <= MOST_TRIED:
            fault = _if_right(reader, [one for change in changes for one in change])
            if fault is not None:
                return fault
    return None


def _written(
    pattern: re.Pattern[bytes], match: re.Match[bytes], new: bytes
) -> list[tuple[int, int, bytes]]:
    """Return the change of one tag."""
    start, end = match.span()
    change = [(start, end, match.expand(new))]
    if pattern is TYPED[5][0]:  # <depend>rclpy<depend/>
        slash = end + len(match["name"])
        change.append((slash, slash + 1, b""))
    return change


def _if_right(reader: _Reader, change: list[tuple[int, int, bytes]]) -> XmlFault | None:
    """Return the fault that a change corrects, if the file is well-formed after it."""
    fixed = reader.found
    for first, last, piece in sorted(change, reverse=True):
        fixed = fixed[:first] + piece + fixed[last:]
    if _Reader(fixed).stop() is not None:
        return None
    lines = sorted({reader.line(first) for first, _, _ in change})
    wanted = fixed.splitlines()[lines[0] - 1].decode("utf-8", "replace").strip()
    variant: Variant = "typed" if len(lines) == 1 else "typed_lines"
    return reader.fault(variant, "", change[0][0], *change, wanted=wanted)


def _rows(reader: _Reader) -> XmlFault | None:
    """Return a line that is there twice, or two lines in the wrong order."""
    rows = reader.found.splitlines(keepends=True)
    at = 0
    for number, row in enumerate(rows[:MOST_ROWS]):
        below = rows[number + 1] if number + 1 < len(rows) else b""
        if row.strip() and below.strip():
            end = at + len(row) + len(below)
            same = row.strip() == below.strip()
            new = row if same else below.rstrip(b"\r\n") + row[len(row.rstrip(b"\r\n")) :] + row
            fixed = reader.found[:at] + new + reader.found[end:]
            tags = all(re.match(rb"\s*</?\w", line) for line in (row, below))
            pasted = row.strip() == b"</package>" and below.lstrip().startswith(b"<package")
            if tags and not pasted and _Reader(fixed).stop() is None:
                variant: Variant = "line_twice" if same else "lines_swapped"
                return reader.fault(
                    variant, "", at + len(row), (at, end, new), wanted=str(number + 1)
                )
        at += len(row)
    return None


def _mismatch(reader: _Reader, at: int) -> XmlFault | None:
    found, top = reader.found, reader.open[-1]
    start = found.rfind(b"</", max(0, at - 200), at + 3)
    end = END_TAG.match(found, start) if start >= 0 else None
    if end is None:
        return None
    name = end["name"].decode("utf-8", "replace")
    if name in [tag.name for tag in reader.open]:
        return _unclosed(reader)
    inside = found[found.find(b">", top.start) + 1 : start]
    own = b"<" not in inside and b"\n" not in inside and len(reader.open) > 1
    if own or nearest(top.name, [name]) == name:
        place = (*end.span("name"), top.name.encode())
        fault = reader.fault("misspelt", f"/{name}", start, place, wanted=f"/{top.name}")
        if name in TAGS and top.name not in TAGS:
            place = (top.start + 1, top.start + 1 + len(top.name.encode()), name.encode())
            fault = reader.fault("misspelt", top.name, top.start, place, wanted=name)
        # (two known tags on one line: <export>ament_python</build_type></export> lacks one)
        if name not in TAGS or top.name not in TAGS or fault.fixed is not None:
            return fault
    before = found[:start].rstrip()
    if before.endswith(f"</{name}>".encode()):
        stop = found.find(b">", start) + 1
        return reader.fault("closed_twice", f"/{name}", start, (len(before), stop, b""))
    begin = found.rfind(b"\n", 0, start) + 1
    text = found[begin:start]
    change = []
    if text.strip() and b"<" not in text:
        first = begin + len(text) - len(text.lstrip())
        change = [(first, first, f"<{name}>".encode())]
    return reader.fault("unopened", f"/{name}", start, *change)


def _unclosed(reader: _Reader) -> XmlFault:
    """Return the innermost open tag: it is closed nowhere, or its end tag lacks the slash."""
    top = reader.open[-1]
    if len(reader.open) > 1 and reader.open[-2].name == top.name:
        at = top.start + 1
        return reader.fault("again", top.name, top.start, (at, at, b"/"))
    head = reader.found.find(b">", top.start) + 1
    end = reader.line_end(head)
    text = reader.found[head:end]
    closing = f"</{top.name}>".encode()
    change = [(end, end, closing)] if text.strip() and b"<" not in text else []
    if len(reader.open) == 1:
        end = len(reader.found.rstrip())
        change = [(end, end, b"\n" + closing)]
    return reader.fault("unclosed", top.name, top.start, *change)


def _end_of_file(reader: _Reader, at: int) -> XmlFault | None:
    del at
    return _unclosed(reader) if reader.open else None


def _invalid(reader: _Reader, at: int) -> XmlFault | None:
    found = reader.found
    fault = _comments(reader, at) or _tag_start(reader, at)
    if fault is not None:
        return fault
    start = found.rfind(b"<", 0, max(at, 1))
    if start >= 0 and at - start > 1 and b">" not in found[start:at]:
        return _in_tag(reader, start, at)
    amp = found.rfind(b"&", max(0, at - 40), at + 1)
    if amp >= 0 and not ENTITY.match(found, amp):
        return reader.fault("ampersand", "&", amp, (amp, amp + 1, b"&amp;"))
    return None if reader.open else _before(reader, at) or _after(reader, at)


def _comments(reader: _Reader, at: int) -> XmlFault | None:
    """Return what is wrong in the first comment that is not right."""
    found, head = reader.found, reader.found.find(b"<!--")
    while 0 <= head <= at + 4:
        dashes = found.find(b"--", head + 4)
        if dashes < 0 or (
            found[dashes - 2 : dashes] == b"<!" and b"\n" in found[head : dashes - 2]
        ):
            return _no_end(reader, head)
        if found[dashes : dashes + 3] != b"-->":
            return _hyphens(reader, head, dashes)
        head = found.find(b"<!--", dashes + 3)
    return None


def _no_end(reader: _Reader, head: int) -> XmlFault:
    """Return that a comment has no end, or a wrong one at the end of its line."""
    end = reader.line_end(head)
    wrong = re.compile(COMMENT_END.pattern + rb"$").search(reader.found[head + 4 : end])
    start = head + 4 + wrong.start() if wrong is not None else end
    return reader.fault("comment", "!--", head, (start, end, b" -->"))


def _hyphens(reader: _Reader, head: int, dashes: int) -> XmlFault:
    """Return that two hyphens are inside of a comment, with the right comment if it is certain."""
    found = reader.found
    close = found.find(b"-->", dashes)
    if close < 0:
        return _no_end(reader, head)
    inside = found[head + 4 : close].strip(b"-")
    if b"<" in inside:
        return reader.fault("hyphens_lines", "!--", dashes)
    inside = re.sub(rb"-{2,}", b"-", re.sub(rb"(?<!-)--(?=\w)", b"- -", inside))
    inside = inside if b"\n" in inside else b" " + inside.strip() + b" "
    right = b"<!--" + inside + b"-->"
    change = (head, close + 3, right)
    if b"\n" in right or len(right) > MOST_SHOWN:
        return reader.fault("hyphens_lines", "!--", dashes, change)
    wanted = right.decode("utf-8", "replace")
    return reader.fault("hyphens", "!--", dashes, change, wanted=wanted)


def _tag_start(reader: _Reader, at: int) -> XmlFault | None:
    """Return what is wrong with a < that begins no tag."""
    found = reader.found
    start = found.rfind(b"<", 0, at + 1)
    if start < 0:
        return None
    line_start, end = found.rfind(b"\n", 0, start) + 1, reader.line_end(start)
    begin = COMMENT_START.match(found, start)
    if begin is not None and begin[0] != b"<!--":
        last = COMMENT_END.search(found, begin.end(), end)
        if last is not None:
            change = ((*begin.span(), b"<!--"), (*last.span(), b" -->"))
            return reader.fault("comment_start", begin[0].decode(), start, *change)
        if begin[0].startswith(b"<!") or not found[line_start:start].strip():
            return reader.fault("comment_start", begin[0].decode(), start)
    bare = [m.start() for m in BARE_LESS.finditer(found, line_start, end)]
    versions = VERSIONS.search(found, line_start, end)
    if versions is not None and start in range(*versions.span("versions")):
        wanted = found[versions.start() : versions.end("name")] + versions["end"]
        gone = (*versions.span("versions"), b"")
        shown = wanted.strip().decode("utf-8", "replace")
        return reader.fault("version", "", start, gone, wanted=shown)
    if start in bare and reader.open:
        fault = reader.fault("less", "", start, *((i, i + 1, b"&lt;") for i in bare))
        return fault if fault.fixed is not None else None
    return None


def _in_tag(reader: _Reader, start: int, at: int) -> XmlFault | None:
    """Return what is wrong inside a tag: its quotes, or it has no end."""
    found = reader.found
    name = re.compile(rb"</?[\w:.-]{0,60}").match(found, start)
    tag = (name[0] if name else b"<").decode("utf-8", "replace")
    end = reader.line_end(start)
    if TYPOGRAPHIC.match(found, at):
        quotes = [(m.start(), m.end(), b'"') for m in TYPOGRAPHIC.finditer(found, at, end)]
        return reader.fault("quotes", tag.lstrip("<"), at, *quotes)
    bare = BARE.search(found, start, end)
    if bare is not None:
        value = b'"' + bare["value"] + b'"'
        wanted = (bare["name"] + b"=" + value).decode("utf-8", "replace")
        change = [(bare.start("value"), bare.end("value"), value)]
        return reader.fault("bare", tag.lstrip("<"), start, *change, wanted=wanted)
    close, following = found.find(b">", start), found.find(b"<", start + 1)
    if tag in ("<", "</") or 0 <= close < following or following < 0 <= close:
        return None
    change = [(end, end, b">")] if name and end == name.end() else []
    return reader.fault("unfinished", tag.lstrip("<"), start, *change)


def _before(reader: _Reader, at: int) -> XmlFault | None:
    """Return what is above the first line of XML."""
    del at
    found = reader.found
    end = found.find(b"<")
    if found.startswith(b"\xef\xbb\xbf") or end <= 0 or reader.open:
        return None
    return reader.fault("before", "", 0, (0, end, b""))


def _declaration(reader: _Reader, at: int) -> XmlFault | None:
    """Return what is above <?xml …?>, which must be the first line."""
    del at
    found = reader.found
    mark = len(BOM) if found.startswith(BOM) else 0
    declared = [m for m in DECLARATION.finditer(found) if not _in_comment(found, m.start())]
    late = next((m for m in declared if m.start() > mark), None)
    if late is None or reader.open:
        return None
    twice = _package_twice(reader)
    if twice is not None:
        return twice
    start, end = late.span()
    above = found[mark:start]
    ending = re.compile(rb"[ \t]*\r?\n").match(found, end)
    end = ending.end() if ending is not None else end
    if declared[0].start() == mark:
        return reader.fault("declared_twice", "?xml", start, (start, end, b""))
    if not above.strip():
        return reader.fault("blank", "?xml", mark, (mark, start, b""))
    if not above.lstrip().startswith(b"<"):
        return _before(reader, start)
    row = late[0] + (b"\r\n" if b"\r\n" in found else b"\n")
    moved = ((mark, mark, row), (start, end, b""))
    fault = reader.fault("declaration", "?xml", mark, *moved)
    return replace(fault, wanted=str(reader.line(start)))


def _in_comment(found: bytes, at: int) -> bool:
    return found.rfind(b"<!--", 0, at) > found.rfind(b"-->", 0, at)


def _first_tag(found: bytes) -> int:
    """Return where the first tag is that is no <?…?> and no comment."""
    match = re.search(rb"<(?![?!])", found)
    return match.start() if match is not None else 0


def _package_twice(reader: _Reader) -> XmlFault | None:
    """Return a second <package> below the first one: the file was pasted twice."""
    found = reader.found
    end = found.find(b"</package>") + len(b"</package>")
    below = end + len(found[end:]) - len(found[end:].lstrip())
    second = re.search(rb"<package[\s>]", found[end:])
    if end < len(b"</package>") or second is None or _Reader(found[:end]).stop() is not None:
        return None
    return reader.fault("package_twice", "package", below, (end, len(found), b"\n"))


def _after(reader: _Reader, at: int) -> XmlFault | None:
    """Return what is below the last end tag."""
    found = reader.found
    if b"<" not in found:
        return reader.fault("no_tags", "", 0)
    twice = _package_twice(reader)
    if twice is not None:
        return twice
    start = found.rfind(b">") + 1
    begin = at - 1 if found[at - 1 : at] == b"<" else at
    if found[begin:].lstrip().startswith(b"</package"):
        end = begin + len(found[begin:].split(b">", 1)[0]) + 1
        return reader.fault("end_twice", "/package", begin, (begin, end, b""))
    first = re.search(rb"<package[\s>]", found)
    if first is not None and first.start() >= at and b"</package>" in found:
        return reader.fault("root_first", "package", _first_tag(found))
    root = found.rfind(b"</package>", 0, at)
    if root >= 0 and found[start:].strip() == b"":
        return reader.fault("outside", "package", at)
    if found[start:].strip() == b"" or start > at:
        return None
    return reader.fault("after", "", at, (start, len(found), b"\n"))


LOOKS: dict[str, Callable[[_Reader, int], XmlFault | None]] = {
    expat.errors.XML_ERROR_TAG_MISMATCH: _mismatch,
    expat.errors.XML_ERROR_NO_ELEMENTS: _end_of_file,
    expat.errors.XML_ERROR_UNCLOSED_TOKEN: _invalid,
    expat.errors.XML_ERROR_INVALID_TOKEN: _invalid,
    expat.errors.XML_ERROR_UNDEFINED_ENTITY: _invalid,
    expat.errors.XML_ERROR_SYNTAX: _before,
    expat.errors.XML_ERROR_MISPLACED_XML_PI: _declaration,
    expat.errors.XML_ERROR_JUNK_AFTER_DOC_ELEMENT: _after,
}
