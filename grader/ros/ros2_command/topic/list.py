"""Output a list of available topics."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from .. import graph

if TYPE_CHECKING:
    from argparse import Namespace

    from ..parsing import Parser


class _Topic(NamedTuple):
    name: str
    types: list[str]
    publishers: int
    subscribers: int


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 topic list`."""
    graph.add_arguments(parser)
    add = parser.add_argument
    add("-t", "--show-types", action="store_true", help="Additionally show the topic type")
    add(
        "-c",
        "--count-topics",
        action="store_true",
        help="Only display the number of topics discovered",
    )
    add("--include-hidden-topics", action="store_true", help="Consider hidden topics as well")
    add("-v", "--verbose", action="store_true", help="List full details about each topic")


def main(args: Namespace) -> None:
    """Print the topics' names, sorted, with the details of the options; or only their number.

    Raises what `graph.graph` raises.
    """
    with graph.graph(args) as node:
        topics = [
            _Topic(name, types, node.count_publishers(name), node.count_subscribers(name))
            for name, types in sorted(node.get_topic_names_and_types())
            if args.include_hidden_topics or not graph.is_hidden(name)
        ]
    if args.count_topics:
        print(len(topics))
    elif args.verbose and topics:
        print(_details("Published", "publisher", [(t, t.publishers) for t in topics]))
        print(_details("Subscribed", "subscriber", [(t, t.subscribers) for t in topics]))
    else:
        for topic in topics:
            print(f"{topic.name} [{', '.join(topic.types)}]" if args.show_types else topic.name)


def _details(title: str, role: str, counts: list[tuple[_Topic, int]]) -> str:
    lines = [
        f" * {topic.name} [{', '.join(topic.types)}] {count} {role}{'s' if count > 1 else ''}\n"
        for topic, count in counts
        if count
    ]
    return f"{title} topics:\n{''.join(lines)}"
