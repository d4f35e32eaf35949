"""Each operator has the change that takes a beginner's mistake back, and hides no expression."""

from __future__ import annotations

import ast
from pathlib import Path
from typing import Any

import pytest
import yaml

from grader.change.operator import Site, Wanted, all_made
from grader.change.table import BY_SORT, TABLE
from grader.package.source.module import parse_module
from tests.processes import ROOT

HERE = Path(__file__).parent
EXAMPLES = yaml.safe_load((HERE / "examples.yaml").read_text(encoding="utf-8"))
KEYS = ROOT / "grader" / "keys"
NOT_NODES = ("__init__.py", "setup.py")


def node_of(lesson: str) -> str:
    """Return the text of the node of a lesson's right package."""
    found = sorted((KEYS / lesson / "solution").rglob("*.py"))
    (file,) = (one for one in found if one.name not in NOT_NODES)
    return file.read_text(encoding="utf-8")


def site_of(text: str, given: dict[str, Any]) -> Site:
    wanted = Wanted(
        tuple(given.get("numbers", ())),
        tuple(given.get("texts", ())),
        tuple(given.get("fields", {}).items()),
        tuple(given.get("types", ())),
        tuple(given.get("paths", ())),
    )
    return Site(parse_module("robot/node.py", text.encode()), wanted)


@pytest.mark.parametrize("given", EXAMPLES, ids=lambda one: f"{one['lesson']}-{one['back']}")
def test_an_operator_takes_a_mistake_back(given: dict[str, Any]) -> None:
    right = node_of(given["lesson"])
    assert right.count(given["old"]) == given.get("times", 1)
    broken = right.replace(given["old"], given["new"])
    made = all_made(site_of(broken, given), [BY_SORT[given["back"]]])
    wanted = right.replace(given["old"], given.get("becomes", given["old"]))
    assert wanted in [text for _, _, text in made]


def test_every_operator_has_a_name_of_its_own() -> None:
    assert len(BY_SORT) == len(TABLE)


VALUE = """\
class Robot(Node):
    def speed(self):
        message = Twist()
        message.linear.x = self.speed * self.factor
        self.publisher.publish(message)
"""


def test_no_operator_puts_the_wanted_value_in_place_of_an_expression() -> None:
    site = site_of(VALUE, {"numbers": [1.25], "fields": {"linear.x": 1.25}})
    for row, _, text in all_made(site, TABLE):
        numbers = [n for n in ast.walk(ast.parse(text)) if isinstance(n, ast.Constant)]
        assert 1.25 not in [n.value for n in numbers], row.sort


HELD = """\
class Robot(Node):
    def ask(self):
        try:
            self.go()
        except ValueError:
            raise
        if self.ready:
            self.publisher.publish(self.made())
"""


def test_no_operator_swallows_an_error_or_removes_a_condition() -> None:
    before = ast.dump(ast.parse(HELD))
    for row, _, text in all_made(site_of(HELD, {}), TABLE):
        after = ast.parse(text)
        names = [type(n).__name__ for n in ast.walk(after)]
        assert names.count("Try") == 1, row.sort
        assert names.count("Raise") == 1, row.sort
        assert names.count("If") >= 1, row.sort
        assert ast.dump(after) != before


KEPT = """\
class Robot(Node):
    def __init__(self):
        self.is_on = False
        self.way = 0.0

    def on_drive(self, request, response):
        self.is_on = not self.is_on
        self.way = self.way_of(request.data, self.is_on)
        if self.is_on:
            self.go()
        else:
            self.stop()
        self.tell()
        return response

    def way_of(self, data, is_on):
        return data * is_on
"""


def changes_of(sort: str) -> list[tuple[str, str]]:
    made = all_made(site_of(KEPT, {}), [BY_SORT[sort]])
    return [(one.name, one.written) for _, one, _ in made]


def test_only_numbers_are_added_to() -> None:
    written = [new for _, new in changes_of("added")]
    assert written == ["self.way += self.way_of(request.data, self.is_on)"]


def test_arguments_with_the_names_of_their_parameters_are_not_swapped() -> None:
    assert changes_of("swapped") == []


def test_a_moved_line_is_told_with_the_condition_under_which_it_runs_then() -> None:
    assert changes_of("into") == [
        ("self.tell()", "not (self.is_on)"),
        ("self.tell()", "self.is_on"),
    ]


def test_a_value_that_does_not_read_the_request_is_replaced_by_it() -> None:
    assert ("not self.is_on", "request.data") in changes_of("asked_data")
