"""The parameters of other nodes: calls of their parameter services, and their values as text."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import graph
from .parsing import CommandError, Parser, positive_float

if TYPE_CHECKING:
    from argparse import Namespace

TIMEOUT = 5.0  # seconds to wait for a node's answer
# rcl_interfaces/msg/ParameterType: the name, the field of ParameterValue, and the words of `get`
TYPES = {
    0: ("not set", None, "Parameter not set"),
    1: ("boolean", "bool_value", "Boolean value is:"),
    2: ("integer", "integer_value", "Integer value is:"),
    3: ("double", "double_value", "Double value is:"),
    4: ("string", "string_value", "String value is:"),
    5: ("byte array", "byte_array_value", "Byte values are:"),
    6: ("boolean array", "bool_array_value", "Boolean values are:"),
    7: ("integer array", "integer_array_value", "Integer values are:"),
    8: ("double array", "double_array_value", "Double values are:"),
    9: ("string array", "string_array_value", "String values are:"),
}


def add_arguments(parser: Parser) -> None:
    """Declare the options shared by all verbs of `ros2 param`."""
    graph.add_arguments(parser)
    parser.add_argument(
        "--include-hidden-nodes", action="store_true", help="Consider hidden nodes as well"
    )


def add_timeout(parser: Parser) -> None:
    """Declare the option for the wait for a node's answer."""
    parser.add_argument(
        "--timeout",
        metavar="N",
        type=positive_float,
        default=TIMEOUT,
        help=f"Seconds to wait for the node's answer (default: {TIMEOUT:.0f})",
    )


def client(node: Any, args: Namespace) -> Client:
    """Return a client of the node that is named; raises CommandError if it is not there."""
    name = args.node_name if args.node_name.startswith("/") else f"/{args.node_name}"
    if name not in names_of_nodes(node, args):
        raise CommandError("Node not found")
    return Client(node, name, args.timeout)


def names_of_nodes(node: Any, args: Namespace) -> list[str]:
    """Return the full names of the nodes that the options select, sorted."""
    hidden = f"/{graph.HIDDEN_PREFIX}"
    found = sorted(set(graph.node_names(node)))
    return [n for n in found if args.include_hidden_nodes or hidden not in n[n.rindex("/") :]]


class Client:
    """Calls of the parameter services of one other node; `timeout` is in seconds.

    Every call raises CommandError if the node does not answer in time.
    """

    def __init__(self, node: Any, name: str, timeout: float) -> None:
        self.name = name
        self._node = node
        self._timeout = timeout

    def names(self, prefixes: list[str] | None = None) -> list[str]:
        """Return the names of the parameters, sorted; only those below the prefixes if given."""
        answer = self._call("ListParameters", "list_parameters", prefixes=prefixes or [])
        return sorted(answer.result.names)

    def values(self, names: list[str]) -> list[Any]:
        """Return the rcl_interfaces/msg/ParameterValue of each name."""
        return list(self._call("GetParameters", "get_parameters", names=names).values)

    def types(self, names: list[str]) -> list[int]:
        """Return the type of each name, a key of `TYPES`."""
        return list(self._call("GetParameterTypes", "get_parameter_types", names=names).types)

    def descriptors(self, names: list[str]) -> list[Any]:
        """Return the rcl_interfaces/msg/ParameterDescriptor of each name."""
        answer = self._call("DescribeParameters", "describe_parameters", names=names)
        return list(answer.descriptors)

    def set(self, parameters: list[Any]) -> list[Any]:
        """Set rcl_interfaces/msg/Parameter; return a SetParametersResult for each."""
        return list(self._call("SetParameters", "set_parameters", parameters=parameters).results)

    def set_atomically(self, parameters: list[Any]) -> Any:
        """Set all parameters or none; return the SetParametersResult."""
        kind = "SetParametersAtomically"
        return self._call(kind, "set_parameters_atomically", parameters=parameters).result

    def _call(self, kind: str, service: str, **fields: Any) -> Any:
        from rcl_interfaces import srv  # noqa: PLC0415 (slow to import)
        from rclpy import spin_until_future_complete  # noqa: PLC0415

        type_ = getattr(srv, kind)
        client = self._node.create_client(type_, f"{self.name}/{service}")
        try:
            if not client.wait_for_service(timeout_sec=self._timeout):
                raise CommandError(f"The node {self.name} has no parameter services")
            future = client.call_async(type_.Request(**fields))
            spin_until_future_complete(self._node, future, timeout_sec=self._timeout)
            if not future.done():
                raise CommandError(
                    f"The node {self.name} did not answer within {self._timeout:g} seconds; is it "
                    "busy, or does it not spin?"
                )
            return future.result()
        finally:
            self._node.destroy_client(client)


def plain(value: Any) -> Any:
    """Return a ParameterValue as a Python value, None if it is not set."""
    field = TYPES[value.type][1]
    content: Any = None if field is None else getattr(value, field)
    return content.tolist() if hasattr(content, "tolist") else content


def from_text(name: str, text: str) -> Any:
    """Return the rcl_interfaces/msg/Parameter of a command line's value, which is YAML."""
    from rcl_interfaces.msg import Parameter  # noqa: PLC0415 (slow to import)
    from rclpy.parameter import get_parameter_value  # noqa: PLC0415

    try:
        return Parameter(name=name, value=get_parameter_value(text))
    except (AssertionError, ValueError) as error:  # such as a mapping
        raise CommandError(f"{text} is not a value of a parameter: {error}") from None
