"""Who publishes a topic, as far as a node knows the graph."""

from rclpy.node import Node


def names(node: Node, topic: str) -> list[str]:
    """Return the full names of the nodes that publish a topic, one for each publisher."""
    return sorted(f"{info.node_namespace.rstrip('/')}/{info.node_name}" for info in infos(node, topic))


def identities(node: Node, topic: str) -> frozenset[bytes]:
    """Return what tells the publishers of a topic apart, even two of one name."""
    return frozenset(bytes(info.endpoint_gid) for info in infos(node, topic))


def infos(node: Node, topic: str) -> list:
    """Return what the graph knows of the publishers of a topic."""
    return node.get_publishers_info_by_topic(node.resolve_topic_name(topic))
