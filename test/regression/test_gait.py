"""Stride analysis on real recordings: counts, events, pitch and stairs; `-s` shows the figures."""

import csv
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest

from pdr_core.conventions import NANOSECONDS
from pdr_core.evaluation.gait_totals import gait_totals
from pdr_core.params import Params, changed
from pdr_core.pipeline import FootGait, FootInertial
from pdr_core.recording import Sensor, open_recording
from pdr_core.records_gait import Mounting, Stride

RATE_HZ = 204.8  # of gaitmap
LONGEST_SWING_S = 0.8
FEET = ("left", "right")


def analysed(sensor: Sensor, params: Params | None = None) -> tuple[list[Stride], Mounting | None]:
    chain, gait = FootInertial(params or Params()), FootGait()
    strides = [stride for piece in sensor.pieces() for stride in gait.run(chain.run(piece))]
    strides += gait.run(chain.finish()) + gait.finish()
    return strides, gait.mounting


def only(path: Path, params: Params | None = None) -> tuple[list[Stride], Mounting | None]:
    (sensor,) = open_recording(path).sensors.values()
    return analysed(sensor, params)


@pytest.fixture(scope="module")
def feet(recordings: Path) -> dict[str, list[Stride]]:
    session = open_recording(recordings / "gaitmap_dual_foot" / "imu_sample.csv")
    return {foot: analysed(session.sensors[f"{foot}_sensor"])[0] for foot in FEET}


def events_s(recordings: Path, foot: str, name: str) -> np.ndarray:
    """Return an event of every stride that gaitmap lists [s]; a swing that is no swing is left out."""
    with (recordings / "gaitmap_dual_foot" / "stride_events_sample.csv").open() as file:
        rows = [row for row in csv.DictReader(file) if row["foot"] == foot]
    good = [row for row in rows if float(row["ic"]) - float(row["tc"]) < LONGEST_SWING_S * RATE_HZ]
    assert len(good) >= len(rows) - 1
    return np.array([float(row[name]) for row in good]) / RATE_HZ


def found_s(strides: list[Stride], name: str) -> np.ndarray:
    return np.array([getattr(stride, name) for stride in strides]) / NANOSECONDS


def nearest_errors_s(found: np.ndarray, listed: np.ndarray) -> np.ndarray:
    return np.array([found[np.argmin(np.abs(found - t))] - t for t in listed])


@pytest.mark.parametrize("foot", FEET)
def test_toe_off_and_heel_strike_beside_those_of_gaitmap(recordings: Path, feet: dict, foot: str) -> None:
    """Its events come from another method on the same samples: they are no truth, and its strike is early."""
    for name, listed, early_ms, late_ms in (("toe_off_ns", "tc", 5.0, 25.0), ("heel_strike_ns", "ic", 10.0, 40.0)):
        errors_ms = 1e3 * nearest_errors_s(found_s(feet[foot], name), events_s(recordings, foot, listed))
        print(f"\n{foot} {name}: {errors_ms.mean():.1f} +- {errors_ms.std():.1f} ms, worst {abs(errors_ms).max():.0f}")
        assert early_ms <= errors_ms.mean() <= late_ms
        assert errors_ms.std() <= 16.0


@pytest.mark.parametrize("foot", FEET)
def test_the_heel_strikes_when_its_marker_stops(recordings: Path, feet: dict, foot: str) -> None:
    """The marker on the heel is slower than 0.8 m/s, of 4.5 at the most, from the strike on."""
    table = np.genfromtxt(recordings / "gaitmap_dual_foot" / "mocap_sample.csv", delimiter=",", skip_header=2)
    first = {"left": 7, "right": 10}[foot]
    speed_mps = np.linalg.norm(np.gradient(table[:, first : first + 3] * 1e-3, 0.01, axis=0), axis=1)
    stops_s = np.flatnonzero((speed_mps[1:] < 0.8) & (speed_mps[:-1] >= 0.8)) * 0.01
    strikes_s = found_s(feet[foot][:-1], "heel_strike_ns")
    errors_ms = 1e3 * np.array([t - stops_s[np.argmin(np.abs(stops_s - t))] for t in strikes_s])
    print(f"\n{foot}: {errors_ms.mean():.1f} +- {errors_ms.std():.1f} ms, worst {abs(errors_ms).max():.0f}")
    assert 0.0 <= errors_ms.mean() <= 25.0
    assert errors_ms.std() <= 20.0


def test_every_stride_of_the_tile_walks_is_analysed(recordings: Path) -> None:
    paths = sorted((recordings / "tile_walks_marg").glob("*.csv"))
    assert len(paths) >= 5
    for path in paths:
        (sensor,) = open_recording(path).sensors.values()
        strides, mounting = analysed(sensor)
        assert len(strides) == len(sensor.truth.position_m) - 1, path.stem
        assert mounting is not None, path.stem
        assert np.degrees(mounting.yaw_sd_rad) < 3.0
        pitch = [np.degrees([s.pitch_max_rad, s.pitch_min_rad]) for s in strides]
        highest, lowest = np.median(pitch, axis=0)
        print(f"\n{path.stem}: pitch {highest:.0f} .. {lowest:.0f} deg", end="")
        assert 50.0 < highest < 85.0
        assert -45.0 < lowest < -10.0


def test_no_recording_gives_a_figure_that_is_no_number(recordings: Path) -> None:
    paths = [*(recordings / "pyshoe_vicon").glob("*.mat"), *recordings.glob("*/*[0-9k].csv")]
    assert len(paths) >= 34
    for path in paths:
        strides, _ = only(path)
        for stride in strides:
            values = [getattr(stride, f.name) for f in fields(stride) if f.name != "step"]
            assert all(np.isfinite(value).all() for value in values if value is not None), path.stem
            assert stride.swing_s is None or 0.0 < stride.swing_s < (stride.duration_s or np.inf), path.stem


def test_a_staircase_by_its_steps(recordings: Path) -> None:
    path = recordings / "xio_ximu_marg" / "stairsAndCorridor_CalInertialAndMag.csv"
    strides, mounting = only(path, changed(Params(), "filter", level_ground=True))
    totals = gait_totals(strides, mounting)
    turned_deg = np.degrees(totals.turned_rad)
    print(f"\n{totals.climbed_m:.2f} m up, riser {totals.riser_m:.3f} m, turned {turned_deg:.0f} deg")
    assert (totals.floors_up, totals.floors_down) == (1, 0)
    assert totals.climbed_m == pytest.approx(3.05, abs=0.15)
    assert 0.12 < totals.riser_m < 0.18
    assert turned_deg == pytest.approx(-360.0, abs=25.0)
