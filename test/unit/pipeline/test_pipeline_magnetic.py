"""Walks in magnetic fields, clean, disturbed and badly measured, through the whole chain."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import FootInertial
from pdr_core.records import FieldUse, joined, length, part
from pdr_core.simulation import simulated_walk
from pdr_core.simulation.sensors import SENSOR_MODELS
from support.fields import earth_field, in_field

AZIMUTH_RAD = 0.3
ACROSS = np.array([-np.sin(AZIMUTH_RAD), np.cos(AZIMUTH_RAD), 0.0])


def walk(seed=1):
    """A walk of 200 m round a rectangle, whose gyro a rest has shown to some hundredths of a degree a second."""
    params = SimulationParams(motion="smooth", walk_length_m=200.0, sample_rate_hz=100.0, seed=seed)
    return simulated_walk(params)


def estimated(imu, params=None):
    """Return the estimates of a walk, and the chain that gave them."""
    chain = FootInertial(params or Params())
    return joined([chain.run(imu).nav, chain.finish().nav]), chain


def heading_error_deg(simulated, nav):
    true = Rotation.from_quat(simulated.motion.quat_xyzw[-length(nav) :])
    return np.degrees((Rotation.from_quat(nav.quat_xyzw) * true.inv()).as_rotvec()[:, 2])


def use_of(chain):
    return FieldUse(int(chain.state.field_use))


@pytest.mark.parametrize("seed", [1, 2])
def test_a_clean_field_holds_the_heading(seed):
    simulated = walk(seed)
    without, _ = estimated(simulated.imu)
    nav, chain = estimated(in_field(simulated, earth_field(AZIMUTH_RAD)))
    assert use_of(chain) is FieldUse.HEADING
    assert {n.kind for n in chain.notices} == {"field_use"}
    error = abs(heading_error_deg(simulated, nav))
    assert error.max() < 2.0
    assert error[-1] < max(1.0, abs(heading_error_deg(simulated, without))[-1])
    assert abs(np.degrees(chain.state.north_rad - AZIMUTH_RAD)) < 2.0


@pytest.mark.parametrize("size_tesla", [2e-6, 4e-6, 1e-5, 3e-5])
def test_a_field_disturbed_for_ten_seconds_turns_the_track_by_less_than_two_degrees(size_tesla):
    simulated = walk()
    stamp_s = (simulated.imu.stamp_ns - simulated.imu.stamp_ns[0]) * 1e-9
    bent = (stamp_s >= 60.0) & (stamp_s < 70.0)
    world = np.where(bent[:, None], earth_field(AZIMUTH_RAD) + size_tesla * ACROSS, earth_field(AZIMUTH_RAD))
    clean, _ = estimated(in_field(simulated, earth_field(AZIMUTH_RAD)))
    disturbed, chain = estimated(in_field(simulated, world))
    moved = abs(heading_error_deg(simulated, disturbed) - heading_error_deg(simulated, clean))
    assert moved.max() < 2.0
    assert use_of(chain) is FieldUse.HEADING  # it is believed again


def test_an_uncalibrated_magnetometer_is_no_compass():
    simulated = walk()
    without, _ = estimated(simulated.imu)
    for offset in ([2e-5, -1e-5, 3e-5], [4e-6, -2e-6, 3e-6]):
        nav, chain = estimated(in_field(simulated, earth_field(AZIMUTH_RAD), np.array(offset)))
        assert use_of(chain) is FieldUse.CHANGE
        assert abs(heading_error_deg(simulated, nav)).max() < abs(heading_error_deg(simulated, without)).max() + 2.0


def test_a_large_bias_is_found_where_the_field_agrees_with_the_rest():
    simulated, extra = walk(), np.radians([1.0, -1.0, 1.0])
    true = SENSOR_MODELS["consumer"].biases(1)[0] + extra
    biased = simulated.imu._replace(gyro_radps=simulated.imu.gyro_radps + extra)
    field = in_field(simulated, earth_field(AZIMUTH_RAD))._replace(gyro_radps=biased.gyro_radps)
    _, without = estimated(biased)
    _, chain = estimated(field, changed(Params(), "filter", magnetometer="change"))
    missed, missed_without = (np.degrees(c.state.gyro_bias_radps - true) for c in (chain, without))
    assert chain.state.bias_is_rare
    assert np.linalg.norm(missed) < 0.7 * np.linalg.norm(missed_without)
    assert np.abs(missed).max() < 0.1


def test_off_is_off():
    simulated = walk()
    field = in_field(simulated, earth_field(AZIMUTH_RAD))
    without, _ = estimated(simulated.imu)
    off, chain = estimated(field, changed(Params(), "filter", magnetometer="off"))
    np.testing.assert_array_equal(off.position_m, without.position_m)
    assert use_of(chain) is FieldUse.NONE


def test_samples_without_a_field_among_others_and_cuts_change_nothing_but_what_they_must():
    simulated = walk()
    imu = in_field(simulated, earth_field(AZIMUTH_RAD))
    tenth = np.arange(length(imu)) % 10 != 0
    slow = imu._replace(field_sd_tesla=np.where(tenth, -1.0, imu.field_sd_tesla))
    whole, chain = estimated(slow)
    assert use_of(chain) is FieldUse.HEADING
    assert abs(heading_error_deg(simulated, whole)).max() < 3.0
    cut = FootInertial(Params())
    pieces = [cut.run(part(slow, i, i + 777)).nav for i in range(0, length(slow), 777)]
    np.testing.assert_array_equal(joined([*pieces, cut.finish().nav]).pose_covariance, whole.pose_covariance)


def test_without_the_gyro_the_field_tells_nothing_of_its_bias():
    imu = in_field(walk(), earth_field(AZIMUTH_RAD))
    off = np.arange(length(imu)) >= 6000
    dark = imu._replace(
        gyro_radps=np.where(off[:, None], 0.0, imu.gyro_radps), gyro_sd_radps=np.where(off, -1.0, imu.gyro_sd_radps)
    )
    needs_no_gyro = changed(Params(), "stance", detector="acceleration_magnitude")
    nav, chain = estimated(dark, needs_no_gyro)
    _, before = estimated(part(imu, 0, 6000), needs_no_gyro)
    assert 0 <= chain.state.field_windows - before.state.field_windows <= 1  # the one that was open
    assert np.isfinite(nav.position_m).all()


def test_the_covariance_of_the_heading_is_honest_in_a_clean_field():
    errors = []
    for seed in range(8):
        simulated = walk(10 + seed)
        nav, _ = estimated(in_field(simulated, earth_field(AZIMUTH_RAD), seed=seed))
        sd = np.degrees(np.sqrt(nav.pose_covariance[-1, 5, 5]))
        errors.append(heading_error_deg(simulated, nav)[-1] / sd)
    assert np.abs(errors).max() < 2.5


@pytest.mark.parametrize("magnetic_east_deg", [-150.0, -40.0, 20.0, 110.0])
def test_a_walk_that_starts_by_the_compass_is_turned_to_magnetic_east(magnetic_east_deg):
    """The foot starts along the world's x; where north is turned clockwise by an angle, it starts at that yaw."""
    params = SimulationParams(
        motion="smooth", walk_length_m=60.0, magnetometer=True, magnetometer_rate_hz=50.0,
        field_declination_deg=magnetic_east_deg,
    )  # fmt: skip
    simulated = simulated_walk(params)
    told = changed(Params(), "place", field_norm_tesla=params.field_norm_tesla, field_dip_deg=params.field_dip_deg)
    nav, chain = estimated(simulated.imu, changed(told, "filter", initial_yaw_source="magnetometer"))
    turned = (heading_error_deg(simulated, nav) - magnetic_east_deg + 180.0) % 360.0 - 180.0
    since_s = (nav.stamp_ns - nav.stamp_ns[0]) * 1e-9
    assert abs(turned[since_s > 1.1]).max() < 2.0
    assert np.degrees(np.sqrt(nav.pose_covariance[since_s > 1.1, 5, 5])).max() < 6.0
    assert "initial_yaw" in {n.kind for n in chain.notices}
    assert use_of(chain) is FieldUse.HEADING  # the field where the walk goes agrees with that of the start
    assert chain.state.north_rad == pytest.approx(np.pi / 2, abs=0.01)


def test_iron_at_the_start_is_refused_and_a_walk_in_it_starts_as_it_is_told():
    simulated = simulated_walk(SimulationParams(motion="smooth", magnetometer=True, indoor_field=0.25, seed=3))
    told = changed(Params(), "place", field_norm_tesla=50e-6, field_dip_deg=60.0)
    nav, chain = estimated(simulated.imu, changed(told, "filter", initial_yaw_source="magnetometer"))
    assert "initial_yaw_given" in {n.kind for n in chain.notices}
    assert abs(heading_error_deg(simulated, nav)).max() < 5.0
