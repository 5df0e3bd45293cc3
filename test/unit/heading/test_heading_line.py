"""A line's own offset beside the filter's yaw: against the same two unknowns in one Kalman filter."""

import math

import numpy as np
import pytest
from heading_cases import YawFilter
from scipy.stats import chi2

from pdr_core.heading.line import Heading, Line

NOISE_RAD2 = np.radians(2.0) ** 2


class Both:
    """Yaw error and offset of the line in one filter; the yaw grows by a random walk."""

    def __init__(self, yaw_rad2: float, offset_rad2: float) -> None:
        self.mean = np.zeros(2)
        self.P = np.diag([yaw_rad2, offset_rad2])

    def take(self, r: float, noise_rad2: float) -> None:
        h = np.ones(2)
        gain = self.P @ h / (h @ self.P @ h + noise_rad2)
        self.mean = self.mean + gain * (r - h @ self.mean)
        self.P = self.P - np.outer(gain, h @ self.P)


@pytest.mark.parametrize("offset_deg", [0.0, 4.0, 5729.0])
@pytest.mark.parametrize("walk_deg", [0.0, 0.5])
def test_the_filter_is_told_what_it_would_know_if_it_carried_the_line_too(offset_deg: float, walk_deg: float) -> None:
    rng = np.random.default_rng(1)
    yaw_rad2, offset_rad2, walk_rad2 = np.radians(3.0) ** 2, np.radians(offset_deg) ** 2, np.radians(walk_deg) ** 2
    both, line = Both(yaw_rad2, offset_rad2), Line(0.0, offset_rad2)
    P, turned = yaw_rad2, 0.0  # of a filter that knows the yaw alone
    true = np.array([np.radians(2.0), np.radians(min(offset_deg, 5.0))])
    for _ in range(25):
        true[0] += math.sqrt(walk_rad2) * rng.standard_normal()
        both.P[0, 0] += walk_rad2
        P += walk_rad2
        heading = true.sum() + math.sqrt(NOISE_RAD2) * rng.standard_normal()
        both.take(heading, NOISE_RAD2)
        told = line.told(Heading(heading - turned, NOISE_RAD2, P))
        if told:
            gain = P / (P + told.sd_rad**2)
            turned += gain * told.error_rad
            P *= 1.0 - gain
        assert turned == pytest.approx(both.mean[0], abs=2e-4)
        assert pytest.approx(both.P[0, 0], rel=2e-3) == P
    assert line.variance_rad2 == pytest.approx(both.P[1, 1], rel=2e-3)


def test_a_line_counts_once_however_long_it_is() -> None:
    line, P = Line(0.0, np.radians(4.0) ** 2), np.radians(5.0) ** 2
    for _ in range(200):
        told = line.told(Heading(0.05, NOISE_RAD2, P))
        P = P * told.sd_rad**2 / (P + told.sd_rad**2) if told else P
    assert np.degrees(np.sqrt(P)) == pytest.approx(5.0 * 4.0 / np.hypot(5.0, 4.0), rel=0.01)


def test_a_new_line_says_nothing_at_first_and_then_holds_its_direction() -> None:
    line, P = Line(1.0), np.radians(5.0) ** 2
    assert line.told(Heading(1.0, NOISE_RAD2, P)) is None
    assert line.told(Heading(1.02, NOISE_RAD2, P)) is None  # the yaw has not become less sure since
    told = line.told(Heading(1.02, NOISE_RAD2, P + np.radians(1.0) ** 2))
    assert told is not None
    assert told.error_rad > 0.0


def test_the_gate_keeps_out_what_is_off_and_what_may_be_the_next_direction() -> None:
    line = Line(0.0, np.radians(2.0) ** 2, np.pi / 2.0)
    seen = Heading(np.radians(4.0), np.radians(1.0) ** 2, np.radians(1.0) ** 2)
    assert line.fits(seen, 4.0)
    assert line.fits(seen._replace(heading_rad=np.radians(94.0)), 4.0)
    assert not line.fits(seen._replace(heading_rad=np.radians(6.0)), 4.0)
    assert not line.fits(seen._replace(yaw_variance_rad2=np.radians(25.0) ** 2), 4.0)


def test_a_yaw_that_somebody_else_has_made_sure_is_not_made_unsure() -> None:
    line = Line(0.0)
    line.told(Heading(0.0, NOISE_RAD2, np.radians(10.0) ** 2))
    for sd_deg in (0.01, 3.0, 0.5):
        told = line.told(Heading(0.02, NOISE_RAD2, np.radians(sd_deg) ** 2))
        assert told is None or (math.isfinite(told.error_rad) and told.sd_rad > 0.0)


def test_what_the_filter_believes_is_true_over_many_walks() -> None:
    """NEES of the yaw over lines of unknown direction and of directions that they are off: within both bounds."""
    rng, runs, walk_rad, own_rad = np.random.default_rng(7), 500, np.radians(0.4), np.radians(4.0)
    nees = []
    for _ in range(runs):
        yaw = YawFilter(np.radians(1.0), walk_rad, np.radians(1.0) * rng.standard_normal())
        for unknown in [True, False] * 3:
            offset_rad = own_rad * rng.standard_normal()
            line = Line(yaw.error_rad + offset_rad) if unknown else Line(0.0, own_rad**2)
            for _ in range(15):
                yaw.go_on(walk_rad * rng.standard_normal())
                heading_rad = yaw.error_rad + offset_rad + math.sqrt(NOISE_RAD2) * rng.standard_normal()
                told = line.told(Heading(heading_rad, NOISE_RAD2, yaw.variance_rad2))
                if told:
                    yaw.take(*told)
        nees.append(yaw.error_rad**2 / yaw.variance_rad2)
    low, high = chi2.ppf([0.025, 0.975], runs) / runs
    assert low <= np.mean(nees) <= high
