from setuptools import find_packages, setup

NAME = "pdr_core"

setup(
    name=NAME,
    version="0.10.0",
    description="Pedestrian dead reckoning from foot- and body-worn inertial sensors, without ROS.",
    maintainer="pdr maintainers",
    maintainer_email="pdr@example.org",
    license="Apache-2.0",
    packages=find_packages(include=[NAME, f"{NAME}.*"]),
    package_data={NAME: ["py.typed", "recording/formats/*.yaml", "evaluation/*.html*"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{NAME}"]),
        (f"share/{NAME}", ["package.xml"]),
    ],
    python_requires=">=3.10",
    install_requires=["numpy", "scipy", "numba", "PyYAML", "rosbags", "mcap", "plotly", "jinja2"],
    extras_require={"compare": ["ahrs"]},
    zip_safe=False,
)
