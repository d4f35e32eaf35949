"""Mistakes in how the number gets into the text: +, f-strings, %, format()."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.counted import counter_in, has_text
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines, node_log, node_words
from grader.mistakes.kind import INSTEAD, Family
from grader.mistakes.made_by import lines_that_make
from grader.mistakes.placeholders import placeholder_values
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.counter import adds_to, starts_of, targets_of
from grader.package.source.names import called_name, dotted
from grader.package.source.place import function_at, place_of, statement_at
from grader.package.source.readable import is_readable
from grader.report.model import Where

MOST_CODE = 80  # characters of a piece of code that a text shows
NUMBER_ALONE = re.compile(r"(?:^|\]: )-?\d{1,20}\s*$", re.MULTILINE)
FORM = re.compile(r"\{([A-Za-z_][\w.]{0,80})(?:![rsa])?(:[^{}]{1,20})\}")
ADDED = (
    r"can only concatenate str \(not \"(?:int|float|bool|complex)\""
    r"|unsupported operand type\(s\) for \+: '(?:int|float)' and 'str'"
)


def _concatenated(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """One + of the line has a text on one side, and no text on the other."""
    number_first = match[0].startswith("unsupported")
    statement = statement_at(raised.module, raised.line)
    if statement is None or any(adds_to(statement, name) for name in targets_of(statement)):
        return None  # (what is added to may be the text)
    sums = [n for n in ast.walk(statement) if isinstance(n, ast.BinOp)]
    sides = [
        (n.left, n.right) if number_first else (n.right, n.left)
        for n in sums
        if isinstance(n.op, ast.Add)
    ]
    found = [n for n, text in sides if (has_text(text) or len(sides) == 1) and _is_one(n, text)]
    operand = min(found, key=lambda n: (n.lineno, n.col_offset), default=None)
    if operand is None:
        return None
    name, number = (raised.module.text.code(n) for n in (operand, _converted(operand)))
    return raised.finding("str_plus_int", name=name, written=f"str({number})")


def _converted(value: ast.expr) -> ast.expr:
    """Return what int() or float() gets; other values as they are."""
    if not isinstance(value, ast.Call) or not value.args:
        return value
    return value.args[0] if called_name(value) in ("int", "float") else value


def _is_one(number: ast.expr, text: ast.expr) -> bool:
    """Whether a side of + can be the number: one behind a text with a value belongs to the value."""
    late = isinstance(number, ast.Constant) and isinstance(text, ast.BinOp | ast.Call)
    return not late and not has_text(number) and not isinstance(number, ast.BinOp)


def _place_of_text(suspect: Suspect) -> Where:
    where = suspect.place
    return where if where is not None and where.line else place_of(suspect.source, None)


def _string_of(suspect: Suspect) -> ast.Constant | None:
    """Return the only string of the files that is the logged text."""
    parts = suspect.source.all_nodes
    found = [n for n in parts if isinstance(n, ast.Constant) and n.value == suspect.text]
    return found[0] if len(found) == 1 else None


def _is_in_f_string(suspect: Suspect, string: ast.Constant) -> bool:
    around = suspect.source.module_of(string).parents.get(string)
    return isinstance(around, ast.JoinedStr)


def _f_prefix(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the string whose braces hold what can be read where it is written."""
    source, string = suspect.source, _string_of(suspect)
    values = re.findall(r"\{([^{}!:=]{1,80})[!:=]?[^{}]{0,20}\}", suspect.text)
    if string is None or not _holds_values(suspect.text) or _is_in_f_string(suspect, string):
        return None
    if re.match(r"[fF]['\"]", suspect.text):
        return None  # (a whole f-string is in the quotes)
    module, around = source.module_of(string), source.function_around(string)
    if not values or not all(is_readable(source, module, around, value) for value in values):
        return None
    code = module.text.code(string)
    found = suspect.finding("f_prefix", string, name=code, written=f"f{code}")
    plain = module.text.plain_string(string) is not None and len(code) <= MOST_CODE
    return replace(found, variant="written" if plain else "")


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


def _is_sure(suspect: Suspect) -> bool:
    """Whether the counter of the texts is a number that the node sets, not only a usual name."""
    counter = str(placeholder_values(suspect.assignment, suspect.source)["counter"])
    source, place = suspect.source, _place_of_text(suspect)
    module = source.module_at(place.file)
    function = function_at(module, place.line)
    known = function is None or is_readable(source, module, function, counter)
    return counter in starts_of(source) and known


def _value_forgotten(suspect: Suspect) -> RecognisedMistake | None:
    """The text shows the place of a value, and has the required form with a number there."""
    match = re.search(r"%[dis]|\{(?:0|(?P<field>[A-Za-z_]\w{0,60}))?\}", suspect.text)
    head, tail = map(re.escape, suspect.output.text.split("{n}"))
    number = suspect.text.replace(match[0], "0", 1) if match is not None else ""
    if match is None or not re.fullmatch(rf"{head}\d+{tail}", number):
        return None
    counter = str(placeholder_values(suspect.assignment, suspect.source)["counter"])
    given = f"{match['field']}={counter}" if match["field"] else counter
    percent = match[0].startswith("%")
    value = f"% {counter}" if percent else f".format({given})"
    place = _place_of_text(suspect)
    found = suspect.finding("value_forgotten", place, name=match[0], written=value)
    call, string = suspect.source.log_call, _string_of(suspect)
    if percent and any(called_name(c) == "format" for c, _ in suspect.source.calls):
        return replace(found, variant="other_format")
    direct = call is not None and call.args[:1] == [string]
    return found if direct and _is_sure(suspect) else replace(found, variant="unknown")


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
    return found if _is_sure(suspect) else replace(found, variant="unknown")


def _constant_text(suspect: Suspect) -> bool:
    """Whether the callback logs the first line of the output as it is."""
    call = suspect.source.log_call
    given = call.args[0] if call is not None else None
    first = suspect.output.line(suspect.output.start)
    return isinstance(given, ast.Constant) and given.value == first


def _always_first(suspect: Suspect) -> RecognisedMistake | None:
    call = suspect.source.log_call
    return suspect.finding("text_without_number", call) if _constant_text(suspect) else None


def _tuple(suspect: Suspect) -> RecognisedMistake | None:
    """The line is a tuple of the text and the number."""
    if not re.fullmatch(r"\((['\"]).*\1, ?-?\d+\)", suspect.text):
        return None
    return suspect.finding("text_is_tuple", _place_of_text(suspect))


def _number_format(suspect: Suspect) -> RecognisedMistake | None:
    """The number has a point, a sign, zeros or blanks: by its first value, its step or its form."""
    head, tail = map(re.escape, suspect.output.text.split("{n}"))
    number = r"[+-]?\d+\.\d+|\+\d+|0\d+|\d(?:\.\d+)?e[+-]?\d+|0[xbo][0-9a-f]+"
    form = _form(suspect)
    if re.fullmatch(rf"{head}(?: +\d+|\d+ +){tail}", suspect.text):
        return form  # (without one, the blanks are of the text)
    if not re.fullmatch(rf"{head} *(?:{number}) *{tail}", suspect.text):
        return None
    found = form or _float_start(suspect) or _float_step(suspect)
    if found is not None:
        return found
    found = suspect.finding("number_format", _place_of_text(suspect))
    made = lines_that_make(suspect.source, suspect.place)
    return replace(found, words={**found.words, "lines": made}, variant="lines") if made else found


def _float_start(suspect: Suspect) -> RecognisedMistake | None:
    """The counter starts with the right number, written with a point."""
    counter, right = counter_in(suspect), suspect.output.start
    start = starts_of(suspect.source, float).get(counter.name) if counter is not None else None
    if start is None or start.value != right:
        return None
    code = suspect.source.module_of(start).text.code(start)
    found = suspect.finding("number_format", start, name=code, written=repr(right))
    return replace(found, variant="start", words={**found.words, "form": code})


def _float_step(suspect: Suspect) -> RecognisedMistake | None:
    """A number with a point is added to the counter, or an attribute that is not set to an integer."""
    counter, known = counter_in(suspect), starts_of(suspect.source)
    point = re.search(r"\d\.\d", suspect.text) is not None
    for node in counter.added if counter is not None and point else ():
        value = node.value.value if isinstance(node.value, ast.Constant) else None
        name = isinstance(node.value, ast.Attribute) and dotted(node.value) not in known
        if counter is not None and (name or isinstance(value, float)):
            code = suspect.source.module_of(node).text.code(node)
            new = f"{counter.name} += {suspect.output.step}"
            found = suspect.finding("number_format", node, name=code, written=new)
            return replace(found, variant="step")
    return None


def _form(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a value of the logged f-string with a form behind a colon."""
    call = suspect.source.log_call
    given = call.args[0] if call is not None else None
    if not isinstance(given, ast.JoinedStr):
        return None
    match = FORM.search(suspect.source.module_of(given).text.code(given))
    if match is None:
        return None
    found = suspect.finding("number_format", given, name=match[0], written=f"{{{match[1]}}}")
    return replace(found, words={**found.words, "form": match[2]}, variant="form")


def _in_text(suspect: Suspect) -> RecognisedMistake | None:
    """The line shows the counter's name: the name is part of the string."""
    string = _string_of(suspect)
    in_f_string = string is not None and _is_in_f_string(suspect, string)
    doubled = re.search(r"\{\s*([A-Za-z_][\w.]{0,80})\s*\}", suspect.text) if in_f_string else None
    if string is not None and doubled is not None:
        found = suspect.finding("counter_in_text", string, name=doubled[1])
        return replace(found, variant="doubled")
    counter = str(placeholder_values(suspect.assignment, suspect.source)["counter"])
    shown = re.search(rf"(?<![\w{{]){re.escape(counter)}(?!\s*[=}}\w])", suspect.text)
    if "." not in counter or shown is None:
        return None
    found = suspect.finding("counter_in_text", _place_of_text(suspect), name=counter)
    return replace(found, variant="bare" if in_f_string else "")


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "str_plus_int",
        "text",
        msg("A string and a number are added"),
        msg("Python's + joins a string only with another string."),
        msg("Write {written} instead of {name}: str() makes a string of a number."),
        links.PYTHON_STRINGS,
        seen=r'TypeError: can only concatenate str \(not "(?P<type>int|float|bool|complex)"\) to str'
        r"|TypeError: unsupported operand type\(s\) for \+: '(?:int|float)' and 'str'",
        raised={ADDED: _concatenated},
        fixed_by=(lines.written,),
        examples=(
            example(
                "int_for_str",
                Replace(NODE, "str(self.counter_)", "int(self.counter_)"),
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
            "doubled": msg("In an f-string, {{{{ is one shown brace: two braces hold no value."),
            "bare": msg(
                "In an f-string, a value is in braces. A name without braces is shown as it is."
            ),
        },
        behind={"run.wrong_text": _in_text},
        fixed_by=(node_log.in_braces, node_log.text),
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
                "round_brackets",
                Replace(
                    NODE, "'Hello time: ' + str(self.counter_)", "f'Hello time: (self.counter_)'"
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
        fixes={"written": msg("Write an f before the first quote: {written}")},
        seen=r"^\[[A-Z]{4,5}\] \[\d{1,12}\.\d{9}\] \[[^\]\n]{1,100}\]: [^\n{]{0,200}\{self\.\w{1,60}\}",
        behind={"run.wrong_text": _f_prefix},
        fixed_by=(node_log.f_prefix, lines.written),
        examples=(
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
        },
        fixes={
            "other_format": msg(
                "Write {{}} instead of {name} in the string, or an f-string: {f_string}"
            ),
            "unknown": msg(
                "Give the place its value where the text is made: % and the value behind a text with "
                "%d, .format() with the value in its () behind a text with {{}}."
            ),
        },
        behind={"run.wrong_text": _value_forgotten},
        fixed_by=(node_words.value,),
        examples=(
            example(
                "percent_without_value",
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "'Hello time: %d'"),
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
        },
        fixes={
            "parts": msg(
                "Find the call that makes the line with the text, and the one that makes the line with the "
                "number. Make one text of both, with + and str(…) or as an f-string, and log it with one call."
            ),
            "unknown": msg(
                "Add the number of the count to the text, as str() of the value that counts the lines."
            ),
        },
        behind={"run.wrong_text": _without_number, "run.constant_counter": _always_first},
        fixed_by=(node_log.number,),
        examples=(
            example(
                "first_line_as_constant",
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "'Hello time: 0'"),
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
            "step": msg("An integer and a number with a decimal point make one with a point."),
            "start": msg(
                "{form} is a number with a decimal point, so each sum with it is one too."
            ),
            "form": msg(
                "{form} sets the form in which the number is written, and the line has to have the "
                "plain integer."
            ),
        },
        fixes={
            "step": msg("Write {written} instead of {name}: the counter counts the lines."),
            "start": INSTEAD,
            "form": INSTEAD,
            "lines": msg(
                "The log line shows what these lines make or change: {lines}. Change the one that "
                "gives the number its form, or the log line, so that an integer is logged."
            ),
        },
        behind={"run.wrong_text": _number_format},
        fixed_by=(lines.written,),
        examples=(
            example(
                "number_as_float",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0.0"),
                fails="run.output",
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
        ),
    ),
)
