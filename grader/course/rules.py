"""The rules of an assignment that its types do not express, with the line that breaks a rule."""

from __future__ import annotations

import difflib
import keyword
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError

from grader.base.errors import AssignmentError
from grader.base.positioned_yaml import Document, Loc
from grader.course.assignment import Assignment, CheckUse, Output
from grader.course.policy import Late, Policy, policy_faults

Fault = tuple[Loc, str]  # the place in the document, and the message

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
TYPES = {
    "string": "text (put it in quotes)",
    "int": "a whole number",
    "float": "a number",
    "datetime": "a date and time such as 2026-11-20T23:59:00+09:00, without quotes",
    "tuple": "a list",
    "dict": "a block of `key: value`",
    "model": "a block of `key: value`",
}


class HiddenChecks(BaseModel):
    """The instructor's file of hidden checks."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    checks: tuple[CheckUse, ...]


def check_content(
    document: Document, *, known_checks: Sequence[str], known_limits: Sequence[str] | None
) -> Assignment:
    """Return the assignment in a document; AssignmentError lists all faults."""
    content = document.content
    if isinstance(content, dict) and "sha256" in content:
        raise document.error(("sha256",), "unknown key 'sha256'")
    try:
        assignment = Assignment.model_validate(content, strict=True)
    except ValidationError as error:
        raise _error_of(document, _type_faults(error, Assignment)) from None
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
        raise _error_of(document, found)
    return assignment


def merge_hidden(
    assignment: Assignment, document: Document, hidden: Document, *, known_checks: Sequence[str]
) -> Assignment:
    """Return the assignment with the hidden checks added after the visible ones."""
    try:
        extra = HiddenChecks.model_validate(hidden.content, strict=True).checks
    except ValidationError as error:
        raise _error_of(hidden, _type_faults(error, HiddenChecks)) from None
    found = list(_check_uses(extra, known_checks, taken=[use.id for use in assignment.checks]))
    if found:
        raise _error_of(hidden, found)
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


def _error_of(document: Document, faults: Iterable[Fault]) -> AssignmentError:
    rows = {(document.line(loc), text) for loc, text in faults}
    return AssignmentError(
        "\n".join(f"{document.path}:{line}: {text}" for line, text in sorted(rows))
    )


def _type_faults(error: ValidationError, model: type[BaseModel]) -> Iterator[Fault]:
    """Yield pydantic's errors in our words; a misspelt key is not reported as missing too."""
    known = _keys(model)
    meant: set[Loc] = set()
    rest = []
    for item in error.errors(include_url=False, include_input=True):
        loc: Loc = item["loc"]
        if item["type"] != "extra_forbidden":
            rest.append(item)
            continue
        name = str(loc[-1])
        candidates = known.get(_shape(loc[:-1]), ())
        close = difflib.get_close_matches(name, candidates, n=1)
        hint = f" (did you mean '{close[0]}'?)" if close else f"; known: {', '.join(candidates)}"
        meant |= {(*loc[:-1], key) for key in close}
        yield loc, f"unknown key '{name}'{hint}"
    for item in rest:
        loc = item["loc"]
        if item["type"] == "missing":
            if loc not in meant:
                yield loc[:-1], f"missing key '{loc[-1]}'"
        else:
            yield loc, _wrong_value(loc, item)


def _wrong_value(loc: Loc, item: Any) -> str:
    where = ".".join(str(part) for part in loc) or "the file"
    kind = str(item["type"])
    given = _shown(item.get("input"))
    wanted = TYPES.get(kind.partition("_")[0])
    if kind.endswith("_type") and wanted:
        return f"{where} must be {wanted}, not {given}"
    bounds = item.get("ctx", {})
    if kind == "greater_than":
        return f"{where} must be above {bounds['gt']:g}, not {given}"
    if kind == "greater_than_equal":
        return f"{where} must be at least {bounds['ge']:g}, not {given}"
    if kind == "literal_error":
        close = difflib.get_close_matches(str(item.get("input")), _choices(bounds), n=1)
        hint = f" (did you mean '{close[0]}'?)" if close else ""
        return f"{where} must be {bounds['expected']}, not {given}{hint}"
    return f"{where}: {item['msg']}, not {given}"


def _choices(bounds: Any) -> list[str]:
    return re.findall(r"'([^']+)'", str(bounds.get("expected", "")))


def _shown(value: Any) -> str:
    if value is None:
        return "empty"
    if isinstance(value, dict | tuple):
        return "a block of `key: value`" if isinstance(value, dict) else "a list"
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "…'"


def _shape(loc: Loc) -> Loc:
    """Return a place with `*` for each index: all members of a list have the same keys."""
    return tuple("*" if isinstance(part, int) else part for part in loc)


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
            close = difflib.get_close_matches(name, known, n=1)
            hint = f" (did you mean '{close[0]}'?)" if close else f"; known: {', '.join(known)}"
            yield ("limits", name), f"unknown limit '{name}'{hint}"
        if not (value > 0 and math.isfinite(value)):
            yield ("limits", name), f"limits.{name} must be a number above 0, not {value:g}"


def _check_uses(
    uses: Sequence[CheckUse], known: Sequence[str], taken: Sequence[str] = ()
) -> Iterator[Fault]:
    if not uses and not taken:
        yield ("checks",), "checks is empty: an assignment needs at least one check"
    seen = set(taken)
    for i, use in enumerate(uses):
        if use.id not in known:
            close = difflib.get_close_matches(use.id, known, n=1)
            hint = f" (did you mean '{close[0]}'?)" if close else f"; known: {', '.join(known)}"
            yield ("checks", i, "id"), f"unknown check '{use.id}'{hint}"
        elif use.id in seen:
            yield ("checks", i, "id"), f"the check '{use.id}' is listed twice"
        seen.add(use.id)
