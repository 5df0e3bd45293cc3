"""Runs the nodes on a driver that publishes on the user's own ROS graph, until the user ends it."""

import re
import time
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path

from pdr_bringup_scripts.cast import Cast, below, one_foot
from pdr_bringup_scripts.chain import DRIVER, stay_on_this_machine
from pdr_bringup_scripts.interrupt import Interrupt
from pdr_bringup_scripts.judging import BAG, judge
from pdr_bringup_scripts.listener import Ears
from pdr_bringup_scripts.live import (
    FIELD_WAIT_S,
    Watch,
    make_run_folder,
    new_recording,
    quiet_for_good_s,
)
from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.relay import INPUT, MAG_INPUT, DriverTopics, Relay
from pdr_bringup_scripts.terminal import Terminal
from pdr_core.evaluation.result import Result, SensorsResult
from pdr_core.params import Params
from pdr_core.warmup import warm_up

PATIENCE_S = 5.0  # without a sample, before we say so
REMINDER_S = 30.0
OUR_TOPICS = (INPUT, MAG_INPUT, "imu/data", "imu/marg")
TOPIC = re.compile(r"(/[A-Za-z_][A-Za-z0-9_]*)+")


@dataclass(frozen=True)
class LiveJob:
    """What to listen to, and for how long."""

    topics: DriverTopics
    own_driver: bool  # started with the nodes
    namespace: str  # of our nodes
    duration_s: float | None  # from the first sample on, or from the start where none comes; None: until Ctrl-C


def checked_topic(name: str, namespace: str) -> str:
    """Return a topic from the root; Problem if it is none, or one on which our own nodes publish."""
    topic = "/" + name.strip("/")
    if not TOPIC.fullmatch(topic):
        raise Problem(f"{name!r} is no ROS topic; it looks like /foot/imu")
    if topic.removeprefix(f"/{namespace}/") in OUR_TOPICS:
        raise Problem(f"{topic} is a topic of our own nodes: choose another --namespace for them")
    return topic


def run_on_driver(params: Params, job: LiveJob, out: Path, terminal: Terminal) -> Result | SensorsResult:
    """Estimate what a driver publishes until Ctrl-C, the duration or our own driver ends it; fill the folder `out`."""
    make_run_folder(out)
    node = replace(params.node, input_reliable=True, autostart=True, magnetometer=bool(job.topics.mag))  # the relay's
    wait_s = FIELD_WAIT_S if job.own_driver else node.field_wait_s
    params = replace(params, node=replace(node, field_wait_s=wait_s))
    warm_up(params)
    begin, cast = time.monotonic(), one_foot(params)
    stay_on_this_machine(out / "nodes", None)
    record(cast, job, out, terminal)
    return judge(cast, out, time.monotonic() - begin, {}, job.namespace)


def record(cast: Cast, job: LiveJob, out: Path, terminal: Terminal) -> None:
    """Run the nodes and write all they hear and say to a bag; Problem if no sample came."""
    (foot,) = cast.feet
    inputs = below(foot, INPUT), below(foot, MAG_INPUT)
    ours = {name: kind for name, kind in cast.topics.items() if name not in inputs}
    with ExitStack() as stack:
        interrupt = stack.enter_context(Interrupt())
        show = stack.enter_context(terminal.progress("Listening"))
        bag = stack.enter_context(new_recording(out / BAG))
        watch = Watch(bag.write, show, "")
        ears = stack.enter_context(Ears(watch.take, job.namespace, ours))
        relay = Relay(ears.node, job.topics, watch.take, foot)
        remapped = {DRIVER: {INPUT: job.topics.imu, **({MAG_INPUT: job.topics.mag} if job.topics.mag else {})}}
        chains = stack.enter_context(cast.chains(out / "nodes", job.namespace, job.own_driver, remapped))
        begin, silence, quiet_s = time.monotonic(), Silence(relay, terminal), quiet_for_good_s(cast)
        while not (interrupt.asked or over(job, relay, begin) or (chains.drivers_are_done and watch.quiet_s > quiet_s)):
            ears.listen(0.1)
            chains.check()
            silence.look()
        relay.close()
        if relay.first_s is None:
            chains.check()
            raise Problem(relay.why_silent())
        if relay.lacks_field:
            terminal.say(f"pdr: no messages on {job.topics.mag}: this walk is estimated without the magnetic field")
        show("ending: the nodes give out what they still hold")
        while watch.quiet_s < quiet_s:
            ears.listen(0.1)
            chains.check()


def over(job: LiveJob, relay: Relay, begin_s: float) -> bool:
    """Tell whether the time is up."""
    since_s = begin_s if relay.first_s is None else relay.first_s
    return job.duration_s is not None and time.monotonic() - since_s > job.duration_s


class Silence:
    """Says it when nothing comes, and says it again when that lasts."""

    def __init__(self, relay: Relay, terminal: Terminal) -> None:
        self._relay = relay
        self._terminal = terminal
        self._next_s = time.monotonic() + PATIENCE_S

    def look(self) -> None:
        """Look whether there is something to say."""
        if self._relay.first_s is None and time.monotonic() > self._next_s:
            self._next_s = time.monotonic() + REMINDER_S
            self._terminal.say(f"pdr: {self._relay.why_silent()}")
