"""Starts the nodes of one sensor as separate processes, together, and ends them together."""

import os
import re
import signal
import subprocess
import sys
from collections.abc import Collection, Mapping
from pathlib import Path
from types import TracebackType

import yaml

from pdr_bringup_scripts.problems import Problem

NODES = ("imu_ingestion", "stance_detector", "zupt_ekf")
ADAPTIVE = ("imu_ingestion", "stance_detector", "gait_dr", "mode_manager")  # of a foot whose gyro is switched
ON_CHEST = ("imu_ingestion", "chest_pdr")  # of a card on the chest
DRIVER = "imu_driver"
QUICK_DISCOVERY = Path(__file__).with_name("fastdds_quick.xml")
GRACE_S = 5.0
NAMESPACE = "pdr"  # of our topics, so that nobody else's `odom` is taken for ours


class Chain:
    """A context manager: the processes run in a namespace while the block does. Their output goes to `folder`."""

    def __init__(
        self,
        folder: Path,
        parameters: dict[str, dict[str, object]],
        namespace: str,
        nodes: tuple[str, ...] = (*NODES, DRIVER),
        remapped: Mapping[str, Mapping[str, str]] | None = None,  # {node: {topic: its other name}}
        kept: Collection[str] = (),  # the nodes that are started again when somebody kills them
    ) -> None:
        self._folder = folder
        self.namespace = namespace
        self._nodes = nodes
        self._remapped = remapped or {}
        self._kept = kept
        self.restarts = 0
        self._parameters = folder / "parameters.yaml"
        self._content = {"/**": {"ros__parameters": parameters}}
        self._processes: dict[str, subprocess.Popen] = {}

    def __enter__(self) -> "Chain":
        """Start all nodes at once: so they find each other within a moment."""
        self._folder.mkdir(parents=True, exist_ok=True)
        self._parameters.write_text(yaml.safe_dump(self._content, sort_keys=False))
        for name in self._nodes:
            self._processes[name] = self._start(name)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """End them as Ctrl-C would."""
        self.interrupt()
        for process in self._processes.values():
            end(process)

    def interrupt(self) -> None:
        """Ask all to end."""
        for process in self._processes.values():
            if process.poll() is None:
                process.send_signal(signal.SIGINT)

    @property
    def has_driver(self) -> bool:
        """A driver was started with the others."""
        return DRIVER in self._processes

    @property
    def driver_is_done(self) -> bool:
        """A driver was started, has delivered everything and ended."""
        return self.has_driver and self._processes[DRIVER].poll() == 0

    @property
    def pids(self) -> dict[str, int]:
        """The process of each node."""
        return {name: process.pid for name, process in self._processes.items()}

    def check(self) -> None:
        """Start a node again that somebody has killed, if it is to be kept; raise a Problem if another one has died."""
        for name, process in self._processes.items():
            if process.poll() in (None, 0):
                continue
            if name in self._kept and process.returncode < 0:  # by a signal
                self._processes[name] = self._start(name)
                self.restarts += 1
            else:
                raise Problem(f"{name} has failed: {self._last_words(name)}")

    def _start(self, name: str) -> subprocess.Popen:
        command = [sys.executable, "-m", f"pdr_nodes.{name}_node", "--ros-args"]
        command += ["--params-file", str(self._parameters), "--log-level", "warn"]
        names = {"__ns": f"/{self.namespace}", **self._remapped.get(name, {})}
        command += [part for topic, other in names.items() for part in ("-r", f"{topic}:={other}")]
        with (self._folder / f"{name}.log").open("w") as log:  # Ctrl-C is for us: the nodes end in order
            return subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT, start_new_session=True)

    def _last_words(self, name: str) -> str:
        lines = (self._folder / f"{name}.log").read_text().strip().splitlines()
        return lines[-1].removeprefix("pdr: ") if lines else f"see {self._folder}"


def end(process: subprocess.Popen) -> None:
    """Wait for a process that was asked to end; if it does not, kill it."""
    try:
        process.wait(GRACE_S)
    except subprocess.TimeoutExpired:
        process.kill()


def stay_on_this_machine(logs: Path, domain: int | None) -> None:
    """Set the environment of this process and its children; what the user has set himself stays as it is."""
    os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    os.environ.setdefault("ROS_LOG_DIR", str(logs))
    os.environ.setdefault("FASTRTPS_DEFAULT_PROFILES_FILE", str(QUICK_DISCOVERY))
    if domain is not None:
        os.environ.setdefault("ROS_DOMAIN_ID", str(domain))


def private_domain() -> int:
    """Return a ROS domain that other runs on this machine hardly use."""
    return 1 + os.getpid() % 100


def checked_namespace(name: str) -> str:
    """Return a namespace without its slashes; Problem if ROS does not allow it."""
    inner = name.strip("/")
    if not re.fullmatch(r"[A-Za-z_]\w*(/[A-Za-z_]\w*)*", inner, re.ASCII):
        raise Problem(f"--namespace {name!r} is no namespace of ROS; it looks like left_foot")
    return inner
