"""Runs the nodes on a driver that publishes on the user's own ROS graph, until the user ends it."""

import time
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

from pdr_bringup_scripts.interrupt import Interrupt
from pdr_bringup_scripts.live.cast import Cast, below
from pdr_bringup_scripts.live.chain import DRIVER, stay_on_this_machine
from pdr_bringup_scripts.live.judging import BAG, judge
from pdr_bringup_scripts.live.listener import Ears
from pdr_bringup_scripts.live.live_run import (
    NOTHING_S,
    Watch,
    make_run_folder,
    new_recording,
    quiet_for_good_s,
)
from pdr_bringup_scripts.live.relay import INPUT, MAG_INPUT, DriverTopics, Relay
from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.terminal import Terminal
from pdr_core.evaluation.result import Result, SensorsResult
from pdr_core.pipeline import ChestCard
from pdr_core.warmup import warm_up

PATIENCE_S = 5.0  # without a sample, before we say so
REMINDER_S = 30.0


@dataclass(frozen=True)
class LiveJob:
    """What to listen to, and for how long."""

    topics: Sequence[DriverTopics]  # of each sensor of the cast, in its order
    own_driver: bool  # started with the nodes; of one sensor only
    namespace: str  # of our nodes
    duration_s: float | None  # from the first sample on, or from the start where none comes; None: until Ctrl-C


def run_on_driver(cast: Cast, job: LiveJob, out: Path, terminal: Terminal) -> Result | SensorsResult:
    """Estimate what drivers publish until Ctrl-C, the duration or our own driver ends it; fill the folder `out`."""
    make_run_folder(out)
    for params in cast.feet.values():  # so that the nodes need not compile, each for itself
        if cast.chest:
            ChestCard(params).warm_up()
        else:
            warm_up(params, both=len(cast.feet) > 1)
    begin = time.monotonic()
    stay_on_this_machine(out / "nodes", None)
    record(cast, job, out, terminal)
    return judge(cast, out, time.monotonic() - begin, {}, job.namespace)


def record(cast: Cast, job: LiveJob, out: Path, terminal: Terminal) -> None:
    """Run the nodes and write all they hear and say to a bag; Problem if a sensor was silent."""
    inputs = {below(foot, name) for foot in cast.feet for name in (INPUT, MAG_INPUT)}
    ours = {name: kind for name, kind in cast.topics.items() if name not in inputs}
    with ExitStack() as stack:
        interrupt = stack.enter_context(Interrupt())
        show = stack.enter_context(terminal.progress("Listening"))
        bag = stack.enter_context(new_recording(out / BAG))
        watch = Watch(bag.write, show, "")
        ears = stack.enter_context(Ears(watch.take, job.namespace, ours))
        relays = [
            Relay(ears.node, topics, watch.take, foot) for foot, topics in zip(cast.feet, job.topics, strict=True)
        ]
        chains = stack.enter_context(cast.chains(out / "nodes", job.namespace, job.own_driver, remapped(job)))
        begin, silences = time.monotonic(), [Silence(relay, terminal) for relay in relays]
        quiet_s = quiet_after_all_s(cast)
        while not (
            interrupt.asked or over(job, relays, begin) or (chains.drivers_are_done and watch.quiet_s > quiet_s)
        ):
            ears.listen(0.1)
            chains.check()
            for silence in silences:
                silence.look()
        for relay in relays:
            relay.close()
        chains.check()
        check_heard(relays, out, terminal)
        show("ending: the nodes give out what they still hold")
        estimates = {f"/{below(foot, 'odom')}" for foot in cast.feet}
        while watch.quiet_s < (quiet_s if estimates <= bag.topics else NOTHING_S):  # nodes may still be starting
            ears.listen(0.1)
            chains.check()


def quiet_after_all_s(cast: Cast) -> float:
    """Return the silence [s] after which nothing more is said: one foot may wait for another that has ended."""
    waits_s = cast.person.node.foot_patience_s if cast.person and len(cast.feet) > 1 else 0.0
    return quiet_for_good_s(cast) + waits_s


def remapped(job: LiveJob) -> dict[str, dict[str, str]]:
    """Return under which names a driver of ours publishes."""
    if not job.own_driver:
        return {}
    (topics,) = job.topics
    return {DRIVER: {INPUT: topics.imu, **({MAG_INPUT: topics.mag} if topics.mag else {})}}


def over(job: LiveJob, relays: Sequence[Relay], begin_s: float) -> bool:
    """Tell whether the time is up."""
    since_s = min((relay.first_s for relay in relays if relay.first_s is not None), default=begin_s)
    return job.duration_s is not None and time.monotonic() - since_s > job.duration_s


def check_heard(relays: Sequence[Relay], out: Path, terminal: Terminal) -> None:
    """Say which magnetometer was silent; Problem if a sensor was, with what is left of the other one."""
    silent = [relay for relay in relays if relay.first_s is None]
    if silent:
        left = [] if len(silent) == len(relays) else [f"the other foot is in {out / BAG}: pdr run {out / BAG}"]
        raise Problem("\n".join([relay.why_silent() for relay in silent] + left))
    for relay in relays:
        if relay.lacks_field:
            terminal.say(f"pdr: no messages on {relay.topics.mag}: this walk is estimated without the magnetic field")


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
