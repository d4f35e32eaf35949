"""Properties of a text stream: whether it is a terminal, its width, whether it takes colours."""

from __future__ import annotations

import os
from typing import TextIO

DUMB = ("", "dumb", "unknown")
WIDTH = 80  # columns, if nothing gives a width


def is_terminal(file: TextIO) -> bool:
    """Return whether `file` is a terminal on which a line can be rewritten."""
    try:
        return file.isatty() and os.environ.get("TERM", "") not in DUMB
    except ValueError:  # it is closed
        return False


def takes_styles(file: TextIO) -> bool:
    """Return whether to use colours: a terminal, and no NO_COLOR (https://no-color.org)."""
    return is_terminal(file) and not os.environ.get("NO_COLOR")


def width_of(file: TextIO) -> int:
    """Return the columns of `file`: the terminal's own, else COLUMNS, else 80."""
    try:
        if file.isatty() and (columns := os.get_terminal_size(file.fileno()).columns) > 0:
            return columns
    except (OSError, ValueError):  # not a real file, or it is closed
        pass
    columns_set = os.environ.get("COLUMNS", "")
    return int(columns_set) if columns_set.isdecimal() and int(columns_set) > 0 else WIDTH
