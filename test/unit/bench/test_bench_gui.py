"""Gui's Table 3 on short walks of few seeds: which variants there are, and what is measured of them."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.bench import gui_tables
from pdr_core.bench.gui_tables import gui_walks, of, row, rows
from pdr_core.bench.gui_variants import FLOOR, SENSOR, TABLE_3, VARIANTS, ideal, told
from pdr_core.bench.gui_walks import WALKS, GuiResult, GuiWalk, by_every_variant, measured, simulated
from pdr_core.params import changed
from pdr_core.records import HeadingSource, StepEvent
from pdr_core.simulation.sensors import SENSOR_MODELS
from pdr_core.stance import StanceDetection

SHORT = GuiWalk("short", "rectangle", 60.0)
SEEDS = (1, 2, 3)
PROPOSED = TABLE_3[-1]


@pytest.fixture(scope="module")
def short():
    """The figures of three short walks by every variant."""
    return [one.result for seed in SEEDS for one in by_every_variant(SHORT, seed)]


def test_the_walks_are_those_of_the_paper():
    assert [(w.walk, w.length_m) for w in WALKS] == [("rectangle", 110.0), ("rectangle", 360.0), ("campus", 590.0)]
    sensor = SENSOR_MODELS[SENSOR]
    assert np.degrees(sensor.gyro_noise_density) == pytest.approx(0.1)
    assert np.degrees(sensor.gyro_bias_radps) == pytest.approx([1.5, 2.0, 1.2], abs=0.01)
    assert (sensor.accel_bias_mps2, sensor.accel_noise_density) == ((0.1, 0.2, 0.15), 0.1)
    assert len(simulated(SHORT, 1).imu.stamp_ns) == pytest.approx(100 * simulated_s(SHORT))


def simulated_s(walk):
    return 6.0 + 1.5 * round(walk.length_m / 1.2) + 4.0


def test_with_zaru_every_stance_tells_the_bias_and_without_only_the_first_rest():
    walk = simulated(SHORT, 1)
    for name, rests in (("ZUPT", 1), ("ZUPT+ZARU", 54)):
        params = told(VARIANTS[name])
        judged = StanceDetection(params.stance, params.place, params.detectors, None).run(walk.imu)
        assert np.sum(judged.rest_sd_radps > 0.0) == pytest.approx(rests, abs=2)
        error = judged.rest_rate_radps[judged.rest_sd_radps > 0.0] - SENSOR_MODELS[SENSOR].gyro_bias_radps
        assert abs(np.degrees(error.mean(axis=0))).max() < 0.3  # unbiased: sd 0.18 each


def test_the_table_falls_from_row_to_row_and_the_constraint_comes_near_the_floor(short):
    found = {r.variant: r for r in rows(short)}
    errors = [found[name].end_error_m for name in (*TABLE_3, FLOOR)]
    assert errors == sorted(errors, reverse=True)
    assert found[PROPOSED].over_floor < 2.0
    assert found[FLOOR].over_floor == 1.0
    assert found[FLOOR].yaw_error_deg < 0.5
    assert all(r.miscounted <= 2 for r in found.values())


def test_the_ideal_heading_says_by_how_much_the_foot_is_turned_too_far():
    walk = simulated(SHORT, 1)
    answer = ideal(told(VARIANTS[FLOOR]), walk)
    true = np.unwrap(Rotation.from_quat(walk.motion.quat_xyzw).as_euler("ZYX")[:, 0])
    for sample in (100, 4000, 8000):
        now_ns = int(walk.imu.stamp_ns[sample])
        step = StepEvent(1, 0, now_ns, np.zeros(3), np.zeros(3), np.eye(3), float(true[sample] + 0.02), 0.1, now_ns)
        found = answer(step)
        assert found.yaw_error_rad == pytest.approx(0.02)
        assert (found.source, found.applies_from_ns) == (HeadingSource.EXTERNAL, now_ns)


def result(variant, end_m, seed=1, distance_m=100.0):
    return GuiResult("w", variant, seed, distance_m, *end_m, 0.5, -3.0, 10, 11)


def test_a_row_is_the_mean_over_its_seeds():
    results = [result("ZUPT", (3.0, 4.0)), result("ZUPT", (0.0, 1.0), 2), result(FLOOR, (1.0, 0.0))]
    found = row(results, "w", "ZUPT")
    assert (found.end_error_m, found.end_error_percent, found.largest_percent) == (3.0, 3.0, 5.0)
    assert (found.end_x_m, found.end_y_m, found.seeds, found.over_floor) == (3.0, 4.0, 2, 3.0)
    assert (found.ate2_m, found.yaw_error_deg, found.miscounted) == (0.5, 3.0, 2)
    assert of(results, "w", FLOOR) == [results[2]]


def test_every_walk_is_walked_with_every_seed_and_the_first_is_drawn(monkeypatch):
    monkeypatch.setattr(gui_tables, "WALKS", (GuiWalk("tiny", "straight", 6.0),))
    monkeypatch.setattr("pdr_core.bench.gui_walks.VARIANTS", {name: VARIANTS[name] for name in ("ZUPT", FLOOR)})
    seen = []
    results, drawn = gui_walks(2, seen.append)
    assert [(r.variant, r.seed) for r in results] == [("ZUPT", 1), (FLOOR, 1), ("ZUPT", 2), (FLOOR, 2)]
    assert [one.result for one in drawn] == results[:2]
    assert seen == ["tiny, 1 of 2", "tiny, 2 of 2"]
    assert results[0].distance_m == pytest.approx(6.0)


def test_a_sensor_without_errors_closes_the_walk_by_every_variant(monkeypatch):
    monkeypatch.setattr("pdr_core.bench.gui_walks.SENSOR", "ideal")
    walk = simulated(SHORT, 1)
    for name in VARIANTS:
        one = measured(SHORT, name, 1, walk)
        assert one.result.end_error_percent < 0.6
        assert abs(one.result.yaw_error_deg) < 0.2
        assert one.estimate.euler_deg[-1, 2] == pytest.approx(360.0, abs=0.2)
        np.testing.assert_allclose(one.estimate.velocity_mps[500:900:50], one.truth.velocity_mps[500:900:50], atol=0.1)


def test_the_parameters_of_a_variant_are_its_own():
    assert told(VARIANTS[PROPOSED]).heading.constraint == "dominant"
    assert told(VARIANTS[PROPOSED]).heading.walking_direction == "foot"
    plain = told(VARIANTS["ZUPT+ZARU"])
    assert not plain.filter.heading_feedback
    assert changed(plain, "stance", rest_later_s=60.0) == told(VARIANTS["ZUPT"])
