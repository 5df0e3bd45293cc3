"""Ctrl-C while the command is still starting."""

import os
import signal
import subprocess
import sys


def interrupted_before_it_began():
    """Leave a Ctrl-C waiting for the program that follows, as the launcher does."""
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    os.kill(os.getpid(), signal.SIGINT)


def test_a_ctrl_c_that_was_waiting_stops_it_without_a_traceback():
    command = [sys.executable, "-m", "pdr_bringup_scripts", "params"]
    answer = subprocess.run(command, preexec_fn=interrupted_before_it_began, capture_output=True, text=True, timeout=99)
    assert (answer.returncode, answer.stdout, answer.stderr) == (130, "", "pdr: stopped\n")
