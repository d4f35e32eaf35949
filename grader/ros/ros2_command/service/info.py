"""Print information about a service."""

from argparse import Namespace

from .. import graph
from ..parsing import CommandError, Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 service info`."""
    graph.add_arguments(parser)
    parser.add_argument("service_name", help="Name of the service (e.g. '/reset')")


def main(args: Namespace) -> None:
    """Print the service's type and the number of its clients and servers.

    Raises CommandError if the service is unknown.
    """
    with graph.graph(args) as node:
        types = dict(node.get_service_names_and_types()).get(args.service_name)
        if not types:
            raise CommandError(f"Unknown service '{args.service_name}'")
        clients = node.count_clients(args.service_name)
        servers = node.count_services(args.service_name)
    print(f"Type: {types[0] if len(types) == 1 else types}")
    print(f"Clients count: {clients}")
    print(f"Services count: {servers}")
