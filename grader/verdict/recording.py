"""The evidence of one verdict as a file: what the build and the run showed, judged again later.

A recording is canonical JSON: UTF-8, sorted keys, no white space, no NaN or infinity, a line end
after it. So equal evidence is equal bytes. Bytes of a name that are not UTF-8 are escaped. Its fields are in docs/recordings.md. Checks, diagnosis,
fixes and the report work on it as they do on a build and a run; nothing is executed.
"""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext
from dataclasses import asdict
from functools import cache
from typing import Annotated, Any, Literal

from pydantic import (
    Field,
    PlainSerializer,
    PlainValidator,
    TypeAdapter,
    ValidationError,
    model_serializer,
)

from grader.base.canonical_json import canonical_json
from grader.base.errors import UsageError
from grader.base.i18n.message import Message, say
from grader.base.part import Part
from grader.course.assignment import Assignment, Output
from grader.course.draw import Plain
from grader.course.scenario import Node, RunPlan
from grader.package.submission import Submission
from grader.report.model import Environment
from grader.run.observer import Event, Watch
from grader.run.run import Run
from grader.run.session import Unobserved
from grader.run.variants import Trace
from grader.run.workspace import Build
from grader.verdict.evidence import Evidence
from grader.verdict.found_change import FoundChange, Sought

EVENT_LISTS = ("events", "before_start", "early")  # of a Watch; they share their events


@cache
def _events() -> TypeAdapter[list[Event]]:
    return TypeAdapter(list[Event])


@cache
def _run() -> TypeAdapter[Run]:
    return TypeAdapter(Run)


class RecordingError(UsageError):
    """A recording cannot be read, or is of another submission or assignment."""


def _run_as_json(run: Run) -> dict[str, Any]:
    """Return a run as a JSON value.

    The lists of a Watch share events, and which event is in which list matters: `seen` has each
    event once, and the lists hold indices into it.
    """
    lists = {name: getattr(run.watch, name) for name in EVENT_LISTS}
    seen = list({id(event): event for events in lists.values() for event in events}.values())
    place = {id(event): index for index, event in enumerate(seen)}
    found: dict[str, Any] = asdict(run)
    found["watch"] |= {name: [place[id(e)] for e in events] for name, events in lists.items()}
    found["watch"]["seen"] = _events().dump_python(seen, mode="json")
    note = run.watch.note
    found["watch"]["note"] = note.template if isinstance(note, Message) else note
    if run.seen is None:  # a run that is no scenario's
        del found["seen"], found["name"]
    else:
        _drop_empty(found["seen"], "silent", "unusable", "twins")
        for message in found["seen"]["messages"]:
            _drop_empty(message, "sender")
        for done in found["seen"]["done"]:
            _drop_empty(done, "unproven")
        for pose in found["seen"]["path"]:
            _drop_empty(pose, "put")
    if not run.others:
        del found["others"]
    for program in (found, *found.get("others", ())):
        _drop_empty(program, "instead", "beside", "began")
    del found["exits"], found["done"]  # (what the plan says of a program is not recorded)
    if not run.watch.silent:  # of no watch on the wall clock
        del found["watch"]["silent"]
    if run.watch.still_answers is None:
        del found["watch"]["still_answers"]
    return found


def _drop_empty(found: dict[str, Any], *names: str) -> None:
    """Leave out fields without a value: recordings of an earlier grader do not have them."""
    for name in names:
        if not found[name]:
            del found[name]


def _run_from_json(value: Any) -> Run:
    if isinstance(value, Run):
        return value
    watch = dict(value["watch"])
    seen = _events().validate_python(watch.pop("seen"))
    lists = {name: [seen[index] for index in watch.pop(name)] for name in EVENT_LISTS}
    note = watch.pop("note")
    run = _run().validate_python({**value, "watch": Watch(**watch)})
    for name, events in lists.items():
        setattr(run.watch, name, events)
    run.watch.note = say(note) if note else ""
    return run


RecordedRun = Annotated[Run, PlainValidator(_run_from_json), PlainSerializer(_run_as_json)]


class Asked(Part):
    """What the build and the run depend on in an assignment, with the values that were drawn."""

    id: str
    package: str
    executable: str
    output: Output
    nodes: dict[str, Node] = Field(default_factory=dict)
    runs: tuple[RunPlan, ...] = ()
    drawn: dict[str, Plain] = Field(default_factory=dict, exclude_if=lambda drawn: not drawn)

    @model_serializer(mode="wrap")
    def _without_scenarios(self, handler: Any) -> dict[str, Any]:
        """Leave out the keys of schema 2 in a recording of schema 1."""
        found: dict[str, Any] = handler(self)
        if not self.runs:
            del found["nodes"], found["runs"]
        return found


class Recording(Part):
    """What one build and one run showed.

    `build` and `run` are None if no check needed them; `unobserved` is the reason if the run was
    tried and could not be observed. In JSON, `run` lists its events once (see `_run_as_json`).
    `scenarios` are the runs of an assignment of schema 2, and `unobserved_runs` the reasons by name.
    `fixed` has the recordings of the package with the fixes that were tried, by the fix's SHA-256,
    `found_changes` the small changes after which the node counts, `trace` what a followed run showed,
    `sought` what short runs of a scenario showed of each failed check, by its id.
    """

    schema_: Literal[1] = Field(default=1, alias="schema")
    asked: Asked
    submission: str = Field(description="the SHA-256 of the submission, its modes included")
    environment: Environment
    build: Build | None = None
    run: RecordedRun | None = None
    unobserved: str = ""
    scenarios: tuple[RecordedRun, ...] = ()
    unobserved_runs: dict[str, str] = Field(default_factory=dict)
    fixed: dict[str, Recording] = Field(default_factory=dict)
    found_changes: tuple[FoundChange, ...] = ()
    trace: Trace | None = None
    sought: dict[str, Sought] = Field(default_factory=dict)

    @model_serializer(mode="wrap")
    def _without_scenarios(self, handler: Any) -> dict[str, Any]:
        """Leave out the keys of schema 2 in a recording of schema 1, and fixes if there are none."""
        found: dict[str, Any] = handler(self)
        left_out = [] if self.asked.runs else ["scenarios", "unobserved_runs"]
        left_out += [
            key for key in ("fixed", "found_changes", "trace", "sought") if not getattr(self, key)
        ]
        for key in left_out:
            found.pop(key, None)  # (pydantic calls this twice for a recording in a recording)
        if self.build is not None and not self.build.faults:
            found["build"].pop("faults", None)
        return found

    def to_bytes(self) -> bytes:
        """Return the recording as canonical JSON.

        Raises ValueError for a number that JSON does not have.
        """
        return canonical_json(self.model_dump(mode="json", by_alias=True))

    @classmethod
    def from_bytes(cls, content: bytes, *, name: str = "the recording") -> Recording:
        """Read a recording; `name` is for the message of a RecordingError."""
        try:
            return cls.model_validate_json(content)
        except (ValidationError, LookupError, TypeError, ValueError) as error:
            raise RecordingError(f"{name} is not a recording of schema 1: {error}") from None


def record(evidence: Evidence, environment: Environment) -> Recording:
    """Return the recording of a verdict's evidence after its last check."""
    return Recording(
        asked=_asked(evidence.asked),
        submission=evidence.submission.sha256,
        environment=environment,
        build=evidence.build if evidence.was_built else None,
        run=evidence.run if evidence.has_run and not evidence.asked.runs else None,
        scenarios=evidence.runs,
        unobserved_runs=evidence.unobserved,
        unobserved="" if evidence.run_failed is None else evidence.run_failed.reason,
        fixed={digest: record(tried, environment) for digest, tried in evidence.tried.items()},
        found_changes=tuple(evidence.found_changes or ()),
        trace=evidence.trace if evidence.was_followed else None,
        sought=dict(evidence.sought),
    )


def as_drawn(recording: Recording, assignment: Assignment) -> Assignment:
    """Return the assignment with the values that were drawn for a recording.

    Raises RecordingError if the recording has no value of a name.
    """
    if not assignment.draw:
        return assignment
    try:
        return assignment.with_drawn(recording.asked.drawn)
    except KeyError as name:
        raise RecordingError(f"the recording has no drawn value {name}") from None


def evidence_of(recording: Recording, submission: Submission, assignment: Assignment) -> Evidence:
    """Return the evidence that a recording holds of a submission.

    Raises RecordingError if the recording is of another submission, or of an assignment whose
    build or run differs. A check that needs what was not recorded raises it too.
    """
    if recording.submission != submission.sha256:
        raise RecordingError(f"the recording is not of {submission.name} as it is now")
    if recording.asked != _asked(assignment):
        raise RecordingError(f"the recording is of another version of {assignment.id}")

    def build() -> Build:
        if recording.build is None:
            raise RecordingError("the recording has no build")
        return recording.build

    def run() -> Run:
        if recording.unobserved:
            raise Unobserved(recording.unobserved)
        if recording.run is None:
            raise RecordingError("the recording has no run")
        return recording.run

    def run_of(plan: RunPlan) -> Run:
        if plan.name in recording.unobserved_runs:
            raise Unobserved(recording.unobserved_runs[plan.name])
        for found in recording.scenarios:
            if found.name == plan.name:
                return found
        raise RecordingError(f"the recording has no run '{plan.name}'")

    def with_fix(digest: str, fixed: Submission) -> AbstractContextManager[Evidence | None]:
        found = recording.fixed.get(digest)
        return nullcontext(None if found is None else evidence_of(found, fixed, assignment))

    return Evidence(
        assignment,
        submission,
        build=build,
        run=run,
        run_of=run_of,
        with_fix=with_fix,
        search=lambda _: list(recording.found_changes),
        follow=lambda _: recording.trace,
        seek=lambda _, result: recording.sought.get(result.id, Sought()),
    )


def _asked(assignment: Assignment) -> Asked:
    return Asked(
        id=assignment.id,
        package=assignment.package,
        executable=assignment.executable,
        output=assignment.output,
        nodes=assignment.nodes,
        runs=assignment.runs,
        drawn=assignment.drawn,
    )
