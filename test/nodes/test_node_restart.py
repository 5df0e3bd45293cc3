"""A node that dies in mid-stream and is started again: the chain goes on."""

from contextlib import ExitStack
from types import SimpleNamespace

import numpy as np
import pytest
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu

from pdr_core.records import joined
from pdr_msgs.msg import StanceImu
from pdr_nodes.convert import nav_block
from support.bench import Bench
from support.processes import node_process
from support.walks import imu_messages, stamps, straight_walk

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
