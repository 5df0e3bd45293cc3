"""K: the paper's objective, its closed form and its search; and the real loop."""

import numpy as np
import pytest

from pdr_core.chest.loop_error import LoopNoise, best_gain_per_s, covariance, rms_rad
from pdr_core.chest.optimal_gain import (
    GainTheory,
    attitude_error_deg,
    closed_form,
    convergence_s,
    least_error_deg,
    least_gain,
    searched,
)
from pdr_core.params import ChestParams

PAPER_GRID = np.arange(0.00001, 1.0, 0.0001)
PAPER_OPTIMA = (1.3e-5, 4.3e-5, 1e-5)


@pytest.mark.parametrize("period_s", [0.3, 1.0, 3.0, 20.0, 300.0])
@pytest.mark.parametrize("gyro_degps", [0.01, 0.1412, 1.0])
def test_closed_form_and_bounded_search_agree(period_s, gyro_degps):
    theory = GainTheory(gyro_degps=gyro_degps, period_s=period_s)
    assert searched(theory) == pytest.approx(closed_form(theory), rel=0.01)


def test_the_closed_form_is_the_minimum_of_a_fine_grid():
    theory = GainTheory(period_s=20.0)
    gains = np.geomspace(1e-6, 1.0, 100_001)
    errors = attitude_error_deg(gains, theory)
    assert gains[errors.argmin()] == pytest.approx(closed_form(theory), rel=0.01)
    assert errors.min() == pytest.approx(least_error_deg(theory), rel=1e-9)


def test_the_papers_grid_holds_none_of_its_optima_but_the_first_point():
    far = [np.abs(PAPER_GRID - k).min() for k in PAPER_OPTIMA]
    assert [d > 1e-9 for d in far] == [True, True, False]
    periods = [np.sqrt(k) * 2.0 * np.pi * 16.5306 / 0.1412 for k in PAPER_OPTIMA]
    assert [closed_form(GainTheory(period_s=t)) for t in periods] == pytest.approx(list(PAPER_OPTIMA))
    assert np.ptp(periods) > 2.0  # three different periods of one walk


def test_the_bounds_hold():
    assert closed_form(GainTheory(period_s=1e4)) == 1.0  # eq. 19
    assert searched(GainTheory(), least=1e-3) == pytest.approx(1e-3, rel=1e-3)  # eq. 20


def test_convergence_is_that_of_the_recursion():
    for gain in (0.001, 0.05, 0.5):
        error, samples = 1.0, 0
        while error > 0.1:
            error, samples = error - error * gain, samples + 1
        assert convergence_s(np.array([gain]), 50.0, 0.1)[0] == pytest.approx(samples / 50.0)
    assert convergence_s(np.array([least_gain(50.0, 0.1, 8.0)]), 50.0, 0.1)[0] == pytest.approx(8.0, abs=0.02)


def test_the_loop_error_is_that_of_drawn_walks():
    noise, gain = LoopNoise(steps=12), 0.6
    rng = np.random.default_rng(1)
    drawn = rng.multivariate_normal(np.zeros(noise.steps + 5), covariance(noise), size=20_000).T
    bias, start, speed = drawn[0], drawn[1], drawn[2:]
    p = [start, start, start]
    for k in range(noise.steps):
        shown = (p[-1] + 2.0 * p[-2] + p[-3]) / 4.0 + (speed[k + 2] - speed[k]) / (2.0 * noise.step_s * 9.80665)
        p.append(p[-1] + noise.step_s * (bias - (gain * shown if k >= noise.start_steps else 0.0)))
    assert rms_rad(gain, noise) == pytest.approx(np.sqrt(np.mean(np.square(p[3:]))), rel=0.02)


def test_the_default_is_the_best_of_the_loop():
    assert ChestParams().feedback_per_s == pytest.approx(best_gain_per_s(LoopNoise()), rel=0.02)


def test_a_better_gyro_wants_less_feedback():
    assert best_gain_per_s(LoopNoise(bias_sd_radps=1e-4)) < 0.6 * best_gain_per_s(LoopNoise())
