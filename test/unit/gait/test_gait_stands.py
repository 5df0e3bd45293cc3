"""Where a foot stands, by the accelerometer alone."""

from itertools import pairwise

import numpy as np
import pytest
from dead_reckoning_cases import judged_without_gyro, left_foot

from pdr_core.gait.stands import Stands
from pdr_core.maths.quaternion import matrix
from pdr_core.params import DeadReckoningParams
from pdr_core.records import joined, length, part

PARAMS = DeadReckoningParams()


def found(block, cuts=()):
    stands, out = Stands(PARAMS), []
    for first, last in pairwise([0, *cuts, length(block)]):
        out += stands.run(part(block, first, last))
    return out + stands.finish()


@pytest.fixture(scope="module")
def walk():
    return left_foot(length_m=30.0, sensor="consumer", shock_mps2=40.0)


@pytest.fixture(scope="module")
def block(walk):
    return judged_without_gyro(walk.imu)


def test_each_stride_ends_in_one_stand(walk, block):
    stands = found(block)
    swings = np.count_nonzero(np.diff(walk.motion.stance.astype(int)) == -1)
    assert len(stands) == swings + 1
    assert all(walk.motion.stance[np.searchsorted(walk.imu.stamp_ns, s.stamp_ns)] for s in stands)
    assert stands[0].impulse_mps is None
    assert all(s.impulse_mps is not None for s in stands[1:])


@pytest.mark.parametrize("rate_hz", [20.0, 50.0, 400.0])
def test_at_any_rate(rate_hz):
    walk = left_foot(length_m=30.0, sensor="consumer", sample_rate_hz=rate_hz)
    swings = np.count_nonzero(np.diff(walk.motion.stance.astype(int)) == -1)
    assert len(found(judged_without_gyro(walk.imu))) == swings + 1


def test_up_and_the_field_are_those_of_the_foot(walk, block):
    for stand in found(block):
        R = matrix(walk.motion.quat_xyzw[np.searchsorted(walk.imu.stamp_ns, stand.stamp_ns)])
        up = stand.force_mps2 / np.linalg.norm(stand.force_mps2)
        assert np.degrees(np.arccos(min(1.0, up @ R[2]))) < 2.0
        earth = R @ stand.field_tesla
        assert abs(np.degrees(np.arctan2(earth[0], earth[1]))) < 2.0


def test_pieces_change_nothing(block):
    whole = found(block)
    for pieces in (7, 301):
        cut = found(block, range(pieces, length(block), pieces))
        assert [s.stamp_ns for s in cut] == [s.stamp_ns for s in whole]
        for one, other in zip(cut, whole, strict=True):
            np.testing.assert_array_equal(one.force_mps2, other.force_mps2)
            np.testing.assert_array_equal(one.impulse_mps, other.impulse_mps)


def test_a_gap_or_a_clock_that_jumps_back_hides_the_swing(block):
    n = length(block)
    gap = joined([part(block, 0, n // 2 - 30), part(block, n // 2 + 30)])
    assert sum(s.impulse_mps is None for s in found(gap)) == 2
    assert len(found(gap)) >= len(found(block)) - 1
    again = joined([block, block])
    assert len(found(again)) == 2 * len(found(block))
    assert sum(s.impulse_mps is None for s in found(again)) == 2


def test_forces_that_are_no_numbers_are_no_impulse(block):
    stands = found(block)
    bad = np.searchsorted(block.imu.stamp_ns, stands[3].stamp_ns) + round(0.6 * 200)
    block.imu.accel_mps2[bad] = np.nan
    unknown = [i for i, s in enumerate(found(block)) if s.impulse_mps is None]
    assert unknown == [0, 4]


def test_a_standing_person_is_one_stand():
    still = left_foot(walk="still", sensor="consumer")
    assert len(found(judged_without_gyro(still.imu))) == 1


def test_a_swing_longer_than_any_has_no_impulse(block):
    """A runner does not stand: what is summed up since he stood last is no push of a stride."""
    rows = slice(*np.searchsorted(block.imu.stamp_ns, block.imu.stamp_ns[0] + np.array([6, 16]) * 1_000_000_000))
    stance = block.stance.copy()
    stance[rows] = False
    hidden = block._replace(stance=stance)
    before = {s.stamp_ns for s in found(hidden) if s.impulse_mps is not None}
    stands = found(hidden)
    gap = next(b for a, b in pairwise(stands) if b.stamp_ns - a.stamp_ns > 5_000_000_000)
    assert gap.impulse_mps is None
    assert len(before) == len(stands) - 2  # that one, and the first
    assert [s.stamp_ns for s in found(hidden, range(100, length(block), 100))] == [s.stamp_ns for s in stands]
