"""Installation alignment through the chain: any mounting, found within a degree and undone by the intake."""

import json

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.maths.quaternion import from_euler, matrix
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import FootInertial
from pdr_core.pipeline.mounting import MountingSearch
from pdr_core.records import joined, part
from pdr_core.simulation import simulated_walk

NORTH_DOWN_TESLA = np.array([0.0, 20e-6, -45e-6])  # ENU, magnetic north along y


def walk(angles=(0.0, 0.0, 0.0), walk="straight", length_m=20.0, **more):
    roll, pitch, yaw = (float(angle) for angle in angles)
    mounted = {"mounting_roll_rad": roll, "mounting_pitch_rad": pitch, "mounting_yaw_rad": yaw}
    return simulated_walk(SimulationParams(motion="smooth", walk=walk, walk_length_m=length_m, **mounted, **more))


def with_mounting(found):
    names = ("mounting_roll_rad", "mounting_pitch_rad", "mounting_yaw_rad")
    return changed(Params(), "intake", **dict(zip(names, found.angles_rad, strict=True)))


@pytest.mark.parametrize("seed", range(20))
def test_any_mounting_is_found_within_a_degree(seed):
    angles = Rotation.random(random_state=seed).as_euler("xyz")
    found = MountingSearch(Params()).run([walk(angles, seed=seed).imu])
    error = matrix(from_euler(*found.angles_rad)) @ matrix(from_euler(*angles)).T
    assert np.degrees(Rotation.from_matrix(error).magnitude()) < 1.0
    assert np.degrees(found.mounting.yaw_sd_rad) < 0.1
    np.testing.assert_allclose(found.after_xyzw[found.rest], np.tile([0.0, 0.0, 0.0, 1.0], (600, 1)), atol=0.01)
    assert np.abs(found.before_xyzw[found.rest] - [0.0, 0.0, 0.0, 1.0]).max() > 0.1


@pytest.mark.parametrize("pitch", [np.pi / 2.0, -np.pi / 2.0])
def test_no_mounting_is_singular(pitch):
    found = MountingSearch(Params()).run([walk((0.4, pitch, -1.0)).imu])
    error = matrix(from_euler(*found.angles_rad)) @ matrix(from_euler(0.4, pitch, -1.0)).T
    assert np.degrees(Rotation.from_matrix(error).magnitude()) < 1.0


def test_the_intake_undoes_it_so_the_foot_looks_where_it_goes():
    imu = walk((2.9, -0.6, 2.7), "rectangle", 60.0).imu
    found = MountingSearch(Params()).run([part(imu, 0, 4000), part(imu, 4000)])
    chain = FootInertial(with_mounting(found))
    outputs = [chain.run(imu), chain.finish()]
    steps = [step for output in outputs for step in output.steps]
    beside = [np.angle(np.exp(1j * (s.heading_rad - s.yaw_rad))) for s in steps]
    assert abs(beside[0]) < np.radians(1.0)
    assert np.abs(np.median(beside)) < np.radians(1.0)
    nav = joined([output.nav for output in outputs])
    assert Rotation.from_quat(nav.quat_xyzw[100]).magnitude() < np.radians(1.0)
    again = MountingSearch(with_mounting(found)).run([imu])
    np.testing.assert_allclose(matrix(from_euler(*again.angles_rad)), matrix(from_euler(*found.angles_rad)), atol=0.01)
    assert Rotation.from_quat(again.mounting.quat_xyzw).magnitude() < np.radians(1.0)


def test_a_walk_that_does_not_tell_says_why():
    assert "straight strides" in MountingSearch(Params()).run([walk(walk="still").imu])
    assert "straight strides" in MountingSearch(Params()).run([walk(walk="curve", length_m=16.0).imu])


def test_a_magnetometer_shows_where_the_walk_goes():
    sim = walk((2.9, -0.6, 2.7))
    assert MountingSearch(Params()).run([sim.imu]).walking_yaw_rad is None
    for yaw in (0.0, 0.5, -2.0):  # of the walk's x from magnetic east
        field = Rotation.from_euler("z", -yaw).apply(NORTH_DOWN_TESLA)
        in_foot = Rotation.from_quat(sim.motion.quat_xyzw).inv().apply(field)
        in_sensor = in_foot @ matrix(from_euler(2.9, -0.6, 2.7))
        imu = sim.imu._replace(field_tesla=in_sensor, field_sd_tesla=np.full(len(in_sensor), 1e-7))
        found = MountingSearch(Params()).run([imu])
        assert found.walking_yaw_rad == pytest.approx(yaw, abs=np.radians(1.5))
        assert json.loads(found.to_json())["walking_yaw_rad"] == found.walking_yaw_rad
