"""Mistakes in the methods of a text that put a value into it: an f too many, join() for +."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.made_by import statements_that_make
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.counter import parts_of_callback, targets_of
from grader.package.source.names import called_name, dotted, last_part
from grader.package.source.place import statement_at
from grader.report.model import Where

MOST_CODE = 80  # characters of a piece of code that a text shows
INSTEAD = msg("Write {written} instead of {name}.")


def _f_and_format(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for an f-string on the line that gets its value from .format()."""
    statement = statement_at(raised.module, raised.line)
    for call in ast.walk(statement) if statement is not None else ():
        if not isinstance(call, ast.Call) or not isinstance(call.func, ast.Attribute):
            continue
        given = {keyword.arg for keyword in call.keywords}
        if call.func.attr == "format" and match["name"] in given:
            text = raised.module.text.code(call.func.value)
            if isinstance(call.func.value, ast.JoinedStr) and text[:1] in "fF":
                return _written(raised, call.func.value, text, text[1:])
    return None


def _written(raised: Raised, at: ast.expr, name: str, written: str) -> RecognisedMistake | None:
    if "\n" in name or len(name) > MOST_CODE:
        return None
    return raised.finding("f_and_format", at=at, name=name, written=written)


def _joined(suspect: Suspect) -> RecognisedMistake | None:
    """Look for `'text'.join(value)` in the text that is logged; with '' it changes nothing."""
    source = suspect.source
    logs = [call for part in parts_of_callback(source) for call in source.logs(part)]
    made = {n for s in (*statements_that_make(source, suspect.place), *logs) for n in ast.walk(s)}
    found = [
        call
        for call, _ in source.calls
        if call in made
        and isinstance(call.func, ast.Attribute)
        and call.func.attr == "join"
        and isinstance(call.func.value, ast.Constant)
        and call.func.value.value
        and len(call.args) == 1
        and isinstance(call.args[0], ast.Call | ast.JoinedStr)
        and (isinstance(call.args[0], ast.JoinedStr) or called_name(call.args[0]) == "str")
    ]
    if len(found) != 1:
        return None
    text = suspect.source.module_of(found[0]).text
    code, func = text.code(found[0]), found[0].func
    if "\n" in code or len(code) > MOST_CODE or not isinstance(func, ast.Attribute):
        return None
    written = f"{text.code(func.value)} + {text.code(found[0].args[0])}"
    return suspect.finding("text_joined", found[0], name=code, written=written)


def _made_text(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A number is added to an attribute that another line turns into a text."""
    del match
    statement = statement_at(raised.module, raised.line)
    if not isinstance(statement, ast.AugAssign) or not isinstance(statement.op, ast.Add):
        return None
    name = dotted(statement.target)
    made = [
        node
        for node in raised.source.own_nodes
        if isinstance(node, ast.Assign) and name in targets_of(node) and _is_text(node.value)
    ]
    around = raised.source.function_around(made[0]) if len(made) == 1 else None
    if not name or around is None or around.name == "__init__":
        return None
    module = raised.source.module_of(made[0])
    found = raised.finding("counter_made_text", at=made[0], name=name)
    words = {**found.words, "written": module.text.code(made[0].value)}
    place = Where(file=module.path, line=made[0].lineno)
    return replace(found, words=words, where=place)


def _digits_joined(suspect: Suspect) -> RecognisedMistake | None:
    """After a right line, the number has the added one behind it: + joined two texts."""
    first, step = suspect.output.line(0), str(suspect.output.step)
    came = suspect.lines or tuple(suspect.transcript.splitlines())
    if suspect.text != first + step or not any(line.endswith(first) for line in came):
        return None
    sums = [
        n
        for n in statements_that_make(suspect.source, suspect.place)
        if isinstance(n, ast.AugAssign) and isinstance(n.op, ast.Add)
    ]
    if len(sums) != 1:
        return None
    code = suspect.source.module_of(sums[0]).text.code
    names = {"name": code(sums[0].target), "value": code(sums[0].value)}
    if any("\n" in name or len(name) > MOST_CODE for name in names.values()):
        return None
    return suspect.finding("digits_joined", sums[0], **names)


def _is_text(value: ast.expr) -> bool:
    if isinstance(value, ast.Call):
        return dotted(value.func) == "str" or last_part(called_name(value)) == "format"
    return isinstance(value, ast.JoinedStr)


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "f_and_format",
        "text",
        msg("A text has an f before it, and .format() behind it"),
        msg(
            "The f puts values into the text at once, and knows only variables. The names that "
            ".format() gets are not variables."
        ),
        INSTEAD,
        raised={NAME_ERROR: _f_and_format},
        fixed_by=(lines.written,),
        examples=(
            example(
                "f_string_with_format",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "f'Hello time: {count}'.format(count=self.counter_)",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "text_joined",
        "text",
        msg("join() is used to append a value to a text"),
        msg(
            "'text'.join(items) puts the text between the items. The items of one text are its "
            "characters, so a number of one digit is shown alone."
        ),
        INSTEAD,
        behind={"run.wrong_text": _joined},
        fixed_by=(lines.written,),
        examples=(
            example(
                "joined_with_the_number",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "'Hello time: '.join(str(self.counter_))",
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "digits_joined",
        "counter",
        msg("The counter is a text, and + joins texts"),
        msg(
            "+ adds two numbers, and joins two texts: '0' + '1' is '01'. On this line {name} and {value} "
            "are texts."
        ),
        msg(
            "Find the lines that give {name} its first value, and {value} its value. Make a number of each "
            "there with int(…), or write it without quotes if it is a number in the code itself. In the line "
            "that is logged, write str(…) around the number if + joins it to a text."
        ),
        behind={"run.wrong_text": _digits_joined},
        examples=(
            example(
                "counter_and_step_are_texts",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "first, self.step_ = '0 1'.split()\n        self.counter_ = first",
                ),
                Replace(NODE, "str(self.counter_)", "self.counter_"),
                Replace(NODE, "self.counter_ += 1", "self.counter_ += self.step_"),
                fails="run.output",
                blocks=("run.period",),
            ),
        ),
    ),
    _node(
        "counter_made_text",
        "counter",
        msg("The counter is turned into a text"),
        msg("This line makes {name} a text, and a number cannot be added to a text."),
        msg(
            "Remove this line, so that {name} stays a number. Write {written} only in the text that "
            "is logged."
        ),
        raised={r"can only concatenate str \(not \"int\"\) to str": _made_text},
        examples=(
            example(
                "counter_turned_into_a_text",
                Replace(
                    NODE,
                    "        self.get_logger().info('Hello time: ' + str(self.counter_))",
                    "        self.counter_ = str(self.counter_)\n"
                    "        self.get_logger().info('Hello time: ' + self.counter_)",
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
)
