"""What the stress test draws, and what its troubles do to the samples."""

from dataclasses import replace

import numpy as np
import pytest

from pdr_core.bench.stress_ranges import RANGES
from pdr_core.bench.stress_trouble import ordeal
from pdr_core.bench.stress_walk import drawn, sensed_walk, walked_m

DRAWN = [drawn(seed) for seed in range(500)]
TROUBLES = {trouble.name: trouble for trouble in RANGES.troubles}
BASE = replace(drawn(1), rate_hz=100.0, strides=drawn(1).strides[:60])


def troubled(name, amount):
    return replace(BASE, trouble=TROUBLES[name], amount=amount, at=0.5)


def where_it_differs(name, amount):
    d = troubled(name, amount)
    clean, hit = sensed_walk(d).imu, ordeal(d)
    differs = np.flatnonzero(np.any(clean.gyro_radps != hit.imu.gyro_radps, axis=1))
    return clean, hit, differs


def test_a_seed_always_draws_the_same_and_another_one_something_else():
    assert drawn(7).text == drawn(7).text
    assert len({d.text for d in DRAWN}) == len(DRAWN)
    a, b = ordeal(drawn(7)), ordeal(drawn(7))
    np.testing.assert_array_equal(a.imu.accel_mps2, b.imu.accel_mps2)


def test_everything_that_is_written_down_is_drawn():
    assert {name for d in DRAWN for name, _, _ in d.stretches} == {s.name for s in RANGES.stretches}
    assert {d.trouble.name for d in DRAWN} == {"none", *TROUBLES}
    assert np.mean([d.trouble.name != "none" for d in DRAWN]) == pytest.approx(RANGES.troubled, abs=0.06)
    rates = [d.rate_hz for d in DRAWN]
    assert min(rates) >= 100.0
    assert max(rates) <= 1000.0
    assert np.mean(np.array(rates) < 316.0) == pytest.approx(0.5, abs=0.06)
    ranges = {(round(np.degrees(d.sensor.gyro_range_radps)), round(d.sensor.accel_range_mps2 / 9.80665)) for d in DRAWN}
    assert ranges == {(gyro, accel) for gyro in (500, 1000, 2000) for accel in (8, 16)}


def test_a_walk_is_as_long_as_it_was_drawn_and_is_felt_in_range():
    for d in DRAWN[:3]:
        walk = sensed_walk(d)
        assert 40.0 < walked_m(walk.motion.position_m)[-1] < 170.0
        assert np.abs(walk.imu.gyro_radps).max() <= d.sensor.gyro_range_radps
        assert np.abs(walk.imu.accel_mps2).max() <= d.sensor.accel_range_mps2


def test_in_a_gap_nothing_comes_and_both_sides_are_scored():
    hit = ordeal(troubled("gap", 2.0))
    step_s = np.diff(hit.imu.stamp_ns) * 1e-9
    assert step_s.max() == pytest.approx(2.01)
    assert np.sum(step_s > 0.1) == 1
    (first, begin), (back, last) = hit.parts
    assert (first, begin, last) == (0, int(step_s.argmax()) + 1, len(hit.imu.stamp_ns))
    assert 100 < back - begin < 600  # two strides and more


@pytest.mark.parametrize("name", ["clipped", "fall"])
def test_a_bad_stretch_is_as_long_as_drawn_and_lies_between_the_parts(name):
    clean, hit, differs = where_it_differs(name, 1.0)
    assert 10 < len(differs) <= 100
    assert hit.parts[0][1] <= differs[0]
    assert differs[-1] < hit.parts[0][1] + 100 < hit.parts[1][0]
    np.testing.assert_array_equal(clean.stamp_ns, hit.imu.stamp_ns)


def test_a_kick_turns_the_sensor_on_the_foot_from_then_on():
    clean, hit, differs = where_it_differs("kicked", 0.9)
    assert differs[0] == hit.parts[0][1]
    before, after = clean.accel_mps2[-200:].mean(axis=0), hit.imu.accel_mps2[-200:].mean(axis=0)
    assert np.linalg.norm(after) == pytest.approx(9.81, abs=0.5)
    angle = np.arccos(before @ after / np.linalg.norm(before) / np.linalg.norm(after))
    assert 0.1 < angle < 0.95  # the turn, but for its part about the vertical


def test_jitter_moves_stamps_and_losses_take_samples():
    clean, moved, _ = where_it_differs("jitter", 0.4)
    off_s = (moved.imu.stamp_ns - clean.stamp_ns) * 1e-9
    assert 0.0039 < np.abs(off_s).max() <= 0.004
    assert np.diff(moved.imu.stamp_ns).min() > 0
    fewer = ordeal(troubled("lost", 0.02))
    assert len(fewer.imu.stamp_ns) == pytest.approx(0.98 * len(clean.stamp_ns), rel=0.005)
    assert len(fewer.position_m) == len(fewer.imu.stamp_ns) == fewer.parts[0][1]


def test_where_the_walk_is_over_before_the_foot_is_back_only_the_first_part_is_scored():
    hit = ordeal(replace(troubled("kicked", 0.5), at=0.999))
    assert len(hit.parts) == 1
    assert hit.parts[0][1] < len(hit.imu.stamp_ns)
