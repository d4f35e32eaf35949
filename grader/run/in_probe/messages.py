"""Messages as JSON values of a bounded size, for the probe's other modules."""

from __future__ import annotations

import importlib
import math
from collections.abc import Iterator
from typing import Any

MOST_VALUES = 400  # numbers and texts of a message
LONGEST_TEXT = 2_000  # characters


def interface(name: str) -> Any:
    """Return the class of a type such as geometry_msgs/msg/Twist; None if there is none."""
    package, kind, rest = (*name.split("/"), "", "")[:3]
    try:
        return getattr(importlib.import_module(f"{package}.{kind}"), rest, None)
    except (ImportError, ValueError):
        return None


def taken_from(subscription: Any, most: int) -> Iterator[Any]:
    """Take the messages that have arrived at a subscription, at most so many, and yield them."""
    for message, _ in taken_with_info(subscription, most):
        yield message


def taken_with_info(subscription: Any, most: int) -> Iterator[tuple[Any, Any]]:
    """Take messages as `taken_from` does; yield each with what the middleware knows of it."""
    for _ in range(most):
        with subscription.handle:
            taken = subscription.handle.take_message(subscription.msg_type, False)
        if taken is None:
            return
        yield taken


class Values:
    """Turns messages into JSON values, of a bounded size."""

    def __init__(self) -> None:
        self.left = MOST_VALUES

    def of(self, value: Any) -> Any:
        """Return a field's value: a number, a text, a list, or a mapping of fields."""
        self.left -= 1
        if hasattr(value, "get_fields_and_field_types"):
            names = value.get_fields_and_field_types()
            return {name: self.of(getattr(value, name)) for name in names if self.left > 0}
        if isinstance(value, bytes):
            return (
                int.from_bytes(value, "little") if len(value) == 1 else value.hex()[:LONGEST_TEXT]
            )
        if isinstance(value, str):
            return value[:LONGEST_TEXT]
        if isinstance(value, (bool, int)):
            return value
        if isinstance(value, float):
            return value if math.isfinite(value) else str(value)
        if hasattr(value, "item"):  # numpy
            return self.of(value.tolist())
        return [self.of(item) for item in value if self.left > 0]


def fill(message: Any, values: Any) -> None:
    """Set the fields of a message from a mapping; raises AttributeError, TypeError, AssertionError."""
    for name, value in values.items():
        inner = getattr(message, name)
        if hasattr(inner, "get_fields_and_field_types"):
            fill(inner, value)
        elif isinstance(inner, float):
            setattr(message, name, float(value))
        else:
            setattr(message, name, value)
