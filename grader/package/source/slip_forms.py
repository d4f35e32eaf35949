"""Statements and values whose form is not complete: import, for, else, lambda, a dict, a call."""

from __future__ import annotations

import builtins
import keyword
import re
from collections.abc import Callable
from dataclasses import replace

from grader.package.edit.text import Splice, indent_of
from grader.package.source.broken_python import BLOCK, MOST_TRIES, Broken, Slip

Look = Callable[[Broken], Slip | None]
CLOSES = {")": "(", "]": "[", "}": "{"}
MODULE = r"[A-Za-z_]\w*(?:\.[A-Za-z_]\w*)*"
IS_IMPORT = re.compile(r"^[ \t]*(?:from|import)\b")
IMPORTS = (
    (rf"^(?P<start>[ \t]*)import[ \t]+(?P<module>{MODULE})\.\*[ \t]*;?", "from \\g<module> import {star}"),
    (rf"^(?P<start>[ \t]*)import[ \t]+static[ \t]+(?P<module>{MODULE})\.(?P<name>\w+)", "from \\g<module> import \\g<name>"),
    (r"^(?P<start>[ \t]*)import[ \t]*\{(?P<name>[\w, \t]*)\}[ \t]*from[ \t]*['\"](?P<module>[\w.]+)['\"]", "from \\g<module> import \\g<name>"),
    (rf"^(?P<start>[ \t]*)import[ \t]*[('\"<{{][ \t]*(?P<module>{MODULE})[ \t]*[)'\">}}]", "import \\g<module>"),
    (rf"^(?P<start>[ \t]*)from[ \t]*['\"<(](?P<module>{MODULE})['\">)][ \t]*import[ \t]+(?P<name>[\w, \t*]+)", "from \\g<module> import \\g<name>"),
    (rf"^(?P<start>[ \t]*)from[ \t]+(?P<module>{MODULE})[ \t]+import[ \t]*[{{['\"<](?P<name>[\w, \t]*)[}}\]'\">]", "from \\g<module> import \\g<name>"),
    (rf"^(?P<start>[ \t]*)from[ \t]+(?P<module>{MODULE})[ \t]+import[ \t]+(?P<part>{MODULE})\.(?P<name>[A-Za-z_]\w*)", "from \\g<module>.\\g<part> import \\g<name>"),
    (rf"^(?P<start>[ \t]*)from[ \t]+(?P<module>{MODULE})[ \t]+import[ \t]+(?P<name>\w+)\(\)", "from \\g<module> import \\g<name>"),
    (rf"^(?P<start>[ \t]*)from[ \t]+(?P<module>{MODULE})[ \t]+(?P<name>[A-Z]\w*)[ \t]*$", "from \\g<module> import \\g<name>"),
    (rf"^(?P<start>[ \t]*)import[ \t]+(?P<module>{MODULE})[ \t]+(?P<name>{MODULE})[ \t]*$", "import \\g<module>, \\g<name>"),
)  # fmt: skip
SLASHES = re.compile(
    r"^[ \t]*(?:from|import)[ \t]+(?P<module>[A-Za-z_]\w*(?:(?:/|::|->|\\)[A-Za-z_]\w*)+)"
)
HANDLER = re.compile(
    r"^[ \t]*except[ \t]+(?P<all>\(?[ \t]*(?P<type>[A-Za-z_][\w.]*)[ \t]+(?P<name>[A-Za-z_]\w*)[ \t]*\)?)[ \t]*:"
)
AS_FIRST = re.compile(r"^[ \t]*except(?P<all>[ \t]+as)[ \t]+[A-Z][\w.]*[ \t]*:")
FOR = re.compile(r"^[ \t]*(?:for|foreach)\b")
FORS = (
    re.compile(r"^[ \t]*for[ \t]+\w+(?P<sign>[ \t]*=(?![ \t]*\d+[ \t]*:)[ \t]*)"),
    re.compile(r"^[ \t]*for[ \t]+\w+(?P<sign>[ \t]+(?:of|:)[ \t]+)"),
    re.compile(r"^[ \t]*for[ \t]+\w+(?P<sign>[ \t]+)(?=range\b)"),
)
FOR_EACH = re.compile(r"^[ \t]*(?P<sign>for[ \t]?each)\b(?=[ \t]+\w+[ \t]+in\b)")
ELSE_IF = re.compile(r"^[ \t]*(?P<word>else)[ \t]+(?!if\b)(?P<condition>[^:]+):")
NO_CONDITION = re.compile(r"^[ \t]*(?P<word>if|elif|while)[ \t]*:[ \t]*$")
LAMBDA = re.compile(r"\blambda\b")
LAMBDA_BRACKETS = re.compile(r"\blambda[ \t]*\((?P<given>[\w, \t]*)\)[ \t]*(?::|->|=>)[ \t]*")
KEY = re.compile(r"^[ \t]*(?P<key>['\"]_*['\"]|\w+)[ \t]*:")
KEY_BESIDE = re.compile(r"(?<=['\"\w)\]}])(?P<blank>[ \t]+)(?=['\"]_*['\"][ \t]*:)")
BESIDE = re.compile(r"(?P<key>['\"]_*['\"])(?P<blank>[ \t]+)(?=[\w'\"\[({-])")
KEY_SIGN = re.compile(r"(?<=['\"])(?P<blank>[ \t]*(?:=>|->|=(?!=))[ \t]*)")
NAMED = re.compile(r"[(,][ \t]*[A-Za-z_]\w*(?P<sign>[ \t]*:)(?=[ \t]*[\w'\"\[(])")
CHANGED = re.compile(
    r"(?<=[(,+=])[ \t]*(?P<all>(?P<name>[A-Za-z_][\w.]*)[ \t]*(?P<sign>[-+*/])=[ \t]*(?P<by>[\w.]+))(?=[ \t]*[),])"
)
RETURNS = re.compile(r"^[ \t]*return[ \t]+(?P<name>[A-Za-z_][\w.]*)[ \t]*[-+*/]?=(?!=)[ \t]*\S")
GLOBAL = re.compile(r"^[ \t]*(?:global|nonlocal)[ \t]+(?P<name>\w+)[ \t]*=(?!=)")
CHAINED = re.compile(
    r"^[ \t]*(?P<name>[A-Za-z_][\w.]*)[ \t]*=[ \t]*(?P<other>[A-Za-z_][\w.]*)[ \t]*[-+*/]=(?!=)"
)
RAISE = re.compile(r"^[ \t]*raise[ \t]+[\w.]+(?P<comma>[ \t]*,[ \t]*)(?P<text>['\"].*?)[ \t]*$")
ENDS_OPEN = re.compile(
    r"(?P<sign>(?:[-+*/%]|(?<![<>=!])=|==|!=|\.|\b(?:and|or|not|in|is|as)))[ \t]*$"
)
OPENS = re.compile(rf"[ \t]*(?:{BLOCK}|from|import)\b")
PLAIN_WORDS = re.compile(
    r"[ \t]*(?P<first>[^\W\d_][\w'\u2019-]*)(?:(?P<colon>[ \t]?:)|,)?(?:[ \t]+[\w'\u2019/-]+(?P<later>:)?,?){1,60}(?:[ \t]*[.!:]+)?[ \t]*"
)
FOREIGN = frozenset({
    *("var", "let", "const", "int", "float", "double", "string", "bool", "char", "void", "public"),
    *("private", "protected", "static", "new", "delete", "function", "func", "fn", "define", "end"),
    *("begin", "loop", "repeat", "unless", "until", "foreach", "switch", "default", "print", "echo"),
    *("import", "include", "using", "self", "super", "throw"),
})  # fmt: skip
"""Words that begin a line of code in one language or another."""


def _shown(text: Broken) -> str:
    return text.source.line(text.number).strip()


def innermost(code: str) -> str:
    """Return the innermost bracket that is open at the end of code; "" if none is."""
    waiting: list[str] = []
    for match in re.finditer(r"[()\[\]{}]", code):
        if match[0] not in CLOSES:
            waiting.append(match[0])
        elif waiting and waiting[-1] == CLOSES[match[0]]:
            waiting.pop()
    return waiting[-1] if waiting else ""


def _around(text: Broken, column: int) -> str:
    """Return the innermost open bracket at a column of the line."""
    return innermost(text.code.text[: text.code.start_of(text.number) + column])


def as_written(text: Broken, variant: str, *splices: Splice) -> Slip | None:
    """Return a slip with the line as it should be; None if Python then reads no further."""
    fixed = text.changed(*splices)
    if fixed is None:
        return None
    return text.slip("signs", variant, _shown(text), *splices, fixed=fixed)


def _import(text: Broken) -> Slip | None:
    """Return an import whose form is not one of the two of Python."""
    if IS_IMPORT.match(text.line) is None:
        return None
    written = text.source.line(text.number)
    uses_node = re.search(r"\bNode\b", text.code.text) is not None
    for pattern, template in IMPORTS:
        match = re.match(pattern, written)
        if match is None:
            continue
        star = "Node" if uses_node and match["module"] == "rclpy.node" else "*"
        new = match.expand(f"\\g<start>{template.format(star=star)}").rstrip()
        new = re.sub(r"(?<=\S)[ \t]{2,}", " ", new)
        if new == written.rstrip():
            continue
        found = as_written(text, "import_written", text.within(*match.span(), new))
        if found is not None:
            return found
    match = SLASHES.match(text.line)
    if match is None:
        return None
    name = re.sub(r"/|::|->|\\", ".", match["module"])
    return as_written(text, "import_dot", text.within(*match.span("module"), name))


def _import_form(text: Broken) -> Slip | None:
    """Return an import that has neither of the two forms."""
    if IS_IMPORT.match(text.line) is None:
        return None
    if "trailing comma" in text.fault.text or re.search(r"(?:,|\bimport|\bas)[ \t]*$", text.line):
        return None
    if "invalid syntax" not in text.fault.text or innermost(
        text.code.text[: text.code.start_of(text.number)]
    ):
        return None
    return (
        None
        if re.search(r"\S[ \t]+(?:from|import)\b.*\bimport\b", text.line)
        else text.slip("signs", "form_of_import", _shown(text))
    )


def _handler(text: Broken) -> Slip | None:
    """Return an except with a name beside its class, or with as before it."""
    match = HANDLER.match(text.line)
    if match is not None and hasattr(builtins, match["type"] + match["name"]):
        name = match["type"] + match["name"]
        return as_written(text, "name_blank", text.within(*match.span("all"), name))
    if match is not None and not {match["name"], match["type"]} & set(keyword.kwlist):
        return as_written(
            text,
            "handler_as",
            text.within(*match.span("all"), f"{match['type']} as {match['name']}"),
        )
    match = AS_FIRST.match(text.line)
    return as_written(text, "handler_class", text.within(*match.span("all"), "")) if match else None


def _for(text: Broken) -> Slip | None:
    """Return a for that is not the one of Python."""
    if FOR.match(text.line) is None:
        return None
    match = FOR_EACH.match(text.line)
    if match is not None:
        found = as_written(text, "for_in", text.within(*match.span("sign"), "for"))
        if found is not None:
            return found
    for pattern in FORS:
        match = pattern.match(text.line)
        found = (
            as_written(text, "for_in", text.within(*match.span("sign"), " in ")) if match else None
        )
        if found is not None:
            return found
    if "invalid syntax" not in text.fault.text or re.match(r"[ \t]*for\b[^=;]*\bin\b", text.line):
        return None
    return text.slip("signs", "for_form", _shown(text))


def _condition(text: Broken) -> Slip | None:
    """Return an else with a condition, or an if without one, or an elif below an else."""
    match = ELSE_IF.match(text.line)
    if match is not None:
        return as_written(text, "else_condition", text.within(*match.span("word"), "elif"))
    match = NO_CONDITION.match(text.line)
    if match is not None:
        return Slip("signs", "condition_missing", text.number, _shown(text), match["word"])
    if re.match(r"[ \t]*(?:elif|else)\b", text.line) is None:
        return None
    width = len(indent_of(text.line))
    for number in range(text.number - 1, 0, -1):
        row = text.code.line(number)
        if not row.strip() or len(indent_of(row)) > width:
            continue
        if len(indent_of(row)) == width and re.match(r"[ \t]*else[ \t]*:", row):
            return Slip("signs", "after_else", text.number, _shown(text), other=number)
        break
    return None


def _ternary(text: Broken) -> Slip | None:
    if "expected 'else' after 'if' expression" in text.fault.text:
        return text.slip("signs", "else_missing", _shown(text))
    return None


def _lambda(text: Broken) -> Slip | None:
    """Return a lambda with brackets around its parameters, or with a statement in it."""
    match = LAMBDA_BRACKETS.search(text.line)
    if match is not None:
        given = match["given"].strip()
        head = f"lambda {given}: " if given else "lambda: "
        return as_written(text, "lambda_brackets", text.within(*match.span(), head))
    above = text.code.line(text.number - 1) if text.number > 1 else ""
    if re.search(r"\blambda\b[^:()]*:[ \t]*$", above) and innermost(
        text.code.text[: text.code.start_of(text.number)]
    ):
        shown = text.source.line(text.number - 1).strip()
        return Slip("signs", "lambda_lines", text.number - 1, shown)
    if LAMBDA.search(text.line) is None or "invalid syntax" not in text.fault.text:
        return None
    match = re.search(
        r"\blambda\b[^:()]*:[ \t]*(?P<body>(?:return|if|for|while|try|with|raise|pass|del|def|global|import|assert)\b.*)$",
        text.line,
    )
    if match is not None:
        body = text.source.line(text.number)[match.start("body") :].strip()
        while body.count(")") > body.count("("):
            body = body[: body.rfind(")")].strip()
        return Slip("signs", "lambda_statement", text.number, _shown(text), body)
    return None


def _entries(text: Broken) -> Slip | None:
    """Return a dict whose entries have no comma, or whose key has no colon behind it."""
    if "syntax" not in text.fault.text:
        return None
    if KEY.match(text.line) and _around(text, 0) == "{":
        above = next((n for n in range(text.number - 1, 0, -1) if text.code.line(n).strip()), 0)
        row = text.code.line(above).rstrip()
        if row and row[-1] not in ",{[(:":
            at = text.code.start_of(above) + len(row)
            fixed = text.changed(Splice(at, at, ","))
            written = text.source.line(above)
            if fixed is not None:
                wanted = f"{written[: len(row)].strip()},"
                return Slip("signs", "comma_missing", above, written.strip(), wanted, fixed)
    for pattern, sign, variant in (
        (KEY_BESIDE, ",", "comma_missing"),
        (KEY_SIGN, ": ", "colon_key"),
        (BESIDE, ":", "colon_key"),
    ):
        for match in list(pattern.finditer(text.line))[:MOST_TRIES]:
            at = match.start("blank")
            if _around(text, at) == "{":
                end = at if variant == "comma_missing" or pattern is BESIDE else match.end("blank")
                found = as_written(text, variant, text.within(at, end, sign))
                if found is not None:
                    return found
    return None


def _call(text: Broken) -> Slip | None:
    """Return a colon or a change of a value in the brackets of a call."""
    if re.match(r"[ \t]*(?:async[ \t]+)?(?:def|lambda|class)\b", text.line):
        return None
    for match in list(NAMED.finditer(text.line))[:MOST_TRIES]:
        if _around(text, match.start("sign")) == "(":
            found = as_written(text, "equals_written", text.within(*match.span("sign"), "="))
            if found is not None:
                return found
    return _changed_inside(text)


def _changed_inside(text: Broken) -> Slip | None:
    """Return a change of a value, as with +=, in brackets."""
    match = CHANGED.search(text.line)
    if match is None or not _around(text, match.start("all")):
        return None
    splice = text.within(*match.span("all"), match["name"])
    if text.changed(splice) is None:
        return None
    step = f"{match['name']} {match['sign']}= {match['by']}"
    found = text.slip("signs", "change_inside", _shown(text), splice)
    before = text.code.text[: text.code.start_of(text.number) + match.start("all")]
    in_lambda = re.search(r"\blambda\b[^\n]*\Z", before) is not None
    return replace(found, step=step, variant="lambda_changes" if in_lambda else found.variant)


def _assigns(text: Broken) -> Slip | None:
    """Return an assignment in a return, in a global, or in another assignment."""
    match = RETURNS.match(text.line)
    if match is not None and "lambda" not in text.line:
        first = _shown(text).removeprefix("return").strip()
        return Slip(
            "signs",
            "return_assigns",
            text.number,
            _shown(text),
            f"return {match['name']}",
            step=first,
        )
    match = GLOBAL.match(text.line)
    if match is not None:
        first = _shown(text).split("=")[0].strip()
        start = re.compile(rf"{match['name']}[ \t]*(?::[^=]*)?=(?!=)")
        there = [n for n, _ in enumerate(text.code.lines, 1) if start.match(text.code.line(n))]
        if there and first.startswith("global"):
            end = match.end("name")
            whole = len(text.line.rstrip())
            new = text.changed(text.within(end, whole, ""))
            return Slip("signs", "global_set", text.number, _shown(text), first, new,
                        other=there[0])  # fmt: skip
        return Slip("signs", "global_value", text.number, _shown(text), first,
                    step=_shown(text).partition(" ")[2].strip())  # fmt: skip
    match = CHAINED.match(text.line)
    if match is None:
        return None
    step = _shown(text).partition("=")[2].strip()
    wanted = f"{match['name']} = {match['other']}"
    return Slip("signs", "assign_twice", text.number, _shown(text), wanted, step=step)


def _raise(text: Broken) -> Slip | None:
    written = text.source.line(text.number)
    match = RAISE.match(written)
    if match is None:
        return None
    end = match.end("text")
    return as_written(
        text, "raise_brackets", text.within(*match.span("comma"), "("), text.within(end, end, ")")
    )


def _inner_quotes(text: Broken) -> Slip | None:
    """Return a text with quotes of its own kind inside of it."""
    written = text.source.line(text.number)
    places = [m.start() for m in re.finditer('"', written)]
    if len(places) != 4 or "'" in written or re.search(r"\"\"\"|\bf\"", written):
        return None
    return as_written(
        text, "quotes_other", *(text.within(at, at + 1, "'") for at in (places[0], places[-1]))
    )


def _ends_open(text: Broken) -> Slip | None:
    """Return a line that ends where a value or a name belongs."""
    match = ENDS_OPEN.search(text.line)
    if match is None or "invalid syntax" not in text.fault.text or OPENS.match(text.line):
        return None
    variant = "ends_equals" if match["sign"] == "=" else "ends_open"
    return Slip("signs", variant, text.number, _shown(text), match["sign"])


def is_code_in_capitals(text: Broken) -> bool:
    """Whether Python reads a line if its first word is written in small letters."""
    match = re.match(r"[ \t]*(?P<word>[A-Za-z]+)", text.line)
    if match is None or not keyword.iskeyword(match["word"].lower()):
        return False
    return text.changed(text.within(*match.span("word"), match["word"].lower())) is not None


def note(text: Broken) -> Slip | None:
    """Return a line of plain words: the rest of a comment, or a note without a #."""
    written = text.source.line(text.number)
    match = PLAIN_WORDS.fullmatch(written) if len(written) < 300 else None
    if match is None or innermost(text.code.text[: text.code.start_of(text.number)]):
        return None
    words = re.findall(r"[\w'\u2019-]+", written)
    above = text.source.line(text.number - 1) if text.number > 1 else ""
    code = text.code.line(text.number - 1) if text.number > 1 else ""
    is_comment = any(a == "#" and b == " " for a, b in zip(above, code))
    comment = is_comment and not above.startswith("#!")
    first = match["first"]
    goes_on = comment and first in ("and", "or", "in", "is", "as", "not")
    is_code = first in FOREIGN or keyword.iskeyword(first) or first in ("match", "case", "type")
    in_capitals = first[0].isupper() and keyword.iskeyword(first.lower()) and len(words) < 4
    is_code = (is_code and not goes_on) or in_capitals or is_code_in_capitals(text)
    colon = match["colon"] is not None or match["later"] is not None
    is_name = colon and not first[0].isupper()
    if is_code or (is_name and not comment) or len(words) < (2 if comment else 3):
        return None
    if not comment and len(words) == 3 and not (colon or "," in written or first[0].isupper()):
        return None
    start = text.source.start_of(text.number) + len(indent_of(written))
    fixed = text.changed(Splice(start, start, "# "))
    if fixed is None:
        return None
    wanted, line = f"# {written.strip()}", text.number - 1 if comment else 0
    variant = "comment_wrapped" if comment else "note_without_sign"
    return Slip("signs", variant, text.number, written.strip(), wanted, fixed, other=line)


FORM_LOOKS: tuple[Look, ...] = (
    _import, _handler, _for, _condition, _ternary, _lambda, _entries, _call, _assigns, _raise,
)  # fmt: skip
LAST_FORM_LOOKS: tuple[Look, ...] = (_import_form, _inner_quotes, _ends_open)
