"""The whole set-up, in the order in which it happens."""

from __future__ import annotations

import fcntl
import os
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from bootstrap import messages, python_packages, ros, stamp, system_packages
from bootstrap.environment import clean_environment, launch_environment
from bootstrap.layout import Layout
from bootstrap.progress import Progress, SetupError

FIRST_IMPORTS = (
    "numba, scipy.linalg, scipy.signal, scipy.spatial.transform, rosbags.highlevel, mcap.reader, "
    "yaml, jinja2, plotly.graph_objects, typer, rich.console, rich.table, pytest, hypothesis, "
    "rclpy.node, rclpy.experimental.events_executor, sensor_msgs.msg, nav_msgs.msg"
)


def set_up(layout: Layout, inherited: Mapping[str, str]) -> None:
    """Make what is missing; two calls at the same time take turns, and the second finds it made."""
    with _lock(layout) as lock:
        scope, reason = stamp.judge(layout, inherited)
        if not scope:
            return
        progress = Progress(layout.log, lock)
        progress.say(f"setting up: {reason}; takes two or three minutes, details in {layout.log}")
        if scope == stamp.EVERYTHING:
            _make_environment(layout, inherited, progress)
        _make_messages(layout, inherited, progress)
        _warm_up(layout, inherited, progress)
        progress.say("ready")


def _make_environment(layout: Layout, inherited: Mapping[str, str], progress: Progress) -> None:
    """Make the environment with everything from elsewhere in it."""
    python_packages.clear(layout)
    found = ros.find_sourced(inherited, layout)
    clean = clean_environment(inherited, layout)
    python = found.python if found else python_packages.base_python()
    system_packages.ensure(python, clean, progress)
    which = f"the one sourced from {found.prefix}" if found else "its wheels (none is sourced)"
    progress.say(f"making the Python environment; ROS 2 Jazzy: {which}")
    now = stamp.wanted(layout, inherited)
    python_packages.create(layout, found, clean, progress)
    progress.say("downloading and installing Python packages")
    python_packages.install(layout, found, clean, progress)
    _try_imports(layout, launch_environment(inherited, layout, found is not None), progress)
    stamp.write_environment(layout, now, sourced=found is not None)


def _try_imports(layout: Layout, environment: Mapping[str, str], progress: Progress) -> None:
    """Import what is used first: proves that it loads, and compiles it for later starts."""
    progress.say("trying what was installed")
    command = [str(layout.python), "-c", f"import {FIRST_IMPORTS}"]
    progress.run(command, environment, "the installed Python packages do not load")


def _make_messages(layout: Layout, inherited: Mapping[str, str], progress: Progress) -> None:
    """Build the message packages into the environment."""
    progress.say("building the ROS messages")
    now = stamp.wanted(layout, inherited)
    messages.build(layout, _environment(layout, inherited), progress)
    stamp.write_messages(layout, now)


def _warm_up(layout: Layout, inherited: Mapping[str, str], progress: Progress) -> None:
    """Compile the numeric functions now, so that the first run does not wait for it."""
    if not (layout.checkout / "pdr_core" / "pdr_core" / "warmup.py").exists():
        return
    progress.say("compiling the numeric functions")
    command = [str(layout.python), "-m", "pdr_core.warmup"]
    try:
        progress.run(command, _environment(layout, inherited), "they do not compile")
    except SetupError as error:  # the command itself will say what is wrong with them
        progress.say(str(error))


def _environment(layout: Layout, inherited: Mapping[str, str]) -> dict[str, str]:
    """Give the environment the finished set-up runs in."""
    return launch_environment(inherited, layout, bool(stamp.read(layout)["sourced"]))


@contextmanager
def _lock(layout: Layout) -> Iterator[int]:
    """Hold the checkout's lock; the programs we start hold it too, so orphans are waited for."""
    descriptor = os.open(layout.bootstrap, os.O_RDONLY)
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            print("pdr: another set-up is running; waiting for it", file=sys.stderr, flush=True)
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield descriptor
    finally:
        os.close(descriptor)
