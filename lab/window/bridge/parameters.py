"""Reads and sets a node's parameters through its services, without waiting."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from typing import Any

from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters, SetParameters
from rclpy.node import Node

SECONDS = 3.0  # within which a node must answer
MOST_CALLS = 100
FIELDS = {
    ParameterType.PARAMETER_BOOL: ("bool", "bool_value"),
    ParameterType.PARAMETER_INTEGER: ("integer", "integer_value"),
    ParameterType.PARAMETER_DOUBLE: ("double", "double_value"),
    ParameterType.PARAMETER_STRING: ("string", "string_value"),
    ParameterType.PARAMETER_BYTE_ARRAY: ("byte_array", "byte_array_value"),
    ParameterType.PARAMETER_BOOL_ARRAY: ("bool_array", "bool_array_value"),
    ParameterType.PARAMETER_INTEGER_ARRAY: ("integer_array", "integer_array_value"),
    ParameterType.PARAMETER_DOUBLE_ARRAY: ("double_array", "double_array_value"),
    ParameterType.PARAMETER_STRING_ARRAY: ("string_array", "string_array_value"),
}
KINDS = {kind: number for number, (kind, _) in FIELDS.items()}
ELEMENTS = {"bool": bool, "integer": int, "double": float, "string": str}
MOST_INTEGER = 2**63

Answer = Callable[[Any], None]
"""Takes a service's answer, None if there was none in time."""


class Parameters:
    """Calls of parameter services; `expire` must be called from time to time."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._clients: dict[str, Any] = {}
        self._calls: list[tuple[float, Any, Any, Answer]] = []

    def read(self, full: str, answer: Callable[[list[dict[str, Any]] | None], None]) -> None:
        """Read all parameters of a node with their descriptions, sorted by name."""

        def listed(result: Any) -> None:
            if result is None:
                answer(None)
                return
            names = sorted(result.result.names)
            self.values(full, names, lambda values: described(names, values))

        def described(names: list[str], values: Any) -> None:
            if values is None:
                answer(None)
                return
            self._call(
                f"{full}/describe_parameters",
                DescribeParameters,
                DescribeParameters.Request(names=names),
                lambda result: answer(_rows(names, values, result)),
            )

        self._call(f"{full}/list_parameters", ListParameters, ListParameters.Request(), listed)

    def values(self, full: str, names: list[str], answer: Answer) -> None:
        """Get the values (ParameterValue) of some parameters of a node."""
        self._call(
            f"{full}/get_parameters",
            GetParameters,
            GetParameters.Request(names=names),
            lambda result: answer(None if result is None else list(result.values)),
        )

    def change(
        self, full: str, name: str, value: ParameterValue, answer: Callable[[bool, str], None]
    ) -> None:
        """Set a parameter; the answer is whether the node took it, and its reason if not."""
        request = SetParameters.Request(parameters=[Parameter(name=name, value=value)])

        def done(result: Any) -> None:
            if result is None or not result.results:
                answer(False, "no_answer")
            else:
                answer(bool(result.results[0].successful), str(result.results[0].reason))

        self._call(f"{full}/set_parameters", SetParameters, request, done)

    def _call(self, service: str, kind: Any, request: Any, answer: Answer) -> None:
        if service not in self._clients:
            self._clients[service] = self._node.create_client(kind, service)
        if len(self._calls) >= MOST_CALLS:
            answer(None)
            return
        self._calls.append((time.monotonic() + SECONDS, self._clients[service], request, answer))
        self.advance()

    @property
    def waits(self) -> bool:
        """Whether an answer is missing."""
        return bool(self._calls)

    def advance(self) -> None:
        """Send the requests whose service was found meanwhile; answer those that were not."""
        calls, self._calls = self._calls, []
        for until, client, request, answer in calls:
            if isinstance(request, _Sent):
                if request.future.done():
                    answer(_result(request.future))
                elif time.monotonic() > until:
                    client.remove_pending_request(request.future)
                    answer(None)
                else:
                    self._calls.append((until, client, request, answer))
            elif client.service_is_ready():
                sent = _Sent(client.call_async(request))
                self._calls.append((until, client, sent, answer))
            elif time.monotonic() > until:
                answer(None)
            else:
                self._calls.append((until, client, request, answer))

    def forget(self, nodes: set[str]) -> None:
        """Remove the clients of nodes that are no longer there."""
        for service in list(self._clients):
            waits = any(client is self._clients[service] for _, client, _, _ in self._calls)
            if service.rpartition("/")[0] not in nodes and not waits:
                self._node.destroy_client(self._clients.pop(service))


class _Sent:
    """A request on its way."""

    def __init__(self, future: Any) -> None:
        self.future = future


def _result(future: Any) -> Any:
    try:
        return future.result()
    except Exception:  # an answer that cannot be read is none
        return None


def _rows(names: list[str], values: Any, described: Any) -> list[dict[str, Any]]:
    descriptors = list(described.descriptors) if described is not None else []
    about = {descriptor.name: descriptor for descriptor in descriptors}
    return [_row(name, value, about.get(name)) for name, value in zip(names, values)]


def _row(name: str, value: Any, about: Any) -> dict[str, Any]:
    kind, field = FIELDS.get(value.type, ("not_set", ""))
    row: dict[str, Any] = {
        "name": name,
        "type": kind,
        "text": _text(kind, getattr(value, field, None)),
    }
    if about is not None:
        row |= {"description": about.description[:500], "read_only": bool(about.read_only)}
        for limits in [*about.integer_range, *about.floating_point_range]:
            row |= {"from": str(limits.from_value), "to": str(limits.to_value)}
    return row


def _text(kind: str, value: Any) -> str:
    """Return a value as a person types it."""
    if kind == "not_set":
        return ""
    if kind == "string":
        return str(value)
    if kind == "byte_array":
        return json.dumps([item[0] for item in value])
    if kind.endswith("_array"):
        return json.dumps([item.item() if hasattr(item, "item") else item for item in value])
    return json.dumps(value)


def parsed(kind: str, text: str) -> ParameterValue | None:
    """Return a parameter's value from what a person typed; None if it is not of that type."""
    element, is_array, _ = kind.partition("_array")
    try:
        read: Any = text if kind == "string" else json.loads(text)
        found = [_element(element, item) for item in read] if is_array else _element(element, read)
    except (ValueError, TypeError):
        return None
    value = ParameterValue(type=KINDS[kind])
    setattr(value, FIELDS[KINDS[kind]][1], found)
    return value


def _element(kind: str, value: Any) -> Any:
    if kind == "byte" and isinstance(value, int) and 0 <= value < 256:
        return bytes([value])
    if kind == "double" and type(value) in (int, float):
        return float(value)
    if kind in ELEMENTS and type(value) is ELEMENTS[kind]:
        if isinstance(value, int) and not -MOST_INTEGER <= value < MOST_INTEGER:
            raise ValueError
        return value
    raise ValueError
