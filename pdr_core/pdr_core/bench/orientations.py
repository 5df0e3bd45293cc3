"""Orientations by every method that is compared: our two filters, and three that the library `ahrs` has, not we.

Every one turns judged samples into world-from-foot quaternions. The library's quaternions have their real part first.
Its gradient descent (Madgwick 2011) and its nonlinear complementary filter (Mahony 2008) take the specific force as it
is, upwards at rest, into a world whose z points up: that is ours. Its factored quaternions (Yun 2008) are those of axes
forward, right, down in a world north, east, down; turned by half a turn about x on both sides they are ours, with x
to the north. Where a method knows north, its world is turned so that the foot begins at the yaw that the others begin
with. The library's filters start from the gyro bias that the first rest shows, as ours do: without it a gyro that is
off by 1 deg/s would be all that the comparison shows.

Madgwick's gains are those of his paper, .033 and .041 with the field. The library's for Mahony, k_P 1 and k_I .3, take
the swing for a tilt: strides come out 13 to 16 % short. Of 1, .3, .1 and .03 the last does best against motion capture,
so that is what ours are compared with; k_I is 1/30 of it. The library's `Complementary` is not used: it adds the rates
of the foot to Euler angles, which holds for small angles alone, and without a field it has no yaw.
"""

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from pdr_core.attitude import QuaternionFilter
from pdr_core.conventions import GAP_NS, NANOSECONDS
from pdr_core.eskf import ZuptFilter
from pdr_core.maths import quaternion
from pdr_core.maths.levelling import levelled
from pdr_core.params import Params
from pdr_core.records import Floats, StanceBlock, length

if TYPE_CHECKING:
    from types import ModuleType

MISSING = "this method comes with the Python package ahrs, which is missing: install it with `pip install ahrs==0.4.0`"
NO_FIELD = "factored quaternions need a magnetometer, and these samples have no magnetic field: leave this method out"


class CannotOrient(Exception):  # noqa: N818  (what a person meets)
    """A method cannot be run here; the text says why and what to do."""


def error_state(judged: StanceBlock, params: Params) -> Floats:
    """Return the orientations of the error-state filter, (n, 4)."""
    return ZuptFilter(params.filter, params.place).run(judged)[0].quat_xyzw


def quaternion_ekf(judged: StanceBlock, params: Params) -> Floats:
    """Return the orientations of the quaternion filter (Qiu eq. 3-18), (n, 4)."""
    return QuaternionFilter(params).run(judged).quat_xyzw


def gradient_descent(judged: StanceBlock, params: Params) -> Floats:
    """Return the orientations by gradient descent, (n, 4); CannotOrient without `ahrs`."""
    with_field = has_field(judged, params)
    one = ahrs().filters.Madgwick(gain=0.041 if with_field else 0.033)
    return recursive(one, judged, params, with_field, north_rad=0.0)


def complementary(judged: StanceBlock, params: Params) -> Floats:
    """Return the orientations of the nonlinear complementary filter, (n, 4); CannotOrient without `ahrs`."""
    one = ahrs().filters.Mahony(k_P=0.03, k_I=0.001)
    return recursive(one, judged, params, has_field(judged, params), north_rad=np.pi / 2.0)


def factored_quaternion(judged: StanceBlock, params: Params) -> Floats:
    """Return the orientation of each sample for itself, by gravity and field, (n, 4); CannotOrient without either."""
    if not length(judged) or not np.all(judged.imu.field_sd_tesla >= 0.0):
        raise CannotOrient(NO_FIELD)
    front_right_down = np.array([1.0, -1.0, -1.0])
    one = ahrs().filters.FQA(mag_ref=np.array([1.0, 0.0, 0.0]))
    pairs = zip(judged.imu.accel_mps2 * front_right_down, judged.imu.field_tesla * front_right_down, strict=True)
    found = np.array([one.estimate(accel, field) for accel, field in pairs])
    return from_the_usual_yaw(found[:, [1, 2, 3, 0]] * [1.0, -1.0, -1.0, 1.0], judged, params)


ORIENTATIONS: dict[str, Callable[[StanceBlock, Params], Floats]] = {
    "error_state": error_state,
    "quaternion_ekf": quaternion_ekf,
    "gradient_descent": gradient_descent,
    "complementary": complementary,
    "factored_quaternion": factored_quaternion,
}


def ahrs() -> "ModuleType":
    """Return the library; CannotOrient if it is not there."""
    try:
        import ahrs as library
    except ImportError as error:
        raise CannotOrient(MISSING) from error
    return library


def has_field(judged: StanceBlock, params: Params) -> bool:
    """Tell whether the methods that can do without the field shall use it."""
    return bool(params.attitude.use_field and np.all(judged.imu.field_sd_tesla >= 0.0))


def at_rest(judged: StanceBlock, params: Params) -> tuple[Floats, Floats]:
    """Return the orientation (4,) and the field (3,), in the foot frame, of the first moments."""
    since_ns = judged.imu.stamp_ns - judged.imu.stamp_ns[:1]
    first = since_ns <= params.filter.alignment_s * NANOSECONDS
    quat_xyzw = np.array(levelled(judged.imu.accel_mps2[first].mean(axis=0), params.filter.initial_yaw_rad))
    return quat_xyzw, judged.imu.field_tesla[first].mean(axis=0)


def recursive(one: Any, judged: StanceBlock, params: Params, with_field: bool, north_rad: float) -> Floats:
    """Return what a filter of the library makes of the samples, (n, 4); with the field, north lies at `north_rad`."""
    if not length(judged):
        return np.zeros((0, 4))
    quat_xyzw, field = at_rest(judged, params)
    if with_field:
        world = quaternion.matrix(quat_xyzw) @ field
        to_north = quaternion.from_euler(0.0, 0.0, north_rad - np.arctan2(world[1], world[0]))
        quat_xyzw = np.array(quaternion.multiply(to_north, quat_xyzw))
    found = np.array(list(updated(one, quat_xyzw[[3, 0, 1, 2]], judged, with_field)))[:, [1, 2, 3, 0]]
    return from_the_usual_yaw(found, judged, params)


def updated(one: Any, quat_wxyz: Floats, judged: StanceBlock, with_field: bool) -> Iterator[Floats]:
    """Yield the orientation at each sample; across gaps, and where the gyro is off, it is held."""
    imu = judged.imu
    step_ns = np.diff(imu.stamp_ns, prepend=imu.stamp_ns[0])
    gyro_radps = imu.gyro_radps - first_rest_radps(judged)
    known = (step_ns > 0) & (step_ns <= GAP_NS) & (imu.gyro_sd_radps >= 0.0)
    for i in range(length(imu)):
        if known[i]:
            sample = (gyro_radps[i], imu.accel_mps2[i], *([imu.field_tesla[i]] if with_field else []))
            update = one.updateMARG if with_field else one.updateIMU
            quat_wxyz = np.array(update(quat_wxyz, *sample, dt=float(step_ns[i]) / NANOSECONDS))
        yield quat_wxyz


def first_rest_radps(judged: StanceBlock) -> Floats:
    """Return the gyro bias (3,) that the first proven rest shows; zero without one."""
    rests = np.flatnonzero(judged.rest_sd_radps > 0.0)
    return judged.rest_rate_radps[rests[0]] if len(rests) else np.zeros(3)


def from_the_usual_yaw(quat_xyzw: Floats, judged: StanceBlock, params: Params) -> Floats:
    """Return the orientations, (n, 4), in a world that is turned so that the first yaw is that of the other methods."""
    turn_rad = quaternion.turn_about_up_rad(np.ascontiguousarray(quat_xyzw[0]), at_rest(judged, params)[0])
    turn = quaternion.from_euler(0.0, 0.0, turn_rad)
    return np.array([quaternion.multiply(turn, q) for q in np.ascontiguousarray(quat_xyzw)])
