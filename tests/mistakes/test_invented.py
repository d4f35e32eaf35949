"""The invented mistakes are packages of their own, and each names a check that exists."""

from __future__ import annotations

from grader.package.edit.tree import apply_all, digest, read_tree
from tests.corpus.broken import BROKEN
from tests.corpus.build import SOLUTION
from tests.corpus.model import POINTS
from tests.mistakes.invented import INVENTED


def test_there_are_more_than_150_different_packages() -> None:
    solution = read_tree(SOLUTION)
    made = [digest(apply_all(one.edits, solution)) for one in INVENTED]
    assert len(set(made)) == len(INVENTED) > 150


def test_one_that_became_an_example_of_a_record_fails_the_check_that_it_names() -> None:
    solution = read_tree(SOLUTION)
    known = {digest(apply_all(package.edits, solution)): package for package in BROKEN}
    became = [(one, known.get(digest(apply_all(one.edits, solution)))) for one in INVENTED]
    for one, package in became:
        assert package is None or one.fails in package.expect_failed, one.name
    assert any(package is not None for _, package in became)


def test_each_names_a_check_a_cause_and_a_place() -> None:
    names = [one.name for one in INVENTED]
    assert len(set(names)) == len(names)
    for one in INVENTED:
        assert one.fails in POINTS, one.name
        assert one.cause.endswith("."), one.name
        assert one.place, one.name
