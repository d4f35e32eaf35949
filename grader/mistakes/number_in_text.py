"""Mistakes in how the number gets into the text: +, f-strings, %, format()."""

from __future__ import annotations

import ast
import io
import re
import tokenize
from dataclasses import replace

from grader.base.i18n.message import Value, joined, msg, say
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.counted import counter_in, text_added
from grader.mistakes.example import DEAD, LOG_LINE, NODE, STEP_LINE, example
from grader.mistakes.fixes import lines, node_log, node_words
from grader.mistakes.kind import Family
from grader.mistakes.made_by import lines_that_make, statements_that_make
from grader.mistakes.placeholders import placeholder_values
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.mistakes.worked_out import DIVISION, INSTEAD, change_of
from grader.package.edit.text import SourceText
from grader.package.edit.tree import Replace
from grader.package.source.counter import parts_of_callback, starts_of, targets_of
from grader.package.source.names import called_name, dotted
from grader.package.source.number_forms import number_forms, widths_in
from grader.package.source.place import function_at, place_of, statement_at
from grader.package.source.readable import is_readable
from grader.package.source.small_values import between
from grader.report.model import Where

MOST_CODE = 80  # characters of a piece of code that a text shows
NUMBER_ALONE = re.compile(r"(?:^|\]: )-?\d{1,20}\s*$", re.MULTILINE)
FLOAT_STEP = msg("An integer and a number with a decimal point make one with a point.")
FLOAT_START = msg("{form} is a number with a decimal point, so each sum with it is one too.")
OTHER_FORM = msg(
    "{form} sets the form in which the number is written, and the line has to have the plain integer."
)
ONE_PIECE = INSTEAD
MORE_PIECES = msg("Write {written} instead of {name}. Write also: {others}.")


def _concatenated(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    number_first = match[0].startswith("unsupported")
    statement = statement_at(raised.module, raised.line)
    if isinstance(statement, ast.Assign) and text_added(statement):
        return None
    kept = _kept_as_text(raised, statement)
    if kept is None and statement is not None and not number_first:
        kept = _kept_and_added(raised, statement)
    if kept is not None:
        return kept
    if _joins_digits(statement) and not number_first:
        return None
    if number_first and statement is not None and _sums(statement):
        return _summed(raised, statement)
    for node in raised.module.nodes:
        if not isinstance(node, ast.BinOp) or not isinstance(node.op, ast.Add):
            continue
        if raised.line not in range(node.lineno, (node.end_lineno or node.lineno) + 1):
            continue
        if (sum_of := _number_added_last(node, raised.module.text)) is not None:
            name, written, variant = sum_of
            found = raised.finding("str_plus_int", name=name, written=written)
            return replace(found, variant=variant)
        sides = (node.left,) if number_first else (node.right,)
        operand = next((part for part in sides if _may_be_number(part)), None)
        if operand is not None:
            text = raised.module.text
            number = operand
            if isinstance(operand, ast.Call) and len(operand.args) == 1:
                number = operand.args[0] if dotted(operand.func) in ("int", "float") else operand
            written = f"str({text.code(number)})"
            return raised.finding("str_plus_int", name=text.code(operand), written=written)
    added = statement.value if isinstance(statement, ast.AugAssign) else None
    if added is None or number_first or not _may_be_number(added):
        return None
    name = raised.module.text.code(added)
    return raised.finding("str_plus_int", at=statement, name=name, written=f"str({name})")


def _added_to_itself(statement: ast.stmt) -> tuple[str, ast.expr] | None:
    """Return the attribute to which a statement adds a number, and that number."""
    value = statement.value if isinstance(statement, ast.Assign) else None
    if isinstance(statement, ast.AugAssign):
        name, added = dotted(statement.target), statement.value
    elif isinstance(statement, ast.Assign) and isinstance(value, ast.BinOp):
        name, added = dotted(value.left), value.right
        if not isinstance(value.op, ast.Add) or [*targets_of(statement)] != [name]:
            return None
    else:
        return None
    return (name, added) if name.startswith("self.") and _is_literal(added) else None


def _joins_digits(statement: ast.stmt | None) -> bool:
    """Whether a number is added to what is set: with str() the digits are joined, nothing counts."""
    if statement is None or _added_to_itself(statement) is not None:
        return statement is not None
    names = set(targets_of(statement))
    sums = [n for n in ast.walk(statement) if isinstance(n, ast.BinOp) and _is_literal(n.right)]
    return any(dotted(n.left) in names for n in sums)


def _kept_and_added(raised: Raised, statement: ast.stmt) -> RecognisedMistake | None:
    """A number is added to an attribute that no line sets to a text of other signs."""
    found = _added_to_itself(statement)
    if found is None:
        return None
    name, code, added = (
        found[0],
        raised.module.text.code(statement),
        raised.module.text.code(found[1]),
    )
    if not _has_digits(raised, name):
        return None
    start = _start_as_text(raised, name)
    if start is not None:
        return start
    params = {"name": code, "written": f"{name} = int({name}) + {added}"}
    kept = raised.finding("str_plus_int", at=statement, params=params)
    return replace(kept, words={**kept.words, "attribute": name}, variant="kept_text")


def _has_digits(raised: Raised, name: str) -> bool:
    """Whether each value that an attribute gets is a number or a number's text, so int() reads it."""
    values = [
        n.value
        for n in raised.source.all_nodes
        if isinstance(n, ast.Assign | ast.AnnAssign)
        and name in targets_of(n)
        and not (isinstance(n, ast.Assign) and _added_to_itself(n) is not None)
    ]
    return bool(values) and all(value is not None and _reads_as_number(value) for value in values)


def _reads_as_number(value: ast.expr) -> bool:
    made = isinstance(value, ast.Call) and dotted(value.func) == "str" and len(value.args) == 1
    if isinstance(value, ast.Call) and made:
        return not any(map(_is_other_value, ast.walk(value.args[0])))
    text = value.value if isinstance(value, ast.Constant) else None
    return _is_literal(value) or (isinstance(text, str) and text.strip().isdigit())


def _is_other_value(part: ast.AST) -> bool:
    """Whether a part of what becomes a text is a word, or a call that may give one."""
    text = part.value if isinstance(part, ast.Constant) else None
    word = isinstance(text, str) and not text.strip().isdigit()
    called = isinstance(part, ast.Call) and dotted(part.func) not in (
        "int",
        "len",
        "float",
        "round",
    )
    return word or called or isinstance(part, ast.JoinedStr)


def _start_as_text(raised: Raised, name: str) -> RecognisedMistake | None:
    """The only line that sets the counter makes a text of a number: `self.n = str(0)`."""
    sets = [
        n
        for n in raised.module.nodes
        if isinstance(n, ast.Assign) and name in targets_of(n) and _added_to_itself(n) is None
    ]
    value = sets[0].value if len(sets) == 1 else None
    if not isinstance(value, ast.Call) or dotted(value.func) != "str" or len(value.args) != 1:
        return None
    if not _is_literal(value.args[0]):
        return None
    code = raised.module.text.code
    params = {"name": code(value), "written": code(value.args[0])}
    found = raised.finding("str_plus_int", at=sets[0], params=params)
    return replace(found, words={**found.words, "attribute": name}, variant="start_text")


def _kept_as_text(raised: Raised, statement: ast.stmt | None) -> RecognisedMistake | None:
    """A counter that is kept as a text gets a number: `self.n = str(self.n + 1)`."""
    value = statement.value if isinstance(statement, ast.Assign) else None
    made = isinstance(value, ast.Call) and dotted(value.func) == "str" and len(value.args) == 1
    total = value.args[0] if isinstance(value, ast.Call) and made else None
    if not isinstance(statement, ast.Assign) or not isinstance(total, ast.BinOp):
        return None
    name = dotted(total.left)
    if not isinstance(total.op, ast.Add) or name not in targets_of(statement):
        return None
    if not _is_literal(total.right) or not _has_digits(raised, name):
        return None
    code, added = raised.module.text.code(total), raised.module.text.code(total.right)
    if "\n" in code:
        return None
    found = raised.finding("str_plus_int", at=total, name=code, written=f"int({name}) + {added}")
    return replace(found, words={**found.words, "attribute": name}, variant="kept_text")


def _sums(statement: ast.stmt) -> list[ast.Call]:
    """Return the calls of sum() in a statement."""
    return [n for n in ast.walk(statement) if isinstance(n, ast.Call) and dotted(n.func) == "sum"]


def _summed(raised: Raised, statement: ast.stmt) -> RecognisedMistake | None:
    """sum() adds a text to a number; None if another + of the statement can be the one that fails."""
    calls = _sums(statement)
    added = [
        n for n in ast.walk(statement) if isinstance(n, ast.BinOp) and isinstance(n.op, ast.Add)
    ]
    code = raised.module.text.code(calls[0])
    if len(calls) > 1 or any(_may_be_number(n.left) for n in added) or "\n" in code:
        return None
    found = raised.finding("str_plus_int", name=code, written="''.join(…)")
    return replace(found, variant="summed")


def _number_added_last(node: ast.BinOp, text: SourceText) -> tuple[str, str, str] | None:
    """Return the end of a sum of a text, a value and a number, what to write for it, and a variant.

    As in `'%d' % n + 1`, `'n: ' + str(n) + 1` ("late": the value is text when the number is added)
    and `'n: ' + n + 1`. None if the sum has another form or more than one line.
    """
    made, number = node.left, text.code(node.right)
    if not _is_literal(node.right) or "\n" in text.code(node):
        return None
    if isinstance(made, ast.BinOp) and isinstance(made.op, ast.Mod):
        if isinstance(made.right, ast.Tuple | ast.Dict) or text.plain_string(made.left) is None:
            return None
        return (
            text.code_between(made.right, node.right),
            f"({text.code(made.right)} + {number})",
            "late",
        )
    if isinstance(made, ast.BinOp) and isinstance(made.op, ast.Add):
        made = made.right
        if isinstance(made, ast.Name | ast.Attribute):
            whole = text.code_between(made, node.right)
            return whole, f"str({whole})", ""
    if not isinstance(made, ast.Call) or len(made.args) != 1 or made.keywords:
        return None
    if called_name(made) not in ("str", "format"):
        return None
    start, (_, end) = text.span(made)[0], text.span(made.args[0])
    written = f"{text.text[start:end]} + {number})"
    return text.code_between(made, node.right), written, "late"


def _is_literal(part: ast.expr) -> bool:
    return isinstance(part, ast.Constant) and type(part.value) in (int, float)


def _may_be_number(part: ast.expr) -> bool:
    """Whether an operand of + is not a text for certain, nor itself a sum."""
    text = isinstance(part, ast.JoinedStr | ast.BinOp)
    text = text or (isinstance(part, ast.Constant) and isinstance(part.value, str))
    return not text and not (isinstance(part, ast.Call) and dotted(part.func) == "str")


def _place_of_text(suspect: Suspect) -> Where:
    where = suspect.place
    return where if where is not None and where.line else place_of(suspect.source, None)


def _f_prefix(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the string whose braces hold what can be read where it is written."""
    source, string = suspect.source, _string_of(suspect)
    if _double_braces(suspect) is not None:
        return None
    if string is None or not _holds_values(suspect.text):
        named = re.search(r"\{[A-Za-z_][\w.]{0,80}\}", suspect.text)
        if named is None or string is not None or not _is_sure(suspect):
            return None
        return suspect.finding("f_prefix", _place_of_text(suspect))
    module, code = source.module_of(string), source.module_of(string).text.code(string)
    values = re.findall(r"\{([^{}!:=]{1,80})[!:=]?[^{}]{0,20}\}", suspect.text)
    if all(is_readable(source, module, source.function_around(string), v) for v in values):
        if code[:1] not in ("'", '"') or _is_joined(code):
            return _f_of_part(suspect, string)
        found = suspect.finding("f_prefix", string, name=code, written=f"f{code}")
        return replace(found, variant="written" if len(code) <= MOST_CODE else "")
    given = _given(suspect, string)
    function = source.function_around(given) if given is not None else None
    plain = code[:1] in ("'", '"') and not _is_joined(code)
    if given is None or not plain or len(code) > MOST_CODE:
        return None
    if not all(is_readable(source, source.module_of(given), function, v) for v in values):
        return None
    name = source.module_of(given).text.code(given)
    found = suspect.finding("f_prefix", given, name=name, written=f"f{code}")
    return replace(found, variant="elsewhere")


def _double_braces(suspect: Suspect) -> RecognisedMistake | None:
    """Look for an f-string whose values are in {{ }}, which stand for { } in the text."""
    source, pattern = suspect.source, re.compile(r"\{\{([^{}\n]{1,80})\}\}")
    for string in (n for n in source.all_nodes if isinstance(n, ast.JoinedStr)):
        code = source.module_of(string).text.code(string)
        found = pattern.search(code) if len(code) <= MOST_CODE else None
        if found is None or f"{{{found[1]}}}" not in suspect.text:
            continue
        function = source.function_around(string)
        if is_readable(source, source.module_of(string), function, found[1]):
            written = pattern.sub(r"{\1}", code)
            finding = suspect.finding("counter_in_text", string, name=found[1], written=written)
            return replace(finding, variant="doubled_at")
    return None


def _is_joined(code: str) -> bool:
    """Whether the code of a string consists of several strings beside each other."""
    rows = io.StringIO(f"({code})").readline
    try:
        return sum(t.type == tokenize.STRING for t in tokenize.generate_tokens(rows)) > 1
    except (tokenize.TokenError, SyntaxError):
        return True


def _f_of_part(suspect: Suspect, string: ast.Constant) -> RecognisedMistake | None:
    """Name the only string with braces that has no f, of several beside each other."""
    module = suspect.source.module_of(string)
    last = string.end_lineno or string.lineno
    found = [
        (row, part)
        for row in range(string.lineno, last + 1)
        for part in re.findall(r"(?<![\w'\"])(?:'[^'\\]*'|\"[^\"\\]*\")", module.line(row))
        if re.search(r"\{[^{}]+\}", part)
    ]
    if len(found) != 1:
        return None
    row, part = found[0]
    place = Where(file=module.path, line=row)
    mistake = suspect.finding("f_prefix", place, name=part, written=f"f{part}")
    return replace(mistake, variant="part")


def _given(suspect: Suspect, string: ast.Constant) -> ast.expr | None:
    """Return the name that the only log call gets, if its only value is this string."""
    call = suspect.source.log_call
    given = call.args[0] if call is not None else None
    if given is None or not dotted(given) or "get_logger" in dotted(given):
        return None
    return given if node_words.values_of(suspect.source, given) == [string] else None


def _is_sure(suspect: Suspect) -> bool:
    """Whether the counter of the texts is a number that the node sets, not only a usual name."""
    counter = str(placeholder_values(suspect.assignment, suspect.source)["counter"])
    source, place = suspect.source, _place_of_text(suspect)
    module = source.module_at(place.file)
    function = function_at(module, place.line)
    number = counter in starts_of(source) or counter.startswith("next(")
    return number and (function is None or is_readable(source, module, function, counter))


def _holds_values(text: str) -> bool:
    """Whether what a text has in braces is Python code that reads a name."""
    try:
        parsed = ast.parse(f"f{text!r}", mode="eval").body
    except (SyntaxError, ValueError):
        return False
    values = [n.value for n in ast.walk(parsed) if isinstance(n, ast.FormattedValue)]
    return bool(values) and all(
        any(isinstance(n, ast.Name) for n in ast.walk(value)) for value in values
    )


def _f_in_quotes(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a whole f-string in the quotes of another string."""
    string = _string_of(suspect)
    if string is None or not re.fullmatch(r"[fF](['\"])[^'\"]*\{.*\1", suspect.text):
        return None
    try:
        inner = ast.parse(suspect.text, mode="eval").body
    except (SyntaxError, ValueError):
        return None
    if not isinstance(inner, ast.JoinedStr):
        return None
    code = suspect.source.module_of(string).text.code(string)
    return suspect.finding("f_in_quotes", string, name=code, written=suspect.text)


def _string_of(suspect: Suspect) -> ast.Constant | None:
    """Return the string that is the logged text: the only one of the callback, or of the files."""
    callback = suspect.source.callback
    of_callback = list(ast.walk(callback)) if callback is not None else []
    for nodes in (of_callback, suspect.source.own_nodes, suspect.source.all_nodes):
        found = [n for n in nodes if isinstance(n, ast.Constant) and n.value == suspect.text]
        if found:
            return found[0] if len(found) == 1 else None
    return None


def _value_forgotten(suspect: Suspect) -> RecognisedMistake | None:
    """The text shows the place of a value, and has the required form with a number there."""
    match = re.search(r"%[dis]|\{(?:0|(?P<field>[A-Za-z_]\w{0,60}))?\}", suspect.text)
    head, tail = map(re.escape, suspect.output.text.split("{n}"))
    number = suspect.text.replace(match[0], "0", 1) if match is not None else ""
    if match is None or not re.fullmatch(rf"{head}\d+{tail}", number):
        return None
    sign = match[0]
    other = _other_format(suspect, sign)
    if other is not None:
        return _with_percent(suspect, other, sign)
    counter = str(placeholder_values(suspect.assignment, suspect.source)["counter"])
    given = f"{match['field']}={counter}" if match["field"] else counter
    value = f"% {counter}" if sign.startswith("%") else f".format({given})"
    found = suspect.finding("value_forgotten", _place_of_text(suspect), name=sign, written=value)
    if not _is_sure(suspect):
        return replace(found, variant="unknown")
    string = _string_of(suspect)
    used = _given(suspect, string) if string is not None else None
    if string is None or used is None or _is_beside(suspect, string):
        return found
    name = suspect.source.module_of(used).text.code(used)
    written = f"{name} {value}" if sign.startswith("%") else f"{name}{value}"
    found = suspect.finding("value_forgotten", used, name=name, written=written)
    return replace(found, words={**found.words, "place": sign}, variant="instead")


def _is_beside(suspect: Suspect, string: ast.Constant) -> bool:
    """Whether a string is in the function that logs it: its value can follow it there."""
    call = suspect.source.log_call
    around = suspect.source.function_around
    return call is not None and around(string) is around(call)


def _with_percent(suspect: Suspect, call: ast.Call, sign: str) -> RecognisedMistake:
    """The call of .format() gets a text with %: write the % in its place, or {} in the text."""
    found = suspect.finding("value_forgotten", call, name=sign, written="{}")
    made = call.func.value if isinstance(call.func, ast.Attribute) else None
    text = suspect.source.module_of(call).text
    if made is None or isinstance(made, ast.Constant):
        return replace(found, variant="other_format")
    given = call.args[0] if len(call.args) == 1 and not call.keywords else None
    if given is None or not dotted(given) or "\n" in text.code(call):
        return replace(found, variant="other_format_kept")
    written = f"{text.code(made)} % {text.code(given)}"
    found = suspect.finding("value_forgotten", call, name=text.code(call), written=written)
    return replace(found, words={**found.words, "place": sign}, variant="percent")


def _other_format(suspect: Suspect, sign: str) -> ast.Call | None:
    """Return the call of .format() on a text with %, which .format() leaves as it is."""
    if not sign.startswith("%"):
        return None
    for node in suspect.source.own_nodes:
        called = node.func if isinstance(node, ast.Call) else None
        text = called.value if isinstance(called, ast.Attribute) else None
        if not isinstance(node, ast.Call) or text is None or called_name(node) != "format":
            continue
        values = node_words.values_of(suspect.source, text)
        if [getattr(value, "value", None) for value in values] == [suspect.text]:
            return node
    return None


def _no_value(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The call of format on the line has fewer values than its text has places."""
    del match
    statement = statement_at(raised.module, raised.line)
    for call in ast.walk(statement) if statement is not None else ():
        if isinstance(call, ast.Call) and called_name(call) == "format" and not call.args:
            written = f".format({raised.words['counter']})"
            found = raised.finding("value_forgotten", at=call, name="{}", written=written)
            return replace(found, variant="format")
    return None


def _without_number(suspect: Suspect) -> RecognisedMistake | None:
    """The line has only the text around the number."""
    without = suspect.output.text.replace("{n}", "").split()
    if suspect.text.split() != without and not _constant_text(suspect):
        return None
    if any(suspect.output.line(k) in suspect.transcript for k in (1, 2)):
        return None  # (other lines have the number)
    found = suspect.finding("text_without_number", _place_of_text(suspect))
    if NUMBER_ALONE.search(suspect.transcript):
        return replace(found, variant="parts")
    if not _is_sure(suspect):
        return replace(found, variant="unknown")
    used = _used_in_text(suspect, str(found.words["counter"]))
    if used is None:
        return found
    return replace(found, words={**found.words, "line": str(used.lineno)}, variant="lost")


def _used_in_text(suspect: Suspect, counter: str) -> ast.expr | None:
    """Return where the counter is given to something, so that a text could be made of it."""
    for node in suspect.source.own_nodes:
        if not isinstance(node, ast.Name | ast.Attribute) or dotted(node) != counter:
            continue
        around = suspect.source.module_of(node).parents.get(node)
        inside = isinstance(
            around, ast.Call | ast.keyword | ast.FormattedValue | ast.List | ast.Tuple
        )
        if inside and isinstance(node.ctx, ast.Load):
            return node
    return None


def _constant_text(suspect: Suspect) -> bool:
    """Whether the callback logs the first line of the output as it is."""
    call = suspect.source.log_call
    given = call.args[0] if call is not None else None
    return isinstance(given, ast.Constant) and given.value == suspect.output.line(
        suspect.output.start
    )


def _always_first(suspect: Suspect) -> RecognisedMistake | None:
    call = suspect.source.log_call
    return suspect.finding("text_without_number", call) if _constant_text(suspect) else None


def _tuple(suspect: Suspect) -> RecognisedMistake | None:
    """The line is a tuple of the text and the number."""
    if not re.fullmatch(r"\((['\"]).*\1, ?-?\d+\)", suspect.text):
        return None
    callback = suspect.source.callback
    for node in ast.walk(callback) if callback is not None else ():
        value = getattr(node, "value", None)
        if isinstance(node, ast.Assign) and isinstance(value, ast.Tuple):
            return suspect.finding("text_is_tuple", node)
    return suspect.finding("text_is_tuple", _place_of_text(suspect))


def _number_format(suspect: Suspect) -> RecognisedMistake | None:
    head, tail = map(re.escape, suspect.output.text.split("{n}"))
    number = r"[+-]?\d+\.\d+|\+\d+|0\d+|\d(?:\.\d+)?e[+-]?\d+|0[xbo][0-9a-f]+"
    if re.fullmatch(rf"{head}(?: +\d+|\d+ +){tail}", suspect.text):
        return _other_form(suspect) or _form_elsewhere(suspect)
    if not re.fullmatch(rf"{head} *(?:{number}) *{tail}", suspect.text):
        return None
    found = _other_form(suspect)
    change = change_of(suspect, "step") if found is None else None
    if change is not None:
        step = suspect.finding("number_format", change.at, name=change.name, written=change.written)
        return replace(step, variant="step")
    counter = counter_in(suspect) if found is None else None
    for node in counter.added if counter is not None else ():
        if counter is not None and not _is_integer(suspect, node.value):
            new = f"{counter.name} += {suspect.output.step}"
            code = suspect.source.module_of(node).text.code(node)
            step = suspect.finding("number_format", node, name=code, written=new)
            return replace(step, variant="step")
    zeros = re.fullmatch(rf"{head}0\d+{tail}", suspect.text) is not None
    return found or (_form_elsewhere(suspect) if zeros else None) or _form_unknown(suspect)


def _form_elsewhere(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only piece with a width in the lines that make what is logged, or beside them."""
    made = statements_that_make(suspect.source, suspect.place)
    logs = [
        call for part in parts_of_callback(suspect.source) for call in suspect.source.logs(part)
    ]
    found = {piece for n in (*made, *logs) for piece in widths_in(suspect.source.module_of(n), n)}
    if len(found) != 1:
        return None
    piece = found.pop()
    place = Where(file=piece.module.path, line=piece.line)
    head = suspect.output.text.partition("{n}")[0]
    texts = [str(getattr(n, "value", "")) for n in suspect.source.own_nodes]
    if head.endswith(" ") and not any(head in t for t in texts) and head.rstrip() in texts:
        mistake = suspect.finding("number_format", place, name=piece.name)
        words = {"form": piece.form, "written": piece.written, "found": shown(head)}
        return replace(mistake, words={**mistake.words, **words}, variant="form_and_blank")
    mistake = suspect.finding("number_format", place, name=piece.name, written=piece.written)
    return replace(mistake, words={**mistake.words, "form": piece.form}, variant="form")


def _form_unknown(suspect: Suspect) -> RecognisedMistake:
    """Say which lines make the number, if nothing is known that gives it its form."""
    origin = _only_float(suspect)
    if origin is not None:
        return origin
    divided = _only_division(suspect)
    if divided is not None:
        return divided
    found = suspect.finding("number_format", _place_of_text(suspect))
    made = lines_that_make(suspect.source, suspect.place)
    if made is None:
        return found
    return replace(found, words={**found.words, "lines": made}, variant="lines")


def _only_division(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only / in the lines that make what is logged."""
    nodes = [n for s in statements_that_make(suspect.source, suspect.place) for n in ast.walk(s)]
    found = [n for n in nodes if isinstance(n, ast.BinOp) and isinstance(n.op, ast.Div)]
    if len(set(found)) != 1 or not re.search(r"\d\.\d", suspect.text):
        return None
    change = between(
        suspect.source.module_of(found[0]), found[0], found[0].left, found[0].right, "//"
    )
    name, written = shown(change.name), shown(change.written)
    return replace(
        suspect.finding("number_format", found[0], name=name, written=written), variant="division"
    )


def _only_float(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only number with a decimal point in the lines that make what is logged."""
    module = suspect.source.module
    found = [
        (n, part)
        for n in statements_that_make(suspect.source, suspect.place)
        for part in ast.walk(n)
        if isinstance(part, ast.Div)
        or (isinstance(part, ast.Constant) and type(part.value) is float)
    ]
    statement, part = found[0] if len(found) == 1 else (None, None)
    if statement is None or not isinstance(part, ast.Constant) or not module.has(part):
        return None
    if not isinstance(part.value, float) or not part.value.is_integer():
        return None
    old, number = module.text.code(statement), module.text.code(part)
    if old.count(number) != 1 or "\n" in old:
        return None
    written = old.replace(number, str(int(part.value)))
    return replace(
        suspect.finding("number_format", statement, name=old, written=written), variant="origin"
    )


def _padded(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a form that fills short numbers, where only the long ones have the right text."""
    output, counter = suspect.output, counter_in(suspect)
    start = starts_of(suspect.source).get(counter.name) if counter is not None else None
    found = number_forms(suspect.source, output.start, output.step)
    if start is None or start.value != output.start or len(found) != 1:
        return None
    return _other_form(suspect) if found[0].part == "form" else None


def _other_form(suspect: Suspect) -> RecognisedMistake | None:
    """Name the piece of code that gives the number its form, and the next one if there is one."""
    output = suspect.output
    found = number_forms(suspect.source, output.start, output.step)
    if not found:
        return None
    piece, place = found[0], Where(file=found[0].module.path, line=found[0].line)
    mistake = suspect.finding("number_format", place, name=piece.name, written=piece.written)
    words: dict[str, Value] = {**mistake.words, "form": piece.form}
    if len(found) == 1:
        return replace(mistake, words=words, variant=piece.part)
    others = [
        say("{new} instead of {old} (line {line})", new=o.written, old=o.name, line=o.line)
        for o in found[1:]
    ]
    floats = piece.part == "form" and any(other.part != "form" for other in found)
    words = {**words, "others": joined(*others, by=", ")}
    return replace(mistake, words=words, variant="floats" if floats else f"{piece.part}_and_more")


def _is_integer(suspect: Suspect, value: ast.expr) -> bool:
    """Whether what is added is an integer, or a name that is not set to a float."""
    if isinstance(value, ast.Constant):
        return not isinstance(value.value, float)
    return not _is_float_name(suspect, dotted(value))


def _is_float_name(suspect: Suspect, name: str) -> bool:
    owner, _, last = name.rpartition(".")
    source, known = suspect.source, {name}
    of_class = last if owner == "self" or owner in source.class_names else ""
    values = (
        getattr(node, "value", None)
        for node in source.own_nodes
        if isinstance(node, ast.Assign | ast.AnnAssign)
        and (known | ({of_class} if node in source.class_body else set())) & set(targets_of(node))
    )
    return any(isinstance(v, ast.Constant) and isinstance(v.value, float) for v in values)


def _in_text(suspect: Suspect) -> RecognisedMistake | None:
    """The line shows the counter's name: the name is part of the string."""
    doubled = _double_braces(suspect)
    if doubled is not None:
        return doubled
    counter = str(placeholder_values(suspect.assignment, suspect.source)["counter"])
    if "." not in counter or counter not in suspect.text:
        return None
    place = _place_of_text(suspect)
    row = suspect.source.module_at(place.file).line(place.line)
    spaced = re.search(rf"\{{\s*{re.escape(counter)}\s*\}}", suspect.text)
    if spaced is not None and not _is_doubled(counter, row):
        return None
    found = suspect.finding("counter_in_text", place, name=counter)
    return _in_f_string(found, counter, row)


def _is_doubled(counter: str, row: str) -> bool:
    """Whether two braces are around the counter, with or without blanks."""
    return re.search(rf"\{{\{{\s*{re.escape(counter)}\s*\}}\}}", row) is not None


def _in_f_string(found: RecognisedMistake, counter: str, row: str) -> RecognisedMistake:
    """Name what an f-string has around the name of the counter."""
    equals = re.search(rf"\{{(\s*{re.escape(counter)}\s*)=\s*(?:[!:][^{{}}]*)?\}}", row)
    if equals is not None:
        words = {**found.words, "found": equals[0], "written": f"{{{counter}}}"}
        return replace(found, words=words, variant="equals")
    if _is_doubled(counter, row):
        return replace(found, variant="doubled")
    if "f'" not in row and 'f"' not in row:
        return found
    signs = re.search(rf"([(\[<$%])\s*{re.escape(counter)}", row)
    opened = signs[1] if signs is not None else ""
    variant = "round" if opened == "(" else "signs" if opened else "bare"
    return replace(found, words={**found.words, "found": opened}, variant=variant)


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "str_plus_int",
        "text",
        msg("A string and a number are added"),
        msg("Python's + joins a string only with another string."),
        msg("Write {written} instead of {name}: str() makes a string of a number."),
        links.PYTHON_STRINGS,
        whys={
            "late": msg("Python makes the string first, and then adds a number to it."),
            "kept_text": msg(
                "{attribute} is a string here: Python's + joins a string only with another one."
            ),
            "start_text": msg(
                "{attribute} is a string here: Python's + joins a string only with another one."
            ),
            "summed": msg(
                "sum() begins with the number 0 and adds each part to it, so it cannot add a string."
            ),
        },
        fixes={
            "late": msg("Write {written} instead of {name}, so that the numbers are added first."),
            "kept_text": msg(
                "Write {written} instead of {name}: int() makes a number of the string."
            ),
            "start_text": msg("Write {written} instead of {name}: a counter is a number."),
            "summed": msg(
                "{name} gets a string. To join strings, use ''.join() instead of sum(): all its parts "
                "must be strings, and str() makes one of a number. To add numbers, give sum() only "
                "numbers: int() makes one of a string."
            ),
        },
        seen=r'TypeError: can only concatenate str \(not "(?P<type>int|float|bool|complex)"\) to str'
        r"|TypeError: unsupported operand type\(s\) for \+: '(?:int|float)' and 'str'",
        raised={
            r"can only concatenate str \(not \"(?:int|float|bool|complex)\"|unsupported operand type\(s\) for \+: '(?:int|float)' and 'str'": _concatenated
        },
        fixed_by=(node_log.number_as_text, lines.written),
        examples=(
            example(
                "counter_starts_as_str_of_a_number",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = str(0)"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "int_for_str",
                Replace(NODE, "str(self.counter_)", "int(self.counter_)"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "added_after_percent",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = -1"),
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "'Hello time: %d' % self.counter_ + 1",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "str_around_the_sum",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "str('Hello time: ' + self.counter_)",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "str_missing",
                Replace(NODE, "str(self.counter_)", "self.counter_"),
                fails="run.output",
                blocks=DEAD,
                note='can only concatenate str (not "int") to str',
            ),
        ),
    ),
    _node(
        "counter_in_text",
        "text",
        msg("The text contains the name of the counter"),
        msg("What is between the quotes is shown as it is: {name} is only text there."),
        msg("Write the text as {f_string}"),
        links.PYTHON_STRINGS,
        whys={
            **dict.fromkeys(
                ("doubled", "doubled_at"),
                msg("In an f-string, {{{{ is one shown brace: two braces hold no value."),
            ),
            "round": msg(
                "In an f-string, a value is in braces. Round brackets and what is in them are "
                "shown as they are."
            ),
            "signs": msg(
                "In an f-string, a value is in braces. {found} and the name behind it are shown as "
                "they are."
            ),
            "bare": msg(
                "In an f-string, a value is in braces. A name without braces is shown as it is."
            ),
            "equals": msg("= in the braces also writes the code that is before it."),
        },
        fixes={
            "equals": msg("Write {written} instead of {found}."),
            "doubled_at": msg("Write this text as {written}"),
        },
        behind={"run.wrong_text": _in_text},
        fixed_by=tuple(map(node_log.right_text, (node_log.in_braces, node_log.text))),
        examples=(
            example(
                "braces_doubled",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "f'Hello time: {{self.counter_}}'",
                ),
                fails="run.output",
            ),
            example(
                "braces_doubled_with_blanks",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "f'Hello time: {{ self.counter_ }}'",
                ),
                fails="run.output",
            ),
            example(
                "braces_doubled_in_a_variable",
                Replace(
                    NODE,
                    "        self.get_logger().info('Hello time: ' + str(self.counter_))\n",
                    "        text = f'Hello time: {{self.counter_}}'\n"
                    "        self.get_logger().info(text)\n",
                ),
                fails="run.output",
            ),
            example(
                "round_brackets",
                Replace(
                    NODE, "'Hello time: ' + str(self.counter_)", "f'Hello time: (self.counter_)'"
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "f_in_quotes",
        "text",
        msg("A whole f-string is inside other quotes"),
        msg(
            "All that is between the outer quotes is text, the f and the inner quotes too. Python "
            "replaces {{…}} with a value only if the f is before the outer quotes."
        ),
        msg("Delete the outer quotes: write {written} instead of {name}."),
        links.PYTHON_STRINGS,
        behind={"run.wrong_text": _f_in_quotes},
        fixed_by=(lines.written,),
        examples=(
            example(
                "f_in_quotes",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "'f\"Hello time: {self.counter_}\"'",
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "f_prefix",
        "text",
        msg("The f before the string is missing"),
        msg("Python replaces {{…}} with a value only in a string that begins with f."),
        msg("Write an f before the first quote: {f_string}"),
        links.PYTHON_STRINGS,
        whys={
            "part": msg(
                "Of several strings beside each other, each one with {{…}} needs an f of its own."
            )
        },
        fixes={
            "written": msg("Write an f before the first quote: {written}"),
            "part": msg("Write {written} instead of {name}."),
            "elsewhere": msg(
                "Write {written} instead of {name} in this line: an f-string reads its values where it "
                "is written."
            ),
        },
        seen=r"^\[[A-Z]{4,5}\] \[\d{1,12}\.\d{9}\] \[[^\]\n]{1,100}\]: [^\n{]{0,200}\{self\.\w{1,60}\}",
        behind={"run.wrong_text": _f_prefix},
        fixed_by=tuple(map(node_log.right_text, (node_log.f_prefix, lines.written))),
        examples=(
            example(
                "f_missing_in_the_second_of_two_strings",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "'Hello '\n            'time: {self.counter_}'",
                ),
                fails="run.output",
            ),
            example(
                "f_lost_in_a_helper",
                Replace(
                    NODE,
                    "class MyFirstNode(",
                    "class Texts:\n    def __init__(self, start):\n        self.start = start\n\n"
                    "    def line(self, number):\n        return '{self.start}{number}'\n\n\n"
                    "class MyFirstNode(",
                ),
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = 0\n        self.texts = Texts('Hello time: ')",
                ),
                Replace(
                    NODE, "'Hello time: ' + str(self.counter_)", "self.texts.line(self.counter_)"
                ),
                fails="run.output",
            ),
            example(
                "f_prefix_missing",
                Replace(
                    NODE, "'Hello time: ' + str(self.counter_)", "'Hello time: {self.counter_}'"
                ),
                fails="run.output",
            ),
            example(
                "f_prefix_missing_in_variable",
                Replace(
                    NODE,
                    "        self.get_logger().info('Hello time: ' + str(self.counter_))\n",
                    "        text = 'Hello time: {self.counter_}'\n"
                    "        self.get_logger().info(text)\n",
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "value_forgotten",
        "text",
        msg("A place for a value in the text gets no value"),
        msg("Python replaces {name} in a string only if a value follows the string."),
        msg("Write {written} after the string, or use an f-string: {f_string}"),
        links.PYTHON_STRINGS,
        whys={
            "other_format": msg(
                ".format() puts its values in the place of {{}}, and leaves {name}."
            ),
            "other_format_kept": msg(
                ".format() puts its values in the place of {{}}, and leaves {name}."
            ),
            "percent": msg(".format() puts its values in the place of {{}}, and leaves {place}."),
            "instead": msg(
                "Python replaces {place} in a string only if a value follows the string."
            ),
            "format": msg("Each {{}} of the text needs a value in the ( ) of format."),
        },
        fixes={
            "other_format": msg(
                "Write {{}} instead of {name} in the string, or an f-string: {f_string}"
            ),
            "other_format_kept": msg("Write {{}} instead of {name} in the string."),
            "percent": msg("Write {written} instead of {name}."),
            "instead": msg("Write {written} instead of {name}."),
            "format": msg("Write {written} instead of .format(), or use an f-string: {f_string}"),
            "unknown": msg(
                "Give the place its value where the text is made: % and the value behind a text with "
                "%d, .format() with the value in its () behind a text with {{}}."
            ),
        },
        raised={r"Replacement index \d{1,9} out of range": _no_value},
        behind={"run.wrong_text": _value_forgotten},
        fixed_by=tuple(map(node_log.right_text, (node_words.value, node_words.value_for_name))),
        examples=(
            example(
                "percent_without_value",
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "'Hello time: %d'"),
                fails="run.output",
            ),
            example(
                "name_in_braces_without_value",
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "'Hello time: {seconds}'"),
                fails="run.output",
            ),
            example(
                "format_with_percent",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "'Hello time: %d'.format(self.counter_)",
                ),
                fails="run.output",
            ),
            example(
                "format_without_value",
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "'Hello time: {}'.format()"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "format_forgotten",
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "'Hello time: {}'"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "text_is_tuple",
        "text",
        msg("The text and the number are joined with a comma"),
        msg("A comma makes a tuple of two values. Only print() shows them side by side."),
        msg("Join the text and the number: {sum}"),
        links.PYTHON_STRINGS,
        behind={"run.wrong_text": _tuple},
        examples=(
            example(
                "message_is_tuple",
                Replace(
                    NODE,
                    "self.get_logger().info('Hello time: ' + str(self.counter_))",
                    "message = 'Hello time: ', self.counter_\n"
                    "        self.get_logger().info(str(message))",
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "text_without_number",
        "text",
        msg("The counter is not in the text"),
        msg("The number in the line is the counter's value at that moment."),
        msg("Add the counter to the text: {sum}"),
        links.PYTHON_STRINGS,
        whys={
            "parts": msg(
                "The text comes on one line and the number on another: each call of the logger or of print() "
                "writes a line of its own."
            ),
            "lost": msg(
                "Line {line} uses the counter, but its value does not get into the text that is logged."
            ),
        },
        fixes={
            "lost": msg(
                "Follow the value from there to the line that logs the text: find what leaves it out. Or "
                "make the text in one step: {sum}"
            ),
            "parts": msg(
                "Find the call that makes the line with the text, and the one that makes the line with the "
                "number. Make one text of both, with + and str(…) or as an f-string, and log it with one call."
            ),
            "unknown": msg(
                "Add the number of the count to the text, as str() of the value that counts the lines."
            ),
        },
        behind={"run.wrong_text": _without_number, "run.constant_counter": _always_first},
        fixed_by=(node_log.right_text(node_log.number),),
        examples=(
            example(
                "first_line_as_constant",
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "'Hello time: 0'"),
                fails="run.output",
            ),
            example(
                "text_and_number_by_two_methods",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class Out:\n    def __init__(self, logger):\n        self.logger = logger\n\n"
                    "    def text(self, text):\n        self.logger.info(text)\n        return self\n\n"
                    "    def value(self, value):\n        self.logger.info(f'{value}')\n\n\n"
                    "class MyFirstNode",
                ),
                Replace(
                    NODE,
                    "self.get_logger().info('Hello time: ' + str(self.counter_))",
                    "Out(self.get_logger()).text('Hello time: ').value(self.counter_)",
                ),
                fails="run.output",
            ),
            example(
                "text_without_number",
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "'Hello time: '"),
                fails="run.output",
                note="21 of 147 log a constant",
            ),
        ),
    ),
    _node(
        "number_format",
        "text",
        msg("The number is written in a different form"),
        msg(
            "The number has to be written as a plain integer: digits only, without a decimal point, "
            "blanks or leading zeros. str() and an f-string write an integer so."
        ),
        msg(
            "Find what gives the number its form: where it is made, what is added to it, or how the "
            "text is put together. Change that, so that an integer is logged."
        ),
        whys={
            "division": DIVISION,
            "step": FLOAT_STEP,
            "step_and_more": FLOAT_STEP,
            "start": FLOAT_START,
            "start_and_more": FLOAT_START,
            "form": OTHER_FORM,
            "form_and_more": OTHER_FORM,
            "form_and_blank": OTHER_FORM,
            "floats": msg(
                "{form} sets the form in which the number is written, and the number itself has a "
                "decimal point."
            ),
        },
        fixes={
            "origin": INSTEAD,
            "division": INSTEAD,
            "step": msg("Write {written} instead of {name}: the counter counts the lines."),
            "start": ONE_PIECE,
            "form": ONE_PIECE,
            "lines": msg(
                "The log line shows what these lines make or change: {lines}. Change the one that "
                "gives the number its form, or the log line, so that an integer is logged."
            ),
            "step_and_more": MORE_PIECES,
            "start_and_more": MORE_PIECES,
            "form_and_more": MORE_PIECES,
            "form_and_blank": msg(
                "Write {written} instead of {name}. Then the blank before the number is missing: end the "
                "text before it with a blank, {found}."
            ),
            "floats": MORE_PIECES,
        },
        behind={"run.wrong_text": _number_format, "run.wrong_start": _padded},
        fixed_by=(node_log.plain_form, lines.written, node_log.plain_number),
        examples=(
            example(
                "cycles_divided",
                Replace(NODE, "self.counter_ = 0", "self.cycle_ = 0"),
                Replace(NODE, "create_timer(1.0", "create_timer(0.25"),
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    "        self.cycle_ += 1\n"
                    "        if self.cycle_ % 4 == 0:\n"
                    "            number = self.cycle_ / 4 - 1\n"
                    "            self.get_logger().info('Hello time: ' + str(number))\n",
                ),
                fails="run.output",
            ),
            example(
                "float_in_a_constant_of_the_class",
                Replace(NODE, "    def __init__", "    FIRST = 0.0\n\n    def __init__"),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = self.FIRST"),
                fails="run.output",
            ),
            example(
                "width_in_a_helper",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "def cell(value, width=3):\n    return str(value).rjust(width)\n\n\n"
                    "class MyFirstNode",
                ),
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "'Hello time:' + cell(self.counter_)",
                ),
                fails="run.output",
            ),
            example(
                "width_in_a_text_with_a_name",
                Replace(
                    NODE, "class MyFirstNode", "TEXT = 'Hello time: {:>2}'\n\n\nclass MyFirstNode"
                ),
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "TEXT.format(self.counter_)"),
                fails="run.output",
            ),
            example(
                "number_as_float",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0.0"),
                fails="run.output",
            ),
            example(
                "adds_the_period",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.period = 1.0"),
                Replace(NODE, "create_timer(1.0", "create_timer(self.period"),
                Replace(NODE, "self.counter_ += 1", "self.counter_ += self.period"),
                fails="run.output",
                blocks=("run.period",),
            ),
            example(
                "step_of_a_float_every_half_second",
                Replace(NODE, "self.counter_ += 1", "self.counter_ += 1.0"),
                Replace(NODE, "create_timer(1.0", "create_timer(0.5"),
                fails="run.output",
                blocks=("run.period",),
            ),
            example(
                "number_padded",
                Replace(
                    NODE, "'Hello time: ' + str(self.counter_)", "f'Hello time: {self.counter_:02}'"
                ),
                fails="run.output",
                note="Hello time: 00",
            ),
            example(
                "number_filled_with_zeros",
                Replace(NODE, "str(self.counter_)", "str(self.counter_).zfill(3)"),
                fails="run.output",
            ),
            example(
                "number_with_a_point_in_percent",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "'Hello time: %.1f' % self.counter_",
                ),
                fails="run.output",
            ),
        ),
    ),
)
