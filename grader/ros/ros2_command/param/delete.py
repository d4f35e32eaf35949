"""Delete parameter."""

import sys
from argparse import Namespace

from .. import graph, parameters
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 param delete`."""
    parameters.add_arguments(parser)
    parser.add_argument("node_name", help="Name of the node (e.g. '/talker')")
    parser.add_argument("parameter_name", help="Name of the parameter")
    parameters.add_timeout(parser)


def main(args: Namespace) -> None:
    """Delete the parameter and print whether the node did (the status is 0 if it did not)."""
    from rcl_interfaces.msg import Parameter  # noqa: PLC0415 (slow to import)

    with graph.graph(args) as node:
        # a parameter without a value is one to delete (rcl_interfaces/srv/SetParameters)
        (result,) = parameters.client(node, args).set([Parameter(name=args.parameter_name)])
    reason = f": {result.reason}" if result.reason else ""
    if result.successful:
        print(f"Deleted parameter successfully{reason}")
    else:
        print(f"Deleting parameter failed{reason}", file=sys.stderr)
