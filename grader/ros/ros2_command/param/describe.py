"""Show descriptive information about declared parameters."""

from argparse import Namespace
from collections.abc import Iterator
from typing import Any

from .. import graph, parameters
from ..parsing import CommandError, Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 param describe`."""
    parameters.add_arguments(parser)
    parser.add_argument("node_name", help="Name of the node (e.g. '/talker')")
    parser.add_argument("parameter_names", nargs="+", help="Names of the parameters")
    parameters.add_timeout(parser)


def main(args: Namespace) -> None:
    """Print the type, description and constraints of each parameter.

    Raises CommandError if the node is not there or does not declare one of them.
    """
    with graph.graph(args) as node:
        client = parameters.client(node, args)
        descriptors = client.descriptors(args.parameter_names)
    if not descriptors:
        raise CommandError(f"{client.name} does not declare: {', '.join(args.parameter_names)}")
    for descriptor in descriptors:
        print("\n".join(_lines(descriptor)))


def _lines(descriptor: Any) -> Iterator[str]:
    yield f"Parameter name: {descriptor.name}"
    yield f"  Type: {parameters.TYPES[descriptor.type][0]}"
    if descriptor.description:
        yield f"  Description: {descriptor.description}"
    yield "  Constraints:"
    if descriptor.read_only:
        yield "    Read only: true"
    for limits in (*descriptor.integer_range, *descriptor.floating_point_range):
        yield f"    Min value: {limits.from_value}"
        yield f"    Max value: {limits.to_value}"
        if limits.step:
            yield f"    Step: {limits.step}"
    if descriptor.additional_constraints:
        yield f"    Additional constraints: {descriptor.additional_constraints}"
