"""Which ends of the graph rclpy makes by itself: no student wrote their names.

A lifecycle node has a topic and services of its own, an action is three services and two topics
(https://design.ros2.org/articles/node_lifecycle.html, https://design.ros2.org/articles/actions.html).
A name with a part that begins with _ is hidden
(https://design.ros2.org/articles/topic_and_service_names.html).
"""

from __future__ import annotations

from grader.run.observations import End

TOPICS = ("/rosout", "/parameter_events", "/clock")
ACTION = "/_action/"
LAST_PARTS = {
    "topic": ("transition_event",),
    "service": (
        *("describe_parameters", "get_parameter_types", "get_parameters", "list_parameters"),
        *("set_parameters", "set_parameters_atomically", "get_type_description"),
        *("change_state", "get_state", "get_available_states", "get_available_transitions"),
        "get_transition_graph",
    ),
}
"""The last part of the names that begin with the node's, by the kind of end."""


def is_of_ros(end: End) -> bool:
    """Whether rclpy made an end by itself. A client is a node's own, whatever it asks."""
    if end.name in TOPICS or "/_" in end.name:
        return True
    kind = "topic" if end.role in ("publisher", "subscription") else "service"
    space, _, last = end.name.rpartition("/")
    return end.role != "client" and space == end.node and last in LAST_PARTS[kind]
