"""Paper 004's experiment: its walks, its figures, and some repetitions of it."""

import numpy as np
import pytest

from pdr_core.bench.dual_tables import WALKS, dual_walks, repeated, row
from pdr_core.bench.dual_walks import DualTrial, DualWalk, FootTrack, both_together, dual_walk, each_alone, tracks
from pdr_core.params import Params, SimulationParams
from pdr_core.simulation import simulated_feet

SEEDS = 3


def straight(errors="mirrored", seed=0, length_m=76.0):
    return DualTrial("straight", length_m, errors, seed)


def made_up(end_m):
    return FootTrack(np.array([[0.0, 0.0], end_m]), np.zeros((2, 2)), np.zeros(0), np.zeros(0))


def test_the_walk_is_that_of_the_paper_and_the_rest_has_turns_and_curves():
    assert WALKS[0] == ("straight", 76.0)
    assert {name for name, _ in WALKS} == {"straight", "corridor", "rectangle", "curve"}
    assert straight().simulation.feet_independent == 0.3


@pytest.mark.parametrize(("errors", "sign"), [("mirrored", -1.0), ("alike", 1.0)])
def test_alone_the_feet_drift_apart_or_to_the_same_side(errors, sign):
    ends = []
    for seed in range(SEEDS):
        walks = simulated_feet(straight(errors, seed).simulation)
        found = tracks(walks, each_alone(walks, Params()))
        ends.append([foot.end_error_m[1] for foot in found.values()])
        drift_deg = [np.degrees(foot.heading_error_rad[-5:].mean()) for foot in found.values()]
        assert 1.0 < drift_deg[0] < 4.0
        assert 1.0 < sign * drift_deg[1] < 4.0
        assert all(abs(foot.heading_error_rad[:3].mean()) < np.radians(0.5) for foot in found.values())
    mean_m = np.mean(ends, axis=0)
    assert 1.0 < mean_m[0] < 2.5
    assert sign * mean_m[1] == pytest.approx(mean_m[0], abs=0.8)


@pytest.mark.parametrize(("errors", "most"), [("mirrored", 0.6), ("alike", 1.05)])
def test_together_the_feet_go_straight_and_errors_that_are_alike_are_not_made_worse(errors, most):
    found = row([dual_walk(straight(errors, seed)) for seed in range(SEEDS)])
    assert found.end_error_alone_m > 1.0
    assert found.ratio <= most


def test_a_wide_curve_without_errors_is_left_as_it_is():
    wide = SimulationParams(walk="curve", walk_length_m=300.0, sensor_model="ideal", placement_sd_m=0.0)
    walks = simulated_feet(wide)
    for foot in tracks(walks, both_together(walks, Params())).values():
        assert np.linalg.norm(foot.position_m - foot.truth_m, axis=1).max() < 0.01
        assert np.degrees(np.abs(foot.heading_error_rad).max()) < 0.01


def test_a_track_begins_where_the_foot_stood_and_as_it_stood():
    walk = simulated_feet(straight(length_m=6.0).simulation)
    found = tracks(walk, each_alone(walk, Params()))
    for foot, y_m in zip(found.values(), (0.1, -0.1), strict=True):
        np.testing.assert_allclose(foot.position_m[0], [0.0, y_m], atol=1e-3)
        np.testing.assert_allclose(foot.position_m, foot.truth_m, atol=0.06)
        assert len(foot.stride_s) == len(foot.heading_error_rad)


def test_the_figures_of_a_row():
    walks = [
        DualWalk(straight(seed=seed), {"left": made_up([0.0, 3.0]), "right": made_up([4.0, 0.0])}, together)
        for seed, together in enumerate([{"left": made_up([0.0, y]), "right": made_up([0.0, -y])} for y in (0.5, 1.5)])
    ]
    r = row(walks)
    assert (r.end_error_alone_m, r.end_error_together_m, r.worst_alone_m, r.worst_together_m) == (3.5, 1.0, 4.0, 1.5)
    assert r.ratio == pytest.approx(1.0 / 3.5)
    assert r.lateral_m["left"] == pytest.approx((1.0, np.sqrt(0.5)))
    assert r.lateral_m["right"] == pytest.approx((-1.0, np.sqrt(0.5)))
    assert r.lateral_bound_m("left") == pytest.approx(1.0)
    assert repeated(walks) == [walks]


def test_every_walk_is_walked_with_both_kinds_of_errors(monkeypatch):
    monkeypatch.setattr("pdr_core.bench.dual_tables.WALKS", (("straight", 6.0), ("curve", 12.0)))
    seen = []
    walks = dual_walks(2, seen.append)
    found = [row(each) for each in repeated(walks)]
    assert [(r.walk, r.straight, r.errors, r.repetitions) for r in found] == [
        ("straight, 6 m", True, "mirrored", 2),
        ("straight, 6 m", True, "alike", 2),
        ("curve, 12 m", False, "mirrored", 2),
        ("curve, 12 m", False, "alike", 2),
    ]
    assert seen[0] == "straight, 6 m, errors mirrored, 1 of 2"
    assert [w.trial.seed for w in walks[-2:]] == [0, 1]
