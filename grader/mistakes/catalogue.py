"""All entries of the catalogue, root causes before what they cause."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from grader.mistakes import (
    building,
    entries,
    files,
    handed_in,
    package,
    running,
    starting,
    terminal,
    ticking,
)
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
