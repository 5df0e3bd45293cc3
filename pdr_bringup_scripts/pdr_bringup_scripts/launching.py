"""What the launch files share: the arguments of a person and of a sensor, and the nodes behind a sensor.

The packages launch and launch_ros are those of a ROS installation; nothing else here imports them.
"""

from collections.abc import Callable, Iterable, Sequence
from typing import Any

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

Said = Callable[[str], str]  # an argument by its name


def argument(name: str, default: Any, description: str) -> DeclareLaunchArgument:
    """Return an argument of a launch file."""
    return DeclareLaunchArgument(name, default_value=default, description=description)


def is_true(said: Said, name: str) -> bool:
    """Return whether an argument says true, in the words of launch itself; RuntimeError: neither true nor false."""
    words = {"true": True, "1": True, "false": False, "0": False}
    try:
        return words[said(name).strip().lower()]
    except KeyError:
        raise RuntimeError(f"{name} is true or false, not {said(name)!r}") from None


def of_person() -> list[DeclareLaunchArgument]:
    """Return the arguments that every launch file has."""
    defaults = PathJoinSubstitution([FindPackageShare("pdr_bringup_scripts"), "config", "foot.yaml"])
    return [
        argument("params", defaults, "parameter file, see `pdr params`"),
        argument("namespace", "", "one per person"),
        argument("frame_prefix", "", "before every frame, as alice/"),
    ]


def of_sensor(side: str = "") -> list[DeclareLaunchArgument]:
    """Return the arguments of a sensor, those of one foot with its name before theirs."""
    start = f"{side}_" if side else ""
    return [
        argument(f"{start}imu", "imu/data_raw", f"topic of your {side} driver".replace("  ", " ")),
        argument(f"{start}mag", "", "topic of its magnetometer, if it has one"),
    ]


def description(arguments: Iterable[DeclareLaunchArgument], nodes: Callable[[Said], list[Any]]) -> LaunchDescription:
    """Return what a launch file returns; `nodes` is told what was said."""

    def made(context: Any) -> list[Any]:
        return nodes(lambda name: LaunchConfiguration(name).perform(context))

    return LaunchDescription([*arguments, OpaqueFunction(function=made)])


def frames(said: Said) -> dict[str, Any]:
    """Return the parameter of the frames' prefix; where nothing is said, the file's counts."""
    return {"node.frame_prefix": said("frame_prefix")} if said("frame_prefix") else {}


def sensor_nodes(
    names: Sequence[str], said: Said, namespace: str, given: dict[str, Any], services: Sequence[str] = ()
) -> list[Node]:
    """Return the nodes behind one sensor; a topic of a magnetometer says that there is one."""
    mag = said("mag")
    given = frames(said) | given | ({"node.magnetometer": True} if mag else {})
    topics = [("imu/data_raw", said("imu")), ("imu/mag", mag or "imu/mag")]
    return [
        Node(
            package="pdr_nodes",
            executable=name,
            namespace=namespace,
            parameters=[said("params"), given],
            remappings=topics + [(service, said(service)) for service in services],
        )
        for name in names
    ]


def person_node(said: Said, given: dict[str, Any]) -> Node:
    """Return the node that speaks for the person whose feet other nodes follow."""
    parameters = [said("params"), frames(said) | given]
    return Node(package="pdr_nodes", executable="heading_fusion", namespace=said("namespace"), parameters=parameters)
