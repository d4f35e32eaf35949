"""Kinds of check for topics: who publishes and subscribes, what, when and with which QoS."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Literal

from pydantic import Field

from grader.base.i18n.message import Message as Text
from grader.base.i18n.message import joined, say, say_plural
from grader.base.i18n.times import times
from grader.base.nearest import nearest, with_difference
from grader.course.scenario import DEEDS
from grader.course.values import Form, first_misfit, forms_in_words, shown_value
from grader.course.worlds import is_of_world
from grader.run.observations import CREATES, refused
from grader.verdict.checks.declare import ANSWERS, kind
from grader.verdict.checks.fields import is_integer_bits
from grader.verdict.checks.foreign import must_be_alone, must_send_itself
from grader.verdict.checks.instants import stops_before, usual_gap, wrong_gaps
from grader.verdict.checks.parameters import EDGE, Parameters
from grader.verdict.outcome import Blocked, Failed, Passed

if TYPE_CHECKING:
    from grader.run.observations import End, Message, Role
    from grader.verdict.use import Use

CLOCK_STARTS = 0.001  # seconds of ROS time


class Publishes(Parameters):
    """`at_least` messages of a type on a topic."""

    topic: str
    type: str
    at_least: int = Field(default=1, ge=0)


class Subscribes(Parameters):
    """A subscription of a type to a topic."""

    topic: str
    type: str


class Period(Parameters):
    """A message every `period` s of ROS time."""

    topic: str
    period: float = Field(gt=0)


class Each(Parameters):
    """The form of fields in each message."""

    topic: str
    each: dict[str, Form] = Field(min_length=1)


class Silent(Parameters):
    """No message in the window; those of a constructor do not count: who receives them is chance."""

    topic: str


class Reacts(Parameters):
    """A message within a time of a stimulus, with fields of a form; at most so many in that time."""

    topic: str
    within: float = Field(ge=0)
    each: dict[str, Form] = Field(default_factory=dict)
    at_most: int | None = Field(default=None, ge=1)


class Quality(Parameters):
    """The quality of service of a node's end."""

    topic: str
    role: Literal["publisher", "subscription"] = "publisher"
    reliability: Literal["", "reliable", "best_effort"] = ""
    durability: Literal["", "volatile", "transient_local"] = ""


@kind("topic.publishes", Publishes, after=["topic.subscribes", *ANSWERS])
def publishes(use: Use[Publishes]) -> Passed:
    """The node publishes {topic}, of the type {type}"""
    given = use.given
    expected = say(
        "{topic} ({type}) from {node}", topic=given.topic, type=given.type, node=use.node
    )
    _must_have("publisher", given.topic, given.type, use, expected)
    must_send_itself(use, given.topic)
    found = use.messages(given.topic)
    if len(found) < given.at_least:
        if not found and not use.sent(given.topic):
            use.require_window()
            _must_hear(use, given.topic)
            raise Failed(
                "topic.never_published",
                expected=expected,
                actual=say("the publisher is there, but no message ever came"),
                where=use.call("publish", "create_publisher", mentions=given.topic),
                words={"topic": given.topic},
            )
        use.require_window()
        raise Failed(
            "topic.too_few",
            expected=say_plural(
                "at least {count} message", "at least {count} messages", given.at_least
            ),
            actual=say_plural("{count} message", "{count} messages", len(found)),
            where=use.call("publish", mentions=given.topic),
            words={"topic": given.topic},
        )
    return Passed(actual=say_plural("{count} message", "{count} messages", len(found)))


def _must_hear(use: Use[Parameters], topic: str) -> None:
    """Raise Blocked if a topic carries reactions, and the node does not hear what it reacts to.

    Without a period, a topic carries reactions to what the node subscribes to.
    """
    checks = [one for one in use.evidence.assignment.checks if one.with_.get("topic") == topic]
    if not any(one.kind == "topic.period" for one in checks):
        use.blocked_by("topic.subscribes")
    for one in checks:
        use.blocked_by_call(one.after)


@kind("topic.subscribes", Subscribes, after=["graph.node_name"])
def subscribes(use: Use[Subscribes]) -> Passed:
    """The node subscribes to {topic}, of the type {type}"""
    given = use.given
    expected = say("{node} subscribes to {topic} ({type})", **given.model_dump(), node=use.node)
    _must_have("subscription", given.topic, given.type, use, expected)
    must_be_alone(use, use.node)
    _must_match(use, given.topic)
    return Passed(actual=say("{node} subscribes to {topic}", node=use.node, topic=given.topic))


def _must_have(role: Role, topic: str, type_: str, use: Use[Parameters], expected: Text) -> End:
    """Return the node's end on a topic; raises Failed if there is none, or of another type."""
    own = use.ends(role)
    here = [end for end in own if end.name == topic]
    right = [end for end in here if end.type == type_]
    where = use.call(CREATES[role], mentions=topic)
    if right and right[0].differs:
        raise Failed(
            "topic.other_definition",
            expected=expected,
            actual=say("{type} with other fields than in its file", type=type_),
            where=where,
            words={"topic": topic, "short": type_.rpartition("/")[2]},
        )
    if right:
        return right[0]
    if here:
        raise Failed(
            "topic.wrong_type",
            expected=expected,
            actual=with_difference(here[0].type, here[0].type, type_),
            where=where,
            params={"type": here[0].type},
            words={"topic": topic, "wanted": type_, "short": type_.rpartition("/")[2]},
        )
    asked = {one.with_.get("topic") for one in use.evidence.assignment.checks}
    free = [end for end in own if end.name not in asked]  # (what another check asks for is right)
    others = [end for end in free if end.type == type_] or free
    names = [end.name for end in others]
    if names:
        close = nearest(topic, names) or names[0]
        raise Failed(
            "topic.wrong_name",
            expected=expected,
            actual=with_difference(", ".join(names), close, topic),
            where=use.call(CREATES[role], mentions=close),
            params={"name": close},
            words={"topic": topic},
        )
    other: Role = "subscription" if role == "publisher" else "publisher"
    if any(end.name == topic for end in use.ends(other)):
        raise Failed(
            "topic.wrong_end",
            expected=expected,
            actual=say(
                "{node} has a {end} on {topic} instead", node=use.node, end=other, topic=topic
            ),
            where=use.call(CREATES[other], mentions=topic),
            words={"topic": topic, "call": CREATES[role]},
        )
    missing = "topic.no_publisher" if role == "publisher" else "topic.no_subscription"
    raise Failed(
        missing,
        expected=expected,
        actual=say("{node} has no such end on the ROS graph", node=use.node),
        where=where,
        words={"topic": topic, "short": type_.rpartition("/")[2]},
    )


def _must_match(use: Use[Parameters], topic: str) -> None:
    """Raise Failed if a publisher of the topic offers less than the node's subscription asks."""
    asked = [end for end in use.ends("subscription") if end.name == topic]
    for publisher in use.seen.ends_of("publisher", topic):
        for end in asked:
            weak = refused(publisher, end)
            if weak is not None and publisher.node != end.node:
                raise Failed(
                    "topic.qos_mismatch",
                    expected=say("QoS that fits {node}'s publisher", node=publisher.node),
                    actual=say(
                        "the subscription asks for {mine}, the publisher of {node} offers {theirs}",
                        mine=weak[0],
                        theirs=weak[1],
                        node=publisher.node,
                    ),
                    where=use.call("create_subscription", mentions=topic),
                    params={"asked": weak[0], "offered": weak[1]},
                    words={"topic": topic},
                )


@kind("topic.period", Period, after=["topic.publishes"])
def period(use: Use[Period]) -> Passed:
    """A message on {topic} comes every {period} s of ROS time"""
    given = use.given
    every = f"{given.period:g}"
    expected = say("one message every {period} s", period=every)
    must_send_itself(use, given.topic)
    found = use.messages(given.topic)
    if not found:
        raise _nothing(use)
    first, last = use.require_window()
    instants = Counter(message.at for message in found)
    where = use.call("create_timer")
    most = max(instants.values())
    if most > 1:
        raise Failed(
            "topic.several_at_once",
            expected=expected,
            actual=say("{count} messages at one instant", count=most),
            where=use.call("publish", mentions=given.topic),
            params={"count": most},
            words={"topic": given.topic},
        )
    clock = use.plan.clock.period
    wrong = wrong_gaps(sorted(instants), given.period, clock)
    due = int((last - max(first, given.period)) / given.period + 1e-6) + 1
    late = stops_before(last, list(instants), given.period, clock)
    if not wrong and not late and len(instants) >= min(2, due):
        each = say_plural(
            "{count} message, at its instant", "{count} messages, each at its instant", len(found)
        )
        return Passed(actual=each)
    if late and not wrong:
        raise Failed(
            "topic.stops",
            expected=expected,
            actual=say("the last message came at {at} s", at=f"{max(instants):g}"),
            where=use.call("publish", mentions=given.topic),
            words={"topic": given.topic},
        )
    seconds = usual_gap(sorted(instants), clock)
    raise Failed(
        "topic.wrong_period",
        expected=expected,
        actual=say("a message about every {period} s", period=f"{seconds:g}"),
        where=where,
        params={"period": seconds},
        words={"topic": given.topic, "wanted": every},
    )


def _nothing(use: Use[Period] | Use[Each]) -> Failed:
    """Return the failure of a topic without messages; Blocked if the check of the publisher says it."""
    use.blocked_by("topic.publishes")
    use.require_window()
    topic = use.given.topic
    return Failed(
        "topic.never_published",
        expected=topic,
        actual=say("no message from {first} s to {last} s", **_times(use)),
        where=use.call("publish", "create_publisher", mentions=topic),
        words={"topic": topic},
    )


@kind("topic.values", Each, after=["topic.publishes"])
def values(use: Use[Each]) -> Passed:
    """The messages on {topic} have the right values"""
    given = use.given
    must_send_itself(use, given.topic)
    found = use.messages(given.topic)
    if not found:
        if use.sent(given.topic):
            use.require_window()
            raise Failed(
                "topic.none_then",
                expected=forms_in_words(given.each),
                actual=say("no message from {first} s to {last} s", **_times(use)),
                where=use.call("publish", mentions=given.topic),
                words={"topic": given.topic},
            )
        raise _nothing(use)
    use.require_window()
    for index, message in enumerate(found):
        _must_fit(message, given.each, use, index)
    return Passed(actual=say_plural("{count} message fits", "{count} messages fit", len(found)))


@kind("topic.silent", Silent, after=["topic.publishes"])
def silent(use: Use[Silent]) -> Passed:
    """No message comes on {topic} at that time"""
    topic = use.given.topic
    must_send_itself(use, topic)
    found = [message for message in use.messages(topic) if message.at > CLOCK_STARTS]
    if found:
        raise Failed(
            "topic.not_silent",
            expected=say("no message from {first} s to {last} s", **_times(use)),
            actual=say("a message at {at} s", at=f"{found[0].at:g}"),
            where=use.call("publish", mentions=topic),
            words={"topic": topic},
        )
    use.require_window()
    if not use.sent(topic):
        use.blocked_by("topic.publishes", topic=topic)
    return Passed()


def _must_fit(
    message: Message, each: dict[str, Form], use: Use[Parameters], index: int = 0
) -> None:
    """Raise Failed if a field of a message does not have its form; `index` is the message's."""
    wrong = first_misfit(message.values, each, index)
    if wrong is None:
        return
    path, form, value = wrong
    _must_be_new(message.topic, path, use)
    garbage = is_integer_bits(value)
    of_world = is_of_world(use.plan.world, message.topic)
    mistake = "world.other_state" if of_world else "topic.wrong_value"
    raise Failed(
        "topic.int_in_float" if garbage else mistake,
        expected=joined(path, form.words, by=": "),
        actual=say(
            "{path}: {value}, in the message at {at} s",
            path=path,
            value=shown_value(value),
            at=f"{message.at:g}",
        ),
        where=use.field(path, topic=message.topic)
        if garbage
        else use.call("publish", mentions=message.topic),
        params={"field": path},
        words={"topic": message.topic, "field": path, "wanted": form.words},
        variant="" if garbage or of_world else _cause_of_value(use),
    )


def _cause_of_value(use: Use[Parameters]) -> str:
    """Return the variant of a wrong value: what the node is to work it out from."""
    stimulus = use.plan.stimulus(use.use.after)
    if stimulus is None:
        return ""
    return "changed" if stimulus.set is not None else "reaction" if stimulus.typed else ""


def _must_be_new(topic: str, path: str, use: Use[Parameters]) -> None:
    """Raise Blocked if an earlier check has found the same field wrong."""
    for other in use.evidence.assignment.checks:
        result = use.evidence.results.get(other.id)
        if result is None or result.status != "failed" or other.with_.get("topic") != topic:
            continue
        if any(found.params.get("field") == path for found in result.mistakes):
            raise Blocked(by=other.id)


def _times(use: Use[Parameters]) -> dict[str, str]:
    first, last = use.window
    return {"first": f"{first:g}", "last": f"{last:g}"}


@kind("topic.reacts", Reacts, after=["topic.publishes", "topic.subscribes"], stimulus=DEEDS)
def reacts(use: Use[Reacts]) -> Passed:
    """The node answers a stimulus with a message on {topic}"""
    given = use.given
    done = use.seen.stimulus(use.use.after) if use.use.after else None
    begin = done.at if done is not None else use.window[0]
    expected = say(
        "a message on {topic} within {within} s", topic=given.topic, within=f"{given.within:g}"
    )
    if done is not None and not done.heard:
        use.blocked_by("topic.subscribes")
    if use.end < begin + given.within - EDGE:
        raise use.unreached()
    must_send_itself(use, given.topic)
    last = begin + given.within + EDGE
    found = [m for m in use.sent(given.topic) if begin - EDGE <= m.at <= last]
    if not found:
        use.blocked_by("topic.publishes", topic=given.topic)
        raise Failed(
            "topic.no_reaction",
            expected=joined(expected, forms_in_words(given.each), by=": ")
            if given.each
            else expected,
            actual=say("no message came in that time"),
            where=use.call("create_subscription"),
            words={"topic": given.topic},
        )
    fits = [message for message in found if first_misfit(message.values, given.each) is None]
    if not fits:
        _must_fit(found[0], given.each, use)
    if given.at_most is not None and len(found) > given.at_most:
        raise Failed(
            "topic.reacts_too_often",
            expected=joined(expected, times(1, given.at_most), by=": "),
            actual=say_plural("{count} message", "{count} messages", len(found)),
            where=use.call("publish"),
            words={"topic": given.topic},
        )
    return Passed(actual=say("it came at {at} s", at=f"{(fits or found)[0].at:g}"))


@kind("topic.qos", Quality, after=["topic.publishes", "topic.subscribes"])
def quality(use: Use[Quality]) -> Passed:
    """The {role} of {topic} has the right quality of service"""
    given = use.given
    must_be_alone(use, use.node)
    ends = [end for end in use.ends(given.role) if end.name == given.topic]
    if not ends:
        use.blocked_by("topic.publishes" if given.role == "publisher" else "topic.subscribes")
        short = use.plan.topics.get(given.topic, "").rpartition("/")[2]
        raise Failed(
            "topic.no_publisher" if given.role == "publisher" else "topic.no_subscription",
            expected=given.topic,
            actual=say("{node} has no such end on the ROS graph", node=use.node),
            where=use.call(CREATES[given.role], mentions=given.topic),
            words={"topic": given.topic, "short": short or "…"},
        )
    for wanted, found in (
        (given.reliability, ends[0].reliability),
        (given.durability, ends[0].durability),
    ):
        if wanted and wanted != found:
            raise Failed(
                "topic.wrong_qos",
                expected=wanted,
                actual=found,
                where=use.call(CREATES[given.role], mentions=given.topic),
                params={"found": found},
                words={"topic": given.topic, "wanted": wanted},
            )
    return Passed(actual=", ".join(one for one in (ends[0].reliability, ends[0].durability) if one))
