"""The catalogue: nodes with a lifecycle, as the answers to their transitions show them."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.kind import Family

_lifecycle = Family("lifecycle", links.LIFECYCLE)
KINDS = (
    _lifecycle(
        "failed",
        "callback",
        msg("A transition of the lifecycle fails"),
        msg(
            "At {at} s the node was asked for this transition; its answer was: {answer}. A transition "
            "succeeds if its callback returns TransitionCallbackReturn.SUCCESS. After any other value "
            "the node does not change to the state that was asked for."
        ),
        msg("Return TransitionCallbackReturn.SUCCESS at the end of {name}, when all went well."),
    ),
    _lifecycle(
        "returns_nothing",
        "callback",
        msg("A callback of the lifecycle returns nothing"),
        msg(
            "At {at} s the node was asked for this transition; its answer was: {answer}. Each callback "
            "of a transition must return a TransitionCallbackReturn. A function without return "
            "returns None, from which ROS learns no result."
        ),
        msg("Write return TransitionCallbackReturn.SUCCESS at the end of {name}."),
    ),
    _lifecycle(
        "not_passed_on",
        "topic",
        msg("The publisher is not activated"),
        msg(
            "The node is active from {at} s on, but its lifecycle publisher is not: "
            "LifecycleNode.on_activate activates each of them, and this class has an on_activate of "
            "its own in its place."
        ),
        msg(
            "Let on_activate end with return super().on_activate({state}), in place of any other return "
            "at its end."
        ),
    ),
    _lifecycle(
        "plain_publisher",
        "topic",
        msg("The publisher does not follow the lifecycle"),
        msg(
            "A publisher of create_publisher sends in every state of the node. One of "
            "create_lifecycle_publisher sends only while the node is active."
        ),
        msg("Write create_lifecycle_publisher in place of create_publisher in this line."),
    ),
)
