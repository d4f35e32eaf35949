"""All built-in checks, found in the modules beside this one, and what follows from them."""

from __future__ import annotations

import heapq
import pkgutil
from collections.abc import Iterable, Iterator, Mapping
from graphlib import TopologicalSorter
from importlib import import_module
from types import MappingProxyType

from grader.course.shorthands import SHORTHANDS
from grader.report.model import Quote
from grader.verdict import checks
from grader.verdict.checks.declare import Check


def in_order(declared: Iterable[Check]) -> dict[str, Check]:
    """Return checks by id in the order of evaluation.

    Stage by stage, each check is after those that it depends on and those in its `after`, else in
    the order of `declared`. Raises ValueError for an id that is declared twice or not at all, and
    for a circle.
    """
    found: dict[str, Check] = {}
    for check in declared:
        if check.id in found:
            raise ValueError(f"the check {check.id} is declared twice")
        found[check.id] = check
    before = {check.id: {*check.depends, *check.after} for check in found.values()}
    for check_id, others in before.items():
        if unknown := others - found.keys():
            raise ValueError(f"{check_id}: no check is declared as {', '.join(sorted(unknown))}")
    places = {check.id: (check.stage.rank, n) for n, check in enumerate(found.values())}
    sorter = TopologicalSorter(before)
    sorter.prepare()
    ready: list[tuple[tuple[int, int], str]] = []
    ordered: dict[str, Check] = {}
    while sorter.is_active():
        for check_id in sorter.get_ready():
            heapq.heappush(ready, (places[check_id], check_id))
        _, check_id = heapq.heappop(ready)
        ordered[check_id] = found[check_id]
        sorter.done(check_id)
    return ordered


def _declared() -> Iterator[Check]:
    """Yield the checks of each module beside this one, in the order of the source."""
    names = (f"{checks.__name__}.{module.name}" for module in pkgutil.iter_modules(checks.__path__))
    for name in sorted(set(names) - {__name__}):
        for found in vars(import_module(name)).values():
            if isinstance(found, Check) and found.function.__module__ == name:
                yield found


CHECKS: Mapping[str, Check] = MappingProxyType(in_order(_declared()))
STATIC = tuple(check.id for check in CHECKS.values() if check.needs == "files")
"""The checks that the package's files usually decide."""
_NAMED = {**CHECKS, **{name: CHECKS[short.kind] for name, short in SHORTHANDS.items()}}
QUOTES: Mapping[str, Quote] = MappingProxyType(
    {name: check.quotes for name, check in _NAMED.items() if check.quotes is not None}
)
"""What of the evidence shows why a check failed, by its kind or its shorthand."""
FAMILIES = tuple(dict.fromkeys(f"{check.partition('.')[0]}." for check in CHECKS))
"""The beginnings of the ids, each with its dot."""
