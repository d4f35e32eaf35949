"""What a run does (schema 2): the nodes to start, the clock, the world, and what is done when."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, ConfigDict, Field, model_validator

from grader.base.part import Part
from grader.base.yaml_model import broken
from grader.course.draw import Slot, Values, filled


def _plain(value: Any) -> Any:
    if not isinstance(value, bool | int | float | str):
        raise broken("a parameter's value must be true or false, a number or a text")
    return value


Value = Annotated[Any, AfterValidator(_plain)]
"""A parameter's value: bool, int, float or str."""


DEEDS = ("publish", "call", "set", "goal", "cancel", "spawn", "move")
"""What a stimulus can do: its keys."""


class _Part(Part):
    model_config = ConfigDict(populate_by_name=True)


class Node(_Part):
    """A node that the student writes: how it is run, its file in the inner folder, its name.

    `package` is its package if that is not the assignment's own.
    """

    package: str = Field(default="", exclude_if=lambda name: not name)
    executable: str
    target: str
    file: str
    name: str


class Start(_Part):
    """The start of a node, with what `ros2 run` gives it.

    `arguments` are the program's own words, before `--ros-args`; `params_file` is a file of
    parameters that the node's package installs, such as config/limits.yaml. A program that `exits` ends by
    itself, with status 0, before the run does: a client that asks once, for example.
    """

    node: str
    arguments: tuple[str, ...] = Field(default=(), exclude_if=lambda words: not words)
    params_file: str = Field(default="", exclude_if=lambda path: not path)
    exits: bool = Field(default=False, exclude_if=lambda given: not given)
    parameters: dict[str, Value] = Field(default_factory=dict)
    remap: dict[str, str] = Field(default_factory=dict)
    namespace: str = ""
    name: str = ""

    def shared_file(self, package: str) -> str:
        """Return where a package installs the file of parameters, from its prefix."""
        return f"share/{package}/{self.params_file}"

    def words(self, package: str, *, plain: bool = False) -> list[str]:
        """Return the words after the executable's name; `package` is the node's.

        With `plain` there are only those that the assignment names.
        """
        words = ["--ros-args"]
        if self.params_file:
            words += ["--params-file", f"install/{package}/{self.shared_file(package)}"]
        words += [] if plain else ["-p", "use_sim_time:=true"]
        for name, value in self.parameters.items():
            words += ["-p", f"{name}:={_as_yaml(value)}"]
        rules = {**self.remap}
        if self.namespace:
            rules["__ns"] = self.namespace
        if self.name:
            rules["__node"] = self.name
        for old, new in rules.items():
            words += ["-r", f"{old}:={new}"]
        return [*self.arguments, *(words if len(words) > 1 else [])]


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


class SendGoal(_Part):
    """A goal to send to an action."""

    action: str
    type: str
    values: dict[str, Any] = Field(default_factory=dict)


class Place(_Part):
    """Where a turtle is put: in m, and the heading in rad.

    The turtle is the world's first one unless it is named; a new one gets a new name.
    """

    turtle: str = ""
    x: float
    y: float
    theta: float = 0.0


class Stimulus(_Part):
    """What is done at an instant of ROS time (s): one of the keys after `at`.

    `set` has the new values of parameters for each node, `cancel` the name of a goal's stimulus.
    `spawn` and `move` put a turtle into the world.
    """

    name: str
    at: float = Field(ge=0, allow_inf_nan=False)
    publish: Publish | None = None
    call: Call | None = None
    set: dict[str, dict[str, Value]] | None = None
    goal: SendGoal | None = None
    cancel: str | None = None
    spawn: Place | None = None
    move: Place | None = None

    @property
    def typed(self) -> dict[str, Publish | Call | SendGoal]:
        """What has a type: the message, the call or the goal, by its key."""
        parts = {"publish": self.publish, "call": self.call, "goal": self.goal}
        return {key: what for key, what in parts.items() if what is not None}

    def with_types(self, named: Callable[[str], str]) -> Stimulus:
        """Return the same with other names of types."""
        update = {
            key: what.model_copy(update={"type": named(what.type)})
            for key, what in self.typed.items()
        }
        return self.model_copy(update=update)

    @model_validator(mode="after")
    def _one(self) -> Stimulus:
        if sum(getattr(self, key) is not None for key in DEEDS) != 1:
            words = f"{', '.join(DEEDS[:-1])} and {DEEDS[-1]}"
            raise broken(f"'{self.name}' must have exactly one of {words}")
        return self


class RunPlan(_Part):
    """One run: a fresh start of its nodes, beside a world if it has one.

    `topics` are recorded, with their types; the topics of the checks are added to them. `periods`
    (s) are those that the checks want of topics: at these instants a message is awaited. `kept_back`
    are the topics that only checks name which students do not see, `slots` the places of drawn values.
    """

    name: str
    world: Literal["", "turtlesim", "robot"] = ""
    start: tuple[Start, ...]
    clock: ClockPlan
    do: tuple[Stimulus, ...] = ()
    topics: dict[str, str] = Field(default_factory=dict)
    periods: dict[str, float] = Field(default_factory=dict)
    kept_back: tuple[str, ...] = ()
    slots: tuple[Slot, ...] = Field(default=(), exclude_if=lambda slots: not slots)

    def with_drawn(self, values: Values) -> RunPlan:
        """Return the same with the drawn values in their places."""
        return filled(self, self.slots, values)

    @property
    def drawn(self) -> tuple[str, ...]:
        """The names of the drawn values that it uses, each once."""
        return tuple(dict.fromkeys(name for slot in self.slots for name in slot.form.names))

    def with_types(self, named: Callable[[str], str]) -> RunPlan:
        """Return the same with other names of types."""
        topics = {topic: named(name) for topic, name in self.topics.items()}
        done = tuple(one.with_types(named) for one in self.do)
        return self.model_copy(update={"topics": topics, "do": done})

    def stimulus(self, name: str) -> Stimulus | None:
        """Return a stimulus by its name."""
        return next((one for one in self.do if one.name == name), None)


def _as_yaml(value: Value) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return f"'{value}'"
    return repr(value)
