"""Each student's page has a safe and unique name, whatever the student's key is."""

from __future__ import annotations

import re

import pytest
from hypothesis import given, strategies

from grader.publish.pages.names import page_names

KEYS = ["../../etc/passwd", "a/b", "a\\b", "", ".", "..", ".hidden", "-rf", "con", "NUL", "x" * 300,
        "Ünï", "a b", 'q"uote', "a\nb", "javascript:alert(1)", "\u202egnp.exe", "%2e%2e"]  # fmt: skip


@given(strategies.lists(strategies.text(max_size=80), unique=True, max_size=30))
def test_names_are_safe_and_unique_even_if_case_is_ignored(
    keys: list[str],
) -> None:
    names = page_names(keys)
    assert set(names) == set(keys)
    assert len({name.lower() for name in names.values()}) == len(keys)
    for name in names.values():
        assert re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9_-]{0,70}\.html", name)


@pytest.mark.parametrize("key", KEYS)
def test_a_key_that_is_not_a_file_name_gets_one(key: str) -> None:
    name = page_names([key])[key]
    assert re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9_-]*\.html", name)
    assert name.removesuffix(".html").lower() not in ("con", "nul")


def test_a_plain_key_is_used_as_the_name() -> None:
    assert page_names(["1041"]) == {"1041": "1041.html"}


def test_keys_that_differ_only_in_case_get_different_names() -> None:
    names = page_names(["Ann", "ann"])
    assert names["Ann"].lower() != names["ann"].lower()


def test_no_key_can_take_another_students_page() -> None:
    theirs = page_names(["a b"])["a b"]
    chosen = theirs.removesuffix(".html")
    names = page_names(["a b", chosen])
    assert names["a b"] == theirs
    assert names[chosen] != theirs


def test_names_do_not_depend_on_the_order_of_the_class() -> None:
    keys = ["b", "a b", "B", "1"]
    assert page_names(keys) == page_names(reversed(keys))
