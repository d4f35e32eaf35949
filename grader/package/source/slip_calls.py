"""One slip in a call of several lines, such as setup(): a sign or a line is missing, or there twice."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from grader.package.edit.text import Splice, indent_of
from grader.package.source.broken_python import MOST_TRIES, Broken, Slip
from grader.package.source.python import can_parse

PREFIXES = ("f", "r", "b", "u", "rb", "br", "fr", "rf")
NO_EQUALS = re.compile(r"[ \t]+(?P<name>[a-z_]\w*)[ \t]*(?=['\"\[{])")
ARGUMENT = re.compile(r"[ \t]*[a-z_]\w*[ \t]*=(?!=)[^=].*,[ \t]*$")
DANGLES = re.compile(r"(?:[:=,]|\()[ \t]*$")
CALLED = re.compile(r"[ \t]*(?:[A-Za-z_][\w.]*[ \t]*=[ \t]*)?[A-Za-z_][\w.]*[ \t]*$")
VALUE_ENDS = re.compile(r"[\w)\]}'\"][ \t]*$")
IMPORTS = re.compile(
    r"[ \t]*from[ \t]+[\w.]+[ \t]+import[ \t]+(?P<names>\w+(?:[ \t]*,?[ \t]+\w+)+)[ \t]*$"
)
ENTRY_QUOTE = re.compile(
    r"[ \t]*(?P<name>[A-Za-z_][\w-]*)[ \t]*=[ \t]*(?P<quote>['\"])(?P<target>[\w.]+:\w+)(?P=quote),?[ \t]*$"
)
MISMATCH = re.compile(
    r"closing parenthesis '(?P<closer>[\])}])' does not match opening parenthesis"
)
OPENERS = {"]": "[", ")": "(", "}": "{"}
MARKER = "share/ament_index/resource_index/packages"
ABOVE = 12  # lines above the one at which Python stops, in which the slip can be


def _nearby(text: Broken) -> Iterator[int]:
    """Yield the line at which Python stops, and those above it, nearest first."""
    yield from range(text.number, max(text.number - ABOVE, 0), -1)


def _slip(text: Broken, variant: str, line: int, *splices: Splice, other: int = 0) -> Slip | None:
    """Return the slip of a line if the whole file can be parsed after the change."""
    new = text.source.spliced(list(splices))
    if new is None or not can_parse(new):
        return None
    start, end = text.source.start_of(line), text.source.end_of(line)
    wanted = text.source.text[start:end]
    for splice in sorted(splices, key=lambda s: s.start, reverse=True):
        if start <= splice.start and splice.end <= end:
            wanted = wanted[: splice.start - start] + splice.new + wanted[splice.end - start :]
    shown = text.source.line(line).strip()
    return Slip("signs", variant, line, shown, wanted.strip(), new, other=other or line)


def _equals_of_argument(text: Broken) -> Slip | None:
    """Return an argument without the = between its name and its value."""
    for number in _nearby(text):
        match = NO_EQUALS.match(text.source.line(number))
        if match is None or match["name"] in (*PREFIXES, "print", "exec", "echo"):
            continue
        at = text.source.start_of(number) + match.end("name")
        end = text.source.start_of(number) + match.end()
        found = _slip(text, "equals_of_argument", number, Splice(at, end, "="))
        if found is not None:
            return found
    return None


def _entry_quote(text: Broken) -> Slip | None:
    """Return an entry of console_scripts whose first quote is behind the = and not before it."""
    for number in _nearby(text):
        match = ENTRY_QUOTE.match(text.source.line(number))
        if match is None:
            continue
        at = text.source.start_of(number)
        entry = f"{match['quote']}{match['name']} = {match['target']}{match['quote']}"
        splice = Splice(at + match.start("name"), at + match.end("target") + 1, entry)
        found = _slip(text, "entry_quote", number, splice)
        if found is not None:
            return found
    return None


def _semicolon_in_call(text: Broken) -> Slip | None:
    """Return a line of a call that ends with a semicolon."""
    for number in _nearby(text):
        row = text.code.line(number).rstrip()
        at = text.source.start_of(number) + len(row)
        if row.endswith(";"):
            found = _slip(text, "semicolon_in_call", number, Splice(at - 1, at, ","))
            if found is not None:
                return found
    return None


def _line_twice(text: Broken) -> Slip | None:
    """Return a line that opens brackets and stands twice, one below the other."""
    for number in (text.number + 1, *_nearby(text)):
        row = text.source.line(number).strip() if number <= len(text.source.lines) else ""
        if (
            number < 2
            or row != text.source.line(number - 1).strip()
            or row[-1:] not in ("[", "(", "{")
        ):
            continue
        found = _slip(text, "line_twice", number, text.source.without(number), other=number - 1)
        if found is not None:
            return found
    return None


def _lines_swapped(text: Broken) -> Slip | None:
    """Return two lines that both open brackets, and stand in the wrong order."""
    for number in _nearby(text):
        rows = [text.source.line(n) for n in (number - 1, number)] if number > 1 else []
        if not rows or any(row.rstrip()[-1:] not in ("[", "(", "{") for row in rows):
            continue
        indents = [indent_of(row) for row in rows]
        start, end = text.source.start_of(number - 1), text.source.end_of(number)
        new = text.source.newline.join((rows[1], rows[0]))
        found = _slip(text, "lines_swapped", number, Splice(start, end, new), other=number - 1)
        if found is not None and indents[0] != indents[1]:
            return found
    return None


def _argument_in_braces(text: Broken) -> Slip | None:
    """Return an argument of the call in the braces of the argument above it."""
    above = next((n for n in range(text.number - 1, 0, -1) if text.code.line(n).strip()), 0)
    row = text.code.line(above).rstrip() if above else ""
    if not ARGUMENT.match(text.line) or not re.search(r"=[ \t]*\{$", row):
        return None
    moved = text.source.before(above, text.source.line(text.number))
    return _slip(
        text,
        "argument_in_braces",
        text.number,
        moved,
        text.source.without(text.number),
        other=above,
    )


def _opener_of_value(text: Broken) -> Slip | None:
    """Return a value whose first bracket is missing: its last one closes another."""
    told = MISMATCH.search(text.fault.text)
    sign = OPENERS[told["closer"]] if told is not None else ""
    for number in _nearby(text) if sign else ():
        row, start = text.code.line(number), text.source.start_of(number)
        if number < text.number and DANGLES.search(row) and not row.rstrip().endswith("("):
            at = start + len(row.rstrip())
            blank = " " if row.rstrip()[-1] in ":," else ""
            found = _slip(text, "opener_missing", number, Splice(at, at, f"{blank}{sign}"))
            if found is not None:
                return found
        for match in list(re.finditer(r"[,(=:][ \t]*(?=\S)", row))[-MOST_TRIES:][::-1]:
            at = start + match.end()
            if number == text.number or number == text.number - 1:
                found = _slip(text, "opener_missing", number, Splice(at, at, sign))
                if found is not None:
                    return found
    return None


def _data_files(text: Broken) -> Slip | None:
    """Return the lines of data_files without the line that begins them."""
    if re.search(r"\bdata_files\b", text.code.text) or "does not match" not in text.fault.text:
        return None
    for number, row in enumerate(text.source.lines, 1):
        if MARKER in row and text.source.line(number).lstrip().startswith("("):
            indent = indent_of(text.source.line(number))[:-4]
            head = text.source.before(number, f"{indent}data_files=[")
            found = _slip(text, "data_files_gone", number, head)
            if found is not None:
                return found
    return None


def _marker_line(text: Broken) -> Slip | None:
    """Return the line of the marker's folder without the line of the marker below it."""
    for number in _nearby(text):
        row = text.source.line(number)
        ends = row.rstrip().endswith(f"{MARKER}',") or row.rstrip().endswith(f'{MARKER}",')
        if not ends or "package_name" not in text.code.text:
            continue
        indent = indent_of(row) + "    "
        line = f"{indent}['resource/' + package_name]),"
        found = _slip(text, "marker_line_gone", number, text.source.before(number + 1, line))
        if found is not None:
            return found
    return None


def _call_open(text: Broken) -> Slip | None:
    """Return the name of a function without its bracket, above its indented arguments."""
    above = next((n for n in range(text.number - 1, 0, -1) if text.code.line(n).strip()), 0)
    row = text.code.line(above) if above else ""
    if "unexpected indent" not in text.fault.text or not CALLED.match(row):
        return None
    at = text.source.start_of(above) + len(row.rstrip())
    return _slip(text, "call_open", above, Splice(at, at, "("))


def _comma_at_end(text: Broken) -> Slip | None:
    """Return a line of a call that ends without its comma, below the line that Python names."""
    if "forgot a comma" not in text.fault.text:
        return None
    last = len(text.source.lines)
    for number in range(text.number, min(text.number + ABOVE, last) + 1):
        row = text.code.line(number)
        if not VALUE_ENDS.search(row):
            continue
        at = text.source.start_of(number) + len(row.rstrip())
        found = _slip(text, "comma_at_end", number, Splice(at, at, ","))
        if found is not None:
            return found
    return None


def _import_names(text: Broken) -> Slip | None:
    """Return an import of several names, of which two have no comma between them."""
    match = IMPORTS.match(text.line)
    if match is None:
        return None
    names = re.findall(r"\w+", match["names"])
    if "as" in names or "import" in names:
        return None
    start = text.source.start_of(text.number)
    splice = Splice(start + match.start("names"), start + match.end("names"), ", ".join(names))
    return _slip(text, "import_names", text.number, splice)


CALL_LOOKS: tuple[Callable[[Broken], Slip | None], ...] = (
    _import_names,
    _entry_quote,
    _semicolon_in_call,
    _line_twice,
    _lines_swapped,
    _call_open,
    _argument_in_braces,
    _data_files,
    _marker_line,
    _opener_of_value,
    _equals_of_argument,
)
LATE_CALL_LOOKS = (_comma_at_end,)
