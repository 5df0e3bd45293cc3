"""Runs the nodes on a device, records what they say, and judges the recording."""

import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path
from shutil import rmtree
from typing import Any

from pdr_bringup_scripts.book import Book, make_folder
from pdr_bringup_scripts.chain import NAMESPACE, Chain, stay_on_this_machine
from pdr_bringup_scripts.listener import STATUS_TOPICS, Ears, bag_writer, message
from pdr_bringup_scripts.live_recording import notices, outputs
from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.terminal import Terminal
from pdr_core.evaluation.result import Result
from pdr_core.params import Params, params_as_mapping
from pdr_core.recording import Sensor, open_recording
from pdr_core.recording.bag_writer import BagWriter
from pdr_core.records import length
from pdr_core.simulation import walk_duration_s
from pdr_core.warmup import warm_up
from pdr_nodes.convert import stamp_ns

PIPELINE = "foot_inertial, live"
BAG = "recording"
LISTENERS = 2  # of the driver's samples: ingestion and the recording
AFTERWARDS_S = 1.5  # beyond the time after which the nodes give out what waits
NOTHING_S = 30.0
FIELD_WAIT_S = 10.0  # the longest
FIELD_IDLE_S = 4.0  # on a busy machine one of two topics may lag behind the other by more than the usual second
IDLE_MAX_S = 10.0
SHOW_EVERY = 20  # odometry messages
SAMPLES = "/imu/data_raw"  # in the recording


def live_run(
    params: Params,
    out: Path,
    domain: int | None,
    terminal: Terminal,
    source: Sensor | None = None,
    namespace: str = NAMESPACE,
) -> Result:
    """Run driver, ingestion, stance detection and filter as processes until the device ends; fill the folder `out`.

    The truth is that of `source`, the sensor that is replayed, or what the driver said of it.
    """
    make_run_folder(out)
    params = for_one_run(params)
    warm_up(params)  # so that the nodes need not compile, each for itself
    begin = time.monotonic()
    stay_on_this_machine(out / "nodes", domain)
    record(params, out, namespace, terminal)
    return judge(params, out, time.monotonic() - begin, source, namespace)


def make_run_folder(out: Path) -> None:
    """Create the folder of a run; Problem if it holds the recording of another."""
    if (out / BAG).exists():
        raise Problem(f"{out / BAG} exists already: choose another folder by --out, or remove it")
    make_folder(out)


@contextmanager
def new_recording(path: Path) -> Iterator[BagWriter]:
    """Write a bag while the block runs; one without a sample does not stay."""
    bag = bag_writer(path)
    try:
        with bag:
            yield bag
    finally:
        if SAMPLES not in bag.topics:
            rmtree(path, ignore_errors=True)


def for_one_run(params: Params) -> Params:
    """Return the parameters of a run whose nodes are all ours, in which all is waited for, however long it takes.

    Played slowly, a stream is idle after a longer time. Our driver says of each sample whether it has a field.
    """
    slowness = max(1.0, 1.0 / params.driver.rate_factor) if params.driver.rate_factor else 1.0
    least_s = FIELD_IDLE_S if params.node.magnetometer else 0.0
    idle_s = min(max(params.node.idle_s, least_s) * slowness, IDLE_MAX_S)
    node = replace(params.node, input_reliable=True, autostart=True, idle_s=idle_s, answer_timeout_s=0.0)
    node = replace(node, field_wait_s=FIELD_WAIT_S)
    return replace(params, node=node, driver=replace(params.driver, subscribers=LISTENERS))


def record(params: Params, out: Path, namespace: str, terminal: Terminal) -> None:
    """Run the nodes and write all they say to a bag."""
    with ExitStack() as stack:
        show = stack.enter_context(terminal.progress("Walking"))
        bag = stack.enter_context(new_recording(out / BAG))
        watch = Watch(bag.write, show, total(params))
        ears = stack.enter_context(Ears(watch.take, namespace))
        chain = stack.enter_context(Chain(out / "nodes", params_as_mapping(params), namespace))
        while not (chain.driver_is_done and watch.quiet_s > quiet_for_good_s(params)):
            ears.listen(0.1)
            chain.check()
            if watch.quiet_s > NOTHING_S:
                raise Problem(f"nothing has come from the nodes for {NOTHING_S:.0f} s; see {out / 'nodes'}")


def quiet_for_good_s(params: Params) -> float:
    """Return the silence [s] after which nothing more comes: the nodes have given out what waited."""
    return 2.0 * params.node.idle_s + AFTERWARDS_S


class Watch:
    """Passes every message on to the recording and shows where the foot is."""

    def __init__(self, write: Callable[[str, str, int, bytes], None], show: Callable[[str], None], of: str) -> None:
        self._write = write
        self._show = show
        self._of = of
        self._first_ns: int | None = None
        self._last_s = time.monotonic()
        self._odometry = 0
        self._steps = 0

    @property
    def quiet_s(self) -> float:
        """How long ago [s] the last message came."""
        return time.monotonic() - self._last_s

    def take(self, topic: str, name: str, cdr: bytes) -> None:
        """Take one message."""
        self._write(f"/{topic}", name, time.time_ns(), cdr)
        if topic not in STATUS_TOPICS:
            self._last_s = time.monotonic()
        self._steps += topic == "step"
        self._odometry += topic == "odom"
        if topic == "odom" and self._odometry % SHOW_EVERY == 0:
            self._show_estimate(message(name, cdr))

    def _show_estimate(self, odometry: Any) -> None:
        now_ns, p = stamp_ns(odometry.header.stamp), odometry.pose.pose.position
        self._first_ns = now_ns if self._first_ns is None else self._first_ns
        passed_s = (now_ns - self._first_ns) * 1e-9
        place = f"x {p.x:+.2f} m, y {p.y:+.2f} m, height {p.z:+.2f} m"
        self._show(f"{passed_s:.0f}{self._of} s, {self._steps} strides, now at {place}")


def total(params: Params) -> str:
    """Return how long the walk will take, as far as that is known before."""
    if params.driver.device != "simulated":
        return ""
    return f" of {walk_duration_s(params.simulation):.0f}"


def judge(params: Params, out: Path, seconds: float, source: Sensor | None, namespace: str) -> Result:
    """Compare what the nodes said with the truth, and write the files of the run."""
    session = open_recording(out / BAG)
    (sensor,) = session.sensors.values()
    with ExitStack() as stack:
        book = Book(session, source or sensor, out, stack)
        for output in outputs(out / BAG, params.node.odom_rate_hz):
            book.keep(output)
        samples = sum(length(piece) for piece in sensor.pieces())
        return book.close(PIPELINE, params, samples, seconds, notices(out / BAG, namespace))
