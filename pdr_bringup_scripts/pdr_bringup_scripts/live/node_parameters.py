"""Asks running nodes for their parameters, without waiting for any of them."""

import time
from collections.abc import Iterable
from typing import Any

from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python
from rclpy.parameter_client import AsyncParameterClient

from pdr_core.params import GROUPS

AGAIN_S = 1.0  # a node that is not configured yet, or does not answer, is asked again
Values = dict[str, Any]  # by name, as group.name


class AskedNode:
    """One node. `own` are the parameters that it reads, as it has answered last: those that it describes.

    One file of parameters serves all nodes, so it may have been given others too.
    """

    def __init__(self, asking: Node, full_name: str) -> None:
        self._client = AsyncParameterClient(asking, full_name)
        self._asked_s = -AGAIN_S
        self._names: list[str] = []
        self._values: Any = None  # of the parameters, to come
        self._texts: Any = None
        self._wanted = True  # an answer
        self.own: Values = {}

    def ask_again(self) -> None:
        """Want to know what it reads now: it may be another process of the same name."""
        self._wanted = True

    def look(self) -> None:
        """Go on asking; call it now and then."""
        if not self._wanted:
            return
        if self._values and self._values.done() and self._texts.done():
            self._take(self._values.result().values, self._texts.result().descriptors)
        elif time.monotonic() - self._asked_s > AGAIN_S and self._client.services_are_ready():
            self._asked_s = time.monotonic()
            self._client.list_parameters().add_done_callback(self._named)

    def _named(self, answer: Any) -> None:
        self._names = [name for name in answer.result().result.names if name.partition(".")[0] in GROUPS]
        self._values = self._client.get_parameters(self._names)
        self._texts = self._client.describe_parameters(self._names)

    def _take(self, values: list[Any], descriptors: list[Any]) -> None:
        self._values = self._texts = None
        of_names = zip(self._names, values, descriptors, strict=True)
        own = {name: parameter_value_to_python(value) for name, value, text in of_names if text.description}
        if own:
            self.own, self._wanted = own, False


def together(nodes: Iterable[AskedNode]) -> dict[str, Values]:
    """Return what several nodes read as {group: {name: value}}."""
    groups: dict[str, Values] = {}
    for name, value in sorted((name, value) for node in nodes for name, value in node.own.items()):
        group, _, rest = name.partition(".")
        groups.setdefault(group, {})[rest] = value
    return groups
