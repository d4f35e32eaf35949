"""YAML with the place of every value, so that an error can name file, line and column.

Read with PyYAML's safe loader. Refused, because a definition that is data does not need them:
aliases (they can multiply), tags other than YAML's plain ones, several documents, duplicate keys.
"""

from __future__ import annotations

import os
import stat
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from grader.base.errors import AssignmentError
from grader.base.nearest import meant, nearest_path

MOST_BYTES = 1_000_000
MOST_LEVELS = 50

Loc = tuple["str | int", ...]
"""The path from the root to a value: keys and indexes."""
Spot = tuple[int, int]
"""A line and a column, both counted from 1."""
START: Spot = (1, 1)


@dataclass(frozen=True)
class Document:
    """The plain data of a YAML file (lists are tuples), and where each value begins.

    A value with a key begins at the key.
    """

    path: Path
    content: Any
    spots: dict[Loc, Spot]

    def spot(self, loc: Loc) -> Spot:
        """Return where a value is, or the nearest parent that exists."""
        for end in range(len(loc), -1, -1):
            if loc[:end] in self.spots:
                return self.spots[loc[:end]]
        return START

    def line(self, loc: Loc) -> int:
        """Return the line of `spot`."""
        return self.spot(loc)[0]

    def error(self, loc: Loc, text: str) -> AssignmentError:
        """Return an error about the value at `loc`."""
        return fault(self.path, self.spot(loc), text)


def fault(path: Path, spot: Spot, text: str) -> AssignmentError:
    """Return an error in the form that editors open: `file:line:column: text`."""
    return AssignmentError(located(path, spot, text))


def located(path: Path, spot: Spot, text: str) -> str:
    """Return a message with its place."""
    return f"{path}:{spot[0]}:{spot[1]}: {text}"


def read_yaml(path: Path) -> Document:
    """Read one YAML file.

    Raises AssignmentError, with file, line and column, if it is missing, cannot be read, is not UTF-8, is
    not YAML or uses what is refused here.
    """
    text = _decode(path, _read(path))
    try:
        loader = yaml.SafeLoader(text)
        node = loader.get_single_node()
        if node is None:
            raise fault(path, START, "the file is empty")
        spots: dict[Loc, Spot] = {}
        content = _Builder(path, loader, spots).build(node, ())
    except yaml.MarkedYAMLError as error:
        raise _not_yaml(path, error) from None
    except yaml.reader.ReaderError as error:
        character = text[error.position]
        raise fault(
            path,
            _spot_of(text, error.position),
            f"a character that YAML forbids: U+{ord(character):04X}",
        ) from None
    except (RecursionError, ValueError) as error:
        raise fault(path, START, f"not YAML that can be used: {error}") from None
    return Document(path, content, spots)


def _spot_of(text: str, position: int) -> Spot:
    line_start = text.rfind("\n", 0, position) + 1
    return text.count("\n", 0, position) + 1, position - line_start + 1


def _read(path: Path) -> bytes:
    try:
        # a named pipe would wait forever for a writer
        handle = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
        with os.fdopen(handle, "rb") as file:
            if not stat.S_ISREG(os.fstat(handle).st_mode):
                raise fault(path, START, "not a file")
            found = file.read(MOST_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        hint = meant(nearest_path(path)) if isinstance(error, FileNotFoundError) else ""
        raise fault(path, START, f"cannot be read: {reason}{hint}") from None
    if len(found) > MOST_BYTES:
        raise fault(path, START, f"larger than {MOST_BYTES // 1000} kB")
    return found


def _decode(path: Path, found: bytes) -> str:
    try:
        return found.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        before = found[: error.start].decode("utf-8-sig")
        spot = _spot_of(before, len(before))
        raise fault(path, spot, "not UTF-8 text") from None


def _not_yaml(path: Path, error: yaml.MarkedYAMLError) -> AssignmentError:
    mark = error.problem_mark or error.context_mark
    problem = error.problem or error.context or "cannot be parsed"
    hint = ""
    if "mapping values are not allowed" in problem:
        hint = " (a text with ': ' in it needs quotes)"
    if "cannot start any token" in problem and "\\t" in problem:
        hint = " (indent with spaces, never with tabs)"
    return fault(path, _of_mark(mark) if mark else START, f"not YAML: {problem}{hint}")


def _of_mark(mark: Any) -> Spot:
    return mark.line + 1, mark.column + 1


class _Builder:
    def __init__(self, path: Path, loader: yaml.SafeLoader, spots: dict[Loc, Spot]) -> None:
        self._path = path
        self._loader = loader
        self._spots = spots
        self._seen: set[int] = set()

    def build(self, node: yaml.Node, loc: Loc) -> Any:
        spot = _of_mark(node.start_mark)
        self._spots.setdefault(loc, spot)
        if id(node) in self._seen:
            raise fault(self._path, spot, "an anchor (&) with an alias (*): write the value twice")
        if len(loc) > MOST_LEVELS:
            raise fault(self._path, spot, f"more than {MOST_LEVELS} levels deep")
        self._seen.add(id(node))
        if isinstance(node, yaml.MappingNode) and node.tag == "tag:yaml.org,2002:map":
            return self._mapping(node, loc)
        if isinstance(node, yaml.SequenceNode) and node.tag == "tag:yaml.org,2002:seq":
            return tuple(self.build(child, (*loc, i)) for i, child in enumerate(node.value))
        if isinstance(node, yaml.ScalarNode):
            return self._loader.construct_object(node)
        raise fault(self._path, spot, f"the tag {node.tag} is not allowed")

    def _mapping(self, node: yaml.MappingNode, loc: Loc) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for key_node, value_node in node.value:
            spot = _of_mark(key_node.start_mark)
            key = self.build(key_node, (*loc, "\0key", len(found)))
            if not isinstance(key, str):
                raise fault(self._path, spot, f"a key must be text, not {key!r}")
            place = (*loc, key)
            if key in found:
                first = self._spots[place][0]
                raise fault(
                    self._path, spot, f"the key '{key}' appears twice (first: line {first})"
                )
            self._spots[place] = spot
            found[key] = self.build(value_node, place)
        return found
