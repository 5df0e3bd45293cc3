"""Two feet on a stock ROS 2: `ros2 launch pdr_bringup_scripts two_feet.launch.py left_imu:=/l/imu right_imu:=/r/imu`.

The nodes of each foot are in a namespace of their own, `left` and `right`; `odom`, `path` and the transform to
base_footprint are of the person. Needs the packages launch and launch_ros, which every ROS installation has.
"""

from pathlib import Path

from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource

from pdr_bringup_scripts.launching import description, of_person, of_sensor, person_node

FEET = ("left", "right")
ONE_FOOT = Path(__file__).with_name("foot.launch.py")


def generate_launch_description():
    return description([*of_person(), *(argument for foot in FEET for argument in of_sensor(foot))], nodes)


def nodes(said):
    """Return the nodes of both feet and of the person."""

    def foot_nodes(foot):
        of_foot = {
            "imu": said(f"{foot}_imu"),
            "mag": said(f"{foot}_mag"),
            "params": said("params"),
            "namespace": f"{said('namespace')}/{foot}".lstrip("/"),
            "foot_frame": f"{foot}_foot",
            "frame_prefix": said("frame_prefix"),
            "heading_feedback": "true",
        }
        return IncludeLaunchDescription(PythonLaunchDescriptionSource(str(ONE_FOOT)), launch_arguments=of_foot.items())

    return [*map(foot_nodes, FEET), person_node(said, {"node.feet": " ".join(FEET)})]
