"""Two real feet before motion capture: together they are no worse than alone, and the body is between them."""

from pathlib import Path

import pytest

from pdr_bringup_scripts.run.run_choice import estimated
from pdr_bringup_scripts.run.run_options import RunOptions
from pdr_core.evaluation.result import SensorsResult
from pdr_core.params import Params
from pdr_core.pipeline import BothFeet
from pdr_core.recording import open_recording

FEET = ("left_sensor", "right_sensor")


@pytest.fixture(scope="module")
def recording(recordings: Path) -> Path:
    return recordings / "gaitmap_dual_foot" / "imu_sample.csv"


@pytest.fixture(scope="module")
def together(recording: Path) -> SensorsResult:
    return estimated(open_recording(recording), Params(), RunOptions())


def test_two_sensors_that_are_called_left_and_right_are_feet(together: SensorsResult) -> None:
    assert list(together.sensors) == list(FEET)
    assert together.body is not None
    assert [n.kind for n in together.body.notices] == []


@pytest.mark.parametrize("foot", FEET)
def test_a_foot_is_no_worse_than_alone(recording: Path, together: SensorsResult, foot: str) -> None:
    alone = estimated(open_recording(recording), Params(), RunOptions(sensor=foot))
    assert together.sensors[foot].truth.ate2_m <= alone.truth.ate2_m
    assert together.sensors[foot].strides == alone.strides


def test_the_body_is_midway_between_both_feet(together: SensorsResult) -> None:
    print(f"body {together.body.truth}, feet {[together.sensors[foot].truth for foot in FEET]}")
    assert together.body.truth.ate2_m < 0.1
    assert together.body.truth.ate2_m < min(together.sensors[foot].truth.ate2_m for foot in FEET)


def test_swapped_sensors_are_named(recording: Path) -> None:
    session = open_recording(recording)
    both = BothFeet(Params(), FEET[::-1])
    for foot in FEET:
        for piece in session.sensors[foot].pieces():
            both.run(foot, piece)
    both.finish()
    assert [n.kind for n in both.notices["body"]] == ["feet_swapped"]
