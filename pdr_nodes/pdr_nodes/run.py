"""Runs a node until it is done or interrupted, and ends cleanly."""

import signal
import sys
from collections.abc import Callable

import rclpy
from rclpy.executors import Executor
from rclpy.experimental.events_executor import EventsExecutor
from rclpy.signals import SignalHandlerOptions

from pdr_core.parameter import ParameterError
from pdr_core.recording import RecordingError
from pdr_nodes.managed import ManagedNode

BLOCK = 200  # messages; with more, the stage is served first


def run(make_node: Callable[[], ManagedNode]) -> None:
    """Make the node, start it and spin it. A bad parameter or recording is one sentence and exit code 2; Ctrl-C is 0.

    A signal is looked at between two callbacks. rclpy's own handler would shut the graph down in the middle of one.
    """
    signals: list[int] = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda number, _frame: signals.append(number))
    begin()
    code = 0
    try:
        node = make_node()
        node.start()
        spin(node, lambda: not signals)
        node.take_leave()
    except (ParameterError, RecordingError) as error:
        print(f"pdr: {error}", file=sys.stderr)
        code = 2
    finally:
        rclpy.shutdown()
    sys.exit(code)


def begin() -> None:
    """Read what ROS was told on the command line; a file of parameters that is no YAML is one sentence too."""
    try:
        rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    except RuntimeError as error:
        print(f"pdr: {error}", file=sys.stderr)
        sys.exit(2)


def spin(node: ManagedNode, wanted: Callable[[], bool]) -> None:
    """Serve callbacks, and the node's own work, until it is done or not wanted any more.

    The events executor costs half of the others. It must be spun with a time-out: without one it cannot be stopped
    (rclpy 7.1).
    """
    executor = EventsExecutor()
    executor.add_node(node)
    while wanted() and node.state != "finalized":
        wait_s = node.work()
        if wait_s is None:
            return
        serve(executor, node, wait_s)


def serve(executor: Executor, node: ManagedNode, within_s: float) -> None:
    """Serve the next callback. Where it brings a message, serve what waits behind it too: so all are one block."""
    executor.spin_once(timeout_sec=within_s)
    before = 0
    while before < node.waiting < BLOCK:
        before = node.waiting
        executor.spin_once(timeout_sec=0.0)
    node.take_waiting()
