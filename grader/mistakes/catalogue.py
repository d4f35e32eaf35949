"""All entries of the catalogue, root causes before their consequences."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from grader.mistakes import (
    build,
    entry_points,
    node_callbacks,
    node_file,
    node_start,
    package,
    run,
    submission,
    terminal,
)
from grader.mistakes.kind import Kind

# the order is the rank: of several recognised mistakes, the first is the root cause
CATALOGUE: Mapping[str, Kind] = MappingProxyType(
    {
        kind.id: kind
        for module in (
            submission,
            package,
            node_file,
            build,
            entry_points,
            node_start,
            node_callbacks,
            run,
            terminal,
        )
        for kind in module.KINDS
    }
)
RANK: Mapping[str, int] = MappingProxyType({name: n for n, name in enumerate(CATALOGUE)})
