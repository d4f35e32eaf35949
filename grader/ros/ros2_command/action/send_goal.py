"""Send an action goal."""

from __future__ import annotations

import signal
import sys
from typing import TYPE_CHECKING, Any

from .. import graph, message_fields
from ..discovery import discover
from ..interfaces import load
from ..message_yaml import to_yaml
from ..parsing import CommandError, Parser

if TYPE_CHECKING:
    from argparse import Namespace

# action_msgs/msg/GoalStatus
STATUSES = {
    1: "ACCEPTED",
    2: "EXECUTING",
    3: "CANCELING",
    4: "SUCCEEDED",
    5: "CANCELED",
    6: "ABORTED",
}
POLL = 0.1  # seconds
CANCEL_TIMEOUT = 5.0  # seconds to wait for the server's answer


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 action send_goal`."""
    parser.add_argument("action_name", help="Name of the action (e.g. '/rotate')")
    parser.add_argument("action_type", help="Type (e.g. 'turtlesim/action/RotateAbsolute')")
    values = parser.add_mutually_exclusive_group()
    values.add_argument(
        "goal", nargs="?", default="{}", help="Values of the goal, as YAML ('{theta: 1.57}')"
    )
    values.add_argument("--stdin", action="store_true", help="Read the goal from standard input")
    parser.add_argument(
        "-f", "--feedback", action="store_true", help="Print the feedback while the goal is active"
    )


def main(args: Namespace) -> None:
    """Send the goal, wait for its result and print both; Ctrl+C cancels the goal.

    Raises CommandError for a goal that cannot be made.
    """
    kind = load(args.action_type, "action")
    goal = kind.Goal()
    values = message_fields.parse(sys.stdin.read() if args.stdin else args.goal)
    try:
        message_fields.fill(goal, values)
    except (AttributeError, TypeError, ValueError, AssertionError, OverflowError) as error:
        raise CommandError(f"Failed to populate message fields: {error!r}") from None
    with graph.own_node(own_interrupts=True) as node:
        discover(node)  # a client finds a server at once that is known already
        _send(node, kind, args.action_name, goal, _Feedback() if args.feedback else None)


class _Feedback:
    """Prints the feedback; what comes before the server's answer to the goal is printed after it."""

    def __init__(self) -> None:
        self._held: list[Any] | None = []

    def __call__(self, message: Any) -> None:
        if self._held is None:
            print(f"Feedback:\n    {to_yaml(message.feedback)}")
        else:
            self._held.append(message)

    def release(self) -> None:
        held, self._held = self._held or [], None
        for message in held:
            self(message)


def _send(node: Any, kind: Any, name: str, goal: Any, feedback: _Feedback | None) -> None:
    from rclpy.action import ActionClient  # noqa: PLC0415 (slow to import)

    client = ActionClient(node, kind, name)
    print("Waiting for an action server to become available...")
    while not client.wait_for_server(timeout_sec=0.5):
        pass
    print(f"Sending goal:\n     {to_yaml(goal)}")
    future = client.send_goal_async(goal, feedback)
    _wait(node, future)
    handle = future.result()
    if not handle.accepted:
        print("Goal was rejected.")
        return
    try:
        print(f"Goal accepted with ID: {bytes(handle.goal_id.uuid).hex()}\n")
        if feedback is not None:
            feedback.release()
        future = handle.get_result_async()
        _wait(node, future)
    except KeyboardInterrupt:
        signal.signal(signal.SIGINT, signal.SIG_DFL)  # a second Ctrl+C ends the command at once
        _cancel(node, handle)
        raise
    result = future.result()
    print(f"Result:\n    {to_yaml(result.result)}")
    print(f"Goal finished with status: {STATUSES.get(result.status, 'UNKNOWN')}")


def _wait(node: Any, future: Any) -> None:
    """Handle what arrives until the future is done.

    Without rclpy's signal handlers, Ctrl+C does not end a wait in rcl: hence the short ones.
    """
    from rclpy import spin_until_future_complete  # noqa: PLC0415 (slow to import)

    while not future.done():
        spin_until_future_complete(node, future, timeout_sec=POLL)


def _cancel(node: Any, handle: Any) -> None:
    from rclpy import spin_until_future_complete as wait  # noqa: PLC0415 (slow to import)

    print("Canceling goal...")
    future = handle.cancel_goal_async()
    wait(node, future, timeout_sec=CANCEL_TIMEOUT)
    if not future.done() or not future.result().goals_canceling:
        raise CommandError("Failed to cancel goal")
    print("Goal canceled.")
