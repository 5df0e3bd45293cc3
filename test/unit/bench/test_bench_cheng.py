"""Cheng's walks of few seeds: what is measured, and that the improved method is better."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.bench import cheng_gain, cheng_tables
from pdr_core.bench.cheng_tables import GainPoint, best, better_percent, gain_point, rows
from pdr_core.bench.cheng_walks import CASES_M, METHODS, PAPER_M, TABLE_2, by_every_method, taken_for_tilt, walk, walked
from pdr_core.chest.loop_error import LoopNoise, rms_rad
from pdr_core.params import ChestParams, Params, changed

SEEDS = range(1, 5)


@pytest.fixture(scope="module")
def case_4():
    return [one for seed in SEEDS for one in by_every_method(walk(4, seed))]


def test_the_cases_are_those_of_the_paper():
    assert CASES_M == (32.0, 44.0, 46.0, 48.0, 45.0)
    assert tuple(METHODS)[:3] == TABLE_2
    means = {name: np.mean(errors) for name, errors in PAPER_M.items()}
    assert 100.0 * (1.0 - means["ICFWSLC"] / means["PIWSLCS"]) == pytest.approx(61.0, abs=1.0)
    assert 100.0 * (1.0 - means["ICFWSLC"] / means["TCFWSLC"]) == pytest.approx(55.0, abs=1.0)


def test_the_improved_method_is_better_and_a_direction_better_still(case_4):
    ends = {r.method: r.end_error_m for r in rows([one.result for one in case_4]) if r.case == 0}
    assert ends["ICFWSLC"] < 0.7 * ends["PIWSLCS"]
    assert ends["ICFWSLC"] < 0.7 * ends["TCFWSLC"]
    assert ends["ICFWSLC, ahead"] < 0.7 * ends["ICFWSLC"]


def test_the_errors_are_those_of_the_equations(case_4):
    one = case_4[0]
    error_m = np.linalg.norm((one.estimate.position_m - one.truth.position_m)[:, :2], axis=1)
    assert one.result.end_error_m == pytest.approx(error_m[-1])  # eq. 23
    rows = np.searchsorted(one.estimate.time_s, one.falls_s)
    assert one.result.footfall_error_m == pytest.approx(np.sqrt(np.mean(error_m[rows] ** 2)))  # eq. 24
    assert one.result.end_error_percent == pytest.approx(100.0 * error_m[-1] / 48.0)


def test_the_bias_of_the_accelerometer_is_no_tilt_error():
    one = walk(1, 1)
    force = one.sim.imu.accel_mps2[:400].mean(axis=0)
    true = Rotation.from_quat(one.sim.motion.quat_xyzw[200])
    up = (true * taken_for_tilt(one)).apply(force)
    assert np.degrees(np.arccos(up[2] / np.linalg.norm(up))) < 0.4  # sway
    assert np.degrees(taken_for_tilt(one).magnitude()) > 0.1


def test_without_feedback_all_filters_are_the_same():
    walks = [walk(1, 2)]
    params = changed(Params(), "chest", **METHODS["PIWSLCS"])
    none = [gain_point(walks, method, 0.0) for method in ("improved", "traditional")]
    assert none[0].end_error_m == none[1].end_error_m == walked(walks[0], "", params).result.end_error_m


def test_the_best_gain_is_the_vertex_of_a_parabola():
    points = [GainPoint("improved", k, (k - 0.37) ** 2, None, 0.0) for k in (0.0, 0.2, 0.4, 0.6)]
    assert best(points, "improved") == pytest.approx(0.37)


def test_the_default_gain_is_near_the_best_of_the_real_loop(monkeypatch):
    """Brute force over the seeds of `pdr bench --cheng`, on a coarser grid. The expected error is the measured one."""
    grid = (0.0, 0.3, 0.45, 0.6, 0.75, 0.9)
    monkeypatch.setattr(cheng_tables, "GAINS_PER_S", {"improved": grid})
    points = cheng_tables.gains(20)
    default = ChestParams().feedback_per_s
    assert default == pytest.approx(best(points, "improved"), rel=0.2)
    least = min(p.tilt_error_deg for p in points)
    assert np.degrees(rms_rad(default, LoopNoise())) == pytest.approx(least, rel=0.2)
    assert points[0].tilt_error_deg > 1.5 * least


def test_theory_tells_both_ways():
    for row in cheng_gain.theory():
        assert row.searched == pytest.approx(row.closed_form, rel=0.01)
    times_s = cheng_gain.convergence_times_s()
    assert np.all(np.diff(times_s) <= 0.0)
    assert times_s[-1] == pytest.approx(0.02)


def test_better_is_the_share_that_is_saved(case_4):
    found = rows([one.result for one in case_4])
    ends = {r.method: r.end_error_m for r in found if r.case == 0}
    assert better_percent(found, "PIWSLCS") == pytest.approx(100.0 * (1.0 - ends["ICFWSLC"] / ends["PIWSLCS"]))
