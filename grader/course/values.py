"""The forms that a value of a message, a parameter or an answer can have.

A form is data: a plain value (equal to it), or one of `{about, within}`, `{between: [a, b]}`,
`{one_of: […]}`, `{matches: pattern}`, `{contains: text}` and, for one message after the other,
`{from: 0, step: 1}`. Nothing of it is evaluated.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any

from pydantic import Field, model_validator

from grader.base.example_text import example_of
from grader.base.i18n.message import Message, joined, say
from grader.base.part import Part
from grader.base.yaml_model import broken

FLOAT32 = 1e-6  # the relative error of a value that went through a float32 field
LONGEST_SHOWN = 50  # values of an array
KEYS = ("equal", "about", "between", "one_of", "matches", "contains", "from")


class Form(Part):
    """A form; exactly one of its keys is set (`within` belongs to `about`, `step` to `from`)."""

    equal: Any = None
    about: float | None = None
    within: float | None = None
    between: tuple[float, float] | None = None
    one_of: tuple[Any, ...] | None = None
    matches: str | None = None
    contains: str | None = None
    from_: float | None = Field(default=None, alias="from")
    step: float | None = None

    @model_validator(mode="before")
    @classmethod
    def _plain(cls, value: Any) -> Any:
        return value if isinstance(value, Mapping | Form) else {"equal": value}

    @model_validator(mode="after")
    def _one(self) -> Form:
        given = [
            key for key in KEYS if getattr(self, "from_" if key == "from" else key) is not None
        ]
        if len(given) != 1:
            raise broken(f"a value is plain or has exactly one of {', '.join(KEYS)}")
        if (self.within is None) != (self.about is None):
            raise broken("about and within belong together: {about: 1.0, within: 0.01}")
        if self.step is not None and self.from_ is None:
            raise broken("step belongs to from: {from: 0, step: 1}")
        if self.matches is not None:
            try:
                re.compile(self.matches)
            except re.error as error:
                raise broken(f"matches is not a regular expression: {error}") from None
        return self

    def at(self, index: int) -> Form:
        """Return the form of the value in a row of values; `index` is counted from 0."""
        if self.from_ is None:
            return self
        return Form(equal=self.from_ + index * (1 if self.step is None else self.step))

    def fits(self, value: Any) -> bool:
        """Whether a value has this form; one that counts has that of the first value."""
        if self.from_ is not None:
            return self.at(0).fits(value)
        if self.about is not None and self.within is not None:
            return _is_number(value) and abs(value - self.about) <= self.within * (1 + FLOAT32)
        if self.between is not None:
            return _is_number(value) and self.between[0] <= value <= self.between[1]
        if self.one_of is not None:
            return any(_equal(value, one) for one in self.one_of)
        if self.matches is not None:
            return isinstance(value, str) and re.search(self.matches, value) is not None
        if self.contains is not None:
            return isinstance(value, str) and self.contains in value
        return _equal(value, self.equal)

    def __str__(self) -> str:
        """Return the form in English."""
        return str(self.words)

    @property
    def words(self) -> Message:
        """The form as a person would write it."""
        if self.between is not None:
            low, high = self.between
            return say("{low} to {high}", low=f"{low:g}", high=f"{high:g}")
        if self.matches is not None:
            return pattern_in_words(self.matches)
        return joined(self._plain_words)

    @property
    def _plain_words(self) -> str:
        if self.about is not None:
            return f"{self.about:g} ± {self.within:g}"
        if self.one_of is not None:
            return " | ".join(shown_value(one) for one in self.one_of)
        if self.contains is not None:
            return f"…{self.contains}…"
        if self.from_ is not None:
            return ", ".join([*(str(self.at(index)) for index in range(3)), "…"])
        return shown_value(self.equal)


def forms_in_words(each: Mapping[str, Form]) -> Message:
    """Return fields and their forms, as in `linear.x: 0 to 2, angular.z: 0`."""
    return joined(*(joined(path, form.words, by=": ") for path, form in each.items()), by=", ")


NUMBER = re.compile(r"\(?-?\??(?:\\d|\[0-9\])[+*]?(?:\(\?:)?(?:\\\.(?:\\d|\[0-9\])[+*]?)?\)?[?]?")
ANYTHING = re.compile(r"\(?\.[*+]\??\)?")
SIGN = re.compile(r"(?<!\\)[\[\](){}|*+?^$]|\\[a-zA-Z]|(?<!\\)\.")


def pattern_in_words(pattern: str) -> Message:
    r"""Return a pattern as students read it: 'Turning' for ^Turning$, 'x: <number>' for ^x: \d+$.

    Of one that is more than that, a text is shown that it matches.
    """
    inner = pattern.removeprefix("^").removesuffix("$")
    inner = ANYTHING.sub("…", NUMBER.sub("<number>", inner))
    if SIGN.search(inner):
        example = example_of(pattern)
        return (
            say("a text such as {example}", example=repr(example))
            if example
            else joined(f"/{pattern}/")
        )
    text = re.sub(r"\\(.)", r"\1", inner)
    before = "" if pattern.startswith("^") else "…"
    after = "" if pattern.endswith("$") else "…"
    return joined(repr(text) if not before + after else f"{before}{text}{after}")


def shown_value(value: Any) -> str:
    """Return a value as text for a reader."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(shown_value, value[:LONGEST_SHOWN]))}]"[:200]
    return repr(value) if isinstance(value, str) else str(value)[:200]


def at_path(values: Any, path: str) -> Any:
    """Return the value of a field such as `linear.x` or `ranges[0]`; KeyError if it is not there."""
    for part in re.findall(r"[^.\[\]]+|\[\d+\]", path):
        if part.startswith("["):
            index = int(part[1:-1])
            if not isinstance(values, list | tuple) or index >= len(values):
                raise KeyError(path)
            values = values[index]
        elif isinstance(values, Mapping) and part in values:
            values = values[part]
        else:
            raise KeyError(path)
    return values


def value_at(values: Any, path: str) -> Any:
    """Return the value of a field, None if it is not there."""
    try:
        return at_path(values, path)
    except KeyError:
        return None


def first_misfit(
    values: Any, each: Mapping[str, Form], index: int = 0
) -> tuple[str, Form, Any] | None:
    """Return the first field that does not have its form: its path, the form and the value.

    `index` is the place of the message among those that are judged, counted from 0.
    """
    for path, every in each.items():
        form, value = every.at(index), value_at(values, path)
        if not form.fits(value):
            return path, form, value
    return None


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _equal(value: Any, wanted: Any) -> bool:
    if isinstance(value, list | tuple) and isinstance(wanted, list | tuple):
        return len(value) == len(wanted) and all(map(_equal, value, wanted))
    if isinstance(wanted, bool) or isinstance(value, bool):
        return value is wanted
    if _is_number(value) and _is_number(wanted):
        return math.isclose(value, wanted, rel_tol=FLOAT32, abs_tol=1e-9)
    return bool(value == wanted)
