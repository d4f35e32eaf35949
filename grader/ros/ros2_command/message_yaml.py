"""Messages as text: YAML as `ros2 topic echo` prints it, and CSV."""

from __future__ import annotations

import array
import re
import sys
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from argparse import Namespace

LONGEST = 128  # characters of a text and elements of an array that are printed by default
_ARRAY = re.compile(r"(?P<type>.+)\[(?P<size>\d+)\]")
_SEQUENCE = re.compile(r"sequence<(?P<type>[^,>]+(?:<\d+>)?)(?:, \d+)?>")


class Style(NamedTuple):
    """How much of a message is printed; `longest` None is all, `flow` is YAML's flow style."""

    longest: int | None = None
    arrays: bool = True
    strings: bool = True
    flow: bool = False


def style(args: Namespace) -> Style:
    """Return the style that the options of `ros2 topic echo` ask for."""
    longest = None if args.full_length else args.truncate_length
    return Style(longest, not args.no_arr, not args.no_str, args.flow_style)


def is_message(value: Any) -> bool:
    """Whether a field's value is itself a message."""
    return hasattr(value, "get_fields_and_field_types")


def to_yaml(message: Any, style: Style = Style()) -> str:  # noqa: B008 (a constant)
    """Return a message as YAML; it ends with a newline."""
    import yaml  # noqa: PLC0415 (slow to import)

    text: str = yaml.dump(
        to_dict(message, style),
        default_flow_style=style.flow,
        allow_unicode=True,
        sort_keys=False,
        width=sys.maxsize,
    )
    return text


def to_dict(message: Any, style: Style = Style()) -> dict[str, Any]:  # noqa: B008 (a constant)
    """Return a message as a dictionary of plain values, in the order of its fields."""
    return {
        name: _plain(getattr(message, name), kind, style)
        for name, kind in message.get_fields_and_field_types().items()
    }


def to_csv(value: Any, style: Style) -> str:
    """Return all values of a message, or of one field, separated by commas."""
    return ",".join(_cells(value, style))


def _plain(value: Any, kind: str, style: Style) -> Any:
    if is_message(value):
        return to_dict(value, style)
    if _is_array(value):
        return _plain_array(value, kind, style)
    if isinstance(value, (bytes, str)):
        if not style.strings and isinstance(value, str):
            return f"<string length: <{len(value)}>>"
        return _shortened(value, style)
    return value


def _plain_array(value: Any, kind: str, style: Style) -> Any:
    if not style.arrays:
        fixed, sequence = _ARRAY.fullmatch(kind), _SEQUENCE.fullmatch(kind)
        if fixed:
            return f"<array type: {fixed['type']}[{fixed['size']}]>"
        return f"<sequence type: {sequence['type'] if sequence else kind}, length: {len(value)}>"
    shown = value if style.longest is None else value[: style.longest]
    plain = [_plain(element, "", style) for element in _elements(shown)]
    return [*plain, "..."] if len(plain) < len(value) else plain


def _cells(value: Any, style: Style) -> list[str]:
    if is_message(value):
        fields = value.get_fields_and_field_types()
        return [cell for name in fields for cell in _cells(getattr(value, name), style)]
    if _is_array(value):
        if not style.arrays:
            return []
        shown = value if style.longest is None else value[: style.longest]
        cells = [cell for element in _elements(shown) for cell in _cells(element, style)]
        return [*cells, "..."] if len(shown) < len(value) else cells
    if isinstance(value, (bytes, str)):
        if not style.strings and isinstance(value, str):
            return []
        return [_shortened(value, style)]
    return [str(value)]


def _is_array(value: Any) -> bool:
    return isinstance(value, (list, tuple, array.array)) or hasattr(value, "dtype")


def _elements(value: Any) -> Any:
    """Return an array's elements as Python values: those of NumPy are not in YAML."""
    return value.tolist() if hasattr(value, "tolist") else value


def _shortened(value: bytes | str, style: Style) -> str:
    text = "".join(map(chr, value)) if isinstance(value, bytes) else value
    if style.longest is None or len(text) <= style.longest:
        return text
    return f"{text[: style.longest]}..."
