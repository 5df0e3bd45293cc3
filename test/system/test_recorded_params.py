"""Which of the recorded parameters are whose."""

from pathlib import Path

import pytest

from pdr_bringup_scripts.live.recorded_params import PARAMETERS, chosen_params
from pdr_bringup_scripts.problems import Problem
from pdr_core.params import Params
from pdr_core.params_file import params_text
from pdr_core.recording import Sensor
from pdr_core.recording.mcap_writer import McapWriter

GATED = {"filter": {"gate": 25.0}, "intake": {"mounting_yaw_rad": 0.1}}
PERSON = {"heading": {"constraint": "hde"}, "fusion": {}, "node": {"feet": "left right"}}


@pytest.fixture
def recorded(tmp_path):
    """Make a recording whose namespaces have these parameters."""

    def make(**by_namespace) -> Path:
        path = tmp_path / "walk.mcap"
        with McapWriter(path, {}) as file:
            for namespace, groups in by_namespace.items():
                name = f"{namespace}/{PARAMETERS}".lstrip("/")
                file.attach(name, "application/yaml", 0, params_text(groups).encode())
        return path

    return make


def of(path, *sensors):
    return chosen_params(None, True, path, [Sensor(name, None, lambda _: iter(())) for name in sensors])


def test_a_foot_has_its_own_and_what_it_does_not_say_is_the_default(recorded):
    params = of(recorded(**{"": GATED}), "imu")
    assert (params.filter.gate, params.intake.mounting_yaw_rad) == (25.0, 0.1)
    assert (params.heading, params.stance) == (Params().heading, Params().stance)


def test_the_person_is_one_level_above_the_feet(recorded):
    path = recorded(**{"alice": PERSON, "alice/left": GATED, "bob": PERSON | {"heading": {"constraint": "ihde"}}})
    params = of(path, "alice/left/imu")
    assert (params.heading.constraint, params.filter.gate) == ("hde", 25.0)


def test_feet_may_differ_in_what_changes_no_track(recorded):
    left, right = (GATED | {"node": {"foot_frame": f"{foot}_foot"}, "driver": {"sensor": foot}} for foot in "lr")
    params = of(recorded(**{"": PERSON, "left": left, "right": right}), "left/imu", "right/imu")
    assert (params.filter.gate, params.heading.constraint) == (25.0, "hde")


def test_feet_that_differ_in_more_are_refused_by_name(recorded):
    other = GATED | {"intake": {"mounting_yaw_rad": 0.2}}
    path = recorded(left=GATED, right=other)
    with pytest.raises(Problem, match=r"left/imu and right/imu .* \(intake.mounting_yaw_rad\): .* --sensor"):
        of(path, "left/imu", "right/imu")
    assert of(path, "right/imu").intake.mounting_yaw_rad == 0.2


def test_a_sensor_without_parameters_is_named(recorded):
    with pytest.raises(Problem, match="holds no parameters for right/imu"):
        of(recorded(left=GATED), "right/imu")


def test_the_last_of_two_files_counts(recorded):
    path = recorded(left=GATED)
    path.unlink()
    with McapWriter(path, {}) as file:
        for gate in (20.0, 40.0):
            text = params_text(GATED | {"filter": {"gate": gate}})
            file.attach(f"left/{PARAMETERS}", "application/yaml", 0, text.encode())
    assert of(path, "left/imu").filter.gate == 40.0
