"""Programs of the suite as processes of their own, which never outlive the test."""

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

NODES = ("imu_driver", "imu_ingestion", "stance_detector", "zupt_ekf")
END_S = 120.0


def start(arguments: list[str], log: Path) -> subprocess.Popen:
    """Start Python on these arguments; everything it says goes to the log."""
    with log.open("w") as file:
        return subprocess.Popen([sys.executable, *arguments], stdout=file, stderr=subprocess.STDOUT)


@contextmanager
def node_process(name: str, namespace: str, log: Path, **params: object) -> Iterator[subprocess.Popen]:
    """Run a node in a namespace while the block runs."""
    given = [part for key, value in params.items() for part in ("-p", f"{key.replace('__', '.', 1)}:={value}")]
    process = start(["-m", f"pdr_nodes.{name}_node", "--ros-args", "-r", f"__ns:=/{namespace}", *given], log)
    try:
        yield process
    finally:
        process.kill()
        process.wait(END_S)


def pdr(*arguments: object, cwd: Path | None = None, **environment: str) -> subprocess.CompletedProcess:
    """Run a `pdr` command to its end."""
    command = [sys.executable, "-m", "pdr_bringup_scripts", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, cwd=cwd, env=os.environ | environment, timeout=600)


def check_refused(answer: subprocess.CompletedProcess, *words: str) -> None:
    """Assert one sentence on stderr, exit code 2, nothing on stdout."""
    assert answer.stderr.startswith("pdr: ")
    assert answer.stderr.count("\n") == 1
    assert [word for word in words if word not in answer.stderr] == []
    assert (answer.returncode, answer.stdout) == (2, "")
