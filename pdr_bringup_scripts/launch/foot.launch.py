"""One foot on a stock ROS 2: `ros2 launch pdr_bringup_scripts foot.launch.py imu:=/your/imu`, and `mag:=/your/mag`.

With `constraint:=dominant`, or another, heading_fusion holds the heading on straight lines: then the foot's nodes are
in the namespace `foot`, and `odom`, `path` and the transform to base_footprint are of the person.
With `adaptive:=true` mode_manager switches the gyro of a driver that offers `set_gyro_power`, wherever that is, and
gait_dr reckons strides while it is off; with a constraint too it holds them itself, and no node moves.
Needs the packages launch and launch_ros, which every ROS installation has.
"""

from pdr_bringup_scripts.launching import (
    argument,
    description,
    is_true,
    of_person,
    of_sensor,
    person_node,
    sensor_nodes,
)

NODES = ("imu_ingestion", "stance_detector", "zupt_ekf")
ADAPTIVE = ("imu_ingestion", "stance_detector", "gait_dr", "mode_manager")
SERVICES = ("set_gyro_power", "set_sample_rate")  # of a driver whose gyro can be switched
FOOT = "foot"  # the namespace of a foot whose heading is held


def generate_launch_description():
    arguments = [
        *of_sensor(),
        *of_person(),
        argument("foot_frame", "foot", "frame of the foot, one per foot"),
        argument("constraint", "", "heading.constraint: dominant, hde ..."),
        argument("adaptive", "false", "switch the gyro of the driver"),
        *(argument(name, name, "service of your driver") for name in SERVICES),
        argument("heading_feedback", "false", "another heading_fusion answers"),
    ]
    return description(arguments, nodes)


def nodes(said):
    """Return the nodes of the foot, and of the person where heading_fusion holds the heading."""
    constraint, home, switched = said("constraint"), said("namespace"), is_true(said, "adaptive")
    asked = is_true(said, "heading_feedback")
    if switched and asked:
        raise RuntimeError("adaptive does not go with a second foot")
    given = {"node.foot_frame": said("foot_frame")}
    if switched:  # gait_dr answers its steps itself
        given |= {"heading.constraint": constraint} if constraint else {}
        return sensor_nodes(ADAPTIVE, said, home, given, SERVICES)
    given |= {"filter.heading_feedback": True} if constraint or asked else {}
    if not constraint:
        return sensor_nodes(NODES, said, home, given, SERVICES)
    foot = sensor_nodes(NODES, said, f"{home}/{FOOT}".lstrip("/"), given, SERVICES)
    return [*foot, person_node(said, {"node.feet": FOOT, "heading.constraint": constraint})]
