"""What stays on a terminal: lines can be erased, overwritten or hidden as soon as they are printed."""

from __future__ import annotations

import re
from collections.abc import Callable

from grader.sandbox.base import COLUMNS, ROWS

SCROLL_BACK = 10_000  # lines
MOST_BYTES = 1_000_000  # that are shown on the model of a screen, from the end of the output
# everything except text, line ends and colours: ECMA-48; a carriage return that ends no line
MOVES = re.compile(rb"\x1b(?!\[[0-9;]*m)|[\x08\x0b\x0c\x0e\x0f]|\xc2[\x80-\x9f]|\r(?![\r\n]|$)")
CONCEALS = re.compile(rb"\x1b\[(?:[0-9;]*;)?0*8m|\x1b\[(?:[0-9;]*;)?0*8;[0-9;]*m")
COLOURS = re.compile(rb"[34]8;(?:5;\d+|2;\d+;\d+;\d+)")  # an 8 in these is not "conceal"


def stays(output: bytes) -> Callable[[str], bool] | None:
    """Return a test whether a text can still be read on the terminal after this output.

    None if the output only adds lines, so that everything can.
    """
    if CONCEALS.search(COLOURS.sub(b"", output)):
        return lambda _: False
    if not MOVES.search(output):
        return None
    import pyte  # noqa: PLC0415 - slow, and few outputs need it

    screen = pyte.HistoryScreen(COLUMNS, ROWS, history=SCROLL_BACK, ratio=0.5)
    pyte.ByteStream(screen).feed(output[-MOST_BYTES:])
    above = ["".join(line[column].data for column in range(COLUMNS)) for line in screen.history.top]
    rows = [row.rstrip() for row in (*above, *screen.display)]
    unwrapped = "".join(row.ljust(COLUMNS) for row in rows)
    return lambda text: (
        any(row.endswith(text) for row in rows) or (len(text) > COLUMNS // 2 and text in unwrapped)
    )
