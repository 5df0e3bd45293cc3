"""What `pdr live` says when nothing comes, as seen on the graph."""

from types import SimpleNamespace

import pytest
import rclpy
from sensor_msgs.msg import Imu, MagneticField

from pdr_bringup_scripts.live import live_run
from pdr_bringup_scripts.live.live_run import START_S, Watch, listen_until_quiet
from pdr_bringup_scripts.live.relay import DriverTopics, Relay
from pdr_bringup_scripts.problems import Problem
from support.bench import Bench

pytestmark = pytest.mark.usefixtures("ros_environment")


@pytest.fixture
def bench():
    with Bench() as bench:
        bench.heard = []
        bench.relay = Relay(bench.me, DriverTopics("/your/imu", "", False), lambda *what: bench.heard.append(what))
        yield bench


def test_others_that_would_do_are_named(bench):
    bench.me.create_publisher(Imu, "/left/imu", 10)
    bench.until(lambda: "/left/imu" in bench.relay.why_silent(), "the topic that would do")
    assert "nobody publishes it in ROS domain" in bench.relay.why_silent()


def test_a_wrong_type_is_told(bench):
    with rclpy.context.Context() as others:  # ROS allows one type per topic and participant
        node = rclpy.create_node("other", context=others)
        node.create_publisher(MagneticField, "/your/imu", 10)
        text = "it is published as sensor_msgs/msg/MagneticField, not as sensor_msgs/msg/Imu"
        bench.until(lambda: text in bench.relay.why_silent(), "the type")
        node.destroy_node()


def test_a_silent_publisher_is_told(bench):
    bench.me.create_publisher(Imu, "/your/imu", 10)
    bench.until(lambda: "its publisher is there but sends nothing" in bench.relay.why_silent(), "the publisher")


def test_what_comes_is_passed_on_until_it_is_closed(bench):
    passed = bench.hear(Imu, "imu/data_raw")
    publisher = bench.publisher(Imu, "/your/imu", 10)
    publisher.publish(Imu())
    bench.until(lambda: passed and bench.heard, "a sample")
    bench.relay.close()
    publisher.publish(Imu())
    for _ in range(10):
        bench.spin()
    assert (len(passed), len(bench.heard)) == (1, 1)
    assert bench.heard[0][:2] == ("imu/data_raw", "sensor_msgs/msg/Imu")


@pytest.mark.parametrize("quiet_s", [6.5, 30.5])
def test_nodes_that_have_said_all_are_told_from_nodes_that_say_nothing(quiet_s, tmp_path):
    """Played at a fifth of its speed a pair of feet is quiet for longer than others ever are."""
    silence, chains = Silence(), SimpleNamespace(drivers_are_done=True, check=lambda: None)
    listen_until_quiet(silence, chains, silence, quiet_s, tmp_path)
    assert silence.quiet_s == pytest.approx(quiet_s, abs=0.11)
    chains.drivers_are_done = False
    with pytest.raises(Problem, match="nothing has come from the nodes"):
        listen_until_quiet(silence, chains, silence, quiet_s, tmp_path)


def test_silence_counts_from_the_end_of_the_drivers(tmp_path):
    """A pause before it is none that a node takes for the end: what waits is given out only after it."""
    silence, chains = Silence(), SimpleNamespace(drivers_are_done=False, check=lambda: None)
    silence.at(25.0, lambda: setattr(chains, "drivers_are_done", True))
    listen_until_quiet(silence, chains, silence, 6.5, tmp_path)
    assert silence.now_s == pytest.approx(31.5, abs=0.21)


def test_nodes_that_are_still_starting_are_not_silent(monkeypatch):
    now_s = [100.0]
    clock = SimpleNamespace(monotonic=lambda: now_s[0], time_ns=lambda: 0)
    monkeypatch.setattr(live_run, "time", clock)
    watch = Watch(lambda *_: None, lambda _: None, "")
    now_s[0] += START_S + 5.0
    assert watch.quiet_s == 5.0
    watch.take("odom", "nav_msgs/msg/Odometry", b"")
    assert watch.quiet_s == 0.0
    now_s[0] += 5.0
    assert watch.quiet_s == 5.0


class Silence:
    """Hears nothing, and knows for how long."""

    def __init__(self):
        self.now_s, self.quiet_s, self._due = 0.0, 0.0, []

    def at(self, when_s, call):
        self._due.append((when_s, call))

    def listen(self, seconds):
        self.now_s, self.quiet_s = self.now_s + seconds, self.quiet_s + seconds
        for when_s, call in self._due:
            if self.now_s >= when_s:
                call()

    def begin_anew(self):
        self.quiet_s = 0.0
