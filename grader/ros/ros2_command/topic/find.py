"""Output a list of available topics of a given type."""

from argparse import Namespace

from .. import graph
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 topic find`."""
    graph.add_arguments(parser)
    parser.add_argument("topic_type", help="Type to look for (e.g. 'std_msgs/msg/String')")
    parser.add_argument(
        "-c",
        "--count-topics",
        action="store_true",
        help="Only display the number of topics discovered",
    )
    parser.add_argument(
        "--include-hidden-topics", action="store_true", help="Consider hidden topics as well"
    )


def main(args: Namespace) -> None:
    """Print the names of the topics of a type, sorted, or their number."""
    with graph.graph(args) as node:
        names = [
            name
            for name, types in sorted(node.get_topic_names_and_types())
            if args.topic_type in types
            and (args.include_hidden_topics or not graph.is_hidden(name))
        ]
    print(*([len(names)] if args.count_topics else names), sep="\n", end="\n" if names else "")
