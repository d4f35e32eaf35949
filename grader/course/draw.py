"""Drawn values: the names of an assignment's `draw:`, and the small forms that compute with them.

A form is data: `{drawn: name}`, or one of `plus`, `minus`, `times` and `divide` with two terms, each
a number, a name or another form. Nothing of it is evaluated as code.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from typing import Any, TypeVar, Union

from pydantic import BaseModel, Field, ValidationInfo, field_validator, model_validator

from grader.base.part import Part
from grader.base.yaml_model import broken

OPERATIONS = ("plus", "minus", "times", "divide")
DRAWN = "drawn"
MOST_VALUES = 1_000  # of a name
MOST_TOGETHER = 20_000  # combinations of the values of the names in a form
MOST_NAMES = 6  # of an assignment: all extremes together are 2 to this power
DIGITS = 9  # after the point: 0.1 + 0.2 is 0.3

Plain = Union[bool, int, float, str]  # noqa: UP007 - pydantic evaluates it on Python 3.10 too
Values = Mapping[str, Plain]
"""The value of each name."""
M = TypeVar("M", bound=BaseModel)


class Draw(Part):
    """How a value is drawn: from a to b in steps, or one of a list."""

    between: tuple[int | float, int | float] | None = Field(
        default=None, exclude_if=lambda given: given is None
    )
    step: int | float | None = Field(default=None, exclude_if=lambda given: given is None)
    one_of: tuple[Plain, ...] | None = Field(default=None, exclude_if=lambda given: given is None)

    @field_validator("between", "step", mode="before")
    @classmethod
    def _numbers(cls, given: Any, info: ValidationInfo) -> Any:
        terms = given if info.field_name == "between" else (given,)
        wanted = 2 if info.field_name == "between" else 1
        if not isinstance(terms, tuple | list) or len(terms) != wanted:
            raise broken("between must be [low, high]")
        if not all(_is_number(term) for term in terms):
            raise broken(f"{info.field_name} takes numbers only")
        return given

    @field_validator("one_of", mode="before")
    @classmethod
    def _plain(cls, given: Any) -> Any:
        values = given if isinstance(given, tuple | list) else (None,)
        if not all(isinstance(value, bool | str) or _is_number(value) for value in values):
            raise broken("one_of must be a list; each value is true or false, a number or a text")
        return given

    @model_validator(mode="after")
    def _can_be_drawn(self) -> Draw:
        if (self.between is None) == (self.one_of is None):
            raise broken("a drawn value has either between and step, or one_of")
        if (self.between is None) != (self.step is None):
            raise broken("between and step belong together: {between: [0.5, 1.5], step: 0.1}")
        if fault := self._fault():
            raise broken(fault)
        return self

    def _fault(self) -> str:
        if self.one_of is not None:
            return _fault_of_choice(self.one_of)
        assert self.between is not None
        assert self.step is not None
        first, last = self.between
        if self.step <= 0 or last <= first:
            return "between must be [low, high] with low below high, and step must be above 0"
        steps = (last - first) / self.step
        if steps > MOST_VALUES:
            return f"there are more than {MOST_VALUES} values: make step larger"
        if abs(steps - round(steps)) > 1e-6:
            end = round(first + math.floor(steps) * self.step, DIGITS)
            return f"steps of {self.step:g} from {first:g} do not lead to {last:g}: write {end:g}"
        return ""

    @property
    def values(self) -> tuple[Plain, ...]:
        """All values, the lowest number first."""
        if self.one_of is not None:
            return self.one_of if self.is_text else tuple(sorted(self.one_of))
        assert self.between is not None
        assert self.step is not None
        first, last = self.between
        count = round((last - first) / self.step) + 1
        return tuple(_rounded(first + k * self.step) for k in range(count))

    @property
    def is_text(self) -> bool:
        """Whether it is a text or true or false: nothing can be computed with it."""
        return self.one_of is not None and isinstance(self.one_of[0], str | bool)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _fault_of_choice(choice: tuple[Plain, ...]) -> str:
    """Return what is wrong with the values of a one_of."""
    kinds = {type(value) for value in choice}
    if kinds == {int, float}:
        kinds = {float}
    if len(kinds) > 1:
        return "the values of one_of must be of one type"
    for n, value in enumerate(choice):
        if value in choice[:n]:
            return f"one_of has {_shown(value)} twice: nobody can tell these draws from each other"
    if len(choice) < 2:
        return "one_of needs at least two values: what is always the same is not drawn"
    return "" if len(choice) <= MOST_VALUES else f"one_of has more than {MOST_VALUES} values"


class Computed(Part):
    """A form: exactly one of its keys is set."""

    drawn: str | None = Field(default=None, exclude_if=lambda given: given is None)
    plus: tuple[Term, Term] | None = Field(default=None, exclude_if=lambda given: given is None)
    minus: tuple[Term, Term] | None = Field(default=None, exclude_if=lambda given: given is None)
    times: tuple[Term, Term] | None = Field(default=None, exclude_if=lambda given: given is None)
    divide: tuple[Term, Term] | None = Field(default=None, exclude_if=lambda given: given is None)

    @property
    def operation(self) -> str:
        """The key that is set."""
        return next(key for key in (DRAWN, *OPERATIONS) if getattr(self, key) is not None)

    @property
    def names(self) -> tuple[str, ...]:
        """The names that stand in it, each once."""
        if self.drawn is not None:
            return (self.drawn,)
        found: dict[str, None] = {}
        for term in getattr(self, self.operation):
            if isinstance(term, str):
                found[term] = None
            elif isinstance(term, Computed):
                found |= dict.fromkeys(term.names)
        return tuple(found)

    def of(self, values: Values) -> Plain:
        """Return the value for drawn values; ZeroDivisionError if it divides by 0."""
        if self.drawn is not None:
            return values[self.drawn]
        one, other = (_number(term, values) for term in getattr(self, self.operation))
        if self.plus is not None:
            return _rounded(one + other)
        if self.minus is not None:
            return _rounded(one - other)
        if self.times is not None:
            return _rounded(one * other)
        return _rounded(one / other)


Term = Union[int, float, str, Computed]  # noqa: UP007 - see Plain
Computed.model_rebuild()


class Slot(Part):
    """A place in a run or a check where a computed value stands."""

    place: tuple[str | int, ...]
    form: Computed


def _number(term: Term, values: Values) -> float | int:
    found = term.of(values) if isinstance(term, Computed) else term
    found = values[found] if isinstance(found, str) else found
    assert isinstance(found, int | float)
    return found


def _rounded(value: float | int) -> float | int:
    return value if isinstance(value, int) else round(value, DIGITS)


def _shown(value: Plain) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def shown(values: Values) -> str:
    """Return drawn values as a reader sees them, such as `radius = 0.7, at = 5.5`."""
    return ", ".join(f"{name} = {_shown(value)}" for name, value in values.items())


def form_at(value: Any) -> bool:
    """Whether a value of a file is meant as a form: one key, with a name among its terms."""
    if not isinstance(value, Mapping) or len(value) != 1:
        return False
    ((key, terms),) = value.items()
    if key == DRAWN:
        return isinstance(terms, str)
    return key in OPERATIONS and isinstance(terms, tuple | list) and _has_name(terms)


def _has_name(terms: Any) -> bool:
    if isinstance(terms, str):
        return True
    if isinstance(terms, Mapping):
        return any(_has_name(term) for term in terms.values())
    return isinstance(terms, tuple | list) and any(_has_name(term) for term in terms)


def combinations(draws: Mapping[str, Draw], names: tuple[str, ...]) -> Iterator[dict[str, Plain]]:
    """Yield all values of some names together."""
    for found in product(*(draws[name].values for name in names)):
        yield dict(zip(names, found))


def count_of(draws: Mapping[str, Draw], names: tuple[str, ...]) -> int:
    """Return how many values some names have together."""
    return math.prod(len(draws[name].values) for name in names)


def extremes(draws: Mapping[str, Draw]) -> Iterator[dict[str, Plain]]:
    """Yield the lowest and highest values of all names, in all combinations; first all lowest."""
    ends = [(one.values[0], one.values[-1]) for one in draws.values()]
    for found in product(*ends):
        yield dict(zip(draws, found))


def put(content: Any, place: tuple[str | int, ...], value: Any) -> Any:
    """Return plain data with another value at a place; what it is in is copied."""
    if not place:
        return value
    first, rest = place[0], place[1:]
    if isinstance(content, Mapping):
        return {**content, first: put(content[first], rest, value)}
    assert isinstance(first, int)
    items = list(content)
    items[first] = put(items[first], rest, value)
    return tuple(items)


def filled(part: M, slots: Sequence[Slot], values: Values) -> M:
    """Return a part of an assignment with the values of its slots."""
    content: Any = part.model_dump(by_alias=True)
    for slot in slots:
        content = put(content, slot.place, slot.form.of(values))
    return type(part).model_validate(content)
