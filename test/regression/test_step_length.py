"""Strides and their length without the gyro on real recordings; `-s` shows the table of docs/step_length.md."""

from pathlib import Path

import numpy as np
import pytest

from pdr_core.bench.step_length import HEAD, MODELS, Prediction, lengths, prediction, strides_of
from pdr_core.bench.trial import Walk
from pdr_core.gait.accelerometer_steps import AccelerometerSteps
from pdr_core.params import Params
from pdr_core.recording import Session, open_recording
from pdr_core.recording.decimation import decimated, kept_of, rate_of_hz
from pdr_core.records import ImuBlock, joined
from pdr_core.records_gait import Behaviour, GaitStep
from support.held_recordings import TILES, VICON, XIO, Held, held, only

WALKS = ["SensorConnectData_31", "SensorConnectData_33", "SensorConnectData_36", "SensorConnectData_39"]
RUN = "SensorConnectData_43"  # partly
RATES_HZ = (200.0, 100.0, 67.0, 50.0, 20.0)
RUNS = ("2017-11-27", "2017-12-15-18-01", "2017-12-15-18-02")  # all of these, from a slow jog to a fast run
LIFTS = ("2018-02-09-11-16-53", "2018-02-09-11-19-39")
NO_WALKS = ("2018-02-09", "2018-02-22")  # lifts, crawls and what is between
PARAMS = Params()


def at_rate(session: Session, rate_hz: float) -> list[ImuBlock]:
    sensor = only(session)
    keep_every = kept_of(rate_of_hz(sensor), rate_hz)
    return list(decimated(sensor, keep_every).pieces() if keep_every > 1 else sensor.pieces())


def strides(session: Session, rate_hz: float = 200.0) -> list[GaitStep]:
    return strides_of(at_rate(session, rate_hz), PARAMS)


@pytest.fixture(scope="module")
def tiles(recordings: Path) -> Held:
    return held(recordings, TILES, [*WALKS, RUN])


@pytest.fixture(scope="module")
def predictions(tiles: Held) -> list[Prediction]:
    known = [lengths(Walk(name, at_rate(tiles[name], 200.0), only(tiles[name]).truth), PARAMS) for name in WALKS]
    lowered = {rate: [strides(tiles[name], rate) for name in WALKS] for rate in RATES_HZ}
    made = [
        prediction(walk, walked, rate, model, PARAMS)
        for model in MODELS
        for rate, walks in lowered.items()
        for walk, walked in zip(known, walks, strict=True)
    ]
    print("", HEAD, *made, sep="\n")
    return made


def errors(predictions: list[Prediction], model: str, rate_hz: float) -> list[float]:
    return [abs(p.distance_error) for p in predictions if p.model == model and p.rate_hz == rate_hz]


@pytest.mark.parametrize("rate_hz", RATES_HZ)
def test_every_stride_is_found_at_every_rate(tiles: Held, rate_hz: float) -> None:
    counts = {name: len(strides(session, rate_hz)) for name, session in tiles.items()}
    assert counts == {name: len(only(session).truth.position_m) - 1 for name, session in tiles.items()}


@pytest.mark.parametrize("rate_hz", RATES_HZ)
def test_distance_without_the_gyro(predictions: list[Prediction], rate_hz: float) -> None:
    off = errors(predictions, "zhou", rate_hz)
    assert len(off) == len(WALKS)
    assert np.mean(off) <= 0.015
    assert max(off) <= 0.025


def test_the_model_is_ready_and_honest(predictions: list[Prediction]) -> None:
    ours = [p for p in predictions if p.model == "zhou"]
    assert min(p.ready for p in ours) == 1.0
    assert 0.5 < np.median([p.normalised_rms for p in ours]) < 1.5
    assert np.mean([p.rms_m for p in ours]) <= 0.12


def test_ours_beats_the_classical_models(predictions: list[Prediction]) -> None:
    mean = {m: np.mean([abs(p.distance_error) for p in predictions if p.model == m]) for m in MODELS}
    assert mean["zhou"] == min(mean.values()), mean


@pytest.mark.parametrize("rate_hz", [20.0, 200.0])
def test_walking_and_running_are_told_apart(recordings: Path, tiles: Held, rate_hz: float) -> None:
    room = held(recordings, VICON)
    looks = {name: [step.behaviour for step in strides(session, rate_hz)] for name, session in room.items()}
    run = [behaviour for name in looks if name.startswith(RUNS) for behaviour in looks[name]]
    assert len(run) > 200
    assert run.count(Behaviour.RUNNING) / len(run) > 0.95
    walks = [name for name in looks if not name.startswith((*RUNS, *NO_WALKS))]
    walked = [behaviour for name in walks for behaviour in looks[name]]
    assert len(walked) > 250
    assert walked.count(Behaviour.RUNNING) / len(walked) < 0.01
    assert walked.count(Behaviour.WALKING) / len(walked) > 0.95
    for name in WALKS:
        assert {step.behaviour for step in strides(tiles[name], rate_hz)} == {Behaviour.WALKING}, name
    partly = [step.behaviour for step in strides(tiles[RUN], rate_hz)]
    assert 20 <= partly.count(Behaviour.RUNNING) <= 30


def test_lifting_a_foot_is_no_walk(recordings: Path) -> None:
    for name, session in held(recordings, VICON, LIFTS).items():
        behaviour = AccelerometerSteps(PARAMS.gait).run(joined(at_rate(session, 200.0))).behaviour
        striding = np.isin(behaviour, [Behaviour.WALKING.value, Behaviour.RUNNING.value])
        assert striding.mean() < 0.05, name


def test_a_sensor_of_400_hz(recordings: Path) -> None:
    (session,) = held(recordings, XIO).values()
    counts = [len(strides(session, rate)) for rate in (400.0, 200.0, 20.0)]
    assert counts == [16, 16, 16]


def test_samples_of_a_bag_at_40_hz(recordings: Path) -> None:
    (path,) = (recordings / "ros1_foot_imu").glob("*.csv")
    pieces = list(only(open_recording(path)).pieces())
    known = lengths(Walk(path.stem, pieces, None), PARAMS)
    assert len(known.strides) == len(known.steps) > 150
    assert abs(prediction(known, known.strides, 40.0, "zhou", PARAMS).distance_error) < 0.03
