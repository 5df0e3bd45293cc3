"""The curve of gyro time against end error: how its figures are made, printed and drawn."""

import json
import re

import numpy as np
import pytest

from pdr_bringup_scripts.benches import energy_tables
from pdr_bringup_scripts.benches.energy_tables import Found, Group
from pdr_core.bench.energy_walks import (
    ALWAYS,
    SCHEMES,
    EnergyRun,
    Unpaired,
    energy_run,
    known,
    means,
    on_share,
    simulated,
)
from pdr_core.bench.trial import Walk
from pdr_core.records import Truth, TruthKind, part
from pdr_core.records_power import PowerState

RUNS = [
    EnergyRun("31", ALWAYS, 1.0, 2.0, -1.0, 0, 0, 0.0),
    EnergyRun("33", ALWAYS, 1.0, 1.0, 2.0, 0, 0, 0.0),
    EnergyRun("31", "swing", 0.5, 4.0, 3.0, 1, 17, 0.2),
    EnergyRun("33", "swing", 0.4, 2.0, -1.0, -1, 24, 0.3),
]
FOUND = Found([Group("Real walks in a building", RUNS)], "no simulated walks: a test")


def test_the_share_of_the_gyro_counts_from_what_holds_at_the_start():
    states = [PowerState(0, True, 200.0), PowerState(10, False, 200.0), PowerState(30, True, 200.0)]
    assert on_share(states, 20, 40) == pytest.approx(0.5)
    assert on_share(states, 0, 40) == pytest.approx(0.5)
    assert on_share([], 20, 40) == 1.0


def test_a_mean_takes_sizes_of_distance_errors_and_adds_counts():
    always, swing = means(RUNS)
    assert (always.scheme, always.distance_error_percent) == (ALWAYS, 1.5)
    assert swing.gyro_share == pytest.approx(0.45)
    assert (swing.end_error_percent, swing.strides_missed, swing.switch_ons) == (3.0, 0, 41)


def test_every_figure_is_printed_written_and_drawn(tmp_path, capsys):
    energy_tables.show(FOUND)
    shown = capsys.readouterr().out
    for text in ("50, 4.0", "40, 2.0", "45.0", FOUND.left_out):
        assert text in shown
    assert max(map(len, shown.splitlines())) <= 120
    energy_tables.write_files(tmp_path, FOUND)
    written = json.loads((tmp_path / "energy.json").read_text())
    assert [run["gyro_share"] for run in written["runs"]["Real walks in a building"]] == [1.0, 1.0, 0.5, 0.4]
    page = (tmp_path / "energy.html").read_text()
    (curve,) = [json.loads(text) for text in re.findall(r'<script type="application/json">(.*?)</script>', page)]
    points = {(trace["name"], x, y) for trace in curve["data"] for x, y in zip(trace["x"], trace["y"], strict=True)}
    assert {("swing", 50, 4), ("swing", 40, 2), ("swing", 45, 3), (ALWAYS, 100, 1.5)} <= points


def test_real_walks_that_are_absent_are_left_out_with_the_reason(tmp_path):
    assert "--recordings" in energy_tables.missing(None)
    assert str(tmp_path / "tile_walks_marg") in energy_tables.missing(tmp_path)


def test_steps_that_are_not_those_of_the_truth_are_refused():
    walk = simulated("outdoors", 1)
    truth = Truth(TruthKind.STRIDES, np.zeros(3, np.int64), np.zeros((3, 3)))
    imu = part(walk.pieces[0], 0, 4000)
    short = Walk("short", [imu], truth)
    with pytest.raises(Unpaired, match="short"):
        known(short)


def test_every_scheme_is_one_of_parameters_that_exist():
    from pdr_core.params import Params, changed

    for values in SCHEMES.values():
        for group, fields in values.items():
            assert changed(Params(), group, **fields) != Params()


def test_the_gyro_that_is_always_on_is_the_filter():
    run = energy_run(known(simulated("outdoors", 1)), ALWAYS)
    assert run.gyro_share == 1.0
    assert run.switch_ons == run.strides_missed == 0
    assert run.end_error_percent < 2.0
