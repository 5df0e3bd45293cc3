"""The virtual environment: made anew, filled with pinned packages, pointed at our sources."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Mapping
from pathlib import Path

from bootstrap.layout import SOURCE_PACKAGES, Layout
from bootstrap.progress import Progress, SetupError
from bootstrap.ros import SourcedRos


def base_python() -> str:
    """Give the interpreter that started us, or the one behind it if it is itself a venv's."""
    return str(getattr(sys, "_base_executable", "") or sys.executable)


def clear(layout: Layout) -> None:
    """Remove whatever is left of an earlier environment and lay an empty folder in its place."""
    try:
        if layout.venv.is_symlink():
            layout.venv.unlink()
        elif layout.venv.exists():
            shutil.rmtree(layout.venv)
        layout.venv.mkdir()
        (layout.venv / "COLCON_IGNORE").touch()
    except OSError as error:
        raise SetupError(f"{layout.venv} cannot be made anew: {error.strerror}") from error


def create(layout: Layout, ros: SourcedRos | None, environment: Mapping[str, str], progress: Progress) -> None:
    """Make the environment: beside the sourced ROS if there is one, else on its own."""
    if ros:
        command = [ros.python, "-m", "venv", "--system-site-packages", str(layout.venv)]
    else:
        command = [base_python(), "-m", "venv", str(layout.venv)]
    progress.run(command, environment, "the Python environment could not be made")


def install(layout: Layout, ros: SourcedRos | None, environment: Mapping[str, str], progress: Progress) -> None:
    """Install the pinned packages and make our own importable from their sources."""
    listed = layout.venv / "requirements.txt"
    listed.write_text(requirements(layout, ros, environment), encoding="utf-8")
    options = ["--no-input", "--no-deps", "-r", str(listed)]
    command = [str(layout.python), "-m", "pip", "install", *options]
    failure = "pip could not install the Python packages; is the network there?"
    progress.run(command, {**environment, "PIP_USER": "0"}, failure)
    _point_at_sources(layout)


def requirements(layout: Layout, ros: SourcedRos | None, environment: Mapping[str, str]) -> str:
    """Give every package with its version; what a sourced ROS was built with keeps its own."""
    kinds = ["pdr"]
    if not ros:
        kinds.append("ros")
    if not ros or not _has_build_tools(environment):
        kinds.append("build")
    pins: dict[str, str] = {}
    for kind in kinds:
        text = (layout.bootstrap / f"requirements-{kind}.txt").read_text(encoding="utf-8")
        for line in text.splitlines():
            name, is_pin, version = line.partition("==")
            if is_pin:
                pins[name] = version
    pins.update(ros.kept if ros else {})
    return "".join(f"{name}=={version}\n" for name, version in pins.items())


def _has_build_tools(environment: Mapping[str, str]) -> bool:
    """Tell whether the sourced ROS brings colcon and CMake along."""
    return all(shutil.which(tool, path=environment["PATH"]) for tool in ("colcon", "cmake", "make"))


def _point_at_sources(layout: Layout) -> None:
    """Put our source folders on the module path, so that an edit needs no new installation."""
    folders = [str(Path(layout.checkout, name)) for name in SOURCE_PACKAGES]
    pointer = layout.site_packages / "pdr_sources.pth"
    pointer.write_text("\n".join(folders) + "\n", encoding="utf-8")
