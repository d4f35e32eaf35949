"""A bracket that is not closed, or that a bracket of another kind closes."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from grader.package.edit.text import Splice, indent_of
from grader.package.source.broken_python import BLOCK, Broken, Slip
from grader.package.source.python import can_parse

PAIRS = {"(": ")", "[": "]", "{": "}"}
BRACKET = re.compile(r"[()\[\]{}]")
HEAD = re.compile(rf"[ \t]*(?:{BLOCK})\b.*:[ \t]*$")
NEVER = re.compile(r"'(?P<sign>[(\[{])' was never closed")
OTHER = re.compile(r"closing parenthesis '[)\]}]' does not match opening parenthesis '[(\[{]'")
OF_SUPER = re.compile(r"\bsuper[ \t]*\([ \t]*\w+[ \t]*,[ \t]*(?P<object>self)\.__init__[ \t]*\(")
KEY = re.compile(r"['\"]_*['\"][ \t]*:")
MOST_AT_ONCE = 3
MOST_ARGUMENTS = 60  # lines below an open bracket that are looked at
ARGUMENT = re.compile(r"[ \t]*\w+[ \t]*=(?!=)")


@dataclass(frozen=True)
class Open:
    """The brackets of a line that are open, and the bracket of another kind after them, if any."""

    line: int
    signs: str
    at: int
    wrong: int | None

    @property
    def closer(self) -> str:
        """What closes the innermost bracket."""
        return PAIRS[self.signs[-1]]


def _open_argument(text: Broken, found: Open) -> Slip | None:
    """Return a line of a call's arguments with an open bracket before its comma, if it is the only one."""
    slips = []
    for number in range(found.line + 1, min(found.line + MOST_ARGUMENTS, len(text.source.lines))):
        row, written, below = (
            text.code.line(number),
            text.source.line(number),
            text.source.line(number + 1),
        )
        signs: list[str] = []
        for match in BRACKET.finditer(row):
            if match[0] in PAIRS:
                signs.append(match[0])
            elif signs:
                signs.pop()
        alike = indent_of(below) == indent_of(written) and ARGUMENT.match(below) is not None
        if not signs or not row.rstrip().endswith(",") or not alike:
            continue
        at = len(written.rstrip()) - 1
        start = text.source.start_of(number) + at
        new = text.source.spliced([Splice(start, start, PAIRS[signs[-1]])])
        if new is not None and can_parse(new):
            wanted = f"{written[:at]}{PAIRS[signs[-1]]},".strip()
            slips.append(Slip("signs", "bracket_argument", number, written.strip(), wanted, new))
    return slips[0] if len(slips) == 1 else None


def open_bracket(text: Broken) -> Slip | None:
    """Return a bracket that is not closed where it must be."""
    found = _open(text)
    if found is None:
        return None
    argument = _open_argument(text, found)
    if argument is not None:
        return argument
    shown = text.source.line(found.line).strip()
    opener = _opener(text, found)
    if opener is not None:
        return opener
    ways = [way for way in _ways(text, found) if way[3] is not None]
    ways = [way for way in ways if way[3] is not None and can_parse(way[3])] or ways
    kinds = {way[0] == "bracket_kind" for way in ways}
    if len(kinds) == 1:
        variant, line, wanted, new = ways[0]
        if variant == "bracket_kind":
            return Slip("signs", variant, line, text.source.line(line).strip(), wanted, new)
        return Slip("signs", variant, found.line, shown, wanted, new, other=line)
    if found.wrong is None:
        return Slip("signs", "bracket_open", found.line, shown, found.closer)
    line = _line_at(text, found.wrong)
    return Slip("signs", "bracket_before", found.line, shown, found.closer, other=line)


KEY = re.compile(r"\s*(?:'[^'\n]{0,80}'|\"[^\"\n]{0,80}\")[ \t]*:")


def _opener(text: Broken, found: Open) -> Slip | None:
    """Return a bracket that opens keys with their values, which a brace closes."""
    if found.wrong is None or text.code.text[found.wrong] != "}" or found.signs[-1] == "{":
        return None
    if KEY.match(text.source.text, found.at + 1) is None:
        return None
    splice = Splice(found.at, found.at + 1, "{")
    new = text.source.spliced([splice])
    if new is None or not can_parse(new):
        return None
    shown, wanted = text.source.line(found.line).strip(), _with(text, found.line, splice)
    line = _line_at(text, found.wrong)
    return Slip("signs", "bracket_opener", found.line, shown, wanted, new, other=line)


def _open(text: Broken) -> Open | None:
    """Return the brackets that are open where Python stops."""
    never, other = NEVER.search(text.fault.text), OTHER.search(text.fault.text)
    if "f-string" in text.fault.text:
        return None
    if never is None and other is None:
        return _in_head(text) if "invalid syntax" in text.fault.text else None
    waiting: list[int] = []
    wrong = None
    code = text.code.text
    for match in BRACKET.finditer(code):
        if match[0] in PAIRS:
            waiting.append(match.start())
        elif waiting and PAIRS[code[waiting[-1]]] == match[0]:
            waiting.pop()
        else:
            wrong = match.start() if waiting else None
            break
    if wrong is not None and (other is None or _line_at(text, wrong) != text.number):
        return None
    if wrong is None and never is None:
        return None
    if never is not None:
        start, end = text.code.start_of(text.number), text.code.end_of(text.number)
        waiting = [at for at in waiting if at < end]
        if not waiting or waiting[-1] < start or code[waiting[-1]] != never["sign"]:
            return None
    if not waiting:
        return None
    line = _line_at(text, waiting[-1])
    signs = "".join(code[at] for at in waiting if at >= text.code.start_of(line))
    return Open(line, signs, waiting[-1], wrong)


def _in_head(text: Broken) -> Open | None:
    """Return the bracket that is open at the colon of a line that begins a block."""
    start = text.code.start_of(text.number)
    waiting: list[int] = []
    for match in BRACKET.finditer(text.line if HEAD.match(text.line) else ""):
        if match[0] in PAIRS:
            waiting.append(match.start())
        elif not waiting or PAIRS[text.line[waiting.pop()]] != match[0]:
            return None
    signs = "".join(text.line[at] for at in waiting)
    return Open(text.number, signs, start + waiting[-1], None) if waiting else None


def _ways(text: Broken, found: Open) -> Iterator[tuple[str, int, str, bytes | None]]:
    """Yield what may be meant: the variant, the line to change, what it is then, and the file."""
    if found.wrong is not None:
        line = _line_at(text, found.wrong)
        splice = Splice(found.wrong, found.wrong + 1, found.closer)
        yield "bracket_kind", line, _with(text, line, splice), text.changed(splice)
    last = _last_line(text, found)
    opener = text.code.line(found.line)
    if found.wrong is None and (own := OF_SUPER.search(opener)) is not None:
        at = text.code.start_of(found.line) + own.end("object")
        yield (
            "bracket_end",
            found.line,
            _with(text, found.line, Splice(at, at, ")")),
            text.changed(Splice(at, at, ")")),
        )
    indent = indent_of(text.source.line(found.line))
    at = found.wrong if found.wrong is not None else len(text.code.text)
    if opener.rstrip().endswith(found.signs[-1]):
        if last > found.line and text.code.end_of(last) <= at:
            comma = "," if _is_inside(text, found) else ""
            splice = text.source.before(last + 1, f"{indent}{found.closer}{comma}")
            yield "bracket_below", last, f"{found.closer}{comma}", text.changed(splice)
        if found.wrong is None or last == found.line:
            return
    place = min(_end_of_code(text, last), _before(text, at))
    if place <= found.at + 1:
        return
    for count in range(1, min(len(found.signs), MOST_AT_ONCE) + 1):
        closers = "".join(PAIRS[sign] for sign in reversed(found.signs[-count:]))
        splice = Splice(place, place, closers)
        line = _line_at(text, place)
        yield "bracket_end", line, _with(text, line, splice), text.changed(splice)


def _last_line(text: Broken, found: Open) -> int:
    """Return the last line that is indented more than the line of the bracket, below it."""
    width, last = len(indent_of(text.code.line(found.line))), found.line
    if HEAD.match(text.code.line(last)):
        return last
    for number in range(found.line + 1, len(text.code.lines) + 1):
        row = text.code.line(number)
        if not row.strip():
            continue
        if len(indent_of(row)) <= width:
            break
        last = number
    return last


def _is_inside(text: Broken, found: Open) -> bool:
    """Whether the bracket is inside of another one."""
    before = text.code.text[: found.at]
    opened = sum(before.count(sign) for sign in PAIRS)
    return opened > sum(before.count(sign) for sign in PAIRS.values())


def _end_of_code(text: Broken, line: int) -> int:
    """Return where the code of a line ends, without a comma or the colon of a block."""
    row = text.code.line(line).rstrip()
    row = row[:-1].rstrip() if row.endswith(",") or HEAD.match(row) else row
    return text.code.start_of(line) + len(row)


def _before(text: Broken, at: int) -> int:
    """Return the place after the code, and the comma, in front of a bracket."""
    before = text.code.text[:at].rstrip()
    return len(before[:-1].rstrip() if before.endswith(",") else before)


def _with(text: Broken, line: int, splice: Splice) -> str:
    start, end = text.source.start_of(line), text.source.end_of(line)
    row = text.source.text[start:end]
    return (row[: splice.start - start] + splice.new + row[splice.end - start :]).strip()


def _line_at(text: Broken, position: int) -> int:
    part = text.code.text[:position]
    return part.count("\n") + part.count("\r") - part.count("\r\n") + 1
