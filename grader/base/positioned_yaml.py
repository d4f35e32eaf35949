"""YAML with the line of every value, so that an error can name file and line.

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


@dataclass(frozen=True)
class Document:
    """The plain data of a YAML file (lists are tuples) and the line on which each value begins."""

    path: Path
    content: Any
    lines: dict[Loc, int]

    def line(self, loc: Loc) -> int:
        """Return the line of a value, or of the nearest parent that exists."""
        for end in range(len(loc), -1, -1):
            if loc[:end] in self.lines:
                return self.lines[loc[:end]]
        return 1

    def error(self, loc: Loc, text: str) -> AssignmentError:
        """Return an error about the value at `loc`."""
        return fault(self.path, self.line(loc), text)


def fault(path: Path, line: int, text: str) -> AssignmentError:
    """Return an error in the form that editors open: `file:line: text`."""
    return AssignmentError(f"{path}:{line}: {text}")


def read_yaml(path: Path) -> Document:
    """Read one YAML file.

    Raises AssignmentError, with file and line, if it is missing, cannot be read, is not UTF-8, is
    not YAML or uses what is refused here.
    """
    text = _decode(path, _read(path))
    try:
        loader = yaml.SafeLoader(text)
        node = loader.get_single_node()
        if node is None:
            raise fault(path, 1, "the file is empty")
        lines: dict[Loc, int] = {}
        content = _Builder(path, loader, lines).build(node, ())
    except yaml.MarkedYAMLError as error:
        raise _not_yaml(path, error) from None
    except yaml.reader.ReaderError as error:
        line = text.count("\n", 0, error.position) + 1
        character = text[error.position]
        raise fault(path, line, f"a character that YAML forbids: U+{ord(character):04X}") from None
    except (RecursionError, ValueError) as error:
        raise fault(path, 1, f"not YAML that can be used: {error}") from None
    return Document(path, content, lines)


def _read(path: Path) -> bytes:
    try:
        # a named pipe would wait forever for a writer
        handle = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
        with os.fdopen(handle, "rb") as file:
            if not stat.S_ISREG(os.fstat(handle).st_mode):
                raise fault(path, 1, "not a file")
            found = file.read(MOST_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        hint = meant(nearest_path(path)) if isinstance(error, FileNotFoundError) else ""
        raise fault(path, 1, f"cannot be read: {reason}{hint}") from None
    if len(found) > MOST_BYTES:
        raise fault(path, 1, f"larger than {MOST_BYTES // 1000} kB")
    return found


def _decode(path: Path, found: bytes) -> str:
    try:
        return found.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = found.count(b"\n", 0, error.start) + 1
        raise fault(path, line, "not UTF-8 text") from None


def _not_yaml(path: Path, error: yaml.MarkedYAMLError) -> AssignmentError:
    mark = error.problem_mark or error.context_mark
    problem = error.problem or error.context or "cannot be parsed"
    hint = ""
    if "mapping values are not allowed" in problem:
        hint = " (a text with ': ' in it needs quotes)"
    if "cannot start any token" in problem and "\\t" in problem:
        hint = " (indent with spaces, never with tabs)"
    return fault(path, mark.line + 1 if mark else 1, f"not YAML: {problem}{hint}")


class _Builder:
    def __init__(self, path: Path, loader: yaml.SafeLoader, lines: dict[Loc, int]) -> None:
        self._path = path
        self._loader = loader
        self._lines = lines
        self._seen: set[int] = set()

    def build(self, node: yaml.Node, loc: Loc) -> Any:
        line = node.start_mark.line + 1
        self._lines.setdefault(loc, line)
        if id(node) in self._seen:
            raise fault(self._path, line, "an anchor (&) with an alias (*): write the value twice")
        if len(loc) > MOST_LEVELS:
            raise fault(self._path, line, f"more than {MOST_LEVELS} levels deep")
        self._seen.add(id(node))
        if isinstance(node, yaml.MappingNode) and node.tag == "tag:yaml.org,2002:map":
            return self._mapping(node, loc)
        if isinstance(node, yaml.SequenceNode) and node.tag == "tag:yaml.org,2002:seq":
            return tuple(self.build(child, (*loc, i)) for i, child in enumerate(node.value))
        if isinstance(node, yaml.ScalarNode):
            return self._loader.construct_object(node)
        raise fault(self._path, line, f"the tag {node.tag} is not allowed")

    def _mapping(self, node: yaml.MappingNode, loc: Loc) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for key_node, value_node in node.value:
            line = key_node.start_mark.line + 1
            key = self.build(key_node, (*loc, "\0key", len(found)))
            if not isinstance(key, str):
                raise fault(self._path, line, f"a key must be text, not {key!r}")
            place = (*loc, key)
            if key in found:
                first = self._lines[place]
                raise fault(
                    self._path, line, f"the key '{key}' appears twice (first: line {first})"
                )
            self._lines[place] = line
            found[key] = self.build(value_node, place)
        return found
