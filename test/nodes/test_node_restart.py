"""A node that dies in mid-stream and is started again: the chain goes on."""

from contextlib import ExitStack

import numpy as np
import pytest
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu

from pdr_core.intake import Ingestion
from pdr_core.params import Params
from pdr_core.records import joined
from pdr_nodes.convert import nav_block
from support.bench import Bench
from support.processes import node_process
from support.walks import imu_messages, stamps, straight_walk

STRIDES, STRIDE_M, HALF = 4, 1.2, 650  # samples: the second stride is behind, the third has not begun
CHAIN = ("stance_detector", "zupt_ekf")


@pytest.fixture(scope="module", params=CHAIN)
def heard(request, tmp_path_factory):
    """All estimates of a walk during which one node is killed and started again."""
    victim, space, logs = request.param, f"restart_{request.param}", tmp_path_factory.mktemp("logs")
    walk = imu_messages(Ingestion(Params().intake).run(straight_walk(STRIDES).imu))
    with ExitStack() as stack:
        started = {
            name: stack.enter_context(node_process(name, space, logs / f"{name}.log", node__idle_s=0.5))
            for name in CHAIN
        }
        bench = stack.enter_context(Bench(namespace=space))
        odometry, publisher = bench.hear(Odometry, "odom"), bench.publisher(Imu, "imu/data")
        bench.feed(publisher, walk[:HALF])
        bench.until(lambda: len(odometry) == HALF, "the first half")
        started[victim].kill()
        bench.feed(publisher, walk[HALF : HALF + 100])
        stack.enter_context(node_process(victim, space, logs / "again.log", node__idle_s=0.5))
        bench.feed(publisher, walk[HALF + 100 :])
        bench.until(lambda: stamps(odometry[-1:]) == stamps(walk[-1:]), "the last sample")
    return odometry, walk


def test_every_sample_gets_an_estimate(heard):
    odometry, walk = heard
    assert set(stamps(odometry)) == set(stamps(walk))


def test_no_estimate_is_nan(heard):
    for column in joined([nav_block(m) for m in heard[0]]):
        assert np.isfinite(column).all()


def test_no_step_is_walked_twice(heard):
    end = heard[0][-1].pose.pose.position
    assert end.x == pytest.approx(STRIDES * STRIDE_M, rel=0.05)
    assert end.y == pytest.approx(0.0, abs=0.2)
