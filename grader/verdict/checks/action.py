"""Kinds of check for actions: who offers them, and what becomes of a goal."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from pydantic import Field

from grader.base.i18n.message import joined, say, say_plural
from grader.course.values import Form, first_misfit, shown_value
from grader.package.source.action_sleeps import sleep_in_action
from grader.report.model import Where
from grader.run.names_of_ros import ACTION
from grader.verdict.checks.declare import kind
from grader.verdict.checks.fields import must_fit
from grader.verdict.checks.foreign import must_own_action
from grader.verdict.checks.offered import must_offer
from grader.verdict.checks.parameters import EDGE, Parameters
from grader.verdict.node_files import source_of_node
from grader.verdict.outcome import Blocked, Failed, Passed

if TYPE_CHECKING:
    from grader.run.observations import Goal
    from grader.verdict.use import Use

SEND_GOAL = f"{ACTION}send_goal"
OF_TYPE = "_SendGoal"
Status = Literal["succeeded", "canceled", "aborted"]


class Action(Parameters):
    """An action and its type."""

    action: str
    type: str


class Accepts(Parameters):
    """Whether the goal `after` is accepted."""

    action: str
    accepted: bool = True


class Feedback(Parameters):
    """At least so many messages of feedback to the goal `after`, with fields of a form."""

    action: str
    at_least: int = Field(default=1, ge=1)
    each: dict[str, Form] = Field(default_factory=dict)


class Result(Parameters):
    """How the goal `after` ends, within a time (s), and the form of fields in its result."""

    action: str
    status: Status = "succeeded"
    within: float = Field(ge=0)
    each: dict[str, Form] = Field(default_factory=dict)


class Cancels(Parameters):
    """The goal of the cancellation `after` ends as canceled, within a time (s)."""

    action: str
    within: float = Field(ge=0)


@kind("action.offers", Action, after=["graph.node_name"])
def offers(use: Use[Action]) -> Passed:
    """The node offers the action {action}, of the type {type}"""
    own = [
        (end.name.removesuffix(SEND_GOAL), end.type.removesuffix(OF_TYPE))
        for end in use.ends("service", of_actions=True)
        if end.name.endswith(SEND_GOAL)
    ]
    passed = must_offer(
        use,
        own,
        use.given.action,
        use.given.type,
        made_by="ActionServer",
        family="action",
        missing="action.missing",
    )
    must_own_action(use, use.given.action)
    return passed


@kind("action.accepts", Accepts, after=["action.offers"], stimulus=["goal"])
def accepts(use: Use[Accepts]) -> Passed:
    """The action {action} accepts or refuses the goal as it must"""
    given, goal = use.given, _goal(use)
    accepted = goal.accepted is not None
    if not accepted and goal.refused is None:
        raise _unanswered(use, given.action)
    words = {True: say("it accepts the goal"), False: say("it refuses the goal")}
    if accepted is not given.accepted:
        raise Failed(
            "action.refused" if given.accepted else "action.accepted",
            expected=words[given.accepted],
            actual=words[accepted],
            where=use.call("ActionServer", mentions=given.action),
            words={"service": given.action},
        )
    return Passed(actual=words[accepted])


@kind("action.feedback", Feedback, after=["action.accepts"], stimulus=["goal"])
def feedback(use: Use[Feedback]) -> Passed:
    """The action {action} gives feedback on the goal"""
    given, goal = use.given, _accepted(use, use.given.action)
    where = use.call("publish_feedback")
    count = say_plural(
        "{count} message of feedback", "{count} messages of feedback", len(goal.feedback)
    )
    if len(goal.feedback) < given.at_least:
        use.require_window()
        where, variant = _waits(use, where)
        raise Failed(
            "action.no_feedback",
            variant=variant,
            expected=say_plural(
                "at least {count} message of feedback",
                "at least {count} messages of feedback",
                given.at_least,
            ),
            actual=count,
            where=where,
            words={"service": given.action},
        )
    for index, (at, values) in enumerate(goal.feedback):
        wrong = first_misfit(values, given.each, index)
        if wrong is not None:
            path, form, value = wrong
            raise Failed(
                "action.wrong_feedback",
                expected=joined(path, form.words, by=": "),
                actual=say(
                    "{path}: {value}, in the message at {at} s",
                    path=path,
                    value=shown_value(value),
                    at=f"{at:g}",
                ),
                where=where,
                params={"field": path},
                words={"service": given.action},
            )
    return Passed(actual=count)


@kind("action.result", Result, after=["action.accepts", "action.feedback"], stimulus=["goal"])
def result(use: Use[Result]) -> Passed:
    """The goal of the action {action} ends as it must"""
    given, goal = use.given, _accepted(use, use.given.action)
    where = use.call("succeed", "abort", "canceled", "ActionServer", mentions=given.action)
    words = {"service": given.action, "wanted": given.status}
    expected = say(
        "the goal ends as {status} within {within} s",
        status=given.status,
        within=f"{given.within:g}",
    )
    if goal.ended is None or goal.ended > goal.at + given.within + EDGE:
        if use.end < goal.at + given.within - EDGE:
            raise use.unreached()
        late = say("it ends at {at} s", at=f"{goal.ended:g}") if goal.ended is not None else ""
        where, variant = _waits(use, where)
        raise Failed(
            "action.no_result",
            variant=variant,
            expected=expected,
            actual=late or say("the goal does not end"),
            where=where,
            words=words,
        )
    if goal.status != given.status:
        raise Failed(
            "action.wrong_status",
            expected=expected,
            actual=say("it ends as {status}", status=goal.status),
            where=where,
            params={"found": goal.status},
            words=words,
        )
    must_fit(goal.result, given.each, "action.wrong_result", where=where, words=words)
    return Passed(actual=say("it ends as {status}", status=goal.status))


@kind("action.cancels", Cancels, after=["action.accepts", "action.result"], stimulus=["cancel"])
def cancels(use: Use[Cancels]) -> Passed:
    """A goal of the action {action} can be cancelled"""
    given = use.given
    begin = use.window[0]
    stimulus = use.plan.stimulus(use.use.after)
    goal = use.seen.goal((stimulus.cancel if stimulus is not None else None) or "")
    must_own_action(use, given.action)
    if goal is None or goal.accepted is None:
        use.blocked_by("action.accepts", "action.offers")
        raise Blocked(by="run.stays")
    if (
        goal.ended is not None
        and goal.status == "canceled"
        and goal.ended <= begin + given.within + EDGE
    ):
        return Passed(actual=say("it ends as {status}", status=goal.status))
    if use.end < begin + given.within - EDGE:
        raise use.unreached()
    ended = ""
    if goal.ended is not None:
        at, after = f"{goal.ended:g}", f"{goal.ended - begin:g}"
        ended = (
            say("it ends as {status} at {at} s, before it is cancelled", status=goal.status, at=at)
            if goal.ended < begin
            else say(
                "it ends as {status} at {at} s, {after} s after the request to cancel it",
                status=goal.status,
                at=at,
                after=after,
            )
        )
    where, variant = use.call("ActionServer", mentions=given.action), ""
    if goal.refused is None:
        where, variant = _waits(use, where)
    use.blocked_by("action.cancels", action=given.action)  # (told once, whatever a use adds to it)
    raise Failed(
        "action.not_cancelled",
        variant=variant,
        expected=say(
            "the goal ends as {status} within {within} s",
            status="canceled",
            within=f"{given.within:g}",
        ),
        actual=say("the node refuses to cancel it")
        if goal.refused is not None
        else ended or say("the goal does not end"),
        where=where,
        words={"service": given.action},
    )


def _waits(use: Use[Parameters], where: Where) -> tuple[Where, str]:
    """Return the line on which the action waits by the wall clock and the variant for it.

    If none does, these are `where` and "".
    """
    source = source_of_node(use.evidence)
    call = sleep_in_action(source) if source is not None else None
    if source is None or call is None:
        return where, ""
    return Where(file=source.module_of(call).path, line=call.lineno), "sleeps"


def _goal(use: Use[Accepts] | Use[Feedback] | Use[Result]) -> Goal:
    """Return the goal that the check names. Raises Blocked if the action is not offered.

    Failed if another node offers it too.
    """
    goal, done = use.seen.goal(use.use.after), use.seen.stimulus(use.use.after)
    if goal is None or done is None:
        raise use.unreached()
    if not done.heard:
        use.blocked_by("action.offers")
    must_own_action(use, use.given.action)
    return goal


def _accepted(use: Use[Feedback] | Use[Result], action: str) -> Goal:
    """Return the goal, which was accepted. Raises Blocked if it was not."""
    goal = _goal(use)
    if goal.accepted is None:
        use.blocked_by("action.accepts")
        raise _unanswered(use, action)
    return goal


def _unanswered(use: Use[Parameters], action: str) -> Failed:
    return Failed(
        "action.no_answer",
        expected=say("the node answers the goal"),
        actual=say("no answer came"),
        where=use.call("ActionServer", mentions=action),
        words={"service": action},
    )
