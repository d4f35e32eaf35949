"""A text that a regular expression matches: what a reader understands better than the pattern."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterable
from typing import Any

with warnings.catch_warnings():
    warnings.simplefilter("ignore", DeprecationWarning)  # (from Python 3.11 on it is re._parser)
    import sre_parse

OF_CATEGORY = {"DIGIT": "1", "SPACE": " ", "WORD": "a", "NOT_DIGIT": "a", "NOT_SPACE": "a"}
LIKELY = "a1 ._-:/ABz0%"  # characters that are tried where some are not allowed


def example_of(pattern: str) -> str:
    """Return a short text that a pattern matches, "" if none is found.

    Groups that refer to others, and conditions that look ahead, are not understood.
    """
    try:
        parsed: Any = sre_parse.parse(pattern)
        text = _of(parsed)
    except (re.error, LookupError, ValueError, RecursionError, StopIteration):
        return ""
    return text if re.search(pattern, text) else ""


def _of(parts: Iterable[tuple[Any, Any]]) -> str:
    return "".join(_part(str(kind), value) for kind, value in parts)


def _part(kind: str, value: Any) -> str:
    match kind:
        case "LITERAL":
            return chr(int(value))
        case "AT":
            return ""
        case "ANY":
            return "a"
        case "NOT_LITERAL":
            return next(one for one in LIKELY if ord(one) != value)
        case "IN":
            return _of_set(value)
        case "BRANCH":
            return _of(value[1][0])
        case "SUBPATTERN":
            return _of(value[3])
        case "MAX_REPEAT" | "MIN_REPEAT" | "POSSESSIVE_REPEAT":
            least, most, repeated = value
            return str(_of(repeated) * (least if least or most == 1 else 1))
    raise ValueError(kind)


def _of_set(members: list[tuple[Any, Any]]) -> str:
    """Return a character of a set, such as [a-z_]."""
    (kind, value), *_ = members
    if str(kind) == "NEGATE":
        taken = re.compile("[" + "".join(map(_member, members[1:])) + "]")
        return next(one for one in LIKELY if not taken.match(one))
    if str(kind) == "RANGE":
        return chr(value[0])
    return (
        OF_CATEGORY[str(value).removeprefix("CATEGORY_")] if str(kind) == "CATEGORY" else chr(value)
    )


def _member(member: tuple[Any, Any]) -> str:
    kind, value = str(member[0]), member[1]
    if kind == "RANGE":
        return f"{re.escape(chr(value[0]))}-{re.escape(chr(value[1]))}"
    if kind == "CATEGORY":
        sign = {"DIGIT": r"\d", "SPACE": r"\s", "WORD": r"\w"}
        return sign[_category(value)]
    return re.escape(chr(value))


def _category(value: Any) -> str:
    return str(value).removeprefix("CATEGORY_")
