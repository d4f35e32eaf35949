"""The lines that a change replaces, as a hint shows them: below their file and line."""

from __future__ import annotations

import re

from grader.base.i18n.message import joined, say

MARGIN = "    "
"""Before a line of code: it is copied, so it is never wrapped."""
MOST_LINES = 40
HUNK = re.compile(r"^@@ -(\d+)")


def code(text: str, *, place: str = "") -> str:
    """Return lines of code for a hint, below the place at which they belong."""
    lines = "\n".join(f"{MARGIN}{line}" for line in text.split("\n"))
    return joined(f"{place}:" if place else "", lines, by="\n")


def changes_in(patch: str) -> str:
    """Return the lines that a patch takes away and adds, below file and line; "" if it has none.

    A line that is added alone is said to be in the line of the one that it pushes down.
    """
    parts: list[str] = []
    file, line, shown = "", 0, 0
    run: list[str] = []
    begins = 0
    for text in [*patch.splitlines(), " "]:
        if text.startswith(("--- ", "+++ ")):
            name = text[4:].strip()
            file = name.partition("/")[2] if name != "/dev/null" else file
        elif hunk := HUNK.match(text):
            line = int(hunk[1])
        elif text[:1] in ("-", "+"):
            begins = begins if run else line
            run.append(text)
            line += text[0] == "-"
            continue
        else:
            line += 1
        if run and shown + len(run) <= MOST_LINES:
            place = say("{file}, line {line}", file=file, line=max(begins, 1))
            parts.append(joined(place, code("\n".join(run)), by=":\n"))
            shown += len(run)
        run = []
    return joined(*parts, by="\n") if parts else ""
