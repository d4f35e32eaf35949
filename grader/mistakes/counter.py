"""Mistakes in the counter and in the text that shows it."""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass, replace

from grader.base.i18n.message import Value, joined, msg, say
from grader.mistakes import links
from grader.mistakes.example import DEAD, LOG_LINE, NODE, STEP_LINE, example
from grader.mistakes.fixes import lines, node_count, node_log, node_words, node_worked_out
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.placeholders import placeholder_values
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.mistakes.worked_out import INSTEAD, first_of, worked_out
from grader.package.edit.files import Files
from grader.package.edit.text import SourceText
from grader.package.edit.tree import Replace
from grader.package.source.counter import (
    logged_counter,
    outer_word,
    parts_of_callback,
    starts_of,
    targets_of,
)
from grader.package.source.module import Function
from grader.package.source.names import called_name, dotted, last_part
from grader.package.source.number_forms import number_forms
from grader.package.source.place import function_at, place_of, statement_at
from grader.report.model import Where

SUM = ast.Add | ast.Sub
MOST_CODE = 80  # characters of a piece of code that a text shows
COUNTER = msg(
    "An attribute (self.…) keeps its value from one callback to the next; a name without self. is "
    "gone when the function ends."
)


FLOAT_STEP = msg("An integer and a number with a decimal point make one with a point.")
FLOAT_START = msg("{form} is a number with a decimal point, so each sum with it is one too.")
OTHER_FORM = msg(
    "{form} sets the form in which the number is written. Without it, Python writes the plain "
    "integer."
)
MODULO = msg(
    "% {form} gives the rest of a division by {form}: after the numbers below {form} comes 0 again."
)
ONE_PIECE = INSTEAD
MORE_PIECES = msg("Write {written} instead of {name}. Write also: {others}.")


@dataclass(frozen=True)
class Counter:
    """The counter of a callback: its name, and the statements that change it."""

    name: str
    added: list[ast.AugAssign]
    set: list[ast.Assign | ast.AnnAssign]
    logged: ast.Call  # the first log call


def counter_in(suspect: Suspect) -> Counter | None:
    """Return the counter that the callback logs; None if it logs none."""
    callback, logged = suspect.source.callback, logged_counter(suspect.source)
    if callback is None or logged is None:
        return None
    call, name = logged
    parts = parts_of_callback(suspect.source)
    found = [n for part in parts for n in ast.walk(part) if name in targets_of(n)]
    added = [n for n in found if isinstance(n, ast.AugAssign)]
    return Counter(
        name,
        sorted(added, key=lambda n: n.lineno),
        [n for n in found if isinstance(n, ast.Assign | ast.AnnAssign)],
        call,
    )


LOG_AND_STEP = f"{LOG_LINE}{STEP_LINE}"
UNBOUND = r"UnboundLocalError: .{0,60}'(?P<name>\w{1,120})'"


def _local(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A function adds to a name that it does not set: an attribute is meant."""
    name, function = match["name"], _function(raised)
    if function is None or not _adds(function, name) or _word(raised, function, name):
        return None
    found = raised.finding("counter_local", name=name)
    step = raised.assignment.output.step
    words = {**found.words, "function": function.name, "step": step}
    return replace(found, words=words, variant=_form_of_local(raised, function, name))


def _form_of_local(raised: Raised, function: Function, name: str) -> str:
    """Return the variant for a counter without self: what the function has, and what is set."""
    around = raised.module.parents.get(function)
    if not isinstance(around, ast.ClassDef):
        if not isinstance(around, ast.Module):
            return ""
        return "apart" if name in raised.source.attributes else "outside"
    arguments = function.args.args
    if not arguments or arguments[0].arg != "self":
        return ""
    attribute = f"self.{name}"
    own = any(name in targets_of(statement) for statement in around.body)
    if own or any(_sets(n, attribute) for n in ast.walk(around)):
        return "set"
    return "" if function is raised.source.callback else "method"


def _sets(node: ast.AST, name: str) -> bool:
    return isinstance(node, ast.Assign | ast.AnnAssign) and name in targets_of(node)


def _global(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A function adds to a name that it does not set: a variable of outside is meant."""
    name, function = match["name"], _function(raised)
    word = _word(raised, function, name) if function is not None else ""
    if function is None or not word or not _adds(function, name):
        return None
    return raised.finding("counter_global", name=name, word=word)


def _function(raised: Raised) -> Function | None:
    return function_at(raised.module, raised.line) or raised.source.callback


def _word(raised: Raised, function: Function, name: str) -> str:
    source = raised.source
    return outer_word(source, function, name) if name not in source.attributes else ""


def _adds(function: Function, name: str) -> bool:
    """Whether a function changes a variable that it never sets to something new."""
    changed = [n for n in ast.walk(function) if name in targets_of(n)]
    return bool(changed) and all(
        isinstance(n, ast.AugAssign) or (isinstance(n, ast.Assign) and _reads(n.value, name))
        for n in changed
    )


def _reads(value: ast.expr, name: str) -> bool:
    return any(isinstance(n, ast.Name) and n.id == name for n in ast.walk(value))


def _concatenated(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    statement = statement_at(raised.module, raised.line)
    if isinstance(statement, ast.Assign) and _adds_text(statement):
        return None
    for node in raised.module.nodes:
        if not isinstance(node, ast.BinOp) or not isinstance(node.op, ast.Add):
            continue
        if raised.line not in range(node.lineno, (node.end_lineno or node.lineno) + 1):
            continue
        if (sum_of := _number_added_last(node, raised.module.text)) is not None:
            name, written, variant = sum_of
            found = raised.finding("str_plus_int", name=name, written=written)
            return replace(found, variant=variant)
        operand = next((part for part in (node.right, node.left) if _may_be_number(part)), None)
        if operand is not None:
            text = raised.module.text
            number = operand
            if isinstance(operand, ast.Call) and len(operand.args) == 1:
                number = operand.args[0] if dotted(operand.func) in ("int", "float") else operand
            written = f"str({text.code(number)})"
            return raised.finding("str_plus_int", name=text.code(operand), written=written)
    counter = str(raised.words["counter"])
    return raised.finding("str_plus_int", name=counter, written=f"str({counter})")


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


def _adds_text(statement: ast.Assign) -> str:
    """Return what is added in `x = x + '1'`; "" if the statement has another form."""
    value = statement.value
    if not isinstance(value, ast.BinOp) or dotted(value.left) not in targets_of(statement):
        return ""
    step = value.right.value if isinstance(value.right, ast.Constant) else None
    return step if isinstance(step, str) else ""


def _may_be_number(part: ast.expr) -> bool:
    """Whether an operand of + is not a text for certain, nor itself a sum."""
    text = isinstance(part, ast.JoinedStr | ast.BinOp)
    text = text or (isinstance(part, ast.Constant) and isinstance(part.value, str))
    return not text and not (isinstance(part, ast.Call) and dotted(part.func) == "str")


def _step_is_text(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    for node in raised.source.all_nodes:
        if isinstance(node, ast.AugAssign) and isinstance(node.value, ast.Constant):
            step, name = node.value.value, dotted(node.target)
            if isinstance(step, str) and name:
                return raised.finding("step_is_text", at=node, name=name, step=step)
        if isinstance(node, ast.Assign) and (added := _adds_text(node)):
            name = next(targets_of(node))
            return raised.finding("step_is_text", at=node, name=name, step=added)
    return None


def _place_of_text(suspect: Suspect) -> Where:
    where = suspect.place
    return where if where is not None and where.line else place_of(suspect.source, None)


def _f_prefix(suspect: Suspect) -> RecognisedMistake | None:
    string = _string_of(suspect)
    if string is not None and _holds_values(suspect.text):
        code = suspect.source.module_of(string).text.code(string)
        if code[:1] in ("'", '"'):
            found = suspect.finding("f_prefix", string, name=code, written=f"f{code}")
            return replace(found, variant="written" if len(code) <= MOST_CODE else "")
    if not re.search(r"\{[A-Za-z_][\w.]{0,80}\}", suspect.text):
        return None
    return suspect.finding("f_prefix", string or _place_of_text(suspect))


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
    for nodes in (of_callback, suspect.source.own_nodes):
        found = [n for n in nodes if isinstance(n, ast.Constant) and n.value == suspect.text]
        if found:
            return found[0] if len(found) == 1 else None
    return None


def _value_forgotten(suspect: Suspect) -> RecognisedMistake | None:
    match = re.search(r"%[dis]|\{0?\}", suspect.text)
    if match is None:
        return None
    by = "% {counter}" if match[0].startswith("%") else ".format({counter})"
    counter = placeholder_values(suspect.assignment, suspect.source)["counter"]
    written = by.format(counter=counter)
    other = _other_format(suspect, match[0])
    place = other if other is not None else _place_of_text(suspect)
    found = suspect.finding("value_forgotten", place, name=match[0], written=written)
    return replace(found, variant="other_format" if other is not None else "")


def _other_format(suspect: Suspect, sign: str) -> ast.Call | None:
    """Return the call of .format() on a text with %, which .format() leaves as it is."""
    if not sign.startswith("%"):
        return None
    for node in suspect.source.own_nodes:
        called = node.func if isinstance(node, ast.Call) else None
        text = called.value if isinstance(called, ast.Attribute) else None
        given = text.value if isinstance(text, ast.Constant) else None
        if isinstance(node, ast.Call) and called_name(node) == "format" and given == suspect.text:
            return node
    return None


def _no_value(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The call of format on the line has fewer values than its text has places."""
    del match
    statement = statement_at(raised.module, raised.line)
    for call in ast.walk(statement) if statement is not None else ():
        if isinstance(call, ast.Call) and called_name(call) == "format" and not call.args:
            written = f".format({raised.words['counter']})"
            return raised.finding("value_forgotten", at=call, name="{}", written=written)
    return None


def _without_number(suspect: Suspect) -> RecognisedMistake | None:
    without = suspect.output.text.replace("{n}", "").split()
    if suspect.text.split() != without and not _constant_text(suspect):
        return None
    return suspect.finding("text_without_number", _place_of_text(suspect))


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
        return _other_form(suspect)
    if not re.fullmatch(rf"{head} *(?:{number}) *{tail}", suspect.text):
        return None
    found = _other_form(suspect)
    counter = counter_in(suspect) if found is None else None
    for node in counter.added if counter is not None else ():
        if counter is not None and not _is_integer(suspect, node.value):
            new = f"{counter.name} += {suspect.output.step}"
            code = suspect.source.module_of(node).text.code(node)
            step = suspect.finding("number_format", node, name=code, written=new)
            return replace(step, variant="step")
    return found or suspect.finding("number_format", _place_of_text(suspect))


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
    values = (
        getattr(node, "value", None)
        for node in suspect.source.own_nodes
        if isinstance(node, ast.Assign | ast.AnnAssign) and name in targets_of(node)
    )
    return any(isinstance(v, ast.Constant) and isinstance(v.value, float) for v in values)


def _plus_reversed(suspect: Suspect) -> RecognisedMistake | None:
    counter = counter_in(suspect)
    for node in counter.set if counter is not None else ():
        if isinstance(node.value, ast.UnaryOp) and isinstance(node.value.op, ast.UAdd):
            return suspect.finding("plus_reversed", node, name=counter.name if counter else "")
    return None


def _reset(suspect: Suspect) -> RecognisedMistake | None:
    counter = counter_in(suspect)
    if counter is None:
        return None
    for node in counter.set:
        if isinstance(node.value, ast.Constant):
            value = str(node.value.value)[:40]
            found = suspect.finding("counter_reset", node, name=counter.name, value=value)
            if "." not in counter.name:
                return replace(found, variant="local")
            around = suspect.source.function_around(node)
            if around is None or around is suspect.source.callback:
                return found
            words = {**found.words, "function": around.name}
            return replace(found, variant="helper", words=words)
    return None


def _reset_if(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a condition of the callback under which the counter starts again."""
    counter = counter_in(suspect)
    for node in counter.set if counter is not None else ():
        around = suspect.source.module_of(node).parents.get(node)
        if counter is None or not isinstance(around, ast.If) or around.orelse:
            continue
        if isinstance(node.value, ast.Constant):
            found = suspect.finding("counter_reset", node, name=counter.name)
            return replace(found, variant="if")
    return None


def _modulo(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a rest of a division, after which the counter starts again."""
    found = worked_out("counter_reset", "modulo", variant="modulo")(suspect)
    deleted = found is not None and not found.params["written"]
    return replace(found, variant="modulo_line") if found is not None and deleted else found


def _in_text(suspect: Suspect) -> RecognisedMistake | None:
    """The line shows the counter's name: the name is part of the string."""
    counter = str(placeholder_values(suspect.assignment, suspect.source)["counter"])
    if "." not in counter or counter not in suspect.text:
        return None
    place = _place_of_text(suspect)
    row = suspect.source.module_at(place.file).line(place.line)
    if f"{{{counter}}}" in suspect.text and f"{{{{{counter}}}}}" not in row:
        return None
    found = suspect.finding("counter_in_text", place, name=counter)
    doubled = f"{{{{{counter}}}}}" in row
    return replace(
        found, variant="doubled" if doubled else "round" if "f'" in row or 'f"' in row else ""
    )


def _copy_increased(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a local copy of an attribute that the callback increases."""
    parts = parts_of_callback(suspect.source)
    copies: dict[str, str] = {}
    for node in (node for part in parts for node in ast.walk(part)):
        target = node.targets[0] if isinstance(node, ast.Assign) else None
        value = dotted(node.value) if isinstance(node, ast.Assign) else ""
        if isinstance(target, ast.Name) and value.startswith("self."):
            copies[target.id] = value
        if isinstance(node, ast.AugAssign) and dotted(node.target) in copies:
            module, name = suspect.source.module_of(node), copies[dotted(node.target)]
            code = module.text.code(node)
            new = code.replace(dotted(node.target), name, 1)
            params = {"name": code, "written": new, "attribute": name}
            return suspect.finding("copy_increased", node, **params)
    return None


def _not_increased(suspect: Suspect) -> RecognisedMistake | None:
    counter = counter_in(suspect)
    if counter is None or counter.added or counter.set or not _is_number(suspect, counter.name):
        return None
    for node in suspect.source.own_nodes:
        changed = isinstance(node, ast.AugAssign) and dotted(node.target)
        if changed and last_part(changed) == last_part(counter.name):
            return None  # (it is increased elsewhere)
    return suspect.finding("counter_not_increased", counter.logged, name=counter.name)


def _is_number(suspect: Suspect, name: str) -> bool:
    """Whether an attribute may be a number: no text is assigned to it."""
    for node in suspect.source.own_nodes:
        if isinstance(node, ast.Assign) and name in targets_of(node):
            value = node.value
            text = isinstance(value, ast.Constant) and isinstance(value.value, str)
            if text or isinstance(value, ast.JoinedStr | ast.BinOp):
                return False
    return True


def _multiplied(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a product: a counter that starts at 0 stays there."""
    counter = counter_in(suspect)
    for node in counter.added if counter is not None else ():
        if isinstance(node.op, ast.Mult) and counter is not None:
            return suspect.finding("counter_multiplied", node, name=counter.name)
    return None


def _added_instead(case: Case) -> Files | None:
    """Write += and the required step instead of the product."""
    node = case.node
    found = [n for n in node.all_nodes if isinstance(n, ast.AugAssign)] if node else []
    if node is None or len(found) != 1 or not isinstance(found[0].op, ast.Mult):
        return None
    module = node.module_of(found[0])
    code = f"{module.text.code(found[0].target)} += {case.assignment.output.step}"
    return case.changed(module, module.text.swap(found[0], code))


def _adds_twice(suspect: Suspect) -> RecognisedMistake | None:
    counter, step = counter_in(suspect), suspect.output.step
    added = [n for n in counter.added if isinstance(n.op, SUM)] if counter is not None else []
    if counter is None or len(added) < 2:
        return None
    return suspect.finding("adds_twice", added[1], name=counter.name, step=step)


_added_elsewhere = worked_out("adds_twice", "doubled", variant="line")
_step_worked_out = worked_out("other_step", "step", variant="written")


def _other_step(suspect: Suspect) -> RecognisedMistake | None:
    counter, step = counter_in(suspect), suspect.output.step
    for node in counter.added if counter is not None else ():
        if not isinstance(node.op, SUM):
            continue
        added = isinstance(node.op, ast.Add) and isinstance(node.value, ast.Constant)
        if not added or getattr(node.value, "value", 1) != step:
            name = counter.name if counter else ""
            return suspect.finding("other_step", node, name=name, step=step)
    return None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "counter_local",
        "counter",
        msg("The counter is used without self."),
        COUNTER,
        msg("Write self.{name} in the callback and in __init__."),
        links.PYTHON_CLASSES,
        fixes={
            "set": msg("Write self.{name} instead of {name} in {function}."),
            "method": msg(
                "Write self.{name} instead of {name} in {function}, and self.{name} = 0 in "
                "__init__ of the same class."
            ),
            "apart": msg(
                "{function} is outside of the class and has no self. Write self.{name} += {step} "
                "in {callback} instead of the call of {function}."
            ),
            "outside": msg(
                "Write {name} = 0 below the imports of the file, and global {name} as the first "
                "line of {function}."
            ),
        },
        seen=r"UnboundLocalError: .{0,60}'(?P<name>(?!\w{0,60}node)\w{1,120})'",
        raised={UNBOUND: _local},
        fixed_by=(node_count.self_dot,),
        examples=(
            example(
                "counter_local",
                Replace(
                    NODE,
                    "self.get_logger().info('Hello time: ' + str(self.counter_))",
                    "self.get_logger().info('Hello time: ' + str(counter_))",
                ),
                Replace(NODE, "self.counter_ += 1", "counter_ += 1"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "counter_global",
        "counter",
        msg("The function changes an outer variable without declaring it"),
        msg(
            "A name that a function assigns to is a variable of that function, unless the "
            "function declares it."
        ),
        msg("Write {word} {name} as the first line of the function."),
        links.PYTHON_CLASSES,
        raised={UNBOUND: _global},
        fixed_by=(node_count.outer,),
        examples=(
            example(
                "counter_not_declared",
                Replace(NODE, "class MyFirstNode", "counter = 0\n\n\nclass MyFirstNode"),
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(NODE, "str(self.counter_)", "str(counter)"),
                Replace(NODE, "self.counter_ += 1", "counter += 1"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "str_plus_int",
        "text",
        msg("A string and a number are added"),
        msg("Python's + joins a string only with another string."),
        msg("Write {written} instead of {name}: str() makes a string of a number."),
        links.PYTHON_STRINGS,
        whys={"late": msg("Python makes the string first, and then adds a number to it.")},
        fixes={
            "late": msg("Write {written} instead of {name}, so that the numbers are added first.")
        },
        seen=r'TypeError: can only concatenate str \(not "(?P<type>\w{1,40})"\) to str'
        r"|TypeError: unsupported operand type\(s\) for \+: '(?:int|float)' and 'str'",
        raised={
            r"can only concatenate str|unsupported operand type\(s\) for \+: '(?:int|float)' and 'str'": _concatenated
        },
        fixed_by=(node_log.number_as_text, lines.written),
        examples=(
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
        "step_is_text",
        "counter",
        msg("A string is added to the counter"),
        msg("A number in quotes is a string, and Python cannot add a string to a number."),
        msg("Write {name} += {step}, without quotes."),
        links.PYTHON_CLASSES,
        seen=r"TypeError: unsupported operand type\(s\) for \+=: '(?:int|float)' and 'str'",
        raised={
            r"unsupported operand type\(s\) for \+=?: '(?:int|float)' and 'str'": _step_is_text
        },
        fixed_by=(node_count.number_step,),
        examples=(
            example(
                "step_is_text_in_sum",
                Replace(NODE, "self.counter_ += 1", "self.counter_ = self.counter_ + '1'"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "step_is_text",
                Replace(NODE, "self.counter_ += 1", "self.counter_ += '1'"),
                fails="run.output",
                blocks=("run.interrupt",),
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
            "round": msg(
                "In an f-string, a value is in braces. Round brackets and what is in them are "
                "shown as they are."
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
        msg("The text shows the place of a value instead of the value"),
        msg("Python replaces {name} in a string only if a value follows the string."),
        msg("Write {written} after the string, or use an f-string: {f_string}"),
        links.PYTHON_STRINGS,
        whys={
            "other_format": msg(
                ".format() puts its values in the place of {{}}, and leaves {name}."
            )
        },
        fixes={
            "other_format": msg(
                "Write {{}} instead of {name} in the string, or an f-string: {f_string}"
            )
        },
        raised={r"Replacement index \d{1,9} out of range": _no_value},
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
            "The counter is an integer, and str() writes it without a decimal point and leading "
            "zeros."
        ),
        msg("Begin with {counter} = {start} (not {start}.0), and log str({counter})."),
        whys={
            "step": FLOAT_STEP,
            "step_and_more": FLOAT_STEP,
            "start": FLOAT_START,
            "start_and_more": FLOAT_START,
            "form": OTHER_FORM,
            "form_and_more": OTHER_FORM,
            "floats": msg(
                "{form} sets the form in which the number is written, and the number itself has a "
                "decimal point."
            ),
        },
        fixes={
            "step": msg("Write {written} instead of {name}: the counter counts the lines."),
            "start": ONE_PIECE,
            "form": ONE_PIECE,
            "step_and_more": MORE_PIECES,
            "start_and_more": MORE_PIECES,
            "form_and_more": MORE_PIECES,
            "floats": MORE_PIECES,
        },
        behind={"run.wrong_text": _number_format, "run.wrong_start": _padded},
        fixed_by=(node_log.plain_form, lines.written, node_log.plain_number),
        examples=(
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
    _node(
        "plus_reversed",
        "counter",
        msg("=+ is written instead of +="),
        msg("x =+ 1 sets x to +1; x += 1 adds one to it."),
        msg("Write {name} += {step}"),
        links.PYTHON_CLASSES,
        behind={"run.constant_counter": _plus_reversed, "run.wrong_step": _plus_reversed},
        fixed_by=(node_count.plus,),
        examples=(
            example(
                "counter_plus_is_plus",
                Replace(NODE, "self.counter_ += 1", "self.counter_ =+ 1"),
                fails="run.output",
                note="0, 1, 1, 1: =+ for +=",
            ),
        ),
    ),
    _node(
        "counter_reset",
        "counter",
        msg("The callback resets the counter"),
        msg(
            "A value that the callback sets is set again in each call. The first value belongs "
            "in __init__."
        ),
        msg("Move {name} = {value} to __init__."),
        whys={
            "local": msg(
                "{name} is a variable of the callback: each call creates it again, with the value "
                "{value}. Only an attribute (self.…) keeps its value from one call to the next."
            ),
            "if": msg("Each time the condition above this line is true, {name} starts again."),
            "helper": msg(
                "{callback} calls {function}, and each call sets {name} to {value} again."
            ),
            "modulo": MODULO,
            "modulo_line": MODULO,
        },
        fixes={
            "local": msg(
                "Write self.{name} = {value} in __init__ instead of this line, and self.{name} "
                "in the callback."
            ),
            "if": msg("Remove this line and its if: the counter never starts again."),
            "helper": msg(
                "Set {name} only once: __init__ may do it, or call {function}, but {callback} must "
                "not. Delete the call of {function} from {callback}, or the line that sets {name} "
                "if {function} has other work to do for {callback}."
            ),
            "modulo": INSTEAD,
            "modulo_line": msg("Delete this line: the counter never starts again."),
        },
        behind={"run.constant_counter": _reset, "run.wrong_step": first_of(_reset_if, _modulo)},
        fixed_by=(node_worked_out.change("modulo"), node_count.kept, node_count.moved),
        examples=(
            example(
                "counter_reset",
                Replace(
                    NODE,
                    "self.get_logger().info('Hello time: ' + str(self.counter_))",
                    (
                        "self.counter_ = 0\n"
                        "        self.get_logger().info('Hello time: ' + str(self.counter_))"
                    ),
                ),
                fails="run.output",
            ),
            example(
                "counter_reset_with_type",
                Replace(NODE, LOG_LINE, f"        self.counter_: int = 0\n{LOG_LINE}"),
                fails="run.output",
            ),
            example(
                "counter_starts_again",
                Replace(
                    NODE,
                    "self.counter_ += 1",
                    "self.counter_ += 1\n"
                    "        if self.counter_ == 5:\n"
                    "            self.counter_ = 0",
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "copy_increased",
        "counter",
        msg("A copy of the counter is increased"),
        msg(
            "A variable that gets the value of {attribute} is a copy: adding to it does not change "
            "{attribute}."
        ),
        msg("Write {written} instead of {name}."),
        behind={"run.constant_counter": _copy_increased},
        fixed_by=(lines.written,),
        examples=(
            example(
                "copy_increased",
                Replace(NODE, LOG_LINE, f"        count = self.counter_\n{LOG_LINE}"),
                Replace(NODE, "str(self.counter_)", "str(count)"),
                Replace(NODE, "self.counter_ += 1", "count += 1"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "counter_not_increased",
        "counter",
        msg("Nothing is added to the counter"),
        msg("The callback logs the counter; without += every line shows the same number."),
        msg("Add to the callback, after the log line: {name} += {step}"),
        behind={"run.constant_counter": _not_increased},
        fixed_by=(node_count.step,),
        examples=(
            example(
                "counter_constant",
                Replace(NODE, "        self.counter_ += 1\n", ""),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "counter_multiplied",
        "counter",
        msg("The counter is multiplied"),
        msg("x *= 2 doubles x. A counter that starts at 0 stays at 0."),
        msg("Write {name} += {step}"),
        behind={"run.constant_counter": _multiplied},
        fixed_by=(_added_instead,),
        examples=(
            example(
                "counter_doubled",
                Replace(NODE, "self.counter_ += 1", "self.counter_ *= 2"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "adds_twice",
        "counter",
        msg("The counter is increased more than once in the callback"),
        msg("Each += counts."),
        msg("Keep only one {name} += {step}."),
        fixes={
            "line": msg("Delete line {line} ({name}): another line adds to the counter already.")
        },
        behind={
            "run.wrong_step": first_of(_adds_twice, _added_elsewhere),
            "run.wrong_start": _added_elsewhere,
        },
        fixed_by=(node_count.twice, node_worked_out.change("doubled")),
        examples=(
            example(
                "adds_in_helper_too",
                Replace(NODE, LOG_AND_STEP, "        self.show()\n        self.counter_ += 1\n"),
                Replace(
                    NODE, "\n\ndef main(", f"\n    def show(self):\n{LOG_AND_STEP}\n\ndef main("
                ),
                fails="run.output",
            ),
            example(
                "adds_twice",
                Replace(
                    NODE, "self.counter_ += 1", "self.counter_ += 1\n        self.counter_ += 1"
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "other_step",
        "counter",
        msg("A different number is added to the counter"),
        msg("The number after += is what each line increases by."),
        msg("Write {name} += {step}"),
        fixes={"written": INSTEAD},
        behind={
            "run.wrong_step": first_of(_other_step, _step_worked_out),
            "run.constant_counter": _step_worked_out,
        },
        fixed_by=(node_count.by, node_worked_out.change("step")),
        examples=(
            example(
                "counts_by_two",
                Replace(NODE, "self.counter_ += 1", "self.counter_ += 2"),
                fails="run.output",
            ),
            example(
                "counts_down",
                Replace(NODE, "self.counter_ += 1", "self.counter_ -= 1"),
                fails="run.output",
            ),
        ),
    ),
)
