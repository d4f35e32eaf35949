"""What checks leave out, because it is elsewhere in the assignment's file.

`{id: run.output, points: 10}` is a use of the kind `log.counts` with the values in `output:`. A
check of the world is about what moves in the run's world from the beginning, unless it names another.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from operator import attrgetter
from types import MappingProxyType

from grader.course.assignment import Assignment, CheckUse
from grader.course.worlds import WORLDS

OF_WORLD = "world."
"""The kinds of the checks of the world begin with it."""


@dataclass(frozen=True)
class Shorthand:
    """A kind of check, and where the assignment has the values of its parameters."""

    kind: str
    values: Mapping[str, str]
    parameters: None = None  # that it takes itself
    stimulus: tuple[str, ...] = ()

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
        SHORTHANDS[use.kind].use(use, assignment)
        if use.kind in SHORTHANDS
        else _with_turtle(use, assignment)
        for use in assignment.checks
    )
    return assignment.model_copy(update={"checks": uses})


def _with_turtle(use: CheckUse, assignment: Assignment) -> CheckUse:
    """Return a check of the world with the name of what it judges; any other check as it is."""
    if not use.kind.startswith(OF_WORLD) or not assignment.runs:
        return use
    world = WORLDS.get(assignment.plan(use.run).world)
    if world is None:
        return use
    return use.model_copy(update={"with_": {"turtle": world.first, **use.with_}})
