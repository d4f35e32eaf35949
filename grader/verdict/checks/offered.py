"""Shared by the checks of services and actions: an end of the graph with a name and a type."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from grader.base.i18n.message import say
from grader.base.nearest import nearest, with_difference
from grader.verdict.outcome import Failed, Passed

if TYPE_CHECKING:
    from grader.verdict.checks.parameters import Parameters
    from grader.verdict.use import Use


def must_offer(
    use: Use[Parameters],
    own: Sequence[tuple[str, str]],
    name: str,
    type_: str,
    *,
    made_by: str,
    family: str,
    missing: str,
) -> Passed:
    """Return Passed if one of a node's ends (`own`, with their types) is the wanted one.

    `made_by` is the call that makes it. Raises Failed with `missing`, or with the mistake
    `wrong_type` or `wrong_name` of a family.
    """
    types = [kind for found, kind in own if found == name]
    words = {"service": name, "short": type_.rpartition("/")[2], "make": made_by}
    expected = f"{name} ({type_})"
    where = use.call(made_by, mentions=name)
    if type_ in types:
        return Passed(actual=say("{node} has it", node=use.node))
    if types:
        raise Failed(
            f"{family}.wrong_type",
            expected=expected,
            actual=with_difference(types[0], types[0], type_),
            where=where,
            params={"type": types[0]},
            words=words,
        )
    names = [found for found, _ in own]
    if names:
        close = nearest(name, names) or names[0]
        raise Failed(
            f"{family}.wrong_name",
            expected=expected,
            actual=with_difference(", ".join(names), close, name),
            where=use.call(made_by, mentions=close),
            params={"name": close},
            words=words,
        )
    raise Failed(
        missing,
        expected=expected,
        actual=say("{node} has no such end on the ROS graph", node=use.node),
        where=where,
        words=words,
    )
