"""Print information about an action."""

from argparse import Namespace

from .. import actions, graph
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 action info`."""
    graph.add_arguments(parser)
    parser.add_argument("action_name", help="Name of the action (e.g. '/rotate')")
    parser.add_argument(
        "-t", "--show-types", action="store_true", help="Additionally show the action type"
    )
    parser.add_argument(
        "-c", "--count", action="store_true", help="Only display the number of clients and servers"
    )


def main(args: Namespace) -> None:
    """Print the nodes that have a client or a server of an action."""
    with graph.graph(args) as node:
        roles = {
            "clients": actions.clients(node, args.action_name),
            "servers": actions.servers(node, args.action_name),
        }
    print(f"Action: {args.action_name}")
    for role, nodes in roles.items():
        print(f"Action {role}: {len(nodes)}")
        for name, types in [] if args.count else nodes:
            print(f"    {name} [{', '.join(types)}]" if args.show_types else f"    {name}")
