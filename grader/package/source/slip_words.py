"""Lines that are written as in another language: declarations, functions, switch, catch, arrows."""

from __future__ import annotations

import keyword
import re
from collections.abc import Callable

from grader.package.edit.text import indent_of
from grader.package.source.broken_python import MOST_TRIES, Broken, Slip

Look = Callable[[Broken], Slip | None]
TYPES = (
    r"(?:unsigned[ \t]+)?(?:std::)?(?:int|float|double|bool|boolean|string|String|char|long|byte|"
    r"Integer|Double|auto|var|let|const|Dim|size_t|uint\d+_t|int\d+_t|object|void)"
)
MODIFIERS = (
    "public|private|protected|static|final|const|constexpr|abstract|virtual|override|export|"
    "inline|@Override"
)
GENERIC = r"[A-Za-z_][\w:.]*(?:<[^<>=()]*>|\[[ \t]*\])?[ \t]*[*&]{0,2}"
PLACE = r"(?:self\.)?[A-Za-z_]\w*"
DECLARED = re.compile(
    rf"^[ \t]*(?P<type>(?:(?:{MODIFIERS}|mut)[ \t]+)*{TYPES}(?:<[^<>=()]*>|\[[ \t]*\])?[ \t]*[*&]?[ \t]+)"
    rf"(?P<name>{PLACE})[ \t]*;?[ \t]*$"
)
TYPED = re.compile(
    rf"^[ \t]*(?P<type>[A-Za-z_][\w:.]*(?:<[^<>=()]*>[*&]?|\[[ \t]*\]|[ \t]*[*&])[ \t]+|let[ \t]+mut[ \t]+|Dim[ \t]+)"
    rf"(?P<name>{PLACE})[ \t]*=(?!=)"
)
TYPE_BEHIND = re.compile(rf"^[ \t]*{PLACE}(?P<type>[ \t]+{TYPES})[ \t]*=(?!=)")
TWO_WORDS = re.compile(
    rf"^[ \t]*(?P<all>(?P<one>{PLACE})[ \t]+(?P<two>[A-Za-z_]\w*))[ \t]*[-+]?=(?!=)"
)
BEFORE_DEF = re.compile(
    rf"^[ \t]*(?P<word>(?:(?:{MODIFIERS}|default)[ \t]+)+)(?=(?:async[ \t]+)?(?:def|class)\b)"
)
ACCESS = re.compile(r"^[ \t]*(?P<word>public|protected|private)(?:[ \t]+slots)?[ \t]*:[ \t]*$")
HEAD = re.compile(
    rf"^[ \t]*(?P<all>(?:(?:{MODIFIERS}|async)[ \t]+)*(?:function|func|fn|fun|sub|Sub|{TYPES}(?:\[[ \t]*\])?)[ \t]+"
    r"(?:[\w\[\], \t]+=[ \t]*)?"
    r"(?P<name>[A-Za-z_]\w*)[ \t]*\((?P<given>[^()]*)\)[ \t]*:?[ \t]*\{?)[ \t]*$"
)
DEF = re.compile(r"^[ \t]*(?:async[ \t]+)?def[ \t]+\w+[ \t]*\((?P<given>[^()]*)\)")
TWO = re.compile(rf"[ \t]*(?P<one>{GENERIC})[ \t]+(?P<two>[A-Za-z_]\w*)[ \t]*(?P<default>=.*)?")
TYPE = re.compile(rf"{TYPES}|[A-Za-z_][\w:.]*(?:<[^<>=]*>|\[[ \t]*\]|[ \t]*[*&]{{1,2}})|[A-Z]\w*")
CATCH = re.compile(
    r"^[ \t]*(?P<all>(?:\}[ \t]*)?catch\b[ \t]*\(?[ \t]*(?:const[ \t]+)?(?P<type>[A-Za-z_][\w.]*)?[ \t]*&?"
    r"(?:[ \t]+(?:as[ \t]+)?(?P<name>\w+))?[ \t]*\)?[ \t]*[:{]?)[ \t]*$"
)
LIKE_EXCEPT = re.compile(
    r"^[ \t]*(?P<word>on|rescue|when|if|elif|case|error|trap)[ \t]+\(?[\w.]*(?:Interrupt|Exception|Error)\)?"
    r"(?:[ \t]+as[ \t]+\w+)?[ \t]*:[ \t]*$"
)
THROW = re.compile(r"^[ \t]*(?P<all>throw[ \t]+(?:new[ \t]+)?)")
SWITCH = re.compile(r"^[ \t]*(?P<all>switch\b[ \t]*(?P<what>\(.*\)|[^:{]*?)[ \t]*[:{]?)[ \t]*$")
OTHER_CASE = re.compile(
    r"^[ \t]*(?P<all>(?:default(?:[ \t]+case)?|case[ \t]+(?:default|else|other|otherwise)|otherwise|else)[ \t]*:)"
)
ARROW = re.compile(
    r"(?<![\w)\]])(?:\((?P<given>[\w, \t]*)\)|(?P<one>\w+))[ \t]*(?P<sign>->|=>)[ \t]*(?P<body>[^{}]+?|\{[^{}]*\})"
    r"(?=[ \t]*\)?[ \t]*;?[ \t]*$)"
)
FUNCTIONS = (
    re.compile(r"std::bind\([ \t]*&\w+(?:::|\.)(?P<name>\w+)[ \t]*,[ \t]*(?:this|self)[^()]*\)"),
    re.compile(r"\b(?:self|this)::(?P<name>\w+)"),
    re.compile(r"(?<![\w)\]&])&[ \t]*(?:self|this)(?:\.|->|::)(?P<name>\w+)"),
    re.compile(
        r"(?:\bfunction[ \t]*\(\)|\[[\w&=, \t]*\][ \t]*\([^()]*\))[ \t]*\{[ \t]*(?:self|this)"
        r"(?:\.|->)(?P<name>\w+)\(\);?[ \t]*\}"
    ),
)
CALLS_METHOD = re.compile(
    r"(?:\{[ \t]*)?(?:self|this)(?:\.|->)(?P<name>\w+)\(\)[ \t]*;?(?:[ \t]*\})?"
)
DEFINE = re.compile(r"^[ \t]*(?P<all>define[ \t]+(?P<name>[A-Za-z_]\w*)[ \t]+)(?=[\w'\"-])")
ENDS = re.compile(
    r"^[ \t]*(?:end[ \t]*(?:if|for|while|def|class|function|try|switch|sub)|esac|fi|done)[ \t]*;?[ \t]*$",
    re.I,
)
INCLUDES = re.compile(
    r"^[ \t]*(?:#?include\b[ \t]*[<'\"\w]|using[ \t]+[\w.: ]+;?[ \t]*$|package[ \t]+[\w.]+;?[ \t]*$|require[ \t]*['\"(])"
)
PARTS = re.compile(r"(?<!\w)(?P<one>[A-Za-z_]\w*)[ \t]+(?=(?P<two>[A-Za-z_]\w*))")
KNOWN = frozenset({
    *("create_timer", "get_logger", "get_clock", "destroy_node", "try_shutdown", "spin_once"),
    *("create_publisher", "create_subscription", "create_service", "create_client"),
    *("declare_parameter", "get_parameter", "seconds_nanoseconds", "add_node"),
})  # fmt: skip
"""Names of rclpy that have a _ in them."""
BLOCK_WORD = re.compile(r"^[ \t]*(?P<word>[A-Za-z]+)\b(?!\(|[ \t]*[.=\[]).*:[ \t]*$")
NEGATED = re.compile(r"^[ \t]*(?P<word>unless|until)\b[ \t]*")


def _shown(text: Broken) -> str:
    return text.source.line(text.number).strip()


def _replaced(
    text: Broken, variant: str, span: tuple[int, int], new: str, *, certain: bool = False
) -> Slip | None:
    """Return a slip of another language whose columns are to be replaced."""
    splice = text.within(*span, new)
    fixed = text.changed(splice)
    if fixed is None and not certain:
        return None
    return text.slip("language", variant, _shown(text), splice, fixed=fixed)


def in_class(text: Broken) -> str:
    """Return the name of the class in whose block the line is, directly; "" if in none."""
    width = len(indent_of(text.line))
    for number in range(text.number - 1, 0, -1):
        row = text.code.line(number)
        if row.strip() and len(indent_of(row)) < width:
            match = re.match(r"[ \t]*class[ \t]+(?P<name>\w+)", row)
            return match["name"] if match is not None else ""
    return ""


def plain_parameters(given: str) -> str | None:
    """Return the parameters of a def without types before or behind them; None if one is no name."""
    names = []
    for part in given.split(",") if given.strip() else ():
        match = TWO.fullmatch(part.rstrip())
        if match is None:
            if re.fullmatch(r"[ \t]*\*{0,2}[A-Za-z_]\w*(?:[ \t]*[:=].*)?", part) is None:
                return None
            names.append(part.strip())
            continue
        one, two = match["one"].strip(), match["two"]
        if TYPE.fullmatch(two) is not None and re.fullmatch(r"[a-z_]\w*", one):
            two = one
        elif TYPE.fullmatch(one) is None:
            return None
        names.append(f"{two}{match['default'] or ''}".strip())
    return ", ".join(names)


def _function(text: Broken) -> Slip | None:
    """Return the head of a function with the type of its result, or another word, for def."""
    match = HEAD.match(text.line)
    given = plain_parameters(match["given"]) if match is not None else None
    if match is None or given is None or keyword.iskeyword(match["name"]):
        return None
    name, owner = match["name"], in_class(text)
    if owner and re.match(r"self\b", given) is None:
        given = ", ".join(filter(None, ("self", given)))
    name = "__init__" if owner and name == owner else name
    return _replaced(text, "function", match.span("all"), f"def {name}({given}):", certain=True)


def _own_constructor(text: Broken) -> Slip | None:
    """Return a constructor that has the name of its class."""
    owner = in_class(text)
    pattern = rf"^[ \t]*(?P<all>(?:public[ \t]+)?{owner}[ \t]*\((?P<given>[^()]*)\)[ \t]*:?[ \t]*\{{?)[ \t]*$"
    match = re.match(pattern, text.line) if owner else None
    given = plain_parameters(match["given"]) if match is not None else None
    if match is None or given is None:
        return None
    if re.match(r"self\b", given) is None:
        given = ", ".join(filter(None, ("self", given)))
    wanted = f"def __init__({given}):"
    return _replaced(text, "constructor", match.span("all"), wanted, certain=True)


def _parameters(text: Broken) -> Slip | None:
    """Return a def with the types of its parameters."""
    match = DEF.match(text.line)
    given = plain_parameters(match["given"]) if match is not None else None
    if match is None or given is None or given == match["given"].strip():
        return None
    written = text.source.line(text.number)[slice(*match.span("given"))]
    plain = plain_parameters(written) or given  # (the code has no texts)
    return _replaced(text, "parameter_type", match.span("given"), plain)


def _declaration(text: Broken) -> Slip | None:
    """Return a variable with its type, or a declaration without a value."""
    for pattern in (TYPED, TYPE_BEHIND):
        match = pattern.match(text.line)
        if match is not None and not keyword.iskeyword(match["type"].strip()):
            found = _replaced(text, "declaration", match.span("type"), "")
            if found is not None:
                return found
    match = DECLARED.match(text.line)
    if match is None or keyword.iskeyword(match["name"]):
        return None
    return Slip("language", "declaration_alone", text.number, _shown(text), match["name"])


def two_words(text: Broken) -> Slip | None:
    """Return a name of two words that gets a value."""
    match = TWO_WORDS.match(text.line)
    if match is None:
        return None
    words = (match["one"], match["two"])
    known = {"self", "print", "echo", "new", "set", "define", "this", "super", "function"}
    if any(keyword.iskeyword(w) or w in known for w in words):
        return None
    if re.fullmatch(r"[A-Z]\w*[a-z]\w*|[A-Z]", words[0]) and words[1][0].islower():
        return _replaced(text, "declaration", match.span("all"), words[1])
    splice = text.within(*match.span("all"), f"{words[0]}_{words[1]}")
    if text.changed(splice) is None:
        return None
    return text.slip("signs", "name_two_words", _shown(text), splice)


def _name_blank(text: Broken) -> Slip | None:
    """Return a name with a blank in it, which rclpy or another line of the file has with a _."""
    for match in list(PARTS.finditer(text.line))[: 2 * MOST_TRIES]:
        start, middle, end = match.start("one"), match.end("one"), match.end("two")
        name = f"{match['one']}_{match['two']}"
        used = re.search(rf"(?<!\w){name}(?!\w)", text.code.text) is not None
        splice = text.within(middle, match.start("two"), "_")
        fixed = text.changed(splice) if used or name in KNOWN else None
        if fixed is not None and start < end:
            return text.slip("signs", "name_blank", _shown(text), splice, fixed=fixed)
    return None


def _modifier(text: Broken) -> Slip | None:
    match = BEFORE_DEF.match(text.line)
    if match is not None:
        return _replaced(text, "modifier", match.span("word"), "", certain=True)
    match = ACCESS.match(text.line)
    if match is None:
        return None
    fixed = text.changed(text.source.without(text.number))
    return Slip("language", "access", text.number, _shown(text), match["word"], fixed)


def _catch(text: Broken) -> Slip | None:
    match = LIKE_EXCEPT.match(text.line)
    if match is not None and "'except'" in text.fault.text:
        splice = text.within(*match.span("word"), "except")
        fixed = text.changed(splice)
        return text.slip("signs", "clause_misspelt", _shown(text), splice, fixed=fixed)
    match = CATCH.match(text.line)
    if match is None:
        return None
    kind, name = match["type"], match["name"]
    if name is None and (kind is None or kind.islower()):
        kind, name = "Exception", kind
    wanted = f"except {kind}{f' as {name}' if name else ''}:"
    return _replaced(text, "catch", match.span("all"), wanted, certain=True)


def _throw(text: Broken) -> Slip | None:
    match = THROW.match(text.line)
    return _replaced(text, "throw", match.span("all"), "raise ") if match is not None else None


def _switch(text: Broken) -> Slip | None:
    match = SWITCH.match(text.line)
    if match is None or not match["what"].strip():
        return None
    what = text.source.line(text.number)[slice(*match.span("what"))].strip()
    outer = re.fullmatch(r"\(([^()]*)\)", what)
    what = outer[1].strip() if outer is not None else what
    return _replaced(text, "switch", match.span("all"), f"match {what}:", certain=True)


def _other_case(text: Broken) -> Slip | None:
    """Return the case for all other values, as other languages write it."""
    match = OTHER_CASE.match(text.line)
    if match is None or not _in_match(text):
        return None
    splice = text.within(*match.span("all"), "case _:")
    fixed = text.source.spliced([splice])
    good = fixed is not None and text.changed(splice) is not None
    variant = "other_case" if good else "other_case_last"
    return text.slip("language", variant, _shown(text), splice, fixed=fixed if good else None)


def _in_match(text: Broken) -> bool:
    """Whether the line is directly in the block of a match, or beside it."""
    width = len(indent_of(text.line))
    for number in range(text.number - 1, 0, -1):
        row = text.code.line(number)
        if not row.strip() or len(indent_of(row)) > width:
            continue
        if len(indent_of(row)) == width and re.match(r"[ \t]*(?:case\b|default\b)", row):
            continue
        return re.match(r"[ \t]*(?:match|switch)\b.*:[ \t]*$", row) is not None
    return False


def _is_function(before: str, sign: str, body: str) -> bool:
    """Whether a name before an arrow is the parameter of a function, and no object or condition."""
    of_object = sign == "->" and not re.match(r"(?:self|this)\b|\{", body)
    return not of_object and re.search(r"[(,=][ \t]*\Z", before) is not None


def _arrow(text: Broken) -> Slip | None:
    """Return a function without a name, or a method as a value, as other languages write them."""
    for pattern in FUNCTIONS:
        match = pattern.search(text.line)
        if match is not None:
            return _replaced(text, "method_value", match.span(), f"self.{match['name']}")
    match = ARROW.search(text.line)
    if match is None:
        return None
    body, end = match["body"].strip(), match.end("body")
    if match["one"] and not _is_function(text.line[: match.start()], match["sign"], body):
        return None
    while body.count(")") > body.count("("):  # the last brackets close the call around
        end = match.start("body") + match["body"].rfind(")", 0, end - match.start("body"))
        body = text.line[match.start("body") : end].strip()
    whole = CALLS_METHOD.fullmatch(body)
    given = (match["given"] or match["one"] or "").strip()
    if whole is not None and not given:
        return _replaced(text, "method_value", (match.start(), end), f"self.{whole['name']}")
    written = text.source.line(text.number)[match.start("body") : end].strip(" \t{};")
    wanted = f"lambda {given}: {written}" if given else f"lambda: {written}"
    return _replaced(text, "arrow_lambda", (match.start(), end), wanted)


def _line_of_its_own(text: Broken) -> Slip | None:
    """Return a line that Python has no like of: the end of a block, an include, a constant."""
    match = DEFINE.match(text.line)
    if match is not None:
        return _replaced(text, "declaration", match.span("all"), f"{match['name']} = ")
    for pattern, variant in ((ENDS, "block_end"), (INCLUDES, "include")):
        if pattern.match(text.source.line(text.number)):
            fixed = (
                text.changed(text.source.without(text.number)) if variant == "block_end" else None
            )
            return Slip("language", variant, text.number, _shown(text), "", fixed)
    return None


def block_word(text: Broken) -> Slip | None:
    """Return a line that begins a block with a word that is not Python's."""
    match = NEGATED.match(text.line)
    if match is not None:
        word = "if not " if match["word"] == "unless" else "while not "
        return _replaced(text, "negated", (match.start("word"), match.end()), word)
    match = BLOCK_WORD.match(text.line)
    if match is None or match["word"] in {*keyword.kwlist, "match", "case", "self"}:
        return None
    below = (text.code.line(n) for n in range(text.number + 1, len(text.code.lines) + 1))
    after = next((row for row in below if row.strip()), "")
    opened = text.code.text[: text.code.start_of(text.number)]
    inside = any(opened.count(a) != opened.count(b) for a, b in ("()", "[]", "{}"))
    if inside or len(indent_of(after)) <= len(indent_of(text.line)):
        return None
    return Slip("language", "block_word", text.number, _shown(text), match["word"])


WORD_LOOKS: tuple[Look, ...] = (
    _arrow, _switch, _other_case, _catch, _throw, _modifier, _function, _own_constructor, _parameters,
    _declaration, _line_of_its_own, _name_blank,
)  # fmt: skip
