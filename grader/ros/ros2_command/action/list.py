"""Output a list of action names."""

from argparse import Namespace

from .. import actions, graph
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 action list`."""
    graph.add_arguments(parser)
    parser.add_argument(
        "-t", "--show-types", action="store_true", help="Additionally show the action type"
    )
    parser.add_argument(
        "-c",
        "--count-actions",
        action="store_true",
        help="Only display the number of actions discovered",
    )


def main(args: Namespace) -> None:
    """Print the names of the actions, sorted, or their number."""
    with graph.graph(args) as node:
        found = actions.names_and_types(node)
    if args.count_actions:
        print(len(found))
        return
    for name, types in found:
        print(f"{name} [{', '.join(types)}]" if args.show_types else name)
