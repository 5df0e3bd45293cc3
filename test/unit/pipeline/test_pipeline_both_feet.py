"""Two simulated feet together: what they correct, what they must leave alone, and what they say."""

import numpy as np
import pytest
from feet_cases import Together, feet_walks, midway_m, samples
from scipy.spatial.transform import Rotation

from pdr_core.maths.quaternion import yaw_rad
from pdr_core.params import Params, changed
from pdr_core.pipeline import FootInertial
from pdr_core.records import joined, length, part

STRAIGHT = {"walk": "straight", "length_m": 76.0, "sensor": "g_sensitive"}


def end_error_m(walk, nav):
    """Return by how much the end of a track is off that begins where and as the foot really stood."""
    turned = Rotation.from_euler("z", yaw_rad(walk.motion.quat_xyzw[0]))
    end_m = walk.motion.position_m[0] + turned.apply(nav.position_m[-1] - nav.position_m[0])
    return np.linalg.norm((end_m - walk.motion.position_m[-1])[:2])


def alone(imu, params=None):
    chain = FootInertial(params or Params())
    return joined([chain.run(imu).nav, chain.finish().nav])


@pytest.mark.parametrize("heading_states", [True, False])
def test_mirrored_errors_are_corrected(heading_states):
    params = changed(Params(), "filter", heading_states=heading_states)
    before, after = [], []
    for seed in range(3):
        walks, imus = feet_walks(**STRAIGHT, seed=seed), samples(**STRAIGHT, seed=seed)
        found = Together(imus, params)
        before += [end_error_m(walks[foot], alone(imus[foot], params)) for foot in imus]
        after += [end_error_m(walks[foot], found.nav(foot)) for foot in imus]
    assert np.mean(after) < 0.5 * np.mean(before)


def test_the_body_of_a_straight_walk_is_where_it_should_be():
    walks, found = feet_walks(**STRAIGHT), Together(samples(**STRAIGHT))
    off_m = (found.body.position_m - midway_m(walks, found.body.stamp_ns))[:, :2]
    assert np.abs(off_m).max() < 1.0
    assert (np.abs(off_m) < 3.0 * np.sqrt(found.body.pose_covariance[:, [0, 1], [0, 1]]) + 0.02).all()


def test_swapped_feet_are_named():
    imus = samples()
    assert "feet_swapped" not in Together(imus).kinds
    assert "feet_swapped" in Together({"left": imus["right"], "right": imus["left"]}).kinds


def test_feet_in_different_directions_are_sent_to_the_calibration():
    imus = samples(**STRAIGHT)
    turned = Rotation.from_euler("z", 60, degrees=True)
    right = imus["right"]._replace(
        gyro_radps=turned.apply(imus["right"].gyro_radps), accel_mps2=turned.apply(imus["right"].accel_mps2)
    )
    (notice,) = Together({"left": imus["left"], "right": right}).both.notices["body"]
    assert notice.kind == "mounting_apart"
    assert "pdr calibrate mounting" in notice.text


def test_feet_of_different_rates_and_sensors_work():
    left = samples(walk="straight", length_m=36.0)["left"]
    walks = feet_walks(walk="straight", length_m=36.0, rate_hz=160.0, sensor="ideal")
    found = Together({"left": left, "right": walks["right"].imu})
    off_m = (found.body.position_m - midway_m(feet_walks(walk="straight", length_m=36.0), found.body.stamp_ns))[:, :2]
    assert np.abs(off_m).max() < 0.4
    assert length(found.body) == pytest.approx(length(left), abs=50)
    assert found.kinds == []


def test_a_recording_of_one_foot_that_ends_early_does_not_end_the_other():
    imus = samples(walk="straight", length_m=36.0)
    short = part(imus["right"], 0, 1500)
    found = Together({"left": imus["left"], "right": short})
    assert length(found.nav("left")) == length(imus["left"])
    assert length(found.nav("right")) == length(short)
    assert found.body.stamp_ns[-1] == imus["left"].stamp_ns[-1]
    assert [step.index for step in found.steps("left")] == list(range(1, len(found.steps("left")) + 1))


def test_a_constraint_and_the_other_foot_speak_together():
    """The constraint holds the direction that both share, the feet each other's."""
    held = changed(Params(), "heading", constraint="dominant")
    found = Together(samples(**STRAIGHT), held)
    assert found.kinds == ["heading_on", "heading_held"]
    off_m = found.body.position_m[-1] - midway_m(feet_walks(**STRAIGHT), found.body.stamp_ns)[-1]
    assert np.linalg.norm(off_m[:2]) < 1.0


def test_tracks_that_drift_apart_stay_within_reach():
    """A gyro of each foot turns by .6 deg/s to the outside once it walks; the headings are not compared."""
    imus = samples(walk="straight", length_m=76.0)
    drifting = {foot: turning(imu, sign * 0.01) for (foot, imu), sign in zip(imus.items(), (1, -1), strict=True)}
    apart_m = {}
    for reach_m in (1.5, 100.0):
        params = changed(Params(), "fusion", frame_strides=1000, separation_max_m=reach_m)
        found = Together(drifting, params)
        feet = [found.both.placed_m(foot, found.nav(foot).position_m) for foot in imus]
        n = min(map(len, feet))
        apart_m[reach_m] = np.linalg.norm((feet[0][:n] - feet[1][:n])[:, :2], axis=1).max()
        assert ("feet_apart" in found.kinds) == (reach_m < 100.0)
    assert apart_m[100.0] > 8.0
    assert apart_m[1.5] < 3.0


def turning(imu, rate_radps):
    """Return samples of a gyro that turns about z from the third second on."""
    gyro_radps = imu.gyro_radps.copy()
    gyro_radps[imu.stamp_ns > imu.stamp_ns[0] + 3_000_000_000, 2] += rate_radps
    return imu._replace(gyro_radps=gyro_radps)
