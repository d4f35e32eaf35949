"""Mistakes in which two calls write the parts of one line."""

from __future__ import annotations

import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG_LINE, NODE, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.two_calls import two_calls

NUMBER = re.compile(r"\s*-?\d+(?:\.\d+)?\s*")


def _in_parts(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the calls of a text and of a number, where one of the two is the line that came."""
    head, _, tail = suspect.output.text.partition("{n}")
    found = two_calls(suspect.source, head) if not tail else None
    came = suspect.text.strip().lower() in ("", head.strip().lower())
    if found is None or not (came or NUMBER.fullmatch(suspect.text)):
        return None
    mistake = suspect.finding("line_in_parts", found.number, written=found.written)
    words = {
        **mistake.words,
        "line": str(found.text.lineno),
        "at": str(found.number.lineno),
        "name": found.module.line(found.text.lineno),
    }
    printed = any(
        found.module.line(part.lineno).startswith("print") for part in (found.text, found.number)
    )
    variant = "printed" if printed else "whole" if found.whole else ""
    return replace(mistake, words=words, variant=variant)


def _in_one_call(case: Case) -> Files | None:
    """Delete the call of the text, and log both in the call of the number."""
    head = case.assignment.output.text.partition("{n}")[0]
    found = two_calls(case.node, head) if case.node is not None else None
    return case.changed(found.module, *found.splices) if found is not None else None


ONE_CALL = msg("Delete line {line} ({name}), and write in line {at}: {written}")
_node = Family("node", links.PYTHON_STRINGS)
KINDS = (
    _node(
        "line_in_parts",
        "text",
        msg("Two calls write the parts of one line"),
        msg(
            "Each call of the logger writes a line of its own. Make the whole text first, and give "
            "it to one call."
        ),
        ONE_CALL,
        whys={
            "whole": msg(
                "Each call of the logger writes a line of its own. Make the whole text first, and "
                "give it to one call. / gives a number with a decimal point in Python, and // the "
                "whole number."
            ),
            "printed": msg(
                "print() and the logger write to different places, and each call of the logger "
                "writes a line of its own. Make the whole text first, and give it to one call of "
                "the logger."
            ),
        },
        behind={"run.wrong_text": _in_parts},
        fixed_by=(_in_one_call,),
        examples=(
            example(
                "line_in_two_calls",
                Replace(
                    NODE,
                    LOG_LINE,
                    "        log = self.get_logger()\n"
                    "        log.info('Hello time: ')\n"
                    "        log.info(str(self.counter_))\n",
                ),
                fails="run.output",
            ),
            example(
                "helper_logs_the_parts",
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def show(self, part):\n        self.get_logger().info(str(part))\n\n"
                    "    def timer_callback",
                ),
                Replace(
                    NODE,
                    f"{LOG_LINE}        self.counter_ += 1",
                    "        self.show('Hello time: ')\n        self.show(self.counter_)\n"
                    "        self.counter_ += 1",
                ),
                fails="run.output",
            ),
            example(
                "printed_and_then_logged",
                Replace(
                    NODE,
                    LOG_LINE,
                    "        print('Hello time: ', end='')\n"
                    "        self.get_logger().info(f'{self.counter_}')\n",
                ),
                fails="run.output",
            ),
        ),
    ),
)
