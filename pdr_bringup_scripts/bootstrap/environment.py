"""The environment variables our programs get: set from scratch, so nothing stale is inherited."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from bootstrap.layout import STAMP_NAME, Layout

SEARCH_PATHS = ("AMENT_PREFIX_PATH", "LD_LIBRARY_PATH", "PYTHONPATH", "CMAKE_PREFIX_PATH")
STALE = (
    *SEARCH_PATHS,
    "COLCON_PREFIX_PATH",
    "PYTHONHOME",
    "VIRTUAL_ENV",
    "_ROS_WHEELS_BOOTSTRAP_COMPLETE",
    "PIP_TARGET",
    "PIP_PREFIX",
)


def foreign_entries(search_path: str, layout: Layout) -> list[str]:
    """Split a search path and drop what lies in this or another environment made by pdr."""
    return [entry for entry in search_path.split(os.pathsep) if entry and not _ours(entry, layout)]


def clean_environment(inherited: Mapping[str, str], layout: Layout) -> dict[str, str]:
    """Keep what does not say where Python or ROS packages lie."""
    environment = {name: value for name, value in inherited.items() if name not in STALE}
    environment["PATH"] = os.pathsep.join(foreign_entries(inherited.get("PATH", os.defpath), layout))
    return environment


def launch_environment(inherited: Mapping[str, str], layout: Layout, sourced: bool) -> dict[str, str]:
    """Give the environment in which everything of pdr runs, and in which messages are built."""
    environment = clean_environment(inherited, layout)
    kept = inherited if sourced else {}
    own = {
        "PATH": [str(layout.venv / "bin"), environment["PATH"]],
        "AMENT_PREFIX_PATH": [str(layout.venv)],
        "LD_LIBRARY_PATH": _library_folders(layout),
    }
    for name in SEARCH_PATHS:
        entries = own.get(name, []) + foreign_entries(kept.get(name, ""), layout)
        if entries:
            environment[name] = os.pathsep.join(entries)
    environment["PATH"] = os.pathsep.join(own["PATH"])
    environment["VIRTUAL_ENV"] = str(layout.venv)
    environment["_ROS_WHEELS_BOOTSTRAP_COMPLETE"] = "1"
    environment.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    if not sourced:  # the wheels have one middleware linked in
        environment["RMW_IMPLEMENTATION"] = "rmw_fastrtps_cpp"
    return environment


def _library_folders(layout: Layout) -> list[str]:
    """List the folders of shared libraries: our messages' and those inside the ROS wheels."""
    wheels = sorted(layout.site_packages.glob("ros_*.libs"))
    return [str(layout.venv / "lib"), *map(str, wheels)]


def _ours(entry: str, layout: Layout) -> bool:
    """Tell whether this path lies in an environment that pdr made."""
    path = Path(entry)
    folders = (path, *path.parents)
    return layout.venv in folders or any((folder / STAMP_NAME).exists() for folder in folders)
