"""The measurement updates: gate, gain, correction of estimate and covariance (Gui eq. 20-26, Zhou eq. 10-13)."""

import numpy as np

from pdr_core.conventions import NO_STAMP
from pdr_core.eskf import heading, zaru, zupt
from pdr_core.eskf.error_state import ACCEL_BIAS, ATTITUDE, GYRO_BIAS, POSITION, VELOCITY
from pdr_core.eskf.settings import Settings
from pdr_core.eskf.state import FilterState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.kalman import (
    Innovation,
    correct,
    correct_cross,
    estimated_error,
    gain,
    inflated,
    innovation,
    normalised_squared,
    symmetrise,
)
from pdr_core.maths.quaternion import from_rotation_vector, multiply, normalised
from pdr_core.maths.vector import Vector, norm
from pdr_core.records import Floats

HOPELESS_MPS = 2.0  # a standing foot that seems so fast is no matter of noise
SHORTEST_SWING_S = 0.1  # in a shorter time a wrong tilt cannot be told from a shock


@compiled
def apply(y: Innovation, H: Floats, K: Floats, state: FilterState) -> None:
    """Correct the estimate, its covariance and its covariance with the ends of the last stances."""
    error = estimated_error(K, y)
    inject(state, error)
    correct_cross(state.cross, K, H)
    correct(state.P, K, y)
    relate(error[VELOCITY : VELOCITY + 3], state.cross)
    relate_covariance(error[VELOCITY : VELOCITY + 3], state.P)


@compiled
def inject(state: FilterState, error: Floats) -> None:
    """Correct the estimate by the estimated errors (15,), which are zero thereafter."""
    turn = from_rotation_vector(error[ATTITUDE : ATTITUDE + 3])
    state.quat_xyzw[:] = normalised(multiply(turn, state.quat_xyzw))
    for i in range(3):
        state.position_m[i] += error[POSITION + i]
        state.velocity_mps[i] += error[VELOCITY + i]
        state.accel_bias_mps2[i] += error[ACCEL_BIAS + i]
        state.gyro_bias_radps[i] += error[GYRO_BIAS + i]


@compiled
def relate(change_mps: Floats, M: Floats) -> None:
    """Replace M, (15, m), by T M: with the velocity, the velocity error that a yaw error makes has changed.

    A yaw error turns the estimated velocity v too: yaw error times z x v is part of the velocity error. When an update
    moves v by `change_mps`, that part changes by yaw error times z x `change_mps`. It is of second order, but it adds
    up over thousands of updates: without it each of them shows a little of the yaw, which none can see. (The errors of
    the invariant filter of Barrau and Bonnabel, 2017, have this built in, for all three axes.)
    """
    for j in range(M.shape[1]):
        M[VELOCITY, j] -= M[ATTITUDE + 2, j] * change_mps[1]
        M[VELOCITY + 1, j] += M[ATTITUDE + 2, j] * change_mps[0]


@compiled
def relate_covariance(change_mps: Floats, P: Floats) -> None:
    """Replace P, (15, 15), by T P T', exactly symmetric."""
    relate(change_mps, P)
    relate(change_mps, P.T)
    symmetrise(P)


@compiled
def zero_velocity(stamp_ns: int, s: Settings, state: FilterState) -> bool:
    """Tell the filter that the foot stands; return whether it believed it.

    An innovation beyond the gate is rejected: a false stance would stop a swinging foot. But where the rejections go
    on for longer than the release time, it is the estimate that is wrong. Then the update is taken with a noise that
    brings it to the gate; and where even then, after the same time, a standing foot seems faster than a walker, the
    covariance is raised until it agrees with the stance. So nothing locks the filter out.
    """
    y = zero_velocity_innovation(s, state)
    d2 = normalised_squared(y)
    state.normalised_innovation = d2
    if d2 > s.gate:
        since_ns = rejecting_for_ns(stamp_ns, state)
        if since_ns < s.release_ns:
            state.rejected += 1
            return False
        state.released += 1
        if since_ns < 2 * s.release_ns or norm(state.velocity_mps) < HOPELESS_MPS:
            y = inflated(y, d2 / s.gate)
        else:
            doubt(stamp_ns, state)
            y = zero_velocity_innovation(s, state)
    else:
        state.rejecting_since_ns = NO_STAMP
    apply(y, zupt.jacobian(state.velocity_mps), zupt.without_gyro_bias(gain(y)), state)
    state.last_accepted_ns = stamp_ns
    state.accepted += 1
    return True


@compiled
def zero_velocity_innovation(s: Settings, state: FilterState) -> Innovation:
    """Return what a stance says beyond the estimate."""
    R = np.eye(3) * s.zero_velocity_sd_mps**2
    return innovation(state.P, zupt.jacobian(state.velocity_mps), R, zupt.residual(state.velocity_mps))


@compiled
def rejecting_for_ns(stamp_ns: int, state: FilterState) -> int:
    """Return for how long [ns] stances have been beyond the gate, this one included."""
    if state.rejecting_since_ns == NO_STAMP:
        state.rejecting_since_ns = stamp_ns
    return stamp_ns - state.rejecting_since_ns


@compiled
def doubt(stamp_ns: int, state: FilterState) -> None:
    """Admit that the velocity is wrong by as much as it shows, and that a wrong tilt may have made it so."""
    speed_mps = norm(state.velocity_mps)
    swing_s = max(SHORTEST_SWING_S, (stamp_ns - state.last_accepted_ns) * 1e-9)
    tilt_rad = min(np.pi, speed_mps / (state.gravity_mps2 * swing_s))
    for i in range(3):
        state.P[VELOCITY + i, VELOCITY + i] += speed_mps**2
    for i in range(2):
        state.P[ATTITUDE + i, ATTITUDE + i] += tilt_rad**2


@compiled
def zero_rate(rest_rate_radps: Vector, rest_sd_radps: float, state: FilterState) -> None:
    """Tell the filter the gyro bias that a rest has shown."""
    R = np.eye(3) * rest_sd_radps**2
    y = innovation(state.P, zaru.H, R, zaru.residual(rest_rate_radps, state.gyro_bias_radps))
    apply(y, zaru.H, gain(y), state)


@compiled
def correct_heading(yaw_error_rad: float, sd_rad: float, state: FilterState) -> None:
    """Tell the filter by how much its track is turned too far."""
    R = np.eye(1) * sd_rad**2
    y = innovation(state.P, heading.H, R, heading.residual(yaw_error_rad))
    apply(y, heading.H, gain(y), state)
