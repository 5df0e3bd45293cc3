from glob import glob

from setuptools import find_packages, setup

NAME = "pdr_bringup_scripts"

setup(
    name=NAME,
    version="0.10.0",
    description="The pdr command, launch files and configuration of the suite.",
    maintainer="pdr maintainers",
    maintainer_email="pdr@example.org",
    license="Apache-2.0",
    # bootstrap/ beside it stays in the checkout: it makes the environment this is installed into
    packages=find_packages(include=[NAME, f"{NAME}.*"]),
    package_data={f"{NAME}.live": ["fastdds_quick.xml"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{NAME}"]),
        (f"share/{NAME}", ["package.xml"]),
        (f"share/{NAME}/launch", glob("launch/*.launch.py")),
        (f"share/{NAME}/config", glob("config/*.yaml")),
    ],
    python_requires=">=3.10",
    install_requires=["setuptools", "pdr_core", "pdr_nodes", "rich", "typer"],
    entry_points={"console_scripts": [f"pdr = {NAME}.__main__:main"]},
    zip_safe=False,
)
