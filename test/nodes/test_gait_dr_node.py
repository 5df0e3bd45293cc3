"""The node that navigates with the gyro and without it says what the same object says offline."""

from types import SimpleNamespace

import numpy as np
import pytest
from nav_msgs.msg import Odometry

from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import AdaptiveFoot
from pdr_core.power import GyroSwitch
from pdr_core.power.motion_rule import motion_rule
from pdr_core.rate_limit import RateLimit
from pdr_core.records import joined, length
from pdr_core.simulation import SimulatedWalk, simulated_walk
from pdr_msgs.msg import FilterHealth, NavigationMode, StanceImu, StepEvent, WalkStatus
from pdr_nodes.convert import nav_block
from pdr_nodes.convert_walk import walk_records
from pdr_nodes.gait_dr_node import GaitDrNode
from pdr_nodes.qos import ANSWERS, MODES, STATUS
from support.bench import Bench
from support.moved import moved_again
from support.switched import command
from support.walks import BEGIN_NS, judged, stamps, stance_messages

WALK = SimulationParams(motion="smooth", walk="straight", walk_length_m=40.0, sample_rate_hz=100.0)
OFF = 20  # the gyro is off from this stride on
IDLE_S = 1.0


def switched_off(walk: SimulatedWalk):
    """Return the samples of a walk whose gyro is off in its last strides."""
    imu = walk.imu
    toe_offs = np.flatnonzero(np.diff(walk.motion.stance.astype(int)) == -1)
    on = np.arange(length(imu)) < toe_offs[OFF] - 10
    off = {"gyro_radps": np.where(on[:, None], imu.gyro_radps, 0.0)}
    return imu._replace(gyro_sd_radps=np.where(on, imu.gyro_sd_radps, -1.0), **off)


@pytest.fixture(scope="module")
def heard():
    """What the node says of the walk; in its middle it is told twice that the step length model has failed."""
    block = judged(switched_off(simulated_walk(WALK, start_ns=BEGIN_NS)))
    messages, half = stance_messages(block), length(block) // 2
    with Bench(GaitDrNode, node__idle_s=IDLE_S) as bench:
        odometry, steps = bench.hear(Odometry, "odom"), bench.hear(StepEvent, "step")
        walks, health = bench.hear(WalkStatus, "walk", ANSWERS), bench.hear(FilterHealth, "filter_health", STATUS)
        stance, mode = bench.publisher(StanceImu, "stance"), bench.publisher(NavigationMode, "mode", MODES)
        bench.feed(stance, messages[:half])
        for first in (half, half + 200):
            heard_ns = int(block.imu.stamp_ns[first - 12])
            bench.until(lambda heard_ns=heard_ns: walks and stamps(walks)[-1] >= heard_ns, "the samples so far")
            mode.publish(NavigationMode(command=7, step_model_failed=True))
            for _ in range(5):
                bench.spin()
            bench.feed(stance, messages[first : first + 200])
        bench.feed(stance, messages[half + 400 :])
        bench.until(lambda: stamps(odometry[-1:]) == [int(block.imu.stamp_ns[-1])], "the last estimate")
        bench.until(lambda: health and health[-1].state == FilterHealth.STATE_COASTING, "health without the gyro")
    return SimpleNamespace(block=block, odometry=odometry, steps=steps, walks=walks, health=health)


@pytest.fixture(scope="module")
def offline(heard):
    """The same object, told of the model where the node says that it was."""
    foot = AdaptiveFoot(Params())
    pieces = list(moved_again(foot, heard.block, heard.walks))
    return [*(moved.output for moved in pieces), foot.finish()], [(moved.walk, moved.sensed) for moved in pieces]


def test_estimates_are_those_of_the_core_to_the_last_bit(heard, offline):
    nav = RateLimit(Params().node.odom_rate_hz).thinned(joined([output.nav for output in offline[0]]))
    said = joined([nav_block(message) for message in heard.odometry])
    for name, of_node, of_core in zip(nav._fields, said, nav, strict=True):
        np.testing.assert_array_equal(of_node, of_core, err_msg=name)
    assert np.isfinite(said.position_m).all()


def test_every_stride_is_a_step_with_the_gyro_and_without(heard, offline):
    ends_ns = [step.stamp_ns for output in offline[0] for step in output.steps]
    assert stamps(heard.steps) == ends_ns
    assert [s.index for s in heard.steps] == list(range(1, len(ends_ns) + 1))
    last = heard.odometry[-1].pose.pose.position  # the model has seen a few strides only since it was forgotten
    assert last.x == pytest.approx(WALK.walk_length_m, rel=0.1)


def test_what_is_seen_of_the_walk_arrives_as_it_was_seen(heard, offline):
    for message, (walk, sensed) in zip(heard.walks, offline[1], strict=True):
        said, of_driver = walk_records(message)
        assert of_driver == sensed
        assert repr(said) == repr(walk)  # of NaN too
    reckoned = sum(message.reckoned for message in heard.walks)
    assert reckoned == pytest.approx(len(heard.steps) - OFF, abs=1)
    assert any(message.strides for message in heard.walks)


def test_a_model_that_has_failed_is_forgotten_once(heard, offline):
    assert [message.model_forgotten for message in heard.walks].count(True) == 1
    unaware = AdaptiveFoot(Params())
    told = joined([*(moved.output.nav for moved in moved_again(unaware, heard.block, [])), unaware.finish().nav])
    assert np.abs(told.position_m[-1] - offline[0][-1].nav.position_m[-1]).max() > 0.01


def test_the_deviation_grows_while_strides_are_reckoned(heard):
    assert heard.health[-1].position_stddev > 0.02
    assert stamps(heard.health)[-1] >= stamps(heard.odometry)[-1] - 100_000_000


def slept_in_stands(walk: SimulatedWalk, params: Params):
    """Return the samples of a walk whose sensor has switched its gyro for each swing of the second half."""
    switch = GyroSwitch(motion_rule(params.power))
    half_ns = int(walk.imu.stamp_ns[length(walk.imu) // 2])
    switch.ask(command(1, True, not_before_ns=half_ns, on_motion=True))
    return joined([*switch.run(walk.imu), *switch.finish()])


def test_a_gyro_that_sleeps_in_every_stand_gives_the_track_of_the_core():
    params = changed(Params(), "power", duty="swing")
    block = judged(slept_in_stands(simulated_walk(WALK, start_ns=BEGIN_NS), params))
    with Bench(GaitDrNode, node__idle_s=IDLE_S, power__duty="swing") as bench:
        odometry = bench.hear(Odometry, "odom")
        bench.feed(bench.publisher(StanceImu, "stance"), stance_messages(block))
        bench.until(lambda: stamps(odometry[-1:]) == [int(block.imu.stamp_ns[-1])], "the last estimate")
    foot = AdaptiveFoot(params)
    navs = [*(moved.output.nav for moved in foot.run(block)), foot.finish().nav]
    of_core = RateLimit(params.node.odom_rate_hz).thinned(joined(navs))
    said = joined([nav_block(message) for message in odometry])
    np.testing.assert_array_equal(said.stamp_ns, of_core.stamp_ns)
    np.testing.assert_array_equal(said.position_m, of_core.position_m)
    np.testing.assert_array_equal(said.pose_covariance, of_core.pose_covariance)
    assert (block.imu.gyro_sd_radps < 0.0).sum() > 300
    assert said.position_m[-1, 0] == pytest.approx(WALK.walk_length_m, rel=0.05)
