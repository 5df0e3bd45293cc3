"""What a sample tells of the orientation beside its interval (Qiu eq. 16-18)."""

import numpy as np

from pdr_core.attitude import field, gravity
from pdr_core.attitude.settings import Settings
from pdr_core.attitude.sphere import corrected, spread
from pdr_core.attitude.state import GYRO_BIAS, SIZE, AttitudeState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.kalman import Innovation, correct, estimated_error, gain, innovation, normalised_squared
from pdr_core.maths.levelling import off_vertical
from pdr_core.maths.quaternion import from_rotation_vector, rows
from pdr_core.maths.vector import Vector, difference, norm, rotated
from pdr_core.records import Floats

BIAS_ALONE = np.eye(SIZE)[GYRO_BIAS:]


@compiled
def apply(y: Innovation, K: Floats, state: AttitudeState) -> None:
    """Correct the estimate and its covariance."""
    correct(state.P, K, y)
    corrected(estimated_error(K, y), state)


@compiled
def weighed(force_mps2: Vector, variance: float, s: Settings, state: AttitudeState) -> Innovation:
    """Return the innovation of the specific force of a foot that stands."""
    residual = np.array(force_mps2) - gravity.expected(state.quat_xyzw, s.gravity_mps2)
    return innovation(state.P, gravity.jacobian(state.quat_xyzw, s.gravity_mps2), np.eye(3) * variance, residual)


@compiled
def level(force_mps2: Vector, sd_mps2: float, dt_s: float, s: Settings, state: AttitudeState) -> None:
    """Tell the filter where up is: it may be off by `sd_mps2`.

    An innovation beyond the gate is not believed: a shock, or a verdict that is wrong. But where that goes on, it is
    the estimate that is wrong, by as much as it shows, and about any axis: so nothing locks the filter out. The filter
    is linear in small errors, and that one is large. So the estimate is first turned by the shortest turn that lays the
    force on the vertical; then the force tells no more than how certain that is.
    """
    if normalised_squared(weighed(force_mps2, sd_mps2**2, s, state)) > s.gate:
        contradicted_s = float(state.contradicted_s) + dt_s
        state.contradicted_s = contradicted_s
        if contradicted_s <= s.release_s:
            return
        about_x, about_y, angle = off_vertical(state.quat_xyzw, force_mps2)
        spread(np.full(3, angle**2), state)
        gravity.stand_up(from_rotation_vector((about_x, about_y, 0.0)), state)
        state.doubted += 1
    state.contradicted_s = 0.0
    y = weighed(force_mps2, gravity.sample_variance(sd_mps2, dt_s, s), s, state)
    apply(y, gain(y), state)


@compiled
def point(field_tesla: Vector, gravity_sd_mps2: float, dt_s: float, s: Settings, state: AttitudeState) -> None:
    """Tell the filter where the field (foot frame) points, unless it is disturbed."""
    world = rotated(rows(state.quat_xyzw), field_tesla)
    if norm(state.field_tesla) == 0.0 or field.disturbed(world, state.field_tesla, s):
        state.disturbed += 1
        return
    R = np.eye(1) * field.sample_variance(gravity_sd_mps2, dt_s, s)
    H = field.jacobian(state.quat_xyzw, world)
    y = innovation(state.P, H, R, field.residual(world, state.field_tesla))
    apply(y, field.heading_alone(gain(y), state.quat_xyzw), state)


@compiled
def rest(rate_radps: Vector, sd_radps: float, state: AttitudeState) -> None:
    """Tell the filter the gyro bias that a rest has shown."""
    residual = np.array(difference(rate_radps, state.gyro_bias_radps))
    y = innovation(state.P, BIAS_ALONE, np.eye(3) * sd_radps**2, residual)
    apply(y, gain(y), state)
