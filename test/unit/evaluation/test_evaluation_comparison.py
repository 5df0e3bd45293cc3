import json

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.evaluation import alignment
from pdr_core.evaluation.association import interpolated, nearest
from pdr_core.evaluation.comparison import compare, in_words, segment_errors_m, spread
from pdr_core.evaluation.comparison_page import write_comparison
from pdr_core.records import Truth, TruthKind

STEP_NS = 250_000_000


def track(stamp_ns, position_m):
    return Truth(TruthKind.POSITION, np.asarray(stamp_ns, np.int64), np.asarray(position_m, float))


def two_tracks():
    """A truth of 40 rows and an estimate of every second one, 4 ms later, turned and bent."""
    t = np.arange(40) * 0.25
    truth_m = np.column_stack([np.cos(t), np.sin(2 * t), 0.1 * t])
    estimate_m = np.column_stack([1.02 * np.sin(2 * t), 0.03 * t - np.cos(t), 0.12 * t + 0.05 * np.cos(5 * t)])
    stamp_ns = np.arange(40) * STEP_NS
    return track(stamp_ns[::2] + 4_000_000, estimate_m[::2]), track(stamp_ns, truth_m)


def noisy_tracks(count=200, seed=4):
    """Rows of a track, and the same turned by a known rotation and moved, with noise."""
    rng = np.random.default_rng(seed)
    truth_m = np.cumsum(rng.normal(size=(count, 3)), axis=0)
    turn = Rotation.from_euler("zyx", [2.5, -0.7, 0.3])
    return turn, turn.inv().apply(truth_m - [3.0, -2.0, 1.0]), truth_m, rng.normal(size=(count, 3))


def test_the_error_is_what_evo_says():
    """Reference: evo 1.38.1, `evo_ape tum truth.tum estimate.tum -a` on these two tracks, full digits by its API."""
    result = compare(*nearest(*two_tracks(), within_ns=10_000_000))
    assert result.pairs == 20
    evo_m = (0.10448272996262484, 0.09386851973717036, 0.08082374723757012, 0.17635288644912195)
    assert result.ate_rigid == pytest.approx(evo_m, abs=1e-9)


def test_a_known_turn_and_shift_is_found():
    turn, estimate_m, truth_m, _ = noisy_tracks()
    found = alignment.rigid(estimate_m, truth_m)
    np.testing.assert_allclose(found.R_fixed_from_moving, turn.as_matrix(), atol=1e-12)
    np.testing.assert_allclose(found.shift_m, [3.0, -2.0, 1.0], atol=1e-11)
    assert compare(np.arange(200), estimate_m, truth_m).ate_rigid.rmse_m < 1e-12


@pytest.mark.parametrize("noise_m", [0.01, 0.3, 5.0])
def test_the_residual_is_the_one_of_an_independent_solver(noise_m):
    _, estimate_m, truth_m, noise = noisy_tracks()
    estimate_m = estimate_m + noise_m * noise
    _, rssd_m = Rotation.align_vectors(truth_m - truth_m.mean(axis=0), estimate_m - estimate_m.mean(axis=0))
    assert compare(np.arange(200), estimate_m, truth_m).ate_rigid.rmse_m == pytest.approx(
        rssd_m / np.sqrt(200), rel=1e-9
    )


def test_a_mirrored_track_is_not_turned_inside_out():
    _, estimate_m, truth_m, _ = noisy_tracks()
    found = alignment.rigid(estimate_m * [1, 1, -1], truth_m)
    assert np.linalg.det(found.R_fixed_from_moving) == pytest.approx(1.0)
    assert compare(np.arange(200), estimate_m * [1, 1, -1], truth_m).ate_rigid.rmse_m > 1.0


def test_a_tilt_counts_in_the_metrics_of_the_house_but_not_in_evos():
    _, _, truth_m, _ = noisy_tracks()
    result = compare(np.arange(200), Rotation.from_euler("x", 0.2).apply(truth_m), truth_m)
    assert result.ate_rigid.rmse_m < 1e-12
    assert result.ate3_m > 0.1


def test_each_row_takes_the_nearest_within_the_difference():
    estimate = track([0, 10, 20, 30, 40], np.arange(15).reshape(5, 3))
    truth = track([4, 25, 53], np.ones((3, 3)))
    stamp_ns, estimate_m, _ = nearest(estimate, truth, 5)
    assert stamp_ns.tolist() == [4, 25]
    assert estimate_m[:, 0].tolist() == [0.0, 6.0]
    assert nearest(estimate, truth, 13)[0].tolist() == [4, 25, 53]
    stamp_ns, estimate_m, truth_m = nearest(truth, estimate, 5)
    assert (stamp_ns.tolist(), len(estimate_m), truth_m[:, 0].tolist()) == ([0, 20], 2, [0.0, 6.0])


def test_rows_need_not_be_in_order():
    estimate, truth = track([30, 0, 20], [[3, 0, 0], [0, 0, 0], [2, 0, 0]]), track([21, 1], [[0, 0, 0]] * 2)
    assert nearest(estimate, truth, 5)[1][:, 0].tolist() == [2.0, 0.0]


def test_interpolation_gives_a_straight_line_exactly():
    estimate = track([0, 100, 400], [[0, 0, 0], [1, 2, 3], [4, 8, 12]])
    stamp_ns, estimate_m, truth_m = interpolated(estimate, track([-1, 50, 200, 401], np.zeros((4, 3))))
    assert stamp_ns.tolist() == [50, 200]
    np.testing.assert_allclose(estimate_m, [[0.5, 1.0, 1.5], [2.0, 4.0, 6.0]])
    assert truth_m.shape == (2, 3)


def test_a_track_that_is_too_long_is_so_in_each_metre():
    truth_m = np.column_stack([np.arange(0, 10.5, 0.05), np.zeros((210, 2))])
    np.testing.assert_allclose(segment_errors_m(1.1 * truth_m, truth_m), 0.1, atol=0.011)
    assert len(segment_errors_m(truth_m, truth_m)) == 10
    assert not segment_errors_m(truth_m, truth_m).any()


def test_distances_are_summed_up():
    assert spread(np.array([0.0, 3.0, 4.0, 0.0])) == pytest.approx((2.5, 1.75, 1.5, 4.0))
    assert np.isnan(spread(np.empty(0))).all()


def test_too_few_pairs_are_an_error():
    with pytest.raises(ValueError, match="only 2 pairs"):
        compare(np.arange(2), np.zeros((2, 3)), np.zeros((2, 3)))


def test_a_truth_that_does_not_move_has_no_error_per_metre():
    content = json.loads(compare(np.arange(5), np.zeros((5, 3)), np.zeros((5, 3))).to_json())
    assert content["rpe"] == dict.fromkeys(("rmse_m", "mean_m", "median_m", "max_m"))
    assert (content["pairs"], content["ate2_m"], content["ate_rigid"]["rmse_m"]) == (5, 0.0, 0.0)


def test_the_page_shows_both_tracks_and_needs_no_network(tmp_path):
    rows = nearest(*two_tracks(), within_ns=10_000_000)
    result = compare(*rows)
    write_comparison(tmp_path / "page.html", result, *rows)
    page = (tmp_path / "page.html").read_text()
    assert f"ATE2 {result.ate2_m:.3f} m" in page
    assert all(f'"name":"{name}"' in page for name in ("Truth", "Estimate", "Horizontal error", "Height error"))
    assert '<script src="http' not in page
    assert f"ATE2 {result.ate2_m:.4f} m" in in_words(result)
