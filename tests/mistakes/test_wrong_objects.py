"""What a variable holds that is used as a node or an executor, and names that only look so."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import OTHERWISE, RIGHT, line_of, raised

MADE = "node = MyFirstNode()"
NO_DESTROY = "AttributeError: '{}' object has no attribute 'destroy_node'"
NO_NODE = "TypeError: Executor.add_node() missing 1 required positional argument: 'node'"


@pytest.mark.parametrize(
    ("kind", "new", "written", "variant"),
    [
        ("tuple", "node = MyFirstNode(),", "MyFirstNode()", ""),
        ("tuple", "node = (MyFirstNode(),)", "MyFirstNode()", "brackets"),
        ("list", "node = [MyFirstNode()]", "MyFirstNode()", "brackets"),
        ("set", "node = {MyFirstNode()}", "MyFirstNode()", "brackets"),
    ],
)
def test_the_line_that_puts_the_node_in_a_tuple_is_named(
    kind: str, new: str, written: str, variant: str
) -> None:
    text = RIGHT.replace(MADE, new)
    found = raised(NO_DESTROY.format(kind), text, line_of(text, "destroy_node"))
    assert found is not None
    assert (found.kind, found.variant) == ("node.object_in_tuple", variant)
    assert found.params["written"] == written
    assert found.where is not None
    assert found.where.line == line_of(text, new)


def test_an_error_about_another_type_is_no_misspelt_method_of_the_node() -> None:
    for kind in ("tuple", "list", "NoneType", "int", "function"):
        found = raised(NO_DESTROY.format(kind), RIGHT, line_of(RIGHT, "destroy_node"))
        assert found is not None
        assert found.kind != "node.method_misspelt"


def test_two_values_of_a_variable_are_not_told_as_one() -> None:
    text = RIGHT.replace(MADE, f"{MADE}\n    node = MyFirstNode(),")
    found = raised(NO_DESTROY.format("tuple"), text, line_of(text, "destroy_node"))
    assert found is None or found.kind != "node.object_in_tuple"


def test_an_executor_that_is_a_class_is_named_where_it_is_set() -> None:
    text = OTHERWISE.replace("SingleThreadedExecutor()", "SingleThreadedExecutor")
    found = raised(NO_NODE, text, line_of(text, "add_node"))
    assert found is not None
    assert found.kind == "node.class_not_called"
    assert found.params["written"] == "executor = SingleThreadedExecutor()"
    assert found.where is not None
    assert found.where.line == line_of(text, "executor = ")


def test_a_node_that_is_missing_in_add_node_keeps_its_answer() -> None:
    text = OTHERWISE.replace("add_node(hello)", "add_node()")
    found = raised(NO_NODE, text, line_of(text, "add_node"))
    assert found is not None
    assert found.kind == "node.argument_missing"
