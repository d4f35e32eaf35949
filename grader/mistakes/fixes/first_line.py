"""Fixes of the node's first line, and of line endings that break it."""

from __future__ import annotations

import re

from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.syntax import without_labels
from grader.package.edit.files import Files
from grader.package.edit.text import BOM, MOST_BYTES, read_source
from grader.package.source.documents import document_of
from grader.package.source.python import SHEBANG, can_parse

SCRIPT = re.compile(r"[#!\s]*(?:/|\b)(?:usr/|bin/|env\b)[\w/ .-]*python[\d.]*\s*", re.IGNORECASE)
LATE = 20


def byte_order_mark(case: Case) -> Files | None:
    """Remove the byte order mark."""
    found = case.files.data(case.judged_path)
    if found is None or not found.startswith(BOM) or not can_parse(found):
        return None
    return case.with_data(case.judged_path, found[len(BOM) :])


def line_ends(case: Case) -> Files | None:
    """Convert the line endings from CRLF to LF."""
    found = case.files.data(case.judged_path)
    if found is None or len(found) > MOST_BYTES or b"\0" in found:
        return None
    if not found.partition(b"\n")[0].endswith(b"\r"):
        return None
    new = found.replace(b"\r\n", b"\n") if b"\n" in found else found.replace(b"\r", b"\n")
    return case.with_data(case.judged_path, new) if _same_code(found, new) else None


def _same_code(old: bytes, new: bytes) -> bool:
    """Whether both versions can be parsed, or neither."""
    return can_parse(old) == can_parse(new)


def shebang(case: Case) -> Files | None:
    """Put the shebang on line 1: moved up, fixed, or added."""
    found = case.files.data(case.judged_path)
    found = without_labels(found) if found is not None else None
    if found is not None and document_of(found) is not None:
        return None
    text = read_source(found)
    if found is None or text is None or text.mark or not found.strip():
        return None
    first = text.line(1)
    if text.newline != "\n":
        # a shebang with a Windows line ending does not work: convert the whole file
        found = found.replace(b"\r\n", b"\n")
        text = read_source(found)
        if text is None or "\r" in text.text:
            return None
    if first.startswith("#!") or SCRIPT.fullmatch(first):
        splices = [text.without(1), text.before(1, SHEBANG)]
    else:
        splices = [text.before(1, SHEBANG)]
        late = [n for n in range(2, LATE) if text.line(n).startswith("#!")]
        splices += [text.without(late[0])] if late else []
    new = found if first == SHEBANG else text.spliced(splices)
    return case.with_data(case.judged_path, new) if new and can_parse(new) else None
