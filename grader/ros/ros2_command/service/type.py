"""Output a service's type."""

from argparse import Namespace

from .. import graph
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 service type`."""
    graph.add_arguments(parser)
    parser.add_argument("service_name", help="Name of the service (e.g. '/reset')")


def main(args: Namespace) -> int:
    """Print the type, or each of several; return 1 without output if the service is unknown."""
    with graph.graph(args) as node:
        types = dict(node.get_service_names_and_types()).get(args.service_name, [])
    for each in types:
        print(each)
    return 0 if types else 1
