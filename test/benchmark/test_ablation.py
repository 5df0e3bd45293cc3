"""What each part of the method is worth: switched off by its parameter, on all development recordings.

`-s` shows the table of pdr_core/docs/navigation.md.
"""

import os
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from pdr_core.bench.ablation import FULL, OFF, without
from pdr_core.params import Params
from support.held_recordings import TILES, VICON, XIO, Held, ate2_m, held, results

DOCUMENT = Path(__file__).resolve().parents[2] / "pdr_core" / "docs" / "navigation.md"


class Row(NamedTuple):
    """One line of the table."""

    vicon_mean_m: float
    vicon_median_m: float
    vicon_worst_m: float
    tiles_mean_m: float
    strides_wrong: float  # of the tile walks
    xio_closure_m: float


WORTH = {  # by how much at least a figure grows without a part; the noise of the sensor helps with noisier ones
    "relative threshold: fixed at 30": Row(10.0, 2.0, 10.0, 10.0, 1.0, 10.0),
    "relative threshold: fixed at 2000": Row(3.0, 1.0, 10.0, 5.0, 1.0, 1.0),
    "confidence": Row(2.0, 2.0, 3.0, 2.0, 1.0, 1.0),
    "rolling contact": Row(1.05, 1.1, 1.0, 1.3, 0.0, 0.0),
    "Huber's weight": Row(1.2, 1.2, 1.5, 3.0, 0.0, 0.0),
    "contradiction": Row(0.0, 0.0, 0.0, 3.0, 1.0, 0.0),
    "noise of change": Row(1.3, 1.0, 3.0, 0.0, 0.0, 0.0),
    "clip repair": Row(1.05, 1.05, 1.1, 0.0, 0.0, 0.0),
    "gyro bias: taken as 0": Row(0.0, 0.0, 0.0, 2.0, 0.0, 0.0),
    "all of these, fixed at 2000": Row(3.0, 2.0, 10.0, 5.0, 1.0, 0.0),
}
COST = Row(0.005, 0.005, 0.01, 0.01, 0.0, 0.015)  # what a part may cost where it does not help
pytestmark = pytest.mark.skipif(os.environ.get("PDR_FULL") != "1", reason="long figures: `pdr test --full`")


def measured(walks: dict[str, Held], params: Params) -> Row:
    vicon_m = list(ate2_m(walks[VICON], params).values())
    tiles = results(walks[TILES], params).values()
    (loop,) = results(walks[XIO], params).values()
    wrong = sum(abs(tile.strides - tile.truth.stride_count_true) for tile in tiles)
    tiles_m = float(np.mean([tile.truth.ate2_m for tile in tiles]))
    return Row(float(np.mean(vicon_m)), float(np.median(vicon_m)), max(vicon_m), tiles_m, wrong, loop.closure_2d_m)


def line(name: str, row: Row) -> str:
    numbers = [f"{x:.0f}" if figure == "strides_wrong" else f"{x:.3f}" for figure, x in row._asdict().items()]
    return f"| {' | '.join([name, *numbers])} |"


@pytest.fixture(scope="module")
def table(recordings: Path) -> dict[str, Row]:
    walks = {folder: held(recordings, folder) for folder in (VICON, TILES, XIO)}
    assert [len(walks[folder]) for folder in (VICON, TILES, XIO)] == [28, 5, 1]
    rows = {name: measured(walks, without(Params(), name)) for name in OFF}
    print("", *(line(name, row) for name, row in rows.items()), sep="\n")
    return rows


@pytest.mark.parametrize("name", WORTH)
def test_without_a_part_the_track_is_worse(table: dict[str, Row], name: str) -> None:
    for figure, least in WORTH[name]._asdict().items():
        without, whole = getattr(table[name], figure), getattr(table[FULL], figure)
        assert without >= max(least * whole, least if figure == "strides_wrong" else 0.0), figure


@pytest.mark.parametrize("name", list(OFF)[1:])
def test_no_part_costs_much_anywhere(table: dict[str, Row], name: str) -> None:
    gains = {f: whole - without for f, whole, without in zip(Row._fields, table[FULL], table[name], strict=True)}
    assert {f: gain for f, gain in gains.items() if gain > getattr(COST, f)} == {}


def test_the_document_shows_what_is_measured(table: dict[str, Row]) -> None:
    cells = [[cell.strip() for cell in text.split("|")[1:-1]] for text in DOCUMENT.read_text().splitlines()]
    shown = {row[0]: [float(cell) for cell in row[1:]] for row in cells if len(row) == 7 and row[0] in OFF}
    assert shown == {name: pytest.approx(row, rel=0.02, abs=0.0015) for name, row in table.items()}
