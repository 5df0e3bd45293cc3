"""Bent corridors and Gui Table 3 on recordings, checked on simulated walks whose strides are known."""

import json

import numpy as np
import pytest

from pdr_core.bench.bends import Bendable, corridor_strides
from pdr_core.bench.heading_ablation import CONSTRAINTS, PARTS, WITHOUT, study, tracked, variants
from pdr_core.bench.trial import Walk
from pdr_core.evaluation.heading_page import heading_page
from pdr_core.evaluation.heading_tables import as_json, bends, figures, means
from pdr_core.maths.circular import wrapped_rad
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.records import Truth, TruthKind
from pdr_core.simulation import simulated_walk

PARAMS = changed(Params(), "filter", magnetometer="off")


def simulated(length_m: float = 16.0, course: str = "straight", **more) -> Walk:
    """Return a simulated walk whose truth is known at the ends of its stances."""
    settings = {"motion": "smooth", "walk": course, "walk_length_m": length_m, "sensor_model": "ideal"}
    found = simulated_walk(SimulationParams(**{**settings, **more}))
    ends = np.flatnonzero(np.diff(found.motion.stance.astype(int)) == -1)
    places_m = found.motion.position_m[[*ends, -1], :2]
    return Walk("simulated", [found.imu], Truth(TruthKind.STRIDES, np.zeros(0, np.int64), places_m))


@pytest.fixture(scope="module")
def straight() -> Walk:
    return simulated()


def headings_rad(truth: Truth) -> np.ndarray:
    moved_m = np.diff(truth.position_m, axis=0)
    return np.arctan2(moved_m[:, 1], moved_m[:, 0])


def test_only_the_middle_of_a_straight_line_is_a_corridor() -> None:
    turns = np.array([0.0] * 7 + [90.0] * 3 + [0.0] * 5)
    steps_m = np.column_stack([np.cos(np.radians(turns)), np.sin(np.radians(turns))])
    truth = Truth(TruthKind.STRIDES, np.zeros(0, np.int64), np.concatenate([[[0.0, 0.0]], np.cumsum(steps_m, axis=0)]))
    assert corridor_strides(truth) == [2, 3, 4, 12]


@pytest.mark.parametrize("angle_deg", [-12.0, 8.0, 40.0])
def test_the_chain_follows_a_bend_as_well_as_the_walk_without_it(straight: Walk, angle_deg: float) -> None:
    """The samples of the bent walk are those of its truth: the filter that knows no bend finds it."""
    bent = Bendable(straight, straight.truth, PARAMS).bent(4, np.radians(angle_deg))
    assert bent.truth is not None
    turned = np.degrees(headings_rad(bent.truth))
    assert turned[:4] == pytest.approx(np.zeros(4), abs=1e-6)
    assert turned[5:] == pytest.approx(np.full(len(turned) - 5, angle_deg), abs=1e-6)
    assert 0.3 < turned[4] / angle_deg < 0.7
    before_m, after_m = (tracked(w, PARAMS).score.ate2_m for w in (straight, bent))
    assert after_m < before_m + 0.005


def test_a_bend_of_nothing_changes_nothing(straight: Walk) -> None:
    same = Bendable(straight, straight.truth, PARAMS).bent(4, 0.0)
    assert np.array_equal(same.pieces[0].gyro_radps, straight.pieces[0].gyro_radps)
    assert same.truth.position_m == pytest.approx(straight.truth.position_m, abs=1e-12)


def test_the_turn_is_felt_about_the_vertical_within_the_swing_alone(straight: Walk) -> None:
    bent = Bendable(straight, straight.truth, PARAMS).bent(4, 0.2)
    rate = bent.pieces[0].gyro_radps - straight.pieces[0].gyro_radps
    felt = np.flatnonzero(np.abs(rate).max(axis=1) > 1e-9)
    dt_s = np.gradient(straight.pieces[0].stamp_ns) * 1e-9
    assert np.sum(np.linalg.norm(rate, axis=1) * dt_s) == pytest.approx(0.2, rel=1e-3)
    assert (felt[-1] - felt[0]) * dt_s[0] < 1.0


@pytest.fixture(scope="module")
def found(straight: Walk):
    return study(straight, Params())


def test_the_study_has_every_row_and_the_bends(found) -> None:
    assert list(found.scores) == [*PARTS, *CONSTRAINTS]
    assert {s.held for name, s in found.scores.items() if name in PARTS} == {0}
    assert {tuple(b.ate2_m) for b in found.bends} == {(WITHOUT, *CONSTRAINTS)}
    assert {b.angle_deg for b in found.bends} == {-12.0, -10.0, -8.0, 8.0, 10.0, 12.0}
    assert found.truth_m.shape == found.tracks_m["hde"].shape
    assert np.abs(found.tracks_m["hde"] - found.truth_m).max() < 0.1


def test_the_rows_are_what_their_names_say() -> None:
    rows = variants(Params(), CONSTRAINTS)
    assert {row.filter.magnetometer for row in rows.values()} == {"off"}
    assert rows["ZUPT alone"].filter.initial_gyro_bias_sd_radps < 1e-6
    assert rows["with the bias of the first rest"].stance.rest_later_s > Params().stance.rest_longest_s
    assert [row.heading.constraint for row in rows.values()] == ["none"] * 3 + list(CONSTRAINTS)


def test_a_gyro_that_drifts_is_held_by_the_constraint() -> None:
    """Half a degree a second about the vertical, which no rest has shown, on a line of 40 strides."""
    walk = simulated(60.0)
    imu = walk.pieces[0]
    moving = (imu.stamp_ns - imu.stamp_ns[0] > 3_000_000_000).astype(float)
    drifting = imu._replace(gyro_radps=imu.gyro_radps + np.outer(moving, [0.0, 0.0, np.radians(0.1)]))
    rows = variants(PARAMS, CONSTRAINTS)
    ends_m = {n: tracked(Walk("drift", [drifting], walk.truth), row).score.end_error_m for n, row in rows.items()}
    for name in CONSTRAINTS:
        assert ends_m[name] < 0.5 * ends_m[WITHOUT], name


def test_tables_page_and_json_show_the_figures(found) -> None:
    assert [row[2] for row in figures([found]).rows] == [*PARTS, *CONSTRAINTS]
    assert [row[0] for row in means([found]).rows] == [*PARTS, *CONSTRAINTS]
    assert bends([found]).rows[0][3] == "1.00"
    text = heading_page([found], "1", "abc")
    assert "Gui&#39;s Table 3" in text or "Gui's Table 3" in text
    assert "plan-0" in text
    (one,) = json.loads(as_json([found]))
    assert one["scores"]["learned"]["strides"] == found.scores["learned"].strides
    assert "tracks_m" not in one


def test_the_wrapped_heading_of_a_bend_is_never_a_jump(straight: Walk) -> None:
    bent = Bendable(straight, straight.truth, PARAMS).bent(4, np.radians(12.0))
    turns = np.diff(headings_rad(bent.truth))
    assert max(abs(wrapped_rad(float(t))) for t in turns) < np.radians(12.0)
