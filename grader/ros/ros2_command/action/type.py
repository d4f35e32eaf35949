"""Print a action's type."""

from argparse import Namespace

from .. import actions, graph
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 action type`."""
    graph.add_arguments(parser)
    parser.add_argument("action_name", help="Name of the action (e.g. '/rotate')")


def main(args: Namespace) -> int:
    """Print the type, or each of several; return 1 without output if the action is unknown."""
    with graph.graph(args) as node:
        types = dict(actions.names_and_types(node)).get(args.action_name, [])
    for each in types:
        print(each)
    return 0 if types else 1
