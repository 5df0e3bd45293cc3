"""ROS parameters from `pdr_core.params`: declared with text, unit and bounds, read once, checked at the start."""

import dataclasses
from typing import Any

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.node import Node

from pdr_core.parameter import grouped, meta
from pdr_core.params import GROUPS, Params, params_from_mapping


def read_params(node: Node, groups: tuple[str, ...]) -> Params:
    """Return the parameters of these groups; those that the user did not give are declared with their defaults.

    The node is made with `automatically_declare_parameters_from_overrides`, so what the user gave is declared
    already, but without text and bounds. One file serves all nodes: values of other groups are checked too.
    """
    given = {name: parameter.value for name, parameter in node.get_parameters_by_prefix("").items()}
    params = params_from_mapping(grouped(given))
    for group in groups:
        for field in dataclasses.fields(GROUPS[group]):
            name = f"{group}.{field.name}"
            shown = descriptor(field)
            if node.has_parameter(name) and node.describe_parameter(name).read_only:
                continue  # the node was configured before
            if node.has_parameter(name):
                shown.type = node.get_parameter(name).type_.value
                node.set_descriptor(name, shown)
            else:
                node.declare_parameter(name, field.default, shown)
    return params


def descriptor(field: Any) -> ParameterDescriptor:
    """Return what ROS tools show of a parameter."""
    known = meta(field)
    out = ParameterDescriptor(description=known.doc, additional_constraints=known.allowed, read_only=True)
    if known.bounds and isinstance(field.default, float):
        low, high = map(float, known.bounds)
        out.floating_point_range = [FloatingPointRange(from_value=low, to_value=high)]
    elif known.bounds:
        low_int, high_int = map(int, known.bounds)
        out.integer_range = [IntegerRange(from_value=low_int, to_value=high_int)]
    return out
