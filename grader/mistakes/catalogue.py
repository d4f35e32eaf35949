"""All entries of the catalogue, root causes before what they cause."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from grader.mistakes import building
from grader.mistakes import entries
from grader.mistakes import files
from grader.mistakes import handed_in
from grader.mistakes import package
from grader.mistakes import running
from grader.mistakes import starting
from grader.mistakes import terminal
from grader.mistakes import ticking
from grader.mistakes.kind import Kind

# the order is the rank: of several mistakes that are recognised, the first is the root
CATALOGUE: Mapping[str, Kind] = MappingProxyType(
    {
        kind.id: kind
        for module in (
            handed_in,
            package,
            files,
            building,
            entries,
            starting,
            ticking,
            running,
            terminal,
        )
        for kind in module.KINDS
    }
)
RANK: Mapping[str, int] = MappingProxyType({name: n for n, name in enumerate(CATALOGUE)})
