"""The ends of the nodes on the graph: topics published and subscribed to, services and clients."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection
from typing import Any

MOST_ENDPOINTS = 400
MOST_TWINS = 8
LONGEST_NAME = 256
Infos = dict[str, Callable[[str], Any]]


def twins_on(node: Any) -> list[str]:
    """Return the full names that more than one node on the graph has."""
    names = Counter(_full_name(space, name) for name, space in node.get_node_names_and_namespaces())
    return sorted(name[:LONGEST_NAME] for name, count in names.items() if count > 1)[:MOST_TWINS]


def ends_of_others(
    node: Any, own_topics: Collection[tuple[str, str]], asked: Collection[str] = ()
) -> list[dict[str, Any]]:
    """Return every end of the nodes but `node`, whose own ends are `own_topics` (role, topic).

    `differs`: its type has another hash than the same type of an own end. Ends of the names `asked`
    come first: no number of others keeps them out. A node that has the name of `node` too is not
    passed over.
    """
    infos: Infos = {
        "publisher": node.get_publishers_info_by_topic,
        "subscription": node.get_subscriptions_info_by_topic,
    }
    readers = (
        ("publisher", node.get_publisher_names_and_types_by_node),
        ("subscription", node.get_subscriber_names_and_types_by_node),
        ("service", node.get_service_names_and_types_by_node),
        ("client", node.get_client_names_and_types_by_node),
    )
    own = _own_definitions(node, own_topics, infos)
    qos: dict[tuple[str, str, str], tuple[str, str, bool]] = {}
    ends: list[dict[str, Any]] = []
    itself, twins = "/" + node.get_name(), twins_on(node)
    for name, space in dict.fromkeys(map(tuple, node.get_node_names_and_namespaces())):
        full = _full_name(space, name)
        if full == itself and itself not in twins:  # (the node of a world is one of the graph)
            continue
        for role, read in readers:
            try:
                found = read(name, space)
            except RuntimeError:  # the node has gone
                continue
            for topic, types in found:
                if role in infos and (role, topic, full) not in qos:
                    for info in infos[role](topic):
                        owner = _full_name(info.node_namespace, info.node_name)
                        qos[role, topic, owner] = (
                            info.qos_profile.reliability.name.lower(),
                            info.qos_profile.durability.name.lower(),
                            own.get(info.topic_type, info.topic_type_hash) != info.topic_type_hash,
                        )
                reliability, durability, differs = qos.get((role, topic, full), ("", "", False))
                ends.extend(
                    {
                        "node": full[:LONGEST_NAME],
                        "role": role,
                        "name": topic[:LONGEST_NAME],
                        "type": kind[:LONGEST_NAME],
                        "reliability": reliability,
                        "durability": durability,
                        "differs": differs,
                    }
                    for kind in types
                )
    ends.sort(key=lambda end: not any(end["name"].startswith(name) for name in asked))
    return ends[:MOST_ENDPOINTS]


def _full_name(space: str, name: str) -> str:
    return space.rstrip("/") + "/" + name


def _own_definitions(
    node: Any, own_topics: Collection[tuple[str, str]], infos: Infos
) -> dict[str, Any]:
    """Return the hash that each type of the own ends has."""
    return {
        info.topic_type: info.topic_type_hash
        for role, topic in own_topics
        for info in infos[role](topic)
        if info.node_name == node.get_name()
    }
