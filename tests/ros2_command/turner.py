"""A node with an action: it turns by up to 3 in half a second, rejects what is below 0, else goes on.

It repeats its feedback: a server can have a goal before it knows the client's subscription for the
feedback, and what it publishes until then is lost.
"""

import time
from contextlib import suppress

import rclpy
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from turtlesim.action import RotateAbsolute

rclpy.init()
node = rclpy.create_node("turner")


def judge(goal):  # type: ignore[no-untyped-def]
    return GoalResponse.REJECT if goal.theta < 0 else GoalResponse.ACCEPT


def execute(handle):  # type: ignore[no-untyped-def]
    for _ in range(10):
        handle.publish_feedback(RotateAbsolute.Feedback(remaining=0.5))
        time.sleep(0.05)
    while handle.request.theta > 3 and not handle.is_cancel_requested:
        time.sleep(0.05)
    if handle.is_cancel_requested:
        handle.canceled()
    else:
        handle.succeed()
    return RotateAbsolute.Result(delta=1.0)


server = ActionServer(
    node,
    RotateAbsolute,
    "rotate",
    execute,
    goal_callback=judge,
    cancel_callback=lambda _: CancelResponse.ACCEPT,
    callback_group=ReentrantCallbackGroup(),
)
executor = MultiThreadedExecutor()
executor.add_node(node)
print("ready", flush=True)
with suppress(KeyboardInterrupt, ExternalShutdownException):
    executor.spin()
