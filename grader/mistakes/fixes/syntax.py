"""Fixes of syntax errors for which only one small change is possible."""

from __future__ import annotations

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import SourceText, Splice, indent_of, read_source
from grader.package.source.documents import document_of
from grader.package.source.other_encoding import declaration
from grader.package.source.pasted import cleaned, labels_in
from grader.package.source.python import PythonFault, parse_python
from grader.package.source.slips import slip_of

TAB_WIDTHS = (2, 4, 8)
TRIES = 10


def node(case: Case) -> Files | None:
    """Fix the node's file, or a module of it that is the finding's place."""
    place = case.finding.file
    there = place.endswith(".py") and case.files.file(place) is not None
    return _fixed(case, place if there else case.node_path)


def setup_py(case: Case) -> Files | None:
    """Fix setup.py."""
    return _fixed(case, "setup.py")


def fault_of(found: bytes) -> PythonFault | None:
    """Return why Python cannot parse a file; None if it can."""
    try:
        parse_python(found)
    except PythonFault as fault:
        return fault
    return None


def _fixed(case: Case, path: str) -> Files | None:
    found = _without_declaration(case.files.data(path))
    document = document_of(found) if found is not None else None
    if document is not None:
        return case.with_data(path, document.fixed)
    for _ in range(TRIES):
        fault = fault_of(found) if found is not None else None
        text = read_source(found)
        if found is None or fault is None or text is None:
            break
        found = _fixed_once(text, found, fault)
    if found is None or fault_of(found) is not None:
        return None
    return case.with_data(path, without_labels(found))


def _without_declaration(found: bytes | None) -> bytes | None:
    """Return UTF-8 without a comment that declares another encoding, if Python stops at that."""
    fault = fault_of(found) if found is not None else None
    declared = declaration(found) if found is not None else None
    if found is None or fault is None or fault.kind != "encoding" or declared is None:
        return found
    rows = found.split(b"\n")
    return b"\n".join(rows[: declared[0] - 1] + rows[declared[0] :])


def _fixed_once(text: SourceText, found: bytes, fault: PythonFault) -> bytes | None:
    """Return the file without the error at which Python stops; None if no fix is certain."""
    if fault.kind == "tabs" and (new := _without_tabs(text)) is not None:
        return new
    slip = slip_of(found)
    return slip.fixed if slip is not None else None


def without_labels(found: bytes) -> bytes:
    """Return a file without the labels of a web page that Python takes for names."""
    text, labels = read_source(found), labels_in(found)
    new = cleaned(text, labels) if text is not None and labels else None
    return found if new is None else new


def _without_tabs(text: SourceText) -> bytes | None:
    """Return the file indented with spaces instead of tabs, if only one tab width works."""
    fitting = []
    for width in TAB_WIDTHS:
        splices = []
        for number, line in enumerate(text.lines, start=1):
            indent = indent_of(line)
            start = text.start_of(number)
            splices.append(Splice(start, start + len(indent), indent.expandtabs(width)))
        new = text.spliced(splices)
        if new is not None and fault_of(new) is None:
            fitting.append(new)
    return fitting[0] if len(fitting) == 1 else None
