"""Options for the quality of service of a subscription or publisher."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from argparse import Namespace

    from .parsing import Parser

# rclpy's short keys, written out so that parsing a command line does not wait for rclpy
PROFILES = (
    "unknown",
    "default",
    "system_default",
    "sensor_data",
    "services_default",
    "parameters",
    "parameter_events",
    "action_status_default",
    "best_available",
)
POLICIES = {
    "history": ("system_default", "keep_last", "keep_all", "unknown"),
    "reliability": ("system_default", "reliable", "best_effort", "unknown", "best_available"),
    "durability": ("system_default", "transient_local", "volatile", "unknown", "best_available"),
    "liveliness": ("system_default", "automatic", "manual_by_topic", "unknown", "best_available"),
}


def add_arguments(parser: Parser, *, profile: str, endpoint: str) -> None:
    """Declare the options; `profile` is the default, `endpoint` says what they are for."""
    add = parser.add_argument
    add(
        "--qos-profile",
        choices=PROFILES,
        help=f"Quality of service profile of the {endpoint} (default: {profile})",
    )
    add(
        "--qos-depth",
        metavar="N",
        type=int,
        help="Number of messages in the queue, for the history keep_last",
    )
    for policy, choices in POLICIES.items():
        add(
            f"--qos-{policy}",
            choices=choices,
            help=f"{policy.title()} of the {endpoint}, instead of the profile's",
        )
    add(
        "--qos-liveliness-lease-duration-seconds",
        metavar="SECONDS",
        type=float,
        help="Seconds after which a publisher that does not assert its liveliness counts as dead",
    )
    parser.set_defaults(default_qos_profile=profile)


def profile(args: Namespace) -> Any:
    """Return the QoSProfile that the options ask for."""
    from rclpy import qos  # noqa: PLC0415 (slow to import)
    from rclpy.duration import Duration  # noqa: PLC0415

    name = args.qos_profile or args.default_qos_profile
    chosen = _copy(qos.QoSPresetProfiles.get_from_short_key(name))
    if args.qos_depth is not None:
        chosen.depth = args.qos_depth
    kinds = {
        "history": qos.QoSHistoryPolicy,
        "reliability": qos.QoSReliabilityPolicy,
        "durability": qos.QoSDurabilityPolicy,
        "liveliness": qos.QoSLivelinessPolicy,
    }
    for policy, kind in kinds.items():
        key = getattr(args, f"qos_{policy}")
        if key is not None:
            setattr(chosen, policy, kind.get_from_short_key(key))
    lease = args.qos_liveliness_lease_duration_seconds
    if lease is not None:
        chosen.liveliness_lease_duration = Duration(seconds=lease)
    return chosen


def matching(args: Namespace, node: Any, topic: str) -> Any:
    """Return the QoSProfile of the options, or one with which all publishers are heard.

    The publishers decide about reliability and durability if no option does.
    """
    from rclpy import qos  # noqa: PLC0415 (slow to import)

    chosen = profile(args)
    if any((args.qos_profile, args.qos_reliability, args.qos_durability)):
        return chosen
    offered = [each.qos_profile for each in node.get_publishers_info_by_topic(topic)]
    if not offered:
        return chosen
    reliable = [each.reliability == qos.QoSReliabilityPolicy.RELIABLE for each in offered]
    lasting = [each.durability == qos.QoSDurabilityPolicy.TRANSIENT_LOCAL for each in offered]
    chosen.reliability = (
        qos.QoSReliabilityPolicy.RELIABLE if all(reliable) else qos.QoSReliabilityPolicy.BEST_EFFORT
    )
    chosen.durability = (
        qos.QoSDurabilityPolicy.TRANSIENT_LOCAL
        if all(lasting)
        else qos.QoSDurabilityPolicy.VOLATILE
    )
    for policy, offers, weaker in (
        ("reliable", reliable, "best_effort"),
        ("transient_local", lasting, "volatile"),
    ):
        if any(offers) and not all(offers):
            print(f"Not all publishers offer {policy}: subscribing as {weaker}, to hear them all")
    return chosen


def _copy(profile: Any) -> Any:
    """Return a profile of its own: rclpy's presets are shared."""
    from rclpy.qos import QoSProfile  # noqa: PLC0415

    names = (slot.removeprefix("_") for slot in QoSProfile.__slots__)
    return QoSProfile(**{name: getattr(profile, name) for name in names})
