"""What two feet tell of their headings: frames, drift, and what must tell nothing."""

import numpy as np
import pytest
from fusion_cases import in_turn, turned_back, walk

from pdr_core.fusion.dual_heading import DualHeading
from pdr_core.params import FusionParams

STRIDES = 60
TIMES = np.arange(1, STRIDES + 1)
DRIFT_RAD = np.radians(0.05)  # a stride


def corrected(left_rad, right_rad, closed=True):
    """Walk; return the stage, and what each foot was turned back by, (strides,) by name."""
    stage, taken = DualHeading(FusionParams(), ("left", "right")), {"left": [0.0], "right": [0.0]}
    for foot, event in in_turn(*walk(left_rad, right_rad)):
        correction = stage.step(foot, turned_back(event, taken[foot][-1]))
        turn_rad = correction.turn_rad if correction and closed else 0.0
        stage.turned_back(foot, turn_rad)
        taken[foot].append(taken[foot][-1] + turn_rad)
    return stage, {foot: np.array(turns[1:]) for foot, turns in taken.items()}


def test_mounting_and_toe_out_are_frames_and_no_error():
    stage, taken = corrected(np.full(STRIDES, -0.3), np.full(STRIDES, 0.2))
    assert stage.known("left").turn_rad == pytest.approx(0.25, abs=1e-6)
    assert stage.known("right").turn_rad == pytest.approx(-0.25, abs=1e-6)
    assert np.abs(taken["left"]).max() < 1e-6


def test_a_lost_foot_turns_its_own_frame_alone():
    stage = DualHeading(FusionParams(), ("left", "right"))
    stage.begin("right")
    for foot, event in in_turn(*walk(np.full(STRIDES, 0.1), np.full(STRIDES, 0.5))):
        stage.step(foot, event)
    assert stage.known("left").turn_rad == 0.0
    assert stage.known("left").sd_rad == 0.0
    assert stage.known("right").turn_rad == pytest.approx(-0.4, abs=1e-6)


def test_strides_of_different_times_show_no_frame():
    """The right foot is lost after four strides of a curve, and the left one walks on in it."""
    lefts, rights = walk(0.5 * TIMES[:12], 0.5 * (TIMES[:4] + 0.5))
    stage = DualHeading(FusionParams(), ("left", "right"))
    for foot, event in in_turn(lefts, rights):
        stage.step(foot, event)
    assert stage.known("left").turn_rad == pytest.approx(0.0, abs=1e-6)


def test_mirrored_drift_is_taken_back_and_nothing_twice():
    drift_rad = DRIFT_RAD * TIMES
    stage, taken = corrected(-0.1 + drift_rad, 0.1 - drift_rad)
    for foot, sign in (("left", 1.0), ("right", -1.0)):
        left_rad = sign * drift_rad - taken[foot]
        assert np.abs(left_rad[20:]).max() < np.radians(0.4), foot  # of 3
    assert stage.known("left").turn_rad == pytest.approx(0.1, abs=np.radians(0.3))


def test_a_drift_of_both_to_one_side_is_nothing_that_they_could_know():
    _, taken = corrected(DRIFT_RAD * TIMES, DRIFT_RAD * TIMES)
    assert np.abs(taken["left"]).max() < np.radians(0.05)
    assert np.abs(taken["right"]).max() < np.radians(0.05)


def test_one_foot_that_drifts_alone_gives_half_to_the_other():
    drift_rad = DRIFT_RAD * TIMES
    _, taken = corrected(drift_rad, 0.0 * drift_rad)
    assert taken["left"][-1] == pytest.approx(0.5 * drift_rad[-1], abs=np.radians(0.3))
    assert taken["right"][-1] == pytest.approx(-0.5 * drift_rad[-1], abs=np.radians(0.3))


def test_a_wide_curve_that_passes_as_straight_turns_nothing():
    curve_rad = np.radians(1.0)  # a stride
    _, taken = corrected(curve_rad * TIMES, curve_rad * (TIMES + 0.5))
    assert np.abs(taken["left"]).max() < np.radians(0.05)


def test_a_sharp_curve_and_a_turn_tell_nothing():
    curve_rad = np.radians(10.0)
    stage, taken = corrected(curve_rad * TIMES, -curve_rad * TIMES)
    assert not stage.aligned
    assert np.abs(taken["left"]).max() == 0.0


def test_without_its_answers_a_foot_is_told_the_same_again():
    drift_rad = DRIFT_RAD * TIMES
    _, taken = corrected(drift_rad, -drift_rad, closed=False)
    assert np.abs(taken["left"]).max() == 0.0


def test_a_foot_alone_is_told_nothing():
    stage = DualHeading(FusionParams(), ("left", "right"))
    lefts, _ = walk(DRIFT_RAD * TIMES, DRIFT_RAD * TIMES)
    assert all(stage.step("left", event) is None for event in lefts)
