"""The parameters of a node, read and set through its services."""

from __future__ import annotations

from typing import Any

from rcl_interfaces.msg import Parameter, ParameterEvent, ParameterType, ParameterValue
from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters, SetParameters
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from grader.run.in_probe.messages import LONGEST_TEXT, Values
from grader.run.in_probe.senders import Senders, taken_with_sender

MOST_PARAMETERS = 60
MOST_EVENTS = 1_000  # that wait to be taken
EVENTS = "/parameter_events"
OF_ROS = ("use_sim_time", "start_type_description_service")  # parameters that every node has

TYPES = {
    ParameterType.PARAMETER_BOOL: ("bool", "bool_value"),
    ParameterType.PARAMETER_INTEGER: ("integer", "integer_value"),
    ParameterType.PARAMETER_DOUBLE: ("double", "double_value"),
    ParameterType.PARAMETER_STRING: ("string", "string_value"),
    ParameterType.PARAMETER_BOOL_ARRAY: ("bool_array", "bool_array_value"),
    ParameterType.PARAMETER_INTEGER_ARRAY: ("integer_array", "integer_array_value"),
    ParameterType.PARAMETER_DOUBLE_ARRAY: ("double_array", "double_array_value"),
    ParameterType.PARAMETER_STRING_ARRAY: ("string_array", "string_array_value"),
}


def parameter_value(value: Any) -> ParameterValue:
    """Return a parameter's value for a bool, an int, a float, a text or a list of one of them."""
    if isinstance(value, bool):
        return ParameterValue(type=ParameterType.PARAMETER_BOOL, bool_value=value)
    if isinstance(value, int):
        return ParameterValue(type=ParameterType.PARAMETER_INTEGER, integer_value=value)
    if isinstance(value, float):
        return ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=value)
    return ParameterValue(type=ParameterType.PARAMETER_STRING, string_value=str(value))


def set_parameters(
    probe: Any, node: str, values: dict[str, Any], deadline: float
) -> list[list[Any]] | None:
    """Set parameters of a node: for each its name, whether it was accepted, and why not.

    None if the node does not answer.
    """
    wanted = [Parameter(name=name, value=parameter_value(value)) for name, value in values.items()]
    client = probe.node.create_client(SetParameters, f"{node}/set_parameters")
    answer = probe.call(client, SetParameters.Request(parameters=wanted), deadline)
    if answer is None:
        return None
    return [
        [one.name, bool(result.successful), result.reason[:200]]
        for one, result in zip(wanted, answer.results)
    ]


def read_parameters(probe: Any, node: str, deadline: float) -> list[dict[str, Any]] | None:
    """Return the name, type, value, range and whether it is read-only of a node's parameters.

    None if the node does not answer.
    """

    def asked(kind: Any, service: str, **request: Any) -> Any:
        client = probe.node.create_client(kind, f"{node}/{service}")
        return probe.call(client, kind.Request(**request), deadline)

    listed = asked(ListParameters, "list_parameters")
    if listed is None:
        return None
    names = [one for one in listed.result.names if one not in OF_ROS][:MOST_PARAMETERS]
    values = asked(GetParameters, "get_parameters", names=names)
    described = asked(DescribeParameters, "describe_parameters", names=names)
    found = []
    for one, value, about in zip(
        names, getattr(values, "values", ()), getattr(described, "descriptors", ())
    ):
        kind, attribute = TYPES.get(value.type, ("not set", ""))
        ranges = [*about.floating_point_range, *about.integer_range]
        found.append(
            {
                "name": one[:LONGEST_TEXT],
                "type": kind,
                "value": Values().of(getattr(value, attribute)) if attribute else None,
                "read_only": bool(about.read_only),
                "range": [ranges[0].from_value, ranges[0].to_value] if ranges else None,
            }
        )
    return found


class Changes:
    """The changes of parameters that nodes tell on /parameter_events, as every rclpy node does."""

    def __init__(self, probe: Any, group: Any, senders: Senders) -> None:
        self.probe, self.senders = probe, senders
        profile = QoSProfile(
            depth=MOST_EVENTS,
            reliability=ReliabilityPolicy.RELIABLE,
            durability=DurabilityPolicy.VOLATILE,
        )
        self.subscription = probe.node.create_subscription(
            ParameterEvent, EVENTS, lambda _: None, profile, callback_group=group
        )
        self.told: list[tuple[bytes, Any]] = []  # the publisher's GID, the event

    def forget(self) -> None:
        """Forget what was told until now."""
        self._take()
        self.told = []

    def _take(self) -> None:
        for event, _, gid in taken_with_sender(self.subscription, MOST_EVENTS):
            self.told = [*self.told, (gid, event)][-MOST_EVENTS:]

    def _values(self, node: str) -> dict[str, list[Any]]:
        """Return the values that a node itself has told for each of its parameters, in order."""
        found: dict[str, list[Any]] = {}
        for gid, event in self.told:
            if event.node == node and self.senders.of(gid, EVENTS) in ("", node):
                for one in (*event.new_parameters, *event.changed_parameters):
                    found.setdefault(one.name, []).append(_value_of(one.value))
        return found

    def unproven(self, node: str, values: dict[str, Any], deadline: float) -> dict[str, str]:
        """Return what is missing for values that a node has accepted: "event" or "value".

        The node itself tells of the new value, and then the parameter has what it told last (a
        callback may correct a value).
        """
        client = self.probe.node.create_client(GetParameters, f"{node}/get_parameters")
        answer = self.probe.call(client, GetParameters.Request(names=[*values]), deadline)
        now = dict(zip(values, map(_value_of, getattr(answer, "values", ()))))
        self._take()
        told = self._values(node)
        missing = {}
        for name, value in values.items():
            if _value_of(parameter_value(value)) not in told.get(name, ()):
                missing[name] = "event"
            elif now.get(name) != told[name][-1]:
                missing[name] = "value"
        return missing


def _value_of(value: ParameterValue) -> tuple[str, Any]:
    """Return a parameter's type and value."""
    kind, attribute = TYPES.get(value.type, ("not set", ""))
    return kind, Values().of(getattr(value, attribute)) if attribute else None
