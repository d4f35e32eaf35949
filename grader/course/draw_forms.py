"""Finds the computed values in an assignment's file, and puts drawn values in their place."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeVar

from pydantic import ConfigDict, Field, ValidationError

from grader.base.errors import AssignmentError
from grader.base.nearest import meant_or_known, nearest
from grader.base.part import Part
from grader.base.positioned_yaml import Document, Loc
from grader.base.yaml_model import Fault, error_of, model_faults
from grader.course.draw import (
    DRAWN,
    MOST_NAMES,
    MOST_TOGETHER,
    OPERATIONS,
    Computed,
    Draw,
    Slot,
    Values,
    combinations,
    count_of,
    extremes,
    form_at,
    put,
    shown,
)

Draws = Mapping[str, Draw]
FormPlace = tuple[Loc, Computed]
"""Where a form stands in a document."""
T = TypeVar("T")

DRAW = "draw"
FIXED = ("topic", "type", "service", "action", "package", "files", "period")
"""Keys of a check's `with:` that no drawn value can be in: what is recorded depends on them."""
WORDS = f"{', '.join(OPERATIONS[:-1])} and {OPERATIONS[-1]}"


class _Draws(Part):
    model_config = ConfigDict(extra="ignore")

    draw: dict[str, Draw] = Field(default_factory=dict)


def draws_of(document: Document) -> dict[str, Draw]:
    """Return the `draw:` of a document. Raises AssignmentError."""
    content = document.content
    if not isinstance(content, Mapping) or DRAW not in content:
        return {}
    try:
        draws = _Draws.model_validate(content, strict=True).draw
    except ValidationError as error:
        keys: dict[Loc, tuple[str, ...]] = {
            (DRAW, str(name)): tuple(Draw.model_fields) for name in _names(content[DRAW])
        }
        raise error_of(document, model_faults(error, keys)) from None
    found: list[Fault] = []
    for name in draws:
        if not name.isidentifier() or not name.isascii():
            text = f"the name of a drawn value has letters, digits and _ only, not '{name}'"
            found.append(((DRAW, name), text))
    if len(draws) > MOST_NAMES:
        found.append(((DRAW,), f"there can be at most {MOST_NAMES} drawn values"))
    if found:
        raise error_of(document, found)
    return draws


def _names(content: Any) -> Sequence[Any]:
    return tuple(content) if isinstance(content, Mapping) else ()


def forms_in(document: Document, draws: Draws) -> list[FormPlace]:
    """Return the forms of a document, with their places. Raises AssignmentError."""
    places: list[FormPlace] = []
    found: list[Fault] = []
    found += _misspelt(document.content, draws, ())
    for loc, content in _forms(document.content, ()):
        if not may_stand(loc):
            found.append((loc, "a drawn value cannot stand here"))
            continue
        try:
            form = Computed.model_validate(content, strict=True)
        except ValidationError:
            found.append((loc, _misfit(content)))
            continue
        faults = list(_faults(form, draws, loc))
        found += faults
        if not faults:
            places.append((loc, form))
    if found:
        raise error_of(document, found)
    return places


def _forms(content: Any, loc: Loc) -> Iterator[tuple[Loc, Any]]:
    if form_at(content):
        yield loc, content
    elif isinstance(content, Mapping):
        for key, value in content.items():
            if (*loc, key) != (DRAW,):
                yield from _forms(value, (*loc, key))
    elif isinstance(content, tuple):
        for n, value in enumerate(content):
            yield from _forms(value, (*loc, n))


def _misspelt(content: Any, draws: Draws, loc: Loc) -> Iterator[Fault]:
    """Yield what would be a form if its key were spelt right."""
    if isinstance(content, Mapping):
        for key, value in content.items():
            terms = value if isinstance(value, tuple) else (value,)
            known = OPERATIONS if isinstance(value, tuple) else (DRAWN,)
            named = any(isinstance(term, str) and term in draws for term in terms)
            close = nearest(key, known) if named and len(content) == 1 and key not in known else ""
            if close:
                yield (*loc, key), f"unknown key '{key}' (did you mean '{close}'?)"
            elif loc or key != DRAW:
                yield from _misspelt(value, draws, (*loc, key))
    elif isinstance(content, tuple):
        for n, value in enumerate(content):
            yield from _misspelt(value, draws, (*loc, n))


def may_stand(loc: Loc) -> bool:
    """Whether a drawn value can be at a place of an assignment's file."""
    match loc:
        case ("runs", int(), "start", int(), "parameters", _):
            return True
        case ("runs", int(), "do", int(), "at"):
            return True
        case ("runs", int(), "do", int(), "publish" | "call" | "goal", "values", _, *_):
            return True
        case ("runs", int(), "do", int(), "set" | "spawn" | "move", _, *_):
            return True
        case ("checks", int(), "during", int()):
            return True
        case ("checks", int(), "with", str() as key, *_):
            return key not in FIXED
    return False


def _misfit(content: Mapping[str, Any]) -> str:
    ((key, terms),) = content.items()
    if isinstance(terms, tuple) and len(terms) != 2:
        return f"{key} takes two values, such as {{{key}: [2.0, radius]}}, not {len(terms)}"
    return (
        f"{key} takes two values, such as {{{key}: [2.0, radius]}}; each is a number, a name or "
        f"one of {WORDS}"
    )


def _faults(form: Computed, draws: Draws, loc: Loc) -> Iterator[Fault]:
    """Yield what is wrong with the names of a form and with what it computes."""
    unknown = [name for name in form.names if name not in draws]
    for name in unknown:
        hint = meant_or_known(name, tuple(draws)) if draws else ": the assignment has no draw:"
        if (verb := nearest(name, OPERATIONS)) and not draws:
            hint += f" (did you mean '{verb}'?)"
        yield loc, f"unknown drawn value '{name}'{hint}"
    if unknown:
        return
    if form.operation != DRAWN:
        for name in form.names:
            if draws[name].is_text:
                kind = "a text" if isinstance(draws[name].values[0], str) else "true or false"
                yield loc, f"{WORDS} are for numbers, and '{name}' is {kind}"
                return
    if count_of(draws, form.names) > MOST_TOGETHER:
        names = ", ".join(form.names)
        yield loc, f"{names} have more than {MOST_TOGETHER} values together: make a step larger"
        return
    for values in combinations(draws, form.names):
        try:
            form.of(values)
        except ZeroDivisionError:
            yield loc, f"it divides by 0 if {shown(values)}"
            return


def with_values(document: Document, places: Sequence[FormPlace], values: Values) -> Document:
    """Return the document as it is for drawn values, without its `draw:`."""
    content = {key: value for key, value in document.content.items() if key != DRAW}
    for loc, form in places:
        content = put(content, loc, form.of(values))
    return replace(document, content=content)


def checked(draws: Draws, check: Callable[[Values], T]) -> T:
    """Return what `check` returns for the lowest values, after it was called for all extremes.

    Raises AssignmentError; a line of it that does not come up for all values says for which.
    """
    made: list[T] = []
    lines: dict[str, list[Values]] = {}
    tried = 0
    for values in extremes(draws):
        tried += 1
        try:
            made.append(check(values))
        except AssignmentError as error:
            for line in str(error).split("\n"):
                lines.setdefault(line, []).append(values)
    if not lines:
        return made[0]
    texts = [
        line if len(found) == tried else f"{line} (if {shown(found[0])})"
        for line, found in lines.items()
    ]
    raise AssignmentError("\n".join(texts))


def slots_of(places: Sequence[FormPlace], first: Loc) -> tuple[Slot, ...]:
    """Return the forms below a place, with their places from there on."""
    depth = len(first)
    return tuple(Slot(place=loc[depth:], form=form) for loc, form in places if loc[:depth] == first)
