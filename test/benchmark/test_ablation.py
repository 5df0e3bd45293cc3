"""What each part of the method is worth: switched off by its parameter, on all development recordings.

`-s` shows the table of pdr_core/docs/navigation.md.
"""

import os
from pathlib import Path

import pytest

from pdr_core.bench.ablation import FULL, OFF, without
from pdr_core.params import Params
from support.development_table import Row, line, measured
from support.held_recordings import TILES, VICON, XIO, held

DOCUMENT = Path(__file__).resolve().parents[2] / "pdr_core" / "docs" / "navigation.md"


WORTH = {  # by how much at least a figure grows without a part; the noise of the sensor helps with noisier ones
    "relative threshold: fixed at 30": Row(10.0, 2.0, 10.0, 10.0, 1.0, 10.0),
    "relative threshold: fixed at 2000": Row(3.0, 0.0, 10.0, 5.0, 1.0, 1.0),
    "confidence": Row(2.0, 2.0, 3.0, 2.0, 1.0, 1.0),
    "rolling contact": Row(1.05, 1.1, 1.0, 1.3, 0.0, 0.0),
    "Huber's weight": Row(1.2, 1.2, 1.5, 3.0, 0.0, 0.0),
    "contradiction": Row(0.0, 0.0, 0.0, 3.0, 1.0, 0.0),
    "noise of change": Row(1.3, 0.0, 3.0, 0.0, 0.0, 0.0),
    "clip repair": Row(1.05, 1.0, 1.1, 0.0, 0.0, 0.0),
    "gyro bias: taken as 0": Row(0.0, 0.0, 0.0, 2.0, 0.0, 0.0),
    "all of these, fixed at 2000": Row(3.0, 2.0, 10.0, 5.0, 1.0, 0.0),
}
COST = Row(0.005, 0.005, 0.01, 0.01, 0.0, 0.015)  # what a part may cost where it does not help
pytestmark = pytest.mark.skipif(os.environ.get("PDR_FULL") != "1", reason="long figures: `pdr test --full`")


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
