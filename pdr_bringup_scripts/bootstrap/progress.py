"""What the set-up tells its user: a line a step with the time so far; the rest goes to a log."""

from __future__ import annotations

import os
import shlex
import signal
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path


class SetupError(Exception):
    """The set-up cannot go on; the text is one sentence for the user."""


class Progress:
    """Shows steps on standard error and runs programs with their output in the log."""

    def __init__(self, log: Path, lock: int) -> None:
        self.log = log
        self._lock = lock
        self._began = time.monotonic()

    def say(self, text: str) -> None:
        """Show one line with the time since the start."""
        print(f"pdr: {time.monotonic() - self._began:5.1f} s  {text}", file=sys.stderr, flush=True)

    def run(self, command: Sequence[str], environment: Mapping[str, str], failure: str) -> None:
        """Run a program to its end; if it fails, raise `failure` with the place of the log."""
        with self.log.open("a", encoding="utf-8") as log:
            print(f"\n$ {shlex.join(command)}", file=log, flush=True)
            child = self._start(command, environment, log.fileno())
            try:
                code = child.wait()
            except BaseException:
                _end(child)
                raise
        if code:
            raise SetupError(f"{failure} (details: {self.log})")

    def _start(self, command: Sequence[str], environment: Mapping[str, str], output: int) -> subprocess.Popen[bytes]:
        """Start a program in a group of its own; it holds the lock too, so it never outlives it."""
        try:
            return subprocess.Popen(
                command,
                env=dict(environment),
                cwd=self.log.parent,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
                pass_fds=[self._lock],
            )
        except OSError as error:
            raise SetupError(f"{command[0]} does not start: {error.strerror}") from error


def _end(child: subprocess.Popen[bytes]) -> None:
    """End a program and everything it started."""
    with suppress(ProcessLookupError, subprocess.TimeoutExpired):
        os.killpg(child.pid, signal.SIGTERM)
        child.wait(timeout=5)
    with suppress(ProcessLookupError):
        os.killpg(child.pid, signal.SIGKILL)
    child.wait()
