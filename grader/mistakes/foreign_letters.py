"""Mistakes in which a letter of a name is from another alphabet and looks right."""

from __future__ import annotations

import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.lookalikes import LATIN, as_latin
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.report.model import Where

QUOTED = r"'(?P<name>[\w.]{0,80}[^\W\x00-\x7f][\w.]{0,80})'"


def _foreign(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name = match["name"]
    written = as_latin(name)
    if not written.isascii():
        return None
    for module in raised.source.modules:
        for number in range(1, len(module.text.lines) + 1):
            if name in module.line(number):
                sign = next(letter for letter in name if letter in LATIN)
                letter, code = LATIN[sign], f"U+{ord(sign):04X}"
                found = raised.finding(
                    "foreign_letter",
                    name=name,
                    written=written,
                    sign=sign,
                    letter=letter,
                    code=code,
                )
                return replace(found, where=Where(file=module.path, line=number))
    return None


_node = Family("node", links.PYTHON_SYNTAX)
KINDS = (
    _node(
        "foreign_letter",
        "file",
        msg("A letter of a name is from another alphabet"),
        msg(
            "The {sign} in {name} is not the letter {letter} of an English keyboard. It looks the "
            "same, but for Python it is another character ({code})."
        ),
        msg("Set the keyboard to English, delete the name and type it again: {written}"),
        raised={QUOTED: _foreign},
        fixed_by=(lines.written_everywhere,),
        examples=(
            example(
                "cyrillic_letter",
                Replace(NODE, "self.counter_ = 0", "self.\u0441ounter_ = 0"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "cyrillic_letter_in_import",
                Replace(NODE, "import Node", "import N\u043ede"),
                fails="run.starts",
            ),
        ),
    ),
)
