"""`pdr bench --zhou`: what goes together, tables, page and JSON, on figures made up; the walks are tested elsewhere."""

import json
import re

import numpy as np
import pytest

from pdr_bringup_scripts.benches import zhou_tables
from pdr_bringup_scripts.benches.zhou_cost import StepCost
from pdr_core.bench.zhou_errors import LapResult, result
from pdr_core.bench.zhou_features import Features
from pdr_core.bench.zhou_lengths import LengthError, Lengths
from pdr_core.bench.zhou_modes import Change, Managed, Timeline, Transition
from pdr_core.bench.zhou_schemes import SCHEMES, Track
from pdr_core.bench.zhou_tables import Drawn, Results
from pdr_core.bench.zhou_testers import TABLE_4_DEG, Found, Observed
from pdr_core.bench.zhou_walks import RATES_HZ, WALKS, Trial, octagon
from pdr_core.records_gait import Behaviour
from pdr_core.records_power import Mode, ModeCommand
from support.processes import check_refused, pdr


def test_zhous_walks_are_their_own(tmp_path):
    check_refused(pdr("bench", "--zhou", "--length", 5), "--zhou", "leave out --length")
    check_refused(pdr("bench", "--zhou", "--gui", "--out", tmp_path / "page"), "--zhou", "choose one")
    assert not (tmp_path / "page").exists()


@pytest.fixture(scope="module")
def zhou_results():
    """Two walks of everything, with figures of their own."""
    laps = [
        LapResult(gait, tester, seed, scheme, rate, 1.25 * seed, 2.5, 0.75, 1.5, 0.5, 0.875, 136 + seed, 136)
        for gait in WALKS
        for tester in TABLE_4_DEG
        for seed in (1, 2)
        for scheme in SCHEMES
        for rate in RATES_HZ
    ]
    return Results(
        laps=[lap for lap in laps if lap.tester == "a"],
        found=[
            Found("walking", name, seed, deg, deg + 0.5, deg + 2.0, deg + 0.2 * seed)
            for name, deg in TABLE_4_DEG.items()
            for seed in (1, 2)
        ],
        tester_laps=[lap for lap in laps if (lap.gait, lap.rate_hz) == ("walking", 100)],
        managed=[Managed("campus", "a", s, 630.0, 648.0, 10.0 + s, 72.5, 6.0, 516, 516) for s in (1, 2)],
        transitions=[Transition("walking", "running", 9.0, s, 2.0 * s) for s in (1.5, np.inf)],
        lengths=[LengthError("ours", "a", 1, 2.75, 0.5, -0.75), LengthError("ours", "a", 2, 2.75, 0.5, 0.25)],
    )  # fmt: skip


COSTS = [StepCost("ZUPT-KF", 200, 1.42e6, 200.0, 0.7), StepCost("ours", 200, 1.59e5, 20.0, 1.1)]


def test_zhous_tables_show_the_figures(zhou_results, capsys):
    zhou_tables.show(zhou_results, COSTS)
    shown = capsys.readouterr().out
    assert max(map(len, shown.splitlines())) <= 120
    cells = [line.split() for line in shown.splitlines()]
    assert ["ours", "20", "1.88", "2.50", "0.75", "1.5", "0.50", "0.88", "+3"] in cells
    assert ["A", "29.2", "29.50", "29.40", "..", "29.60", "0.40", "31.20"] in cells
    assert ["D", "1.88", "1.88", "2.50", "2.50"] in cells
    assert ["ours", "200", "1.59e+05", "20.0", "0.10", "1.10"] in cells
    assert ["walking", "running", "2", "1", "inf", "inf", "inf", "inf"] in cells
    assert ["campus", "2", "630", "648", "11.5", "12.0", "72.5", "6.00", "+0"] in cells
    assert ["ours", "2.8", "0.5", "0.50", "0.75"] in cells


@pytest.fixture(scope="module")
def zhou_drawn():
    """A true lap, by every scheme, and what else is drawn."""
    walked = octagon(Trial("running", "b", 1))
    track = Track(walked.stand_m[walked.half :], walked.stand_yaw_rad[walked.half :], 0.1, 88, 175.0)
    assert result(walked, "ours", 50, track).rmse_m < 1e-9
    row = np.arange(3.0)
    commands = [ModeCommand(i, i * 10**9, mode, "", mode is Mode.INITIALISING, 50.0, 0) for i, mode in enumerate(Mode)]
    return Drawn(
        octagons={"running": walked},
        tracks={("running", scheme, rate): track for scheme in SCHEMES for rate in RATES_HZ},
        observed={"running": Observed(row, row, row + 5.0, row + 6.0, row + 4.0, 5.5)},
        features=[Features("walking fast", row, row, row)],
        timeline=Timeline([Change(0.0, Behaviour.STANDING)], [Change(0.5, Behaviour.WALKING)], commands),
        lengths=Lengths(row, row + 1.0, {"kim": row, "ours": row + 1.0}, [True, True, False]),
    )


def test_zhous_page_and_json_hold_every_figure(zhou_results, zhou_drawn, tmp_path):
    zhou_tables.write_files(tmp_path, zhou_results, COSTS, zhou_drawn)
    assert set(zhou_tables.FILES.split(", ")) == {path.name for path in tmp_path.iterdir()}
    page = (tmp_path / "zhou.html").read_text()
    drawn = [json.loads(text) for text in re.findall(r'<script type="application/json">(.*?)</script>', page)]
    assert len(drawn) == 4 + 1 + 2 + 1
    assert [trace["name"] for trace in drawn[0]["data"]] == ["Truth", *SCHEMES]
    deviation = {trace["name"]: trace["y"] for trace in drawn[3]["data"]}
    assert deviation["of each stride, eq. 20"] == pytest.approx([5.0, 5.0, 5.0])
    modes = {trace["name"]: trace for trace in drawn[6]["data"]}
    assert modes["gyro"]["y"] == [1.0] + [0.0] * (len(Mode) - 1)
    assert modes["mode"]["line"]["shape"] == "hv"
    assert drawn[6]["layout"]["yaxis"]["ticktext"][:3] == ["gyro off", "gyro on", "initialising"]
    found = json.loads((tmp_path / "zhou.json").read_text())
    assert found == json.loads(zhou_tables.as_json(zhou_results, COSTS))
    assert [t["strides"] for t in found["transitions"]] == [3.0, None]
    assert found["costs"][1]["operations"] == 1.59e5
