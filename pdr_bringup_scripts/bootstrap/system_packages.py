"""What only the system can bring: a compiler, the headers of Python and its venv module."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Mapping

from bootstrap.progress import Progress, SetupError

PROBE = """
import importlib.util, os, sysconfig
header = os.path.join(sysconfig.get_path("include"), "Python.h")
print(int(importlib.util.find_spec("ensurepip") is not None), int(os.path.exists(header)))
"""


def missing(python: str, environment: Mapping[str, str]) -> list[str]:
    """Name the system packages that this Python and the build of messages still lack."""
    answer = subprocess.run([python, "-I", "-c", PROBE], capture_output=True, text=True)
    has_venv, has_headers = (answer.stdout.split() or ["0", "0"])[:2]
    stem = _package_stem(python)
    wanted = []
    if has_venv != "1":
        wanted.append(f"{stem}-venv")
    if has_headers != "1":
        wanted.append(f"{stem}-dev")
    if not has_compiler(environment):
        wanted.append("g++")
    return wanted


def has_compiler(environment: Mapping[str, str]) -> bool:
    """Tell whether a C and a C++ compiler are on PATH."""
    path = environment.get("PATH", os.defpath)
    candidates = (
        (environment.get("CC"), "cc", "gcc", "clang"),
        (environment.get("CXX"), "c++", "g++", "clang++"),
    )
    return all(any(shutil.which(name or "", path=path) for name in names) for names in candidates)


def install_command(packages: list[str]) -> str:
    """Give the command by which a user with sudo installs them."""
    return f"sudo apt-get install {' '.join(packages)}"


def ensure(python: str, environment: Mapping[str, str], progress: Progress) -> None:
    """Install what is missing if this is root on Debian or Ubuntu; otherwise say what to type."""
    packages = missing(python, environment)
    if not packages:
        return
    if os.geteuid() != 0 or not shutil.which("apt-get"):
        raise SetupError(f"the system lacks {', '.join(packages)}; install with: {install_command(packages)}")
    _install(packages, environment, progress)
    still = missing(python, environment)
    if still:
        raise SetupError(f"{python} still lacks {', '.join(still)}; use the system's python3")


def _install(packages: list[str], environment: Mapping[str, str], progress: Progress) -> None:
    """Let apt-get fetch its lists and install these packages."""
    progress.say(f"installing {', '.join(packages)} with apt-get")
    quiet = {**environment, "DEBIAN_FRONTEND": "noninteractive"}
    failure = f"apt-get could not install {', '.join(packages)}"
    progress.run(["apt-get", "update"], quiet, failure)
    options = ["install", "--yes", "--no-install-recommends"]
    progress.run(["apt-get", *options, *packages], quiet, failure)


def _package_stem(python: str) -> str:
    """Give `python3` for the system's own Python, else `python3.11` or the like."""
    real = os.path.realpath(python)
    name = os.path.basename(real)
    own = not real.startswith("/usr/bin/") or real == os.path.realpath("/usr/bin/python3")
    return "python3" if own or not name.startswith("python3.") else name
