"""Show all of the parameters of a node in a YAML file format."""

from argparse import Namespace
from typing import Any

from .. import graph, parameters
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 param dump`."""
    parameters.add_arguments(parser)
    parser.add_argument("node_name", help="Name of the node (e.g. '/talker')")
    parameters.add_timeout(parser)


def main(args: Namespace) -> None:
    """Print the parameters as `ros2 param load` and `--params-file` read them.

    Raises CommandError if the node is not there or does not answer.
    """
    import yaml  # noqa: PLC0415 (slow to import)

    tree: dict[str, Any] = {}
    with graph.graph(args) as node:
        client = parameters.client(node, args)
        names = client.names()
        for name, value in zip(names, client.values(names)):
            _insert(tree, name.split("."), parameters.plain(value))
    file = {client.name: {"ros__parameters": tree}}
    print(yaml.dump(file, default_flow_style=False, allow_unicode=True), end="")


def _insert(tree: dict[str, Any], parts: list[str], value: Any) -> None:
    for n, part in enumerate(parts[:-1]):
        inner = tree.setdefault(part, {})
        if not isinstance(inner, dict):  # `a` and `a.b` are both parameters
            tree[".".join(parts[n:])] = value
            return
        tree = inner
    tree[parts[-1]] = value
