"""Call a service."""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING

from .. import graph, message_fields
from ..discovery import discover
from ..interfaces import load
from ..parsing import CommandError, Parser, positive_float

if TYPE_CHECKING:
    from argparse import Namespace


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 service call`."""
    add = parser.add_argument
    add("service_name", help="Name of the service (e.g. '/reset')")
    add("service_type", help="Type of the service (e.g. 'std_srvs/srv/SetBool')")
    values = parser.add_mutually_exclusive_group()
    values.add_argument(
        "values", nargs="?", default="{}", help="Values of the request, as YAML ('{data: true}')"
    )
    values.add_argument("--stdin", action="store_true", help="Read the values from standard input")
    add("-r", "--rate", metavar="N", type=positive_float, help="Repeat the call N times a second")


def main(args: Namespace) -> None:
    """Wait for the service, call it, and print the request and the response.

    Raises CommandError for a request that cannot be made.
    """
    from rclpy import spin_until_future_complete as wait  # noqa: PLC0415 (slow to import)
    from rclpy.exceptions import InvalidServiceNameException  # noqa: PLC0415

    kind = load(args.service_type, "srv")
    values = message_fields.parse(sys.stdin.read() if args.stdin else args.values)
    with graph.own_node() as node:
        discover(node)  # a client finds a server at once that is known already
        try:
            client = node.create_client(kind, args.service_name)
        except (InvalidServiceNameException, ValueError) as error:
            raise CommandError(str(error)) from None
        request = kind.Request()
        try:
            stamps = message_fields.fill(request, values, lambda: node.get_clock().now().to_msg())
        except (AttributeError, TypeError, ValueError, AssertionError, OverflowError) as error:
            raise CommandError(f"Failed to populate field: {error}") from None
        print("waiting for service to become available...")
        while not client.wait_for_service(timeout_sec=0.5):
            pass
        while True:
            for stamp in stamps:
                stamp()
            print(f"requester: making request: {request!r}\n")
            future = client.call_async(request)
            wait(node, future)
            print(f"response:\n{future.result()!r}\n")
            if args.rate is None:
                return
            time.sleep(1 / args.rate)
