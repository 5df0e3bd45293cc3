"""The helpers of the nodes that need no graph: rate limit, repeats, notices as values."""

import numpy as np
import pytest

from pdr_core.rate_limit import RateLimit
from pdr_core.records import Level, Notice
from pdr_nodes import throttle
from pdr_nodes.notice_board import notices_from, status
from pdr_nodes.repeats import Repeats

MS = 1_000_000
SECOND = 1000 * MS


def evenly(rate_hz, seconds, begin_ns=0):
    return begin_ns + np.arange(round(rate_hz * seconds), dtype=np.int64) * round(SECOND / rate_hz)


def test_a_sensor_of_just_that_rate_loses_nothing_however_its_stamps_scatter():
    rng = np.random.default_rng(1)
    stamps = np.sort(evenly(200.0, 30.0) + rng.integers(-6 * MS, 6 * MS, 6000))
    assert RateLimit(200.0).allowed(stamps) == list(range(6000))


@pytest.mark.parametrize("rate_hz", [400.0, 1000.0, 2000.0])
def test_a_faster_sensor_is_thinned_evenly(rate_hz):
    stamps = evenly(rate_hz, 10.0)
    sent = stamps[RateLimit(200.0).allowed(stamps)]
    at_the_start = np.searchsorted(sent, SECOND // 10)
    assert set(np.diff(sent[at_the_start:])) == {5 * MS}
    assert len(sent) <= 200 * 10 + 5


def test_the_same_samples_are_sent_however_they_come():
    stamps = evenly(1000.0, 2.0)
    whole, one_by_one = RateLimit(150.0), RateLimit(150.0)
    assert whole.allowed(stamps) == [i for i, at_ns in enumerate(stamps.tolist()) if one_by_one.allows(at_ns)]


def test_a_clock_that_jumps_back_does_not_stop_the_estimates():
    limit, stamps = RateLimit(100.0), evenly(100.0, 1.0, begin_ns=100 * SECOND)
    assert len(limit.allowed(stamps)) == 100
    assert limit.allowed(stamps - 50 * SECOND) == list(range(100))


def test_only_what_is_said_again_by_a_new_publisher_is_left_out():
    there = {"first"}
    repeats = Repeats(lambda: frozenset(there))

    def new(stamps):
        return [at_ns for at_ns in stamps if not repeats.has(at_ns)]

    assert new(range(100)) == list(range(100))
    assert new(range(100)) == list(range(100)), "a loop of the same publisher"
    there = {"second"}
    assert new(range(100)) == []
    assert new(range(100)) == list(range(100)), "a loop of the second one"
    there = {"third"}
    assert new(range(50, 150)) == list(range(100, 150))
    repeats.expect()
    assert new(range(200)) == list(range(150, 200))


def test_notices_are_read_back_exactly():
    notices = [
        Notice(Level.WARN, "gap", "samples are missing: 2 x 0.1 s", 3, 17),
        Notice(Level.ERROR, "accel_unit", "set intake.accel_unit to g", 1, -4),
    ]
    said = status("imu_ingestion: samples", notices, "as it should be")
    assert notices_from(said.values) == notices
    assert (said.level, said.message) == (b"\x02", "set intake.accel_unit to g")


def test_without_notices_all_is_well():
    said = status("imu_ingestion: samples", [], "as it should be")
    assert (said.level, said.message, said.values) == (b"\x00", "as it should be", [])


def test_without_acknowledgement_only_so_many_samples_leave_in_a_while(monkeypatch):
    now_s = [100.0]
    monkeypatch.setattr(throttle.time, "monotonic", lambda: now_s[0])
    gate, left = throttle.Throttle(None, "odom"), []
    now_s[0] += 60.0  # the subscribers took their time
    for stamp_ns in range(10 * throttle.ON_THEIR_WAY):
        if gate.wait_s(stamp_ns) == 0.0:
            gate.sent(stamp_ns)
            left.append(now_s[0])
        else:
            now_s[0] += 0.01
    windows = np.histogram(left, bins=np.arange(160.0, now_s[0] + throttle.STALLED_S, throttle.STALLED_S))[0]
    assert len(left) > throttle.ON_THEIR_WAY
    assert windows.max() <= throttle.ON_THEIR_WAY
    assert [notice.kind for notice in gate.notices] == ["not_acknowledged"]
