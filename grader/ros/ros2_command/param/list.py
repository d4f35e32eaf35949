"""Output a list of available parameters."""

import re
import sys
from argparse import Namespace

from .. import graph, parameters
from ..parsing import CommandError, Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 param list`."""
    parameters.add_arguments(parser)
    add = parser.add_argument
    add("node_name", nargs="?", help="Name of the node (e.g. '/talker'); default: all nodes")
    add("--param-prefixes", nargs="+", default=[], help="List only parameters below these names")
    add("--param-type", action="store_true", help="Print the types of the parameters, too")
    add("--filter", help="List only parameters whose names match this regular expression")
    parameters.add_timeout(parser)


def main(args: Namespace) -> None:
    """Print the names of the parameters of one node, or below the name of each.

    Raises CommandError if the node is not there or does not answer.
    """
    matches = _pattern(args.filter)
    with graph.graph(args) as node:
        if args.node_name is not None:
            _print(parameters.client(node, args), args, matches)
            return
        for name in parameters.names_of_nodes(node, args):
            client = parameters.Client(node, name, args.timeout)
            try:
                client.names()
            except CommandError as error:  # the others are listed all the same
                print(error, file=sys.stderr)
                continue
            print(f"{name}:")
            _print(client, args, matches)


def _pattern(expression: str | None) -> "re.Pattern[str]":
    try:
        return re.compile(expression or "")
    except re.error as error:
        raise CommandError(f"The filter is not a regular expression: {error}") from None


def _print(client: parameters.Client, args: Namespace, matches: "re.Pattern[str]") -> None:
    names = [name for name in client.names(args.param_prefixes) if matches.search(name)]
    if not args.param_type:
        print("".join(f"  {name}\n" for name in names), end="")
        return
    for name, kind in zip(names, client.types(names)):
        print(f"  {name} (type: {parameters.TYPES[kind][0]})")
