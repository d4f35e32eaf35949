"""The forms of values in assignments of schema 2."""

from __future__ import annotations

import math
from typing import Any

import pytest
from pydantic import ValidationError

from grader.course.values import Form, at_path, first_misfit


@pytest.mark.parametrize(
    ("form", "fitting", "other"),
    [
        (2.0, [2.0, 2, 2.0000000001, 1.9999999], [2.1, "2.0", True, None, [2.0]]),
        (0.1, [0.10000000149011612], [0.1001]),  # as a float32 field returns it
        (True, [True], [1, 1.0, "true", False]),
        ("go", ["go"], ["Go", "go "]),
        ({"about": 1.0, "within": 0.01}, [1.0, 1.01, 0.99], [1.02, "1.0", math.nan]),
        ({"between": (0.0, 2.0)}, [0, 1.5, 2.0], [-0.1, 2.1]),
        ({"one_of": (1, "a")}, [1, "a"], [2, "b"]),
        ({"matches": "^Turn(ed|ing)$"}, ["Turned"], ["turned", 3]),
        ({"contains": "wall"}, ["the wall!"], ["Wall", 3]),
        ({"from": 3, "step": 2}, [3, 3.0], [5, "3", True]),
    ],
)
def test_a_form_fits_what_it_says(form: Any, fitting: list[Any], other: list[Any]) -> None:
    found = Form.model_validate(form)
    assert [value for value in fitting if not found.fits(value)] == []
    assert [value for value in other if found.fits(value)] == []


@pytest.mark.parametrize(
    ("form", "word"),
    [
        ({"about": 1.0}, "within"),
        ({"within": 1.0}, "about"),
        ({"about": 1.0, "within": 0.1, "equal": 1.0}, "exactly one"),
        ({}, "exactly one"),
        ({"matches": "("}, "regular expression"),
        ({"step": 1.0}, "from"),
        ({"from": 1.0, "equal": 1.0}, "exactly one"),
    ],
)
def test_a_form_that_says_nothing_or_two_things_is_refused(form: Any, word: str) -> None:
    with pytest.raises(ValidationError, match=word):
        Form.model_validate(form)


@pytest.mark.parametrize(
    ("form", "values", "wrong"),
    [
        ({"from": 0, "step": 1}, [0, 1, 2, 3], None),
        ({"from": 0}, [0, 1, 2], None),
        ({"from": 0.5, "step": -0.25}, [0.5, 0.25, 0.0], None),
        ({"from": 0, "step": 1}, [0, 1, 1], 2),
        ({"from": 0, "step": 1}, [1, 2, 3], 0),
        ({"from": 0, "step": 2}, [0, 1, 2], 1),
        ({"between": (0, 2)}, [0, 1, 3], 2),
    ],
)
def test_messages_that_count_are_compared_one_by_one(
    form: Any, values: list[float], wrong: int | None
) -> None:
    each = {"data": Form.model_validate(form)}
    misfits = [n for n, value in enumerate(values) if first_misfit({"data": value}, each, n)]
    assert misfits[:1] == ([] if wrong is None else [wrong])


def test_a_form_that_counts_is_shown_as_its_first_values() -> None:
    form = Form.model_validate({"from": 5, "step": 5})
    assert (str(form), str(form.at(3))) == ("5, 10, 15, …", "20")


def test_a_path_leads_to_a_field() -> None:
    values = {"linear": {"x": 2.0}, "ranges": [1.0, 3.0], "name": "a"}
    assert at_path(values, "linear.x") == 2.0
    assert at_path(values, "ranges[1]") == 3.0
    for path in ("linear.y", "ranges[2]", "name.x", "linear.x.y", ""):
        if path:
            with pytest.raises(KeyError):
                at_path(values, path)


@pytest.mark.parametrize("form", [{"equal": [0, 1, 0.1]}, {"one_of": [[5], [0, 1, 0.1]]}])
def test_an_array_is_compared_value_by_value(form: dict[str, object]) -> None:
    wanted = Form.model_validate(form)
    assert wanted.fits([0, 1, 0.10000000149])  # (a float32)
    assert wanted.fits((0, 1, 0.1))
    assert not wanted.fits([0, 1])
    assert not wanted.fits([0, 1, 0.2])
    assert str(wanted).endswith("[0, 1, 0.1]")
