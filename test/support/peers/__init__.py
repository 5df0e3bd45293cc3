"""Other people's packages to be compared with in a benchmark, in environments of their own that may be thrown away."""

import os
import subprocess
import sys
from pathlib import Path

NOT_FOR_OTHERS = ("_ROS_WHEELS_BOOTSTRAP_COMPLETE", "LD_LIBRARY_PATH", "PYTHONPATH", "AMENT_PREFIX_PATH", "VIRTUAL_ENV")
ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS"), "1")
HERE = Path(__file__).parent
INSTALL = ("-m", "pip", "install", "--only-binary", ":all:", "--retries", "1", "--requirement")
LIMIT_S = 600


class PeerError(Exception):
    """The peer cannot be installed here; the text says why."""


def peer_python(name: str) -> Path:
    """Return the Python of an environment with `<name>.txt` installed; it is made at the first call, in the cache."""
    requirements = HERE / f"{name}.txt"
    version = f"python{sys.version_info.major}.{sys.version_info.minor}"
    cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    folder = cache / "pdr" / "peers" / f"{name}-{version}"
    python, made_from = folder / "bin" / "python", folder / "made_from.txt"
    if not (made_from.is_file() and made_from.read_text() == requirements.read_text()):
        installed(Path(sys.base_prefix) / "bin" / version, "-m", "venv", "--clear", folder)
        installed(python, *INSTALL, requirements)
        made_from.write_text(requirements.read_text())
    return python


def installed(*command: object) -> None:
    """Run a command of the installation; PeerError if it fails."""
    run = outside(*command)
    if run.returncode != 0:
        raise PeerError(reason(run))


def peer_output(python: Path, name: str, *arguments: object) -> str:
    """Run `<name>.py` in the peer's environment and return what it prints; RuntimeError if it fails."""
    run = outside(python, HERE / f"{name}.py", *arguments)
    if run.returncode != 0:
        raise RuntimeError(f"{name}: {run.stderr}")
    return run.stdout


def outside(*command: object) -> subprocess.CompletedProcess:
    """Run a program to its end, in one thread and without anything of our own environment."""
    environment = {key: value for key, value in os.environ.items() if key not in NOT_FOR_OTHERS} | ONE_THREAD
    arguments = [str(part) for part in command]
    return subprocess.run(arguments, env=environment, capture_output=True, text=True, timeout=LIMIT_S)


def reason(run: subprocess.CompletedProcess) -> str:
    """Return the sentence in which a program says why it has failed."""
    lines = (run.stderr + run.stdout).strip().splitlines() or ["no word"]
    return next((line for line in lines if line.startswith("ERROR:")), lines[-1])
