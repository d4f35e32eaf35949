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
from grader.course.interface_rules import interface_faults
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
from grader.course.shorthands import OF_WORLD, SHORTHANDS
from grader.course.worlds import WORLDS
from grader.report.detail import FeedbackRules

ARCHIVE = r"(?!\.)(?:[\w.-]|\{student\}){1,100}\.zip"
# REP 144 for packages; the ROS design article "Topic and Service name mapping" for nodes.
NAMES = {  # key: its pattern, and the pattern in words
    "id": (r"[a-z][a-z0-9_]*", "lower case letters, digits and _, starting with a letter"),
    "package": (r"[a-z][a-z0-9_]*", "lower case letters, digits and _, starting with a letter"),
    "node_name": (r"[A-Za-z_][A-Za-z0-9_]*", "letters, digits and _, not starting with a digit"),
    "executable": (
        r"[A-Za-z_][A-Za-z0-9_.-]*",
        "letters, digits, _, - and ., starting with a letter",
    ),
    "node_file": (
        r"[A-Za-z_][A-Za-z0-9_]*\.py",
        "the name of a Python file without a folder, such as my_node.py",
    ),
    "target": (
        r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)*:[A-Za-z_]\w*",
        "module.path:function, such as my_package.my_node:main",
    ),
}


SCHEMA_2 = ("nodes", "runs", "interface_packages")  # keys of Assignment that schema 1 does not have
ONLY_GRAPH = ("topic.subscribes", "topic.qos")  # kinds that judge no messages


class KnownCheck(Protocol):
    """What the loader asks of a kind of check."""

    @property
    def parameters(self) -> type[BaseModel] | None:
        """The model of its `with:`, None if it takes none."""


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
    if isinstance(content, dict) and content.get("schema") == 2:
        return _lesson(document, known_checks=known_checks, known_limits=known_limits)
    for key in ("sha256", *SCHEMA_2):
        if isinstance(content, dict) and key in content:
            hint = "" if key == "sha256" else " (it is of schema 2)"
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


def _lesson(
    document: Document,
    *,
    known_checks: KnownChecks | None,
    known_limits: Sequence[str] | None,
) -> Assignment:
    lesson = validated(document, Lesson, _lesson_keys(document.content))
    found = list(_runs(lesson))
    if found:
        raise error_of(document, found)
    assignment = lesson.assignment()
    found = [
        *_names(assignment),
        *_limits(assignment.limits, known_limits),
        *_check_uses(assignment.checks, known_checks, assignment.schema_),
        *_uses_of_runs(lesson),
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
            text = f"the type of {topic} is not known: add `topics: {{{topic}: …}}` to the run"
            found.append((("checks", i - first, "with", "topic"), text))
    if found:
        raise error_of(document, found)
    periods: dict[str, dict[str, float]] = {plan.name: {} for plan in assignment.runs}
    for use in assignment.checks:
        topic, period = use.with_.get("topic"), use.with_.get("period")
        if topic and period:
            periods[assignment.plan(use.run).name][topic] = float(period)
    runs = tuple(
        plan.model_copy(update={"topics": topics[plan.name], "periods": periods[plan.name]})
        for plan in assignment.runs
    )
    made = assignment.model_copy(update={"runs": runs})
    found = list(interface_faults(made, first=first))
    if found:
        raise error_of(document, found)
    return made


def _lesson_keys(content: Mapping[str, Any]) -> dict[Loc, tuple[str, ...]]:
    """Return the known keys of each place of a file of schema 2."""
    keys = _keys(Lesson)
    keys["policy",] = tuple(Policy.model_fields)
    keys["policy", "late"] = tuple(Late.model_fields)
    keys["feedback",] = tuple(FeedbackRules.model_fields)
    nodes = content.get("nodes")
    for name in nodes if isinstance(nodes, Mapping) else ():
        keys["nodes", str(name)] = tuple(Node.model_fields)
    keys["runs", "*"] = tuple(name for name in RunPlan.model_fields if name != "periods")
    keys["runs", "*", "clock"] = tuple(ClockPlan.model_fields)
    keys["runs", "*", "start", "*"] = tuple(Start.model_fields)
    keys["runs", "*", "do", "*"] = tuple(Stimulus.model_fields)
    keys["runs", "*", "do", "*", "publish"] = tuple(Publish.model_fields)
    keys["runs", "*", "do", "*", "call"] = tuple(Call.model_fields)
    keys["runs", "*", "do", "*", "goal"] = tuple(SendGoal.model_fields)
    for key in ("spawn", "move"):
        keys["runs", "*", "do", "*", key] = tuple(Place.model_fields)
    return keys


def _runs(lesson: Lesson) -> Iterator[Fault]:
    """Yield what is wrong with nodes, packages and runs."""
    pattern, words = NAMES["package"]
    for i, name in enumerate(lesson.interface_packages):
        if not re.fullmatch(pattern, name, re.ASCII) or name == lesson.package:
            text = f"the name of another package must be {words}, not '{name}'"
            yield ("interface_packages", i), text
    yield from _packages_of_nodes(lesson)
    names = [plan.name for plan in lesson.runs]
    if not names:
        yield ("runs",), "runs is empty: an assignment of schema 2 needs at least one run"
    for i, plan in enumerate(lesson.runs):
        place: Loc = ("runs", i)
        if not plan.start:
            yield (*place, "start"), f"the run '{plan.name}' starts no node"
        if names.index(plan.name) != i:
            yield (*place, "name"), f"the run '{plan.name}' is listed twice"
        for j, begin in enumerate(plan.start):
            if begin.node not in lesson.nodes:
                hint = meant_or_known(begin.node, tuple(lesson.nodes))
                yield (*place, "start", j, "node"), f"unknown node '{begin.node}'{hint}"
        yield from _stimuli(plan, lesson, place)


def _packages_of_nodes(lesson: Lesson) -> Iterator[Fault]:
    pattern, words = NAMES["package"]
    for name, node in lesson.nodes.items():
        place: Loc = ("nodes", name, "package")
        if node.package and not re.fullmatch(pattern, node.package, re.ASCII):
            yield place, f"package must be {words}, not '{node.package}'"
        elif node.package in lesson.interface_packages:
            yield place, f"'{node.package}' is a package of interfaces: it has no nodes"
    main = lesson.nodes.get(lesson.runs[0].start[0].node) if _starts(lesson) else None
    if main is not None and main.package not in ("", lesson.package):
        text = f"the first node of the first run must be in the package '{lesson.package}'"
        yield ("runs", 0, "start", 0, "node"), text


def _starts(lesson: Lesson) -> bool:
    return bool(lesson.runs and lesson.runs[0].start)


def _stimuli(plan: RunPlan, lesson: Lesson, place: Loc) -> Iterator[Fault]:
    end = plan.clock.period * plan.clock.ticks
    done = [one.name for one in plan.do]
    for j, one in enumerate(plan.do):
        here: Loc = (*place, "do", j)
        if done.index(one.name) != j:
            yield (*here, "name"), f"'{one.name}' is listed twice"
        if one.at >= end:
            yield (
                (*here, "at"),
                f"'{one.name}' comes at {one.at:g} s, the run ends at {end:g} s",
            )
        for node in one.set or {}:
            if node not in lesson.nodes:
                hint = meant_or_known(node, tuple(lesson.nodes))
                yield (*here, "set", node), f"unknown node '{node}'{hint}"
        goals = tuple(other.name for other in plan.do if other.goal is not None)
        if one.cancel is not None and one.cancel not in goals:
            hint = meant_or_known(one.cancel, goals)
            yield (*here, "cancel"), f"unknown goal '{one.cancel}'{hint}"
        if (one.spawn or one.move) and not plan.world:
            yield (*here, "name"), f"'{one.name}' needs a world, the run '{plan.name}' has none"


def _uses_of_runs(lesson: Lesson) -> Iterator[Fault]:
    """Yield what is wrong with the run, the node and the window that checks name."""
    names = tuple(plan.name for plan in lesson.runs)
    for i, use in enumerate(lesson.checks):
        place: Loc = ("checks", i)
        if use.run and use.run not in names:
            yield (*place, "run"), f"unknown run '{use.run}'{meant_or_known(use.run, names)}"
            continue
        if use.of and use.of not in lesson.nodes:
            hint = meant_or_known(use.of, tuple(lesson.nodes))
            yield (*place, "of"), f"unknown node '{use.of}'{hint}"
        plan = next((plan for plan in lesson.runs if plan.name == use.run), lesson.runs[0])
        done = tuple(one.name for one in plan.do)
        if use.after and use.after not in done:
            yield (
                (*place, "after"),
                f"unknown stimulus '{use.after}'{meant_or_known(use.after, done)}",
            )
        yield from _of_world(use, plan, place)
        if use.during is not None and use.during[0] > use.during[1]:
            yield (
                (*place, "during"),
                "during must be [first, last] in s, the first not above the last",
            )


def _of_world(use: CheckUse, plan: RunPlan, place: Loc) -> Iterator[Fault]:
    """Yield that a check of the world has none, or asks for what its world does not have."""
    if not use.kind.startswith(OF_WORLD):
        return
    world = WORLDS.get(plan.world)
    event = use.with_.get("event")
    if world is None:
        text = f"'{use.kind}' needs a world, the run '{plan.name}' has none"
        yield (*place, "check" if use.check else "id"), text
    elif isinstance(event, str) and event not in world.events:
        hint = meant_or_known(event, tuple(world.events))
        text = f"the world '{plan.world}' has no event '{event}'{hint}"
        yield (*place, "with", "event"), text


def merge_hidden(
    assignment: Assignment,
    document: Document,
    hidden: Document,
    *,
    known_checks: KnownChecks | None,
) -> Assignment:
    """Return the assignment with the hidden checks added after the visible ones."""
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
    return _with_topics(merged, hidden, first=first) if merged.runs else merged


def _as_hidden(use: CheckUse) -> CheckUse:
    return use.model_copy(update={"visibility": "hidden"})


def _keys(model: type[BaseModel]) -> dict[Loc, tuple[str, ...]]:
    """Return the known keys of each place."""
    own = _aliases(model)
    if model is Assignment:
        own = tuple(name for name in own if name not in ("sha256", *SCHEMA_2))
    keys: dict[Loc, tuple[str, ...]] = {(): own, ("checks", "*"): _aliases(CheckUse)}
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
