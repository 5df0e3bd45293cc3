import time

import numpy as np
import pytest
from sensor_msgs.msg import Imu

from pdr_core.intake import Ingestion
from pdr_core.params import Params
from pdr_core.records import joined, length, part
from pdr_core.stance import StanceDetection
from pdr_msgs.msg import MargSample, StanceImu
from pdr_nodes.convert import marg_message, stance_block
from pdr_nodes.qos import OWN
from pdr_nodes.stance_detector_node import StanceDetectorNode
from support.bench import Bench
from support.walks import imu_messages, magnetic_walk, stamps, still, straight_walk

STRIDES = 3


@pytest.fixture(scope="module")
def trusted():
    """The samples of a short walk as ingestion passes them on."""
    return Ingestion(Params().intake).run(straight_walk(STRIDES).imu)


def held_back(block):
    """How many samples wait for later ones."""
    params = Params()
    return length(block) - length(StanceDetection(params.stance, params.place).run(block))


@pytest.fixture(scope="module")
def verdicts(trusted):
    """What the node says of the walk, and of a rest that begins after the node has given out the end of the walk."""
    later = still(0.5, int(trusted.stamp_ns[-1]) + 10_000_000)
    with Bench(StanceDetectorNode, node__idle_s=0.3) as bench:
        heard = bench.hear(StanceImu, "stance")
        publisher = bench.publisher(Imu, "imu/data")
        bench.feed(publisher, imu_messages(trusted))
        bench.until(lambda: len(heard) >= length(trusted), "the verdict on every sample")
        bench.feed(publisher, imu_messages(later))
        bench.until(lambda: len(heard) >= length(trusted) + 50, "the verdicts on what came later")
        return heard, joined([trusted, later])


def test_each_sample_comes_out_once_with_its_stamp(verdicts):
    heard, fed = verdicts
    assert stamps(heard) == fed.stamp_ns.tolist()


def test_the_end_of_a_walk_had_to_be_flushed(trusted):
    assert 0 < held_back(trusted) < length(trusted)


def test_the_sample_is_passed_on_as_it_is(verdicts):
    heard, fed = verdicts
    assert [m.imu.angular_velocity.y for m in heard] == fed.gyro_radps[:, 1].tolist()
    assert [m.imu.linear_acceleration.z for m in heard] == fed.accel_mps2[:, 2].tolist()
    assert {m.imu.header.frame_id for m in heard} == {"foot"}
    assert {m.magnetic_field.magnetic_field_covariance[0] for m in heard} == {-1.0}


def test_the_foot_stands_between_its_strides(verdicts):
    stance = np.array([m.stance for m in verdicts[0]])
    assert np.count_nonzero(np.diff(stance.astype(int)) == -1) == STRIDES
    assert stance[0]
    assert stance[-1]


def test_a_verdict_follows_from_its_statistic_and_stays_finite(verdicts):
    numbers = np.array([[m.statistic, m.threshold] for m in verdicts[0]])
    assert np.isfinite(numbers).all()
    standing = np.array([m.stance for m in verdicts[0]])
    assert (numbers[standing, 0] <= numbers[standing, 1]).all()


def test_a_pause_is_no_end_while_the_driver_is_there(trusted):
    """Else the last verdicts before the pause would be judged by what there was: 231 um in a walk of two feet."""
    params, half = Params(), part(trusted, 0, length(trusted) // 2)
    stance = StanceDetection(params.stance, params.place)
    expected = joined([stance.run(trusted), stance.finish()])
    with Bench(StanceDetectorNode, node__idle_s=0.2, node__ends_with="imu/data_raw") as bench:
        heard = bench.hear(StanceImu, "stance")
        driver = bench.me.create_publisher(Imu, "imu/data_raw", OWN)
        publisher, messages = bench.publisher(Imu, "imu/data"), imu_messages(trusted)
        bench.feed(publisher, messages[: length(half)])
        bench.until(lambda: len(heard) >= length(half) - held_back(half), "the verdicts before the pause")
        pause = time.monotonic() + 1.0
        bench.until(lambda: time.monotonic() > pause, "the end of the pause")
        bench.feed(publisher, messages[length(half) :])
        bench.until(lambda: len(heard) >= length(trusted) - held_back(trusted), "the verdicts after the pause")
        bench.me.destroy_publisher(driver)
        bench.until(lambda: len(heard) >= length(trusted), "the verdict on every sample")
    block = joined([stance_block(m) for m in heard])
    for name in ("stance", "statistic", "threshold", "zero_velocity_sd_mps"):
        np.testing.assert_array_equal(getattr(block, name), getattr(expected, name), err_msg=name)


def test_with_a_magnetometer_each_verdict_has_the_field_of_its_sample():
    params, walk = Params(), Ingestion(Params().intake).run(magnetic_walk(1))
    stance = StanceDetection(params.stance, params.place)
    expected = joined([stance.run(walk), stance.finish()])
    with Bench(StanceDetectorNode, node__idle_s=0.3, node__magnetometer=True) as bench:
        heard = bench.hear(StanceImu, "stance")
        publisher = bench.publisher(MargSample, "imu/marg")
        bench.feed(publisher, [marg_message(walk, i, "foot") for i in range(length(walk))])
        bench.until(lambda: len(heard) >= length(walk), "the verdict on every sample")
    block = joined([stance_block(m) for m in heard])
    for column, wanted in zip(block.imu, expected.imu, strict=True):
        np.testing.assert_array_equal(column, wanted)
    np.testing.assert_array_equal(block.stance, expected.stance)
    assert (block.imu.field_sd_tesla < 0.0).any()
    assert all(
        m.magnetic_field.header == m.imu.header for m in heard if m.magnetic_field.magnetic_field_covariance[0] > 0
    )
