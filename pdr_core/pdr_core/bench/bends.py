"""Bent corridors: a recording changed as if the walk had turned by an angle in the swing of one stride.

With theta(t), which rises from 0 to the angle over the swing, and p0 for where the foot stood before it, the new motion
has the old one's velocity and attitude turned about the vertical z:

    v' = R(theta) v,    C' = R(theta) C,    p' = p0 + integral of R(theta) v.

Differentiated, with the specific force f of the old motion in the foot frame and its rate w:

    w' = w + theta_dot C'z,    f' = f + theta_dot C'(z x v),

where C' on the right is the transpose: a' = R(theta) (a + theta_dot z x v), and gravity is not turned. This is exact
but for what attitude C and velocity v of an estimate are off. The truth turns too: the stride itself by the complex
ratio of the integrals of R(theta) v and v, in which no frame has a part, and all that follows by the angle.
"""

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.bench.trial import Walk, outputs
from pdr_core.conventions import seconds_between
from pdr_core.maths.circular import wrapped_rad
from pdr_core.params import Params
from pdr_core.pipeline import FootInertial
from pdr_core.records import Flags, Floats, ImuBlock, Truth, joined

STRAIGHT_RAD = float(np.radians(8.0))
CORRIDOR = 2  # strides before the bend and after it that go straight on
UP = np.array([0.0, 0.0, 1.0])


def corridor_strides(truth: Truth) -> list[int]:
    """Return the strides, counted from 0, in the middle of straight lines of a truth that is known at strides."""
    moved_m = np.diff(truth.position_m[:, :2], axis=0)
    heading_rad = np.arctan2(moved_m[:, 1], moved_m[:, 0])
    return [i for i in range(CORRIDOR, len(heading_rad) - CORRIDOR) if _straight(heading_rad, i)]


def _straight(heading_rad: Floats, i: int) -> bool:
    around = heading_rad[i - CORRIDOR : i + CORRIDOR + 1]
    return all(abs(wrapped_rad(float(h - heading_rad[i]))) < STRAIGHT_RAD for h in around)


class Bendable:
    """A walk whose truth is known at strides, and what the chain makes of it: where to bend it."""

    def __init__(self, walk: Walk, truth: Truth, params: Params) -> None:
        found = list(outputs(FootInertial(params), walk.pieces))
        nav = joined([output.nav for output in found])
        judged = joined([output.judged for output in found])
        self._name, self._truth = walk.name, truth
        self._imu, self._stance = judged.imu, judged.stance
        self._steps = [step for output in found for step in output.steps]
        self._foot_from_world = Rotation.from_quat(nav.quat_xyzw).inv()
        self._velocity_mps = self._foot_from_world.inv().apply(nav.velocity_mps)  # in the world frame

    @property
    def corridors(self) -> list[int]:
        """The strides that can be bent."""
        return [i for i in corridor_strides(self._truth) if i < len(self._steps)]

    def bent(self, stride: int, angle_rad: float) -> Walk:
        """Return the walk, turned by an angle in the swing of a stride, counted from 0."""
        within = self._swing(stride)
        share = np.cumsum(within) / np.sum(within)
        angle = angle_rad * (share - np.sin(2.0 * np.pi * share) / (2.0 * np.pi))  # begins and ends at rate 0
        return Walk(self._name, [self._felt(angle)], self._turned(stride, angle, within))

    def _swing(self, stride: int) -> Flags:
        """Return which samples, (n,), are in the swing of a stride: between its two stances."""
        step = self._steps[stride]
        in_stride = (self._imu.stamp_ns > step.start_ns) & (self._imu.stamp_ns <= step.stamp_ns)
        moving = np.flatnonzero(in_stride & ~self._stance)
        rows = np.arange(len(in_stride))
        return (rows >= moving[0]) & (rows <= moving[-1])

    def _felt(self, angle_rad: Floats) -> ImuBlock:
        """Return what the sensor would have shown with the foot turned by an angle at each sample, (n,)."""
        time_s = seconds_between(self._imu.stamp_ns, int(self._imu.stamp_ns[0]))
        rate = np.gradient(angle_rad, time_s)[:, None]
        gyro = self._foot_from_world.apply(rate * UP)
        accel = self._foot_from_world.apply(rate * np.cross(UP, self._velocity_mps))
        return self._imu._replace(gyro_radps=self._imu.gyro_radps + gyro, accel_mps2=self._imu.accel_mps2 + accel)

    def _turned(self, stride: int, angle_rad: Floats, within: Flags) -> Truth:
        """Return the truth of the bent walk."""
        plane_mps = (self._velocity_mps @ [1.0, 1j, 0.0])[within]
        own = np.sum(np.exp(1j * angle_rad[within]) * plane_mps) / np.sum(plane_mps)
        moved = np.diff(self._truth.position_m[:, :2] @ [1.0, 1j])
        moved[stride] *= own
        moved[stride + 1 :] *= np.exp(1j * angle_rad[-1])
        at = self._truth.position_m[0, :2] @ [1.0, 1j] + np.concatenate([[0.0], np.cumsum(moved)])
        return replace(self._truth, position_m=np.column_stack([at.real, at.imag]))
