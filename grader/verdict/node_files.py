"""Finds the source that may contain the mistake: the node's, or another module's."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from grader.package.source.node import NodeSource, read_node
from grader.verdict.checks.actual_node import actual_path
from grader.verdict.checks.parsed import data_of

if TYPE_CHECKING:
    from grader.report.model import Where
    from grader.verdict.evidence import Evidence


def source_of_node(evidence: Evidence) -> NodeSource | None:
    """Return the source of the node, which can be in several files; None if Python cannot read it."""
    return _read(evidence, actual_path(evidence))


def source_around(evidence: Evidence, where: Where | None) -> NodeSource | None:
    """Return the source that a place is in: the node's, or a module that is not part of it."""
    source = source_of_node(evidence)
    known = source is not None and where is not None and where.file in source.paths
    return source if where is None or known else _read(evidence, where.file)


def _read(evidence: Evidence, path: str) -> NodeSource | None:
    return read_node(partial(data_of, evidence), path, evidence.assignment.function)
