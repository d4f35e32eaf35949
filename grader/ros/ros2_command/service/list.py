"""Output a list of available services."""

from argparse import Namespace

from .. import graph
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 service list`."""
    graph.add_arguments(parser)
    add = parser.add_argument
    add("-t", "--show-types", action="store_true", help="Additionally show the service type")
    add(
        "-c",
        "--count-services",
        action="store_true",
        help="Only display the number of services discovered",
    )
    add("--include-hidden-services", action="store_true", help="Consider hidden services as well")


def main(args: Namespace) -> None:
    """Print the names of the services, sorted, or their number."""
    with graph.graph(args) as node:
        found = graph.services(node, hidden=args.include_hidden_services)
    if args.count_services:
        print(len(found))
        return
    for name, types in found:
        print(f"{name} [{', '.join(types)}]" if args.show_types else name)
