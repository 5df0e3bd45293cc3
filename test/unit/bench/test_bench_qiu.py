"""Qiu's Tables: which walks they are, what is measured of them, and some of the walks themselves."""

from dataclasses import asdict, replace

import numpy as np
import pytest

from pdr_core.bench import qiu_walks
from pdr_core.bench.qiu_tables import Cost, costs, means, of, qiu_tables, sensors
from pdr_core.bench.qiu_walks import SENSOR, Trial, compared, eskf, measured, told, trials
from pdr_core.evaluation.course_plots import CourseTrack
from pdr_core.params import Params
from pdr_core.records import length
from pdr_core.simulation.qiu_courses import qiu_rectangle, stair_climb
from pdr_core.simulation.sensors import SENSOR_MODELS

TRIALS = {(trial.table, trial.name): trial for trial in trials()}
SHORT = Trial("3", "1", qiu_rectangle(27, 20.0), 1, True)
CLIMB = Trial("stairs", "1", stair_climb([]), 1, True)


def test_the_walks_are_those_of_the_tables():
    strides = {table: [len(t.strides) for t in trials() if t.table == table] for table in ("3", "4", "5", "stairs")}
    assert strides["3"] == [57, 60, 59, 56, 55, 59]
    assert (np.mean(strides["4"]), max(strides["4"]), min(strides["4"])) == (321, 327, 315)
    assert strides["5"] == [321, 654, 297, 613]
    assert strides["stairs"] == [14] * 4  # ten of them climb
    assert [TRIALS["3", str(i)].turns for i in range(1, 7)] == [10] * 6
    assert TRIALS["3", "5"].distance_m == pytest.approx(51.33)
    assert [TRIALS["5", str(i)].distance_m for i in range(1, 5)] == pytest.approx([423, 846, 423, 846], abs=0.1)
    for table in strides:
        walks = [t for t in trials() if t.table == table]
        assert len({t.seed for t in walks}) == len(walks)
        assert {t.indoors for t in walks} == {table in ("3", "stairs")}


def test_the_suite_is_told_what_the_data_sheet_says():
    assert told().intake.gyro_range_radps == SENSOR.gyro_range_radps
    assert told().intake.accel_range_mps2 == 50.0
    assert np.degrees(told().filter.initial_gyro_bias_sd_radps) == pytest.approx(1.0)
    assert told().filter.initial_accel_bias_sd_mps2 == 0.02
    assert Params().intake.gyro_noise_density >= SENSOR.gyro_noise_density
    assert Params().intake.accel_noise_density >= SENSOR.accel_noise_density


def track(heading_deg, end_m):
    position_m = np.array([[0.0, 0.0, 0.0], end_m])
    return CourseTrack("made up", np.array([0.0, 1.0]), position_m, np.array([0.0, heading_deg]))


def test_the_figures_are_those_of_the_paper():
    steps = measured(SHORT).steps[:10]
    r = compared(SHORT, "ESKF", steps, track(-876.5, [3.0, 4.0, 0.1]), track(-900.0, [0.0, 0.0, 0.2]))
    assert (r.strides, r.strides_true, r.turns) == (10, 27, 10)
    assert (r.heading_deg, r.heading_error_deg) == pytest.approx((-156.5, 23.5))
    assert r.error_per_turn_deg == pytest.approx(2.35)
    assert r.end_error_m == pytest.approx(5.0)
    assert r.end_error_percent == pytest.approx(25.0)
    assert r.distance_m == pytest.approx(sum(step.length_m for step in steps))
    assert r.distance_error_percent == pytest.approx(100.0 * (r.distance_m - 20.0) / 20.0)
    assert r.distance_error_percent < -50.0
    assert (r.height_m, r.height_true_m, r.height_error_percent) == pytest.approx((0.1, 0.2, -50.0))


def test_a_heading_beyond_half_a_turn_is_told_within_it_and_the_curve_does_not_jump():
    one = measured(SHORT)
    assert np.abs(np.diff(one.estimate.heading_deg)).max() < 20.0
    assert one.estimate.heading_deg[-1] == pytest.approx(-900.0, abs=20.0)
    assert -180.0 <= one.result.heading_deg < 180.0


def test_a_perfect_sensor_is_perfectly_tracked():
    r = measured(SHORT, sensor=SENSOR_MODELS["ideal"]).result
    assert r.strides == r.strides_true == 27
    assert abs(r.distance_error_percent) < 0.05
    assert r.end_error_percent < 0.05
    assert r.error_per_turn_deg < 0.005
    assert measured(CLIMB, sensor=SENSOR_MODELS["ideal"]).result.height_error_percent == pytest.approx(0.0, abs=0.1)


def test_the_sensor_of_table_1_is_within_the_targets_on_one_rectangle_and_the_stairs():
    r, climb = measured(TRIALS["3", "2"]).result, measured(TRIALS["stairs", "1"]).result
    assert (r.strides, climb.strides) == (60, 14)
    assert 0.0 < abs(r.distance_error_percent) < 0.5
    assert 0.0 < r.error_per_turn_deg < 0.6
    assert 0.0 < abs(climb.height_error_percent) < 2.0


def test_a_method_gets_the_field_and_what_it_loses_is_seen(monkeypatch):
    fields = []

    def loses_strides(imu, params):
        fields.append(imu.field_sd_tesla)
        nav, steps = eskf(imu, params)
        turned = nav.quat_xyzw[:, [1, 0, 3, 2]] * [1.0, -1.0, 1.0, -1.0]  # by half a turn about the vertical
        return qiu_walks.Track(nav._replace(quat_xyzw=turned), steps[::2])

    monkeypatch.setitem(qiu_walks.METHODS, "loses", loses_strides)
    r = measured(SHORT, "loses").result
    assert (fields[0] > 0.0).all()
    assert (r.method, r.strides) == ("loses", 14)
    assert -55.0 < r.distance_error_percent < -40.0
    assert 16.0 < r.error_per_turn_deg < 20.0


@pytest.mark.parametrize("method", ["EKF", "CF", "GDA"])
def test_the_orientations_of_others_walk_too(method):
    r = measured(SHORT, method).result
    assert r.strides == r.strides_true
    assert abs(r.distance_error_percent) < 3.0
    assert r.error_per_turn_deg < 2.0


def test_every_method_walks_every_walk(monkeypatch):
    monkeypatch.setattr("pdr_core.bench.qiu_tables.trials", lambda: [SHORT, CLIMB])
    for name in ("EKF", "CF", "GDA"):
        monkeypatch.delitem(qiu_walks.METHODS, name)
    monkeypatch.setitem(qiu_walks.METHODS, "again", eskf)
    seen = []
    walks = qiu_tables(seen.append)
    assert [(w.result.table, w.result.method) for w in walks] == [
        ("3", "ESKF"), ("3", "again"), ("stairs", "ESKF"), ("stairs", "again"),
    ]  # fmt: skip
    assert len(seen) == 4
    assert asdict(walks[1].result) | {"method": "ESKF"} == asdict(walks[0].result)
    assert of([w.result for w in walks], "stairs", "again") == [walks[3].result]


def test_a_mean_is_that_of_the_sizes():
    up, down = (compared(SHORT, "", [], track(-900.0 + e, [0.0, 0.0, 0.0]), track(-900.0, [0.0] * 3)) for e in (2, -4))
    assert means([up, down]).heading_error_deg == pytest.approx(3.0)
    assert means([up, down]).distance_error_percent == pytest.approx(100.0)


def test_each_error_of_the_sensor_is_switched_off_alone():
    parts = {name: flat(asdict(sensor)) for name, sensor in sensors().items()}
    whole = parts.pop("nothing")
    changed = {name: {k for k in whole if part[k] != whole[k]} for name, part in parts.items()}
    assert changed["gyro bias"] == {"gyro_bias_sd_radps"}
    assert changed["accelerometer bias"] == {"accel_bias_sd_mps2"}
    assert changed["noise"] == {"gyro_noise_density", "accel_noise_density", "magnetometer.noise_tesla"}
    for name, key in (("alignment", "alignment_sd_rad"), ("linearity", "linearity"), ("bandwidth", "bandwidth_hz")):
        axes = ("gyro_response", "accel_response", "magnetometer.response")
        assert changed[name] == {f"{axis}.{key}" for axis in axes}
    perfect = replace(SENSOR_MODELS["ideal"], gyro_range_radps=SENSOR.gyro_range_radps, accel_range_mps2=50.0)
    assert sensors()["all of these"] == perfect


def flat(mapping, prefix=""):
    rows = {}
    for name, value in mapping.items():
        rows |= flat(value, f"{prefix}{name}.") if isinstance(value, dict) else {prefix + name: value}
    return rows


def test_what_an_error_costs_is_measured_on_the_walks_of_both_tables(monkeypatch):
    lap = Trial("4", "1", SHORT.strides, 2, False)
    monkeypatch.setattr("pdr_core.bench.qiu_tables.trials", lambda: [SHORT, lap, CLIMB])
    found = costs()
    assert [(c.table, c.without) for c in found] == [(table, part) for table in ("3", "4") for part in sensors()]
    by_part = {(c.table, c.without): c.means for c in found}
    assert by_part["3", "nothing"].error_per_turn_deg == measured(SHORT).result.error_per_turn_deg
    assert by_part["4", "all of these"].end_error_percent < 0.1 * by_part["4", "nothing"].end_error_percent
    assert isinstance(found[0], Cost)


def test_a_track_has_a_place_for_every_sample():
    one = measured(CLIMB)
    assert len(one.truth.time_s) == len(one.truth.position_m) == len(one.truth.heading_deg)
    assert length((one.estimate.time_s,)) > 0.95 * len(one.truth.time_s)
    assert one.estimate.position_m[0].tolist() == [0.0, 0.0, 0.0]
