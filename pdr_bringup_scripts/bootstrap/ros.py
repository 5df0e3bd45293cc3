"""Which ROS there is: a sourced ROS 2 Jazzy, or the wheels that the set-up installs."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from bootstrap.environment import foreign_entries
from bootstrap.layout import Layout

KEPT_PACKAGES = ("numpy", "pytest")
PROBE = """
import importlib.metadata, json, sys
import numpy, rclpy
def version(name):
    try:
        return importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return ""
print(json.dumps({name: version(name) for name in sys.argv[1:]}))
"""


@dataclass(frozen=True)
class SourcedRos:
    """A ROS installation that the user's shell has sourced, with the Python it runs under."""

    prefix: str
    python: str
    kept: dict[str, str]
    """Packages of that Python whose version must stay (the message extensions link to numpy)."""


def sourced_prefix(environment: Mapping[str, str], layout: Layout) -> str:
    """Give the folder of the sourced ROS 2 Jazzy that holds rclpy, or nothing; reads no code."""
    if environment.get("ROS_DISTRO") != "jazzy":
        return ""
    for entry in foreign_entries(environment.get("AMENT_PREFIX_PATH", ""), layout):
        if any(Path(entry).glob("lib/python3.*/site-packages/rclpy/__init__.py")):
            return entry
    return ""


def find_sourced(environment: Mapping[str, str], layout: Layout) -> SourcedRos | None:
    """Find the sourced ROS and a Python that can import its rclpy; none if either is missing."""
    prefix = sourced_prefix(environment, layout)
    if not prefix:
        return None
    for python in _candidates(prefix, environment):
        kept = _kept_versions(python, environment)
        if kept is not None:
            return SourcedRos(prefix, python, kept)
    return None


def _candidates(prefix: str, environment: Mapping[str, str]) -> list[str]:
    """List the interpreters on PATH of the version that the ROS packages were made for."""
    path = environment.get("PATH", os.defpath)
    versions = [entry.name for entry in Path(prefix, "lib").glob("python3.*")]
    found = [shutil.which(name, path=path) for name in [*versions, "python3"]]
    return [python for python in found if python]


def _kept_versions(python: str, environment: Mapping[str, str]) -> dict[str, str] | None:
    """Ask this Python for the versions to keep; None if it cannot import rclpy and numpy."""
    command = [python, "-c", PROBE, *KEPT_PACKAGES]
    answer = subprocess.run(command, env=dict(environment), capture_output=True, text=True)
    if answer.returncode:
        return None
    versions: dict[str, str] = json.loads(answer.stdout.splitlines()[-1])
    return {name: version for name, version in versions.items() if version}
