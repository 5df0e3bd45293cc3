"""A node that dies in mid-stream and is started again: the chain goes on."""

from contextlib import ExitStack
from types import SimpleNamespace

import numpy as np
import pytest
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, MagneticField

from pdr_core.records import joined
from pdr_msgs.msg import MargSample, StanceImu
from pdr_nodes.convert import marg_block, nav_block
from support.bench import Bench
from support.processes import node_process
from support.walks import field_messages, imu_messages, magnetic_walk, stamps, straight_walk

STRIDES, STRIDE_M, HALF = 4, 1.2, 650  # samples: the second stride is behind, the third has not begun
CHAIN = ("imu_ingestion", "stance_detector", "zupt_ekf")
RELIABLE = {"node__idle_s": 0.5, "node__input_reliable": True}


@pytest.fixture(scope="module", params=CHAIN)
def heard(request, tmp_path_factory):
    """All verdicts and estimates of a walk during which one node is killed and started again."""
    victim, space, logs = request.param, f"restart_{request.param}", tmp_path_factory.mktemp("logs")
    walk = imu_messages(straight_walk(STRIDES).imu)
    with ExitStack() as stack:
        started = {
            name: stack.enter_context(node_process(name, space, logs / f"{name}.log", **RELIABLE)) for name in CHAIN
        }
        bench = stack.enter_context(Bench(namespace=space))
        odometry, verdicts = bench.hear(Odometry, "odom"), bench.hear(StanceImu, "stance")
        publisher = bench.publisher(Imu, "imu/data_raw")
        bench.feed(publisher, walk[:HALF])
        bench.until(lambda: len(odometry) == HALF, "the first half")
        started[victim].kill()
        bench.feed(publisher, walk[HALF : HALF + 100])
        stack.enter_context(node_process(victim, space, logs / "again.log", **RELIABLE))
        bench.feed(publisher, walk[HALF + 100 :])
        bench.until(lambda: stamps(odometry[-1:]) == stamps(walk[-1:]), "the last sample")
    return SimpleNamespace(odometry=odometry, verdicts=verdicts, walk=walk)


def test_every_sample_gets_an_estimate(heard):
    assert set(stamps(heard.odometry)) == set(stamps(heard.walk))


@pytest.mark.parametrize("heard", ["imu_ingestion"], indirect=True, scope="module")
def test_what_a_restarted_ingestion_says_once_more_is_judged_once(heard):
    assert stamps(heard.verdicts) == stamps(heard.walk)


def test_no_estimate_is_nan(heard):
    for column in joined([nav_block(m) for m in heard.odometry]):
        assert np.isfinite(column).all()


def test_no_step_is_walked_twice(heard):
    end = heard.odometry[-1].pose.pose.position
    assert end.x == pytest.approx(STRIDES * STRIDE_M, rel=0.05)
    assert end.y == pytest.approx(0.0, abs=0.2)


def test_an_ingestion_that_is_killed_and_started_again_pairs_every_field(tmp_path):
    space, walk = "restart_field", magnetic_walk(STRIDES)
    samples, fields = imu_messages(walk), field_messages(walk)
    params = RELIABLE | {"node__magnetometer": True, "node__field_wait_s": 5.0}  # however busy the machine
    with Bench(namespace=space) as bench:
        margs = bench.hear(MargSample, "imu/marg")
        with node_process("imu_ingestion", space, tmp_path / "first.log", **params):
            mag, imu = bench.publisher(MagneticField, "imu/mag"), bench.publisher(Imu, "imu/data_raw")
            bench.feed(mag, fields[:HALF])
            bench.feed(imu, samples[:HALF])
            bench.until(lambda: len(margs) >= HALF - 10, "the first half")
        bench.feed(imu, samples[HALF:])
        bench.feed(mag, fields[HALF:])
        with node_process("imu_ingestion", space, tmp_path / "again.log", **params):
            bench.until(lambda: stamps(m.imu for m in margs[-1:]) == stamps(samples[-1:]), "the last sample")
    latest = {int(block.stamp_ns[0]): block for block in map(marg_block, margs)}
    block = joined([latest[stamp] for stamp in stamps(samples)])
    np.testing.assert_array_equal(block.field_sd_tesla >= 0.0, walk.field_sd_tesla >= 0.0)
    np.testing.assert_array_equal(block.field_tesla, walk.field_tesla)
