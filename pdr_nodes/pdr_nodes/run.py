"""Runs a node until it is done or interrupted, and ends cleanly."""

import signal
import sys
from collections.abc import Callable

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.experimental.events_executor import EventsExecutor
from rclpy.node import Node

from pdr_core.parameter import ParameterError
from pdr_core.recording import RecordingError


def run(make_node: Callable[[], Node]) -> None:
    """Make the node and spin it; a bad parameter or recording is one sentence and exit code 2, Ctrl-C is exit code 0.

    The events executor costs half of the others. It must be spun with a time-out: without one it cannot be stopped
    (rclpy 7.1). A node that has work of its own has a method `work`, which returns the time [s] until it wants to be
    called again, or None when it is done.
    """
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, shut_down)
    rclpy.init()
    code = 0
    try:
        spin(make_node())
    except (ParameterError, RecordingError) as error:
        print(f"pdr: {error}", file=sys.stderr)
        code = 2
    except (RuntimeError, ExternalShutdownException):
        if rclpy.ok():
            raise  # else the graph was shut down while something still wanted it
    finally:
        rclpy.try_shutdown()
    sys.exit(code)


def shut_down(*_: object) -> None:
    """Leave it to rclpy: its own handler shuts the graph down. A KeyboardInterrupt would come out of any callback."""


def spin(node: Node) -> None:
    """Serve callbacks, and the node's own work where it has some, until it is done."""
    executor = EventsExecutor()
    executor.add_node(node)
    work = getattr(node, "work", None)
    while rclpy.ok():
        wait_s = work() if work else 0.5
        if wait_s is None:
            return
        executor.spin_once(timeout_sec=wait_s)
