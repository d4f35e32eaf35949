"""Slips in the form of lines and blocks: brackets, colons, indentation, and texts without an end."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from grader.package.edit.text import Splice, indent_of
from grader.package.source.broken_python import BLOCK, MOST_TRIES, Broken, Slip
from grader.package.source.python import can_parse

CLOSES = {")": "(", "]": "[", "}": "{"}
OPENER = re.compile(rf"[ \t]*(?:{BLOCK}|async|match|case)\b")
FUNCTION = re.compile(
    r"[ \t]*(?P<name>[a-z_]\w{0,80})[ \t]*\((?:|(?:self|args)\b.*)\)[ \t]*:[ \t]*"
)
WORD = re.compile(
    rf"[ \t]*(?P<word>(?i:{BLOCK}|import|from|return|pass|break|continue|raise|global|nonlocal|assert))\b"
)
CLAUSE = re.compile(r"[ \t]*(?:except|finally|else|elif)\b")
AFTER_COLON = re.compile(r"expected an indented block after .{0,60} on line (?P<line>\d{1,6})")
EXTRA = "unexpected indent"
UNMATCHED = "unindent does not match"
TRIPLE = re.compile(r"\"\"\"|'''")
EQUALS = re.compile(r"(?<![=!<>:+*/%-])=(?!=)")
CONDITION = re.compile(r"[ \t]*(?:if|elif|while|assert|and|or|not)\b")
LONGEST_TEXT = 4  # lines of a docstring after which its end is looked for


def _bracket(text: Broken) -> Slip | None:
    """Return a closing bracket that closes nothing."""
    if "unmatched" not in text.fault.text:
        return None
    start, end = text.code.start_of(text.number), text.code.end_of(text.number)
    at = _unmatched(text.code.text[:end])
    if at is None or at < start:
        return None
    sign = text.code.text[at]
    if (closed := _closed_before(text, at)) is not None:
        return closed
    new = text.changed(Splice(at, at + 1, ""))
    if new is None:
        return None
    double = text.code.text[start:at].rstrip()[-1:] in CLOSES
    shown = text.source.line(text.number).strip()
    variant = "bracket_extra" if double else "bracket_alone"
    return Slip("signs", variant, text.number, shown, sign, new if double else None)


def _closed_before(text: Broken, at: int) -> Slip | None:
    """Return a call that is closed, with more values and a second closing bracket behind it."""
    start = text.code.start_of(text.number)
    before = text.code.text[start:at]
    end = start + before.rfind(")") + 1
    rest = text.code.text[end:at]
    if end == start or not re.match(r"[ \t]*,[ \t]*\S", rest) or "(" in rest:
        return None
    written = text.source.text
    twice = written[end:at].strip(" \t,") in written[start:end]
    splice = Splice(end, at + 1, "") if twice else Splice(end - 1, end, "")
    new = text.changed(splice)
    if new is None or not can_parse(new):
        return None
    variant = "bracket_closed_before" if twice else "bracket_too_early"
    return text.slip("signs", variant, text.source.line(text.number), splice, fixed=new)


def _unmatched(code: str) -> int | None:
    """Return the place of the first closing bracket that closes no bracket before it."""
    waiting: list[str] = []
    for match in re.finditer(r"[()\[\]{}]", code):
        sign = match[0]
        if sign not in CLOSES:
            waiting.append(sign)
        elif not waiting or waiting.pop() != CLOSES[sign]:
            return match.start() if not waiting else None
    return None


def _colon(text: Broken) -> Slip | None:
    """Return a colon after a line that begins no block, or a function without def."""
    line = text.line
    ends = len(line.rstrip())
    if not line.rstrip().endswith(":") or OPENER.match(line):
        return None
    if _next_indent(text) > len(indent_of(line)):
        match = FUNCTION.fullmatch(line)
        at = match.start("name") if match is not None else 0
        splice, variant = text.within(at, at, "def "), "def_missing"
    else:
        match = FUNCTION.match(line) or re.match("", line)
        splice, variant = text.within(ends - 1, ends, ""), "colon_extra"
    new = text.changed(splice) if match is not None else None
    shown = text.source.line(text.number)
    return text.slip("signs", variant, shown, splice, fixed=new) if new is not None else None


def _next_indent(text: Broken) -> int:
    """Return the width of the indentation of the next line with code; 0 if there is none."""
    for number in range(text.number + 1, len(text.code.lines) + 1):
        if text.code.line(number).strip():
            return len(indent_of(text.code.line(number)))
    return 0


def _capital(text: Broken) -> Slip | None:
    """Return a word of Python that is written with capital letters."""
    match = WORD.match(text.line)
    if match is None or match["word"].islower():
        return None
    splice = text.within(*match.span("word"), match["word"].lower())
    new = text.changed(splice)
    return text.slip("language", "capital", match["word"], splice, fixed=new) if new else None


def _compare(text: Broken) -> Slip | None:
    """Return one equals sign where two are needed."""
    if "'=='" not in text.fault.text or CONDITION.match(text.line) is None:
        return None
    for match in list(EQUALS.finditer(text.line))[:MOST_TRIES]:
        splice = text.within(*match.span(), "==")
        new = text.changed(splice)
        if new is not None:
            return text.slip(
                "signs", "one_equals", text.source.line(text.number), splice, fixed=new
            )
    return None


def _not_indented(text: Broken) -> Slip | None:
    """Return the first line of a block that is not indented, or a block without a line."""
    match = AFTER_COLON.search(text.fault.text)
    if match is None or text.fault.kind != "indentation":
        return None
    head, shown = int(match["line"]), text.source.line(text.number).strip()
    if head == text.number:
        return Slip("signs", "block_missing", head, shown)
    twice = _head_twice(text, head)
    if twice is not None:
        return twice
    if not 0 < head < text.number:
        return None
    deeper = _head_deeper(text, head)
    if deeper is not None:
        return deeper
    width = len(indent_of(text.source.line(head)))
    between = [row for n in range(head + 1, text.number) if (row := text.source.line(n)).strip()]
    comment = _only_comment(text, head, between) if between else None
    if any(len(indent_of(row)) > width for row in between):
        return comment
    own = len(indent_of(text.source.line(text.number)))
    deeper = _def_of_class(text, head)
    if deeper is not None:
        return deeper
    if own == width and _is_end_of_node(text, head) and not between:
        new = text.changed(text.source.before(head + 1, " " * (width + 4) + "pass"))
        code = text.source.line(head).strip()
        return Slip("signs", "block_empty", head, code, "", new, other=text.number)
    for lines in _lines_of_block(text, head) if own <= width else ():
        columns = " " * (width + 4 - own)
        starts = [text.source.start_of(n) for n in lines if text.source.line(n).strip()]
        new = text.changed(*(Splice(at, at, columns) for at in starts))
        if new is not None and can_parse(new):
            return Slip("signs", "lines_not_indented", text.number, shown, str(lines[-1]), new,
                        other=head)  # fmt: skip
    if own < width or re.match(r"[ \t]*(?:def|class|@|async|else|elif|except|finally)", text.line):
        empty = text.source.line(head).strip()
        return comment or Slip("signs", "block_empty", head, empty, other=text.number)
    alone = own == width and (_next_indent(text) > own or _ends_after(text))
    new = text.changed(text.within(0, 0, " " * 4)) if alone else None
    return Slip("signs", "not_indented", text.number, shown, "", new, other=head)


def _is_end_of_node(text: Broken, head: int) -> bool:
    """Whether an except has no line, and the line below it ends the node: it is for every end."""
    ends = re.search(r"\.(?:try_)?shutdown\(|\bdestroy_node\(", text.line)
    return ends is not None and text.source.line(head).strip().startswith("except")


def _only_comment(text: Broken, head: int, rows: list[str]) -> Slip:
    """Return a block in which is only a comment."""
    width, indent = len(indent_of(text.source.line(head))), indent_of(rows[0])
    indent = indent if len(indent) > width else " " * (width + 4)
    new = text.changed(text.source.before(head + 1, f"{indent}pass"))
    code = text.source.line(head).strip()
    return Slip("signs", "block_comment", head, code, "", new, other=text.number)


def _head_deeper(text: Broken, head: int) -> Slip | None:
    """Return a def or class that is indented further than the others, unlike its block."""
    row, width = text.code.line(head), len(indent_of(text.code.line(head)))
    match = re.match(r"[ \t]+(?:async[ \t]+)?(?P<word>def|class)\b", row)
    if match is None or len(indent_of(text.line)) != width or width < 4:
        return None
    same = re.compile(rf"(?P<indent>[ \t]*)(?:async[ \t]+)?{match['word']}\b")
    heads = [n for n, _ in enumerate(text.code.lines, 1) if n != head]
    columns = {len(m["indent"]) for n in heads if (m := same.match(text.code.line(n)))}
    of_module = re.match(r"[ \t]+(?:async[ \t]+)?def[ \t]+main[ \t]*\((?![ \t]*self\b)", row)
    if of_module is not None and width == 4:
        columns = {0}
    if match["word"] == "class" and any(same.match(text.code.line(n)) for n in range(1, head)):
        return None  # (a class in another one, whose block is missing)
    if width in columns or (match["word"] == "def" and width - 4 not in columns):
        return None
    if match["word"] == "class" and _is_in_block(text, head):
        return None
    start = text.source.start_of(head)
    new = text.source.spliced([Splice(start, start + 4, "")])
    if new is None or not can_parse(new):
        return None
    shown = text.source.line(head).strip()
    return Slip("signs", "head_deeper", head, shown, "4", new, other=text.number)


def _is_in_block(text: Broken, number: int) -> bool:
    """Whether a line of the same block stands above a line."""
    width = len(indent_of(text.code.line(number)))
    above = (text.code.line(n) for n in range(number - 1, 0, -1))
    row = next((r for r in above if r.strip() and len(indent_of(r)) <= width), "")
    return len(indent_of(row)) == width


def _def_of_class(text: Broken, head: int) -> Slip | None:
    """Return the first def of a class that is not indented, unlike the lines below it."""
    is_class = re.match(r"[ \t]*class\b", text.code.line(head)) is not None
    if (
        not is_class
        or re.match(r"[ \t]*(?:async[ \t]+)?def\b[^()]*\([ \t]*self\b", text.line) is None
    ):
        return None
    start = text.source.start_of(text.number)
    new = text.source.spliced([Splice(start, start, "    ")])
    if new is None or not can_parse(new):
        return None
    shown = text.source.line(text.number).strip()
    return Slip("signs", "not_indented", text.number, shown, "", new, other=head)


HEAD_OF = re.compile(
    r"[ \t]*(?:async[ \t]+)?(?:(?P<word>def|class)[ \t]+(?P<name>\w+)|(?P<all>.*\S))"
)


def _head_twice(text: Broken, head: int) -> Slip | None:
    """Return the first line of a block that stands twice, one below the other."""
    first, second = (HEAD_OF.match(text.source.line(n).rstrip()) for n in (head, text.number))
    columns = {len(indent_of(text.source.line(n))) for n in (head, text.number)}
    if first is None or second is None or first.groups() != second.groups() or len(columns) > 1:
        return None
    new = text.source.spliced([text.source.without(head)])
    if new is None or not can_parse(new):
        return None
    shown = text.source.line(head).strip()
    return Slip("signs", "head_twice", head, shown, other=text.number, fixed=new)


def _lines_of_block(text: Broken, head: int) -> list[list[int]]:
    """Return the lines that belong to a def above them, and are not indented: up to a blank line.

    They are certain only if one of them uses self, or returns, or if the block goes on below them.
    """
    found = []
    for number in range(text.number, len(text.code.lines) + 1):
        row = text.code.line(number)
        if not text.source.line(number).strip() or re.match(r"[ \t]*(?:def|class|@|async)", row):
            break
        found.append(number)
    code = "\n".join(text.code.line(number) for number in found)
    certain = re.search(r"\bself\.|^[ \t]*return\b", code, re.M) is not None
    is_def = re.match(r"[ \t]*(?:async[ \t]+)?def\b", text.code.line(head)) is not None
    first = [n for n in found if len(indent_of(text.code.line(n))) == len(indent_of(text.line))]
    first = [n for at, n in enumerate(first) if n == text.number + at]
    after = text.code.line(first[-1] + 1) if first else ""
    goes_on = len(indent_of(after)) == len(indent_of(text.code.line(head))) + 4
    ways = [found] if certain else []
    ways += [first] if goes_on else []
    return [way for way in ways if len(way) > 1] if is_def else []


def _ends_after(text: Broken) -> bool:
    """Whether the next line with code belongs to the statement around, e.g. `except`."""
    rest = (text.code.line(n) for n in range(text.number + 1, len(text.code.lines) + 1))
    return CLAUSE.match(next((line for line in rest if line.strip()), "")) is not None


def _line_above(text: Broken) -> Slip | None:
    """Return a line that is indented less than the other lines of its block."""
    told = text.fault.text
    if text.fault.kind != "indentation" or not (EXTRA in told or UNMATCHED in told):
        return None
    lines = [n for n in range(1, text.number) if text.code.line(n).strip()]
    if len(lines) < 2:
        return None
    before, above = lines[-2:]
    wanted, written = indent_of(text.source.line(text.number)), indent_of(text.source.line(above))
    head = indent_of(text.source.line(before))
    opens = text.code.line(before).rstrip().endswith(":") and len(wanted) == len(head) + 4
    like_before = head == wanted if EXTRA in told else opens
    if not like_before or _reads(text, text.number, wanted, written):
        return None
    start = text.source.start_of(above)
    new = text.source.spliced([Splice(start, start + len(written), wanted)])
    if new is None or not can_parse(new):
        return None
    shown = text.source.line(above).strip()
    return Slip("signs", "line_above", above, shown, "", new, other=text.number)


def _beside_block(text: Broken) -> Slip | None:
    """Return a line that begins one to three columns beside the lines of its block."""
    if text.fault.kind != "indentation" or AFTER_COLON.search(text.fault.text):
        return None
    written = indent_of(text.source.line(text.number))
    above = [n for n in range(text.number - 1, 0, -1) if text.code.line(n).strip()]
    below = range(text.number + 1, len(text.code.lines) + 1)
    near = above[: 2 * MOST_TRIES] or [n for n in below if text.code.line(n).strip()][:1]
    columns = {n: len(indent_of(text.code.line(n))) - len(written) for n in near}
    fitting = sorted((abs(by), by, place) for place, (_, by) in enumerate(columns.items()))
    closest = {by for far, by, _ in fitting if far == fitting[0][0]}
    if not fitting or not 0 < fitting[0][0] < 4 or len(closest) != 1 or "\t" in written:
        return None
    other = near[fitting[0][2]]
    wanted = indent_of(text.source.line(other))
    first = text.number
    while first > 1 and re.match(rf"{written}#", text.source.line(first - 1)):
        first -= 1
    starts = [text.source.start_of(number) for number in range(first, text.number + 1)]
    new = text.changed(*(Splice(at, at + len(written), wanted) for at in starts))
    shown = text.source.line(text.number).strip()
    return Slip("signs", "line_above", text.number, shown, "", new, other=other) if new else None


def _reads(text: Broken, number: int, old: str, new: str) -> bool:
    """Whether Python reads the file with another indentation of one line."""
    start = text.source.start_of(number)
    changed = text.source.spliced([Splice(start, start + len(old), new)])
    return changed is not None and can_parse(changed)


def _without_end(text: Broken) -> Slip | None:
    """Return a text in three quotes that has no end, so that the code below it belongs to it."""
    tries = 0
    for start, end in _long_texts(text):
        quotes = text.code.text[start : start + 3]
        first, last = (text.code.text.count("\n", 0, at) + 1 for at in (start, end))
        for number in range(first, min(first + LONGEST_TEXT, last)):
            tries += 1
            at = text.source.end_of(number)
            inside = text.source.text[start + 3 : at].rstrip(" \t").rstrip(quotes[0])
            new = text.source.spliced([Splice(start + 3 + len(inside), at, quotes)])
            if new is not None and can_parse(new):
                shown = text.source.line(first).strip()
                return Slip("signs", "text_without_end", first, shown, quotes, new)
        if tries > 2 * MOST_TRIES:
            break
    return None


def _long_texts(text: Broken) -> Iterator[tuple[int, int]]:
    """Yield where texts in three quotes of more than one line start and end."""
    places = [match.start() for match in TRIPLE.finditer(text.code.text)]
    for at in range(0, len(places), 2):
        start = places[at]
        end = places[at + 1] if at + 1 < len(places) else len(text.code.text)
        if "\n" in text.code.text[start:end]:
            yield start, end


HEADS = {"except": "try", "finally": "try", "elif": "if", "else": "if"}


def _clause(text: Broken) -> Slip | None:
    """Return an except, finally, elif or else that belongs to no block above it."""
    match = CLAUSE.match(text.line)
    if match is None or text.fault.text not in ("invalid syntax", "SyntaxError: invalid syntax"):
        return None
    word = match[0].strip()
    width = len(indent_of(text.line))
    for number in range(text.number - 1, 0, -1):
        row = text.code.line(number)
        if row.strip() and len(indent_of(row)) < width:
            break
        if len(indent_of(row)) == width and re.match(
            rf"[ \t]*(?:{HEADS[word]}|for|while|if|elif|except)\b", row
        ):
            return None
    shown = text.source.line(text.number).strip()
    return Slip("signs", "clause_alone", text.number, shown, HEADS[word])


NO_BRACKETS = re.compile(r"(?P<head>[ \t]*def[ \t]+\w+)[ \t]*:")


def _def_brackets(text: Broken) -> Slip | None:
    """Return a function without brackets after its name."""
    match = NO_BRACKETS.match(text.line)
    if match is None:
        return None
    given = "(self)" if indent_of(text.line) else "()"
    at = match.end("head")
    splice = text.within(at, at, given)
    new = text.changed(splice)
    written = text.source.line(text.number)
    return text.slip("signs", "def_brackets", written, splice, fixed=new) if new else None


LONE_NAME = re.compile(r"[ \t]*[A-Za-z_][\w.]*")
ENDS_NAME = re.compile(r"[A-Za-z_]\w*\Z")
OPENS_CALL = re.compile(r"[A-Za-z_]\w*[ \t]*\(")


OTHER_WORDS = re.compile(r"<-|\bfunction\b")


def two_statements(text: Broken) -> Slip | None:
    """Return two statements on one line, if neither is of another language."""
    if OTHER_WORDS.search(text.line):
        return None
    indent = indent_of(text.line)
    for match in list(
        re.finditer(r"(?<=[)\w'\"])[ \t]+(?=[A-Za-z_][\w.]*[ \t]*[(=+-])", text.line)
    ):
        if LONE_NAME.fullmatch(text.line[: match.start()]):
            continue  # two words of one name, or a call without brackets
        if OPENS_CALL.match(text.line, match.end()) and ENDS_NAME.search(
            text.line[: match.start()]
        ):
            continue
        splice = text.within(*match.span(), text.source.newline + indent)
        new = text.changed(splice)
        if new is not None and can_parse(new):
            shown = text.source.line(text.number).strip()
            second = text.source.line(text.number)[match.end() :].strip()
            return Slip("signs", "two_statements", text.number, shown, second, new)
    return None


BLOCK_LOOKS: tuple[Callable[[Broken], Slip | None], ...] = (
    _bracket, _def_brackets, _clause, _colon, _capital, _compare, _not_indented, _line_above, _beside_block, _without_end,
)  # fmt: skip
