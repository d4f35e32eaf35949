"""Control sequences, as for colours, in a logged text: a terminal does not show them."""

from __future__ import annotations

import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace

CODE = re.compile(r"\x1b\[[0-9;:]{0,40}m")


def _in_logged_text(suspect: Suspect) -> RecognisedMistake | None:
    codes = list(dict.fromkeys(CODE.findall(suspect.text)))
    if not codes:
        return None
    found = suspect.finding("colour_codes", suspect.place, name=shown(", ".join(codes)))
    line = suspect.place.line if suspect.place is not None else None
    if line is None:
        return found
    return replace(found, words={**found.words, "line": str(line)}, variant="line")


_node = Family("node", links.PYTHON_STRINGS)
KINDS = (
    _node(
        "colour_codes",
        "text",
        msg("The logged text has colour codes in it"),
        msg(
            "A terminal does not show these characters, but they are part of the message that ROS "
            "logs. The text is compared character by character."
        ),
        msg("Log the text without the colour codes ({name})."),
        fixes={
            "line": msg(
                "Log the text without the colour codes ({name}): remove what adds them in line "
                "{line}."
            )
        },
        behind={"run.wrong_text": _in_logged_text},
        examples=(
            example(
                "text_in_colour",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "'\\033[92m' + 'Hello time: ' + str(self.counter_) + '\\033[0m'",
                ),
                fails="run.output",
            ),
        ),
    ),
)
