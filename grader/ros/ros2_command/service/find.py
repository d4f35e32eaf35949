"""Output a list of available services of a given type."""

from argparse import Namespace

from .. import graph
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 service find`."""
    graph.add_arguments(parser)
    add = parser.add_argument
    add("service_type", help="Type to look for (e.g. 'std_srvs/srv/SetBool')")
    add(
        "-c",
        "--count-services",
        action="store_true",
        help="Only display the number of services discovered",
    )
    add("--include-hidden-services", action="store_true", help="Consider hidden services as well")


def main(args: Namespace) -> None:
    """Print the names of the services of a type, sorted, or their number."""
    with graph.graph(args) as node:
        found = graph.services(node, hidden=args.include_hidden_services)
    names = [name for name, types in found if args.service_type in types]
    if args.count_services:
        print(len(names))
        return
    for name in names:
        print(name)
