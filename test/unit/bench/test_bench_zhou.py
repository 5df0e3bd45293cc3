"""Zhou's section 5 on few and short walks: what the laps are, what is measured of them, and what the schemes make."""

import numpy as np
import pytest

from pdr_core.bench.zhou_errors import result
from pdr_core.bench.zhou_lengths import LengthError, Walked, error, online
from pdr_core.bench.zhou_lesson import lesson
from pdr_core.bench.zhou_modes import Change, Managed, done, figure_15, named, transitions
from pdr_core.bench.zhou_schemes import SCHEMES, Track, at_rate
from pdr_core.bench.zhou_steps import METHODS, prepared
from pdr_core.bench.zhou_tables import mean, of
from pdr_core.bench.zhou_testers import found
from pdr_core.bench.zhou_walks import FULL_HZ, RATES_HZ, Trial, octagon, stands_s, told
from pdr_core.conventions import nanoseconds
from pdr_core.gait.accelerometer_steps import GaitSeen
from pdr_core.records import length
from pdr_core.records_gait import Behaviour, GaitStep
from pdr_core.simulation.gait import RUN, SWING, WALK, Stride
from pdr_core.simulation.zhou_courses import LAP_M

TRIAL = Trial("running", "c", 1)


@pytest.fixture(scope="module")
def walked():
    """Two laps, run."""
    return octagon(TRIAL)


@pytest.fixture(scope="module")
def known(walked):
    """What the first one teaches."""
    return lesson(walked)


def test_the_laps_are_those_of_the_paper(walked):
    assert RATES_HZ == (200, 100, 75, 50, 20)
    assert len(walked.corners) == 8
    assert len(walked.stand_m) == 2 * walked.half + 1
    lap_m = np.linalg.norm(np.diff(walked.stand_m[walked.half :], axis=0), axis=1).sum()
    assert lap_m == pytest.approx(LAP_M, rel=0.05)
    assert np.linalg.norm(walked.stand_m[-1] - walked.stand_m[walked.half]) < 5.0
    still = walked.walk.motion.still[np.searchsorted(walked.walk.imu.stamp_ns, walked.stand_ns)]
    assert still.all()


@pytest.mark.parametrize("rate_hz", RATES_HZ)
def test_each_rate_is_a_whole_part_of_the_sensors(walked, rate_hz):
    first, second = walked.lap(1, rate_hz), walked.lap(2, rate_hz)
    steps_ns = np.diff(np.concatenate([first.stamp_ns, second.stamp_ns]))
    assert steps_ns == pytest.approx(1e9 / rate_hz, abs=2)
    assert first.stamp_ns[-1] < walked.stand_ns[walked.half] + nanoseconds(1.0) < second.stamp_ns[0] + nanoseconds(2.0)
    assert 0.0 < (second.field_sd_tesla >= 0.0).mean() <= 1.0
    assert FULL_HZ % rate_hz == 0
    assert length(second) == pytest.approx((walked.walk.imu.stamp_ns[-1] - second.stamp_ns[0]) * 1e-9 * rate_hz, abs=2)


def test_the_figures_of_a_lap(walked):
    true_m = walked.stand_m[walked.half :]
    off_m = np.zeros_like(true_m)
    points = [i - walked.half for i in walked.corners]
    off_m[points[:3], 1] = 9.0  # of nine points three
    yaw = walked.stand_yaw_rad[walked.half :] + np.radians(3.0)
    track = Track(true_m + off_m + 100.0, yaw, walked.deviation_rad - np.radians(1.0), len(true_m), 1.02 * LAP_M)
    r = result(walked, "ours", 50, track)
    assert r.corner_error_m == pytest.approx(3.0)
    assert r.rmse_m == pytest.approx(9.0 * np.sqrt(3.0 / len(true_m)))
    assert r.heading_error_deg == pytest.approx(2.0)
    lap_m = np.linalg.norm(np.diff(true_m, axis=0), axis=1).sum()
    assert r.distance_error_percent == pytest.approx(abs(102.0 * LAP_M / lap_m - 100.0))
    assert r.misclosure_m < 1e-9
    assert (r.strides, r.strides_true, r.gait, r.tester) == (len(true_m), len(true_m) - 1, "running", "c")


def test_a_runner_is_dead_reckoned_without_the_gyro_and_the_deviation_counts(walked, known):
    tracks = at_rate(known, 50)
    assert tuple(tracks) == SCHEMES
    results = {name: result(walked, name, 50, track) for name, track in tracks.items()}
    assert all(r.strides == r.strides_true for r in results.values())
    assert results["ours"].rmse_m < 3.0
    assert results["PDR"].rmse_m > results["ours"].rmse_m
    assert results["ours"].distance_error_percent < 3.0
    assert results["PDR"].heading_error_deg > np.degrees(walked.deviation_rad)
    shown, strides = found(known)
    assert shown.learnt_deg == pytest.approx(shown.true_deg, abs=1.0)
    assert shown.by_place_deg == pytest.approx(shown.true_deg, abs=1.0)
    assert shown.by_velocity_deg > shown.by_place_deg  # the foot flies towards its toes
    assert strides.deviation_deg[-1] == pytest.approx(shown.by_place_deg)


def test_the_mean_of_laps_is_that_of_their_figures(walked):
    track = Track(walked.stand_m[walked.half :], walked.stand_yaw_rad[walked.half :], 0.0, 1, LAP_M)
    laps = [result(walked, "ours", rate, track) for rate in (50, 50, 20)]
    assert len(of(laps, rate_hz=50, scheme="ours")) == 2
    assert of(laps, scheme="PDR") == []
    two = mean([laps[0], type(laps[0])(**{**vars(laps[0]), "rmse_m": laps[0].rmse_m + 2.0})])
    assert two.rmse_m == pytest.approx(laps[0].rmse_m + 1.0)
    assert two.scheme == "ours"


STRIDES = [Stride(SWING), Stride(WALK, pause_s=2.0), Stride(WALK), Stride(RUN), Stride(RUN), Stride(RUN)]


def test_what_the_foot_does_begins_and_ends_standing():
    row = done(STRIDES)
    assert [c.behaviour.name for c in row] == [
        "STANDING",
        "SWING",
        "WALKING",
        "STANDING",
        "WALKING",
        "RUNNING",
        "STANDING",
    ]
    assert row[3].time_s == pytest.approx(3.0 + SWING.duration_s + WALK.duration_s)
    assert row[-1].time_s == pytest.approx(3.0 + sum(s.duration_s for s in STRIDES))


def gait_step(hit_s, behaviour):
    return GaitStep(1, 0, nanoseconds(hit_s), behaviour, 1.0, 0.0, 0.0, 0.0, 0.0)


def test_a_change_is_found_in_the_stride_that_is_named_so_first():
    ends_s = stands_s(STRIDES)[1:]
    run = done(STRIDES)[5]
    steps = [gait_step(ends_s[3], Behaviour.WALKING), gait_step(ends_s[4], Behaviour.RUNNING)]
    shown = GaitSeen(np.zeros(0, np.int64), np.zeros(0, np.int64), steps)
    assert named(shown, run, 0, ends_s, 3) == 2.0
    assert named(shown._replace(steps=steps[:1]), run, 0, ends_s, 3) == np.inf
    seen = [Change(0.5, Behaviour.STANDING), Change(run.time_s + 1.7, Behaviour.RUNNING)]
    rows = transitions(STRIDES, done(STRIDES), seen, shown, 0)
    assert [(r.before, r.after) for r in rows][-2:] == [("walking", "running"), ("running", "standing")]
    assert rows[-2].delay_s == pytest.approx(1.7)
    assert rows[-1].delay_s == rows[-1].strides == np.inf  # never found


def test_through_all_behaviours_the_manager_finds_its_way(monkeypatch):
    monkeypatch.setattr("pdr_core.bench.zhou_modes.TRANSITIONS_M", 240.0)
    walk, changes, timeline = figure_15("a", 1)
    assert isinstance(walk, Managed)
    assert walk.strides == walk.strides_true
    assert walk.end_error_m < 0.02 * walk.distance_m
    assert 20.0 < walk.gyro_on_percent < 70.0  # two calibrations of 50 m each
    assert [(c.before, c.after) for c in changes] == [
        ("standing", "swing"), ("swing", "standing"), ("standing", "walking"),
        ("walking", "running"), ("running", "walking"), ("walking", "standing"),
    ]  # fmt: skip
    assert max(c.strides for c in changes) <= 2.0
    off = [c for c in timeline.modes if not c.gyro]
    assert {timeline.true[i].behaviour for c in off for i in [at(timeline.true, c.stamp_ns)]} >= {
        Behaviour.WALKING,
        Behaviour.RUNNING,
    }


def at(row, stamp_ns):
    return int(np.searchsorted([c.time_s for c in row], stamp_ns * 1e-9)) - 1


def test_ours_is_the_filter_while_it_calibrates_and_the_model_after_it():
    class Step:
        def __init__(self, length_m):
            self.length_m, self.displacement_m = length_m, np.array([length_m, 0.0, 0.0])
            self.displacement_covariance_m2 = 1e-6 * np.eye(3)

    steps = [gait_step(float(i), Behaviour.WALKING) for i in range(60)]
    measured = [Step(1.25) for _ in steps]
    lengths_m, by_filter = online(Walked(steps, np.ones(60), measured), told())
    assert by_filter == [i < 40 for i in range(60)]  # L0 = 50 m
    assert lengths_m[:40] == pytest.approx(1.25)
    assert lengths_m[40:] == pytest.approx(1.25, abs=0.05)
    found_error = error("ours", "a", 1, Walked(steps, np.full(60, 1.0), measured), np.full(60, 1.02))
    assert found_error == LengthError("ours", "a", 1, pytest.approx(2.0), pytest.approx(2.0), pytest.approx(2.0))


@pytest.mark.parametrize("method", METHODS)
def test_both_methods_take_the_same_strides(method):
    walk = prepared(50, 12.0)
    before = walk.counted[0].stamp_ns[0]
    assert walk.strides == 3
    assert (walk.counted[-1].stamp_ns[-1] - before) * 1e-9 == pytest.approx(3.6, abs=0.15)
    METHODS[method](walk)()
