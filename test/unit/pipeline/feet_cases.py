"""Two simulated feet, and their estimates by the pipeline offline and as messages that arrive in any order."""

from collections import deque
from functools import cache

import numpy as np

from pdr_core.conventions import nanoseconds
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import BothFeet, FootInertial, HeadingFusion
from pdr_core.records import joined, length, part
from pdr_core.simulation import simulated_feet

FEET = ("left", "right")
START_NS = 1_700_000_000_000_000_000


@cache
def feet_walks(walk="rectangle", length_m=24.0, seed=1, rate_hz=100.0, sensor="consumer"):
    """Return the walks of both feet, by name."""
    params = SimulationParams(walk=walk, walk_length_m=length_m, seed=seed, sample_rate_hz=rate_hz, sensor_model=sensor)
    return simulated_feet(params, start_ns=START_NS)


def samples(**walk):
    """Return the samples of both feet, by name."""
    return {name: one.imu for name, one in feet_walks(**walk).items()}


def later(imu, shift_s):
    """Return samples on a clock that shows more."""
    return imu._replace(stamp_ns=imu.stamp_ns + nanoseconds(shift_s))


class Together:
    """What BothFeet makes of samples, in pieces that are fed in turn."""

    def __init__(self, imus, params=None, piece=500):
        self.both = BothFeet(params or Params(), tuple(imus))
        self.outputs = []
        for start in range(0, max(length(imu) for imu in imus.values()), piece):
            for name, imu in imus.items():
                if start < length(imu):
                    self.outputs.append(self.both.run(name, part(imu, start, start + piece)))
                    if start + piece >= length(imu):
                        self.outputs.append(self.both.end(name))
        self.outputs.append(self.both.finish())
        self.body = joined([o.body for o in self.outputs])
        self.kinds = [notice.kind for notice in self.both.notices["body"]]

    def nav(self, foot):
        return joined([one.nav for output in self.outputs for name, one in output.feet if name == foot])

    def steps(self, foot):
        return [step for output in self.outputs for name, one in output.feet if name == foot for step in one.steps]


class Messages:
    """Feet whose steps and estimates come by different topics, in random order; each waits for its answers.

    `lives` are the samples of each foot: of its process, and of those that are started when the one before is killed.
    """

    def __init__(self, lives, rng, params=None, piece=40):
        self.params = changed(params or Params(), "filter", heading_feedback=True)
        self.rng, self.piece, self.lives = rng, piece, {name: deque(those) for name, those in lives.items()}
        self.fusion = HeadingFusion(self.params, tuple(lives))
        self.chains, self.sources, self.taken = {}, {}, dict.fromkeys(lives, 0)
        self.topics = {(name, topic): deque() for name in lives for topic in ("step", "odometry", "answer")}
        self.haste = {}  # some topics are slower than others
        self.bodies, self.answers, self.steps = [], [], {name: [] for name in lives}
        for name in lives:
            self.start(name)

    def start(self, name):
        """Start a process of a foot; the answers that the one before has not read are lost."""
        imu = self.lives[name].popleft()
        self.chains[name] = FootInertial(self.params, heading=None)
        self.sources[name] = deque(part(imu, i, i + self.piece) for i in range(0, length(imu), self.piece))
        self.topics[name, "answer"].clear()

    def run(self):
        """Return all of the body and all answers."""
        while ready := self.ready():
            weights = [self.haste.setdefault(what, np.exp(self.rng.normal(0.0, 2.0))) for what in ready]
            self.happen(*ready[self.rng.choice(len(ready), p=np.divide(weights, sum(weights)))])
        return joined([body for body in self.bodies if length(body)]), self.answers

    def ready(self):
        """Return what may happen next: the feet walk in step."""
        for name in self.lives:
            if not self.sources[name] and self.lives[name]:
                self.start(name)
        behind = min((self.taken[name] for name in self.lives if self.sources[name]), default=0)
        walk = [("samples", n) for n in self.lives if self.sources[n] and self.taken[n] <= behind + 2]
        return walk + [topic[::-1] for topic, queue in self.topics.items() if queue]

    def happen(self, what, name):
        if what == "samples":
            self.taken[name] += 1
            self.publish(name, self.chains[name].run(self.sources[name].popleft()))
        elif what == "answer":
            self.publish(name, self.chains[name].answer(self.topics[name, what].popleft()))
        else:
            self.take(getattr(self.fusion, what)(name, self.topics[name, what].popleft()))

    def lose_patience(self):
        """Wait no longer for what is waited for, as a node does after a while; return whether anything was."""
        waited_for = list(self.fusion.awaited_ns)
        for name in waited_for:
            self.take(self.fusion.leave(name))
        return bool(waited_for)

    def publish(self, name, output):
        self.steps[name].extend(output.steps)
        self.topics[name, "step"].extend(output.steps)
        self.topics[name, "odometry"].append(output.nav)

    def take(self, told):
        self.bodies.append(told.body)
        self.answers.extend(told.answers)
        for name, answer in told.answers:
            self.topics[name, "answer"].append(answer)


def by_messages(imus, rng, params=None):
    """Return the body and the answers, where each foot has one process."""
    return Messages({name: [imu] for name, imu in imus.items()}, rng, params).run()


def yaw_rad(nav):
    """Return the yaw of a level body, (n,)."""
    return 2.0 * np.arctan2(nav.quat_xyzw[:, 2], nav.quat_xyzw[:, 3])


def midway_m(walks, stamp_ns):
    """Return where the body really was, (n, 3): between the feet of these walks."""
    first_ns = stamp_ns[0]
    feet = []
    for walk in walks.values():
        known = (walk.truth.stamp_ns - first_ns).astype(float)
        at = (stamp_ns - first_ns).astype(float)
        feet.append(np.column_stack([np.interp(at, known, axis) for axis in walk.truth.position_m.T]))
    return 0.5 * (feet[0] + feet[1])
