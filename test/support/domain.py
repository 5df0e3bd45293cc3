"""A ROS domain that no other test session on this machine uses."""

import fcntl
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

DOMAINS = range(215, 232)  # above the ports that Linux gives to others, and above the domains of `pdr demo`


@contextmanager
def own_domain() -> Iterator[int]:
    """Hold the lock of the first domain that is free."""
    for domain in DOMAINS:
        with Path(tempfile.gettempdir(), f"pdr_test_domain_{domain}.lock").open("w") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                continue
            yield domain
            return
    raise RuntimeError("all ROS domains for tests are in use")
