"""The parameters of a node, read and set through its services."""

from __future__ import annotations

from typing import Any

from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters, SetParameters

from grader.run.in_probe.messages import LONGEST_TEXT, Values

MOST_PARAMETERS = 60
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
