import numpy as np
import pytest

from pdr_core.evaluation.detector_curves import STRETCHES, detector_curves, envelope, true_speed
from pdr_core.records import Truth, TruthKind

N = 100_000
PERIOD_NS = 5_000_000
START_NS = 1_700_000_000_000_000_000


def moving(n=400, speed_mps=1.5):
    stamp_ns = START_NS + PERIOD_NS * np.arange(n)
    position_m = np.zeros((n, 3))
    position_m[:, 1] = speed_mps * PERIOD_NS * 1e-9 * np.arange(n)
    return stamp_ns, position_m


def test_a_thinned_curve_loses_no_spike():
    time_s, value = np.arange(N) * 0.005, np.random.default_rng(1).normal(size=N)
    value[[777, 50_001]] = 40.0, -40.0
    thin = envelope(time_s, value)
    assert len(thin.value) <= 2 * STRETCHES
    assert (np.diff(thin.time_s) > 0.0).all()
    assert {(0.005 * 777, 40.0), (0.005 * 50_001, -40.0)} <= set(zip(thin.time_s, thin.value, strict=True))


def test_what_is_not_finite_interrupts_the_curve():
    value = np.ones(N)
    value[40_000:60_000] = np.inf
    thin = envelope(np.arange(N) * 1.0, value)
    gap = np.isnan(thin.value)
    assert 0.15 * STRETCHES < gap.sum() < 0.25 * STRETCHES
    assert thin.time_s[gap].min() == pytest.approx(40_000, abs=N / STRETCHES)
    assert thin.time_s[gap].max() == pytest.approx(60_000, abs=N / STRETCHES)
    assert np.array_equal(np.isnan(envelope(np.arange(3.0), np.array([1.0, np.inf, 2.0])).value), [False, True, False])


def test_a_fixed_threshold_is_two_points_and_stances_have_both_ends(make):
    stamp_ns = START_NS + PERIOD_NS * np.arange(8)
    free = make.stance_block(stamp_ns, [1, 1, 0, 0, 1, 0, 0, 1])
    gated = make.stance_block(stamp_ns, [1, 1, 0, 0, 0, 0, 0, 1])
    curves = detector_curves("glrt", {"none": free, "kmeans": gated})
    assert curves.threshold.time_s.tolist() == [0.0, 0.035]
    assert curves.threshold.value.tolist() == [30.0, 30.0]
    assert curves.stance_s["none"] == pytest.approx(np.array([[0.0, 0.01], [0.02, 0.025], [0.035, 0.035]]))
    assert curves.stance_s["kmeans"] == pytest.approx(np.array([[0.0, 0.01], [0.035, 0.035]]))


def test_the_true_speed_is_that_of_the_foot():
    stamp_ns, position_m = moving()
    speed = true_speed(Truth(TruthKind.POSITION, stamp_ns, position_m), START_NS)
    assert speed.value == pytest.approx(1.5)
    assert speed.time_s[0] == pytest.approx(0.01)
    assert (np.diff(speed.time_s) > 0.0).all()


def test_the_true_speed_has_a_gap_where_motion_capture_lost_the_foot():
    stamp_ns, position_m = moving()
    position_m[200:240] = position_m[200]
    speed = true_speed(Truth(TruthKind.POSITION, stamp_ns, position_m), START_NS)
    lost = np.isnan(speed.value)
    assert speed.value[~lost] == pytest.approx(1.5)
    assert speed.time_s[lost].min() == pytest.approx(0.99)
    assert speed.time_s[lost].max() == pytest.approx(1.205, abs=0.006)


@pytest.mark.parametrize("kind", [TruthKind.STRIDES, TruthKind.CLOSED_LOOP])
def test_no_curve_where_the_path_is_not_known(kind):
    assert true_speed(Truth(kind, np.empty(0, np.int64), np.zeros((3, 2))), 0) is None
    assert true_speed(None, 0) is None
