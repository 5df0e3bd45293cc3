"""What a line tells the filter is what one filter of both, yaw error and offset of the line, would make of it."""

import numpy as np
import pytest

from pdr_core.heading.line import Heading, Line


@pytest.mark.parametrize(("line_rad2", "growth_rad2"), [(1e4, 1e-4), (1e-3, 0.0), (1e-3, 1e-4), (0.0, 2e-5)])
def test_estimate_and_variance_are_those_of_a_filter_with_two_states(line_rad2, growth_rad2):
    rng, noise, direction = np.random.default_rng(1), 4e-4, 0.3
    line, P_yaw, turned = Line(direction, line_rad2), 9e-4, 0.0  # turned: what the filter has turned its track by
    P, x = np.diag([P_yaw, line_rad2]), np.zeros(2)
    H = np.array([[1.0, 1.0]])
    for _ in range(20):
        heading = direction + 0.05 * rng.standard_normal()
        told = line.told(Heading(heading + turned, noise, P_yaw))
        K = P @ H.T / (H @ P @ H.T + noise)
        x, P = x + K[:, 0] * (heading - direction - x.sum()), (np.eye(2) - K @ H) @ P
        if told:
            gain = P_yaw / (P_yaw + told.sd_rad**2)
            turned, P_yaw = turned - gain * told.error_rad, P_yaw * (1.0 - gain)
        assert turned == pytest.approx(-x[0], abs=1e-6)
        assert pytest.approx(P[0, 0], rel=1e-4) == P_yaw
        P[0, 0], P_yaw = P[0, 0] + growth_rad2, P_yaw + growth_rad2
