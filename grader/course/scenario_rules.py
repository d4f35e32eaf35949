"""The rules of the nodes, runs and stimuli of an assignment, and of the checks that judge them."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from typing import Any, Protocol

from grader.base.nearest import meant, meant_or_known, nearest
from grader.base.positioned_yaml import Loc
from grader.base.yaml_model import Fault
from grader.course.assignment import Assignment, CheckUse, Lesson
from grader.course.names import NAMES
from grader.course.scenario import RunPlan, Start, Stimulus
from grader.course.shorthands import OF_WORLD
from grader.course.worlds import WORLDS

EDGE = 1e-6  # s by which an instant may be off the clock's
TYPES = {"bool": bool, "integer": int, "double": float, "string": str}  # of a parameter's values


class OfStimulus(Protocol):
    """What these rules ask of a kind of check."""

    @property
    def stimulus(self) -> tuple[str, ...]:
        """What its `after` must do; empty if it needs none."""


def run_faults(lesson: Lesson) -> Iterator[Fault]:
    """Yield what is wrong with nodes, packages and runs."""
    pattern, words = NAMES["package"]
    for i, name in enumerate(lesson.interface_packages):
        if not re.fullmatch(pattern, name, re.ASCII) or name == lesson.package:
            text = f"the name of another package must be {words}, not '{name}'"
            yield ("interface_packages", i), text
    yield from _packages_of_nodes(lesson)
    for name, node in lesson.nodes.items():
        if fault := module_fault(node.target, node.file):
            yield ("nodes", name, "file"), fault
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
            yield from _start_faults(begin, (*place, "start", j))
        yield from _stimuli(plan, lesson, place)


def _start_faults(begin: Start, place: Loc) -> Iterator[Fault]:
    for k, word in enumerate(begin.arguments):
        if word == "--ros-args":
            text = "arguments are the program's own: use parameters, params_file, remap, namespace"
            yield (*place, "arguments", k), text
    parts = begin.params_file.split("/")
    if begin.params_file and (parts[0] == "" or ".." in parts):
        text = "params_file must be a path in the package, such as config/limits.yaml"
        yield (*place, "params_file"), f"{text}, not '{begin.params_file}'"


def module_fault(target: str, file: str) -> str:
    """Return what is wrong if a node's file is not the module that its entry point names."""
    module = target.partition(":")[0]
    named = f"{module.replace('.', '/')}.py"
    own = f"{module.partition('.')[0]}/{file}"
    if named == own or "." not in module:
        return ""
    return f"the file is {own}, but the target '{target}' names {named}{meant(_last(named))}"


def _last(path: str) -> str:
    """Return the name of a file that is in the inner folder itself; "" for another."""
    return path.rpartition("/")[2] if path.count("/") == 1 else ""


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
    done = [one.name for one in plan.do]
    goals = tuple(one.name for one in plan.do if one.goal is not None)
    topics = _topics(plan, lesson)
    for j, one in enumerate(plan.do):
        here: Loc = (*place, "do", j)
        if done.index(one.name) != j:
            yield (*here, "name"), f"'{one.name}' is listed twice"
        if fault := instant_fault(one, plan):
            yield (*here, "at"), fault
        for node, values in (one.set or {}).items():
            if node not in lesson.nodes:
                hint = meant_or_known(node, tuple(lesson.nodes))
                yield (*here, "set", node), f"unknown node '{node}'{hint}"
            yield from _values(values, node, lesson, (*here, "set", node))
        if one.cancel is not None and one.cancel not in goals:
            hint = meant_or_known(one.cancel, goals)
            yield (*here, "cancel"), f"unknown goal '{one.cancel}'{hint}"
        if (one.spawn or one.move) and not plan.world:
            yield (*here, "name"), f"'{one.name}' needs a world, the run '{plan.name}' has none"
        if one.publish and not any(re.fullmatch(name, one.publish.topic) for name in topics):
            topic, kind = one.publish.topic, one.publish.type
            text = (
                f"nothing else names {topic}{meant(nearest(topic, topics))}: judge it in a check, "
                f"or add `topics: {{{topic}: {kind}}}` to the run"
            )
            yield (*here, "publish", "topic"), text


def instant_fault(one: Stimulus, plan: RunPlan) -> str:
    """Return what is wrong with the instant of a stimulus."""
    period, end = plan.clock.period, plan.clock.period * plan.clock.ticks
    if one.at >= end:
        return f"'{one.name}' comes at {one.at:g} s, the run ends at {end:g} s"
    ticks = one.at / period
    if abs(ticks - round(ticks)) * period <= EDGE:
        return ""
    before, after = math.floor(ticks) * period, math.ceil(ticks) * period
    return (
        f"'{one.name}' comes at {one.at:g} s, but the clock shows a multiple of {period:g} s: "
        f"write {before:g} or {after:g}"
    )


def _topics(plan: RunPlan, lesson: Lesson) -> set[str]:
    """Return the topics that something else than a stimulus names, as regular expressions."""
    judged = (use.with_.get("topic") for use in lesson.checks)
    given = (name for begin in plan.start for name in begin.remap.values())
    names = {str(name) for name in (*judged, *given, *plan.topics) if name}
    found = {re.escape(name) for name in names}
    if plan.world:
        world = WORLDS[plan.world]
        found |= {offer.name.replace(world.first, r"\w+") for offer in world.offers}
    return found


def _values(values: Mapping[str, Any], node: str, lesson: Lesson, place: Loc) -> Iterator[Fault]:
    """Yield the values that a parameter cannot have, by the type that a check wants of it."""
    for name, value in values.items():
        kind = next(
            (
                str(use.with_.get("type", ""))
                for use in lesson.checks
                if use.kind == "parameter.declared"
                and use.with_.get("name") == name
                and _judged(use, lesson) == node
            ),
            "",
        )
        if kind in TYPES and type(value) is not TYPES[kind]:
            hint = meant(f"{value:.1f}") if kind == "double" and type(value) is int else ""
            shown = {True: "true", False: "false"}.get(value) if type(value) is bool else value
            yield (*place, name), f"{name} is of the type {kind}: it cannot be {shown!s}{hint}"


def _judged(use: CheckUse, lesson: Lesson | Assignment) -> str:
    """Return the node that a check judges."""
    start = _plan(use, lesson).start
    return use.of or (start[0].node if start else "")


def _plan(use: CheckUse, lesson: Lesson | Assignment) -> RunPlan:
    return next((plan for plan in lesson.runs if plan.name == use.run), lesson.runs[0])


def use_faults(
    lesson: Assignment, known: Mapping[str, OfStimulus] | None, *, first: int = 0
) -> Iterator[Fault]:
    """Yield what is wrong with the run, the node, the stimulus and the window that checks name.

    `first` is the check with which the document begins: above 0 it is the file of hidden checks.
    """
    names = tuple(plan.name for plan in lesson.runs)
    for i, use in enumerate(lesson.checks[first:]):
        place: Loc = ("checks", i)
        if use.run and use.run not in names:
            yield (*place, "run"), f"unknown run '{use.run}'{meant_or_known(use.run, names)}"
            continue
        if use.of and use.of not in lesson.nodes:
            hint = meant_or_known(use.of, tuple(lesson.nodes))
            yield (*place, "of"), f"unknown node '{use.of}'{hint}"
        plan = _plan(use, lesson)
        done = tuple(one.name for one in plan.do)
        if use.after and use.after not in done:
            hint = meant_or_known(use.after, done) if done else f": '{plan.name}' has none"
            yield (*place, "after"), f"unknown stimulus '{use.after}'{hint}"
        elif known is not None and use.kind in known:
            yield from _after_faults(use, plan, known[use.kind].stimulus, place)
        yield from _of_world(use, plan, place)
        yield from _window_faults(use, plan, place)


def _after_faults(
    use: CheckUse, plan: RunPlan, deeds: tuple[str, ...], place: Loc
) -> Iterator[Fault]:
    """Yield that a check names no stimulus, or one that does something else than it judges."""
    one = plan.stimulus(use.after)
    fits = tuple(other.name for other in plan.do if any(getattr(other, d) for d in deeds))
    names = f": {', '.join(fits)}" if fits else f"; the run '{plan.name}' has none"
    if not deeds:
        return
    if one is None:
        words = "a stimulus" if len(deeds) > 1 else f"a stimulus with '{deeds[0]}'"
        yield (*place, "id"), f"'{use.kind}' needs `after:` with {words}{names}"
    elif one.name not in fits:
        text = f"'{use.kind}' judges a stimulus with '{deeds[0]}', and '{use.after}' is none{names}"
        yield (*place, "after"), text
    elif one.call is not None and use.with_.get("service", one.call.service) != one.call.service:
        text = f"the stimulus '{use.after}' calls {one.call.service}"
        yield (*place, "with", "service"), text
    elif one.goal is not None and use.with_.get("action", one.goal.action) != one.goal.action:
        text = f"the stimulus '{use.after}' sends its goal to {one.goal.action}"
        yield (*place, "with", "action"), text


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


def _window_faults(use: CheckUse, plan: RunPlan, place: Loc) -> Iterator[Fault]:
    """Yield what is wrong with a check's window."""
    if use.during is None:
        return
    first, last = use.during
    if first > last:
        text = "during must be [first, last] in s, the first not above the last"
        yield (*place, "during"), text
        return
    one = plan.stimulus(use.after)
    begin, end = one.at if one is not None else 0.0, plan.clock.period * plan.clock.ticks
    if begin + last > end + EDGE:
        text = f"the window ends at {begin + last:g} s, the run '{plan.name}' at {end:g} s"
        hint = f": the last can be {end - begin:g}" if end > begin + first else ""
        yield (*place, "during"), text + hint
