"""A recording, as if its gyro had been switched: what the driver would have given, sample by sample."""

from itertools import pairwise

import numpy as np
import pytest

from pdr_core.conventions import NANOSECONDS
from pdr_core.maths.thinning import thinned
from pdr_core.records import length, part
from pdr_core.records_power import Outcome
from support.switched import FULL_HZ, RATE_HZ, SETTLE_S, command, driven, recording


def test_without_commands_the_samples_are_as_they_were():
    imu = recording()
    out, _, switch = driven([imu], {})
    assert all(np.array_equal(a, b) for a, b in zip(out, imu, strict=True))
    assert switch.full_rate_hz == pytest.approx(RATE_HZ)


def test_the_gyro_is_not_measured_from_the_acknowledged_stamp_until_it_has_settled_again():
    out, answers, _ = driven([recording()])
    off, on, off_again, on_again = (answer.effective_ns for answer in answers)
    settle_ns = round(SETTLE_S * NANOSECONDS)
    t = out.stamp_ns
    expected = (t < off) | ((t >= on + settle_ns) & (t < off_again)) | (t >= on_again + settle_ns)
    assert np.array_equal(out.gyro_sd_radps >= 0.0, expected)
    assert not out.gyro_radps[~expected].any()
    assert all(answer.outcome is Outcome.ACKNOWLEDGED for answer in answers)
    assert all(answer.settling_s == SETTLE_S for answer in answers)


def test_the_rate_is_lowered_and_filtered_from_the_acknowledged_stamp_on():
    imu = recording()
    out, answers, switch = driven([imu])
    first, second, third, fourth = (answer.effective_ns for answer in answers)
    steps = np.diff(out.stamp_ns)
    assert set(steps[(out.stamp_ns[:-1] >= first) & (out.stamp_ns[1:] < second)]) == {20_000_000}
    assert set(steps[(out.stamp_ns[:-1] >= third) & (out.stamp_ns[1:] < fourth)]) == {10_000_000}
    at = int(np.searchsorted(imu.stamp_ns, first))
    wanted = thinned(imu, at, at + 40, 4)
    got = part(out, int(np.searchsorted(out.stamp_ns, first)))
    assert np.array_equal(got.accel_mps2[:10], wanted.accel_mps2)
    assert np.array_equal(got.accel_sd_mps2[:10], wanted.accel_sd_mps2)
    assert [round(s.rate_hz) for s in switch.states] == [50, 200, 100, 200]
    assert [s.gyro_on for s in switch.states] == [False, True, False, True]


@pytest.mark.parametrize("pieces", [1, 7, 240, 1200])
def test_however_the_recording_is_cut_the_driver_gives_the_same(pieces):
    imu = recording()
    whole, answers, _ = driven([imu])
    cuts = np.linspace(0, length(imu), pieces + 1).astype(int)
    cut, cut_answers, _ = driven([part(imu, a, b) for a, b in pairwise(cuts)])
    assert all(np.array_equal(a, b) for a, b in zip(cut, whole, strict=True))
    assert cut_answers == answers


def test_a_command_for_later_holds_from_its_stamp_on():
    imu = recording()
    later_ns = int(imu.stamp_ns[777])
    out, (answer,), _ = driven([imu], {1.0: command(1, False, FULL_HZ, later_ns)})
    assert answer.effective_ns == later_ns
    assert np.array_equal(out.gyro_sd_radps < 0.0, out.stamp_ns >= later_ns)


@pytest.mark.parametrize("jump_ns", [-3600 * NANOSECONDS, 3600 * NANOSECONDS])
def test_a_clock_that_jumps_loses_no_sample(jump_ns):
    imu = recording()
    stamps = imu.stamp_ns.copy()
    stamps[600:] += jump_ns
    out, _, _ = driven([imu._replace(stamp_ns=stamps)], {})
    assert np.array_equal(out.stamp_ns, stamps)


def test_stamps_that_stand_still_pass_too():
    imu = recording()
    out, _, _ = driven([imu._replace(stamp_ns=np.full(length(imu), 5))], {})
    assert length(out) == length(imu)


def test_after_a_clock_that_jumps_back_the_gyro_can_still_be_switched():
    imu = recording()
    stamps = imu.stamp_ns.copy()
    stamps[700:] -= 3600 * NANOSECONDS
    early = {1.0: command(1, False), 3.4: command(2, True, FULL_HZ, int(stamps[690]))}
    out, _, _ = driven([imu._replace(stamp_ns=stamps)], early)
    measured = out.gyro_sd_radps >= 0.0
    assert not measured[300:690].any()
    assert measured[-1]
    assert 0 < np.flatnonzero(~measured)[-1] - 700 < 20
