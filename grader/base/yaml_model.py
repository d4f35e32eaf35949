"""Checks a YAML document with a pydantic model: errors in our words, with file, line and column."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError
from pydantic_core import PydanticCustomError

from grader.base.errors import AssignmentError
from grader.base.nearest import meant_or_known, nearest
from grader.base.positioned_yaml import Document, Loc, located

Fault = tuple[Loc, str]
"""The place in the document, and the message."""
Keys = Mapping[Loc, tuple[str, ...]]
"""The known keys of each place; an index is `*`."""
M = TypeVar("M", bound=BaseModel)

TAG = "|"  # the tags of a union begin with it: they are in pydantic's places, but in no document
RULE = "rule"  # the type of the errors that `broken` makes
TYPES = {
    "string": "text (put it in quotes)",
    "int": "a whole number",
    "float": "a number",
    "datetime": "a date and time such as 2026-11-20T23:59:00+09:00, without quotes",
    "tuple": "a list",
    "dict": "a block of `key: value`",
    "model": "a block of `key: value`",
}


def validated(document: Document, model: type[M], keys: Keys) -> M:
    """Return the model of a document; AssignmentError lists all faults."""
    try:
        return model.model_validate(document.content, strict=True)
    except ValidationError as error:
        raise error_of(document, model_faults(error, keys)) from None


def error_of(document: Document, faults: Iterable[Fault]) -> AssignmentError:
    """Return one error of all faults, a line for each."""
    rows = sorted({(document.spot(loc), text) for loc, text in faults})
    return AssignmentError("\n".join(located(document.path, *row) for row in rows))


def broken(text: str) -> PydanticCustomError:
    """Return the error that a model's own validator raises; its message is `text`."""
    return PydanticCustomError(RULE, "{text}", {"text": text})


def model_faults(error: ValidationError, keys: Keys) -> Iterator[Fault]:
    """Yield pydantic's errors in our words; a misspelt key is not reported as missing too."""
    meant: set[Loc] = set()
    rest = []
    for item in error.errors(include_url=False, include_input=True):
        loc: Loc = item["loc"]
        if item["type"] != "extra_forbidden":
            rest.append(item)
            continue
        name = str(loc[-1])
        candidates = keys.get(_shape(loc[:-1]), ())
        close = nearest(name, candidates)
        meant |= {(*loc[:-1], close)} if close else set()
        yield (
            (*_place(loc[:-1]), name),
            f"unknown key '{name}'{meant_or_known(name, candidates)}",
        )
    for item in rest:
        loc = item["loc"]
        if item["type"] == "missing":
            if loc not in meant:
                yield _place(loc[:-1]), f"missing key '{loc[-1]}'"
        else:
            yield _place(loc), _wrong_value(_place(loc), item)


def _wrong_value(loc: Loc, item: Any) -> str:
    where = ".".join(str(part) for part in loc) or "the file"
    kind = str(item["type"])
    given = _shown(item.get("input"))
    wanted = TYPES.get(kind.partition("_")[0])
    if kind == RULE:
        return str(item["msg"])
    if kind.endswith("_type") and wanted:
        return f"{where} must be {wanted}, not {given}"
    bounds = item.get("ctx", {})
    if kind == "string_too_short":
        return f"{where} must not be empty"
    if kind == "greater_than":
        return f"{where} must be above {bounds['gt']:g}, not {given}"
    if kind == "greater_than_equal":
        return f"{where} must be at least {bounds['ge']:g}, not {given}"
    if kind == "literal_error":
        close = nearest(str(item.get("input")), _choices(bounds))
        hint = f" (did you mean '{close}'?)" if close else ""
        return f"{where} must be {bounds['expected']}, not {given}{hint}"
    return f"{where}: {item['msg']}, not {given}"


def _choices(bounds: Any) -> list[str]:
    return [name for name in re.findall(r"'([^']*)'", str(bounds.get("expected", ""))) if name]


def _shown(value: Any) -> str:
    if value is None:
        return "empty"
    if isinstance(value, dict | tuple):
        return "a block of `key: value`" if isinstance(value, dict) else "a list"
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "…'"


def _shape(loc: Loc) -> Loc:
    """Return a place with `*` for each index: all members of a list have the same keys."""
    return tuple("*" if isinstance(part, int) else part for part in loc)


def _place(loc: Loc) -> Loc:
    """Return a place in the document: without the tags of unions."""
    return tuple(part for part in loc if not (isinstance(part, str) and part.startswith(TAG)))
