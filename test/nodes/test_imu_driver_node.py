import numpy as np
import pytest
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, MagneticField

from pdr_core.params import Params, SimulationParams, changed
from pdr_core.power import GyroSwitch
from pdr_core.power.motion_rule import motion_rule
from pdr_core.records import joined, length
from pdr_core.simulation import simulated_feet, simulated_walk
from pdr_msgs.msg import WalkStatus
from pdr_msgs.srv import SetGyroPower, SetSampleRate
from pdr_nodes import imu_driver_node
from pdr_nodes.convert import field_block, imu_block, stamp_ns
from pdr_nodes.devices.source import Source
from pdr_nodes.imu_driver_node import LOOK_S, ImuDriverNode
from pdr_nodes.qos import ANSWERS
from pdr_nodes.throttle import ON_THEIR_WAY
from support.bench import Bench
from support.switched import command, strides
from support.walks import magnetic_walk, stamps, straight_walk, write_csv

SIMULATED = {"simulation__walk": "still", "simulation__sample_rate_hz": 200.0, "driver__rate_factor": 1000.0}
SAMPLES = 1200  # six seconds
SETTLING_NS = 50_000_000


class Driver:
    """A driver that works only when the test lets it."""

    def __init__(self, bench):
        self.bench, self.node = bench, bench.node
        self.samples = bench.hear(Imu, "imu/data_raw")
        self.done = False

    def work_until(self, count):
        """Let it work until so many samples have come."""

        def enough():
            if self.node._player.taken < count:
                self.done = self.node.work() is None
            return len(self.samples) >= count

        self.bench.until(enough, f"{count} samples")

    def work_to_the_end(self):
        self.work_until(1)
        self.bench.until(lambda: self.done or self.node.work() is None, "the end")
        self.bench.until(lambda: len(self.samples) == self.node._player.taken, "the last samples")


@pytest.fixture
def driver():
    with Bench(ImuDriverNode, **SIMULATED) as bench:
        yield Driver(bench)


def measured(samples):
    """Which samples hold an angular rate."""
    return np.array([m.angular_velocity_covariance[0] != -1.0 for m in samples])


def test_it_waits_for_a_subscriber_and_then_gives_everything():
    params = SimulationParams(walk="straight", walk_length_m=1.2, sensor_model="ideal")
    with Bench(
        ImuDriverNode, simulation__walk="straight", simulation__walk_length_m=1.2, driver__rate_factor=1000.0
    ) as bench:
        for _ in range(5):
            assert bench.node.work() == LOOK_S
            bench.spin()
        driver, truth = Driver(bench), bench.hear(PoseStamped, "ground_truth")
        driver.work_to_the_end()
        bench.until(lambda: len(truth) == len(driver.samples), "the truth beside every sample")
    expected = simulated_walk(params, start_ns=stamps(driver.samples)[0])
    assert stamps(driver.samples) == expected.imu.stamp_ns.tolist() == stamps(truth)
    np.testing.assert_array_equal([m.pose.position.x for m in truth], expected.truth.position_m[:, 0])
    assert {m.header.frame_id for m in driver.samples} == {"imu_link"}


def test_it_waits_for_as_many_subscribers_as_it_is_told():
    with Bench(ImuDriverNode, driver__subscribers=2, **SIMULATED) as bench:
        driver = Driver(bench)
        bench.until(lambda: bench.node._samples.get_subscription_count() == 1, "the first subscriber")
        assert bench.node.work() == LOOK_S
        assert "1 of 2 are there" in bench.node._notices()[0].text
        bench.hear(Imu, "imu/data_raw")
        driver.work_until(10)
        assert bench.node._notices() == []


def test_as_fast_as_possible_it_waits_for_one_who_acknowledges():
    with Bench(ImuDriverNode, **SIMULATED | {"driver__rate_factor": 0.0}) as bench:
        driver = Driver(bench)
        bench.until(lambda: bench.node._samples.get_subscription_count() == 1, "the subscriber")
        assert bench.node.work() == LOOK_S
        assert "driver.acknowledge_topic" in bench.node._notices()[0].text
        bench.publisher(Odometry, "odom")
        driver.work_until(10)


def test_at_a_pace_it_is_never_far_ahead_of_the_end_of_the_chain():
    lead, given = 20, SIMULATED | {"driver__acknowledge_topic": "walk"}
    with Bench(ImuDriverNode, **given, driver__lead_samples=lead) as bench:
        driver, walks = Driver(bench), bench.me.create_publisher(WalkStatus, "walk", ANSWERS)
        driver.work_until(lead)
        for _ in range(5):
            assert driver.node.work() == LOOK_S
            bench.spin()
        assert driver.node._player.taken == lead
        status = WalkStatus()
        status.header.stamp = driver.samples[lead - 6].header.stamp
        walks.publish(status)
        driver.work_until(2 * lead - 5)
        assert driver.node.work() == LOOK_S
        assert driver.node._player.taken == 2 * lead - 5


def test_as_fast_as_possible_an_estimate_acknowledges_all_samples_before_it():
    with Bench(ImuDriverNode, **SIMULATED | {"driver__rate_factor": 0.0}) as bench:
        driver, publisher = Driver(bench), bench.publisher(Odometry, "odom")
        driver.work_until(ON_THEIR_WAY)
        assert bench.node.work() == LOOK_S
        publisher.publish(Odometry(header=driver.samples[149].header))
        driver.work_until(ON_THEIR_WAY + 150)
        assert bench.node.work() == LOOK_S
    assert bench.node._player.taken == ON_THEIR_WAY + 150


def test_a_deactivated_driver_pauses_and_goes_on_where_it_was(driver):
    driver.work_until(100)
    driver.node.trigger_deactivate()
    assert driver.node.work() == LOOK_S
    driver.node.trigger_activate()
    driver.work_to_the_end()
    assert len(stamps(driver.samples)) == len(set(stamps(driver.samples))) == SAMPLES


def test_a_gyro_can_be_switched_at_a_stamp_to_come(driver):
    driver.work_until(200)
    later = driver.samples[150].header.stamp
    later.sec += 1
    answer = driver.bench.call(SetGyroPower, "set_gyro_power", powered=False, not_before=later)
    driver.work_to_the_end()
    assert answer.effective == later
    assert np.argmin(measured(driver.samples)) == 350


def test_a_recording_is_replayed_bit_by_bit(tmp_path):
    block = straight_walk(1).imu
    path = str(write_csv(tmp_path / "walk.csv", block))
    with Bench(ImuDriverNode, driver__device="replayed", driver__recording=path, driver__rate_factor=1000.0) as bench:
        driver = Driver(bench)
        driver.work_to_the_end()
    assert stamps(driver.samples) == block.stamp_ns.tolist()
    assert [m.angular_velocity.y for m in driver.samples] == block.gyro_radps[:, 1].tolist()
    assert [m.linear_acceleration.x for m in driver.samples] == block.accel_mps2[:, 0].tolist()


def test_it_keeps_the_pace_that_it_is_given(driver):
    driver.node._pace._factor = 1e-9
    driver.work_until(1)
    for _ in range(5):
        assert driver.node.work() == LOOK_S
        driver.bench.spin()
    assert len(driver.samples) == 1


def test_the_gyro_is_off_from_the_stated_stamp_on_and_settles_when_switched_on(driver):
    driver.work_until(200)
    off = driver.bench.call(SetGyroPower, "set_gyro_power", powered=False)
    driver.work_until(500)
    on = driver.bench.call(SetGyroPower, "set_gyro_power", powered=True)
    driver.work_to_the_end()
    assert off.success
    assert on.success
    assert (off.settling_time, on.settling_time) == (0.0, 0.05)
    off_ns, on_ns = (t.sec * 10**9 + t.nanosec for t in (off.effective, on.effective))
    at_ns = np.array(stamps(driver.samples))
    assert at_ns[0] < off_ns < on_ns < at_ns[-1] - SETTLING_NS
    np.testing.assert_array_equal(measured(driver.samples), (at_ns < off_ns) | (at_ns >= on_ns + SETTLING_NS))
    assert all(m.angular_velocity.y == 0.0 for m in driver.samples if m.angular_velocity_covariance[0] == -1.0)
    assert len(driver.samples) == SAMPLES


@pytest.mark.parametrize("part", ["mpu9250", "bmi270"])
def test_a_sensor_that_switches_by_itself_does_so_as_offline(monkeypatch, part):
    imu, asked = strides(), {"power__wake_mps2": 3.0, "power__part": part}
    monkeypatch.setattr(imu_driver_node, "open_device", lambda _params, _start_ns: Source("strides", iter([imu]), None))
    with Bench(ImuDriverNode, driver__rate_factor=1000.0, **asked) as bench:
        driver = Driver(bench)
        driver.work_until(100)
        answer = bench.call(SetGyroPower, "set_gyro_power", on_motion=True)
        driver.work_to_the_end()
    rule = motion_rule(changed(Params(), "power", wake_mps2=3.0, part=part).power)
    assert (answer.success, answer.settling_time) == (True, rule.settle_ns * 1e-9)
    switch = GyroSwitch(rule)
    switch.ask(command(1, True, not_before_ns=stamp_ns(answer.effective), on_motion=True))
    offline = joined([*switch.run(imu), *switch.finish()])
    live = joined([imu_block(message) for message in driver.samples])
    np.testing.assert_array_equal(live.gyro_sd_radps < 0.0, offline.gyro_sd_radps < 0.0)
    np.testing.assert_array_equal(live.gyro_radps, offline.gyro_radps)
    assert 0.1 < measured(driver.samples)[300:].mean() < 0.9


def test_switching_on_what_is_on_needs_no_settling(driver):
    driver.work_until(200)
    assert driver.bench.call(SetGyroPower, "set_gyro_power", powered=True).success
    driver.work_to_the_end()
    assert measured(driver.samples).all()


def test_the_rate_holds_from_the_stated_stamp_on(driver):
    driver.work_until(200)
    answer = driver.bench.call(SetSampleRate, "set_sample_rate", rate=55.0)
    driver.work_to_the_end()
    assert answer.success
    assert answer.rate == pytest.approx(50.0, rel=1e-6)
    at_ns = np.array(stamps(driver.samples))
    since = np.searchsorted(at_ns, answer.effective.sec * 10**9 + answer.effective.nanosec)
    assert 200 <= since < len(at_ns) - 100
    np.testing.assert_allclose(np.diff(at_ns[: since + 1]), 5_000_000, atol=2)
    np.testing.assert_allclose(np.diff(at_ns[since:]), 20_000_000, atol=2)


def magnetic_driver(monkeypatch, **params):
    """A bench with a driver whose device has a magnetometer."""
    source = Source("magnetic", iter([magnetic_walk(1)]), None)
    monkeypatch.setattr(imu_driver_node, "open_device", lambda _params, _start_ns: source)
    return Bench(ImuDriverNode, driver__rate_factor=1000.0, **params)


def test_the_field_goes_out_with_its_sample_also_while_the_gyro_is_off(monkeypatch):
    walk = magnetic_walk(1)
    with magnetic_driver(monkeypatch, node__magnetometer=True) as bench:
        bench.hear(Imu, "imu/data_raw")
        bench.until(lambda: bench.node._samples.get_subscription_count() == 1, "the subscriber of the samples")
        assert bench.node.work() == LOOK_S
        assert f"/{bench.namespace}/imu/mag: 0 of 1 are there" in bench.node._notices()[0].text
        fields, driver = bench.hear(MagneticField, "imu/mag"), Driver(bench)
        driver.work_until(200)
        assert bench.call(SetGyroPower, "set_gyro_power", powered=False).success
        driver.work_to_the_end()
        bench.until(lambda: len(fields) == length(walk), "the last fields")
    assert not measured(driver.samples)[-100:].any()
    assert {m.header.frame_id for m in fields} == {"imu_link"}
    heard = joined([field_block(m) for m in fields])
    np.testing.assert_array_equal(heard.stamp_ns, walk.stamp_ns)
    np.testing.assert_array_equal(heard.field_tesla, walk.field_tesla)
    np.testing.assert_array_equal(heard.field_sd_tesla, walk.field_sd_tesla)


def test_a_magnetometer_that_nobody_knows_of_is_not_published(monkeypatch):
    with magnetic_driver(monkeypatch) as bench:
        Driver(bench).work_until(10)
        assert bench.me.count_publishers("imu/mag") == 0


@pytest.mark.parametrize("rate", [0.0, -1.0, float("nan")])
def test_an_impossible_rate_is_refused(driver, rate):
    driver.work_until(10)
    answer = driver.bench.call(SetSampleRate, "set_sample_rate", rate=rate)
    assert (answer.success, answer.message) == (False, f"rate = {rate}: must be positive [Hz]")


def test_calls_at_the_wrong_time_are_refused(driver):
    assert not driver.bench.call(SetSampleRate, "set_sample_rate", rate=50.0).success
    driver.work_to_the_end()
    assert not driver.bench.call(SetSampleRate, "set_sample_rate", rate=50.0).success
    assert not driver.bench.call(SetGyroPower, "set_gyro_power", powered=False).success


def test_the_length_of_the_simulation_is_known():
    assert length(simulated_walk(SimulationParams(walk="still")).imu) == SAMPLES


def test_it_begins_after_the_nodes_that_it_is_told_to_wait_for():
    """With two feet no stream starts before the nodes of the other one are there."""
    with Bench(ImuDriverNode, **SIMULATED, driver__begins_after="other/odom path") as bench:
        driver = Driver(bench)
        bench.me.create_publisher(Odometry, "other/odom", 10)
        bench.until(lambda: bench.node._missing() == ["path"], "one of both")
        for _ in range(3):
            assert bench.node.work() == LOOK_S
        assert "publishers of path (driver.begins_after)" in bench.node._notices()[0].text
        bench.me.create_publisher(Odometry, "path", 10)
        driver.work_until(10)


@pytest.mark.parametrize("foot", ["left", "right"])
def test_it_plays_one_of_both_feet_from_a_stamp_on(foot):
    asked = {"simulation__foot": foot, "simulation__start_ns": 5_000_000_000, "simulation__walk_length_m": 1.2}
    with Bench(ImuDriverNode, driver__rate_factor=1000.0, simulation__walk="straight", **asked) as bench:
        driver, truth = Driver(bench), bench.hear(PoseStamped, "ground_truth")
        driver.work_to_the_end()
        bench.until(lambda: len(truth) == len(driver.samples), "the truth beside every sample")
    walk = simulated_feet(SimulationParams(walk="straight", walk_length_m=1.2), start_ns=5_000_000_000)[foot]
    assert stamps(driver.samples) == walk.imu.stamp_ns.tolist()
    np.testing.assert_array_equal([m.pose.position.y for m in truth], walk.truth.position_m[:, 1])
    assert np.sign(truth[0].pose.position.y) == (1.0 if foot == "left" else -1.0)
