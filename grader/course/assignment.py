"""The model of an assignment: what the package must do, and the checks with their points."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, Literal

from pydantic import ConfigDict, Field

from grader.base.part import Part
from grader.course.draw import Draw, Plain, Slot, Values, filled
from grader.course.policy import Policy
from grader.course.scenario import Node, RunPlan
from grader.report.detail import FeedbackRules
from grader.report.model import Visibility
from grader.ros.distro import Distro

OWN = "own."
"""The ids of an instructor's own kinds of checks begin with it."""
TURTLESIM = ("turtlesim", "turtlesim_msgs")
"""The package of turtlesim's interfaces: `turtlesim` up to jazzy, `turtlesim_msgs` later."""
BUILT = ("example_interfaces", "tf2_msgs")
"""Other packages of interfaces without a wheel; `grader.ros.interfaces` builds them."""


class Count(Part):
    """Lines that count: `text` has `{n}` once, the place of the number."""

    text: str
    start: int = 0
    step: int = 1

    def line(self, k: int) -> str:
        """Return the text of the k-th line, counted from 0."""
        return self.text.replace("{n}", str(self.start + k * self.step))


class Output(Count):
    """The lines that the node must print; `period` is in s of ROS time."""

    period: float = Field(default=1.0, gt=0, allow_inf_nan=False)
    ticks: int = Field(default=10, ge=2)


class CheckUse(Part):
    """A check of the assignment: its points, and who sees it.

    `check` is the kind of check, the same as `id` unless it is given; `title` is what students
    read instead of the kind's title. The rest is for kinds that take it: `with_` their parameters,
    `of` a node, `run` the run that is judged, and `during` the first and the last instant (s of ROS
    time) that count, from the stimulus `after` if it is given. `slots` are the places of drawn values.
    """

    model_config = ConfigDict(populate_by_name=True)

    id: str
    points: float = Field(ge=0, allow_inf_nan=False)
    visibility: Visibility = "visible"
    check: str = ""
    title: str = Field(default="", max_length=100)
    of: str = ""
    run: str = ""
    after: str = ""
    during: tuple[float, float] | None = None
    with_: dict[str, Any] = Field(default_factory=dict, alias="with")
    slots: tuple[Slot, ...] = Field(default=(), exclude_if=lambda slots: not slots)

    @property
    def kind(self) -> str:
        """The kind of check."""
        return self.check or self.id

    def with_drawn(self, values: Values) -> CheckUse:
        """Return the same with the drawn values in their places."""
        return filled(self, self.slots, values) if self.slots else self

    def with_types(self, named: Callable[[str], str]) -> CheckUse:
        """Return the same with other names of types."""
        if "type" not in self.with_:
            return self
        return self.model_copy(
            update={"with_": {**self.with_, "type": named(str(self.with_["type"]))}}
        )


class Lesson(Part):
    """The content of an assignment's file of schema 2: nodes, and runs in which they are judged."""

    schema_: Literal[2] = Field(alias="schema")
    id: str
    title: str
    package: str
    nodes: dict[str, Node]
    runs: tuple[RunPlan, ...]
    interface_packages: tuple[str, ...] = ()
    draw: dict[str, Draw] = Field(default_factory=dict)
    modes: Literal["accept-unknown", "require"] = "accept-unknown"
    hidden_checks: int = Field(default=0, ge=0)
    limits: dict[str, float] = Field(default_factory=dict)
    checks: tuple[CheckUse, ...]
    policy: Policy = Field(default_factory=Policy)
    feedback: FeedbackRules = Field(default_factory=FeedbackRules)
    archive: str = ""

    def assignment(self) -> Assignment:
        """Return the assignment; its main node is the first that the first run starts."""
        main = self.nodes[self.runs[0].start[0].node]
        return Assignment(
            schema=2,
            id=self.id,
            title=self.title,
            package=self.package,
            node_file=main.file,
            node_name=main.name,
            executable=main.executable,
            target=main.target,
            output=Output(text="{n}"),
            modes=self.modes,
            confirm="never",
            hidden_checks=self.hidden_checks,
            limits=self.limits,
            checks=self.checks,
            policy=self.policy,
            feedback=self.feedback,
            archive=self.archive,
            nodes=self.nodes,
            runs=self.runs,
            interface_packages=self.interface_packages,
            draw=self.draw,
        )


class Assignment(Part):
    """One assignment; `course/load.py` reads it from a file.

    Of schema 1, it has one node that counts (`output`) and no `nodes` and `runs`; of schema 2, the
    names are those of the main node. `archive` is the name of the file that `lab submit` makes, with
    `{student}` for the student's name; "" for `<id>.zip`.

    `draw` is how values are drawn for each submission, `drawn` has the values of one: in an
    assignment that was loaded there are none, and the runs and checks hold the lowest.
    """

    schema_: Literal[1, 2] = Field(alias="schema")
    id: str
    title: str
    package: str
    node_file: str
    node_name: str
    executable: str
    target: str
    output: Output
    modes: Literal["accept-unknown", "require"] = "accept-unknown"
    timer: Literal["ros", "any"] = "ros"
    confirm: Literal["always", "sample", "never"] = "sample"
    hidden_checks: int = Field(default=0, ge=0)
    limits: dict[str, float] = Field(default_factory=dict)
    checks: tuple[CheckUse, ...]
    policy: Policy = Field(default_factory=Policy)
    feedback: FeedbackRules = Field(default_factory=FeedbackRules)
    archive: str = ""
    sha256: str = ""
    nodes: dict[str, Node] = Field(default_factory=dict)
    runs: tuple[RunPlan, ...] = ()
    interface_packages: tuple[str, ...] = ()
    draw: dict[str, Draw] = Field(default_factory=dict, exclude_if=lambda draw: not draw)
    drawn: dict[str, Plain] = Field(default_factory=dict, exclude_if=lambda drawn: not drawn)
    own_checks: str = Field(
        default="", exclude=True, description="the text of checks.py; it is code: never in a file"
    )

    @property
    def function(self) -> str:
        """The function of the entry point's target."""
        return self.target.partition(":")[2]

    @property
    def folder(self) -> str:
        """The inner folder: the Python package that the target names."""
        return self.target.partition(":")[0].partition(".")[0]

    @property
    def others(self) -> tuple[str, ...]:
        """The packages that are handed in beside the main one: of interfaces, and of other nodes."""
        of_nodes = (node.package for node in self.nodes.values())
        names = dict.fromkeys((*self.interface_packages, *of_nodes))
        return tuple(name for name in names if name not in ("", self.package))

    @property
    def period(self) -> float | None:
        """The s of ROS time between two lines or messages of the main node; None if it names no one."""
        if not self.runs:
            return self.output.period
        main = self.runs[0].start[0].node
        given = [use.with_.get("period") for use in self.checks if use.of in ("", main)]
        named = {float(value) for value in given if isinstance(value, int | float)}
        return named.pop() if len(named) == 1 else None

    @property
    def seconds(self) -> str:
        """The period as Python code; "…", which Python cannot read, if the assignment names none."""
        return "…" if self.period is None else repr(self.period)

    def with_drawn(self, values: Values) -> Assignment:
        """Return the assignment with the drawn values of one submission.

        Raises KeyError for a name without a value.
        """
        drawn = {name: values[name] for name in self.draw}
        return self.model_copy(
            update={
                "runs": tuple(plan.with_drawn(drawn) for plan in self.runs),
                "checks": tuple(use.with_drawn(drawn) for use in self.checks),
                "drawn": drawn,
            }
        )

    def about(self, node: str) -> Assignment:
        """Return the same with another main node: `node_file` and so on are that node's.

        The package is that of the node. An unknown node, such as "", changes nothing.
        """
        found = self.nodes.get(node)
        if found is None:
            return self
        return self.model_copy(
            update={
                "package": found.package or self.package,
                "node_file": found.file,
                "node_name": found.name,
                "executable": found.executable,
                "target": found.target,
            }
        )

    def plan(self, name: str) -> RunPlan:
        """Return a run's plan; the first one if the name is ""."""
        return next((plan for plan in self.runs if plan.name == name), self.runs[0])

    @property
    def interfaces(self) -> tuple[str, ...]:
        """The packages of interfaces that ROS must have, and that no wheel has.

        turtlesim's come with what builds the interfaces of students.
        """
        named = {name.partition("/")[0] for name in self.types()}
        turtlesim = TURTLESIM[:1] if self.interface_packages or named & {*TURTLESIM, *BUILT} else ()
        return (*turtlesim, *(name for name in BUILT if name in named))

    def on(self, distro: Distro) -> Assignment:
        """Return the assignment with the names that turtlesim's interfaces have in a distro."""
        if not self.interfaces:
            return self

        def named(name: str) -> str:
            package, slash, rest = name.partition("/")
            return (distro.turtlesim if package in TURTLESIM else package) + slash + rest

        return self.model_copy(
            update={
                "runs": tuple(plan.with_types(named) for plan in self.runs),
                "checks": tuple(use.with_types(named) for use in self.checks),
            }
        )

    def types(self) -> Iterator[str]:
        """Yield the interface types of its runs and checks; a parameter's, such as double, is none."""
        for plan in self.runs:
            yield from plan.topics.values()
            yield from (what.type for one in plan.do for what in one.typed.values())
        named = (str(use.with_.get("type", "")) for use in self.checks)
        yield from (name for name in named if "/" in name)

    @property
    def max_score(self) -> float:
        """The sum of the checks' points."""
        return sum(use.points for use in self.checks)
