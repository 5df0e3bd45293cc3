"""`pdr live` on drivers of somebody else, until Ctrl-C."""

import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path

from support import foreign_driver
from support.processes import END_S, start

ANSWER_S = 300.0  # nodes may still be starting, and wait for each other
HEARD_S = 0.5  # what was published last is on its way
PATIENT = "/**: {ros__parameters: {node: {answer_timeout_s: 0.0, field_wait_s: 10.0, idle_s: 3.0}}}"


def live_until_done(folder: Path, drivers: Sequence[tuple[object, ...]], *arguments: object) -> tuple[int, str, str]:
    """Start the drivers, each with its arguments, and `pdr live` into `out`; press Ctrl-C when they have said all.

    Returns the exit code, what was said and what was complained of.
    """
    command = [sys.executable, "-m", "pdr_bringup_scripts", "live", *map(str, arguments), "--out", str(folder / "out")]
    logs = [folder / f"driver_{number}.log" for number in range(len(drivers))]
    with ExitStack() as stack:
        for driver, log in zip(drivers, logs, strict=True):
            stack.callback(ended, start([foreign_driver.__file__, *map(str, driver)], log))
        live = subprocess.Popen(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        stack.callback(ended, live)
        wait_for(logs, live)
        time.sleep(HEARD_S)
        live.send_signal(signal.SIGINT)
        said, complained = live.communicate(timeout=ANSWER_S)
    return live.returncode, said, complained


def patience(folder: Path) -> tuple[str, Path]:
    """Return arguments by which a foot, its field or its driver that a busy machine holds up is waited for."""
    (folder / "patient.yaml").write_text(PATIENT)
    return "--params", folder / "patient.yaml"


def ended(process: subprocess.Popen) -> None:
    """End a process."""
    process.kill()
    process.wait(END_S)


def wait_for(logs: Sequence[Path], live: subprocess.Popen) -> None:
    """Wait until every driver has published everything."""
    deadline_s = time.monotonic() + END_S
    while not all("done" in log.read_text() for log in logs):
        assert time.monotonic() < deadline_s, [log.read_text() for log in logs]
        assert live.poll() is None, "pdr live ended before the drivers"
        time.sleep(0.1)
