"""The message packages: built with colcon and installed into the environment."""

from __future__ import annotations

import shutil
from collections.abc import Iterable, Mapping
from pathlib import Path

from bootstrap import tf2_msgs
from bootstrap.layout import Layout
from bootstrap.progress import Progress


def build(layout: Layout, environment: Mapping[str, str], progress: Progress) -> None:
    """Build our messages, and tf2_msgs where the environment has none, from nothing."""
    _remove_old(layout)
    sources = [layout.messages]
    if not tf2_msgs.provided(environment, layout):
        tf2_msgs.generate(layout)
        sources.append(layout.generated)
    command = _colcon_command(layout, sources, environment)
    failure = "the messages in pdr_msgs could not be built"
    progress.run(command, _build_environment(environment), failure)


def source_files(layout: Layout) -> list[Path]:
    """List the files that the messages are made from."""
    patterns = ("msg/*.msg", "srv/*.srv", "package.xml", "CMakeLists.txt", "cmake/*.cmake")
    return [path for pattern in patterns for path in layout.messages.glob(pattern)]


def built_files(layout: Layout) -> list[Path]:
    """List the files whose presence says that the messages are built."""
    packages = ["pdr_msgs"] + (["tf2_msgs"] if tf2_msgs.installed(layout) else [])
    libraries = [layout.venv / "lib" / f"lib{name}__rosidl_generator_py.so" for name in packages]
    modules = [layout.site_packages / name / "msg" / "__init__.py" for name in packages]
    return libraries + modules


def _colcon_command(layout: Layout, sources: list[Path], environment: Mapping[str, str]) -> list[str]:
    """Give the command that builds these packages into the environment."""
    colcon = shutil.which("colcon", path=environment["PATH"]) or "colcon"
    fix = layout.messages / "cmake" / "pypi_ros_fix.cmake"
    return [
        *(colcon, "--log-base", str(layout.build / "log"), "build"),
        *("--base-paths", *map(str, sources)),
        *("--build-base", str(layout.build)),
        *("--merge-install", "--install-base", str(layout.venv)),
        *("--cmake-args", f"-DCMAKE_PROJECT_INCLUDE={fix}", "-DBUILD_TESTING=OFF"),
        f"-DPython3_EXECUTABLE={layout.python}",
    ]


def _build_environment(environment: Mapping[str, str]) -> dict[str, str]:
    """Add the build program: Ninja where it is, else what CMake chooses."""
    has_ninja = shutil.which("ninja", path=environment["PATH"])
    return {**environment, **({"CMAKE_GENERATOR": "Ninja"} if has_ninja else {})}


def _remove_old(layout: Layout) -> None:
    """Remove what an earlier build left, so that a deleted message is gone."""
    ours = ["pdr_msgs"] + (["tf2_msgs"] if tf2_msgs.installed(layout) else [])
    for name in ours:
        for pattern in (f"lib/lib{name}__*", f"share/{name}", f"include/{name}"):
            _remove(layout.venv.glob(pattern))
        _remove(layout.site_packages.glob(f"{name}*"))
    _remove([layout.build])
    layout.build.mkdir()


def _remove(paths: Iterable[Path]) -> None:
    """Remove files and folders."""
    for path in list(paths):
        if path.is_dir():
            shutil.rmtree(path)
        elif path.exists():
            path.unlink()
