"""Whether a publisher and a subscription fit, and if not, why (DDS: "requested versus offered")."""

from __future__ import annotations

from typing import Any

from rclpy.qos import (
    DurabilityPolicy,
    LivelinessPolicy,
    QoSCompatibility,
    ReliabilityPolicy,
    qos_check_compatible,
)

RELIABILITY = {ReliabilityPolicy.RELIABLE: "reliable", ReliabilityPolicy.BEST_EFFORT: "best_effort"}
DURABILITY = {
    DurabilityPolicy.TRANSIENT_LOCAL: "transient_local",
    DurabilityPolicy.VOLATILE: "volatile",
}
LIVELINESS = {
    LivelinessPolicy.AUTOMATIC: "automatic",
    LivelinessPolicy.MANUAL_BY_TOPIC: "manual_by_topic",
}
Reason = dict[str, str]
"""`policy` is type, definition or a QoS policy; `offered` and `requested` are its values."""


def qos_words(profile: Any) -> dict[str, str]:
    """Return the policies of an endpoint that decide whether it fits; times are in seconds."""
    return {
        "reliability": RELIABILITY.get(profile.reliability, "unknown"),
        "durability": DURABILITY.get(profile.durability, "unknown"),
        "liveliness": LIVELINESS.get(profile.liveliness, "unknown"),
        "deadline": _seconds(profile.deadline),
        "lease": _seconds(profile.liveliness_lease_duration),
    }


def misfits(publisher: Any, subscription: Any) -> list[Reason]:
    """Return why a publisher's messages do not reach a subscription; empty if they do.

    Both are rclpy's TopicEndpointInfo.
    """
    if publisher.topic_type != subscription.topic_type:
        return [_reason("type", publisher.topic_type, subscription.topic_type)]
    hashes = [str(getattr(end, "topic_type_hash", "")) for end in (publisher, subscription)]
    if all(_is_known(value) for value in hashes) and hashes[0] != hashes[1]:
        return [_reason("definition", *hashes)]
    offered, requested = publisher.qos_profile, subscription.qos_profile
    compatible, text = qos_check_compatible(offered, requested)
    if compatible != QoSCompatibility.ERROR:
        return []
    return _policies(offered, requested) or [_reason("other", text, "")]


def _policies(offered: Any, requested: Any) -> list[Reason]:
    """Return the policies of which less is offered than is requested."""
    first, second = qos_words(offered), qos_words(requested)
    less = {
        "reliability": (first["reliability"], second["reliability"]) == ("best_effort", "reliable"),
        "durability": (first["durability"], second["durability"])
        == ("volatile", "transient_local"),
        "deadline": _longer(offered.deadline, requested.deadline),
        "liveliness": (first["liveliness"], second["liveliness"])
        == ("automatic", "manual_by_topic"),
        "lease": _longer(offered.liveliness_lease_duration, requested.liveliness_lease_duration),
    }
    return [_reason(name, first[name], second[name]) for name, found in less.items() if found]


def _longer(offered: Any, requested: Any) -> bool:
    """Whether the offered duration is longer; zero stands for infinite, as in rmw."""
    if requested.nanoseconds == 0:
        return False
    return bool(offered.nanoseconds == 0 or offered.nanoseconds > requested.nanoseconds)


def _seconds(duration: Any) -> str:
    # (infinite durations are reported as the largest number of ns)
    seconds = duration.nanoseconds / 1e9
    return "infinite" if seconds == 0 or seconds > 1e9 else f"{seconds:g} s"


def _is_known(type_hash: str) -> bool:
    """Whether a hash is one: RIHS01_ and hexadecimal digits that are not all zero (REP 2016)."""
    return type_hash.startswith("RIHS01_") and bool(type_hash[7:].strip("0"))


def _reason(policy: str, offered: str, requested: str) -> Reason:
    return {"policy": policy, "offered": offered, "requested": requested}
