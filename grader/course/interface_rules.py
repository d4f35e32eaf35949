"""Types, fields and values in an assignment that ROS's interfaces do not have."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from grader.base.nearest import meant_or_known
from grader.base.positioned_yaml import Loc
from grader.base.yaml_model import Fault
from grader.course.assignment import Assignment, CheckUse
from grader.course.interfaces import ARRAY, PARTS, Interfaces, part_names, ros_interfaces
from grader.course.scenario import Stimulus

OF_FAMILY = {"topic": "msg", "service": "srv", "action": "action"}  # a kind of check: its types
OF_KEY = {"publish": ("msg", ""), "call": ("srv", "_Request"), "goal": ("action", "_Goal")}
ANSWERS = {
    "service.answers": ("call", "_Response"),
    "action.feedback": ("goal", "_Feedback"),
    "action.result": ("goal", "_Result"),
}
"""Kinds of checks that judge what comes back: the stimulus, and the part of its interface."""
UNSIGNED = {"uint8": 8, "char": 8, "uint16": 16, "uint32": 32, "uint64": 64}
SIGNED = {"int8": 8, "int16": 16, "int32": 32, "int64": 64}
FLOATS = ("float32", "float64")
TEXTS = ("string", "wstring")
NUMERIC = ("about", "between", "from")
TEXTUAL = ("matches", "contains")


def interface_faults(assignment: Assignment, *, first: int = 0) -> Iterator[Fault]:
    """Yield what is wrong with the types, fields and values of an assignment.

    `first` is the check with which the document begins: above 0 it is the file of hidden checks,
    which has no runs. Interfaces of unknown packages are not judged.
    """
    judge = _Judge(ros_interfaces(), assignment)
    if first == 0:
        for i, plan in enumerate(assignment.runs):
            for topic, kind in plan.topics.items():
                yield from judge.type(kind, "msg", ("runs", i, "topics", topic))
            for j, one in enumerate(plan.do):
                yield from judge.stimulus(one, ("runs", i, "do", j))
    for i, use in enumerate(assignment.checks[first:]):
        yield from judge.use(use, ("checks", i, "with"))


class _Judge:
    def __init__(self, known: Interfaces, assignment: Assignment) -> None:
        self._known = known
        self._assignment = assignment
        self._students = assignment.interface_packages

    def type(self, name: str, kind: str, place: Loc) -> Iterator[Fault]:
        """Yield what is wrong with the name of a type."""
        if name.partition("/")[0] in self._students and name.count("/") == 2:
            return
        if fault := self._known.type_fault(name, kind):
            yield place, fault

    def stimulus(self, one: Stimulus, place: Loc) -> Iterator[Fault]:
        """Yield what is wrong with the type and the values of a stimulus."""
        for key, what in one.typed.items():
            kind, part = OF_KEY[key]
            yield from self.type(what.type, kind, (*place, key, "type"))
            yield from self._values(what.type + part, what.values, (*place, key, "values"))

    def _values(self, message: str, values: Mapping[str, Any], place: Loc) -> Iterator[Fault]:
        for name, value in values.items():
            here = (*place, name)
            field = self._known.field(message, name)
            if field.fault:
                yield here, field.fault
            elif (
                isinstance(value, Mapping) and "/" in field.type and not ARRAY.fullmatch(field.type)
            ):
                yield from self._values(field.type, value, here)
            elif fault := value_fault(field.type, value):
                yield here, f"{name} {fault}"

    def use(self, use: CheckUse, place: Loc) -> Iterator[Fault]:
        """Yield what is wrong with the type and the fields of a check."""
        kind = OF_FAMILY.get(use.kind.partition(".")[0])
        if kind is not None and isinstance(use.with_.get("type"), str):
            yield from self.type(use.with_["type"], kind, (*place, "type"))
        yield from _part_faults(use, place)
        each = use.with_.get("each")
        message = self._message(use)
        if not message or not isinstance(each, Mapping):
            return
        for path, form in each.items():
            here = (*place, "each", path)
            field = self._known.field(message, path)
            if field.fault:
                yield here, field.fault
            elif fault := form_fault(field.type, form):
                yield here, f"{path} {fault}"

    def _message(self, use: CheckUse) -> str:
        """Return the message whose fields a check judges, "" if it is not known."""
        plan = self._assignment.plan(use.run)
        topic = use.with_.get("topic")
        if isinstance(topic, str):
            return plan.topics.get(topic, "")
        if use.kind not in ANSWERS:
            return ""
        key, part = ANSWERS[use.kind]
        one = plan.stimulus(use.after)
        made = one.typed.get(key) if one is not None else None
        return made.type + part if made is not None else ""


def _part_faults(use: CheckUse, place: Loc) -> Iterator[Fault]:
    """Yield the fields of `interface.fields` whose part the type does not have."""
    kind = str(use.with_.get("type", "")).split("/")[1:2]
    if use.kind != "interface.fields" or not kind or kind[0] not in PARTS:
        return
    known = part_names(kind[0])
    for field in use.with_.get("fields", ()):
        part = str(field).rpartition(".")[0]
        if part and part not in known:
            hint = meant_or_known(part, known) if known else " (it has no parts)"
            yield (*place, "fields", field), f"a {kind[0]} has no part '{part}'{hint}"


def value_fault(kind: str, value: Any) -> str:
    """Return why a field of a type cannot have a value: "is a bool, not 3"; "" if it can."""
    array = ARRAY.fullmatch(kind)
    if array is not None:
        if isinstance(value, list | tuple):
            inner = (value_fault(array[1], one) for one in value)
            return next((f"[{n}] {fault}" for n, fault in enumerate(inner) if fault), "")
        return f"is a list ({kind}), not {_shown(value)}"
    if "/" in kind:
        wrong = not isinstance(value, Mapping)
        return f"has fields ({kind}): write {{field: value}}, not {_shown(value)}" if wrong else ""
    bounds = _bounds(kind)
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if kind in ("", "byte"):
        return ""
    if bounds is not None:
        fits = isinstance(value, int) and is_number and bounds[0] <= value <= bounds[1]
    elif kind in FLOATS:
        fits = is_number
    elif kind in TEXTS:
        fits = isinstance(value, str)
    else:
        fits = isinstance(value, bool)
    words = f" ({bounds[0]} to {bounds[1]})" if bounds is not None else ""
    return "" if fits else f"is of the type {kind}{words}: it cannot be {_shown(value)}"


def form_fault(kind: str, form: Any) -> str:
    """Return why a field of a type can never have a form, "" if it can."""
    if not kind or kind == "byte" or ARRAY.fullmatch(kind) or "/" in kind:
        return ""
    if not isinstance(form, Mapping):
        return _equal_fault(kind, form)
    if "equal" in form:
        return _equal_fault(kind, form["equal"])
    is_number = kind in FLOATS or _bounds(kind) is not None
    for key in form:
        if (key in NUMERIC and not is_number) or (key in TEXTUAL and kind not in TEXTS):
            return f"is of the type {kind}: '{key}' never fits"
    return ""


def _equal_fault(kind: str, value: Any) -> str:
    whole = isinstance(value, float) and value.is_integer() and _bounds(kind) is not None
    return value_fault(kind, int(value) if whole else value)


def _bounds(kind: str) -> tuple[int, int] | None:
    """Return the smallest and the largest value of a type for whole numbers."""
    if kind in UNSIGNED:
        return 0, 2 ** UNSIGNED[kind] - 1
    if kind in SIGNED:
        return -(2 ** (SIGNED[kind] - 1)), 2 ** (SIGNED[kind] - 1) - 1
    return None


def _shown(value: Any) -> str:
    text = {True: "true", False: "false", None: "empty"}.get(value) if _is_plain(value) else None
    return text or repr(value)[:60]


def _is_plain(value: Any) -> bool:
    return value is None or isinstance(value, bool)
