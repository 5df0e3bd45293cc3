"""Runs a node until it is done or interrupted, and ends cleanly."""

import signal
import sys
from collections.abc import Callable

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.experimental.events_executor import EventsExecutor

from pdr_core.parameter import ParameterError
from pdr_core.recording import RecordingError
from pdr_nodes.managed import ManagedNode


def run(make_node: Callable[[], ManagedNode]) -> None:
    """Make the node, start it and spin it. A bad parameter or recording is one sentence and exit code 2; Ctrl-C is 0.

    The events executor costs half of the others. It must be spun with a time-out: without one it cannot be stopped
    (rclpy 7.1).
    """
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, shut_down)
    rclpy.init()
    code = 0
    try:
        node = make_node()
        node.start()
        spin(node)
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


def spin(node: ManagedNode) -> None:
    """Serve callbacks, and the node's own work, until it is done or shut down."""
    executor = EventsExecutor()
    executor.add_node(node)
    while rclpy.ok() and node.state != "finalized":
        wait_s = node.work()
        if wait_s is None:
            return
        executor.spin_once(timeout_sec=wait_s)
