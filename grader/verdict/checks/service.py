"""Kinds of check for services: who offers and calls them, and what they answer."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pydantic import Field

from grader.base.i18n.message import say
from grader.base.nearest import nearest, with_difference
from grader.course.values import Form, shown_value, value_at
from grader.verdict.checks.declare import Parameters, kind
from grader.verdict.outcome import Blocked, Failed, Passed

if TYPE_CHECKING:
    from grader.run.observations import Role
    from grader.verdict.use import Use

OWN = (
    "describe_parameters",
    "get_parameter_types",
    "get_parameters",
    "list_parameters",
    "set_parameters",
    "set_parameters_atomically",
    "get_type_description",
)


class Service(Parameters):
    """A service and its type."""

    service: str
    type: str


class Answers(Parameters):
    """The form of fields in the answer to the call `after`, within a time (s)."""

    service: str
    within: float = Field(default=0.0, ge=0)
    each: dict[str, Form] = Field(default_factory=dict)


@kind("service.offers", Service, after=["run.node_name"])
def offers(use: Use[Service]) -> Passed:
    """The node offers the service {service}, of the type {type}"""
    return _must_have("service", use)


@kind("service.calls", Service, after=["run.node_name"])
def calls(use: Use[Service]) -> Passed:
    """The node is a client of the service {service}, of the type {type}"""
    return _must_have("client", use)


def _must_have(role: Role, use: Use[Service]) -> Passed:
    given = use.given
    make = "create_service" if role == "service" else "create_client"
    ends = (end for end in use.ends(role) if "/_action/" not in end.name)
    own = [end for end in ends if end.name.rpartition("/")[2] not in OWN]
    here = [end for end in own if end.name == given.service]
    expected = f"{given.service} ({given.type})"
    words = {"service": given.service, "short": given.type.rpartition("/")[2], "make": make}
    where = use.call(make, mentions=given.service)
    if any(end.type == given.type for end in here):
        return Passed(actual=say("{node} has it", node=use.node))
    if here:
        raise Failed(
            "service.wrong_type",
            expected=expected,
            actual=with_difference(here[0].type, here[0].type, given.type),
            where=where,
            params={"type": here[0].type},
            words=words,
        )
    names = [end.name for end in own]
    if names:
        close = nearest(given.service, names) or names[0]
        raise Failed(
            "service.wrong_name",
            expected=expected,
            actual=with_difference(", ".join(names), close, given.service),
            where=use.call(make, mentions=close),
            params={"name": close},
            words=words,
        )
    raise Failed(
        "service.missing" if role == "service" else "service.no_client",
        expected=expected,
        actual=say("{node} has no such end on the ROS graph", node=use.node),
        where=where,
        words=words,
    )


@kind("service.answers", Answers, after=["service.offers"])
def answers(use: Use[Answers]) -> Passed:
    """The service {service} answers as it must"""
    given = use.given
    done = use.seen.stimulus(use.use.after)
    if done is None:
        raise use.unreached()
    if not done.heard:
        use.blocked_by("service.offers")
    where = use.call("create_service", mentions=given.service)
    words = {"service": given.service}
    expected = ", ".join(f"{path}: {form}" for path, form in given.each.items())
    if done.replied is None and (use.run.ended_by_itself or use.seen.stuck is not None):
        raise Blocked(by="run.stays")
    if done.replied is None or done.replied > done.at + given.within + 1e-6:
        raise Failed(
            "service.no_answer",
            expected=expected or say("an answer within {within} s", within=f"{given.within:g}"),
            actual=say("no answer came"),
            where=where,
            words=words,
        )
    for path, form in given.each.items():
        value = value_at(done.reply, path)
        if not form.fits(value):
            raise Failed(
                "service.wrong_answer",
                expected=f"{path}: {form}",
                actual=f"{path}: {shown_value(value)}",
                where=where,
                params={"field": path},
                words=words,
            )
    return Passed(actual=say("it answered at {at} s", at=f"{done.replied:g}"))
