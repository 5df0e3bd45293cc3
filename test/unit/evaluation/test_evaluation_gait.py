"""Totals, tables and figures of gait analysis."""

import json
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import trapezoid

from pdr_core.evaluation import gait_plots, style
from pdr_core.evaluation.gait_totals import gait_totals, spread
from pdr_core.evaluation.gait_words import gait_rows
from pdr_core.evaluation.mounting_page import Orientations, figure_3, table_2, write_mounting
from pdr_core.evaluation.trace import Trace
from pdr_core.records_gait import CYCLE_POINTS, Mounting

MOUNTING = Mounting(np.array([0.0, 0.0, 0.0, 1.0]), 0.005, 0.01, 6)


def strides(make, climbs_m=(0.0,) * 10, lengths_m=None):
    """Strides along x with these climbs."""
    lengths_m = np.full(len(climbs_m), 1.4) if lengths_m is None else lengths_m
    moved = np.column_stack([lengths_m, np.zeros(len(climbs_m)), climbs_m])
    return make.strides_of(make.steps_at(np.concatenate([np.zeros((1, 3)), np.cumsum(moved, axis=0)])))


def test_totals_of_a_walk(make):
    walk = strides(make, lengths_m=np.array([1.3, 1.5] * 5))
    totals = gait_totals(walk, MOUNTING)
    assert totals.strides == 10
    assert (totals.length_m.mean, totals.length_m.sd) == (pytest.approx(1.4), pytest.approx(0.1 * np.sqrt(10 / 9)))
    assert totals.cadence_per_min.mean == pytest.approx(100.0)  # of the nine whose duration is known
    assert totals.speed_mps.mean == pytest.approx(np.mean([1.3, 1.5] * 4 + [1.3]) / 1.2)
    assert totals.turned_rad == pytest.approx(1.0)
    assert (totals.clearance_max_m, totals.climbed_m, totals.floors_up) == (0.12, 0.0, 0)
    assert np.isnan(totals.riser_m)


def test_stairs_are_counted_by_floors_and_a_slope_is_none(make):
    totals = gait_totals(
        strides(make, (0.05, 0.34, 0.34, 0.34, 0.34, 0.34, 0.34, 0.34, 0.34, 0.34, -0.30, -0.05)), None
    )
    assert (totals.climbed_m, totals.descended_m) == (pytest.approx(3.06), pytest.approx(0.30))
    assert (totals.floors_up, totals.floors_down) == (1, 0)
    assert totals.riser_m == pytest.approx((9 * 0.34 + 0.30) / 20.0)


def test_what_no_stride_knows_is_not_a_number(make):
    nothing = [replace(s, clearance_m=None, turn_rad=None, duration_s=None) for s in strides(make)]
    totals = gait_totals(nothing, None)
    assert np.isnan([totals.clearance_m.mean, totals.clearance_max_m, totals.speed_mps.mean]).all()
    assert totals.turned_rad == 0.0
    assert np.isnan(spread([1.0]).sd)


def test_the_section_of_the_result_is_strict_json(make):
    result = make.result_of(gait=gait_totals(strides(make), MOUNTING))
    section = json.loads(result.to_json())["gait"]
    assert section["length_m"] == {"mean": pytest.approx(1.4), "sd": pytest.approx(0.0, abs=1e-9)}
    assert section["mounting"]["quat_xyzw"] == [0.0, 0.0, 0.0, 1.0]
    assert section["riser_m"] is None
    assert json.loads(make.result_of().to_json())["gait"] is None


def test_the_table_says_what_is_known(make):
    rows = {row.name: row for row in gait_rows(gait_totals(strides(make), MOUNTING))}
    assert rows["Stride length"].mean == "1.40 m"
    assert rows["Largest foot pitch (push-off)"].mean == "51.6 °"
    assert rows["Turned in total (left is positive)"].mean == "57 °"
    assert "Stairs up" not in rows
    stairs = {row.name: row for row in gait_rows(gait_totals(strides(make, (0.34,) * 9), None))}
    assert stairs["Stairs up"].mean == "3.06 m, 1 floor"
    assert stairs["Height of a step of the stairs"].mean == "0.170 m"
    assert stairs["Walking direction in the sensor's axes"].mean == "unknown"


def test_histogram_density_and_normal_each_cover_one(make):
    lengths_m = np.random.default_rng(4).normal(1.4, 0.05, 300)
    bars, kernel, normal = gait_plots.lengths(strides(make, (0.0,) * 300, lengths_m)).data
    assert np.sum(bars.y) * bars.width == pytest.approx(1.0, abs=1e-3)
    for line in (kernel, normal):
        assert trapezoid(line.y, line.x) == pytest.approx(1.0, abs=0.06)
    assert normal.x[int(np.argmax(normal.y))] == pytest.approx(1.4, abs=0.01)


def test_equal_lengths_have_no_density_and_wild_ones_few_bars(make):
    assert len(gait_plots.lengths(strides(make)).data) == 1
    wild = np.concatenate([np.full(500, 1.4) + np.linspace(0.0, 1e-3, 500), [90.0]])
    assert len(gait_plots.lengths(strides(make, (0.0,) * 501, wild)).data[0].x) <= gait_plots.MOST_BARS


def test_the_pitch_of_many_strides_is_thinned_but_not_its_mean(make):
    faint, mean = gait_plots.pitch(strides(make, (0.0,) * 1000)).data
    assert len(faint.x) == len(faint.y) < 10_000
    assert faint.y[CYCLE_POINTS] is None
    assert max(mean.y) == pytest.approx(50.0, abs=0.01)


def test_heights_over_the_distance(make):
    walk = strides(make, (0.0, 0.34, 0.34))
    walk[1] = replace(walk[1], clearance_m=None)
    height, clearance = gait_plots.climb(walk).data
    np.testing.assert_allclose(height.x, [1.4, 2.8, 4.2])
    np.testing.assert_allclose(height.y, [0.0, 0.34, 0.68])
    assert clearance.y == (0.12, None, 0.12)


def test_the_heading_goes_on_beyond_half_a_turn(make):
    walk = [replace(s, turn_rad=-0.5, heading_change_rad=-0.5) for s in strides(make, (0.0,) * 20)]
    walk_line, foot = gait_plots.heading(walk, Trace()).data
    assert foot.y[-1] == pytest.approx(np.degrees(-10.0), rel=1e-4)
    assert np.abs(np.diff(walk_line.y)).max() < 30.0


def test_velocity_is_that_of_the_world(make):
    trace = Trace()
    nav = make.nav_block(np.arange(4) * 10_000_000, np.zeros((4, 3)), np.pi / 2.0)
    nav.velocity_mps[:, 0] = 2.0
    trace.add(make.stance_block(nav.stamp_ns, np.zeros(4, bool)), nav)
    x, y, z = gait_plots.velocity(trace).data
    np.testing.assert_allclose([x.y, y.y, z.y], [[0.0] * 4, [2.0] * 4, [0.0] * 4], atol=1e-9)
    assert len(style.listed(np.array(x.x))) == 4


def test_the_alignment_as_qiu_shows_it(tmp_path):
    """Table 2: the scalar comes first; three samples before the alignment, the same three after it."""
    before, after = np.tile([0.6, 0.0, 0.0, 0.8], (50, 1)), np.tile([0.0, 0.0, 0.0, 1.0], (50, 1))
    shown = Orientations(np.arange(50) * 10_000_000, before, after, slice(10, 21))
    table = table_2(shown)
    assert [row[0] for row in table] == [1, 2, 3, 4, 5, 6]
    assert [row[1] for row in table] == pytest.approx([0.1, 0.15, 0.2] * 2)
    assert {row[2:] for row in table[:3]} == {(0.8, 0.6, 0.0, 0.0)}
    assert {row[2:] for row in table[3:]} == {(1.0, 0.0, 0.0, 0.0)}
    assert [line.name for line in figure_3(shown).data[1:3]] == ["q0 sensor", "q0 body"]
    write_mounting(tmp_path / "m.html", "<walk>", "words", shown)
    text = (tmp_path / "m.html").read_text(encoding="utf-8")
    assert "&lt;walk&gt;" in text
    assert 0 < text.index("<td>0.80000</td>") < text.index("<td>1.00000</td>")
