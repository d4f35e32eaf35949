"""Words and signs of other programming languages."""

from __future__ import annotations

import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import node_words
from grader.mistakes.kind import Family
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace

WORDS = {
    **dict.fromkeys(("true", "TRUE"), "True"),
    **dict.fromkeys(("false", "FALSE"), "False"),
    **dict.fromkeys(
        ("null", "NULL", "Null", "nil", "none", "NONE", "nullptr", "undefined"), "None"
    ),
    "this": "self",
}
FUNCTIONS = {
    **dict.fromkeys(("num2str", "int2str", "to_string", "itoa", "String"), "str"),
    **dict.fromkeys(("length", "numel", "sizeof", "strlen"), "len"),
    **dict.fromkeys(("str2num", "str2double", "atof", "parseFloat"), "float"),
    **dict.fromkeys(("atoi", "parseInt"), "int"),
}
"""Functions of other languages, and Python's own."""
PRINTS = (
    *("printf", "println", "puts", "echo", "console", "cout", "std", "System", "Console"),
    *("RCLCPP_INFO", "RCLCPP_DEBUG", "RCLCPP_WARN", "RCLCPP_ERROR", "ROS_INFO", "ROS_INFO_STREAM"),
)
METHODS = {
    **dict.fromkeys(("toString", "to_string", "ToString", "str"), "str(…)"),
    **dict.fromkeys(("length", "size", "Length"), "len(…)"),
    **dict.fromkeys(("concat", "Concat"), "+"),
    **dict.fromkeys(("push", "push_back", "add", "Add"), "append(…)"),
}
SHOWN = "|".join((*WORDS, *PRINTS))


def _word(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name = match["name"]
    given = rf"\b{name}\s*\((?!\s*\)|\s*\w+\s*=)"  # (String() and String(data=…) make a message)
    if name in FUNCTIONS and re.search(given, raised.module.line(raised.line)):
        return raised.finding("other_language", name=name, close=FUNCTIONS[name])
    if name in WORDS:
        return raised.finding("other_language", name=name, close=WORDS[name])
    if name not in PRINTS:
        return None
    return replace(raised.finding("other_language", name=name), variant="print")


def _comment(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name, line = match["name"], raised.module.line(raised.line)
    if not re.search(rf"//\s{{0,99}}{re.escape(name)}\b", line) or _is_misspelt(raised, name):
        return None
    return raised.finding("slash_comment", name=name)


def _is_misspelt(raised: Raised, name: str) -> bool:
    """Whether the file has nearly this name: another one may be meant."""
    known = {*raised.module.names, *(own.rstrip("_") for own in raised.source.attributes)}
    return bool(nearest(name, known - {name}, 0.75)) or name in raised.source.attributes


def _method(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name = match["name"]
    if name not in METHODS:
        return None
    found = raised.finding("other_language", name=name, written=METHODS[name])
    return replace(found, variant="to_text" if METHODS[name] == "str(…)" else "method")


def _lost_sum(suspect: Suspect) -> RecognisedMistake | None:
    found = node_words.lost_sum(suspect.source)
    if found is None:
        return None
    step = suspect.output.step
    return suspect.finding("sum_not_kept", found[0], name=found[1], step=step)


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "other_language",
        "callback",
        msg("A word of another programming language is used"),
        msg("Each programming language has its own words. In Python, case matters."),
        msg("Use Python's own word instead of {name}: True, False, None, self."),
        close=msg("Write {close} instead of {name}."),
        fixes={
            "to_text": msg("Write str( ) around the value instead of .{name}() behind it."),
            "print": msg(
                "Write self.get_logger().info(…) instead of the whole statement with {name}, and the "
                "text to log instead of …"
            ),
            "method": msg("Write {written} instead of {name}."),
        },
        seen=rf"NameError: name '(?P<name>{SHOWN})' is not defined",
        raised={
            NAME_ERROR: _word,
            (
                r"AttributeError: '(?:int|float|str|list)' object has no attribute "
                r"'(?P<name>\w{1,120})'"
            ): _method,
        },
        fixed_by=(node_words.word,),
        examples=(
            example(
                "null_for_none",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.last_ = null"),
                fails="run.starts",
            ),
            example(
                "true_in_lower_case",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.on_ = true"),
                fails="run.starts",
            ),
            example(
                "this_for_self",
                Replace(NODE, "self.counter_ += 1", "this.counter_ += 1"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "to_string",
                Replace(NODE, "str(self.counter_)", "self.counter_.toString()"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "printf_in_callback",
                Replace(
                    NODE,
                    "self.get_logger().info('Hello time: ' + str(self.counter_))",
                    "printf('Hello time: %d', self.counter_)",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "slash_comment",
        "callback",
        msg("A comment begins with // instead of #"),
        msg("In Python // is a division, so what follows it is not a comment."),
        msg("Write # instead of //."),
        raised={NAME_ERROR: _comment},
        fixed_by=(node_words.comment,),
        examples=(
            example(
                "comment_with_slashes",
                Replace(NODE, "self.counter_ += 1", "self.counter_ += 1  // increment"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "sum_not_kept",
        "counter",
        msg("The result of the calculation is not kept"),
        msg(
            "This line calculates or compares, but assigns the result to nothing: {name} stays as it "
            "is. Python has no ++, and == only compares."
        ),
        msg("Write in this line: {name} += {step}"),
        links.PYTHON_CLASSES,
        behind={"run.constant_counter": _lost_sum},
        fixed_by=(node_words.kept_sum,),
        examples=(
            example(
                "plus_plus_before_name",
                Replace(NODE, "self.counter_ += 1", "++self.counter_"),
                fails="run.output",
            ),
            example(
                "sum_not_kept",
                Replace(NODE, "self.counter_ += 1", "self.counter_ + 1"),
                fails="run.output",
            ),
        ),
    ),
)
