"""What a variable holds that is used as a node or an executor, and names that only look so."""

from __future__ import annotations

from tests.mistakes.test_from_source import OTHERWISE, line_of, raised

NO_NODE = "TypeError: Executor.add_node() missing 1 required positional argument: 'node'"


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
