"""Query the ROS graph with a node of our own, as ros2cli's DirectNode does.

The wheels have no daemon; `discovery` waits until the node knows the others.
"""

from __future__ import annotations

import os
import time
from contextlib import contextmanager, nullcontext
from typing import TYPE_CHECKING, Any

from .discovery import discover
from .transport import udp_only

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Iterator

    from .parsing import Parser

HIDDEN_PREFIX = "_"


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


def node_names(node: Any) -> list[str]:
    """Return the full names of all nodes that a node knows, with its own, sorted."""
    return sorted(
        f"{namespace.rstrip('/')}/{name}"
        for name, namespace in node.get_node_names_and_namespaces()
    )


def services(node: Any, *, hidden: bool) -> list[tuple[str, list[str]]]:
    """Return the services that a node knows with their types, sorted; hidden ones if asked."""
    found = sorted(node.get_service_names_and_types())
    return [(name, types) for name, types in found if hidden or not is_hidden(name)]


@contextmanager
def graph(args: Namespace, *, name: str | None = None, carries_data: bool = False) -> Iterator[Any]:
    """Yield an rclpy node that has had time to discover the others (`args.spin_time` in seconds).

    `carries_data` as in `own_node`.

    Raises KeyboardInterrupt if Ctrl+C ends the wait, ModuleNotFoundError without rclpy.
    """
    with own_node(use_sim_time=args.use_sim_time, name=name, carries_data=carries_data) as node:
        if args.spin_time is None:
            discover(node)
        else:
            _spin(node, args.spin_time)
        yield node


@contextmanager
def own_node(
    *,
    use_sim_time: bool = False,
    name: str | None = None,
    own_interrupts: bool = False,
    carries_data: bool = False,
) -> Iterator[Any]:
    """Yield an rclpy node, by default hidden; it does not know the graph yet.

    With `carries_data` its messages may be large: they go through shared memory where possible.

    With `own_interrupts` Ctrl+C leaves the node alive, for what is to be done after it.

    Raises KeyboardInterrupt if Ctrl+C or SIGTERM shuts it down, ModuleNotFoundError without rclpy.
    """
    import rclpy  # noqa: PLC0415 (slow to import)
    from rclpy.parameter import Parameter  # noqa: PLC0415
    from rclpy.signals import SignalHandlerOptions  # noqa: PLC0415

    handlers = SignalHandlerOptions.NO if own_interrupts else SignalHandlerOptions.ALL
    begun = False
    try:
        with nullcontext() if carries_data else udp_only():
            rclpy.init(args=[], signal_handler_options=handlers)
            begun = True
            node = rclpy.create_node(
                name or f"{HIDDEN_PREFIX}ros2cli_{os.getpid()}",
                start_parameter_services=False,
                parameter_overrides=[
                    Parameter("use_sim_time", value=use_sim_time),
                    # its interfaces import NumPy, 0.1 s
                    Parameter("start_type_description_service", value=False),
                ],
            )
        try:
            yield node
        finally:
            node.destroy_node()
    except Exception:
        # a signal has shut down the context, and each call fails with an error of its own since
        if handlers is SignalHandlerOptions.ALL and begun and not rclpy.ok():
            raise KeyboardInterrupt from None
        raise
    finally:
        rclpy.try_shutdown()


def _spin(node: Any, seconds: float) -> None:
    import rclpy  # noqa: PLC0415

    end = time.monotonic() + seconds
    while (left := end - time.monotonic()) > 0:
        rclpy.spin_once(node, timeout_sec=left)
