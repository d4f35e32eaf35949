"""Checks that are written without a kind: their parameters are elsewhere in the assignment's file.

`{id: run.output, points: 10}` is a use of the kind `log.counts` with the values in `output:`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from operator import attrgetter
from types import MappingProxyType

from grader.course.assignment import Assignment, CheckUse


@dataclass(frozen=True)
class Shorthand:
    """A kind of check, and where the assignment has the values of its parameters."""

    kind: str
    values: Mapping[str, str]
    parameters: None = None  # that it takes itself

    @property
    def needs_output(self) -> bool:
        """Whether its values are in `output:`, which only schema 1 has."""
        return any(place.startswith("output.") for place in self.values.values())

    def use(self, use: CheckUse, assignment: Assignment) -> CheckUse:
        """Return a use of the kind, with its parameters; those of a node are each node's own."""
        if assignment.nodes and not self.needs_output:
            return use.model_copy(update={"check": self.kind, "with_": {}})
        given = {name: attrgetter(place)(assignment) for name, place in self.values.items()}
        return use.model_copy(update={"check": self.kind, "with_": given})


SHORTHANDS: Mapping[str, Shorthand] = MappingProxyType(
    {
        "run.node_name": Shorthand("graph.node_name", {"name": "node_name"}),
        "run.output": Shorthand(
            "log.counts", {"text": "output.text", "start": "output.start", "step": "output.step"}
        ),
        "run.logger": Shorthand("log.logger", {"text": "output.text"}),
        "run.period": Shorthand("log.period", {"text": "output.text", "period": "output.period"}),
    }
)


def with_kinds(assignment: Assignment) -> Assignment:
    """Return the assignment with the kind and the parameters of every check."""
    uses = tuple(
        SHORTHANDS[use.kind].use(use, assignment) if use.kind in SHORTHANDS else use
        for use in assignment.checks
    )
    return assignment.model_copy(update={"checks": uses})
