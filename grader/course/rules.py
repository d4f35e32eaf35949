"""The rules of an assignment that its types do not express, with the line that breaks a rule."""

from __future__ import annotations

import keyword
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Protocol

from pydantic import BaseModel, ValidationError

from grader.base.nearest import meant_or_known
from grader.base.part import Part
from grader.base.positioned_yaml import Document, Loc
from grader.base.yaml_model import Fault, error_of, model_faults, validated
from grader.course.assignment import Assignment, CheckUse, Lesson, Output
from grader.course.draw import Draw, Values
from grader.course.draw_forms import FormPlace, checked, draws_of, forms_in, slots_of, with_values
from grader.course.draw_rules import alike, draw_faults
from grader.course.interface_rules import interface_faults
from grader.course.names import NAMES
from grader.course.policy import Late, Policy, policy_faults
from grader.course.scenario import (
    Call,
    ClockPlan,
    Node,
    Place,
    Publish,
    RunPlan,
    SendGoal,
    Start,
    Stimulus,
)
from grader.course.scenario_rules import module_fault, run_faults, use_faults
from grader.course.shorthands import SHORTHANDS
from grader.report.detail import FeedbackRules

ARCHIVE = r"(?!\.)(?:[\w.-]|\{student\}){1,100}\.zip"
SCHEMA_2 = (
    "nodes",
    "runs",
    "interface_packages",
    "draw",
)  # keys of Assignment that schema 1 does not have
MADE = ("periods", "kept_back", "slots")  # fields of a part that are made from the rest of the file
ONLY_GRAPH = ("topic.subscribes", "topic.qos")  # kinds that judge no messages


class KnownCheck(Protocol):
    """What the loader asks of a kind of check."""

    @property
    def parameters(self) -> type[BaseModel] | None:
        """The model of its `with:`, None if it takes none."""

    @property
    def stimulus(self) -> tuple[str, ...]:
        """What the stimulus of its `after` must do; empty if it needs none."""


KnownChecks = Mapping[str, KnownCheck]


class HiddenChecks(Part):
    """The instructor's file of hidden checks."""

    checks: tuple[CheckUse, ...]


def check_content(
    document: Document,
    *,
    known_checks: KnownChecks | None,
    known_limits: Sequence[str] | None,
) -> Assignment:
    """Return the assignment in a document; AssignmentError lists all faults."""
    content = document.content
    if found := list(_made_faults(content)):
        raise error_of(document, found)
    if isinstance(content, dict) and content.get("schema") == 2:
        return _lesson(document, known_checks=known_checks, known_limits=known_limits)
    for key in ("sha256", "drawn", *SCHEMA_2):
        if isinstance(content, dict) and key in content:
            hint = " (it is of schema 2)" if key in SCHEMA_2 else ""
            raise document.error((key,), f"unknown key '{key}'{hint}")
    assignment = validated(document, Assignment, _keys(Assignment))
    found = [
        *_names(assignment),
        *_output(assignment.output),
        *_limits(assignment.limits, known_limits),
        *_check_uses(assignment.checks, known_checks, assignment.schema_),
        *(
            (("policy", *place), f"policy.{text}")
            for place, text in policy_faults(assignment.policy)
        ),
    ]
    if found:
        raise error_of(document, found)
    return assignment


def _made_faults(content: Any) -> Iterator[Fault]:
    """Yield the keys of runs and checks that a file cannot have, although their models do."""
    for part in ("runs", "checks"):
        items = content.get(part) if isinstance(content, Mapping) else None
        for i, item in enumerate(items if isinstance(items, tuple) else ()):
            for key in MADE:
                if isinstance(item, Mapping) and key in item:
                    yield (part, i, key), f"unknown key '{key}'"


def _lesson(
    document: Document,
    *,
    known_checks: KnownChecks | None,
    known_limits: Sequence[str] | None,
) -> Assignment:
    """Return an assignment of schema 2, judged for the extremes of its drawn values."""
    draws = draws_of(document)
    places = forms_in(document, draws)

    def judged(values: Values) -> Assignment:
        filled = with_values(document, places, values)
        return _lesson_of(filled, known_checks=known_checks, known_limits=known_limits)

    assignment = checked(draws, judged).model_copy(update={"draw": draws})
    if not draws:
        return assignment
    made = _with_slots(assignment, places)
    if found := list(draw_faults(made)):
        raise error_of(document, found)
    return made


def _with_slots(
    assignment: Assignment, places: Sequence[FormPlace], *, first: int = 0
) -> Assignment:
    """Return an assignment that knows where its drawn values stand.

    `first` is the check with which the document begins; above 0 it has no runs.
    """
    runs = assignment.runs
    if first == 0:
        runs = tuple(
            plan.model_copy(update={"slots": slots_of(places, ("runs", i))})
            for i, plan in enumerate(runs)
        )
    checks = tuple(
        use.model_copy(update={"slots": slots_of(places, ("checks", i))})
        for i, use in enumerate(assignment.checks[first:])
    )
    return assignment.model_copy(
        update={"runs": runs, "checks": assignment.checks[:first] + checks}
    )


def _lesson_of(
    document: Document,
    *,
    known_checks: KnownChecks | None,
    known_limits: Sequence[str] | None,
) -> Assignment:
    lesson = validated(document, Lesson, lesson_keys(document.content))
    found = list(run_faults(lesson))
    if found:
        raise error_of(document, found)
    assignment = lesson.assignment()
    found = [
        *_names(assignment),
        *_limits(assignment.limits, known_limits),
        *_check_uses(assignment.checks, known_checks, assignment.schema_),
        *use_faults(assignment, known_checks),
        *(
            (("policy", *place), f"policy.{text}")
            for place, text in policy_faults(assignment.policy)
        ),
    ]
    if found:
        raise error_of(document, found)
    return _with_topics(assignment, document)


def _with_topics(assignment: Assignment, document: Document, *, first: int = 0) -> Assignment:
    """Return the assignment with the topics of its checks among those that its runs record.

    Raises AssignmentError for a topic without a type, or with two, and for types and fields that
    do not exist. `first` is the check with which the document begins.
    """
    topics = {plan.name: dict(plan.topics) for plan in assignment.runs}
    public = {plan.name: set(plan.topics) - set(plan.kept_back) for plan in assignment.runs}
    for use in assignment.checks:
        if use.visibility == "visible":
            public[assignment.plan(use.run).name].add(str(use.with_.get("topic")))
    places = [
        (i, use, topics[assignment.plan(use.run).name])
        for i, use in enumerate(assignment.checks)
        if use.kind not in ONLY_GRAPH
    ]
    found: list[Fault] = []
    for i, use, known in places:
        topic, kind = use.with_.get("topic"), use.with_.get("type")
        if topic and kind and known.setdefault(topic, kind) != kind:
            text = f"{topic} has the type {known[topic]} elsewhere in this run, not {kind}"
            found.append((("checks", i - first, "with", "type"), text))
    for i, use, known in places:
        topic = use.with_.get("topic")
        if topic and topic not in known:
            run = assignment.plan(use.run).name
            text = (
                f"the type of {topic} is not known: add `topics: {{{topic}: …}}` to the run {run}"
            )
            found.append((("checks", i - first, "with", "topic"), text))
    if found:
        raise error_of(document, found)
    periods: dict[str, dict[str, float]] = {plan.name: {} for plan in assignment.runs}
    for use in assignment.checks:
        topic, period = use.with_.get("topic"), use.with_.get("period")
        if topic and period:
            periods[assignment.plan(use.run).name][topic] = float(period)
    runs = tuple(
        plan.model_copy(
            update={
                "topics": topics[plan.name],
                "periods": periods[plan.name],
                "kept_back": tuple(sorted(set(topics[plan.name]) - public[plan.name])),
            }
        )
        for plan in assignment.runs
    )
    made = assignment.model_copy(update={"runs": runs})
    found = list(interface_faults(made, first=first))
    if found:
        raise error_of(document, found)
    return made


def lesson_keys(content: Mapping[str, Any]) -> dict[Loc, tuple[str, ...]]:
    """Return the known keys of each place of a file of schema 2."""
    keys = _keys(Lesson)
    keys["policy",] = tuple(Policy.model_fields)
    keys["policy", "late"] = tuple(Late.model_fields)
    keys["feedback",] = tuple(FeedbackRules.model_fields)
    keys["draw", "*"] = tuple(Draw.model_fields)
    nodes = content.get("nodes")
    for name in nodes if isinstance(nodes, Mapping) else ():
        keys["nodes", str(name)] = tuple(Node.model_fields)
    keys["runs", "*"] = tuple(name for name in RunPlan.model_fields if name not in MADE)
    keys["runs", "*", "clock"] = tuple(ClockPlan.model_fields)
    keys["runs", "*", "start", "*"] = tuple(Start.model_fields)
    keys["runs", "*", "do", "*"] = tuple(Stimulus.model_fields)
    keys["runs", "*", "do", "*", "publish"] = tuple(Publish.model_fields)
    keys["runs", "*", "do", "*", "call"] = tuple(Call.model_fields)
    keys["runs", "*", "do", "*", "goal"] = tuple(SendGoal.model_fields)
    for key in ("spawn", "move"):
        keys["runs", "*", "do", "*", key] = tuple(Place.model_fields)
    return keys


def merge_hidden(
    assignment: Assignment,
    document: Document,
    hidden: Document,
    *,
    known_checks: KnownChecks | None,
) -> Assignment:
    """Return the assignment with the hidden checks added after the visible ones.

    They may use its drawn values.
    """
    draws = assignment.draw
    if found := list(_made_faults(hidden.content)):
        raise error_of(hidden, found)
    places = forms_in(hidden, draws)

    def judged(values: Values) -> Assignment:
        at = assignment.with_drawn(values) if draws else assignment
        filled = with_values(hidden, places, values) if places else hidden
        return _merged(at, document, filled, known_checks=known_checks)

    made = checked(draws, judged)
    if not draws:
        return made
    first = len(assignment.checks)
    made = _with_slots(made.model_copy(update={"drawn": {}}), places, first=first)
    if found := list(alike(made, first=first)):
        raise error_of(hidden, found)
    return made


def _merged(
    assignment: Assignment,
    document: Document,
    hidden: Document,
    *,
    known_checks: KnownChecks | None,
) -> Assignment:
    extra = validated(hidden, HiddenChecks, _keys(HiddenChecks)).checks
    taken = [use.id for use in assignment.checks]
    found = list(_check_uses(extra, known_checks, assignment.schema_, taken))
    if found:
        raise error_of(hidden, found)
    if len(extra) != assignment.hidden_checks:
        raise document.error(
            ("hidden_checks",),
            f"hidden_checks is {assignment.hidden_checks}, but {hidden.path} has {len(extra)}",
        )
    marked = tuple(
        use if "visibility" in use.model_fields_set else _as_hidden(use) for use in extra
    )
    merged = assignment.model_copy(update={"checks": assignment.checks + marked})
    first = len(assignment.checks)
    found = list(use_faults(merged, known_checks, first=first)) if merged.runs else []
    if found:
        raise error_of(hidden, found)
    return _with_topics(merged, hidden, first=first) if merged.runs else merged


def _as_hidden(use: CheckUse) -> CheckUse:
    return use.model_copy(update={"visibility": "hidden"})


def _keys(model: type[BaseModel]) -> dict[Loc, tuple[str, ...]]:
    """Return the known keys of each place."""
    own = _aliases(model)
    if model is Assignment:
        own = tuple(name for name in own if name not in ("sha256", "drawn", *SCHEMA_2))
    of_check = tuple(name for name in _aliases(CheckUse) if name not in MADE)
    keys: dict[Loc, tuple[str, ...]] = {(): own, ("checks", "*"): of_check}
    if "output" in own:
        keys["output",] = tuple(Output.model_fields)
        keys["policy",] = tuple(Policy.model_fields)
        keys["policy", "late"] = tuple(Late.model_fields)
        keys["feedback",] = tuple(FeedbackRules.model_fields)
    return keys


def _aliases(model: type[BaseModel]) -> tuple[str, ...]:
    return tuple(field.alias or name for name, field in model.model_fields.items())


def _names(assignment: Assignment) -> Iterator[Fault]:
    for key, (pattern, words) in NAMES.items():
        value = str(getattr(assignment, key))
        if not re.fullmatch(pattern, value, re.ASCII):
            yield (key,), f"{key} must be {words}, not '{value}'"
            continue
        parts = re.split(r"[.:]", value.removesuffix(".py"))
        reserved = [part for part in parts if keyword.iskeyword(part)]
        if reserved and key in ("package", "node_file", "target"):
            yield (key,), f"{key}: '{reserved[0]}' is a Python keyword"
    if assignment.archive and not re.fullmatch(ARCHIVE, assignment.archive, re.ASCII):
        yield (
            ("archive",),
            "archive must be a file name of letters, digits, '.', '_', '-' and {student} that ends "
            f"in .zip, not '{assignment.archive}'",
        )
    fault = "" if assignment.nodes else module_fault(assignment.target, assignment.node_file)
    if fault:
        yield ("node_file",), fault
    if assignment.package == "test":
        yield ("package",), "package: an ament_python package cannot be named 'test'"
    if not assignment.title.strip():
        yield ("title",), "title is empty"


def _output(output: Output) -> Iterator[Fault]:
    count = output.text.count("{n}")
    if count != 1:
        yield ("output", "text"), f"output.text must contain {{n}} exactly once, not {count} times"
    if not output.text.isprintable():
        yield ("output", "text"), "output.text must be one line, without control characters"
    if output.step == 0:
        yield ("output", "step"), "output.step must not be 0: every line would be the same"


def _limits(limits: dict[str, float], known: Sequence[str] | None) -> Iterator[Fault]:
    for name, value in limits.items():
        if known is not None and name not in known:
            yield ("limits", name), f"unknown limit '{name}'{meant_or_known(name, known)}"
        if not (value > 0 and math.isfinite(value)):
            yield ("limits", name), f"limits.{name} must be a number above 0, not {value:g}"


def _check_uses(
    uses: Sequence[CheckUse], known: KnownChecks | None, schema: int, taken: Sequence[str] = ()
) -> Iterator[Fault]:
    if known is not None:
        known = {**known, **{s: one for s, one in SHORTHANDS.items() if one.kind in known}}
    if not uses and not taken:
        yield ("checks",), "checks is empty: an assignment needs at least one check"
    seen = set(taken)
    for i, use in enumerate(uses):
        if known is not None and use.kind not in known:
            yield (
                ("checks", i, "check" if use.check else "id"),
                f"unknown check '{use.kind}'{meant_or_known(use.kind, tuple(known))}",
            )
        elif use.id in seen:
            yield ("checks", i, "id"), f"the check '{use.id}' is listed twice"
        elif known is not None:
            yield from _parameters(use, known[use.kind].parameters, ("checks", i, "with"))
            yield from _of_schema(use, schema, ("checks", i, "check" if use.check else "id"))
        seen.add(use.id)


def _of_schema(use: CheckUse, schema: int, place: Loc) -> Iterator[Fault]:
    """Yield that a check needs `output:` but has none, or parameters of its own beside it."""
    for name, short in SHORTHANDS.items():
        if short.needs_output and schema == 1 and use.kind == short.kind:
            yield place, f"the parameters of '{use.kind}' are in output: of schema 1: use {name}"
        if short.needs_output and schema == 2 and use.kind == name:
            yield place, f"'{name}' needs output: of schema 1: use {short.kind} with its parameters"


def _parameters(use: CheckUse, model: type[BaseModel] | None, place: Loc) -> Iterator[Fault]:
    """Yield what is wrong with the parameters of a check."""
    if model is None:
        if use.with_:
            yield place, f"the check '{use.kind}' takes no parameters"
        return
    try:
        model.model_validate(use.with_, strict=True)
    except ValidationError as error:
        for loc, text in model_faults(error, {(): _aliases(model)}):
            yield (*place, *loc), text
