"""The heading constraints: what they say of steps, and what they survive."""

from dataclasses import replace

import numpy as np
import pytest
from heading_cases import SECOND_NS, answers, constraint, said, step

from pdr_core.params import HeadingParams
from pdr_core.records import HeadingSource, Level

ALL = ("dominant", "hde", "ihde", "learned")


def deg(*degrees: float) -> np.ndarray:
    return np.radians(degrees)


def repeated(heading_deg: float, times: int = 8) -> list[float]:
    return [np.radians(heading_deg)] * times


def drifting(stage, headings_deg, first: int = 1):
    """Steps of a filter whose yaw becomes less sure by a tenth of a degree a step."""
    steps = [step(first + i, np.radians(h), np.radians(0.5 + 0.1 * i)) for i, h in enumerate(headings_deg)]
    return [stage.answer(s) for s in steps]


@pytest.mark.parametrize("name", ["none", *ALL])
def test_every_step_gets_one_answer_that_applies_when_it_is_due(name: str) -> None:
    stage = constraint(name)
    rng = np.random.default_rng(5)
    for i in range(1, 300):
        asked = step(i, rng.uniform(-np.pi, np.pi) if i % 17 < 4 else 0.05 * rng.standard_normal(), rng.uniform(0, 0.3))
        answer = stage.answer(asked)
        assert (answer.step_index, answer.step_ns) == (asked.index, asked.stamp_ns)
        assert answer.applies_from_ns == asked.answer_due_ns
        assert np.isfinite([answer.yaw_error_rad, answer.yaw_error_sd_rad]).all()
        assert answer.source is HeadingSource.NONE or answer.yaw_error_sd_rad > 0.0


def test_none_says_nothing_and_has_no_notice() -> None:
    stage = constraint("none")
    assert said(answers(stage, repeated(10.0, 50))) == []
    assert stage.notices == []


@pytest.mark.parametrize("name", ALL)
def test_the_notices_warn_that_it_is_on_and_count_the_strides(name: str) -> None:
    stage = constraint(name)
    used = said(drifting(stage, [0.0] * 30))
    on, held = stage.notices
    assert (on.kind, on.level, on.count) == ("heading_on", Level.WARN, 1)
    assert "straight lines do not have the directions" in on.text
    assert (held.kind, held.level, held.count) == ("heading_held", Level.OK, len(used))
    assert used


def test_a_filter_that_does_not_estimate_its_yaw_is_named() -> None:
    """As the one of 11 states: it says that its yaw is known without any doubt."""
    stage = constraint("dominant")
    assert said(answers(stage, repeated(10.0, 20), yaw_sd_rad=0.0)) == []
    on, fixed = stage.notices
    assert (on.kind, fixed.kind, fixed.level, fixed.count) == ("heading_on", "heading_fixed", Level.WARN, 1)


def test_a_line_is_held_in_the_direction_in_which_it_began() -> None:
    found = drifting(constraint("dominant"), [30.0] * 5 + [31.0] * 5)
    assert said(found) == [5, 6, 7, 8, 9, 10]
    assert found[4].yaw_error_rad == pytest.approx(0.0, abs=1e-12)
    assert found[5].yaw_error_rad > np.radians(1.0)
    assert {a.source for a in found[5:]} == {HeadingSource.STRAIGHT_WALK}


@pytest.mark.parametrize("name", ALL)
def test_nothing_is_said_in_curves_and_after_them_it_begins_anew(name: str) -> None:
    curve = list(np.arange(20.0, 100.0, 16.0))
    found = drifting(constraint(name), [0.0] * 10 + curve + [97.0] * 10)
    first, last = 10, 10 + len(curve)
    assert not set(said(found)) & set(range(first + 1, last + 4))
    assert max(said(found)) == len(found)


def test_after_a_curve_the_dominant_direction_is_that_of_the_new_line() -> None:
    found = drifting(constraint("dominant"), [0.0] * 8 + [40.0] + [77.0] * 10)
    assert len(found) in said(found)
    assert all(abs(a.yaw_error_rad) < 1e-9 for a in found)


@pytest.mark.parametrize("corner_deg", [-180.0, -90.0, 90.0, 180.0])
def test_the_building_has_four_directions_that_its_first_line_shows(corner_deg: float) -> None:
    stage = constraint("hde")
    found = drifting(stage, [20.0] * 8 + [20.0 + corner_deg + 3.0] * 8)
    assert found[11].source is HeadingSource.BUILDING
    assert found[11].yaw_error_rad == pytest.approx(np.radians(3.0), abs=1e-6)
    assert found[11].yaw_error_sd_rad > np.radians(2.0)


@pytest.mark.parametrize(
    ("directions", "heading_deg", "error_deg"), [(4, 43.0, None), (8, 43.0, -2.0), (12, 31.0, 1.0)]
)
def test_a_given_building_has_4_8_or_12_directions(
    directions: int, heading_deg: float, error_deg: float | None
) -> None:
    stage = constraint("hde", building_from="given", building_directions=directions, direction_spreads=0.5)
    first = answers(stage, repeated(heading_deg, 4))[3]
    if error_deg is None:
        assert first.source is HeadingSource.NONE
    else:
        assert first.yaw_error_rad == pytest.approx(np.radians(error_deg))


def test_a_given_building_may_stand_askew() -> None:
    stage = constraint("hde", building_from="given", building_heading_rad=float(np.radians(25.0)))
    assert answers(stage, repeated(116.0, 4))[3].yaw_error_rad == pytest.approx(np.radians(1.0))


def test_ihde_says_less_the_worse_a_line_fits() -> None:
    def sd(headings_deg) -> float:
        stage = constraint("ihde", building_from="given")
        return answers(stage, deg(*headings_deg), 0.001)[3].yaw_error_sd_rad

    assert 0.0 < sd([0.0] * 4) < sd([2.5] * 4) < sd([5.0] * 4)
    assert sd([0.0] * 4) < sd([1.5, -1.5, 1.5, -1.5])


def test_a_direction_is_learnt_there_and_used_on_the_way_back() -> None:
    stage = constraint("learned")
    found = drifting(stage, [15.0] * 8 + [100.0, 150.0] + [-162.0] * 8)
    assert said(found)[-1] == len(found)
    assert found[13].yaw_error_rad == pytest.approx(np.radians(3.0), abs=1e-6)


def test_a_new_direction_is_learnt_only_while_the_yaw_is_known() -> None:
    for sd_deg, learnt in ((1.0, True), (4.0, False)):
        stage = constraint("learned")
        answers(stage, repeated(0.0, 8) + repeated(60.0, 8), np.radians(sd_deg))
        back = answers(stage, repeated(180.0, 2) + repeated(-118.0, 8), np.radians(sd_deg), first=17)
        assert bool(said(back)) is learnt


def test_a_line_that_is_far_off_is_left_alone() -> None:
    stage = constraint("learned")
    found = answers(stage, repeated(0.0, 8) + deg(30.0, 60.0).tolist() + repeated(20.0, 8), np.radians(0.5))
    assert all(abs(a.yaw_error_rad) < 1e-9 for a in found)


def test_what_the_filter_turns_is_no_curve() -> None:
    """The yaw is off by 4 degrees: the first answer takes them off, and the strides remembered turn along."""
    stage = constraint("hde", building_from="given", direction_spreads=0.0, stride_sd_rad=0.002, straight_max_rad=0.02)
    found = answers(stage, repeated(4.0, 4) + repeated(0.0, 4), np.radians(5.0))
    assert said(found) == [4, 5, 6, 7, 8]


def test_a_line_that_may_wander_is_held_less() -> None:
    sd_rad = [
        drifting(constraint("dominant", wander_spreads=spreads), [0.0] * 20)[-1].yaw_error_sd_rad
        for spreads in (0.0, 0.4, 1.0)
    ]
    assert sd_rad[0] < sd_rad[1] < sd_rad[2]


@pytest.mark.parametrize("name", ALL)
def test_a_step_on_the_spot_tells_nothing_and_ends_no_line(name: str) -> None:
    stage = constraint(name)
    drifting(stage, [0.0] * 12)
    assert stage.answer(step(13, 1.0, 0.04, length_m=0.0)).source is HeadingSource.NONE
    assert stage.answer(step(14, 0.0, 0.05)).source is not HeadingSource.NONE


@pytest.mark.parametrize("name", ALL)
@pytest.mark.parametrize(
    "broken",
    [
        {"displacement_m": np.full(3, np.nan)},
        {"displacement_m": np.array([np.inf, 0.0, 0.0])},
        {"yaw_sd_rad": np.nan},
        {"yaw_sd_rad": 0.0},
        {"yaw_sd_rad": np.inf},
    ],
)
def test_what_is_no_number_ends_the_line_and_nothing_else(name: str, broken: dict) -> None:
    stage = constraint(name)
    drifting(stage, [0.0] * 12)
    assert stage.answer(replace(step(13, 0.0), **broken)).source is HeadingSource.NONE
    after = drifting(stage, [0.0] * 12, first=14)
    assert said(after)
    assert all(np.isfinite(a.yaw_error_rad) for a in after)
    assert min(said(after)) >= 17


@pytest.mark.parametrize("name", ALL)
def test_steps_numbered_anew_are_a_new_walk(name: str) -> None:
    stage = constraint(name)
    first = drifting(stage, [0.0] * 12)
    again = drifting(stage, [41.0] * 12)
    assert [a.yaw_error_rad for a in again] == pytest.approx([a.yaw_error_rad for a in first], abs=1e-9)
    assert said(again) == said(first)


@pytest.mark.parametrize("name", ALL)
def test_a_clock_that_jumps_back_ends_the_line(name: str) -> None:
    stage = constraint(name)
    drifting(stage, [0.0] * 12)
    back = [replace(step(i, 0.0, 0.03), start_ns=i * SECOND_NS - 50 * SECOND_NS) for i in (13,)]
    assert [stage.answer(s).source for s in back] == [HeadingSource.NONE]


def test_it_is_off_unless_asked_for() -> None:
    assert HeadingParams().constraint == "none"
