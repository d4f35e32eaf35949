"""Kinds of check for services: who offers and calls them, and what they answer."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pydantic import Field

from grader.base.i18n.message import say
from grader.course.values import Form, forms_in_words
from grader.verdict.checks.declare import kind
from grader.verdict.checks.fields import must_fit
from grader.verdict.checks.foreign import must_own_service
from grader.verdict.checks.offered import must_offer
from grader.verdict.checks.parameters import EDGE, Parameters
from grader.verdict.outcome import Blocked, Failed, Passed

if TYPE_CHECKING:
    from grader.run.observations import Role
    from grader.verdict.use import Use


class Service(Parameters):
    """A service and its type."""

    service: str
    type: str


class Answers(Parameters):
    """The form of fields in the answer to the call `after`, within a time (s; 0: at its instant)."""

    service: str
    within: float = Field(default=0.0, ge=0)
    each: dict[str, Form] = Field(default_factory=dict)


@kind("service.offers", Service, after=["graph.node_name"])
def offers(use: Use[Service]) -> Passed:
    """The node offers the service {service}, of the type {type}"""
    return _must_have("service", use)


@kind("service.calls", Service, after=["graph.node_name"])
def calls(use: Use[Service]) -> Passed:
    """The node is a client of the service {service}, of the type {type}"""
    return _must_have("client", use)


def _must_have(role: Role, use: Use[Service]) -> Passed:
    own = [(end.name, end.type) for end in use.ends(role)]
    passed = must_offer(
        use,
        own,
        use.given.service,
        use.given.type,
        made_by="create_service" if role == "service" else "create_client",
        family="service",
        missing="service.missing" if role == "service" else "service.no_client",
    )
    must_own_service(use, role, use.given.service)
    return passed


@kind("service.answers", Answers, after=["service.offers"], stimulus=["call"])
def answers(use: Use[Answers]) -> Passed:
    """The service {service} answers as it must"""
    given = use.given
    done = use.seen.stimulus(use.use.after)
    if done is None:
        raise use.unreached()
    if not done.heard:
        use.blocked_by("service.offers")
    must_own_service(use, "service", given.service)
    where = use.call("create_service", mentions=given.service)
    words = {"service": given.service}
    expected = forms_in_words(given.each)
    if done.replied is None and (use.run.ended_by_itself or use.seen.stuck is not None):
        raise Blocked(by="run.stays")
    if done.replied is None or done.replied > done.at + given.within + EDGE:
        raise Failed(
            "service.no_answer",
            expected=expected or say("an answer within {within} s", within=f"{given.within:g}"),
            actual=say("no answer came"),
            where=where,
            words=words,
        )
    must_fit(done.reply, given.each, "service.wrong_answer", where=where, words=words)
    return Passed(actual=say("it answered at {at} s", at=f"{done.replied:g}"))
