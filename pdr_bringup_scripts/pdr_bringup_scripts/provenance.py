"""Which version of the code made a result."""

import subprocess
from pathlib import Path

from pdr_core import __version__

VERSION = __version__


def commit() -> str:
    """Return the commit of the checkout, with a + where it has changes; empty outside of one."""
    here = Path(__file__).resolve().parent
    command = ["git", "-C", str(here), "describe", "--always", "--abbrev=12", "--dirty=+", "--exclude=*"]
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True, timeout=5).stdout.strip()
    except (OSError, subprocess.SubprocessError):
        return ""
