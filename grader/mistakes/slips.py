"""The catalogue: texts about what stops Python from reading a file, for the node's and setup.py."""

from __future__ import annotations

from grader.base.i18n.message import Message, msg, say
from grader.base.shown import shown
from grader.package.source.broken_python import Slip
from grader.package.source.pasted import Pasted
from grader.package.source.python import PythonFault

WEB = msg(
    "A web page or a document shows code with its own quotes, spaces and labels, and other input "
    "methods have signs that look alike. If they are copied with the code, Python stops at them."
)
OTHER_LANGUAGE = msg(
    "Other languages have signs and words that Python does not know, or uses in another way. Python "
    "stops at a line with one of them."
)
NO_CODE = msg("Python reads the whole file, and stops at the first line that is not Python code.")
LANGUAGE = {
    "language": msg("Python writes this in another way. Write: {wanted}"),
    "increment_inside": msg(
        "Python has no ++ and no --. Add 1 on a line of its own, with += 1 after the name."
    ),
    "braces": msg(
        "Python has no braces around a block. Delete {{ and }}. Write a colon at the end of the line "
        "above the block, and indent each line of the block by 4 spaces."
    ),
}
PASTED = {
    "signs": msg(
        "Type '{found}' again, here and in the other lines that have it, with the keyboard set to English: "
        "quotes are ' or \", and spaces are those of the space bar."
    ),
    "lines": msg(
        "Delete '{found}', and everything else of this kind: it belongs to the page or the terminal from "
        "which the code was copied, and is not code."
    ),
    "around": msg(
        "Keep only the code, lines {line} to {wanted}. Delete everything above and below it, the "
        "lines '{found}' too: that is the text of a chat or a web page, and not Python."
    ),
    "notebook": msg(
        "This file is a Jupyter notebook: the code is in it as texts, and Python runs none of them. "
        "Rename the file so that its name ends with .ipynb, and open it in Jupyter or VS Code. Copy "
        "the code of its cells, without lines that begin with ! or %, into a new file with the name "
        "of this one. Write #!/usr/bin/env python3 as its first line, and make it executable with "
        "chmod +x."
    ),
    "document": msg(
        "This file is a document of another program, and not plain text with Python code. Open it in "
        "the program that wrote it, and copy only the code into a new file with this name, in a code "
        "editor (such as VS Code)."
    ),
    "conflict": msg(
        "git could not join two versions of these lines. Keep one version, and delete the other "
        "one and the lines with <<<<<<<, ======= and >>>>>>>."
    ),
}
SIGNS = {
    "write": msg("Write: {wanted}"),
    "colon_missing": msg("A line that begins a block ends with a colon. Write: {wanted}"),
    "colon_extra": msg(
        "Remove the colon at the end of that line: only lines that begin a block, such as def, if "
        "or try, end with one."
    ),
    "comma_at_end": msg("The comma at the end of this line is missing. Write: {wanted}"),
    "bracket_end": msg(
        "A bracket of this line is not closed. If the part in brackets ends here, write: {wanted}"
    ),
    "line_extra": msg("Python can read the file without this line. Delete it."),
    "block_empty": msg(
        "This line ends with a colon, but line {line} is not in its block. Write the lines of the "
        "block below this line, indented by 4 spaces; or write pass there if nothing is to be done."
    ),
    "head_deeper": msg(
        "This line is indented too far: line {line} below it is in the same column, and belongs to its "
        "block. Indent this line by 4 spaces less."
    ),
    "line_above": msg(
        "Indent this line as far as line {line}: the lines of one block begin in the same column."
    ),
    "not_indented": msg(
        "Line {line} ends with a colon, so its block comes next: indent this line, and the other "
        "lines of the block, by 4 spaces more than line {line}."
    ),
    "tab": msg(
        "This line is indented with a tab, and the lines around it with spaces. Delete the tab and "
        "type as many spaces as the other lines of its block have."
    ),
    "two_statements": msg("Write each statement on a line of its own: {wanted}"),
    "try_alone": msg(
        "The try: above this line has neither except: nor finally: below its block. Write one of them "
        "above this line, in the same column as try:. For Ctrl+C that is except KeyboardInterrupt: and, "
        "on the next line and indented by 4 spaces more, pass."
    ),
    "text_without_end": msg(
        "For Python, a text in three quotes begins in this line and has no end. Three quotes are missing "
        "at the end of this text, or of one above."
    ),
    "quote": msg(
        "A text begins and ends with the same quote, on one line. In this line a quote is missing, or "
        "one is too many. If it has no quotes at all, write one on each side of the text."
    ),
    "bracket_open": msg(
        "A bracket of this line is not closed. Close it where the part in brackets ends."
    ),
    "block_missing": msg(
        "This line ends with a colon, but its block is missing. Write the lines of the block below "
        "it, indented by 4 spaces more than this line; or write pass there if nothing is to be done."
    ),
    "stops_at": msg(
        "Python can read what is before {part}, but {part} cannot follow it. The mistake is at this "
        "place or before it in the same statement, which may begin in a line above. Compare the "
        "statement with one of the same kind that works."
    ),
    "told_at": msg(
        "Python stops at {part}. What it expects there, or does not accept, is in its message behind "
        "SyntaxError. Change that part of the statement, or compare the statement with one of the same "
        "kind that works."
    ),
}
SLIPS = {**SIGNS, **LANGUAGE, **PASTED}
SLIP_WHYS = {
    **dict.fromkeys(SIGNS, NO_CODE),
    **dict.fromkeys(LANGUAGE, OTHER_LANGUAGE),
    **dict.fromkeys(PASTED, WEB),
    **dict.fromkeys(("conflict", "document"), NO_CODE),
}
KINDS = {
    "pasted": "source.pasted",
    "document": "source.pasted",
    "language": "source.other_language",
}
"""The mistakes of the node's file by the cause of a slip; the others are syntax errors."""


def words_of(slip: Slip | Pasted) -> dict[str, str]:
    """Return the values of the placeholders in the texts above."""
    wanted = slip.wanted if isinstance(slip, Slip) else ""
    line = str(slip.other) if isinstance(slip, Slip) else ""
    return {"found": shown(slip.found), "wanted": shown(wanted), "line": line}


def variant_of(slip: Slip | Pasted) -> str:
    """Return the variant whose texts are told of a slip: its own, or the one of its cause."""
    if slip.variant in SLIPS:
        return slip.variant
    language = isinstance(slip, Slip) and slip.cause == "language"
    return "language" if language else "write"


def unexplained(fault: PythonFault) -> str:
    """Return the variant of a fault for which no slip is known: what Python says of it, and where."""
    if fault.kind != "syntax" or not fault.part:
        return fault.kind
    return "stops_at" if "invalid syntax" in fault.text else "told_at"


def description(slip: Slip | Pasted) -> Message:
    """Return what was found at the place of a slip."""
    found = shown(slip.found)
    if isinstance(slip, Slip) and slip.cause == "document" and slip.variant != "conflict":
        return say("the file is a document of another program")
    if isinstance(slip, Slip) and slip.cause in ("signs", "document"):
        return say("in: {code}", code=found)
    return say("this is not Python: {found}", found=found)
