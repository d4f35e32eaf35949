"""Types of messages by their names, and their numeric fields by paths such as `pose.x`."""

from __future__ import annotations

import importlib
import math
import re
from collections.abc import Iterator
from typing import Any

NAME = re.compile(r"([a-z][a-z0-9_]*)/msg/([A-Z][A-Za-z0-9]*)")
NUMBERS = {
    *("float", "double", "boolean", "octet", "long double"),
    *(f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)),
}
ARRAY = re.compile(r"(.+)\[(\d+)\]")
SEQUENCE = re.compile(r"sequence<(.+?)(?:, \d+)?>")
STEP = re.compile(r"([A-Za-z_][A-Za-z0-9_]*)((?:\[\d+\])*)")
INDEX = re.compile(r"\[(\d+)\]")
MOST_ELEMENTS = 8  # of an array that are offered
MOST_FIELDS = 200
MOST_DEPTH = 6


def message_type(name: str) -> Any:
    """Return the class of a message type such as std_msgs/msg/Int32; None if it is not installed."""
    match = NAME.fullmatch(name)
    if match is None:
        return None
    try:
        found = getattr(importlib.import_module(f"{match[1]}.msg"), match[2], None)
        if found is not None:
            found.__class__.__import_type_support__()
    except Exception:  # whatever a package of interfaces does when it is imported
        return None
    return found


def numeric_fields(kind: Any) -> list[str]:
    """Return the paths of a message type's numeric fields, of arrays the first elements."""
    found: list[str] = []
    for path in _fields(kind, "", 0):
        if len(found) == MOST_FIELDS:
            break
        found.append(path)
    return found


def _fields(kind: Any, prefix: str, depth: int) -> Iterator[str]:
    for name, type_name in kind.get_fields_and_field_types().items():
        if name != "structure_needs_at_least_one_member":
            yield from _paths(type_name, prefix + name, depth)


def _paths(type_name: str, path: str, depth: int) -> Iterator[str]:
    if type_name in NUMBERS:
        yield path
        return
    array, sequence = ARRAY.fullmatch(type_name), SEQUENCE.fullmatch(type_name)
    if array or sequence:
        element = (array or sequence)[1]  # type: ignore[index]
        count = min(int(array[2]), MOST_ELEMENTS) if array else MOST_ELEMENTS
        for index in range(count):
            yield from _paths(element, f"{path}[{index}]", depth + 1)
        return
    inner = message_type(type_name.replace("/", "/msg/")) if "/" in type_name else None
    if inner is not None and depth < MOST_DEPTH:
        yield from _fields(inner, path + ".", depth + 1)


def number_at(message: Any, path: str) -> float | None:
    """Return the number at a path; None if there is none or it is not finite."""
    value: Any = message
    for part in path.split("."):
        step = STEP.fullmatch(part)
        if step is None:
            return None
        value = getattr(value, step[1], None)
        for index in INDEX.findall(step[2]):
            try:
                value = value[int(index)]
            except (IndexError, TypeError, KeyError):
                return None
    try:
        number = float(value[0] if isinstance(value, bytes) else value)
    except (TypeError, ValueError, IndexError):
        return None
    return number if math.isfinite(number) else None
