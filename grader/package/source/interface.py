"""The fields and constants that the text of a .msg file declares."""

from __future__ import annotations

import re
from dataclasses import dataclass

LINE = re.compile(
    r"^(?P<type>[A-Za-z][\w/]*(?:<=\d+)?(?:\[(?:<=)?\d*\])?)\s+(?P<name>[A-Za-z]\w*)"
    r"(?:\s*=\s*(?P<constant>.+)|\s+(?P<default>.+))?$"
)
NUMBERS = re.compile(r"u?int(?:8|16|32|64)|float(?:32|64)")
NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
FIELD_NAME = re.compile(r"[a-z](?:_?[a-z0-9])*")


@dataclass(frozen=True)
class Declared:
    """One line of a .msg file that declares something: a field with its default, or a constant with its value."""

    line: int
    type: str
    name: str
    constant: str = ""
    default: str = ""


@dataclass(frozen=True)
class MessageText:
    """What a .msg file declares, and the numbers of the lines that declare nothing known."""

    declared: tuple[Declared, ...]
    unknown: tuple[int, ...]

    def field(self, name: str) -> Declared | None:
        """Return the field with a name; None if there is none."""
        return next((one for one in self.declared if (one.name, one.constant) == (name, "")), None)


def message_text(text: str) -> MessageText:
    """Return what the text of a .msg file declares."""
    declared: list[Declared] = []
    unknown: list[int] = []
    for number, line in enumerate(text.splitlines(), start=1):
        code = line.partition("#")[0].strip()
        found = LINE.match(code)
        if found and not _is_comment(found["type"], (found["default"] or "").strip()):
            constant, default = ((found[key] or "").strip() for key in ("constant", "default"))
            declared.append(Declared(number, found["type"], found["name"], constant, default))
        elif code:
            unknown.append(number)
    return MessageText(tuple(declared), tuple(unknown))


def _is_comment(kind: str, default: str) -> bool:
    """Whether what is behind a number's name cannot be its default: a comment without its sign."""
    numeric = NUMBERS.fullmatch(kind) is not None
    return bool(default) and numeric and NUMBER.fullmatch(default) is None
