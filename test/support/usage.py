"""What a process has used so far, as Linux tells it."""

import os
from pathlib import Path
from typing import NamedTuple


class Usage(NamedTuple):
    """Of one process."""

    cpu_s: float  # since it began
    memory_mb: float  # resident now


def usage(pid: int) -> Usage:
    """Read /proc; FileNotFoundError where the process has ended."""
    after_name = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    user, system, pages = int(after_name[11]), int(after_name[12]), int(after_name[21])  # proc(5): fields 14, 15, 24
    return Usage((user + system) / os.sysconf("SC_CLK_TCK"), pages * os.sysconf("SC_PAGE_SIZE") / 1e6)
