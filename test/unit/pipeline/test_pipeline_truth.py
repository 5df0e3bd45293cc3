"""The whole chain, and the filter alone with true verdicts, against the truth of simulated walks."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from pdr_core.conventions import gravity_mps2
from pdr_core.eskf import ZuptFilter
from pdr_core.eskf.updates import zero_velocity
from pdr_core.evaluation.metrics import path_length_m
from pdr_core.intake import Ingestion
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import FootInertial
from pdr_core.records import StanceBlock, joined, part
from pdr_core.simulation import simulated_walk
from pdr_core.simulation.gui_motion import GuiCourse, Phase, steps
from pdr_core.simulation.imu_model import SensorModel, point_samples, sensed

G = gravity_mps2(np.radians(45.0))


def with_verdicts(imu, stance):
    n = len(imu.stamp_ns)
    return StanceBlock(imu, stance, np.zeros(n), np.ones(n), np.zeros(n), np.zeros((n, 3)), np.zeros(n))


@pytest.mark.parametrize("walk", ["straight", "rectangle"])
@pytest.mark.parametrize(("motion", "rate_hz"), [("gui", 100.0), ("gui", 400.0), ("smooth", 100.0), ("smooth", 200.0)])
def test_a_walk_of_100_m_without_noise_and_with_true_verdicts_returns_the_truth(walk, motion, rate_hz):
    simulation = SimulationParams(
        motion=motion, walk=walk, walk_length_m=100.0, sample_rate_hz=rate_hz, sensor_model="ideal"
    )
    sim, params = simulated_walk(simulation), Params()
    block = with_verdicts(Ingestion(params.intake).run(sim.imu), sim.motion.still)
    nav, _ = ZuptFilter(params.filter, params.place).run(block)
    error = np.linalg.norm(nav.position_m - sim.motion.position_m, axis=1)
    assert error[-1] < 0.0005 * path_length_m(sim.motion.position_m)  # 0.05 %
    assert np.sqrt(np.mean(error**2)) < 0.0005 * path_length_m(sim.motion.position_m)
    turn = (Rotation.from_quat(nav.quat_xyzw).inv() * Rotation.from_quat(sim.motion.quat_xyzw)).magnitude()
    # Gui's turn on the spot begins and ends with a jump of pi^3 rad/s^2 in the yaw's acceleration, so the trapezium
    # misses 2 pi^3 / 12 of the squared interval, four times round a rectangle; and no stance tells the yaw.
    missed_rad = 4.0 * np.pi**3 / 6.0 / rate_hz**2 if (motion, walk) == ("gui", "rectangle") else 0.0
    assert turn.max() < missed_rad + (2e-4 if motion == "gui" else 2e-3)


@pytest.mark.parametrize("walk", ["straight", "rectangle"])
@pytest.mark.parametrize("motion", ["gui", "smooth"])
def test_so_does_the_whole_chain_that_finds_the_stances_itself(motion, walk):
    sim = simulated_walk(
        SimulationParams(motion=motion, walk=walk, walk_length_m=100.0, sample_rate_hz=100.0, sensor_model="ideal")
    )
    chain = FootInertial(Params())
    position_m = joined([chain.run(sim.imu).nav, chain.finish().nav]).position_m
    error = np.linalg.norm(position_m - sim.motion.position_m, axis=1)
    assert error[-1] < 0.0005 * path_length_m(sim.motion.position_m)  # 0.05 %
    assert np.sqrt(np.mean(error**2)) < 0.0005 * path_length_m(sim.motion.position_m)


def between_samples(phases, rate_hz):
    """Return motion and stamps with samples astride the jumps of the acceleration, where the trapezium is exact."""
    time_s = (np.arange(round(sum(p.duration_s for p in phases) * rate_hz)) + 0.5) / rate_hz
    return GuiCourse(phases).at(time_s), np.rint(time_s * 1e9).astype(np.int64)


@pytest.mark.parametrize("yaw_rad", [1.0, -2.5])
def test_the_initial_yaw_turns_the_whole_track(yaw_rad):
    sim = simulated_walk(SimulationParams(walk="straight", walk_length_m=6.0, sample_rate_hz=100.0))
    straight = FootInertial(Params()).run(sim.imu).nav
    turned = FootInertial(changed(Params(), "filter", initial_yaw_rad=yaw_rad)).run(sim.imu).nav
    R = Rotation.from_euler("z", yaw_rad)
    np.testing.assert_allclose(turned.position_m, R.apply(straight.position_m), atol=1e-6)
    np.testing.assert_allclose(turned.velocity_mps, straight.velocity_mps, atol=1e-6)
    assert (
        Rotation.from_quat(turned.quat_xyzw).inv() * R * Rotation.from_quat(straight.quat_xyzw)
    ).magnitude().max() < 1e-6


def test_an_hour_later_the_track_is_the_same():
    sims = [
        simulated_walk(SimulationParams(walk="straight", walk_length_m=6.0), start_ns=s)
        for s in (10**18, 10**18 + 3600 * 10**9)
    ]
    a, b = (FootInertial(Params()).run(sim.imu).nav for sim in sims)
    np.testing.assert_array_equal(a.position_m, b.position_m)


@pytest.mark.parametrize("walk", ["straight", "rectangle"])
def test_the_whole_chain_walks_a_consumer_sensor_home(walk):
    sim = simulated_walk(SimulationParams(walk=walk, walk_length_m=24.0))
    chain = FootInertial(Params())
    out, rest = chain.run(sim.imu), chain.finish()
    assert np.linalg.norm(rest.nav.position_m[-1] - sim.motion.position_m[-1]) < 0.03 * 24.0
    assert len(out.steps) + len(rest.steps) == 20 + 4 * (walk == "rectangle")
    assert chain.notices == []


@pytest.mark.parametrize(("chosen", "share"), [({"gravity_source": "place"}, 1.0), ({}, 1.0033)])
def test_a_bias_along_the_vertical_is_no_gravity(chosen, share):
    """The 10 mg that a data sheet allows: at rest they look like gravity, in a swing the foot is tipped."""
    bias = SensorModel(accel_bias_mps2=(0.0, 0.0, 0.1))
    sim = simulated_walk(SimulationParams(motion="smooth", walk="straight", walk_length_m=42.0), model=bias)
    chain = FootInertial(changed(Params(), "filter", **chosen))
    steps = [*chain.run(sim.imu).steps, *chain.finish().steps]
    found_m = np.linalg.norm([step.displacement_m[:2] for step in steps], axis=1)
    assert len(steps) == 30
    assert np.mean(found_m) == pytest.approx(1.4 * share, rel=5e-4)


def normalised_errors(seed, zero_velocity_sd=0.005, rate_hz=100.0):
    """Walk 12 m with a sensor drawn from the filter's own assumptions; return NEES of velocity and tilt, (ends, 2)."""
    rng = np.random.default_rng(seed)
    model = SensorModel(tuple(rng.normal(0, 0.0035, 3)), tuple(rng.normal(0, 0.02, 3)), 1.75e-4, 2.9e-3)
    motion, stamps = between_samples([Phase(3.0), *steps(10), Phase(1.0)], rate_hz)
    params = changed(Params(), "intake", gyro_noise_density=1.75e-4, accel_noise_density=2.9e-3, change_noise=0.0)
    params = changed(params, "filter", gravity_source="place", contact_height_m=0.0)
    block = with_verdicts(
        Ingestion(params.intake).run(sensed(stamps, *point_samples(motion, G), rate_hz, model, seed)),
        np.zeros(len(stamps), bool),
    )
    f, truth, found = ZuptFilter(params.filter, params.place), Rotation.from_quat(motion.quat_xyzw), []
    for i in range(len(stamps)):
        f.run(part(block, i, i + 1))
        if motion.stance[i] and not f.state.aligning:
            observed = rng.normal(0, zero_velocity_sd, 3)  # the foot is as still as the filter takes it to be
            f.state.velocity_mps[:] -= observed
            zero_velocity(int(stamps[i]), block.imu.gyro_radps[i], zero_velocity_sd, f._settings, f.state)
            f.state.velocity_mps[:] += observed
            if i + 1 < len(stamps) and not motion.stance[i + 1]:
                turn = (truth[i] * Rotation.from_quat(f.state.quat_xyzw).inv()).as_rotvec()[:2]
                speed = motion.velocity_mps[i] - f.state.velocity_mps
                P = f.state.P
                found.append([speed @ np.linalg.solve(P[3:6, 3:6], speed), turn @ np.linalg.solve(P[6:8, 6:8], turn)])
    assert f.state.contradicted <= 0.02 * f.state.accepted
    return np.array(found)


def test_the_covariance_of_velocity_and_tilt_is_neither_too_small_nor_too_large():
    runs = np.array([normalised_errors(seed) for seed in range(30)])  # (30, ends, 2)
    for column, freedom in ((0, 3), (1, 2)):
        low, high = chi2.ppf([0.025, 0.975], 30 * freedom) / 30
        print(f"mean NEES {runs[:, :, column].mean():.2f} of {freedom}, 95 %: {low:.2f} .. {high:.2f}")
        print(np.round(runs[:, :, column].mean(0), 2))
    for column, freedom in ((0, 3), (1, 2)):
        low, high = chi2.ppf([0.025, 0.975], 30 * freedom) / 30
        assert low < runs[:, :, column].mean() < high
