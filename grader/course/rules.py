"""The rules of an assignment that its types do not express, with the line that breaks a rule."""

from __future__ import annotations

import keyword
import math
import re
from collections.abc import Iterator, Sequence

from pydantic import BaseModel, ConfigDict

from grader.base.nearest import meant_or_known
from grader.base.positioned_yaml import Document, Loc
from grader.base.yaml_model import Fault, error_of, validated
from grader.course.assignment import Assignment, CheckUse, Output
from grader.course.policy import Late, Policy, policy_faults

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


class HiddenChecks(BaseModel):
    """The instructor's file of hidden checks."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    checks: tuple[CheckUse, ...]


def check_content(
    document: Document,
    *,
    known_checks: Sequence[str] | None,
    known_limits: Sequence[str] | None,
) -> Assignment:
    """Return the assignment in a document; AssignmentError lists all faults."""
    content = document.content
    if isinstance(content, dict) and "sha256" in content:
        raise document.error(("sha256",), "unknown key 'sha256'")
    assignment = validated(document, Assignment, _keys(Assignment))
    found = [
        *_names(assignment),
        *_output(assignment.output),
        *_limits(assignment.limits, known_limits),
        *_check_uses(assignment.checks, known_checks),
        *(
            (("policy", *place), f"policy.{text}")
            for place, text in policy_faults(assignment.policy)
        ),
    ]
    if found:
        raise error_of(document, found)
    return assignment


def merge_hidden(
    assignment: Assignment,
    document: Document,
    hidden: Document,
    *,
    known_checks: Sequence[str] | None,
) -> Assignment:
    """Return the assignment with the hidden checks added after the visible ones."""
    extra = validated(hidden, HiddenChecks, _keys(HiddenChecks)).checks
    found = list(_check_uses(extra, known_checks, taken=[use.id for use in assignment.checks]))
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
    return assignment.model_copy(update={"checks": assignment.checks + marked})


def _as_hidden(use: CheckUse) -> CheckUse:
    return CheckUse(id=use.id, points=use.points, visibility="hidden")


def _keys(model: type[BaseModel]) -> dict[Loc, tuple[str, ...]]:
    """Return the known keys of each place."""
    own = tuple(f.alias or name for name, f in model.model_fields.items() if name != "sha256")
    keys: dict[Loc, tuple[str, ...]] = {(): own, ("checks", "*"): tuple(CheckUse.model_fields)}
    if "output" in own:
        keys["output",] = tuple(Output.model_fields)
        keys["policy",] = tuple(Policy.model_fields)
        keys["policy", "late"] = tuple(Late.model_fields)
    return keys


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
    uses: Sequence[CheckUse], known: Sequence[str] | None, taken: Sequence[str] = ()
) -> Iterator[Fault]:
    if not uses and not taken:
        yield ("checks",), "checks is empty: an assignment needs at least one check"
    seen = set(taken)
    for i, use in enumerate(uses):
        if known is not None and use.id not in known:
            yield (
                ("checks", i, "id"),
                f"unknown check '{use.id}'{meant_or_known(use.id, known)}",
            )
        elif use.id in seen:
            yield ("checks", i, "id"), f"the check '{use.id}' is listed twice"
        seen.add(use.id)
