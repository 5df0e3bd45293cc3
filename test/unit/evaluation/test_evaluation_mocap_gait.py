"""Strides and pitch against markers that were made from a simulated walk, so that every error is known."""

import json
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.evaluation.mocap_gait import (
    at,
    estimated_pitch_rad,
    gait_errors,
    markers,
    pitch_cycle,
    pitch_rad,
    true_strides_ns,
)
from pdr_core.evaluation.orientation_page import orientation_page
from pdr_core.evaluation.orientation_study import Drift, OrientationStudy
from pdr_core.evaluation.orientation_tables import as_json, gait
from pdr_core.evaluation.walk_score import WalkScore
from pdr_core.params import SimulationParams
from pdr_core.records import StepEvent, Truth, TruthKind
from pdr_core.simulation import simulated_walk

WALK = simulated_walk(SimulationParams(motion="smooth", walk="straight", walk_length_m=9.0, sample_rate_hz=200.0))
STAMPS, MOTION = WALK.imu.stamp_ns, WALK.motion
HEEL, TOE = (MOTION.position_m + Rotation.from_quat(MOTION.quat_xyzw).apply([x, 0.0, -0.08]) for x in (-0.08, 0.16))
TRUTH = Truth(TruthKind.POSITION, STAMPS, (HEEL + TOE) / 2.0, np.stack([HEEL, TOE], axis=1))
FOUND = markers(TRUTH)
TIMES_NS = true_strides_ns(FOUND)


def step(index, start_ns, stamp_ns, length_m):
    return StepEvent(index, int(start_ns), int(stamp_ns), np.zeros(3), np.array([length_m, 0, 0]), np.eye(3), 0.0, 0.1)


def steps_of(longer_m):
    ends = [STAMPS[0], *((TIMES_NS[:-1, 1] + TIMES_NS[1:, 0]) // 2), STAMPS[-1]]
    where = at(FOUND, np.array(ends))
    middle = (where.heel_m + where.toe_m) / 2.0
    lengths = np.hypot(*np.diff(middle[:, :2], axis=0).T)
    return [step(i + 1, a, b, s + longer_m) for i, (a, b, s) in enumerate(zip(ends, ends[1:], lengths, strict=False))]


def test_true_strides_are_those_of_the_walk():
    swings = int(np.sum(np.diff(MOTION.stance.astype(int)) == -1))
    assert len(TIMES_NS) == swings > 4
    assert np.all(TIMES_NS[:, 0] < TIMES_NS[:, 1])


def test_a_known_error_is_what_is_found():
    tilted = (Rotation.from_quat(MOTION.quat_xyzw) * Rotation.from_euler("y", -0.05)).as_quat()
    found = gait_errors(FOUND, STAMPS, tilted, steps_of(0.012))
    assert (found.strides_found, found.strides_true, found.strides_false) == (len(TIMES_NS), len(TIMES_NS), 0)
    assert found.mean_m == pytest.approx(0.012, abs=1e-9)
    assert found.sd_m == pytest.approx(0.0, abs=1e-9)
    assert found.pitch_offset_rad == pytest.approx(0.05, abs=1e-6)
    assert found.pitch_rmse_rad < 2e-4  # a foot that also rolls


def test_a_wrong_pitch_is_seen_in_the_cycle():
    scaled = Rotation.from_euler("y", 1.1 * Rotation.from_quat(MOTION.quat_xyzw).as_euler("ZYX")[:, 1]).as_quat()
    swing_deg = np.degrees(np.ptp(pitch_rad(FOUND)))
    found = gait_errors(FOUND, STAMPS, scaled, steps_of(0.0))
    assert 0.01 * swing_deg < np.degrees(found.pitch_rmse_rad) < 0.06 * swing_deg
    cycle = pitch_cycle(FOUND, STAMPS, {"scaled": scaled})
    assert 0.5 < cycle.time_s[-1] < 2.0
    assert np.abs(cycle.estimated_rad["scaled"] - cycle.true_rad).max() > 0.03


def test_toe_up_is_positive_on_both_sides():
    toe_up = Rotation.from_euler("y", -0.3)
    assert estimated_pitch_rad(toe_up.as_quat()[None])[0] == pytest.approx(0.3)
    heel, toe = (toe_up.apply([[x, 0.0, 0.0]]) for x in (-0.1, 0.1))
    assert pitch_rad(FOUND._replace(heel_m=heel, toe_m=toe))[0] == pytest.approx(0.3)


def test_a_missed_stride_and_a_false_one_are_counted():
    steps = steps_of(0.0)
    merged = [*steps[:1], replace(steps[1], stamp_ns=steps[2].stamp_ns), *steps[3:]]
    found = gait_errors(FOUND, STAMPS, MOTION.quat_xyzw, merged)
    assert found.strides_found == len(TIMES_NS) - 2  # two in one step: neither is found
    rest_ns = STAMPS[-1]
    extra = gait_errors(FOUND, STAMPS, MOTION.quat_xyzw, [*steps, step(99, rest_ns, rest_ns + 10**8, 0.3)])
    assert extra.strides_false == 1


def test_strides_of_a_foot_that_turns_count_but_are_not_measured():
    third = (TIMES_NS[2].mean() < STAMPS) * 0.6
    turned = Rotation.from_euler("z", third)
    middle = (HEEL + TOE) / 2.0
    bent = FOUND._replace(heel_m=middle + turned.apply(HEEL - middle), toe_m=middle + turned.apply(TOE - middle))
    found = gait_errors(bent, STAMPS, MOTION.quat_xyzw, steps_of(0.0))
    assert found.strides_found == len(TIMES_NS)
    assert len(found.length_error_m) == len(TIMES_NS) - 1


def test_a_truth_of_one_point_or_none_has_no_markers():
    assert markers(None) is None
    assert markers(Truth(TruthKind.POSITION, STAMPS, HEEL)) is None


def test_page_and_figures_hold_what_was_found():
    score = WalkScore("position", 6, None, 0.1, 0.2, np.nan, np.nan, np.nan, 0.4)
    rng = np.random.default_rng(0)
    errors = gait_errors(FOUND, STAMPS, MOTION.quat_xyzw, steps_of(0.0))
    errors = replace(errors, length_error_m=rng.normal(0.005, 0.01, len(errors.length_error_m)))
    cycle = pitch_cycle(FOUND, STAMPS, {"quaternion_ekf": MOTION.quat_xyzw})
    drift = Drift(np.arange(3.0), np.ones((3, 3)), np.zeros((3, 3)))
    why = {"factored_quaternion": "it needs a field"}
    done = OrientationStudy("walk <1>", {"quaternion_ekf": score}, why, {"quaternion_ekf": errors}, cycle, drift)
    page = orientation_page([done], "1.2.3", "abc")
    for text in (
        "walk &lt;1&gt;",
        "Kernel density",
        "Normal fit",
        "Motion capture",
        "Before",
        "it needs a field",
        "1.2.3",
    ):
        assert text in page
    assert json.loads(as_json([done]))[0]["gait"]["quaternion_ekf"]["strides_true"] == len(TIMES_NS)
    assert gait([done]).rows[0][2] == f"{len(TIMES_NS)} of {len(TIMES_NS)}"
