"""Messages as JSON values of a bounded size, for the probe's other modules."""

from __future__ import annotations

import importlib
import itertools
import json
import math
import re
import subprocess
import sys
from collections.abc import Iterator
from typing import Any

CHECK_SECONDS = 20.0  # wall time, after which our own side has failed
CHECK_LIMITS = {"RLIMIT_CPU": 10, "RLIMIT_AS": 3 << 30, "RLIMIT_CORE": 0}  # seconds, bytes
LONGEST_REASON = 300
CHECK = """
import importlib, json, resource, sys
from rclpy.serialization import serialize_message
for name, most in json.loads(sys.argv[1]).items():
    limit = getattr(resource, name)
    hard = resource.getrlimit(limit)[1]
    most = most if hard == resource.RLIM_INFINITY else min(most, hard)
    resource.setrlimit(limit, (most, most))
print("begins", flush=True)
package, kind, rest = sys.argv[2].split("/")
found = getattr(importlib.import_module(package + "." + kind), rest)
names = {"srv": ("Request", "Response"), "action": ("Goal", "Result", "Feedback")}
for part in [getattr(found, name) for name in names.get(kind, ())] or [found]:
    serialize_message(part())
"""
OF_MESSAGE = re.compile(r"([a-z][a-z0-9_]*)/(\w+)")  # in the type of a list's field
MOST_VALUES = 400  # numbers and texts of a message
LONGEST_TEXT = 2_000  # characters


def interface(name: str) -> Any:
    """Return the class of a type such as geometry_msgs/msg/Twist; None if there is none."""
    package, kind, rest = (*name.split("/"), "", "")[:3]
    try:
        return getattr(importlib.import_module(f"{package}.{kind}"), rest, None)
    except (ImportError, ValueError):
        return None


def why_unusable(name: str) -> str:
    """Return why the class of a type that a student wrote cannot be used; "" if it can.

    Another process tries it first: whatever the class does there, the probe goes on. Raises
    RuntimeError if that process does not begin, and TimeoutExpired: our own side has failed.
    """
    command = [sys.executable, "-c", CHECK, json.dumps(CHECK_LIMITS), name]
    done = subprocess.run(command, capture_output=True, timeout=CHECK_SECONDS, check=False)
    if not done.stdout.startswith(b"begins"):
        raise RuntimeError(done.stderr.decode("utf-8", "replace"))
    if done.returncode == 0:
        return ""
    rows = done.stderr.decode("utf-8", "replace").strip().splitlines()
    return (rows[-1] if rows else f"status {done.returncode}")[:LONGEST_REASON]


def fields_of(value: Any) -> dict[str, str]:
    """Return the fields of a message with their types; none of what is no message.

    They are read from the class: a field may have the name of one of its methods.
    """
    found = getattr(type(value), "_fields_and_field_types", None)
    return found if isinstance(found, dict) else {}


def is_message(value: Any) -> bool:
    """Whether a value is a message, also one without fields."""
    return isinstance(getattr(type(value), "_fields_and_field_types", None), dict)


def taken_from(subscription: Any, most: int) -> Iterator[Any]:
    """Take the messages that have arrived at a subscription, at most so many, and yield them."""
    for _ in range(most):
        with subscription.handle:
            taken = subscription.handle.take_message(subscription.msg_type, False)
        if taken is None:
            return
        yield taken[0]


FLOATS = ("double", "float")
TINY = 5e-324


def as_sent(kind: str, value: Any) -> Any:
    """Return what arrives of a field of a type: ROS copies a whole number's bytes into a float field."""
    if type(value) is int and kind in FLOATS:
        return TINY if value else 0.0
    return value


def is_sent_as_it_is(message: Any) -> bool:
    """Whether no field of a message arrives as something else."""
    for name, kind in fields_of(message).items():
        value = getattr(message, name)
        other = is_message(value) and not is_sent_as_it_is(value)
        if other or as_sent(kind, value) is not value:
            return False
    return True


class Values:
    """Turns messages into JSON values, of a bounded size."""

    def __init__(self) -> None:
        self.left = MOST_VALUES

    def of(self, value: Any) -> Any:
        """Return a field's value: a number, a text, a list, or a mapping of fields."""
        self.left -= 1
        if is_message(value):
            fields = fields_of(value)
            return {
                name: self.of(as_sent(kind, getattr(value, name)))
                for name, kind in fields.items()
                if self.left > 0
            }
        if isinstance(value, bytes):
            return (
                int.from_bytes(value, "little") if len(value) == 1 else value[:LONGEST_TEXT].hex()
            )
        if isinstance(value, str):
            return value[:LONGEST_TEXT]
        if isinstance(value, (bool, int)):
            return value
        if isinstance(value, float):
            return value if math.isfinite(value) else str(value)
        if hasattr(value, "ndim"):  # numpy
            return self.of(value[: self.left + 1].tolist() if value.ndim else value.item())
        items = itertools.islice(value, max(0, self.left))
        return [self.of(item) for item in items if self.left > 0]


def fill(message: Any, values: Any) -> None:
    """Set the fields of a message from a mapping; raises AttributeError, TypeError, AssertionError."""
    if hasattr(message, "_check_fields"):  # (else the middleware ends the process, from jazzy on)
        message._check_fields = True
    for name, value in values.items():
        inner = getattr(message, name)
        if is_message(inner):
            fill(inner, value)
        elif isinstance(inner, float):
            setattr(message, name, float(value))
        elif isinstance(value, list):
            setattr(message, name, _items(fields_of(message)[name], value))
        else:
            setattr(message, name, value)


def _items(kind: str, values: list[Any]) -> list[Any]:
    """Return the items of a list's field: `kind` is such as `sequence<geometry_msgs/Point>`."""
    of = OF_MESSAGE.search(kind)
    if of is None:
        return [float(value) for value in values] if "double" in kind or "float" in kind else values
    made = [interface(f"{of[1]}/msg/{of[2]}")() for _ in values]
    for item, value in zip(made, values):
        fill(item, value)
    return made
