"""Slips that Python's own message names: assignments, imports, calls, parameters, numbers, words."""

from __future__ import annotations

import keyword
import re
from collections.abc import Callable, Iterator

from grader.base.nearest import nearest
from grader.package.edit.text import Splice, indent_of
from grader.package.source.broken_python import MOST_TRIES, Broken, Slip
from grader.package.source.python import can_parse
from grader.package.source.slip_arguments import unnamed_argument
from grader.package.source.slip_forms import as_written

Look = Callable[[Broken], Slip | None]
PLACE = r"[A-Za-z_][\w.]{0,120}"
ASSIGNED = re.compile(
    r"^(?P<start>[ \t]*)(?P<left>[^=]+?)[ \t]*=(?!=)[ \t]*(?P<right>[^=]+?)[ \t]*$"
)
CONDITION = re.compile(r"[ \t]*(?:if|elif|while|assert|return|and|or)\b")
NAME_PARTS = re.compile(
    r"^[ \t]*(?P<word>def|class)[ \t]+(?P<name>[A-Za-z_]\w*(?:[ \t]*-[ \t]*\w+|[ \t]+\w+)+)[ \t]*(?=[(:])"
)
INHERITS = re.compile(r"\b(?:extends|implements|inherits|from)\b")  # words of other languages
WORD_AS_NAME = (
    re.compile(r"^[ \t]*(?:def|class)[ \t]+(?P<name>[A-Za-z]+)[ \t]*[(:]"),
    re.compile(r"\.(?P<name>[a-z]+)\b"),
    re.compile(r"^[ \t]*(?P<name>[a-z]+)[ \t]*=(?!=)"),
    re.compile(r"[(,][ \t]*(?P<name>[a-z]+)[ \t]*=(?!=)"),
)
FIRST_WORD = re.compile(r"^[ \t]*(?P<word>[a-z]{2,8})\b(?=[ \t]+[\w('\"]|[ \t]*:)")
WORDS = (
    *("from", "import", "class", "def", "return", "while", "for", "if", "elif", "else", "try"),
    *("except", "finally", "with", "raise", "pass", "global", "async", "lambda", "nonlocal"),
)
MISSPELT = {"form": "from", "fro": "from", "dfe": "def", "fi": "if"}
PARAMETERS = re.compile(r"^[ \t]*def[ \t]+\w+[ \t]*\([^)]*\b\w+\.\w")
FROM_PARTS = re.compile(r"^[ \t]*from[ \t]+[\w.]+(?P<blank>[ \t]+)(?!import\b)[\w.]+[ \t]+import\b")
NO_NAME = re.compile(r"^[ \t]*(?:from[ \t]+[\w.]+[ \t]+)?import(?:[ \t]+[\w.]+[ \t]+as)?[ \t]*$")
CALL_WITHOUT = re.compile(
    rf"^[ \t]*(?P<name>{PLACE}(?:\(\)\.[\w.]{{1,80}})?)(?P<blank>[ \t]+)(?P<given>[\w'\"].*?)[ \t]*$"
)
ASSIGNS_ALSO = re.compile(r"[^('\"=]+(?<![=!<>])=(?!=)")
HANDLER = re.compile(r"^[ \t]*except[ \t]+(?P<types>[\w.]+[ \t]*,[ \t]*(?P<last>\w+))[ \t]*:")
OPERANDS = re.compile(r"(?P<before>[\w'\")\]}])(?P<blank>[ \t]+|[ \t]*[\r\n][ \t\r\n]*)(?=[\w'\"])")
ASSIGNS = re.compile(r"[ \t]*(?:return\b|[A-Za-z_][\w.]{0,80}[ \t]*\+?=(?!=))")
CONVERTED = re.compile(r"str[ \t]*\(")
LONE_NAME = re.compile(r"(?P<name>[A-Za-z_][\w.]{0,80})(?=[ \t]*(?:[,)+]|$))", re.M)
NAME_BEFORE = re.compile(r"(?<![\w.)\]])(?P<name>[A-Za-z_][\w.]{0,80})\Z")
LINES_BETWEEN = 5  # lines, at most, of which the last has the next value
TEXTS = re.compile(r"(?:\.(?:info|warn|warning|error|debug|fatal)|\bprint|\bstr)\(")


def _says(pattern: str, variant: str) -> Look:
    """Return a look for faults whose message matches; a group in it is what is wanted."""

    def look(text: Broken) -> Slip | None:
        match = re.search(pattern, text.fault.text)
        if match is None:
            return None
        wanted = match[1] if match.re.groups else ""
        shown = text.source.line(text.number).strip()
        return Slip("signs", variant, text.number, shown, wanted)

    return look


def _assigned(text: Broken) -> Slip | None:
    """Return an assignment whose left side is no place for a value."""
    told = re.search("cannot assign to|illegal expression for augmented", text.fault.text)
    match = ASSIGNED.match(text.line)
    if told is None or match is None or CONDITION.match(text.line) or not _balanced(match["left"]):
        return None
    if not _balanced(text.code.text[: text.code.start_of(text.number)]):
        return None  # inside of brackets
    written = text.source.line(text.number)
    if re.fullmatch(PLACE, match["right"]) and not keyword.iskeyword(match["right"]):
        (start, middle), (begin, end) = match.span("left"), match.span("right")
        left = text.within(start, middle, written[begin:end])
        right = text.within(begin, end, written[start:middle])
        new = text.changed(left, right)
        return text.slip("signs", "assign_swapped", written, left, right, fixed=new)
    return text.slip("signs", "assign_left", written)


def _balanced(code: str) -> bool:
    return all(code.count(a) == code.count(b) for a, b in ("()", "[]", "{}"))


MINUS_IN_NAME = re.compile(
    r"^[ \t]*(?P<name>(?:self\.)?[A-Za-z_]\w*(?:-[A-Za-z_]\w*){1,5})[ \t]*[-+]?=(?!=)"
)


def _minus(text: Broken) -> Slip | None:
    """Return an assignment to a name with a minus in it, which other lines may have too."""
    match = MINUS_IN_NAME.match(text.line)
    if match is None:
        return None
    name, place = match["name"], text.within(*match.span("name"), match["name"].replace("-", "_"))
    written = text.source.text
    in_code = rf"(?<![\w.-]){re.escape(name)}(?![\w-])"
    spans = {at.span() for at in re.finditer(in_code, text.code.text)}
    spans |= {
        at.span("name")
        for at in re.finditer(rf"\{{[^{{}}'\"]{{0,80}}?(?P<name>{in_code})", written)
    }
    splices = [Splice(start, end, place.new) for start, end in sorted(spans)]
    new = text.source.spliced(splices)
    new = new if new is not None and can_parse(new) else None
    return text.slip("signs", "name_minus", text.source.line(text.number), place, fixed=new)


def _name_parts(text: Broken) -> Slip | None:
    """Return a name of a function or a class with a space or a minus in it."""
    match = NAME_PARTS.match(text.line)
    if match is None or INHERITS.search(match["name"]):
        return None
    parts = re.split(r"[ \t-]+", match["name"])
    name = re.sub(r"(?<=_)_-_|[ \t-]+", "_", re.sub(r"(?<=_)[ \t]+|[ \t]+(?=_)", "", match["name"]))
    if match["word"] == "class":
        name = "".join(part[:1].upper() + part[1:] for part in parts)
    splice = text.within(*match.span("name"), name)
    new = text.changed(splice)
    return text.slip("signs", "name_parts", text.line, splice, fixed=new) if new else None


def _word_as_name(text: Broken) -> Slip | None:
    """Return a word of Python where a name belongs."""
    for pattern in WORD_AS_NAME:
        match = pattern.search(text.line)
        if match is not None and keyword.iskeyword(match["name"]):
            other = text.within(match.end("name"), match.end("name"), "_")
            if text.changed(other) is not None:
                shown = text.source.line(text.number).strip()
                new = _renamed(text, match["name"])
                return Slip("signs", "word_as_name", text.number, shown, match["name"], new)
    return None


def _renamed(text: Broken, word: str) -> bytes | None:
    """Return the file with another name for an attribute or a method, if Python then reads it."""
    code, written = text.code.text, text.source.text  # (a value in an f-string is not in the code)
    ends = {at.end() for at in re.finditer(rf"\b(?:def|class)[ \t]+(?={word}\b)", code)}
    ends |= {at.end() for at in re.finditer(rf"\.[ \t]*(?={word}\b)", code)}
    ends |= {at.end() for at in re.finditer(rf"\bself\.(?={word}\b)", written)}
    new = text.source.spliced([Splice(at, at, "my_") for at in ends])
    return new if new is not None and can_parse(new) else None


def _word(text: Broken) -> Slip | None:
    """Return a misspelt word of Python at the start of a line."""
    match = FIRST_WORD.match(text.line)
    if match is None or match["word"] in (*WORDS, "print", "switch", "foreach"):
        return None
    close = MISSPELT.get(match["word"]) or nearest(match["word"], WORDS, cutoff=0.7)
    splice = text.within(*match.span("word"), close)
    new = text.changed(splice) if close else None
    written = text.source.line(text.number)
    return text.slip("signs", "word_misspelt", written, splice, fixed=new) if new else None


def _parameters(text: Broken) -> Slip | None:
    """Return a function with an attribute among its parameters."""
    if PARAMETERS.match(text.line) is None:
        return None
    return text.slip("signs", "parameter_dot", text.source.line(text.number))


def _import(text: Broken) -> Slip | None:
    """Return an import with a space for a dot, or without a name at its end."""
    written = text.source.line(text.number)
    match = FROM_PARTS.match(text.line)
    if match is not None:
        splice = text.within(*match.span("blank"), ".")
        new = text.changed(splice)
        return text.slip("signs", "import_dot", written, splice, fixed=new) if new else None
    return text.slip("signs", "import_nothing", written) if NO_NAME.match(text.line) else None


def _call(text: Broken) -> Slip | None:
    """Return a call without brackets, on a line of its own."""
    match = CALL_WITHOUT.match(text.line)
    if match is None or keyword.iskeyword(match["name"]) or ASSIGNS_ALSO.match(text.line):
        return None
    if "." not in match["name"] and match["name"] != "print":
        return None
    written = text.source.line(text.number)
    end = match.end("given")
    splices = (text.within(*match.span("blank"), "("), text.within(end, end, ")"))
    new = text.changed(*splices)
    return text.slip("signs", "call_brackets", written, *splices, fixed=new) if new else None


def _handler(text: Broken) -> Slip | None:
    """Return an except with a comma: before a variable, or between two classes."""
    match = HANDLER.match(text.line)
    if match is None:
        return None
    start, end = match.span("types")
    types = text.line[start:end]
    if match["last"][:1].isupper():
        splice = text.within(start, end, f"({types})")
    else:
        splice = text.within(start, end, re.sub(r"[ \t]*,[ \t]*", " as ", types))
    new = text.changed(splice)
    return text.slip("signs", "handler_comma", text.line, splice, fixed=new) if new else None


def _between(text: Broken) -> Slip | None:
    """Return two values with nothing between them: a comma or a + is missing."""
    inside = "forgot a comma" in text.fault.text
    if not inside and ASSIGNS.match(text.line) is None:
        return None
    if re.search(r"\blambda\b[^:]*:[ \t]*$", _above(text)):
        return None
    for splices, variant in _ways(text):
        if variant == "comma_missing" and (not inside or CALLED_NUMBER.search(text.line)):
            continue
        new = text.changed(*splices)
        if new is not None:
            at = splices[0].start - text.code.start_of(text.number)
            own = re.match(r"[ \t]+self\.", text.line[at:]) is not None and inside
            if variant == "comma_missing" and not own and _are_names(text.line, at):
                return text.slip("signs", "comma_or_name", text.source.line(text.number), *splices)
            return text.slip("signs", variant, text.source.line(text.number), *splices, fixed=new)
    return None


CALLED_NUMBER = re.compile(r"(?<![\w.])\d[\d.]*[ \t]*\(")


def _are_names(line: str, at: int) -> bool:
    """Whether two names are beside a place of a line that is no def."""
    before, after = line[:at], line[at:]
    is_def = re.match(r"[ \t]*(?:async[ \t]+)?def\b", line) is not None
    names = re.search(r"[A-Za-z_]\w*\Z", before) and re.match(r"[ \t]+[A-Za-z_]", after)
    return names is not None and not is_def


def _above(text: Broken) -> str:
    return text.code.line(text.number - 1) if text.number > 1 else ""


def _ways(text: Broken) -> Iterator[tuple[list[Splice], str]]:
    """Yield what could stand between the values of the line, and of it and the next one."""
    start, end = text.code.start_of(text.number), text.code.end_of(text.number + LINES_BETWEEN)
    code = text.code.text[start:end]
    for match in list(OPERANDS.finditer(code))[: MOST_TRIES * 2]:
        if match.start("blank") > len(text.line):
            break
        at = start + match.start("blank")
        quoted = {match["before"], code[match.end()]} & {"'", '"'}
        is_text = any((TEXTS.search(code[: match.end()]), CONVERTED.match(code, match.end())))
        shown = is_text or _ends_path(text, at) or ASSIGNS.match(code)
        number = code[match.end()].isdigit()
        converted = CONVERTED.match(code, match.end()) is not None
        joins = quoted or (converted and not _ends_word(code[: match.start("blank")]))
        if joins and shown and not number and match["blank"].strip("\r\n"):
            plus = Splice(at, at + len(match["blank"]), " + ")
            plain = _ends_path(text, at) or not quoted
            values = [] if plain else [*_as_text(code, match, start)]
            yield [plus, *values], "plus_missing"
        yield [Splice(at, at, ",")], "comma_missing"


def _ends_word(before: str) -> bool:
    """Whether code ends with a word of Python, behind which a value stands: `return`, `and`."""
    last = re.search(r"(?<![\w.])[a-z]+\Z", before)
    return last is not None and keyword.iskeyword(last[0])


def _as_text(code: str, match: re.Match[str], start: int) -> Iterator[Splice]:
    """Yield the splices that make a text of a plain name beside a text: + joins only texts."""
    name = LONE_NAME.match(code, match.end())
    if name is not None:
        yield Splice(start + name.start(), start + name.start(), "str(")
        yield Splice(start + name.end(), start + name.end(), ")")
    before = NAME_BEFORE.search(code[: match.start("blank")])
    if before is not None:
        yield Splice(start + before.start(), start + before.start(), "str(")
        yield Splice(start + before.end(), start + before.end(), ")")


def _ends_path(text: Broken, end: int) -> bool:
    """Return whether the text that ends here is the beginning of a path, as in 'share/'."""
    return text.source.text[max(end - 2, 0) : end] in ("/'", '/"')


def _colon(text: Broken) -> Slip | None:
    """Return a line that begins a block and does not end with a colon."""
    if "expected ':'" not in text.fault.text:
        return None
    ends = len(text.line.rstrip())
    splice = text.within(ends, ends, ":")
    new = text.changed(splice)
    written = text.source.line(text.number)
    return text.slip("signs", "colon_missing", written, splice, fixed=new) if new else None


ENTRY_PARTS = re.compile(
    r"^[ \t]*(?P<all>(?P<quote>['\"])(?P<name>[\w-]+)(?P=quote)[ \t]*(?P<sign>[=:])[ \t]*"
    r"(?P<other>['\"])(?P<place>[\w.]+:\w+)(?P=other)),?[ \t]*$"
)


def _entry_parts(text: Broken) -> Slip | None:
    """Return an entry of console_scripts that is written as two strings."""
    written = text.source.line(text.number)
    match = ENTRY_PARTS.match(written)
    if match is None:
        return None
    quote = match["quote"]
    splice = text.within(*match.span("all"), f"{quote}{match['name']} = {match['place']}{quote}")
    new = text.changed(splice)
    return text.slip("signs", "entry_parts", written, splice, fixed=new) if new else None


# what the parser accepts, and the compiler refuses

ESCAPE = re.compile(r"\\[uUxN]")
QUOTE = re.compile(r"(?<![\w'\"])(?P<quote>'''|\"\"\"|'|\")")
LATE = re.compile(
    r"name '(?P<name>\w+)' is (?:used prior to|assigned to before) global declaration"
)


def _loop_word(text: Broken) -> Slip | None:
    """Return a break or continue without a loop around it."""
    match = re.search("'(break|continue)' (?:outside loop|not properly in loop)", text.fault.text)
    if match is None:
        return None
    alone = re.fullmatch(rf"[ \t]*{match[1]}[ \t]*;?[ \t]*", text.line)
    start = len(indent_of(text.line))
    splice = text.within(start, start + len(match[1]), "pass")
    new = text.changed(splice) if alone is not None and _begins_block(text) else None
    shown = text.source.line(text.number).strip()
    return Slip("signs", "loop_word", text.number, shown, match[1], new)


def _begins_block(text: Broken) -> bool:
    above = (text.code.line(number) for number in range(text.number - 1, 0, -1))
    return next((line for line in above if line.strip()), "").rstrip().endswith(":")


def _global_late(text: Broken) -> Slip | None:
    """Return a global below the first use of its name in the function."""
    match = LATE.search(text.fault.text)
    if match is None:
        return None
    written, width = text.source.line(text.number), len(indent_of(text.line))
    for number in range(text.number - 1, 0, -1):
        if re.match(r"[ \t]*(?:async[ \t]+)?def\b", text.code.line(number)):
            indent = " " * width
            if len(indent_of(text.code.line(number))) < width:
                row = text.source.before(number + 1, indent + written.strip())
                new = text.changed(row, text.source.without(text.number))
                shown = written.strip()
                return Slip("signs", "global_late", text.number, shown, "", new, other=number)
    return None


def _backslash(text: Broken) -> Slip | None:
    """Return a backslash in a text before a letter for which Python expects a code."""
    if "(unicode error)" not in text.fault.text:
        return None
    first = max(1, text.number - 1)
    # (Python names the first or the last line of a long string)
    rows = [*range(first, len(text.source.lines) + 1), *range(first, 0, -1)]
    at = next((n for n in rows if ESCAPE.search(text.source.line(n))), None)
    if at is None:
        return None
    shown = text.source.line(at).strip()
    for number in range(at, max(0, at - MOST_TRIES), -1):
        for match in reversed(list(QUOTE.finditer(text.source.line(number)))[:MOST_TRIES]):
            start = text.source.start_of(number) + match.start()
            new = text.source.spliced([Splice(start, start, "r")])
            if new is not None and text.changed(Splice(start, start, "r")) is not None:
                return Slip("signs", "backslash", at, shown, "r" + match["quote"], new)
    return Slip("signs", "backslash", at, shown, "r" + text.source.quote)


# a list with keys

KEY_BEFORE_COLON = re.compile(r"['\"]_*['\"][ \t]*:")
PAIRS = {"[": "]", "(": ")"}


def _list_with_keys(text: Broken) -> Slip | None:
    """Return a list, or round brackets, around keys with values: a dict has braces."""
    match = KEY_BEFORE_COLON.search(text.line)
    if match is None:
        return None
    code = text.code.text
    open_at, depth = text.code.start_of(text.number) + match.start(), 0
    while open_at > 0 and depth >= 0:
        open_at -= 1
        depth += (code[open_at] in ")]}") - (code[open_at] in "([{")
    if depth >= 0 or code[open_at] not in PAIRS:
        return None
    close_at, depth = open_at, 0
    while close_at < len(code) and (depth > 0 or close_at == open_at):
        depth += (code[close_at] in "([{") - (code[close_at] in ")]}")
        close_at += 1
    if depth or code[close_at - 1] != PAIRS[code[open_at]]:
        return None
    new = text.changed(Splice(open_at, open_at + 1, "{"), Splice(close_at - 1, close_at, "}"))
    shown = text.source.line(text.number).strip()
    return Slip("signs", "dict_braces", text.number, shown, "", new) if new is not None else None


def _unbound(text: Broken) -> Slip | None:
    """Return a nonlocal in a function inside a function, of a name that the outer one lacks."""
    match = re.search(r"no binding for nonlocal '(?P<name>\w+)'", text.fault.text)
    width, outer = len(indent_of(text.line)), 0
    for number in range(text.number - 1, 0, -1):
        row = text.code.line(number)
        if row.strip() and len(indent_of(row)) < width and re.match(r"[ \t]*(?:def|class)\b", row):
            width, outer = len(indent_of(row)), outer + ("def" in row)
    if match is None or outer < 2:
        return None
    shown = text.source.line(text.number).strip()
    if re.search(rf"^{match['name']}[ \t]*(?::[^=\n]*)?=(?!=)", text.code.text, re.M):
        word = text.line.index("nonlocal")
        splice = text.within(word, word + len("nonlocal"), "global")
        return as_written(text, "nonlocal_of_file", splice)
    return Slip("signs", "nonlocal_unbound", text.number, shown, match["name"])


STATEMENT_LOOKS: tuple[Look, ...] = (
    _entry_parts, _minus, _assigned, _word, _name_parts, _parameters, _import, _handler, _between, _colon, _call,
    _loop_word, _global_late, _backslash, _list_with_keys,
    _says(r"name '(\w+)' is parameter and (?:global|nonlocal)", "global_parameter"),
    _unbound,
    _says(r"(?:no binding for nonlocal '\w+'|nonlocal declaration not allowed)", "nonlocal"),
    _says(r"'(return|yield)' outside function", "outside_function"),
    _says(r"'(?:await|async \w+)' outside", "await_outside"),
    unnamed_argument,
    _says(r"keyword argument repeated: (\w+)", "argument_twice"),
    _says(r"duplicate argument '(\w+)' in function", "parameter_twice"),
    _says(r"(?:non-default argument|parameter without a default) follows", "parameter_order"),
    _says(r"invalid decimal literal", "number_letters"),
    _says(r"leading zeros in decimal", "number_zeros"),
    _word_as_name,
)  # fmt: skip


def _walrus(text: Broken) -> Slip | None:
    """Return := behind an attribute or brackets; in a lambda no other line can hold it."""
    in_lambda = re.search(r"\blambda\b.*:=", text.line) is not None
    said = "cannot use assignment expressions with"
    return _says(said, "walrus_in_lambda" if in_lambda else "walrus_place")(text)


MESSAGE_LOOKS: tuple[Look, ...] = (
    _says(r"Missing parentheses in call to '(\w+)'", "call_of_word"),
    _says(r"cannot contain assignment", "call_assigns"),
    _walrus,
    _says(r"':' expected after dictionary key", "key_alone"),
    _says(r"expression expected after dictionary key", "value_missing"),
    _says(r"unexpected character after line continuation", "backslash_alone"),
    _says(r"makes remaining patterns unreachable", "case_last"),
    _says(r"default 'except:' must be last", "except_last"),
    _says(r"import \* only allowed at module level", "import_star"),
    _says(r"expected default value expression", "default_missing"),
    _says(r"Generator expression must be parenthesized", "generator"),
    _says(r"(?:multiple exception types must be parenthesized)", "handler_types"),
    _says(r"comprehension target", "comprehension"),
    _says(r"future feature (\w+) is not defined", "future_unknown"),
)
