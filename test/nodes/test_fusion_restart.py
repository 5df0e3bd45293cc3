"""A node of two feet that dies in mid-walk: the others go on, and take it back when it is started again."""

from contextlib import ExitStack

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry

from pdr_core.records import joined, length, part
from pdr_msgs.msg import StanceImu
from pdr_nodes.convert import nav_block
from pdr_nodes.qos import STATUS
from support.bench import Bench
from support.feet import FEET, both_walk
from support.processes import node_process
from support.walks import judged, stamps, stance_messages

PATIENT = {"node__idle_s": 0.5, "node__answer_timeout_s": 4.0}  # a busy machine is no foot that has ended
ASKING = PATIENT | {"filter__heading_feedback": True}
WALK = {foot: judged(samples) for foot, samples in both_walk(9.6).items()}
HALF = 900  # samples: in the middle of the walk


class Feet:
    """Filters of both feet and the fusion as processes, fed by the test."""

    def __init__(self, space, logs, stack):
        self._space, self._logs, self._stack, self._count = space, logs, stack, 0
        self.nodes = {foot: self.start("zupt_ekf", foot) for foot in FEET}
        self.fusion = self.start("heading_fusion")
        self.bench = bench = stack.enter_context(Bench(namespace=space))
        self.person = bench.hear(Odometry, "odom")
        self.odometry = {foot: bench.hear(Odometry, f"{foot}/odom") for foot in FEET}
        self.diagnostics = bench.hear(DiagnosticArray, "/diagnostics", STATUS)
        self.publishers = {foot: bench.publisher(StanceImu, f"{foot}/stance") for foot in FEET}
        bench.until(lambda: all(map(self.whole, FEET)), "all nodes")

    def whole(self, foot):
        """The fusion hears the foot, and the foot the fusion."""
        me = self.bench.me
        return me.count_subscribers(f"{foot}/step") and me.count_subscribers(f"{foot}/heading_observation")

    def start(self, node, foot=""):
        self._count += 1
        space, log = f"{self._space}/{foot}".rstrip("/"), self._logs / f"{self._count}.log"
        params = ASKING if foot else PATIENT
        return self._stack.enter_context(node_process(node, space, log, **params))

    def walk(self, foot, start, stop):
        self.bench.feed(self.publishers[foot], stance_messages(part(WALK[foot], start, stop)))

    def until_at(self, odometry, foot, index, what):
        """Wait until somebody is at a sample of a foot."""
        stamp_ns = int(WALK[foot].imu.stamp_ns[index])
        self.bench.until(lambda: odometry and stamps(odometry[-1:])[0] >= stamp_ns, what)


@pytest.fixture
def feet(tmp_path):
    with ExitStack() as stack:
        yield Feet(f"feet_{tmp_path.name.strip('_')}", tmp_path, stack)


def test_feet_go_on_without_the_fusion_and_say_so(feet):
    for foot in FEET:
        feet.walk(foot, 0, HALF)
    for foot in FEET:
        feet.until_at(feet.odometry[foot], foot, HALF - 1, f"the first half of {foot}")
    feet.fusion.kill()
    for foot in FEET:
        feet.walk(foot, HALF, length(WALK[foot]))
    for foot in FEET:
        feet.until_at(feet.odometry[foot], foot, -1, f"the end of {foot}")
    feet.bench.until(lambda: "heading_unanswered" in repr(feet.diagnostics), "the notice")


def test_the_person_goes_on_with_one_foot_and_takes_the_other_back(feet):
    for foot in FEET:
        feet.walk(foot, 0, HALF)
    feet.until_at(feet.person, "left", HALF - 2, "the person's first half")
    feet.nodes["left"].kill()
    feet.walk("left", HALF, HALF + 300)
    feet.walk("right", HALF, HALF + 300)
    feet.until_at(feet.person, "right", HALF + 299, "the person on one foot")
    alone = nav_block(feet.person[-1])
    feet.start("zupt_ekf", "left")
    for foot in ("left", "right"):
        feet.walk(foot, HALF + 300, length(WALK[foot]))
    for foot in FEET:
        feet.until_at(feet.odometry[foot], foot, -1, f"the end of {foot}")
    feet.until_at(feet.person, "right", -2, "the person's end")
    nav = joined([nav_block(message) for message in feet.person])
    assert all(np.isfinite(column).all() for column in nav)
    assert (np.diff(nav.stamp_ns) > 0).all()
    before_m2 = nav.pose_covariance[nav.stamp_ns < alone.stamp_ns[0] - 5e9, 0, 0]
    assert np.median(before_m2) < 0.1 * alone.pose_covariance[0, 0, 0]  # a busy machine may lack a foot for a moment
