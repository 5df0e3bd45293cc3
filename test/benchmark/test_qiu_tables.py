"""Qiu's Tables 3, 4 and 5 and his stairs as `pdr bench --qiu` has them: the targets of the suite's own chain."""

import os

import pytest

from pdr_core.bench.qiu_tables import Means, means, of
from pdr_core.bench.qiu_walks import QiuResult, measured, trials

pytestmark = pytest.mark.skipif(os.environ.get("PDR_FULL") != "1", reason="long figures: `pdr test --full`")


@pytest.fixture(scope="module")
def results() -> list[QiuResult]:
    return [measured(trial).result for trial in trials()]


def mean(results: list[QiuResult], table: str) -> Means:
    found = means(of(results, table, "ESKF"))
    print(f"\nTable {table}: {found}", end="")
    return found


def test_every_stride_is_found(results: list[QiuResult]) -> None:
    assert [(r.table, r.trial, r.strides) for r in results if r.strides != r.strides_true] == []


def test_rectangle(results: list[QiuResult]) -> None:
    assert mean(results, "3").distance_error_percent < 0.5
    assert mean(results, "3").error_per_turn_deg < 0.6


@pytest.mark.parametrize("table", ["4", "5"])
def test_track(results: list[QiuResult], table: str) -> None:
    assert mean(results, table).distance_error_percent <= 0.4
    assert mean(results, table).end_error_percent <= 0.5


def test_stairs(results: list[QiuResult]) -> None:
    assert [r.height_error_percent for r in of(results, "stairs", "ESKF") if abs(r.height_error_percent) > 2.0] == []
