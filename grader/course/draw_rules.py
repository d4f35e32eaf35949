"""The rules of drawn values: each is used, its instants fit, and it can be told from what was before."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from pydantic import ValidationError

from grader.base.positioned_yaml import Loc
from grader.base.yaml_model import Fault
from grader.course.assignment import Assignment, CheckUse
from grader.course.draw import (
    MOST_TOGETHER,
    Computed,
    Draw,
    Plain,
    Slot,
    combinations,
    count_of,
    shown,
)
from grader.course.scenario import RunPlan
from grader.course.scenario_rules import instant_fault
from grader.course.values import Form
from grader.course.worlds import WORLDS

Draws = Mapping[str, Draw]
SUBJECT = ("topic", "service", "action", "event", "turtle", "name")
"""What a check is about: two checks of a kind with the same are compared."""
TURTLE = r"[A-Za-z][A-Za-z0-9_]*"


def draw_faults(assignment: Assignment) -> Iterator[Fault]:
    """Yield what is wrong with the drawn values of an assignment, whose runs and checks have slots."""
    draws = assignment.draw
    used = {name for plan in assignment.runs for name in plan.drawn}
    for name in draws:
        if name not in used:
            text = (
                f"no run uses '{name}': write {{drawn: {name}}} in place of a value, an instant or a "
                "turtle's name of a stimulus, or of a parameter"
            )
            yield ("draw", name), text
    for i, plan in enumerate(assignment.runs):
        for slot in plan.slots:
            yield from _slot_faults(plan, slot, assignment, ("runs", i))
    yield from alike(assignment)


def _slot_faults(plan: RunPlan, slot: Slot, assignment: Assignment, place: Loc) -> Iterator[Fault]:
    here = (*place, *slot.place)
    match slot.place:
        case ("do", int() as j, "at"):
            yield from _off_the_clock(plan, j, slot.form, assignment.draw, here)
        case ("do", int() as j, "set", str() as node, str() as name):
            before = _before(plan, j, node, name, assignment)
            if before is not None:
                yield from _same(slot.form, before, name, assignment.draw, here)
        case ("do", int() as j, "spawn", "turtle"):
            yield from _turtles(plan, j, slot.form, assignment.draw, here)


def _off_the_clock(
    plan: RunPlan, j: int, form: Computed, draws: Draws, place: Loc
) -> Iterator[Fault]:
    """Yield that a stimulus is not at an instant of the clock for all values."""
    for values in combinations(draws, form.names):
        at = form.of(values)
        if not isinstance(at, int | float) or at < 0:
            continue  # (the types say so)
        if fault := instant_fault(plan.do[j].model_copy(update={"at": float(at)}), plan):
            yield place, f"{fault} (if {shown(values)})"
            return


def _before(plan: RunPlan, j: int, node: str, name: str, assignment: Assignment) -> Plain | None:
    """Return the value that a parameter has before a stimulus, as far as the assignment says it."""
    found: Any = None
    for use in assignment.checks:
        asked = use.with_.get("value")
        own = use.with_.get("name") == name and use.of in ("", node)
        if use.kind == "parameter.declared" and own and isinstance(asked, bool | int | float | str):
            found = asked
    for begin in plan.start:
        if begin.node == node:
            found = begin.parameters.get(name, found)
    at = plan.do[j].at
    for other in sorted(plan.do, key=lambda one: one.at):
        if other.at < at and other.set:
            found = other.set.get(node, {}).get(name, found)
    return found if isinstance(found, bool | int | float | str) else None


def _same(form: Computed, before: Plain, name: str, draws: Draws, place: Loc) -> Iterator[Fault]:
    """Yield that a parameter can be set to the value that it has."""
    wanted = Form(equal=before)
    for values in combinations(draws, form.names):
        if wanted.fits(form.of(values)):
            text = (
                f"{name} is {before!s} already if {shown(values)}: a program that ignores the new "
                "value would pass"
            )
            yield place, text
            return


def _turtles(plan: RunPlan, j: int, form: Computed, draws: Draws, place: Loc) -> Iterator[Fault]:
    """Yield the names of a new turtle that it cannot have."""
    first = WORLDS[plan.world].first if plan.world else ""
    others = {one.spawn.turtle for n, one in enumerate(plan.do) if one.spawn and n != j}
    for values in combinations(draws, form.names):
        name = str(form.of(values))
        if not re.fullmatch(TURTLE, name):
            text = (
                f"a turtle's name has letters, digits and _ and begins with a letter, not '{name}'"
            )
            yield place, text
        elif name == first or name in others:
            yield place, f"there is a turtle '{name}' already"


def alike(assignment: Assignment, *, first: int = 0) -> Iterator[Fault]:
    """Yield the checks that would pass without the drawn values.

    Before a stimulus, or for other values, a message looks as the check wants it. `first` is the
    check with which the document begins.
    """
    for i, use in enumerate(assignment.checks[first:]):
        slots = _in_values(use)
        names = tuple(dict.fromkeys(name for slot in slots for name in slot.form.names))
        if not slots or count_of(assignment.draw, names) > MOST_TOGETHER:
            continue
        everything = list(combinations(assignment.draw, names))
        fields = {str(slot.place[2]) for slot in slots if slot.place[1] == "each"}
        others = [
            other
            for other in assignment.checks
            if other is not use and not _in_values(other) and _same_subject(use, other, assignment)
        ]
        for values in everything:
            made = use.with_drawn(values)
            for other in others:
                if fields and all(_fits(made, other, field) for field in fields):
                    text = (
                        f"'{use.id}' asks for the same as '{other.id}' if {shown(values)}: a program "
                        "that ignores the drawn value would pass"
                    )
                    yield ("checks", i, "with", "each"), text
                    return
        low, high = use.with_drawn(everything[0]), use.with_drawn(everything[-1])
        if fields and all(_fits(low, high, field) for field in fields):
            ends = f"{shown(everything[0])} and {shown(everything[-1])}"
            text = f"'{use.id}' cannot tell {ends} from each other: make `within` smaller"
            yield ("checks", i, "with", "each"), text


def _in_values(use: CheckUse) -> list[Slot]:
    """Return the places of drawn values in what a check asks for."""
    return [slot for slot in use.slots if slot.place[:1] == ("with",)]


def _same_subject(one: CheckUse, other: CheckUse, assignment: Assignment) -> bool:
    same_run = assignment.plan(one.run).name == assignment.plan(other.run).name
    about = [(use.kind, use.of, *(use.with_.get(key) for key in SUBJECT)) for use in (one, other)]
    return same_run and about[0] == about[1]


def _fits(one: CheckUse, other: CheckUse, field: str) -> bool:
    """Whether the value of a field that one check wants is what the other wants too."""
    wanted, given = _form(one, field), _form(other, field)
    if wanted is None or given is None:
        return False
    value = given.about if given.about is not None else given.equal
    return value is not None and wanted.fits(value)


def _form(use: CheckUse, field: str) -> Form | None:
    each = use.with_.get("each")
    found = each.get(field) if isinstance(each, Mapping) else None
    try:
        return None if found is None else Form.model_validate(found)
    except ValidationError:
        return None
