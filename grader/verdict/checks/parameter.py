"""Kinds of check for parameters: declared, with a type and a default, and settable."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from grader.base.i18n.message import say
from grader.base.nearest import nearest, with_difference
from grader.course.values import Form, shown_value
from grader.verdict.checks.declare import kind
from grader.verdict.checks.foreign import must_own_parameters
from grader.verdict.checks.parameters import Parameters
from grader.verdict.outcome import Blocked, Failed, Inconclusive, Passed

if TYPE_CHECKING:
    from grader.verdict.use import Use

ELSEWHERE = ("parameter.not_declared", "parameter.wrong_type")  # why a change is refused


class Declared(Parameters):
    """A parameter with a type (`double`, `integer`, `bool`, `string`, …) and a value at the start."""

    name: str
    type: str = ""
    value: Any = None


class Accepts(Parameters):
    """The stimulus `after` set the parameter."""

    name: str


@kind("parameter.declared", Declared, after=["graph.node_name"])
def declared(use: Use[Declared]) -> Passed:
    """The node has the parameter {name}"""
    given = use.given
    must_own_parameters(use)
    found = use.seen.parameters.get(use.node)
    if found is None:
        raise Inconclusive(say("the parameters of {node} could not be read", node=use.node))
    names = [one.name for one in found]
    words = {"name": given.name, "type": given.type}
    where = use.call("declare_parameter", mentions=given.name)
    expected = say("the parameter {name}", name=given.name)
    own = next((one for one in found if one.name == given.name), None)
    if own is None:
        close = nearest(given.name, names) or ""
        raise Failed(
            "parameter.not_declared",
            expected=expected,
            actual=with_difference(", ".join(names), close, given.name)
            if close
            else say("{node} has no parameter of that name", node=use.node),
            where=where,
            params={"close": close} if close else {},
            words={**words, "close": close},
            variant="close" if close else "",
        )
    if given.type and own.type != given.type:
        raise Failed(
            "parameter.wrong_type",
            expected=given.type,
            actual=say(
                "{type}, with the value {value}", type=own.type, value=shown_value(own.value)
            ),
            where=where,
            params={"type": own.type},
            words=words,
        )
    form = Form.model_validate(given.value) if given.value is not None else None
    if form is not None and not form.fits(own.value):
        raise Failed(
            "parameter.wrong_value",
            expected=form.words,
            actual=shown_value(own.value),
            where=where,
            words={**words, "wanted": form.words},
        )
    return Passed(actual=f"{own.name}: {shown_value(own.value)} ({own.type})")


@kind("parameter.accepts", Accepts, after=["parameter.declared"], stimulus=["set"])
def accepts(use: Use[Accepts]) -> Passed:
    """The parameter {name} can be set while the node runs"""
    name = use.given.name
    done = use.seen.stimulus(use.use.after)
    if done is None:
        raise use.unreached()
    for other in use.evidence.assignment.checks:
        if use.evidence.has_mistake(other.id, *ELSEWHERE):
            raise Blocked(by=other.id)
    if name not in done.accepted and (use.run.ended_by_itself or use.seen.stuck is not None):
        raise Blocked(by="run.stays")
    must_own_parameters(use)
    reason = done.accepted.get(name, say("the node did not answer"))
    if reason:
        raise Failed(
            "parameter.refused",
            expected=say("ros2 param set changes {name}", name=name),
            actual=reason,
            where=use.call("add_on_set_parameters_callback", "declare_parameter", mentions=name),
            words={"name": name},
        )
    if name in done.unproven:
        raise Failed(
            "parameter.no_effect",
            expected=say("the node's own parameter {name} changes", name=name),
            actual=say("it says yes, and tells no change on /parameter_events")
            if done.unproven[name] == "event"
            else say("it says yes, and the parameter does not have the new value"),
            where=use.call("create_service", "declare_parameter", mentions=name),
            words={"name": name},
        )
    return Passed(actual=say("accepted at {at} s", at=f"{done.at:g}"))
