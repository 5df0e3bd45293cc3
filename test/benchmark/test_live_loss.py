"""A minute live through separate processes: is every sample in the recording, and how late? (--full)"""

import os
from pathlib import Path

import numpy as np
import pytest
from rosbags.highlevel import AnyReader

from pdr_core.params import Params, changed
from pdr_core.rate_limit import RateLimit
from pdr_core.simulation import simulated_walk
from support.processes import pdr

LENGTH_M = 40.8  # a rectangle of 34 strides: a minute
ODOM_HZ = Params().node.odom_rate_hz
START_S = 5.0  # a node that starts late gets what was said before
TOPICS = ("imu/data_raw", "stance", "odom")
full = pytest.mark.skipif(os.environ.get("PDR_FULL") != "1", reason="long figures: `pdr test --full`")


def heard(bag: Path, topic: str) -> tuple[np.ndarray, np.ndarray]:
    """Return the header stamps of a topic's messages and when the recorder got them, (n,) [ns] each."""
    with AnyReader([bag]) as reader:
        connections = [c for c in reader.connections if c.topic.strip("/") == topic]
        messages = [(reader.deserialize(raw, c.msgtype), at) for c, at, raw in reader.messages(connections=connections)]
    headers = [message.imu.header if hasattr(message, "imu") else message.header for message, _ in messages]
    stamps = [header.stamp.sec * 10**9 + header.stamp.nanosec for header in headers]
    return np.array(stamps, np.int64), np.array([at for _, at in messages], np.int64)


@full
@pytest.mark.usefixtures("ros_environment")
@pytest.mark.parametrize("rate_hz", [200.0, 1000.0])
def test_a_minute_live_loses_nothing(tmp_path: Path, rate_hz: float) -> None:
    params = changed(Params(), "simulation", walk_length_m=LENGTH_M, sample_rate_hz=rate_hz)
    sent_ns = simulated_walk(params.simulation, params.place).imu.stamp_ns
    assert sent_ns[-1] - sent_ns[0] > 59e9
    (tmp_path / "params.yaml").write_text(f"/**: {{ros__parameters: {{simulation: {{sample_rate_hz: {rate_hz}}}}}}}")
    run = pdr("demo", "--length", LENGTH_M, "--params", tmp_path / "params.yaml", "--out", tmp_path / "out")
    assert run.returncode == 0, run.stderr
    received = {topic: heard(tmp_path / "out" / "recording", topic) for topic in TOPICS}
    stamps = {topic: stamp_ns - received["imu/data_raw"][0][0] for topic, (stamp_ns, _) in received.items()}
    wanted = dict.fromkeys(TOPICS, sent_ns) | {"odom": sent_ns[RateLimit(ODOM_HZ).allowed(sent_ns)]}
    for topic in TOPICS:
        print(f"\n{topic:<14}{len(stamps[topic]):>7} of {len(wanted[topic])} samples", end="")
    for start, stop in (("imu/data_raw", "stance"), ("stance", "odom"), ("imu/data_raw", "odom")):
        print(f"\n{start} -> {stop}: {later_ms(received[start], received[stop])}", end="")
    for topic in TOPICS:
        assert np.array_equal(stamps[topic], wanted[topic]), topic


def later_ms(start: tuple[np.ndarray, np.ndarray], stop: tuple[np.ndarray, np.ndarray]) -> str:
    """Say how much later the second of two topics came; up to the verdict, the detector's own waiting is in it."""
    stamp_ns, before, after = np.intersect1d(start[0], stop[0], return_indices=True)
    late_ms = (stop[1][after] - start[1][before]) / 1e6
    starting = stamp_ns - start[0][0] < START_S * 1e9
    p50, p99 = np.percentile(late_ms[~starting], [50, 99])
    return f"p50 {p50:.1f} ms, p99 {p99:.1f} ms; while the nodes start, at most {late_ms[starting].max():.0f} ms"
