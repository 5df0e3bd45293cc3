"""Ingestion with a magnetometer: each sample goes out with its field, and without one where none comes."""

import math
from contextlib import contextmanager
from itertools import count
from types import SimpleNamespace

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Imu, MagneticField
from std_msgs.msg import Header

from pdr_core.intake import Ingestion
from pdr_core.params import Params
from pdr_core.records import Level, joined, length
from pdr_msgs.msg import MargSample
from pdr_nodes import catch_up, idle
from pdr_nodes.convert import field_block, marg_block, time_message
from pdr_nodes.imu_ingestion_node import ImuIngestionNode
from pdr_nodes.notice_board import notices_from
from pdr_nodes.qos import OWN, STATUS
from support.bench import DEADLINE_S, Bench
from support.walks import field_messages, imu_messages, magnetic_walk, stamps

WALK = magnetic_walk(1)
SAMPLES, FIELDS = imu_messages(WALK), field_messages(WALK)
HAS_FIELD = WALK.field_sd_tesla >= 0.0
BEST_EFFORT = QoSProfile(depth=1000, reliability=ReliabilityPolicy.BEST_EFFORT)
LATE = 5  # samples: 50 ms


class Fed:
    """A node with the streams of a foreign driver in the hands of the test, and all that it says."""

    def __init__(self, bench, qos):
        self.bench = bench
        self.out, self.margs = bench.hear(Imu, "imu/data"), bench.hear(MargSample, "imu/marg")
        self.diagnostics = bench.hear(DiagnosticArray, "/diagnostics", STATUS)
        self.imu, self.mag = bench.publisher(Imu, "imu/data_raw", qos), bench.publisher(MagneticField, "imu/mag", qos)

    def feed(self, samples, fields):
        """Publish both streams in the order of what is given with them."""
        events = [(at, self.imu, m) for at, m in samples] + [(at, self.mag, m) for at, m in fields]
        for _, publisher, message in sorted(events, key=lambda event: event[0]):
            publisher.publish(message)
            if publisher is self.imu:
                self.bench.spin()

    def heard(self, wanted=0):
        """All samples, or so many, that came out with their fields, as a block."""
        wanted = wanted or len(SAMPLES)
        self.bench.until(lambda: len(self.margs) >= wanted, f"{wanted} samples")
        return joined([marg_block(m) for m in self.margs])

    def told(self, what):
        """The latest of what the node says is wrong: {kind: notice}."""
        named = f"/imu_ingestion: {what}"
        status = [s for m in self.diagnostics for s in m.status if s.name.endswith(named)][-1:]
        return {notice.kind: notice for s in status for notice in notices_from(s.values)}

    def told_within(self, what, kind):
        """The notice of a kind, once it is said."""
        self.bench.until(lambda: kind in self.told(what), f"{kind} on /diagnostics", 5.0)
        return self.told(what)[kind]


@contextmanager
def fed(qos=BEST_EFFORT, **params):
    with Bench(ImuIngestionNode, node__magnetometer=True, **{"node__idle_s": 0.4} | params) as bench:
        yield Fed(bench, qos)


def at(messages, late_ns=0):
    """The messages, each with the moment at which it comes."""
    return [(stamp_ns + late_ns, m) for stamp_ns, m in zip(stamps(messages), messages, strict=True)]


def check_fields(block, there=HAS_FIELD):
    """Assert that just these samples have a field, that it is theirs, and that nothing else has changed."""
    expected = Ingestion(Params().intake).run(WALK)
    np.testing.assert_array_equal(block.stamp_ns, expected.stamp_ns)
    np.testing.assert_array_equal(block.gyro_radps, expected.gyro_radps)
    np.testing.assert_array_equal(block.field_sd_tesla >= 0.0, there)
    np.testing.assert_array_equal(block.field_tesla[there], expected.field_tesla[there])
    np.testing.assert_array_equal(block.field_sd_tesla[there], expected.field_sd_tesla[there])
    assert not block.field_tesla[~there].any()


@pytest.mark.parametrize("late", [-LATE, 0, LATE])
def test_each_sample_goes_out_with_its_field_whichever_comes_first(late):
    with fed() as node:
        node.feed(at(SAMPLES), at(FIELDS, late * 10_000_000))
        check_fields(node.heard())
        assert stamps(node.out) == stamps(SAMPLES)
        assert [m.imu for m in node.margs] == node.out
        assert all(m.orientation_covariance[0] > 0.0 for m in node.out)
        assert {m.imu.header.frame_id for m in node.margs} == {"foot"}
        assert node.told("samples") == {}


def test_without_a_magnetometer_nobody_listens_to_one():
    with Bench(ImuIngestionNode) as bench:
        out = bench.hear(Imu, "imu/data")
        bench.feed(bench.publisher(Imu, "imu/data_raw"), SAMPLES)
        bench.until(lambda: len(out) == len(SAMPLES), "all samples")
        assert bench.me.count_subscribers("imu/mag") == bench.me.count_publishers("imu/marg") == 0


def test_a_magnetometer_that_never_says_anything_is_named_and_no_sample_is_lost():
    with fed() as node:
        node.feed(at(SAMPLES), [])
        check_fields(node.heard(), np.zeros(len(SAMPLES), np.bool_))
        said = node.told_within("streams", "no_field")
    assert said.level is Level.WARN
    assert f"no field on /{node.bench.namespace}/imu/mag for 2 s: is it published?" in said.text
    assert "node.magnetometer: false" in said.text


def test_a_magnetometer_that_falls_silent_and_is_started_again_costs_only_what_it_did_not_say():
    silent = (np.arange(len(SAMPLES)) > 150) & (np.arange(len(SAMPLES)) < 350)
    before = [m for m in FIELDS if stamps([m])[0] <= stamps(SAMPLES)[150]]
    after = [m for m in FIELDS if stamps([m])[0] >= stamps(SAMPLES)[350]]
    with fed(OWN, node__input_reliable=True) as node:
        node.feed(at(SAMPLES[:160]), at(before))
        node.bench.me.destroy_publisher(node.mag)
        node.feed(at(SAMPLES[160:340]), [])
        node.mag = node.bench.publisher(MagneticField, "imu/mag", OWN)
        node.feed(at(SAMPLES[340:]), at(before[-20:], 10**9) + at(after))
        check_fields(node.heard(), HAS_FIELD & ~silent)
        assert node.told_within("samples", "field_silent").level is Level.WARN


def test_a_field_that_is_none_or_no_number_leaves_its_sample_without_and_one_that_comes_twice_counts_once():
    bad = field_messages(WALK)
    for message in bad[100:120]:
        message.magnetic_field.y = math.nan
    for message in bad[200:210]:
        message.magnetic_field_covariance[0] = -1.0
    without = np.flatnonzero(HAS_FIELD)[np.r_[100:120, 200:210]]
    there = HAS_FIELD.copy()
    there[without] = False
    with fed() as node:
        node.feed(at(SAMPLES), sorted(at(bad) + at(bad[:90], 1), key=lambda event: event[0]))
        check_fields(node.heard(), there)


def test_a_clock_of_its_own_is_named_and_no_sample_is_lost():
    other = field_messages(WALK)
    for message in other:
        message.header.stamp.sec = 1000 + message.header.stamp.sec % 1000
    with fed() as node:
        node.feed(at(SAMPLES), [(when, m) for (when, _), m in zip(at(FIELDS), other, strict=True)])
        check_fields(node.heard(), np.zeros(len(SAMPLES), np.bool_))
        assert "check the magnetometer and its stamps" in node.told_within("samples", "field_silent").text


def test_both_clocks_that_jump_back_go_on_together():
    jump_ns, early = 10**11, WALK._replace(stamp_ns=WALK.stamp_ns - 10**11)
    samples, fields = imu_messages(early), field_messages(early)
    with fed() as node:
        node.feed(at(SAMPLES) + at(samples, 2 * jump_ns), at(FIELDS) + at(fields, 2 * jump_ns))
        block = node.heard(2 * len(SAMPLES))
    np.testing.assert_array_equal(block.stamp_ns, np.concatenate([WALK.stamp_ns, early.stamp_ns]))
    lost = np.flatnonzero((block.field_sd_tesla >= 0.0) != np.tile(HAS_FIELD, 2))
    assert all(abs(i - len(SAMPLES)) <= 2 for i in lost), lost


def test_a_slower_magnetometer_holds_nothing_up():
    slow = HAS_FIELD & (np.arange(len(SAMPLES)) % 4 == 0)
    fields = field_messages(WALK._replace(field_sd_tesla=np.where(slow, 3e-7, -1.0)))
    with fed(node__idle_s=60.0, node__field_wait_s=10.0) as node:
        node.feed(at(SAMPLES), at(fields))
        block = node.heard(len(SAMPLES) - LATE)
    np.testing.assert_array_equal(block.field_sd_tesla >= 0.0, slow[: length(block)])


def test_a_magnetometer_that_goes_on_alone_does_not_keep_the_last_samples_waiting(monkeypatch):
    now_s, later = [0.0], (time_message(int(WALK.stamp_ns[-1]) + i * 10_000_000) for i in count(1))
    monkeypatch.setattr(idle, "time", SimpleNamespace(monotonic=lambda: now_s[0]))
    with fed() as node:
        node.feed(at(SAMPLES), at(FIELDS[:-1]))
        node.heard(len(SAMPLES) - 1)
        for _ in range(5):  # what is under way comes: the last sample, which waits
            node.bench.spin()
        assert len(node.margs) == len(SAMPLES) - 1
        now_s[0] += 1.0

        def all_came():
            node.mag.publish(MagneticField(header=Header(stamp=next(later))))
            return len(node.margs) == len(SAMPLES)

        node.bench.until(all_came, "the last sample", 10.0)


def test_one_who_joins_late_pairs_what_the_topics_remember(monkeypatch):
    """The samples come in one go, longer than each waits for its field, and the fields in two after them."""
    monkeypatch.setattr(catch_up, "START_S", DEADLINE_S)
    with fed(OWN, node__input_reliable=True, node__idle_s=60.0) as node:
        node.bench.node.trigger_deactivate()
        node.bench.feed(node.mag, FIELDS[:10])
        node.bench.feed(node.imu, SAMPLES)
        node.bench.node.trigger_activate()
        start = node.bench.node._fields._start
        node.bench.until(lambda: length(start._held) > len(SAMPLES) - 30, "the samples")
        node.bench.feed(node.mag, FIELDS[10:])
        node.bench.until(lambda: start._other_ns == stamps(FIELDS)[-1], "the fields")
        node.bench.node._finish()
        check_fields(node.heard())


@pytest.mark.parametrize("covariance", [math.nan, math.inf, 0.0])
def test_a_field_whose_noise_nobody_knows_is_a_field(covariance):
    message = field_messages(WALK)[0]
    message.magnetic_field_covariance[0] = covariance
    assert field_block(message).field_sd_tesla.tolist() == [0.0]
