"""The report of one verdict, schema 1 (fields may be added, never changed).

The JSON form is `Report.model_dump_json()`; its JSON Schema is `report.schema.json` beside this
module. All durations are seconds, all sizes bytes, `virtual` instants seconds of ROS time since
the clock started at 0, `wall` instants seconds of the epoch.
"""

from __future__ import annotations

from datetime import datetime
from typing import Literal

from pydantic import ConfigDict, Field

from grader.base.part import Part
from grader.report.detail import FeedbackRules

CheckStatus = Literal["passed", "failed", "skipped", "inconclusive", "error"]
Visibility = Literal["visible", "hidden", "after_due_date"]
Origin = Literal["directory", "zip", "tar", "git"]
Modes = Literal["recorded", "unknown"]
Quote = Literal["build_log", "transcript", "before_ctrl_c"]
"""What of `Evidence` shows why a check failed; `before_ctrl_c` is that part of the transcript."""
LIMITS_MET = ("build.timeout", "build.resource", "run.resource", "run.too_much_output")
"""The mistakes by which a limit on the submission ended what it did."""
NEAR = 1e-6  # of a value or an instant: float32 fields, and rounding
SHORTEST = 1e-3  # extent of a plot's axis


class Mistake(Part):
    """A mistake of the catalogue: a stable id and the parameters of its text."""

    id: str
    params: dict[str, str | int | float] = Field(default_factory=dict)


class Where(Part):
    """A place in the submission: `file` relative to the package, `line` counted from 1."""

    file: str
    line: int | None = None


class CheckResult(Part):
    """What one check found. `rationale` says why it matters, `fix` the one change that fixes it."""

    id: str
    title: str
    status: CheckStatus
    score: float = 0
    max_score: float
    visibility: Visibility = "visible"
    rationale: str = ""
    expected: str = ""
    actual: str = ""
    fix: str = ""
    patch: str = ""
    advice: list[str] = Field(default_factory=list)
    mistakes: list[Mistake] = Field(default_factory=list)
    where: Where | None = None
    node: str = Field(default="", description="the assignment's node that it is about, if any")
    run: str = Field(default="", description="the name of the run that it is about, if any")
    depends: list[str] = Field(default_factory=list)
    consequence_of: str = Field(
        default="", description="an earlier check that failed because of the same mistake"
    )
    blocked_by: str = Field(default="", description="the check because of which it was skipped")
    fault: str = Field(
        default="", description="of a check with status error: our traceback, not for students"
    )
    seconds: float = 0


class AssignmentInfo(Part):
    """The assignment; `sha256` of its definition distinguishes versions."""

    id: str
    title: str
    sha256: str
    due: datetime | None = Field(default=None, description="the due date, in UTC")
    feedback: FeedbackRules = Field(
        default_factory=FeedbackRules, description="how much students get to know"
    )


class SubmissionInfo(Part):
    """The submission: whose package it is, its path, and what is known about it."""

    name: str
    student_id: str | None = None
    path: str
    sha256: str
    package: str | None = None
    origin: Origin = "directory"
    modes: Modes = "recorded"
    notes: list[str] = Field(default_factory=list)


class LimitInfo(Part):
    """A limit; `held_by` enforces it (`cgroup`, `rlimit`, `grader`, `tmpfs` or `none`)."""

    value: float
    unit: str
    held_by: str


class Environment(Part):
    """The environment in which the commands ran."""

    distro: str
    ros: Literal["image", "wheels", "system"]
    sandbox: Literal["docker", "bubblewrap", "account", "none"]
    limits: dict[str, LimitInfo] = Field(default_factory=dict)
    rclpy: str = ""
    rmw: str = ""
    python: str = ""
    colcon: str = ""
    setuptools: str = ""
    image: str = ""
    grader: str = ""


class Tick(Part):
    """One line of the count: its number, its text, and its times."""

    n: int | None
    text: str
    virtual: float | None = None
    wall: float | None = None


class Exit(Part):
    """How `ros2 run` ended; `seconds` from Ctrl+C to the end."""

    status: int | None = None
    signal: int | None = None
    seconds: float | None = None


class Observed(Part):
    """What was observed during the run.

    `period` is the assignment's, in seconds; `due` the instants (virtual) at which the clock
    stopped to wait for a line, empty on the wall clock.
    """

    command: str = ""
    clock: Literal["virtual", "wall"] | None = None
    ticks: list[Tick] = Field(default_factory=list)
    nodes: list[str] = Field(default_factory=list)
    exit: Exit | None = None
    period: float | None = None
    due: list[float] = Field(default_factory=list)


class TopicInfo(Part):
    """A topic that was recorded: its type, and how many messages came."""

    name: str
    type: str
    count: int


class Band(Part):
    """The values from `low` to `high` that a check wants from `first` to `last` (s of ROS time).

    `every` is whether it wants them of every message, not of one.
    """

    check: str
    first: float
    last: float
    low: float
    high: float
    every: bool = True


class TopicPlot(Part):
    """The values of a field of a topic's messages over ROS time, for the `checks` that judge it.

    `points` are (s, value); `field` is empty if only the instants count. `due` are the instants
    at which a message is wanted, `end` is where the run ended, in s.
    """

    topic: str
    field: str = ""
    checks: list[str] = Field(default_factory=list)
    points: list[tuple[float, float]] = Field(default_factory=list)
    due: list[float] = Field(default_factory=list)
    bands: list[Band] = Field(default_factory=list)
    end: float = 0

    @property
    def times(self) -> tuple[float, float]:
        """The first and the last instant that a plot shows; they differ."""
        ends = [at for at, _ in self.points] + [band.last for band in self.bands]
        return 0.0, max([self.end, *self.due, *ends, SHORTEST])

    @property
    def values(self) -> tuple[float, float]:
        """The lowest and the highest value that a plot shows; they differ."""
        shown = [value for _, value in self.points]
        shown += [value for band in self.bands for value in (band.low, band.high)]
        low, high = min(shown, default=0.0), max(shown, default=0.0)
        room = (high - low) / 10 or max(abs(high) / 10, SHORTEST)
        return low - room, high + room

    @property
    def wrong(self) -> int:
        """How many messages have a value that is not as wanted."""
        return sum(not self.is_right(at, value) for at, value in self.points)

    def is_right(self, at: float, value: float) -> bool:
        """Whether a message's value is in each band of its instant that holds for every message."""
        return all(
            band.low - _near(band.low) <= value <= band.high + _near(band.high)
            for band in self.bands
            if band.every and band.first - NEAR <= at <= band.last + NEAR
        )


def _near(value: float) -> float:
    """Return by how much a value that went through a float32 field may differ."""
    return NEAR * max(1.0, abs(value))


class OtherProgram(Part):
    """A program that a scenario starts beside its first one, for the assignment's `node`."""

    node: str
    command: str
    ended_by_itself: bool = Field(default=False, description="before Ctrl+C")
    exit: Exit


class RunInfo(Part):
    """One run of a scenario: what was observed, and where its turtles drove.

    `observed` has the command and the exit of the first program, `others` those of the rest.

    `instants` is how many instants of ROS time the clock showed, `period` s apart (`observed`);
    `path` has points in metres by the turtle's name, `wanted` those of the path that was wanted.
    `plots` are the values that the checks of topics judge. `drawn` are the values that were drawn
    for this submission and used in this run, by their names in the assignment's `draw:`.
    """

    name: str
    drawn: dict[str, bool | int | float | str] = Field(default_factory=dict)
    node: str = Field(default="", description="of the assignment, which the first program is")
    world: str = ""
    observed: Observed = Field(default_factory=Observed)
    others: list[OtherProgram] = Field(default_factory=list)
    instants: int = 0
    topics: list[TopicInfo] = Field(default_factory=list)
    path: dict[str, list[tuple[float, float]]] = Field(default_factory=dict)
    wanted: dict[str, list[tuple[float, float]]] = Field(default_factory=dict)
    plots: list[TopicPlot] = Field(default_factory=list)


class Transcript(Part):
    """What the program of the assignment's `node` printed in a run, cut in the middle."""

    run: str
    node: str
    text: str


class Evidence(Part):
    """The texts on which the verdict is based, cut in the middle to a bounded length.

    `programs` has the parts of the transcript, if several programs ran.
    """

    build_log: str = ""
    transcript: str = ""
    programs: list[Transcript] = Field(default_factory=list)


class Timing(Part):
    """Wall time of each stage, in seconds."""

    setup: float = 0
    intake: float = 0
    build: float = 0
    run: float = 0
    total: float = 0


class Report(Part):
    """The verdict on one submission on one distro."""

    model_config = ConfigDict(populate_by_name=True)

    schema_: Literal[1] = Field(default=1, alias="schema")
    assignment: AssignmentInfo
    submission: SubmissionInfo
    environment: Environment
    status: Literal["graded", "error"]
    message: str = ""
    score: float
    max_score: float
    lang: str = "en"
    attempts: int = 1
    checks: list[CheckResult]
    observed: Observed = Field(
        default_factory=Observed, description="of the first run, if there are several"
    )
    runs: list[RunInfo] = Field(
        default_factory=list, description="the runs of an assignment of schema 2"
    )
    evidence: Evidence = Field(default_factory=Evidence)
    timing: Timing = Field(default_factory=Timing)
    started: str

    def check(self, check_id: str) -> CheckResult:
        """Return the result of one check; KeyError if the assignment does not have it."""
        for result in self.checks:
            if result.id == check_id:
                return result
        raise KeyError(check_id)

    @property
    def inconclusive(self) -> float:
        """The points that are neither given nor lost."""
        return sum(c.max_score for c in self.checks if c.status in ("inconclusive", "error"))

    @property
    def met_a_limit(self) -> bool:
        """Whether the submission met a limit of its own, which ended what it did."""
        return any(m.id in LIMITS_MET for check in self.checks for m in check.mistakes)

    @property
    def all_passed(self) -> bool:
        """Whether every check passed."""
        return self.status == "graded" and all(c.status == "passed" for c in self.checks)
