"""Managed nodes, those with a life cycle: which there are, and calls of their services.

Design: https://design.ros2.org/articles/node_lifecycle.html.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import graph, parameters
from .parsing import CommandError, Parser

if TYPE_CHECKING:
    from argparse import Namespace

STATE_SERVICE, STATE_TYPE = "get_state", "lifecycle_msgs/srv/GetState"


def add_name(parser: Parser) -> None:
    """Declare the name of a node, and the option for hidden nodes."""
    parser.add_argument("node_name", help="Name of the ROS node")
    parser.add_argument(
        "--include-hidden-nodes", action="store_true", help="Consider hidden nodes as well"
    )


def names(node: Any, args: Namespace) -> list[str]:
    """Return the full names of the managed nodes that the options select, sorted."""
    known = graph.services(node, hidden=True)
    managed = {name for name, types in known if STATE_TYPE in types}
    found = parameters.names_of_nodes(node, args)
    return [name for name in found if f"{name}/{STATE_SERVICE}" in managed]


def named(node: Any, args: Namespace) -> str:
    """Return the full name of the node that is named; raises CommandError if it is not managed."""
    name = args.node_name if args.node_name.startswith("/") else f"/{args.node_name}"
    if name not in names(node, args):
        raise CommandError("Node not found")
    return str(name)


def state(node: Any, name: str) -> str:
    """Return the state of a managed node: its label and number."""
    return _text(_call(node, "GetState", f"{name}/{STATE_SERVICE}").current_state)


def transitions(
    node: Any, name: str, *, every: bool = False, timeout: float | None = None
) -> list[Any]:
    """Return the lifecycle_msgs/msg/TransitionDescription from a node's state, or `every` one.

    Raises CommandError if there is no answer within `timeout` seconds; None waits for ever.
    """
    service = "get_transition_graph" if every else "get_available_transitions"
    answer = _call(node, "GetAvailableTransitions", f"{name}/{service}", timeout=timeout)
    return list(answer.available_transitions)


def find_transition(possible: list[Any], wanted: str) -> Any:
    """Return the lifecycle_msgs/msg/Transition with a label, else with a number.

    Raises CommandError if none of the possible descriptions has it.
    """
    known = [description.transition for description in possible]
    for found in known:
        if found.label == wanted:
            return found
    for found in known:
        if str(found.id) == wanted:
            return found
    lines = ["Unknown transition requested, available ones are:", *map(_text, known)]
    raise CommandError("\n- ".join(lines))


def change(node: Any, name: str, transition: Any) -> bool:
    """Ask a managed node for a transition; return whether it succeeded."""
    return bool(_call(node, "ChangeState", f"{name}/change_state", transition=transition).success)


def described(description: Any) -> str:
    """Return the three lines about a transition: its name, and the states before and after it."""
    start, goal = description.start_state.label, description.goal_state.label
    return f"- {_text(description.transition)}\n\tStart: {start}\n\tGoal: {goal}"


def _text(named_: Any) -> str:
    return f"{named_.label} [{named_.id}]"


def _call(
    node: Any, kind: str, service: str, *, timeout: float | None = None, **fields: Any
) -> Any:
    """Call a service of lifecycle_msgs and wait for the answer, by default as long as it takes."""
    from lifecycle_msgs import srv  # noqa: PLC0415 (slow to import)
    from rclpy import spin_until_future_complete  # noqa: PLC0415

    type_ = getattr(srv, kind)
    client = node.create_client(type_, service)
    try:
        client.wait_for_service(timeout_sec=timeout)
        future = client.call_async(type_.Request(**fields))
        spin_until_future_complete(node, future, timeout_sec=timeout)
        if not future.done():
            raise CommandError(f"{service} did not answer within {timeout} seconds")
        return future.result()
    finally:
        node.destroy_client(client)
