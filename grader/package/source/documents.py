"""Files of another kind under the name of a Python file: a notebook, a web page, an archive."""

from __future__ import annotations

import json
import re

from grader.package.edit.text import read_source
from grader.package.source.broken_python import Slip
from grader.package.source.kept import keep_small
from grader.package.source.python import SHEBANG, can_parse

DOCUMENT = re.compile(
    r"\s*(?:<!--.{0,500}?-->\s*)?(?:<(?:!doctype\s+html|html|head|body|package|\?xml)\b|\{\\rtf)",
    re.I | re.S,
)
"""How texts begin that are no Python at all: a web page, package.xml, a rich text."""
SIGNATURES = (
    *(b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", b"%PDF-", b"\x7fELF", b"MZ\x90\0", b"PK\x03\x04"),
    *(b"\x1f\x8b", b"7z\xbc\xaf\x27\x1c", b"Rar!\x1a\x07"),
)
"""The first bytes of files that are no text: of office programs, PDF, programs, archives."""

NOTEBOOK = re.compile(r"\s*\{\s*\"(?:cells\"\s*:\s*\[(?=\s*(?:\{|\Z))|nbformat(?:_minor)?\"\s*:)")
ABOVE = re.compile(rb"\A(?:\xef\xbb\xbf)?(?:#[^\r\n]*|[ \t\r\n])*")
ONLY_JUPYTER = re.compile(r"^[!%][^\n]*\n?", re.M)
"""Lines that are commands for Jupyter."""


def document_of(found: bytes) -> Slip | None:
    """Return what a file is, if it is no Python file at all; None if it can be one."""
    compiled = found[2:4] == b"\r\n" and found[4:7] == b"\0\0\0"  # as in __pycache__
    if found.startswith(SIGNATURES) or compiled:
        return Slip("document", "document", 1, "")
    source = read_source(found)
    if source is None:
        return None
    first = source.line(1).strip()
    if code_cells(found) is not None or NOTEBOOK.match(source.text):
        return Slip("document", "notebook", 1, first, fixed=script_of(found))
    match = None if first.startswith("#") else DOCUMENT.match(source.text)
    if match is None:
        return None
    line = match[0].count("\n") + 1
    return Slip("document", "document", line, source.line(line).strip())


@keep_small
def code_cells(found: bytes) -> list[str] | None:
    """Return the code of a notebook's cells; None if the file is no notebook."""
    text = ABOVE.sub(b"", found, count=1)  # a shebang does not make a program of it
    if text[:1] != b"{" or b'"cells"' not in text:
        return None
    try:
        notebook = json.loads(text)
    except (ValueError, RecursionError):
        return None
    cells = notebook.get("cells") if isinstance(notebook, dict) else None
    if not isinstance(cells, list) or not all(isinstance(cell, dict) for cell in cells):
        return None
    return [_code(cell.get("source")) for cell in cells if cell.get("cell_type") == "code"]


def _code(source: object) -> str:
    lines = source if isinstance(source, list) else [source]
    return "".join(line for line in lines if isinstance(line, str))


def script_of(found: bytes) -> bytes | None:
    """Return a notebook's code as a Python file; None if that is no code that Python can read."""
    cells = [cell.strip("\r\n") for cell in code_cells(found) or [] if cell.strip()]
    if not cells:
        return None
    code = "\n\n\n".join("\n".join(cell.splitlines()) for cell in cells)
    ways = (_script(code), _script(ONLY_JUPYTER.sub("", code).strip("\n")))
    return next((script for script in ways if script is not None and can_parse(script)), None)


def _script(code: str) -> bytes | None:
    """Return a file with this code and with a shebang."""
    first = "" if code.startswith("#!") else f"{SHEBANG}\n"
    try:
        return f"{first}{code}\n".encode()
    except UnicodeEncodeError:
        return None
