"""Print a topic's type."""

from argparse import Namespace

from .. import graph, topics
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 topic type`."""
    graph.add_arguments(parser)
    parser.add_argument("topic_name", help="Name of the topic (e.g. '/chatter')")


def main(args: Namespace) -> int:
    """Print the type, or each of several; return 1 without output if the topic is unknown."""
    with graph.graph(args) as node:
        found = topics.types(node, args.topic_name)
    for each in found:
        print(each)
    return 0 if found else 1
