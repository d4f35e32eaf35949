"""What a run does (schema 2): the nodes to start, the clock, the world, and what is done when."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import AfterValidator, ConfigDict, Field, model_validator

from grader.base.part import Part
from grader.base.yaml_model import broken


def _plain(value: Any) -> Any:
    if not isinstance(value, bool | int | float | str):
        raise broken("a parameter's value must be true or false, a number or a text")
    return value


Value = Annotated[Any, AfterValidator(_plain)]
"""A parameter's value: bool, int, float or str."""


class _Part(Part):
    model_config = ConfigDict(populate_by_name=True)


class Node(_Part):
    """A node that the student writes: how it is run, its file in the inner folder, its name."""

    executable: str
    target: str
    file: str
    name: str


class Start(_Part):
    """The start of a node, with what `ros2 run … --ros-args` gives it."""

    node: str
    parameters: dict[str, Value] = Field(default_factory=dict)
    remap: dict[str, str] = Field(default_factory=dict)
    namespace: str = ""
    name: str = ""

    def arguments(self) -> list[str]:
        """Return the words after `--ros-args`."""
        words = ["-p", "use_sim_time:=true"]
        for name, value in self.parameters.items():
            words += ["-p", f"{name}:={_as_yaml(value)}"]
        rules = {**self.remap}
        if self.namespace:
            rules["__ns"] = self.namespace
        if self.name:
            rules["__node"] = self.name
        for old, new in rules.items():
            words += ["-r", f"{old}:={new}"]
        return words


class ClockPlan(_Part):
    """The instants that the clock shows: `ticks` of them, `period` s of ROS time apart."""

    period: float = Field(gt=0, allow_inf_nan=False)
    ticks: int = Field(ge=1, le=20_000)


class Publish(_Part):
    """A message to publish."""

    topic: str
    type: str
    values: dict[str, Any] = Field(default_factory=dict)


class Call(_Part):
    """A service to call."""

    service: str
    type: str
    values: dict[str, Any] = Field(default_factory=dict)


class Stimulus(_Part):
    """What is done at an instant of ROS time (s): one of publish, call and set.

    `set` has the new values of parameters for each node.
    """

    name: str
    at: float = Field(ge=0, allow_inf_nan=False)
    publish: Publish | None = None
    call: Call | None = None
    set: dict[str, dict[str, Value]] | None = None

    @model_validator(mode="after")
    def _one(self) -> Stimulus:
        if sum(one is not None for one in (self.publish, self.call, self.set)) != 1:
            raise broken(f"'{self.name}' must have exactly one of publish, call and set")
        return self


class RunPlan(_Part):
    """One run: a fresh start of its nodes, beside a world if it has one.

    `topics` are recorded, with their types; the topics of the checks are added to them. `periods`
    (s) are those that the checks want of topics: at these instants a message is awaited.
    """

    name: str
    world: Literal["", "turtlesim"] = ""
    start: tuple[Start, ...]
    clock: ClockPlan
    do: tuple[Stimulus, ...] = ()
    topics: dict[str, str] = Field(default_factory=dict)
    periods: dict[str, float] = Field(default_factory=dict)

    def stimulus(self, name: str) -> Stimulus | None:
        """Return a stimulus by its name."""
        return next((one for one in self.do if one.name == name), None)


def _as_yaml(value: Value) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return f"'{value}'"
    return repr(value)
