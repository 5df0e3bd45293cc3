"""What happens at every call: a look at the stamp, a set-up if it is needed, and off."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from typing import NoReturn

from bootstrap import stamp
from bootstrap.environment import launch_environment
from bootstrap.layout import Layout, this_checkout
from bootstrap.progress import SetupError


def main(arguments: list[str]) -> NoReturn:
    """Become `python -m pdr_bringup_scripts` inside the environment, after making it if need be."""
    layout = this_checkout()
    try:
        _prepare(layout)
        _become(layout, arguments)
    except SetupError as error:
        sys.exit(_complain(f"pdr: {error}.", 2))
    except KeyboardInterrupt:
        sys.exit(_complain("\npdr: interrupted; the next call takes it up again.", 130))


def _prepare(layout: Layout) -> None:
    """Set up what the stamp says is missing, or everything if Python itself does not start."""
    scope, _ = stamp.judge(layout, os.environ)
    if not scope and not _starts(layout):
        layout.stamp.unlink()
        scope = stamp.EVERYTHING
    if scope:
        from bootstrap.set_up import set_up

        try:
            set_up(layout, os.environ)
        except OSError as error:
            raise SetupError(f"the set-up failed: {error} (details: {layout.log})") from error


def _starts(layout: Layout) -> bool:
    """Tell whether the environment's Python starts at all; costs about 10 ms."""
    command = [str(layout.python), "-I", "-S", "-c", ""]
    try:
        return subprocess.run(command, capture_output=True).returncode == 0
    except OSError:
        return False


def _become(layout: Layout, arguments: list[str]) -> NoReturn:
    """Replace this process by the command proper; a Ctrl-C waits until that can answer it."""
    sourced = bool(stamp.read(layout)["sourced"])
    environment = launch_environment(os.environ, layout, sourced)
    command = [str(layout.python), "-m", "pdr_bringup_scripts", *arguments]
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    os.execve(layout.python, command, environment)


def _complain(text: str, code: int) -> int:
    """Tell the user why there is no result."""
    print(text, file=sys.stderr)
    return code
