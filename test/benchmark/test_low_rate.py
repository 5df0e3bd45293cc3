"""What a low sample rate costs on the development recordings, by how the rate was lowered.

`-s` shows the table of pdr_core/docs/navigation.md.
"""

import os
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from pdr_core.maths.thinning import kept_of, thinned
from pdr_core.params import Params, changed
from pdr_core.recording import Session
from pdr_core.recording.decimation import rate_of_hz
from pdr_core.records import ImuBlock, length, part
from support.development_table import Row, line, measured
from support.held_recordings import TILES, VICON, XIO, Held, held, only, with_samples

DOCUMENT = Path(__file__).resolve().parents[2] / "pdr_core" / "docs" / "navigation.md"
NATIVE = "as recorded"
AVERAGES = changed(Params(), "filter", samples="averages")
MEANS = changed(Params(), "filter", samples="means")
pytestmark = pytest.mark.skipif(os.environ.get("PDR_FULL") != "1", reason="long figures: `pdr test --full`")
Lower = Callable[[ImuBlock, int], ImuBlock]


def filtered(samples: ImuBlock, k: int) -> ImuBlock:
    return thinned(samples, 0, length(samples), k)


def dropped(samples: ImuBlock, k: int) -> ImuBlock:
    return ImuBlock._make(np.ascontiguousarray(column[::k]) for column in samples)


def averaged(samples: ImuBlock, k: int) -> ImuBlock:
    """Each sample the mean of k, at the last one's stamp: a sensor that averages."""
    whole = part(samples, 0, length(samples) // k * k)
    means = (column.reshape(-1, k, *column.shape[1:]).mean(axis=1) for column in whole[1:])
    return ImuBlock(whole.stamp_ns[k - 1 :: k].copy(), *means)


WAYS: dict[str, tuple[Lower, Params]] = {
    "filtered": (filtered, Params()),
    "averaged, `averages`": (averaged, AVERAGES),
    "averaged, `means`": (averaged, MEANS),
    "samples dropped": (dropped, Params()),
}
AT_MOST = {  # mean, median and worst of Vicon, mean of the tiles
    NATIVE: (0.060, 0.045, 0.15, 0.18),
    "100 Hz filtered": (0.065, 0.050, 0.20, 0.20),
    "100 Hz averaged, `averages`": (0.065, 0.050, 0.20, 0.20),
    "100 Hz samples dropped": (0.085, 0.070, 0.25, 0.30),
    "50 Hz filtered": (0.075, 0.060, 0.35, 0.25),
    "50 Hz averaged, `averages`": (0.075, 0.060, 0.35, 0.27),
    "50 Hz samples dropped": (0.25, 0.20, 1.0, 0.35),
}


def slower(walk: Session, lower: Lower, rate_hz: float) -> Session:
    k = kept_of(rate_of_hz(only(walk)), rate_hz)
    return with_samples(walk, lambda samples: lower(samples, k))


def lowered(walks: dict[str, Held], lower: Lower, rate_hz: float) -> dict[str, Held]:
    return {
        folder: {name: slower(walk, lower, rate_hz) for name, walk in group.items()} for folder, group in walks.items()
    }


@pytest.fixture(scope="module")
def table(recordings: Path) -> dict[str, Row]:
    walks = {folder: held(recordings, folder) for folder in (VICON, TILES, XIO)}
    assert [len(group) for group in walks.values()] == [28, 5, 1]
    rows = {NATIVE: measured(walks, Params())}
    for rate_hz in (100.0, 50.0):
        for way, (lower, params) in WAYS.items():
            rows[f"{rate_hz:.0f} Hz {way}"] = measured(lowered(walks, lower, rate_hz), params)
    print("", *(line(name, row) for name, row in rows.items()), sep="\n")
    return rows


@pytest.mark.parametrize("name", AT_MOST)
def test_a_low_rate_costs_little(table: dict[str, Row], name: str) -> None:
    row = table[name]
    assert row.strides_wrong == 0
    for found, most in zip(row[:4], AT_MOST[name], strict=True):
        assert found <= most


@pytest.mark.parametrize("rate_hz", [100, 50])
def test_a_filter_is_better_than_dropping_samples(table: dict[str, Row], rate_hz: int) -> None:
    by_filter, by_dropping = table[f"{rate_hz} Hz filtered"], table[f"{rate_hz} Hz samples dropped"]
    assert all(good < bad for good, bad in zip(by_filter[:4], by_dropping[:4], strict=True))


@pytest.mark.parametrize("rate_hz", [100, 50])
def test_averages_are_not_taken_for_what_a_sensor_integrated(table: dict[str, Row], rate_hz: int) -> None:
    averages, means = table[f"{rate_hz} Hz averaged, `averages`"], table[f"{rate_hz} Hz averaged, `means`"]
    assert averages.tiles_mean_m < 0.9 * means.tiles_mean_m


def test_the_document_shows_what_is_measured(table: dict[str, Row]) -> None:
    cells = [[cell.strip() for cell in text.split("|")[1:-1]] for text in DOCUMENT.read_text().splitlines()]
    shown = {row[0]: [float(cell) for cell in row[1:]] for row in cells if len(row) == 7 and row[0] in table}
    assert shown == {name: pytest.approx(row, rel=0.02, abs=0.0015) for name, row in table.items()}
