"""One foot on a stock ROS 2: `ros2 launch pdr_bringup_scripts foot.launch.py imu:=/your/imu`, and `mag:=/your/mag`.

Needs the packages launch and launch_ros, which every ROS installation has.
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

NODES = ("imu_ingestion", "stance_detector", "zupt_ekf")


def generate_launch_description():
    defaults = PathJoinSubstitution([FindPackageShare("pdr_bringup_scripts"), "config", "foot.yaml"])
    arguments = [
        DeclareLaunchArgument("imu", default_value="imu/data_raw", description="topic of your driver"),
        DeclareLaunchArgument("mag", default_value="", description="topic of its magnetometer, if it has one"),
        DeclareLaunchArgument("params", default_value=defaults, description="parameter file, see `pdr params`"),
        DeclareLaunchArgument("namespace", default_value="", description="one per foot"),
        DeclareLaunchArgument("foot_frame", default_value="foot", description="frame of the foot, one per foot"),
    ]
    return LaunchDescription([*arguments, OpaqueFunction(function=nodes)])


def nodes(context):
    """Return the nodes; a topic of a magnetometer says that there is one."""
    mag = LaunchConfiguration("mag").perform(context)
    given = {"node.foot_frame": LaunchConfiguration("foot_frame")} | ({"node.magnetometer": True} if mag else {})
    return [
        Node(
            package="pdr_nodes",
            executable=name,
            namespace=LaunchConfiguration("namespace"),
            parameters=[LaunchConfiguration("params"), given],
            remappings=[("imu/data_raw", LaunchConfiguration("imu")), ("imu/mag", mag or "imu/mag")],
        )
        for name in NODES
    ]
