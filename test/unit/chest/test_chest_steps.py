"""Steps from the acceleration, and how long they should be."""

import numpy as np
import pytest

from pdr_core.chest.step_length import best_share
from pdr_core.params import ChestParams, SimulationParams
from pdr_core.simulation.walk import course
from support.chest import estimated, params, walk


def falls_s(seed, length_m=24.0):
    settings = SimulationParams(motion="chest", walk="rectangle", walk_length_m=length_m, seed=seed)
    return course(settings).strikes_s


@pytest.mark.parametrize("seed", range(1, 7))
def test_every_whole_step_is_found_once(seed):
    """The first footfall of each side begins a step, and the last one may be too soft: 4 sides."""
    _, steps, _ = estimated(walk(seed).imu)
    ends = np.array([s.stamp_ns for s in steps]) / 1e9
    apart = np.abs(ends[:, None] - falls_s(seed)).min(axis=1)
    stepping = apart < 0.25  # the others are steps on the spot, in a turn
    assert len(falls_s(seed)) - 12 <= stepping.sum() <= len(falls_s(seed)) - 4
    assert np.std(apart[stepping]) < 0.06


def test_steps_are_as_long_as_the_true_ones():
    true, errors = walk(3, 44.0), []
    _, steps, _ = estimated(true.imu)
    at = {int(ns): row for row, ns in enumerate(true.imu.stamp_ns)}
    for step in steps:
        moved = true.motion.position_m[at[step.stamp_ns]] - true.motion.position_m[at[step.start_ns]]
        if np.linalg.norm(moved[:2]) > 0.5:
            errors.append(step.length_m - np.linalg.norm(moved[:2]))
    assert len(errors) > 40
    assert abs(np.mean(errors)) < 0.02
    assert np.std(errors) < 0.04


def test_the_share_is_the_one_of_least_steady_error():
    """The recursion of step_length.py, drawn: no other share does better."""
    rng = np.random.default_rng(3)
    push, differ = 0.015 * rng.standard_normal((2000, 200)), 0.013 * rng.standard_normal((2000, 200))

    def left(share):
        error = np.zeros(2000)
        for k in range(200):
            error = error + push[:, k]
            error = error + share * (differ[:, k] - error)
        return np.std(error)

    best = best_share(0.015, 0.013)
    assert best == pytest.approx(ChestParams().step_share, abs=0.02)
    assert left(best) < min(left(best - 0.15), left(best + 0.15))


def test_no_step_is_compensated_without_a_first_length():
    """With s = 0 eq. 13 changes nothing."""
    none, zero = (estimated(walk(1).imu, p)[0] for p in (params(step_length="none"), params(step_share=0.0)))
    assert np.allclose(none.position_m, zero.position_m, atol=1e-9)


def test_with_s_of_1_all_uniform_steps_are_as_long_as_the_first_ones():
    steps = estimated(walk(1, 44.0).imu, params(step_share=1.0, step_direction="solved"))[1]
    lengths = np.array([step.length_m for step in steps[6:16]])
    assert np.ptp(lengths) < 1e-9
    assert 0.5 < lengths[0] < 0.9


def test_a_length_model_is_learnt_and_used():
    first, model = (estimated(walk(1).imu, params(step_length=kind))[0] for kind in ("first", "model"))
    assert not np.array_equal(first.position_m, model.position_m)
    assert np.linalg.norm(first.position_m[-1] - model.position_m[-1]) < 0.3
