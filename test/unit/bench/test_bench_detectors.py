"""Detectors, windows and ablation on a short simulated walk of which everything is known."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from pdr_core.bench.ablation import FULL, OFF, without
from pdr_core.bench.detectors import DETECTORS, study, with_choice
from pdr_core.bench.trial import NoSamples, Walk, trial
from pdr_core.bench.windows import LONGEST_S, SIZES, ingested, lengths_s, swings, window_steps, with_window
from pdr_core.evaluation.detector_study import Choice
from pdr_core.evaluation.walk_score import FAILED_M
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline.stance_phases import OFFLINE, TIME_GATES
from pdr_core.records import NO_SAMPLES, part
from pdr_core.simulation import simulated_walk

STRIDES = 6
RATE_HZ = 200.0
PARAMS = Params()


@pytest.fixture(scope="module")
def walk():
    simulated = simulated_walk(SimulationParams(motion="smooth", walk="straight", walk_length_m=9.0))
    pieces = [part(simulated.imu, start, start + 1000) for start in range(0, len(simulated.imu.stamp_ns), 1000)]
    return Walk("straight", pieces, simulated.truth)


@pytest.fixture(scope="module")
def deep(walk):
    said = []
    return SimpleNamespace(study=study(walk, PARAMS, DETECTORS, TIME_GATES, True, said.append), said=said)


def test_every_detector_runs_with_every_gate(deep):
    assert list(deep.study.scores) == [Choice(d, g) for d in DETECTORS for g in TIME_GATES]
    assert {"adaptive", "glrt", "mbgtd"} <= set(DETECTORS)
    assert TIME_GATES == ("none", "gait_phases", "kmeans", OFFLINE)
    for choice, score in deep.study.scores.items():
        assert score.error_m < FAILED_M, choice
        assert score.strides == STRIDES or choice.detector not in ("adaptive", "glrt"), choice
    assert len({score.ate2_m for score in deep.study.scores.values()}) >= len(DETECTORS)


def test_each_detector_has_its_own_curve_with_a_lane_for_each_gate(deep):
    assert [one.detector for one in deep.study.curves] == list(DETECTORS)
    assert len({one.statistic.value.tobytes() for one in deep.study.curves}) == len(DETECTORS) - 1  # adaptive is a glrt
    assert all(list(one.stance_s) == list(TIME_GATES) for one in deep.study.curves)
    assert np.nanmax(deep.study.speed.value) > 1.0


def test_it_says_what_is_under_way(deep):
    assert {"mbgtd, gate kmeans", "windows of glrt", "without rolling contact"} <= set(deep.said)


def test_without_depth_there_are_figures_and_curves_only(walk):
    shallow = study(walk, PARAMS, ["glrt"], ["none"], False)
    assert (shallow.windows, shallow.ablation, len(shallow.curves)) == (None, {}, 1)


def test_the_default_choice_is_the_default():
    assert with_choice(PARAMS, Choice("adaptive", "none")) == PARAMS
    assert with_choice(PARAMS, Choice("adaptive", OFFLINE)) == with_choice(PARAMS, Choice("adaptive", "kmeans"))


def test_windows_grow_from_three_samples_and_short_ones_find_more_steps(deep):
    found = deep.study.windows
    assert found.window_s == pytest.approx(np.linspace(3.0 / RATE_HZ, LONGEST_S, SIZES))
    assert list(found.steps) == list(DETECTORS)
    for detector, steps in found.steps.items():
        assert len(steps) == SIZES
        assert STRIDES in steps, detector
    assert set(found.steps["adaptive"]) == {STRIDES}
    assert max(found.steps["acceleration_magnitude"][:5]) > STRIDES


@pytest.mark.parametrize("detector", DETECTORS)
def test_every_detector_has_a_window_of_its_own(detector):
    short, long = (with_window(PARAMS, detector, s) for s in (0.01, 0.2))
    assert short.stance.detector == detector
    assert short != long


def test_the_steps_of_the_default_window_are_those_of_its_verdicts(walk):
    (steps,) = window_steps(walk, PARAMS, ["adaptive"]).steps.values()
    window_s = lengths_s(ingested(walk, PARAMS))
    verdicts = trial(walk, changed(PARAMS, "stance", window_s=float(window_s[3]))).judged.stance
    assert steps[3] == swings(verdicts)


def test_a_swing_lies_between_two_stances():
    assert [swings(np.array(s, bool)) for s in ([], [0, 0], [1, 1], [0, 1, 0], [1, 0, 1], [0, 1, 0, 1, 0, 1])] == [
        0, 0, 0, 0, 1, 2,
    ]  # fmt: skip


def test_every_part_can_be_switched_off_and_makes_a_difference(deep):
    assert list(deep.study.ablation) == list(OFF)
    assert without(PARAMS, FULL) == PARAMS
    assert len({str(without(PARAMS, off)) for off in OFF}) == len(OFF)
    assert deep.study.ablation[FULL] == deep.study.scores[Choice("adaptive", "none")]
    assert len({score.ate2_m for score in deep.study.ablation.values()}) > len(OFF) / 2


def test_parts_are_taken_from_the_setting_at_hand():
    mine = changed(PARAMS, "stance", window_s=0.05)
    assert without(mine, "confidence").stance.window_s == 0.05


def test_where_the_pieces_are_cut_changes_nothing(walk):
    cut = Walk("cut", [part(piece, *ends) for piece in walk.pieces for ends in ((0, 7), (7, None))], walk.truth)
    assert trial(cut, PARAMS).score == trial(walk, PARAMS).score


def test_without_truth_no_part_can_be_worth_anything(walk):
    unknown = study(replace(walk, truth=None), PARAMS, ["glrt"], ["none"], True)
    assert (unknown.windows is not None, unknown.ablation) == (True, {})


@pytest.mark.parametrize("pieces", [[], [NO_SAMPLES]])
def test_a_recording_without_samples_is_said_to_be_so(pieces):
    with pytest.raises(NoSamples, match=r"empty holds no usable sample$"):
        study(Walk("empty", pieces, None), PARAMS, ["glrt"], ["none"], False)
