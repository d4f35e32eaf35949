"""Mistakes in which a function returns nothing, and its value is logged or counted with."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, LOG, NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect, on_line
from grader.mistakes.worked_out import INSTEAD
from grader.package.edit.files import Files
from grader.package.edit.text import indent_of
from grader.package.edit.tree import Replace, Write
from grader.package.source.counter import parts_of_callback
from grader.package.source.no_return import NoReturn, no_return
from grader.package.source.node import NodeSource
from grader.package.source.place import function_at

MOST_CODE = 80  # characters of a piece of code that a text shows


NO_TEXT = "(null)"  # what the logger writes for None


def _logged_none(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a function without a value, where the line shows None."""
    shows = re.search(r"\bNone\b", suspect.text) or suspect.text == NO_TEXT
    if not shows or "None" in suspect.output.text:
        return None
    found = _found(suspect.source)
    if found is None:
        return None
    mistake = suspect.finding("nothing_returned", found.at, name=found.name, written=found.written)
    return _in_words(mistake, found, suspect.source)


def _printed_for_logger(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a function that prints the text, where the logger gets what it returns."""
    found = _found(suspect.source)
    if found is None or not found.printed or found.sort != "instead":
        return None
    if not any(found.used in ast.walk(call) for call in suspect.source.own_logs):
        return None
    mistake = suspect.finding("nothing_returned", found.at, name=found.name, written=found.written)
    return _in_words(mistake, found, suspect.source)


def _none_at_error(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The same, where something is added to the None that came back."""
    del match
    found, function = _found(raised.source), function_at(raised.module, raised.line)
    if found is None or function is None:
        return None
    mistake = raised.finding(
        "nothing_returned", at=found.at, name=found.name, written=found.written
    )
    return _in_words(mistake, found, raised.source)


def _found(source: NodeSource) -> NoReturn | None:
    found = no_return(source, parts_of_callback(source))
    return found if found is None or len(found.name + found.written) <= 2 * MOST_CODE else None


def _in_words(mistake: RecognisedMistake, found: NoReturn, source: NodeSource) -> RecognisedMistake:
    other = source.module_of(found.used)
    place = "" if other is found.module else f" ({other.path})"
    words = {
        **mistake.words,
        "function": found.function,
        "line": f"{found.used.lineno}{place}",
        "at": str(found.at.lineno),
    }
    printed = found.printed and found.sort == "instead"
    return replace(mistake, words=words, variant="printed" if printed else found.sort)


def _returned(case: Case) -> Files | None:
    """Write the return below the last line, or in place of what is there."""
    found = _found(case.node) if case.node is not None else None
    if found is None or case.module is not found.module or not found.written:
        return None
    text = found.module.text
    if found.sort == "instead" and text.code(found.at) == found.name:
        return case.changed(found.module, text.swap(found.at, found.written))
    if found.sort == "below":
        row = f"{indent_of(text.line(found.at.lineno))}{found.written}"
        below = (found.at.end_lineno or found.at.lineno) + 1
        return case.changed(found.module, text.before(below, row))
    return None


NO_RETURN = msg(
    "A function gives back only what stands behind return. {function} has no such line, so line "
    "{line}, which uses its value, gets None."
)
_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "nothing_returned",
        "counter",
        msg("A function returns nothing, and its value is used"),
        NO_RETURN,
        msg("Write {written} below this line, indented as far as this line."),
        whys={
            "printed": msg(
                "print() and the logger write a text and do not hand it on. {function} has no return, so "
                "it gives None to line {line}, which uses its value."
            ),
            "some": msg(
                "{function} returns a value only if the condition in line {at} is true. If it is "
                "not, line {line}, which uses the value, gets None."
            ),
        },
        fixes={
            "instead": INSTEAD,
            "printed": INSTEAD,
            "end": msg(
                "Let the last line of {function} be a return with the value that line {line} needs."
            ),
            "some": msg(
                "Add a return with a value as the last line of {function}, indented as far as the "
                "if in line {at}: it counts when the condition is not true."
            ),
        },
        raised={
            r"TypeError: (?:unsupported operand type\(s\) for [+-]=?: '(?:NoneType' and '\w+|\w+' "
            r"and 'NoneType)'|can only concatenate str \(not \"NoneType\"\))": on_line(
                _none_at_error
            )
        },
        behind={
            "run.wrong_text": _logged_none,
            "run.print_not_logger": _printed_for_logger,
        },
        fixed_by=(_returned, lines.written),
        examples=(
            example(
                "text_in_a_variable_instead_of_return",
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def time_text(self):\n        time_text = str(self.counter_)\n"
                    "        self.counter_ = self.counter_ + 1\n\n    def timer_callback",
                ),
                Replace(NODE, LOG, "self.get_logger().info('Hello time: ' + self.time_text())"),
                Replace(NODE, "        self.counter_ += 1\n", ""),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "no_return_in_another_file",
                Write(
                    "my_robot_controller/speaker.py",
                    "def words(number):\n    text = 'Hello time: ' + str(number)\n",
                ),
                Replace(
                    NODE,
                    "import rclpy\n",
                    "import rclpy\n\nfrom my_robot_controller.speaker import words\n",
                ),
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "words(self.counter_)"),
                fails="run.output",
            ),
            example(
                "helper_without_return",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "def add_one(x):\n    y = x + 1\n\n\nclass MyFirstNode",
                ),
                Replace(NODE, "self.counter_ += 1", "self.counter_ = add_one(self.counter_)"),
                fails="run.output",
                blocks=DEAD[1:],
            ),
            example(
                "text_printed_not_returned",
                Replace(NODE, LOG, "self.get_logger().info(str(self.text()))"),
                Replace(
                    NODE,
                    "\n\ndef main(",
                    "\n    def text(self):\n"
                    "        print('Hello time: ' + str(self.counter_))\n\n\ndef main(",
                ),
                fails="run.logger",
            ),
        ),
    ),
)
