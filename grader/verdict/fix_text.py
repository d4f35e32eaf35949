"""The text of a fix must say what its change does: where it does not, the change words it."""

from __future__ import annotations

import re
import string
from difflib import SequenceMatcher, get_close_matches

from grader.base.i18n.message import Message, msg, say
from grader.base.i18n.translator import Translator
from grader.base.shown import shown
from grader.mistakes.catalogue import CATALOGUE
from grader.package.edit.files import Files
from grader.report.model import CheckResult

INSTEAD = msg("Write {written} instead of {name}.")
BELOW = msg("Make the change below.")
DELETES = "Delete this line"
"""How the texts begin that take the line of the finding away."""


def matching_text(result: CheckResult, old: Files, new: Files, translate: Translator) -> str:
    """Return what to do for a result whose change leads from `old` to `new`.

    It is the text of the result, unless that says to delete a line which the change keeps or rewrites.
    """
    where, fix = result.where, result.fix
    if where is None or where.line is None or not _deletes(result, translate):
        return fix
    before, after = (_rows(files, where.file) for files in (old, new))
    codes = SequenceMatcher(None, before, after, autojunk=False).get_opcodes()
    at = where.line - 1
    tag, start, end, first, last = next(
        (code for code in codes if code[1] <= at < code[2]), ("delete", at, at, 0, 0)
    )
    if tag == "delete":
        return fix
    if tag != "replace":
        return translate(Message(BELOW))
    row, group = before[at], before[start:end]
    own = [new for new in after[first:last] if get_close_matches(new, group, 1, 0) == [row]]
    if [new.strip() for new in own] in ([], ["pass"]):  # (a text says of itself that pass is left)
        return fix
    if len(own) == 1:
        words = {"written": shown(own[0].strip()), "name": shown(row.strip())}
        return translate(Message(INSTEAD, words))
    return translate(Message(BELOW))


def without_change(result: CheckResult, translate: Translator) -> CheckResult:
    """Return the result of what was only seen, whose usual fix does not help: its text asks for it."""
    if not any(mistake.id.startswith("run.") for mistake in result.mistakes):
        return result
    follow = say(
        "The usual change for this was tried, and the check still fails with it. Follow the program step "
        "by step to the line that logs: log the values that each step uses, and compare them with what "
        "you expect."
    )
    return result.model_copy(update={"fix": translate(follow)})


def _deletes(result: CheckResult, translate: Translator) -> bool:
    """Whether the text of a result, in the reader's language, is one that deletes its line."""
    kind = CATALOGUE.get(result.mistakes[0].id) if result.mistakes else None
    texts = (kind.fix, *kind.fixes.values()) if kind is not None else ()
    return any(
        re.match(_pattern(text, translate), result.fix, re.DOTALL)
        for text in texts
        if text.startswith(DELETES)
    )


def _pattern(text: str, translate: Translator) -> str:
    """Return a pattern of a template in the reader's language, whatever its values are."""
    names = {name for _, name, _, _ in string.Formatter().parse(text) if name}
    filled = translate(Message(text, dict.fromkeys(names, "\0")))
    return ".*?".join(map(re.escape, filled.split("\0")))


def _rows(files: Files, path: str) -> list[str]:
    return (files.data(path) or b"").decode("utf-8", "replace").splitlines()
