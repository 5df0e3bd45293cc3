"""The one message of tf2_msgs for an environment that has none; it never hides a real one."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from bootstrap.environment import foreign_entries
from bootstrap.layout import Layout

MESSAGE = "geometry_msgs/TransformStamped[] transforms\n"

PACKAGE = """<?xml version="1.0"?>
<package format="3">
  <name>tf2_msgs</name>
  <version>0.0.0</version>
  <description>Fallback where there is no tf2_msgs: the transform message alone.</description>
  <maintainer email="pdr@example.org">pdr maintainers</maintainer>
  <license>Apache-2.0</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <buildtool_depend>rosidl_default_generators</buildtool_depend>
  <depend>geometry_msgs</depend>
  <exec_depend>rosidl_default_runtime</exec_depend>
  <member_of_group>rosidl_interface_packages</member_of_group>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""

CMAKE = """cmake_minimum_required(VERSION 3.21)
project(tf2_msgs)
find_package(ament_cmake REQUIRED)
find_package(geometry_msgs REQUIRED)
find_package(rosidl_default_generators REQUIRED)
rosidl_generate_interfaces(tf2_msgs msg/TFMessage.msg DEPENDENCIES geometry_msgs)
ament_export_dependencies(rosidl_default_runtime)
ament_package()
"""


def provided(environment: Mapping[str, str], layout: Layout) -> bool:
    """Tell whether ROS itself, sourced or from wheels, brings tf2_msgs."""
    entries = foreign_entries(environment.get("AMENT_PREFIX_PATH", ""), layout)
    if any(Path(entry, "share", "tf2_msgs", "package.xml").exists() for entry in entries):
        return True
    return _manifest(layout).exists() and not installed(layout)


def installed(layout: Layout) -> bool:
    """Tell whether the environment holds the fallback."""
    manifest = _manifest(layout)
    return manifest.exists() and manifest.read_text(encoding="utf-8") == PACKAGE


def _manifest(layout: Layout) -> Path:
    """Name the manifest of a tf2_msgs inside the environment."""
    return layout.venv / "share" / "tf2_msgs" / "package.xml"


def generate(layout: Layout) -> None:
    """Write the sources of the fallback into the build folder."""
    (layout.generated / "msg").mkdir(parents=True)
    (layout.generated / "package.xml").write_text(PACKAGE, encoding="utf-8")
    (layout.generated / "CMakeLists.txt").write_text(CMAKE, encoding="utf-8")
    (layout.generated / "msg" / "TFMessage.msg").write_text(MESSAGE, encoding="utf-8")
