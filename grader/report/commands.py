"""Commands that a student copies: recognised, taken apart, and broken where a shell reads on."""

from __future__ import annotations

import re
from collections.abc import Iterator

from rich.cells import cell_len

COMMAND = re.compile(
    r"(?:cd|source|ros2|touch|mkdir|chmod|mv|colcon|sudo|rmdir) |(?:fg|check)(?=$|   \()"
)
PART = re.compile(r"\s*(?:&&|;)\s*")
BEHIND = re.compile(rf"(.*?:) ((?:{COMMAND.pattern})(?:(?!, |\. ).)*[^.,])")
"""A line that ends with a command: a colon stands between them."""
REMARK = "   ("
"""What begins a remark behind a command."""
WORD = re.compile(r"""\s*(?:'[^']*'|"[^"]*"|[^\s'"])+""")
WHOLE = re.compile(r"""(?:'[^']*'|"[^"]*"|[^'"&;])+(?:&&|;)?""")
"""A command of a line, with what joins it to the next one."""
BETWEEN = " \\"
"""The end of a line behind which a shell reads on."""
INDENT = "    "


def is_command(line: str) -> bool:
    """Whether a line is to be copied: it is broken only where a shell reads on."""
    return COMMAND.match(line) is not None and line.partition(REMARK)[0].isascii()


def parts_of(command: str) -> list[str]:
    """Return the commands of a line, one after the other."""
    return PART.split(command) if is_command(command) else []


def command_behind(line: str) -> tuple[str, str]:
    """Return what stands before the command with which a line ends, and the command; "" if none."""
    found = BEHIND.fullmatch(line)
    if found is None or not found[2].isascii():  # (a sentence may begin with a command's name)
        return line, ""
    return found[1], found[2]


def broken(command: str, width: int, *, first: int = 0) -> str:
    """Return a command in lines of at most so many columns, if its words are not longer.

    `first` columns of the first line are taken.
    """
    lines = list(_lines(command, width, first))
    return f"{BETWEEN}\n{INDENT}".join(lines)


def _lines(command: str, width: int, first: int) -> Iterator[str]:
    """Yield the lines: each begins with a command if it has room for the whole, else with a word."""
    if cell_len(command) <= width - first:
        yield command
        return
    line, room = "", width - first - len(BETWEEN)
    for part in WHOLE.findall(command):
        is_whole = cell_len(part.lstrip()) <= width - len(INDENT) - len(BETWEEN)
        for piece in [part] if is_whole else WORD.findall(part):
            if line and cell_len(line + piece) > room:
                yield line
                line, room = piece.lstrip(), width - len(INDENT) - len(BETWEEN)
            else:
                line += piece
    yield line
