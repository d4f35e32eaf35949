"""An instructor's own checks: `checks.py` beside the keys, written with the same decorators as ours.

Their ids begin with `own.`. The file is the instructor's code and runs in the grader's process, so
it is only read from the folder of the keys, never from evidence, a report or a submission.
"""

from __future__ import annotations

import functools
import hashlib
import sys
import traceback
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType, ModuleType

from grader.base.errors import AssignmentError, UsageError
from grader.base.i18n.message import say
from grader.course.assignment import OWN, Assignment
from grader.verdict.checks.all import CHECKS, in_order
from grader.verdict.checks.declare import Check

FILE = "checks.py"
MOST_BYTES = 1_000_000


def read_own_checks(keys: Path | None) -> str:
    """Return the text of `checks.py` in the instructor's folder, "" if there is none.

    Raises AssignmentError, with file and line, if it cannot be used.
    """
    path = keys / FILE if keys is not None else None
    if path is None or not path.is_file():
        return ""
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise AssignmentError(f"{path}:1:1: cannot be read: {error}") from None
    if len(text.encode()) > MOST_BYTES:
        raise AssignmentError(f"{path}:1:1: larger than {MOST_BYTES // 1000} kB")
    try:
        all_checks(text)
    except OwnChecksError as error:
        raise AssignmentError(f"{path}:{error.line}:1: {error}") from None
    return text


def checks_of(assignment: Assignment) -> Mapping[str, Check]:
    """Return the kinds of checks that an assignment can use: ours, and its instructor's own.

    Raises UsageError if it uses an own check and came without them (from evidence, for example).
    """
    known = all_checks(assignment.own_checks)
    missing = [use.kind for use in assignment.checks if use.kind not in known]
    if missing:
        raise UsageError(
            say("the check {check} is not known here", check=missing[0]),
            remedy=say("Give the folder that has {name} with --keys.", name=FILE),
        )
    return known


def static_of(assignment: Assignment) -> tuple[str, ...]:
    """Return the kinds of checks that the package's files usually decide."""
    return tuple(check.id for check in checks_of(assignment).values() if check.needs == "files")


class OwnChecksError(Exception):
    """What is wrong with the text of `checks.py`, in which line."""

    def __init__(self, line: int, text: str) -> None:
        super().__init__(text)
        self.line = line


@functools.lru_cache(maxsize=8)
def all_checks(text: str) -> Mapping[str, Check]:
    """Return our kinds of checks and those in the text of a `checks.py`, in their order.

    Raises OwnChecksError.
    """
    if not text:
        return CHECKS
    own = _declared(text)
    for check in own:
        if not check.id.startswith(OWN):
            known = f"the id of a check in {FILE} begins with '{OWN}', not '{check.id}'"
            raise OwnChecksError(_line_of(check), known)
    try:
        return MappingProxyType(in_order([*CHECKS.values(), *own]))
    except ValueError as error:
        raise OwnChecksError(1, str(error)) from None


def _declared(text: str) -> list[Check]:
    name = f"grader_own_checks_{hashlib.sha256(text.encode()).hexdigest()[:16]}"
    module = ModuleType(name)
    sys.modules[name] = module  # pydantic looks for the types of parameters there
    try:
        exec(compile(text, FILE, "exec"), vars(module))  # noqa: S102 - the instructor's own code
    except SyntaxError as error:
        raise OwnChecksError(error.lineno or 1, f"not Python: {error.msg}") from None
    except (Exception, SystemExit) as error:
        what = f"{type(error).__name__}: {error}"
        raise OwnChecksError(_line_in(error), what) from None
    found = [one for one in vars(module).values() if isinstance(one, Check)]
    return [one for one in found if one.function.__module__ == name]


def _line_in(error: BaseException) -> int:
    """Return the line of `checks.py` that raised an error."""
    lines = [
        frame.lineno
        for frame in traceback.extract_tb(error.__traceback__)
        if frame.filename == FILE
    ]
    return (lines[-1] if lines else None) or 1


def _line_of(check: Check) -> int:
    code = getattr(check.function, "__code__", None)
    return code.co_firstlineno if code is not None else 1
