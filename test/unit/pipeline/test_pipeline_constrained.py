"""One foot with the heading constraint of its parameters."""

from itertools import pairwise

import numpy as np
import pytest

from pdr_core.params import Params, changed
from pdr_core.pipeline import ConstrainedFoot, FootInertial
from pdr_core.records import joined, part
from support.walks import straight_walk


def drifting():
    """A straight walk of 40 strides whose gyro drifts by 0.2 deg/s once it moves."""
    imu = straight_walk(40).imu
    moving = imu.stamp_ns - imu.stamp_ns[0] > 3_000_000_000
    return imu._replace(gyro_radps=imu.gyro_radps + np.outer(moving, [0.0, 0.0, np.radians(0.2)]))


def with_constraint(name: str) -> Params:
    return changed(Params(), "heading", constraint=name)


def test_without_a_constraint_it_is_the_same_foot_to_the_last_bit() -> None:
    imu = drifting()
    plain, constrained = FootInertial(Params()), ConstrainedFoot(Params())
    assert np.array_equal(plain.run(imu).nav.position_m, constrained.run(imu).nav.position_m)
    assert plain.notices == constrained.notices


@pytest.mark.parametrize("name", ["dominant", "hde", "ihde", "learned"])
def test_a_drift_is_taken_off_and_the_gyro_bias_learns_it(name: str) -> None:
    imu, params = drifting(), with_constraint(name)
    before, after = ConstrainedFoot(Params()), ConstrainedFoot(params)
    off_m = [abs(foot.run(imu).nav.position_m[-1, 1]) for foot in (before, after)]
    assert off_m[1] < 0.5 * off_m[0]
    bias_degps = np.degrees(after.state.gyro_bias_radps[2])
    assert 0.1 < bias_degps < 0.25
    assert after.state.P[14, 14] < before.state.P[14, 14]
    assert [n.kind for n in after.notices if n.kind.startswith("heading")] == ["heading_on", "heading_held"]


@pytest.mark.parametrize("pieces", [1, 7])
def test_pieces_of_any_length_give_the_same_track(pieces: int) -> None:
    imu, whole, cut = drifting(), ConstrainedFoot(with_constraint("hde")), ConstrainedFoot(with_constraint("hde"))
    expected = joined([whole.run(imu).nav, whole.finish().nav])
    borders = np.linspace(0, len(imu.stamp_ns), pieces + 1).astype(int)
    navs = [cut.run(part(imu, a, b)).nav for a, b in pairwise(borders)]
    assert np.array_equal(joined([*navs, cut.finish().nav]).position_m, expected.position_m)
