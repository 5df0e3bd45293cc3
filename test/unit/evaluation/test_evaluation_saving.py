"""The charge of a run, for a machine and for a person."""

import json
from dataclasses import replace

import pytest

from pdr_core.conventions import NANOSECONDS
from pdr_core.evaluation.mode_plots import modes
from pdr_core.evaluation.report import report
from pdr_core.evaluation.result import in_words
from pdr_core.evaluation.saving import Saving
from pdr_core.evaluation.trace import Trace
from pdr_core.records_power import Charge, DriverAnswer, Energy, Mode, ModeCommand, Outcome

ENERGY = Energy("mpu9250", 100.0, 25.0, 3, 1e-4, Charge(0.04, 0.06), Charge(0.1, 0.12))
COMMANDS = [
    ModeCommand(1, 5 * NANOSECONDS, Mode.INITIALISING, "the walk begins", True, 1000.0, 0),
    ModeCommand(2, 30 * NANOSECONDS, Mode.DEAD_RECKONING, "good", False, 50.0, 0),
]


def test_a_result_brings_the_charge_and_the_timeline(make):
    result = replace(make.result_of(), saving=Saving(ENERGY, COMMANDS))
    energy = json.loads(result.to_json())["energy"]
    assert energy["gyro_on_share"] == 0.25
    assert energy["sensor_saved_share"] == pytest.approx(0.6)
    assert energy["node_saved_share"] == pytest.approx(0.5)
    assert energy["drawn"] == {"sensor_mah": 0.04, "node_mah": 0.06}
    assert [(m["t_s"], m["mode"], m["gyro"]) for m in energy["modes"]] == [
        (0.0, "initialising", True),
        (25.0, "dead_reckoning", False),
    ]


def test_words_say_how_long_the_gyro_was_on_and_what_that_saved(make):
    result = replace(make.result_of(), saving=Saving(ENERGY, COMMANDS))
    assert "The gyro was on for 25.0 % of the time" in in_words(result)
    assert "1.44 mAh an hour, 60.0 % less" in in_words(result)
    assert "power.calibration_m" not in in_words(result)


def test_words_say_what_a_gyro_that_never_slept_has_waited_for(make):
    result = replace(make.result_of(), saving=Saving(ENERGY, COMMANDS[:1]))
    assert "once power.calibration_m of a gait are measured" in in_words(result)


def test_a_result_without_a_switched_gyro_says_nothing_of_charge(make):
    assert "energy" not in json.loads(make.result_of().to_json())
    assert "mAh" not in in_words(make.result_of())


ACKNOWLEDGED = DriverAnswer(1, 5 * NANOSECONDS, Outcome.ACKNOWLEDGED, 5 * NANOSECONDS + 60_000_000, 0.05)
REFUSED = DriverAnswer(2, 30 * NANOSECONDS, Outcome.REFUSED, 0, 0.0, "not today")


def test_a_table_says_what_a_driver_was_asked_and_has_answered():
    rows = Saving(ENERGY, COMMANDS, [ACKNOWLEDGED, REFUSED]).rows()
    assert rows[0] == (
        "0.00 s",
        "gyro on, 1000 Hz",
        "acknowledged, holds 0.06 s later",
        "initialising: the walk begins",
    )
    assert rows[1] == ("25.00 s", "gyro off, 50 Hz", "refused: not today", "dead reckoning: good")
    assert [row.answer for row in Saving(ENERGY, COMMANDS).rows()] == ["", ""]


def test_a_clock_that_jumps_back_does_not_turn_the_timeline():
    back = replace(COMMANDS[0], stamp_ns=3 * NANOSECONDS)
    assert Saving(ENERGY, [*COMMANDS, back]).times_s.tolist() == [0.0, 25.0, 25.0]


def test_the_figure_shades_the_gyro_and_draws_the_modes():
    on, mode = modes(Saving(ENERGY, COMMANDS)).data
    assert sorted({x for x in on.x if x is not None}) == [0.0, 25.0]
    assert list(mode.x) == [0.0, 25.0, 100.0]
    assert list(mode.customdata) == ["initialising", "dead reckoning", "dead reckoning"]
    assert mode.line.shape == "hv"


def test_swings_are_told_and_drawn_and_not_shaded():
    swings = ModeCommand(3, 60 * NANOSECONDS, Mode.SWINGS, "good", True, 1000.0, 0, on_motion=True)
    saving = Saving(ENERGY, [*COMMANDS, swings])
    assert saving.rows()[2].what == "gyro on in swings, 1000 Hz"
    on, mode = modes(saving).data
    assert sorted({x for x in on.x if x is not None}) == [0.0, 25.0]
    assert mode.customdata[2] == "swings"


def test_the_figure_has_a_row_for_every_mode():
    commands = [replace(COMMANDS[0], mode=mode) for mode in Mode]
    _, drawn = modes(Saving(ENERGY, commands)).data
    assert list(drawn.customdata[:-1]) == [mode.name.lower().replace("_", " ") for mode in Mode]


def test_the_page_shows_timeline_and_table_only_where_a_gyro_was_switched(make):
    switched = replace(make.result_of(), saving=Saving(ENERGY, COMMANDS, [ACKNOWLEDGED, REFUSED]))
    words = report(switched, Trace(), [], None), report(make.result_of(), Trace(), [], None)
    for text in ("What the driver was asked", "not today", "of the charge saved", 'id="modes"'):
        assert [text in page for page in words] == [True, False], text
