"""The samples of a stride: bounded memory, whatever comes."""

from itertools import pairwise

import numpy as np
import pytest

from pdr_core.gait import foot_events
from pdr_core.gait.samples import LIMIT, SAMPLE, Buffer, row_of, stood_from, without_middle
from pdr_core.gait.stride_analysis import WAITING, StrideAnalysis
from pdr_core.records import NavBlock, StanceBlock, StepEvent, inertial_block, part

PERIOD_NS = 5_000_000


def blocks(n, first=0, standing=True, stamp_ns=None):
    """A foot at rest, sample numbers from `first` on."""
    stamp_ns = (first + np.arange(n)) * PERIOD_NS if stamp_ns is None else stamp_ns
    quat, rows = np.tile([0.0, 0.0, 0.0, 1.0], (n, 1)), np.zeros((n, 3))
    imu = inertial_block(stamp_ns, rows, np.tile([0.0, 0.0, 9.8], (n, 1)), np.zeros(n), np.zeros(n))
    stance = np.full(n, standing)
    judged = StanceBlock(imu, stance, np.ones(n), np.full(n, 30.0), np.zeros(n), rows, np.zeros(n))
    matrices = np.zeros((n, 6, 6))
    return judged, NavBlock(stamp_ns, rows, quat, rows, rows, matrices, matrices)


def step(first, last, displacement_m=(1.0, 0.0, 0.0), index=1):
    ends = (first * PERIOD_NS, last * PERIOD_NS)
    return StepEvent(
        index, *ends, np.zeros(3), np.array(displacement_m), np.eye(3), 0.0, 0.0, sample_numbers=(first, last)
    )


def test_a_long_rest_takes_no_more_memory_than_its_ends():
    buffer, piece = Buffer(), 3000
    for first in range(0, 40 * LIMIT, piece):
        buffer.add(*blocks(piece, first))
        buffer.forget()
        assert len(buffer._room) <= 6 * LIMIT
    assert row_of(buffer._kept, 5) == 5
    last = 40 * LIMIT - 10
    assert buffer._kept[row_of(buffer._kept, last)]["number"] == last


def test_what_comes_before_the_stance_of_the_last_stride_goes():
    """One second of it stays, in which the foot is stillest somewhere."""
    buffer = Buffer()
    buffer.add(*blocks(1000))
    buffer.take(step(100, 700))
    buffer.forget()
    assert buffer._kept["number"].tolist() == list(range(500, 1000))


def test_what_was_left_out_is_no_gap_unless_there_was_one():
    for hole, seen in ((False, True), (True, False)):
        whole = np.zeros(3 * LIMIT, SAMPLE)
        whole["number"], whole["seen"] = np.arange(3 * LIMIT), True
        whole["seen"][LIMIT] = not hole
        kept = without_middle(whole)
        assert len(kept) == LIMIT
        assert np.flatnonzero(~kept["seen"]).tolist() == ([] if seen else [LIMIT // 2])
        assert kept["number"].tolist() == [*range(LIMIT // 2), *range(3 * LIMIT - LIMIT // 2, 3 * LIMIT)]


def test_strides_that_wait_for_the_walking_direction_are_not_many():
    analysis, given = StrideAnalysis(), 0
    for i in range(3 * WAITING):
        given += len(analysis.run(*blocks(200, 200 * i), [step(200 * i, 200 * i + 150, index=i)]))
        assert len(analysis._waiting) <= WAITING
    assert given == 2 * WAITING
    assert given + len(analysis.finish()) == 3 * WAITING


def test_the_last_second_of_a_stance_is_kept_with_its_short_interruptions():
    samples = np.zeros(500, SAMPLE)
    samples["stamp_ns"], samples["standing"] = np.arange(500) * PERIOD_NS, True
    assert stood_from(samples, 450) == 250
    samples["standing"][380:410] = False  # 0.15 s
    assert stood_from(samples, 450) == 250
    samples["standing"][370:415] = False  # 0.225 s
    assert stood_from(samples, 450) == 415


@pytest.mark.parametrize("what", ["gap", "back", "gyro"])
def test_gaps_jumps_back_and_a_gyro_that_is_off_are_seen(what):
    judged, nav = blocks(100)
    stamps = nav.stamp_ns.copy()
    stamps[50:] += {"gap": 150_000_000, "back": -100_000_000, "gyro": 0}[what]
    judged, nav = blocks(100, stamp_ns=stamps)
    judged.imu.gyro_sd_radps[50] = -1.0 if what == "gyro" else 0.0
    for cuts in ([0, 100], [0, 50, 100], [0, 49, 51, 100]):
        buffer = Buffer()
        for start, stop in pairwise(cuts):
            buffer.add(part(judged, start, stop), part(nav, start, stop))
        assert np.flatnonzero(~buffer._kept["seen"]).tolist() == [50]
        assert not foot_events.marks(buffer.take(step(10, 90))).seen


def test_a_step_within_one_sample_is_no_accident():
    analysis = StrideAnalysis()
    assert analysis.run(*blocks(10), [step(5, 5)]) == []
    (stride,) = analysis.finish()
    assert (stride.duration_s, stride.swing_s, stride.pitch_max_rad) == (None, None, None)
