"""Samples and fields through the processes of one foot give what the core alone makes of them, to the last bit."""

import json

import numpy as np
import pytest
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, MagneticField

from pdr_bringup_scripts.live.chain import NODES, Chain
from pdr_bringup_scripts.live.live_recording import messages
from pdr_core.params import Params, changed, params_as_mapping
from pdr_core.pipeline import FootInertial
from pdr_core.recording import open_recording
from pdr_core.records import joined, length
from pdr_msgs.msg import StanceImu
from pdr_nodes.convert import nav_block, stance_block
from support.bench import Bench
from support.processes import pdr
from support.walks import field_messages, imu_messages, magnetic_walk

STRIDES = 3
FULL_SPEED_S = 10.0  # so much, by stamps, one topic may be ahead of the other where all is said at once
pytestmark = pytest.mark.usefixtures("ros_environment")


@pytest.fixture(scope="module")
def outputs(tmp_path_factory):
    """The verdicts and estimates of a walk with a magnetometer: live, and of the core alone."""
    patient = {"field_wait_s": FULL_SPEED_S, "idle_s": FULL_SPEED_S}  # a machine that is busy is no stream that ended
    params = changed(Params(), "node", magnetometer=True, input_reliable=True, **patient)
    walk = magnetic_walk(STRIDES, 200.0)
    logs = tmp_path_factory.mktemp("logs")
    with Chain(logs, params_as_mapping(params), "magnetic", NODES) as chain, Bench(namespace="magnetic") as bench:
        verdicts, odometry = bench.hear(StanceImu, "stance"), bench.hear(Odometry, "odom")
        fields, samples = bench.publisher(MagneticField, "imu/mag"), bench.publisher(Imu, "imu/data_raw")
        by_stamp = {(m.header.stamp.sec, m.header.stamp.nanosec): m for m in field_messages(walk)}
        for message in imu_messages(walk):
            if field := by_stamp.get((message.header.stamp.sec, message.header.stamp.nanosec)):
                fields.publish(field)
            samples.publish(message)
        everything = [length(walk)] * 2
        bench.until(lambda: [len(verdicts), len(odometry)] == everything, "a verdict and an estimate for each sample")
        chain.check()
    alone = FootInertial(params)
    expected = alone.run(walk), alone.finish()
    judged, nav = (joined([getattr(output, name) for output in expected]) for name in ("judged", "nav"))
    return (joined([stance_block(m) for m in verdicts]), judged), (joined([nav_block(m) for m in odometry]), nav)


@pytest.fixture(scope="module", params=[0, 4])
def replay(request, tmp_path_factory):
    """A recording with a magnetometer of half the rate, and the folder of its replay: at full speed, and at a pace."""
    folder = tmp_path_factory.mktemp("replay")
    walk = "simulation: {magnetometer_rate_hz: 100.0, walk: straight}"
    (folder / "mine.yaml").write_text(f"/**: {{ros__parameters: {{{walk}}}}}\n")
    recording, mine = folder / "walk.mcap", ("--params", folder / "mine.yaml")
    for command in (
        ("simulate", "--magnetometer", "--length", 3.6, *mine, "--out", recording),
        ("replay", recording, "--rate", request.param, "--out", folder / "live"),
    ):
        answer = pdr(*command)
        assert answer.returncode == 0, answer.stderr
    return recording, folder / "live"


def all_samples(recording):
    (sensor,) = open_recording(recording).sensors.values()
    return joined(list(sensor.pieces()))


def test_every_field_reaches_the_filter(outputs):
    live, alone = outputs[0]
    for column, wanted in zip(live.imu, alone.imu, strict=True):
        np.testing.assert_array_equal(column, wanted)
    assert 0.8 < np.mean(live.imu.field_sd_tesla > 0.0) < 0.9


def test_every_estimate_is_the_same(outputs):
    for column, wanted in zip(*outputs[1], strict=True):
        np.testing.assert_array_equal(column, wanted)
    assert np.hypot(*outputs[1][0].position_m[-1, :2]) == pytest.approx(1.2 * STRIDES, rel=0.05)


def test_a_replay_records_every_field_that_it_plays(replay):
    recording, live = replay
    played = all_samples(recording)
    for column, wanted in zip(all_samples(live / "recording"), played, strict=True):
        np.testing.assert_array_equal(column, wanted)
    assert np.mean(played.field_sd_tesla >= 0.0) == pytest.approx(0.5, abs=0.01)
    said = json.loads((live / "result.json").read_text())["notices"]
    late = "waiting"  # a node of a busy machine that has started before the one it hears
    assert [(n["level"], n["kind"]) for n in said if n["kind"] != late] == [("OK", "field_use")]


def test_a_replay_gives_the_filter_every_field_that_it_plays(replay):
    recording, live = replay
    alone = FootInertial(Params())
    wanted = joined([alone.run(all_samples(recording)).judged, alone.finish().judged])
    judged = joined([stance_block(m) for m in messages(live / "recording", "stance")])
    for column, expected in zip(judged.imu, wanted.imu, strict=True):
        np.testing.assert_array_equal(column, expected)
    for column, expected in zip(judged[1:], wanted[1:], strict=True):
        np.testing.assert_array_equal(column, np.minimum(expected, np.finfo(float).max))
