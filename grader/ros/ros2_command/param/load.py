"""Load parameter file for a node."""

import sys
from argparse import Namespace
from typing import Any

from .. import graph, parameters
from ..parsing import CommandError, Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 param load`."""
    parameters.add_arguments(parser)
    parser.add_argument("node_name", help="Name of the node (e.g. '/talker')")
    parser.add_argument("parameter_file", help="YAML file, as `ros2 param dump` prints it")
    parser.add_argument(
        "--no-use-wildcard",
        action="store_true",
        help="Do not load the parameters of /** (those for all nodes) into the node",
    )
    parameters.add_timeout(parser)


def main(args: Namespace) -> None:
    """Set each parameter of the file and print whether the node took it.

    Raises CommandError if the node is not there or the file cannot be used.
    """
    with graph.graph(args) as node:
        client = parameters.client(node, args)
        wanted = _read(args.parameter_file, client.name, wildcard=not args.no_use_wildcard)
        results = client.set(list(wanted.values()))
    for name, result in zip(wanted, results):
        reason = f": {result.reason}" if result.reason else ""
        if result.successful:
            print(f"Set parameter {name} successful{reason}")
        else:
            print(f"Set parameter {name} failed{reason}", file=sys.stderr)


def _read(path: str, node: str, *, wildcard: bool) -> dict[str, Any]:
    import yaml  # noqa: PLC0415 (slow to import)
    from rclpy.parameter import parameter_dict_from_yaml_file  # noqa: PLC0415

    try:
        with open(path, encoding="utf-8") as file:  # noqa: PTH123
            named = yaml.safe_load(file) or {}
        # a file for all nodes only is one for this node, too
        target = [node] if not isinstance(named, dict) or set(named) != {"/**"} else None
        read: dict[str, Any] = parameter_dict_from_yaml_file(path, wildcard, target)
    except OSError as error:
        raise CommandError(f"{path}: {error.strerror}") from None
    except (yaml.YAMLError, RuntimeError, ValueError, AttributeError, TypeError) as error:
        raise CommandError(f"{path} is not a file of parameters of {node}: {error}") from None
    return read
