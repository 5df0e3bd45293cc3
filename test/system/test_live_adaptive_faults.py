"""Nodes of a foot whose gyro is switched are killed and started again: no crash, no jump, the gyro comes back on."""

import signal
import time
from contextlib import ExitStack

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu

from pdr_msgs.msg import NavigationMode, WalkStatus
from pdr_nodes.convert import imu_block
from pdr_nodes.notice_board import notices_from
from pdr_nodes.qos import ANSWERS, MODES, STATUS
from support.bench import Bench
from support.processes import node_process

NODES = ("imu_ingestion", "stance_detector", "gait_dr", "mode_manager", "imu_driver")
SPEED = 4.0
LAST_WORDS_S = 0.5  # a message that is on its way when its node is killed comes within this
WALK = {
    "driver__device": "simulated",
    "driver__rate_factor": SPEED,
    "driver__subscribers": 2,
    "driver__begins_after": "odom mode",  # a navigator that has to compile first would miss the walk
    "simulation__motion": "smooth",
    "simulation__walk": "straight",
    "simulation__walk_length_m": 1200.0,  # 250 s: longer than all tests, also where every start takes its time
    "simulation__sample_rate_hz": 100.0,
    "power__calibration_m": 20.0,
    "power__answer_timeout_s": SPEED,
    "node__input_reliable": True,
}
STRIDE_M = 1.7  # longer than any of this walk


class Walk:
    """The nodes as processes, and what they say."""

    def __init__(self, space, logs, stack):
        self._space, self._logs, self._stack = space, logs, stack
        self.bench = stack.enter_context(Bench(namespace=space))
        self.odometry, self.raw = self.bench.hear(Odometry, "odom"), self.bench.hear(Imu, "imu/data_raw")
        self.modes = self.bench.hear(NavigationMode, "mode", MODES)
        self.walks = self.bench.hear(WalkStatus, "walk", ANSWERS)
        self.said = self.bench.hear(DiagnosticArray, "/diagnostics", STATUS)
        self.running = {}
        self.begin = 0  # of the estimates that are checked
        self._started = 0
        for name in NODES:
            self.start(name)

    def start(self, name):
        self._started += 1
        log = self._logs / f"{name}_{self._started}.log"
        self.running[name] = self._stack.enter_context(node_process(name, self._space, log, **WALK))

    def kill(self, name):
        self.running[name].kill()
        self.running[name].wait(120.0)
        heard_s = time.monotonic() + LAST_WORDS_S
        self.bench.until(lambda: time.monotonic() > heard_s, "what it said before")

    def until_mode(self, condition, what):
        """Wait for something that is said from now on."""
        first = max(0, len(self.modes) - 1)
        self.bench.until(lambda: any(condition(said) for said in self.modes[first:]), what)

    def until_the_gyro_is_off(self):
        self.until_mode(reckons, "the gyro off")
        self.bench.until(lambda: imu_block(self.raw[-1]).gyro_sd_radps[0] < 0.0, "samples without rates")

    def kinds(self):
        statuses = [s for array in self.said for s in array.status]
        return {notice.kind for status in statuses for notice in notices_from(status.values)}

    def check(self, jumps=0):
        """Nothing has crashed, no number is none, and the track jumps only so often."""
        assert {name: process.poll() for name, process in self.running.items()} == dict.fromkeys(NODES)
        at = np.array([[p.x, p.y, p.z] for p in (m.pose.pose.position for m in self.odometry[self.begin :])])
        assert np.isfinite(at).all()
        moved_m = np.linalg.norm(np.diff(at, axis=0), axis=1)
        assert (moved_m > STRIDE_M).sum() <= jumps, moved_m.max()


def reckons(said):
    return said.mode == NavigationMode.MODE_GAIT_DR and said.answer == NavigationMode.ANSWER_ACKNOWLEDGED


@pytest.fixture(scope="module")
def nodes(ros_environment, tmp_path_factory):  # noqa: ARG001
    """Started once: whatever was killed and started again before, the walk goes on."""
    with ExitStack() as stack:
        yield Walk("faults", tmp_path_factory.mktemp("logs"), stack)


@pytest.fixture
def walk(nodes):
    nodes.until_the_gyro_is_off()
    nodes.begin = len(nodes.odometry)
    return nodes


def test_a_driver_that_is_killed_and_started_again(walk):
    walk.kill("imu_driver")
    walk.until_mode(lambda said: said.mode == NavigationMode.MODE_FAULT, "the fault")
    fault = next(said for said in walk.modes[::-1] if said.mode == NavigationMode.MODE_FAULT)
    assert fault.gyro_requested
    assert "driver has failed" in fault.reason
    before = len(walk.raw)
    walk.start("imu_driver")
    walk.bench.until(lambda: len(walk.raw) > before + 100, "samples")
    walk.until_mode(lambda said: said.mode == NavigationMode.MODE_INITIALISING, "calibration anew")
    assert all(imu_block(m).gyro_sd_radps[0] >= 0.0 for m in walk.raw[before : before + 100])
    walk.until_the_gyro_is_off()
    assert "driver_died" in walk.kinds()
    walk.check()


def test_a_manager_that_is_killed_and_started_again_asks_for_the_gyro_first(walk):
    walk.kill("mode_manager")
    before, told = len(walk.raw), len(walk.modes)
    walk.start("mode_manager")
    walk.bench.until(lambda: walk.modes[told:] and walk.modes[-1].gyro_powered, "the gyro on")
    walk.bench.until(lambda: imu_block(walk.raw[-1]).gyro_sd_radps[0] >= 0.0, "rates")
    assert all(said.gyro_requested for said in walk.modes[told:])
    assert any(imu_block(m).gyro_sd_radps[0] < 0.0 for m in walk.raw[before:])
    walk.until_the_gyro_is_off()
    walk.check()
    walk.running["mode_manager"].send_signal(signal.SIGINT)  # in order, it leaves no gyro off
    walk.bench.until(lambda: imu_block(walk.raw[-1]).gyro_sd_radps[0] >= 0.0, "rates without a manager")
    walk.start("mode_manager")


def test_a_navigator_that_is_killed_and_started_again_calibrates_anew(walk):
    walk.kill("gait_dr")
    walk.until_mode(lambda said: said.mode == NavigationMode.MODE_FAULT, "that nothing is heard any more")
    walk.bench.until(lambda: imu_block(walk.raw[-1]).gyro_sd_radps[0] >= 0.0, "rates")
    before = len(walk.odometry)
    walk.start("gait_dr")
    walk.bench.until(lambda: len(walk.odometry) > before + 500, "estimates")
    walk.until_the_gyro_is_off()
    walk.check(jumps=1)  # it begins where it began, and takes what the stance detector remembers once more
