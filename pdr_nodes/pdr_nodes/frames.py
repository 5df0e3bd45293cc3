"""What the frames of a node are called, so that tf2 takes them and several people fit on one /tf."""

from dataclasses import fields, replace

from pdr_core.parameter import ParameterError
from pdr_core.params import NodeParams, Params

FRAMES = tuple(field.name for field in fields(NodeParams) if field.name.endswith("_frame"))


def prefixed(params: Params) -> Params:
    """Return the parameters with `node.frame_prefix` before every frame; ParameterError for a name tf2 refuses."""
    node = params.node
    named = {name: node.frame_prefix + getattr(node, name) for name in FRAMES}
    for name, frame in named.items():
        if frame.startswith("/") or not getattr(node, name):
            text = f"node.{name} = {frame!r}, with node.frame_prefix: tf2 takes no frame that is empty or begins with /"
            raise ParameterError(text)
    return replace(params, node=replace(node, **named))
