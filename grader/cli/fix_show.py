"""A diff on a terminal in colours, elsewhere byte for byte."""

from __future__ import annotations

from typing import TextIO

from rich.text import Text

from grader.base.gate import bytes_of
from grader.base.gated_console import GatedConsole

STYLES = {"+": "green", "-": "red", "@": "cyan", "d": "bold"}
"""By a line's first character; of the lines with names (`---`, `+++`) see below."""


def show_diff(patch: bytes, file: TextIO) -> None:
    """Write a diff: a terminal sees it in colours, and no control characters of the student's."""
    if not file.isatty():
        file.flush()
        raw = bytes_of(file)
        raw.write(patch)
        raw.flush()
        return
    console = GatedConsole(file, soft_wrap=True)
    for line in patch.decode("utf-8", "backslashreplace").split("\n")[:-1]:
        named = line.startswith(("--- ", "+++ "))
        style = "bold" if named else STYLES.get(line[:1], "")
        console.print(Text(_plain(line), style=style), soft_wrap=True)


def _plain(line: str) -> str:
    return "".join(c if c.isprintable() or c == "\t" else _escaped(c) for c in line)


def _escaped(sign: str) -> str:
    return sign.encode("unicode_escape", "surrogatepass").decode("ascii")
