"""A value without a name behind one with a name, in a call."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from grader.package.edit.text import Splice
from grader.package.source.broken_python import Broken, Slip

CALLED = re.compile(r"(?P<name>\w{1,120})[ \t]*\Z")
NAMED = re.compile(r"\s*(?P<name>[A-Za-z_]\w*)\s*=(?!=)")
MOST_CODE = 4000  # characters of a call
NAMES = {"create_timer": ("timer_period_sec", "callback")}
"""The first parameters of methods that a node calls."""


@dataclass(frozen=True)
class _Call:
    """A call: the name of the function, and where each value begins and what it is."""

    name: str
    values: list[tuple[int, str]]

    @property
    def names(self) -> list[str]:
        """The names of the values; "" for those without one."""
        found = [NAMED.match(value) for _, value in self.values]
        return [match["name"] if match is not None else "" for match in found]

    @property
    def wrong(self) -> list[int]:
        """The indices of the values without a name behind one with a name."""
        names = self.names
        return [n for n, name in enumerate(names) if not name and any(names[:n])]


def _calls(text: Broken) -> Iterator[_Call]:
    """Yield the calls that end on the line at which Python stops, the inner ones first."""
    code = text.code.text
    start, end = text.code.start_of(text.number), text.code.end_of(text.number)
    for close in range(start, min(end, start + MOST_CODE)):
        call = _ending_at(code, close) if code[close] == ")" else None
        if call is not None:
            yield call


def _ending_at(code: str, close: int) -> _Call | None:
    depth, commas = 0, [close]
    for at in range(close - 1, max(-1, close - MOST_CODE), -1):
        if code[at] in ")]}":
            depth += 1
        elif code[at] in "([{" and depth:
            depth -= 1
        elif code[at] in "([{":
            match = CALLED.search(code[max(0, at - MOST_CODE) : at]) if code[at] == "(" else None
            if match is None:
                return None
            edges = [at, *reversed(commas)]
            parts = [(a + 1, code[a + 1 : b]) for a, b in zip(edges, edges[1:])]
            return _Call(match["name"], [(a, part) for a, part in parts if part.strip()])
        elif code[at] == "," and not depth:
            commas.append(at)
    return None


def unnamed_argument(text: Broken) -> Slip | None:
    """Return the value that needs a name, and the name if the function is known."""
    if "positional argument follows keyword" not in text.fault.text:
        return None
    for call in _calls(text):
        if not call.wrong:
            continue
        at, value = call.values[call.wrong[0]]
        at += len(value) - len(value.lstrip())
        line = text.code.text.count("\n", 0, at) + 1
        shown = text.source.line(line).strip()
        missing = [n for n in NAMES.get(call.name, ()) if n not in call.names]
        splice = Splice(at, at, f"{missing[0]}=") if len(missing) == 1 else None
        fixed = text.changed(splice) if splice is not None and len(call.wrong) == 1 else None
        if splice is None or fixed is None:
            return Slip("signs", "argument_order", line, shown)
        begin = at - text.code.start_of(line)
        row = text.source.line(line)
        wanted = f"{row[:begin]}{splice.new}{row[begin:]}".strip()
        return Slip("signs", "argument_name", line, shown, wanted, fixed)
    shown = text.source.line(text.number).strip()
    return Slip("signs", "argument_order", text.number, shown)
