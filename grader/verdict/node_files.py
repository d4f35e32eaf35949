"""Finds the files that may contain the mistake: the node's own, and the modules it imports."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from grader.package.source.node import NodeSource, read_node
from grader.verdict.checks.parsed import file_of, names_in, node_path

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

MOST_MODULES = 10  # modules searched in addition to the node's file


@dataclass(frozen=True)
class NodeFile:
    """A file of the package: its path in the package, and its source."""

    path: str
    source: NodeSource


def file_at(evidence: Evidence, path: str) -> NodeFile | None:
    """Return a file of the package; None if it does not exist or Python cannot read it."""
    file = file_of(evidence, path)
    source = read_node(file.data) if file is not None and not file.unreadable else None
    return NodeFile(path, source) if source is not None else None


def file_with_main(evidence: Evidence) -> NodeFile | None:
    """Return the node's file; None if the node's class is in another module."""
    found = file_at(evidence, node_path(evidence))
    return None if found is None or _imports_the_node(found, evidence) else found


def file_with_node(evidence: Evidence) -> NodeFile | None:
    """Return the file with the node's class: the node's file, or a module that it imports."""
    found = file_at(evidence, node_path(evidence))
    if found is None or not _imports_the_node(found, evidence):
        return found
    inner = evidence.assignment.package
    for name in sorted(names_in(evidence, inner))[:MOST_MODULES]:
        other = file_at(evidence, f"{inner}/{name}") if name.endswith(".py") else None
        if other is not None and other.source.uses_ros and other.source.node_class is not None:
            return other
    return None


def _imports_the_node(found: NodeFile, evidence: Evidence) -> bool:
    own = found.source.imports_of(evidence.assignment.package)
    return own and found.source.node_class is None
