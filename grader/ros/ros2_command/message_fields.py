"""Set the fields of a message from the values of a command line, which are YAML."""

from __future__ import annotations

import array
from typing import TYPE_CHECKING, Any

from .message_yaml import is_message
from .parsing import CommandError

if TYPE_CHECKING:
    from collections.abc import Callable

    Now = Callable[[], Any]  # returns a builtin_interfaces/msg/Time

TIME, HEADER = "builtin_interfaces/Time", "std_msgs/Header"


def parse(text: str) -> dict[str, Any]:
    """Return the values of a command line; raises CommandError if they are not a YAML mapping."""
    import yaml  # noqa: PLC0415 (slow to import)

    try:
        values = yaml.safe_load(text)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        where = f" at character {mark.column + 1} of line {mark.line + 1}" if mark else ""
        problem = getattr(error, "problem", None) or str(error).partition("\n")[0]
        raise CommandError(
            f"The passed value is not valid YAML{where}: {problem}. Check the brackets, quotes and "
            f"colons of: {text}"
        ) from None
    values = {} if values is None else values
    if not isinstance(values, dict):
        raise CommandError("The passed value needs to be a dictionary in YAML format")
    return values


def fill(message: Any, values: dict[str, Any], now: Now | None = None) -> list[Callable[[], None]]:
    """Set a message's fields; return what to call before each sending, for `now` and `auto`.

    `now` gives the node's time. Raises AttributeError, TypeError or ValueError for values that do
    not fit; their texts are the real command's.
    """
    again: list[Callable[[], None]] = []
    kinds = message.get_fields_and_field_types()
    for name, value in values.items():
        old = getattr(message, name)
        kind = kinds[name]
        if is_message(old):
            again += _fill_nested(old, kind, value, now)
        else:
            setattr(message, name, _converted(old, kind, value, now))
    return again


def _fill_nested(message: Any, kind: str, value: Any, now: Now | None) -> list[Callable[[], None]]:
    if now is not None and (kind, value) in ((TIME, "now"), (HEADER, "auto")):
        stamp = message if kind == TIME else message.stamp
        return [lambda: _set_time(stamp, now())]
    if not isinstance(value, dict):
        raise TypeError(
            f"Value '{value}' is expected to be a dictionary but is a {type(value).__name__}"
        )
    return fill(message, value, now)


def _set_time(stamp: Any, time: Any) -> None:
    stamp.sec, stamp.nanosec = time.sec, time.nanosec


def _converted(old: Any, kind: str, value: Any, now: Now | None) -> Any:
    if isinstance(old, array.array):
        return array.array(old.typecode, value)
    if hasattr(old, "dtype"):
        import numpy  # type: ignore[import-not-found] # noqa: PLC0415 (slow to import)

        return numpy.array(value, dtype=old.dtype)
    if isinstance(old, list):
        return _converted_list(kind, value, now)
    if isinstance(old, bytes):
        return _byte(value)
    return type(old)(value)


def _converted_list(kind: str, value: Any, now: Now | None) -> list[Any]:
    element = kind.removeprefix("sequence<").partition("[")[0].rstrip(">").partition(",")[0]
    element = element.partition("<")[0]
    if element in ("octet", "byte"):
        return [_byte(each) for each in value]
    if "/" not in element:
        convert = {"string": str, "wstring": str, "boolean": bool}.get(element)
        return [convert(each) if convert else each for each in value]
    from .interfaces import load  # noqa: PLC0415

    messages = []
    for each in value:
        message = load(element, "msg")()
        for update in _fill_nested(message, element, each, now):
            update()
        messages.append(message)
    return messages


def _byte(value: Any) -> bytes:
    return bytes([value]) if isinstance(value, int) else str(value).encode("latin-1")
