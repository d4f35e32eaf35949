"""A diff as people read it: lines that differ only in their line ends are one remark."""

from __future__ import annotations

import difflib
import shlex
from collections.abc import Iterator

from grader.base.i18n.message import say
from grader.base.plain_text import Translate

LINE_ENDS = say("(line endings of the whole file: CRLF becomes LF)")
COMMAND = say(
    "(CRLF becomes LF in the whole file. This is no patch: in the package's folder, run the "
    "command below)"
)
MOST_COMPARED = 400


def shown_patch(patch: str, translate: Translate = str) -> str:
    """Return a diff without the pairs of lines of which only the line ends differ.

    It is for reading: a tool that applies the change needs the diff itself.
    """
    if "\r\n" not in patch:
        return patch
    return "\n".join(_read(patch.split("\n"), translate(LINE_ENDS), translate(COMMAND)))


def _read(lines: list[str], general: str, with_command: str) -> Iterator[str]:
    at, remark = 0, general
    while at < len(lines):
        if lines[at].startswith("+++ b/"):
            path = shlex.quote(lines[at].removeprefix("+++ b/").rstrip())
            remark = f"{with_command}\nsed -i 's/\\r$//' {path}"
        removed = _run(lines, at, "-") if not lines[at].startswith("--- ") else 0
        added = _run(lines, at + removed, "+")
        if removed and added:
            yield from _changes(
                lines[at : at + removed], lines[at + removed : at + removed + added], remark
            )
            at += removed + added
        else:
            yield lines[at]
            at += 1


def _run(lines: list[str], at: int, sign: str) -> int:
    end = at
    while end < len(lines) and lines[end].startswith(sign):
        end += 1
    return end - at


def _changes(old: list[str], new: list[str], remark: str) -> Iterator[str]:
    """Yield the lines that differ in more than their line ends, and once the remark."""
    before = [line[1:].removesuffix("\r") for line in old]
    after = [line[1:].removesuffix("\r") for line in new]
    if max(len(old), len(new)) > MOST_COMPARED:  # comparing takes quadratic time
        equal = before == after
        yield from [remark] if equal else [*old, *new]
        return
    said = False
    matcher = difflib.SequenceMatcher(None, before, after, autojunk=False)
    for tag, i, j, k, m in matcher.get_opcodes():
        if tag != "equal":
            yield from old[i:j]
            yield from new[k:m]
        elif not said:
            said = True
            yield remark
