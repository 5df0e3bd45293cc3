from setuptools import find_packages, setup

NAME = "pdr_nodes"
NODES = [
    "imu_driver",
    "imu_ingestion",
    "stance_detector",
    "zupt_ekf",
    "heading_fusion",
    "gait_dr",
    "mode_manager",
    "chest_pdr",
    "external_odometry",
]

setup(
    name=NAME,
    version="0.10.0",
    description="The ROS 2 nodes of the pedestrian dead reckoning suite.",
    maintainer="pdr maintainers",
    maintainer_email="pdr@example.org",
    license="Apache-2.0",
    packages=find_packages(include=[NAME, f"{NAME}.*"]),
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{NAME}"]),
        (f"share/{NAME}", ["package.xml"]),
    ],
    python_requires=">=3.10",
    install_requires=["setuptools", "pdr_core"],
    entry_points={"console_scripts": [f"{node} = {NAME}.{node}_node:main" for node in NODES]},
    zip_safe=False,
)
