"""Runs the nodes on devices, records what they say, and judges the recording."""

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path
from shutil import rmtree
from typing import Any

from pdr_bringup_scripts.live.cast import Cast, below
from pdr_bringup_scripts.live.chain import NAMESPACE, stay_on_this_machine
from pdr_bringup_scripts.live.chains import Chains
from pdr_bringup_scripts.live.judging import BAG, judge
from pdr_bringup_scripts.live.listener import Ears, bag_writer, is_status, message
from pdr_bringup_scripts.live.owed import Owed
from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.run.track_book import make_folder
from pdr_bringup_scripts.terminal import Terminal
from pdr_core.evaluation.result import Result, SensorsResult
from pdr_core.params import Params
from pdr_core.recording import Sensor
from pdr_core.recording.bag_writer import BagWriter
from pdr_core.simulation import walk_duration_s
from pdr_core.warmup import warm_up
from pdr_nodes.convert import stamp_ns

LISTENERS = 2  # of the driver's samples: ingestion and the recording
AFTERWARDS_S = 1.5  # for the last words of nodes that were asked to end
IDLE_TIMES = 3.0  # of `node.idle_s`: after twice that the last node gives out what waits, once it has looked twice
MARGIN_S = 0.5
NOTHING_S = 30.0
START_S = 60.0  # of the nodes, before their silence counts: two feet took 16 s where ten programs wanted two cores
FIELD_WAIT_S = 10.0  # the longest
FIELD_IDLE_S = 4.0  # on a busy machine one of two topics may lag behind the other by more than the usual second
FEET_IDLE_S = 2.0  # for the same reason, of two feet
IDLE_MAX_S = 10.0
SHOW_EVERY = 20  # odometry messages
DRIVEN = "imu/data_raw"  # where the driver of each sensor publishes
SAMPLES = f"/{DRIVEN}"  # how these topics end in the recording


def live_run(
    cast: Cast,
    out: Path,
    domain: int | None,
    terminal: Terminal,
    sources: Mapping[str, Sensor] | None = None,
    namespace: str = NAMESPACE,
) -> Result | SensorsResult:
    """Run all nodes as processes until the devices end; fill the folder `out`.

    The truth is that of `sources`, the sensors that are replayed, by foot, or what the drivers said of it.
    """
    make_run_folder(out)
    cast = cast.with_params(for_one_run).that_begins_together(namespace)
    for params in cast.feet.values():  # so that the nodes need not compile, each for itself
        warm_up(params, both=bool(cast.person), adaptive=cast.adaptive)
    begin = time.monotonic()
    stay_on_this_machine(out / "nodes", domain)
    restarts = record(cast, out, namespace, terminal)
    return judge(cast, out, time.monotonic() - begin, sources or {}, namespace, restarts)


def make_run_folder(out: Path) -> None:
    """Create the folder of a run; Problem if it holds the recording of another."""
    if (out / BAG).exists():
        raise Problem(f"{out / BAG} exists already: choose another folder by --out, or remove it")
    make_folder(out)


@contextmanager
def new_recording(path: Path) -> Iterator[BagWriter]:
    """Write a bag while the block runs, whole whatever fails there; one without a sample does not stay."""
    end = ExitStack()
    bag = end.enter_context(bag_writer(path))
    try:
        yield bag
    finally:
        end.close()  # without the error: with it the last minutes would be lost
        if not any(topic.endswith(SAMPLES) for topic in bag.topics):
            rmtree(path, ignore_errors=True)


def for_one_run(params: Params) -> Params:
    """Return the parameters of a run whose nodes are all ours, in which all is waited for, however long it takes.

    Played slowly, a stream is idle after a longer time. Our driver says of each sample whether it has a field.
    """
    slowness = max(1.0, 1.0 / params.driver.rate_factor) if params.driver.rate_factor else 1.0
    least_s = max(FIELD_IDLE_S * params.node.magnetometer, FEET_IDLE_S * params.filter.heading_feedback)
    idle_s = min(max(params.node.idle_s, least_s) * slowness, IDLE_MAX_S)
    node = replace(params.node, input_reliable=True, autostart=True, idle_s=idle_s, answer_timeout_s=0.0)
    node = replace(node, field_wait_s=FIELD_WAIT_S, ends_with=DRIVEN)  # a driver that is held up has not ended
    return replace(params, node=node, driver=replace(params.driver, subscribers=LISTENERS))


def record(cast: Cast, out: Path, namespace: str, terminal: Terminal) -> int:
    """Run the nodes and write all they say to a bag; return how often one was killed and started again."""
    params = next(iter(cast.feet.values()))
    with ExitStack() as stack:
        show = stack.enter_context(terminal.progress("Walking"))
        bag = stack.enter_context(new_recording(out / BAG))
        both = cast.feet if len(cast.feet) > 1 else {}
        watch = Watch(bag.write, show, total(params), both)
        ears = stack.enter_context(Ears(watch.take, namespace, cast.topics))
        chains = stack.enter_context(cast.chains(out / "nodes", namespace, driver=True))
        listen_until_quiet(ears, chains, watch, quiet_for_good_s(cast), out)
        if both:
            homes = {foot: below(namespace, foot) for foot in both}
            if waits := watch.owed.by:  # for the other foot, which has ended before it
                chains.end([home for foot, home in homes.items() if foot not in waits])
                listen_until_quiet(ears, chains, watch, quiet_for_good_s(cast), out)
            chains.end(homes.values())
            listen_for(ears, AFTERWARDS_S)
        return chains.restarts


def listen_until_quiet(ears: Ears, chains: Chains, watch: "Watch", quiet_s: float, out: Path) -> None:
    """Hear what the nodes say, until the drivers are done and nothing has come for a while since."""
    too_long_s = max(NOTHING_S, 2.0 * quiet_s)  # two feet that are played slowly are quiet for as long when all is well
    done = False
    while not (done and watch.quiet_s > quiet_s):
        ears.listen(0.1)
        chains.check()
        if watch.quiet_s > too_long_s:
            raise Problem(f"nothing has come from the nodes for {too_long_s:.0f} s; see {out / 'nodes'}")
        if chains.drivers_are_done and not done:
            done = True
            watch.begin_anew()  # only now does a node take a pause for the end


def listen_for(ears: Ears, seconds: float) -> None:
    """Hear what is still said."""
    end_s = time.monotonic() + seconds
    while time.monotonic() < end_s:
        ears.listen(0.1)


def quiet_for_good_s(cast: Cast) -> float:
    """Return the silence [s] after which the feet say nothing more: they have given out what waited."""
    return IDLE_TIMES * max(params.node.idle_s for params in cast.feet.values()) + MARGIN_S


class Watch:
    """Passes every message on to the recording and shows where the foot is."""

    def __init__(
        self,
        write: Callable[[str, str, int, bytes], None],
        show: Callable[[str], None],
        of: str,
        both: Mapping[str, Params] | None = None,  # of two feet that wait for each other
    ) -> None:
        self.owed = Owed(both or {})
        self._write = write
        self._show = show
        self._of = of
        self._first_ns: int | None = None
        self._last_s = time.monotonic() + START_S
        self._odometry = 0
        self._steps = 0

    @property
    def quiet_s(self) -> float:
        """How long ago [s] the last message came; before the first one, for how long the nodes should have spoken."""
        return time.monotonic() - self._last_s

    def begin_anew(self) -> None:
        """Count the silence from now."""
        self._last_s = time.monotonic()

    def take(self, topic: str, name: str, cdr: bytes) -> None:
        """Take one message."""
        self.owed.hear(topic, cdr)
        self._write(f"/{topic}", name, time.time_ns(), cdr)
        if not is_status(topic):
            self._last_s = time.monotonic()
        self._steps += topic.rpartition("/")[2] == "step"
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
