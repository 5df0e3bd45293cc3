"""Who publishes a topic, as far as this node knows the graph."""

from rclpy.node import Node


def publishers(node: Node, topic: str) -> list[str]:
    """Return the full names of the nodes that publish a topic, one for each publisher."""
    infos = node.get_publishers_info_by_topic(node.resolve_topic_name(topic))
    return sorted(f"{info.node_namespace.rstrip('/')}/{info.node_name}" for info in infos)
