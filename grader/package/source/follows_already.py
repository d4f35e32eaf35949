"""Whether a source already does what an advice asks for: one small question for each part of it."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping

from grader.base.i18n.message import Value
from grader.package.source.counter import targets_of
from grader.package.source.names import called_name, dotted, last_part
from grader.package.source.node import NodeSource

Question = Callable[[NodeSource, Mapping[str, Value]], bool]


def names(*wanted: str) -> Question:
    """Return whether a source names each of these: a class, a method, a keyword or an attribute."""

    def named(source: NodeSource, values: Mapping[str, Value]) -> bool:
        del values
        found = {last_part(dotted(n)) for n in source.all_nodes if isinstance(n, ast.Name)}
        found |= {n.attr for n in source.all_nodes if isinstance(n, ast.Attribute)}
        found |= {n.arg or "" for n in source.all_nodes if isinstance(n, ast.keyword)}
        return found.issuperset(wanted)

    return named


def calls(*wanted: str) -> Question:
    """Return whether a source calls each of these, with parentheses."""

    def called(source: NodeSource, values: Mapping[str, Value]) -> bool:
        del values
        return {last_part(name) for _, name in source.calls}.issuperset(wanted)

    return called


def never(source: NodeSource, values: Mapping[str, Value]) -> bool:
    """Return False: of advice against what the source has, which is told for that reason."""
    del source, values
    return False


def publishes(source: NodeSource, values: Mapping[str, Value]) -> bool:
    """Whether the publisher of a topic is told to publish; any one if it is not known which is it."""
    topic = str(values["topic"]).strip("/")
    made = [
        target
        for node in source.all_nodes
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Call)
        if called_name(node.value).endswith("publisher") and topic in ast.unparse(node.value)
        for target in targets_of(node)
    ]
    told = [name for _, name in source.calls if last_part(name) == "publish"]
    return any(name.removesuffix(".publish") in made for name in told) if made else bool(told)
