"""Shared by the checks of messages, answers and requests: fields that do not have their form."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeGuard

from grader.base.i18n.message import Value, joined
from grader.course.values import Form, first_misfit, shown_value
from grader.report.model import Where
from grader.verdict.outcome import Failed

DENORMAL = 1e-300  # below it, a value is the bits of an integer that were read as a float


def is_integer_bits(value: object) -> TypeGuard[float]:
    """Whether a whole number was put into a field for floating-point numbers."""
    return isinstance(value, float) and 0 < abs(value) < DENORMAL


def must_fit(
    values: Any,
    each: Mapping[str, Form],
    mistake: str,
    *,
    where: Where,
    words: Mapping[str, Value],
) -> None:
    """Raise Failed with a mistake if a field does not have its form."""
    wrong = first_misfit(values, each)
    if wrong is not None:
        path, form, value = wrong
        raise Failed(
            mistake,
            expected=joined(path, form.words, by=": "),
            actual=f"{path}: {shown_value(value)}",
            where=where,
            params={"field": path},
            words=words,
        )
