"""Query the ROS graph with a node of our own, as ros2cli's DirectNode does.

The real command asks its daemon, which already knows the graph. The wheels have no daemon: every
call discovers the graph itself. Half a second, as ros2cli waits without its daemon, found the only
other node in two thirds of the calls (measured on 2 busy cores). So, unless `--spin-time` is given,
the half second starts when another node is known, which is awaited for up to `PATIENCE`.
"""

from __future__ import annotations

import os
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Iterator

    from .parsing import Parser

HIDDEN_PREFIX = "_"
SPIN_TIME = 0.5  # seconds, ros2cli's default
# A lost message of discovery is repeated after 3 s (Fast DDS's heartbeat and announcement period)
PATIENCE = 3.5  # seconds


def add_arguments(parser: Parser) -> None:
    """Declare the options shared by all verbs that query the graph."""
    parser.add_argument(
        "--spin-time",
        type=float,
        help="Spin time in seconds to wait for discovery (only applies when not using an already "
        "running daemon)",
    )
    parser.add_argument(
        "-s", "--use-sim-time", action="store_true", help="Enable ROS simulation time"
    )
    parser.add_argument(
        "--no-daemon",
        action="store_true",
        help="Do not spawn nor use an already running daemon",
    )


def is_hidden(name: str) -> bool:
    """Return whether any part of a topic's or node's name starts with an underscore."""
    return any(part.startswith(HIDDEN_PREFIX) for part in name.split("/"))


@contextmanager
def graph(args: Namespace) -> Iterator[Any]:
    """Yield an rclpy node that has had time to discover the others (`args.spin_time` in seconds).

    Raises KeyboardInterrupt if Ctrl+C ends the wait, ModuleNotFoundError without rclpy.
    """
    import rclpy  # noqa: PLC0415 (slow to import)
    from rclpy.executors import ExternalShutdownException  # noqa: PLC0415
    from rclpy.parameter import Parameter  # noqa: PLC0415

    rclpy.init(args=[])
    try:
        node = rclpy.create_node(
            f"{HIDDEN_PREFIX}ros2cli_{os.getpid()}",
            start_parameter_services=False,
            parameter_overrides=[Parameter("use_sim_time", value=args.use_sim_time)],
        )
        try:
            if args.spin_time is not None:
                _spin(node, args.spin_time)
            elif _discover(node, PATIENCE):
                _spin(node, SPIN_TIME)
            yield node
        except ExternalShutdownException:
            raise KeyboardInterrupt from None
        finally:
            node.destroy_node()
    finally:
        rclpy.try_shutdown()


def _spin(node: Any, seconds: float) -> None:
    import rclpy  # noqa: PLC0415

    end = time.monotonic() + seconds
    while (left := end - time.monotonic()) > 0:
        rclpy.spin_once(node, timeout_sec=left)


def _discover(node: Any, seconds: float) -> bool:
    """Spin for that long, or until another node is known; return whether one is."""
    import rclpy  # noqa: PLC0415

    end = time.monotonic() + seconds
    while (left := end - time.monotonic()) > 0:
        rclpy.spin_once(node, timeout_sec=min(left, 0.05))
        if len(node.get_node_names()) > 1:
            return True
    return False
