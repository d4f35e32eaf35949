"""Mistakes in single characters of a text: invisible ones, look-alikes, line ends."""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping
from dataclasses import replace

from grader.base.i18n.message import Value, msg, say
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import INSTEAD, Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.edit.tree import Replace
from grader.package.source.odd_characters import (
    OddSign,
    broken_texts,
    joined,
    odd_signs,
    plain,
    plain_text,
    strings_with,
    typed,
)

LONGEST = 120  # characters of a piece of code that a text shows


def _odd_sign(suspect: Suspect) -> RecognisedMistake | None:
    """Look for characters of the line with others of an English keyboard in their place."""
    head, tail = suspect.output.text.split("{n}")
    signs = odd_signs(suspect.text)
    came = plain_text(suspect.text)
    if not signs or not (head + tail).isascii() or not joined(came).startswith(joined(head)):
        return None
    found = strings_with(suspect.source, {sign.sign for sign in signs})
    if not found:
        return None
    module, node = found[0]
    mistake = suspect.finding("odd_character", node, code=signs[0].code)
    words: dict[str, Value] = {**mistake.words, **_words(signs[0])}
    code = typed(module.text.code(node), head)
    alone = len(signs) == 1 and came.startswith(head)
    if alone or len(code) > LONGEST:
        return replace(mistake, words=words, variant=signs[0].sort)
    several = f"{signs[0].sort}_and_more"
    return replace(mistake, words={**words, "written": code}, variant=several)


def _words(sign: OddSign) -> Mapping[str, Value]:
    word = sign.word if sign.sort == "letter" else plain_text(sign.word)
    return {
        "before": shown(plain_text(sign.before)) or say("the quotes"),
        "after": say("the number")
        if sign.after.isdecimal()
        else shown(plain_text(sign.after)) or say("the quotes"),
        "name": shown(word),
        "letter": plain(sign.sign),
    }


def _typed_again(case: Case) -> Files | None:
    """Put characters of an English keyboard in the place of the others in the strings."""
    node = case.node
    module, name = case.module, str(case.finding.params.get("code", ""))
    if node is None or module is None or not name:
        return None
    head, text, splices = case.assignment.output.text.partition("{n}")[0], module.text, []
    for found, string in strings_with(node, set(text.text) - set(map(chr, range(128)))):
        start, end = text.span(string)
        if found is module and string.lineno == case.finding.line:
            splices.append(Splice(start, end, typed(text.text[start:end], head)))
    return case.changed(module, *splices)


def _line_end(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only string with a line end in it, if the line has one."""
    found = broken_texts(suspect.source)
    if len(found) != 1 or "\n" not in suspect.text:
        return None
    module, node = found[0]
    code = module.text.code(node)
    written = re.sub(r"(?<=^['\"])\\n|\\n(?=['\"]$)", "", code)
    only = "\\n" in written or len(code) > LONGEST
    params = {} if only else {"name": code, "written": written}
    mistake = suspect.finding("line_end_in_text", node, **params)
    words = {**mistake.words, "form": "\\n"}
    return replace(mistake, words=words, variant="only" if only else "")


PRINTS = ("print", "sys.stdout.write", "sys.stderr.write", "os.write")


def _second_row(suspect: Suspect) -> RecognisedMistake | None:
    """A logged text has a line end in it: the row of the terminal with the rest looks printed."""
    source = suspect.source
    logged = {n for call in source.own_logs for n in ast.walk(call)}
    found = [node for _, node in broken_texts(source) if node in logged]
    if len(found) != 1 or any(name in PRINTS for _, name in source.calls):
        return None
    return _line_end(replace(suspect, text=f"\n{suspect.text}"))


SPACE = msg(
    "There is another space than that of the space bar: {code}. It looks the same, also in a diff, "
    "but the text is compared character by character. Web pages, PDF files and the Alt key bring "
    "such spaces."
)
NOTHING = msg(
    "There is a character that cannot be seen: {code}. It does not show, also not in a diff, but the "
    "text is compared character by character. Copied text often has such characters."
)
LETTER = msg(
    "There is a character that looks like {letter}, but is another one: {code}. It looks nearly the "
    "same, also in a diff, but the text is compared character by character. Another keyboard or "
    "copied text brings such characters."
)
AGAIN = msg("Delete the whole text between the quotes and type it again, not copied: {written}")
_node = Family("node", links.PYTHON_STRINGS)
KINDS = (
    _node(
        "odd_character",
        "text",
        msg("A character of the text is invisible, or looks like another one"),
        LETTER,
        AGAIN,
        whys={
            **dict.fromkeys(("space", "space_and_more"), SPACE),
            **dict.fromkeys(("nothing", "nothing_and_more"), NOTHING),
        },
        fixes={
            "space": msg(
                "Delete the space between {before} and {after} in this line, and type it again with "
                "the space bar alone."
            ),
            "nothing": msg(
                "Delete what is between {before} and {after} in this line, one character more than "
                "you see, and type it again."
            ),
            "letter": msg(
                "Set the keyboard to English, delete the word {name} in this line and type it again "
                "with the {letter} of the keyboard."
            ),
        },
        behind={"run.wrong_text": _odd_sign},
        fixed_by=(_typed_again,),
        examples=(
            example(
                "no_break_space_in_text",
                Replace(NODE, "'Hello time: '", "'Hello\u00a0time: '"),
                fails="run.output",
            ),
            example(
                "wide_colon_in_text",
                Replace(NODE, "'Hello time: '", "'Hello time\uff1a '"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "line_end_in_text",
        "text",
        msg("The text has a line end or a tab in it"),
        msg(
            "The logger ends each line by itself. {form} is one more character of the text, and the "
            "text is compared character by character."
        ),
        INSTEAD,
        fixes={"only": msg("Delete {form} from the text in this line.")},
        behind={"run.wrong_text": _line_end, "run.print_not_logger": _second_row},
        fixed_by=(lines.written,),
        examples=(
            example(
                "newline_in_text",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "'Hello time: %d\\n' % self.counter_",
                ),
                fails="run.output",
            ),
        ),
    ),
)
