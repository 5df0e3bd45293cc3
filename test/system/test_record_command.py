"""`pdr record` leaves what the nodes heard, how they were set and what they said, also when it is killed."""

import json
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import rclpy
from mcap.reader import make_reader
from nav_msgs.msg import Odometry
from rclpy.serialization import deserialize_message

from pdr_bringup_scripts.live.chain import Chain
from pdr_bringup_scripts.live.graph import OurNode, spoken
from pdr_bringup_scripts.live.listener import Ears
from pdr_core.params import Params, changed, params_as_mapping
from pdr_core.recording import open_recording
from pdr_core.recording.tum import read_tum
from pdr_nodes.convert import numbers, stamp_ns
from support.processes import END_S, check_refused, pdr
from support.walks import straight_walk, write_csv

HOME, LOSS_S, TOLERANCE, LEAST = "me/here", 1.0, 1e-9, 900
MOUNTED = changed(changed(Params(), "intake", mounting_yaw_rad=0.3), "filter", gate=25.0, initial_yaw_rad=1.0)
WALK = changed(
    MOUNTED, "simulation", motion="smooth", walk="curve", walk_length_m=12.0, sample_rate_hz=100.0, mounting_yaw_rad=0.3
)
pytestmark = pytest.mark.usefixtures("ros_environment")


class Estimates:
    """What was published, as one who only listens knows it: stamp [ns], place [m], time of arrival [s]."""

    def __init__(self):
        self.rows = []

    def take(self, _topic, _name, cdr):
        odometry = deserialize_message(cdr, Odometry)
        place = numbers(odometry.pose.pose.position)
        self.rows.append((stamp_ns(odometry.header.stamp), *place, time.monotonic()))

    def until(self, moment_s):
        """Stamps and places of what came until then."""
        rows = [row for row in self.rows if row[-1] <= moment_s]
        return np.array([row[0] for row in rows], np.int64), np.array([row[1:4] for row in rows])


def recorder(*arguments):
    command = [sys.executable, "-m", "pdr_bringup_scripts", "record", "--namespace", HOME, *map(str, arguments)]
    return subprocess.Popen(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def listen_until(ears, chain, condition):
    deadline_s = time.monotonic() + END_S
    while not condition():
        assert time.monotonic() < deadline_s
        ears.listen(0.05)
        chain.check()


@pytest.fixture(scope="module")
def killed(tmp_path_factory):
    """A walk in whose middle one recorder is killed, and another that is asked to end once the nodes have gone.

    The folder, what was published, when each recorder ended and what it said.
    """
    folder, said = tmp_path_factory.mktemp("record"), Estimates()
    asked, ends_s = [recorder("--out", folder / f"{name}.mcap") for name in ("killed", "ended")], []
    chain = Chain(folder / "nodes", params_as_mapping(changed(WALK, "driver", subscribers=3)), HOME)
    try:
        with Ears(said.take, HOME, {"odom": "nav_msgs/msg/Odometry"}) as ears, chain:
            listen_until(ears, chain, lambda: len(said.rows) > LEAST)
            asked[0].kill()
            ends_s.append(time.monotonic())
            listen_until(ears, chain, lambda: chain.driver_is_done)
        time.sleep(1.0)  # the recorder sees them go
        asked[1].send_signal(signal.SIGINT)
        ends_s.append(time.monotonic())
        words = [process.communicate(timeout=END_S) for process in asked]
    finally:
        for process in asked:
            process.kill()
            process.wait(END_S)
    return folder, said, ends_s, words


def check_contains(again, stamps, places_m):
    """Assert that a trajectory holds all that was published, and that this was a walk."""
    assert len(stamps) > LEAST - 120
    assert np.ptp(places_m, axis=0)[:2].min() > 0.5
    rows = np.searchsorted(again.stamp_ns, stamps)
    assert rows.max() < len(again.stamp_ns)
    np.testing.assert_array_equal(again.stamp_ns[rows], stamps)
    np.testing.assert_allclose(again.position_m[rows], places_m, rtol=0.0, atol=TOLERANCE)


@pytest.fixture(scope="module", params=["killed", "ended"])
def again(request, killed, tmp_path_factory):
    """What `pdr run` makes of a recording: its folder, and when the recorder ended."""
    out = tmp_path_factory.mktemp("again")
    answer = pdr("run", killed[0] / f"{request.param}.mcap", "--as-recorded", "--out", out)
    assert answer.returncode == 0, answer.stderr
    return out, killed[2][("killed", "ended").index(request.param)]


def test_what_was_published_until_a_second_before_comes_out_again(killed, again):
    out, end_s = again
    check_contains(read_tum(out / "trajectory.tum"), *killed[1].until(end_s - LOSS_S))


def test_the_recorded_parameters_are_those_of_the_nodes(again):
    config = json.loads((again[0] / "result.json").read_text())["config"]
    for group in ("intake", "place", "stance", "detectors", "filter"):
        assert config[group] == params_as_mapping(MOUNTED)[group]


def test_parameters_of_a_file_or_of_the_recording(killed, tmp_path):
    recording = killed[0] / "killed.mcap"
    check_refused(pdr("run", recording, "--as-recorded", "--params", tmp_path / "x"), "leave out --params")


def test_a_killed_recording_says_so_and_an_ended_one_is_whole(killed):
    folder, _, _, words = killed
    kinds = {}
    for name in ("killed", "ended"):
        session = open_recording(folder / f"{name}.mcap")
        assert sum(len(piece.stamp_ns) for piece in session.sensors["imu"].pieces()) > LEAST - 120
        kinds[name] = {notice.kind for notice in session.notices}
    assert kinds == {"killed": {"damaged_recording"}, "ended": set()}
    assert words[1][0].startswith("Recorded ")
    assert f"pdr run {folder / 'ended.mcap'} --as-recorded" in words[1][0]


def test_at_no_time_would_a_kill_have_cost_more_than_a_second(killed):
    with (killed[0] / "ended.mcap").open("rb") as file:
        chunks = make_reader(file).get_summary().chunk_indexes
    spans_s = [(chunk.message_end_time - chunk.message_start_time) / 1e9 for chunk in chunks]
    assert len(spans_s) > 10
    assert max(spans_s) < LOSS_S


def test_a_killed_recording_can_be_replayed_as_it_was(killed, tmp_path):
    folder, said, ends_s, _ = killed
    answer = pdr(
        "replay", folder / "killed.mcap", "--as-recorded", "--rate", 0, "--out", tmp_path / "live", "--namespace", HOME
    )
    assert answer.returncode == 0, answer.stderr
    check_contains(read_tum(tmp_path / "live" / "trajectory.tum"), *said.until(ends_s[0] - LOSS_S))


def test_parameters_are_asked_of_what_has_none(tmp_path):
    walk = write_csv(tmp_path / "walk.csv", straight_walk(1).imu)
    check_refused(pdr("run", walk, "--as-recorded"), "walk.csv holds no parameters", "leave out --as-recorded")


def test_nothing_to_record_is_one_sentence_and_no_file(tmp_path):
    with rclpy.context.Context() as others:
        node = rclpy.create_node("zupt_ekf", namespace="/somebody/else", context=others)
        answer = pdr("record", "--namespace", HOME, "--duration", 4, "--out", tmp_path / "walk.mcap")
        node.destroy_node()
    check_refused(
        answer, f"no samples of nodes in namespace /{HOME}; nodes of pdr are in ", "/somebody/else", "--namespace"
    )
    assert list(tmp_path.iterdir()) == []


class Graph:
    """Two nodes of `pdr live` with a driver of ours, which publishes where the user's own would."""

    def get_publisher_names_and_types_by_node(self, name, _):
        said = {"imu_driver": "/imu/data_raw", "imu_ingestion": "/pdr/imu/data"}
        return [(said[name], ["sensor_msgs/msg/Imu"])]

    def get_subscriber_names_and_types_by_node(self, name, _):
        return [("/pdr/imu/data_raw", ["sensor_msgs/msg/Imu"])] if name == "imu_ingestion" else []


def test_the_raw_input_is_what_the_ingestion_hears_and_nothing_beside_it():
    """Or every sample would be recorded twice, under one name."""
    found = spoken(Graph(), [OurNode("imu_driver", "pdr"), OurNode("imu_ingestion", "pdr")], "pdr")
    assert {s.topic: s.address for s in found.values()} == {
        "imu/data_raw": "/pdr/imu/data_raw",
        "imu/data": "/pdr/imu/data",
    }
    assert len(found) == 2


def test_no_recording_is_overwritten(tmp_path):
    (tmp_path / "walk.mcap").write_text("mine")
    check_refused(pdr("record", "--out", tmp_path / "walk.mcap"), "exists already", "--out")
    check_refused(pdr("record", "--out", tmp_path / "walk.bag"), "ends in .mcap")
    assert (tmp_path / "walk.mcap").read_text() == "mine"
