"""Every stance detector with every time gate on all development recordings, in the default filter and in a plain one.

`-s` shows the tables of pdr_core/docs/detectors.md.
"""

import os
import re
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import NamedTuple

import pytest

from pdr_bringup_scripts.compare.comparing import walk_of
from pdr_core.bench.ablation import without
from pdr_core.bench.detectors import DETECTORS, with_choice
from pdr_core.bench.trial import Walk, trial
from pdr_core.evaluation.detector_study import Choice
from pdr_core.evaluation.walk_score import summary
from pdr_core.params import Params, changed
from pdr_core.pipeline.stance_phases import TIME_GATES
from pdr_core.recording import open_recording

DOCUMENT = Path(__file__).resolve().parents[2] / "pdr_core" / "docs" / "detectors.md"
VICON, TILES, XIO, GAITMAP = "pyshoe_vicon", "tile_walks_marg", "xio_ngimu", "gaitmap_dual_foot"
FILES = {VICON: ("*.mat", 28), TILES: ("*.csv", 5), XIO: ("*.csv", 1), GAITMAP: ("imu_sample.csv", 2)}
PLAIN = ("confidence", "rolling contact", "Huber's weight", "contradiction", "gyro bias: taken as 0")
FILTERS = ("The default filter", "A plain filter")
Groups = dict[str, list[Walk]]
pytestmark = pytest.mark.skipif(os.environ.get("PDR_FULL") != "1", reason="long figures: `pdr test --full`")


class Row(NamedTuple):
    """One line of a table."""

    vicon_mean_m: float
    vicon_median_m: float
    vicon_worst_m: float
    vicon_over_1_m: int
    tiles_mean_m: float
    strides_wrong: int  # of the tile walks
    xio_closure_m: float
    gaitmap_mean_m: float


def filter_params(name: str) -> Params:
    params = Params()
    for part in PLAIN if name == FILTERS[1] else ():
        params = without(params, part)
    return params


def measured(groups: Groups, params: Params, choice: Choice) -> Row:
    chosen = with_choice(params, choice)
    two_passes = choice.gate.endswith("offline")
    of = {name: summary([trial(walk, chosen, two_passes).score for walk in some]) for name, some in groups.items()}
    room, tiles = of[VICON], of[TILES]
    spread = (room.mean_m, room.median_m, room.worst_m, room.failed)
    return Row(*spread, tiles.mean_m, tiles.strides_wrong, of[XIO].closure_2d_m, of[GAITMAP].mean_m)


def cell(value: float) -> str:
    return str(value) if isinstance(value, int) else f"{value:.3f}"


def line(choice: Choice, row: Row) -> str:
    return f"| {' | '.join([*(f'`{name}`' for name in choice), *map(cell, row)])} |"


def lines() -> Iterator[tuple[str, list[str]]]:
    """Every table row of the document that begins with a detector, and the heading above it."""
    heading = ""
    for text in DOCUMENT.read_text().splitlines():
        heading = text.lstrip("# ") if text.startswith("#") else heading
        cells = [cell.strip(" `") for cell in re.split(r"(?<!\\)\|", text)[1:-1]]
        if cells and cells[0] in DETECTORS:
            yield heading, cells


@pytest.fixture(scope="module")
def groups(recordings: Path) -> Groups:
    found = {}
    for folder, (pattern, count) in FILES.items():
        paths = sorted((recordings / folder).glob(pattern))
        sessions = {path.stem: open_recording(path) for path in paths}
        found[folder] = [walk_of(s, sensor, name) for name, s in sessions.items() for sensor in s.sensors.values()]
        assert len(found[folder]) == count, folder
    return found


@pytest.fixture(scope="module")
def tables(groups: Groups) -> dict[str, dict[Choice, Row]]:
    choices = [Choice(detector, gate) for detector in DETECTORS for gate in TIME_GATES]
    found = {name: {c: measured(groups, filter_params(name), c) for c in choices} for name in FILTERS}
    for name, rows in found.items():
        print("", f"### {name}", "", *(line(choice, row) for choice, row in rows.items()), sep="\n")
    return found


def test_the_document_shows_what_is_measured(tables: dict[str, dict[Choice, Row]]) -> None:
    shown = {(head, Choice(*cells[:2])): list(map(float, cells[2:])) for head, cells in lines() if head in FILTERS}
    expected = {(name, choice): list(row) for name, rows in tables.items() for choice, row in rows.items()}
    assert shown == {key: pytest.approx(row, rel=0.02, abs=0.0015) for key, row in expected.items()}


def test_the_default_is_the_only_one_that_no_walk_defeats(tables: dict[str, dict[Choice, Row]]) -> None:
    rows = tables[FILTERS[0]]
    default = rows[Choice("adaptive", "none")]
    assert (default.vicon_over_1_m, default.strides_wrong) == (0, 0)
    assert default.vicon_worst_m == min(row.vicon_worst_m for c, row in rows.items() if c.gate == "none")


def test_a_plain_filter_costs_every_detector(tables: dict[str, dict[Choice, Row]]) -> None:
    for choice, row in tables[FILTERS[0]].items():
        assert tables[FILTERS[1]][choice].vicon_median_m > 1.3 * row.vicon_median_m, choice


def test_gates_help_a_plain_filter(tables: dict[str, dict[Choice, Row]]) -> None:
    alone, *gated = (tables[FILTERS[1]][Choice("adaptive", gate)] for gate in TIME_GATES)
    assert all(row.vicon_mean_m < 0.95 * alone.vicon_mean_m for row in gated)
    assert all(row.tiles_mean_m < 0.5 * alone.tiles_mean_m for row in gated)


def test_the_document_names_windows_and_thresholds_as_they_are() -> None:
    told = {cells[0]: cells for head, cells in lines() if head == "Detectors"}
    own, adaptive = asdict(Params().detectors), told.pop("adaptive")
    assert {*told, adaptive[0]} == set(DETECTORS)
    assert float(adaptive[3]) == Params().stance.window_s
    for name, (_, statistic, _, window, threshold, *_) in told.items():
        limits = [value for key, value in own.items() if key.startswith(name) and key.endswith("threshold")]
        within = [float(text) for text in re.findall(r" / ([\d.]+)", statistic)]
        assert (float(window), within or [float(threshold)]) == (own[f"{name}_window_s"], limits), name


def test_a_detector_is_told_apart_from_one_that_always_says_stance(groups: Groups) -> None:
    never_moving = changed(Params(), "detectors", glrt_threshold=1e9)
    assert measured(groups, never_moving, Choice("glrt", "none")).strides_wrong > 100
