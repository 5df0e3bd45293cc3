"""Zhou's section 5 as `pdr bench --zhou` has it, with few seeds: the limits of the second lap without the gyro."""

import os

import numpy as np
import pytest

from pdr_bringup_scripts.benches.zhou_cost import StepCost, cost
from pdr_core.bench.zhou_tables import Results, mean, of, zhou_walks
from pdr_core.bench.zhou_testers import TABLE_4_DEG
from pdr_core.bench.zhou_walks import RATES_HZ

pytestmark = pytest.mark.skipif(os.environ.get("PDR_FULL") != "1", reason="long figures: `pdr test --full`")
SEEDS = 3
DISTANCE_PERCENT = {"walking": 1.0, "running": 3.0}


@pytest.fixture(scope="module")
def results() -> Results:
    return zhou_walks(SEEDS)[0]


@pytest.mark.parametrize("gait", DISTANCE_PERCENT)
def test_the_rate_hardly_matters_and_no_stride_is_lost(results: Results, gait: str) -> None:
    laps = {rate: mean(of(results.laps, gait=gait, scheme="ours", rate_hz=rate)) for rate in (200, 20)}
    print(f"\n{gait}: {[f'{rate} Hz {lap.rmse_m:.2f} m' for rate, lap in laps.items()]}", end="")
    assert laps[20].rmse_m <= 1.3 * laps[200].rmse_m
    assert laps[20].corner_error_m <= 1.3 * laps[200].corner_error_m
    assert all(lap.strides == lap.strides_true for lap in of(results.laps, gait=gait, scheme="ours"))


@pytest.mark.parametrize("gait", DISTANCE_PERCENT)
@pytest.mark.parametrize("rate_hz", RATES_HZ)
def test_the_distance_is_right_at_every_rate(results: Results, gait: str, rate_hz: int) -> None:
    found = mean(of(results.laps, gait=gait, scheme="ours", rate_hz=rate_hz))
    print(f"\n{gait}, {rate_hz} Hz: {found.distance_error_percent:.2f} %", end="")
    assert found.distance_error_percent <= DISTANCE_PERCENT[gait]


def test_the_four_deviations_are_found_within_a_degree_and_are_worth_it(results: Results) -> None:
    assert len(results.found) == SEEDS * len(TABLE_4_DEG)
    for one in results.found:
        assert one.learnt_deg == pytest.approx(TABLE_4_DEG[one.tester], abs=1.0)
    for name in TABLE_4_DEG:
        pdr, ours = (mean(of(results.tester_laps, tester=name, scheme=scheme)) for scheme in ("PDR", "ours"))
        assert ours.corner_error_m < 0.5 * pdr.corner_error_m


def test_every_change_is_found_within_two_strides(results: Results) -> None:
    assert len(results.transitions) == SEEDS * 6
    assert max(t.strides for t in results.transitions) <= 2.0


def test_outdoors_the_gyro_sleeps(results: Results) -> None:
    walks = of(results.managed, walk="campus")
    assert walks
    for walk in walks:
        assert walk.duration_s >= 600.0
        assert walk.gyro_on_percent < 15.0
        assert walk.strides == walk.strides_true


def test_ours_is_the_best_step_length_over_changes(results: Results) -> None:
    rms = {m: np.mean([e.rms_cm for e in results.lengths if e.model == m]) for m in {e.model for e in results.lengths}}
    assert min(rms, key=lambda model: rms[model]) == "ours"


@pytest.fixture(scope="module")
def costs() -> list[StepCost]:
    return cost(rates_hz=(200, 50, 20))


def test_a_step_costs_at_most_a_quarter_in_one_language_and_as_it_runs(costs: list[StepCost]) -> None:
    for rate_hz in (200, 50, 20):
        zupt, ours = (next(c for c in costs if (c.method, c.rate_hz) == (m, rate_hz)) for m in ("ZUPT-KF", "ours"))
        print(f"\n{rate_hz} Hz: {ours.interpreted_ms:.1f} of {zupt.interpreted_ms:.1f} ms interpreted", end="")
        print(f", {ours.compiled_ms:.3f} of {zupt.compiled_ms:.3f} ms compiled", end="")
        assert ours.interpreted_ms <= 0.25 * zupt.interpreted_ms
        assert ours.compiled_ms <= 0.25 * zupt.compiled_ms
        assert ours.operations <= 0.3 * zupt.operations
