"""Says why Python cannot read a file, and what to change in it."""

from __future__ import annotations

import re

from grader.base.i18n.message import joined, say
from grader.base.shown import shown
from grader.mistakes.recognised import RecognisedMistake
from grader.mistakes.slips import KINDS, description, unexplained, variant_of, words_of
from grader.package.source.broken_python import Slip
from grader.package.source.documents import document_of
from grader.package.source.other_encoding import declaration, kind_of_encoding
from grader.package.source.python import PythonFault, parse_python
from grader.package.source.slips import slip_of
from grader.report.model import Where
from grader.verdict.checks.parsed import printable_reason
from grader.verdict.outcome import Failed

GUESS = re.compile(
    r"(?:\.|, )? ?(?:Maybe you meant|Perhaps you forgot|[Dd]id you (?:mean|forget)) .*", re.DOTALL
)
"""What Python adds to an error: for a text without quotes it asks for '=='."""


def unreadable_module(path: str, found: bytes) -> RecognisedMistake | None:
    """Return why Python stops at a file that the node's file imports; None if it can be parsed."""
    document = document_of(found)
    if document is not None:
        failed = failed_document(path, document)
    else:
        try:
            parse_python(found)
        except PythonFault as fault:
            if fault.kind == "size":
                return None  # (a limit of the grader, and none of Python)
            failed = not_python(path, fault, found)
        else:
            return None
    return RecognisedMistake(
        kind=failed.mistake.id,
        params=failed.mistake.params,
        words=failed.words,
        variant=failed.variant,
        where=failed.where,
    )


def not_python(path: str, fault: PythonFault, found: bytes) -> Failed:
    """Return the failure of a file that Python cannot parse."""
    text = printable_reason(fault.text)
    slip = slip_of(found)
    if slip is not None:
        return _slip(path, text, fault.kind, slip)
    code = say("in: {code}", code=shown(fault.shown)) if fault.shown else ""
    declared = declaration(found) if fault.kind == "encoding" else None
    line, name = declared or (fault.line, "")
    return Failed(
        "source.not_utf8" if fault.kind == "encoding" else "source.syntax_error",
        expected=say("a file that Python can read"),
        actual=joined(text, code, by=", "),
        where=Where(file=path, line=line),
        words={"line": str(line), "found": shown(name), "part": shown(fault.part)},
        variant=kind_of_encoding(found) if fault.kind == "encoding" else unexplained(fault),
        params={"error": str(text), "kind": fault.kind},
    )


def without_guess(error: str) -> str:
    """Return Python's error without what it thinks was meant, for which a slip has the real name."""
    return error[: guess.start()] if (guess := GUESS.search(error)) else error


def _slip(path: str, text: str, kind: str, slip: Slip) -> Failed:
    mistake = KINDS.get(slip.cause, "source.syntax_error")
    params = {"error": str(text), "kind": kind}
    return Failed(
        mistake,
        expected=say("a file that Python can read"),
        actual=joined(without_guess(text), description(slip), by=", "),
        where=Where(file=path, line=slip.line),
        variant=variant_of(slip),
        params=params,
        words={**words_of(slip), "file": shown(path.rpartition("/")[2])},
    )


def failed_document(path: str, document: Slip) -> Failed:
    """Return the failure of a file that is a document of another program."""
    return Failed(
        "source.pasted",
        expected=say("a file that Python can read"),
        actual=description(document),
        where=Where(file=path, line=document.line),
        variant=variant_of(document),
        words={**words_of(document), "file": shown(path.rpartition("/")[2])},
    )
