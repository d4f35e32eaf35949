"""The ROS graph as values: nodes, topics with their endpoints, services, actions."""

from __future__ import annotations

from collections import defaultdict
from typing import Any

from rclpy.node import Node

from lab.window.bridge.fit import misfits, qos_words

PARAMETER_SERVICES = (
    *("describe_parameters", "get_parameter_types", "get_parameters", "list_parameters"),
    *("set_parameters", "set_parameters_atomically", "get_type_description"),
)
PLUMBING = ("/rosout", "/parameter_events", "/clock")
ACTION = "/_action/"
MOST_NODES = 200
MOST_TOPICS = 500

Graph = dict[str, Any]


def full_name(space: str, name: str) -> str:
    """Return a node's full name, such as /robot/talker."""
    return (space if space.endswith("/") else space + "/") + name


def snapshot(node: Node, own: frozenset[str]) -> Graph:
    """Return what is on the graph now, without the nodes in `own`.

    It is sorted, so that two equal graphs are equal values.
    """
    names = sorted(
        (full_name(space, name), name, space)
        for name, space in node.get_node_names_and_namespaces()
    )
    shown = [entry for entry in names if entry[0] not in own][:MOST_NODES]
    services, actions, with_parameters = _services(node, shown)
    return {
        "nodes": [
            {"name": full, "parameters": full in with_parameters, "hidden": name.startswith("_")}
            for full, name, _ in dict.fromkeys(shown)
        ],
        "twice": sorted({full for full, *_ in shown if [n[0] for n in shown].count(full) > 1}),
        "topics": list(_topics(node, own)),
        "services": services,
        "actions": actions,
    }


def _topics(node: Node, own: frozenset[str]) -> list[dict[str, Any]]:
    found = []
    for topic, types in sorted(node.get_topic_names_and_types())[:MOST_TOPICS]:
        if ACTION in topic:
            continue
        publishers = _others(node.get_publishers_info_by_topic(topic), own)
        subscriptions = _others(node.get_subscriptions_info_by_topic(topic), own)
        if publishers or subscriptions:
            found.append(
                {
                    "name": topic,
                    "types": sorted({end.topic_type for end in publishers + subscriptions})
                    or sorted(types),
                    "publishers": [_endpoint(end) for end in publishers],
                    "subscriptions": [_endpoint(end) for end in subscriptions],
                    "misfits": _misfits(publishers, subscriptions),
                    "plumbing": topic in PLUMBING,
                }
            )
    return found


def _others(ends: list[Any], own: frozenset[str]) -> list[Any]:
    shown = [end for end in ends if full_name(end.node_namespace, end.node_name) not in own]
    return sorted(shown, key=lambda e: (e.node_namespace, e.node_name, bytes(e.endpoint_gid)))


def _endpoint(end: Any) -> dict[str, Any]:
    return {
        "node": full_name(end.node_namespace, end.node_name),
        "type": end.topic_type,
        "qos": qos_words(end.qos_profile),
    }


def _misfits(publishers: list[Any], subscriptions: list[Any]) -> list[dict[str, Any]]:
    """Return the pairs that do not fit, as places in the two lists, with the reasons."""
    pairs = [
        {"publisher": i, "subscription": j, "reasons": misfits(publisher, subscription)}
        for i, publisher in enumerate(publishers)
        for j, subscription in enumerate(subscriptions)
    ]
    return [pair for pair in pairs if pair["reasons"]]


def _services(
    node: Node, nodes: list[tuple[str, str, str]]
) -> tuple[list[dict[str, Any]], list[dict[str, Any]], set[str]]:
    """Return the services, the actions, and the nodes with parameter services."""
    servers: dict[str, list[tuple[str, str]]] = defaultdict(list)
    clients: dict[str, list[tuple[str, str]]] = defaultdict(list)
    for full, name, space in dict.fromkeys(nodes):
        for kinds, get in (
            (servers, node.get_service_names_and_types_by_node),
            (clients, node.get_client_names_and_types_by_node),
        ):
            try:
                found = get(name, space)
            except Exception:  # noqa: S112 - the node has gone (NodeNameNonExistentError)
                continue
            for service, types in found:
                kinds[service].extend((full, kind) for kind in types)
    with_parameters = {
        full
        for full, *_ in nodes
        if any(end[0] == full for end in servers[full + "/get_parameters"])
    }
    plumbing = {f"{full}/{name}" for full, *_ in nodes for name in PARAMETER_SERVICES}
    services: list[dict[str, Any]] = []
    actions: list[dict[str, Any]] = []
    for service in sorted({*servers, *clients}):
        if service in plumbing or not (servers[service] or clients[service]):
            continue
        action, is_action, part = service.partition(ACTION)
        if is_action and part != "send_goal":
            continue
        entry = _service(action, servers[service], clients[service])
        (actions if is_action else services).append(entry)
    return services, actions, with_parameters


def _service(
    name: str, servers: list[tuple[str, str]], clients: list[tuple[str, str]]
) -> dict[str, Any]:
    types = sorted({kind.removesuffix("_SendGoal") for _, kind in servers + clients})
    return {
        "name": name,
        "types": types,
        "servers": sorted({full for full, _ in servers}),
        "clients": sorted({full for full, _ in clients}),
        "misfits": [
            {
                "client": client,
                "server": server,
                "reasons": [
                    {
                        "policy": "type",
                        "offered": kind.removesuffix("_SendGoal"),
                        "requested": wanted.removesuffix("_SendGoal"),
                    }
                ],
            }
            for client, wanted in sorted(set(clients))
            for server, kind in sorted(set(servers))
            if wanted != kind
        ],
    }
