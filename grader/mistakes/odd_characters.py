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
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.mistakes.worked_out import INSTEAD
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.edit.tree import Replace
from grader.package.source.odd_characters import (
    LINE_ENDS,
    BrokenText,
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
    """Look for line ends and tabs in the line, or for the blanks of a string of several lines."""
    head = suspect.output.text.partition("{n}")[0]
    found = broken_texts(suspect.source, head)
    ends = any(c in LINE_ENDS for c in suspect.text)
    blanks = re.search(r" {2,}", suspect.text) and " ".join(suspect.text.split()).startswith(
        head.strip()
    )
    if len(found) != 1 or not (ends or (blanks and not found[0].sign)):
        return None
    broken = found[0]
    code = broken.module.text.code(broken.node)
    name = code if broken.sign and len(code) <= LONGEST else ""
    mistake = suspect.finding("line_end_in_text", broken.node, name=name, written=broken.written)
    words = {
        **mistake.words,
        "form": broken.sign,
        "line": str(broken.node.lineno),
        "at": str(broken.node.end_lineno or broken.node.lineno),
    }
    return replace(mistake, words=words, variant=_variant(broken))


PRINTS = ("print", "sys.stdout.write", "sys.stderr.write", "os.write")


def _second_row(suspect: Suspect) -> RecognisedMistake | None:
    """A logged text has a line end in it: the row of the terminal with the rest looks printed."""
    source = suspect.source
    head = suspect.output.text.partition("{n}")[0]
    logged = {n for call in source.own_logs for n in ast.walk(call)}
    found = [b for b in broken_texts(source, head) if b.node in logged and "\\n" in b.sign]
    if len(found) != 1 or any(name in PRINTS for _, name in source.calls):
        return None
    return _line_end(replace(suspect, text=LINE_ENDS[0] + suspect.text))


def _variant(broken: BrokenText) -> str:
    if not broken.sign:
        return "lines" if broken.written else "lines_only"
    sort = "tab" if broken.sign == "\\t" else ""
    return sort if broken.written else f"{sort}_only" if sort else "only"


def _without_line_end(case: Case) -> Files | None:
    """Write the string on one line, without line ends and tabs."""
    head = case.assignment.output.text.partition("{n}")[0]
    found = broken_texts(case.node, head) if case.node is not None else []
    if len(found) != 1 or not found[0].written:
        return None
    module = found[0].module
    return case.changed(module, module.text.swap(found[0].node, found[0].written))


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
LINE_END = msg(
    "The logger ends each line by itself. {form} is one more character of the text, and the text is "
    "compared character by character."
)
TAB = msg(
    "{form} is a tab, one more character of the text. The text is compared character by character."
)
LINES = msg(
    "The string has more than one line of the file: the line ends, or the blanks before the next "
    "line, are a part of the text."
)
_node = Family("node", links.PYTHON_STRINGS)
KINDS = (
    _node(
        "odd_character",
        "text",
        msg("A character of the text is invisible, or looks like another one"),
        LETTER,
        AGAIN,
        whys={
            "space": SPACE,
            "space_and_more": SPACE,
            "nothing": NOTHING,
            "nothing_and_more": NOTHING,
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
            "letter_and_more": msg(
                "Set the keyboard to English, delete the whole text between the quotes and type it "
                "again, not copied: {written}"
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
                "zero_width_space_in_text",
                Replace(NODE, "'Hello time: '", "'Hello \u200btime: '"),
                fails="run.output",
            ),
            example(
                "wide_colon_in_text",
                Replace(NODE, "'Hello time: '", "'Hello time\uff1a '"),
                fails="run.output",
            ),
            example(
                "wide_colon_without_blank",
                Replace(NODE, "'Hello time: '", "'Hello time\uff1a'"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "line_end_in_text",
        "text",
        msg("The text has a line end or a tab in it"),
        LINE_END,
        INSTEAD,
        whys={
            "only": LINE_END,
            "tab": TAB,
            "tab_only": TAB,
            "lines": LINES,
            "lines_only": LINES,
        },
        fixes={
            "only": msg("Delete {form} from the text in this line."),
            "tab_only": msg("Delete {form} from the text in this line."),
            "lines": msg("Write {written} instead of the string in lines {line} to {at}."),
            "lines_only": msg(
                "Write the string in lines {line} to {at} on one line, without line ends in it."
            ),
        },
        behind={"run.wrong_text": _line_end, "run.print_not_logger": _second_row},
        fixed_by=(_without_line_end,),
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
            example(
                "text_continued_with_backslash",
                Replace(NODE, "'Hello time: '", "'Hello \\\n            time: '"),
                fails="run.output",
            ),
        ),
    ),
)
