"""A card on the chest on a stock ROS 2: `ros2 launch pdr_bringup_scripts chest.launch.py imu:=/your/imu`.

With a magnetometer, add `mag:=/your/mag`.

Needs the packages launch and launch_ros, which every ROS installation has.
"""

from pdr_bringup_scripts.launching import argument, description, of_person, of_sensor, sensor_nodes

NODES = ("imu_ingestion", "chest_pdr")


def generate_launch_description():
    constraint = argument("constraint", "", "heading.constraint: dominant, hde ...; default: as in the file")
    return description([*of_sensor(), *of_person(), constraint], nodes)


def nodes(said):
    constraint = said("constraint")
    return sensor_nodes(NODES, said, said("namespace"), {"heading.constraint": constraint} if constraint else {})
