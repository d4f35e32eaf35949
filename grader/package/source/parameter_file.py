"""A file of parameters (`--params-file`): for which nodes it gives values, of which types."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

import yaml

KEY = "ros__parameters"
LONGEST = 200_000  # bytes
TYPES = {"int": "integer", "float": "double", "bool": "bool", "str": "string"}
"""The types of parameters, by YAML's tags."""


@dataclass(frozen=True)
class GivenValue:
    """A value for a parameter: its text in the file, its type as ROS names it, and its line."""

    name: str
    text: str
    type: str
    line: int


@dataclass(frozen=True)
class Section:
    """The values for the nodes that have a name, which can have * and ** in it; `line` is its line."""

    node: str
    line: int
    values: tuple[GivenValue, ...]

    def is_for(self, full_name: str) -> bool:
        """Whether a node with this full name gets the values."""
        parts = self.node.strip("/").split("/")
        pattern = "".join("(/[^/]+)*" if p == "**" else f"/{_part(p)}" for p in parts)
        return re.fullmatch(pattern, full_name) is not None


def _part(text: str) -> str:
    return "[^/]+" if text == "*" else re.escape(text)


def sections_of(found: bytes) -> list[Section]:
    """Return the sections of a file; none if it is no YAML, or too long."""
    if len(found) > LONGEST:
        return []
    try:
        root = yaml.compose(found.decode("utf-8", "replace"), Loader=yaml.SafeLoader)
        return list(_sections(root, ""))
    except (yaml.YAMLError, RecursionError):
        return []


def _sections(node: yaml.Node | None, name: str) -> Iterator[Section]:
    for key, value in node.value if isinstance(node, yaml.MappingNode) else ():
        path = f"{name}/{str(key.value).strip('/')}"
        inner = value.value if isinstance(value, yaml.MappingNode) else ()
        for inner_key, given in inner:
            if inner_key.value == KEY:
                yield Section(path, key.start_mark.line + 1, tuple(_values(given, "")))
        others = [pair for pair in inner if pair[0].value != KEY]
        yield from _sections(yaml.MappingNode(value.tag, others), path)


def _values(node: yaml.Node, name: str) -> Iterator[GivenValue]:
    for key, value in node.value if isinstance(node, yaml.MappingNode) else ():
        path = f"{name}.{key.value}" if name else str(key.value)
        if isinstance(value, yaml.ScalarNode):
            type_ = TYPES.get(value.tag.rpartition(":")[2], "")
            yield GivenValue(path, value.value, type_, key.start_mark.line + 1)
        elif isinstance(value, yaml.SequenceNode):
            types = {TYPES.get(one.tag.rpartition(":")[2], "") for one in value.value}
            type_ = f"{types.pop()}_array" if len(types) == 1 else ""
            yield GivenValue(path, "", type_, key.start_mark.line + 1)
        else:
            yield from _values(value, path)
