"""The measurement updates: gate, gain, correction of estimate and covariance (Gui eq. 20-26, Zhou eq. 10-13)."""

import numpy as np

from pdr_core.conventions import GAP_NS
from pdr_core.eskf import field_heading, floor, gravity, heading, position, zaru, zupt
from pdr_core.eskf.error_state import ACCEL_BIAS, ATTITUDE, GYRO_BIAS, POSITION, SIZE, VELOCITY
from pdr_core.eskf.known_yaw import YAW, given_yaw
from pdr_core.eskf.last_stances import correct_ends, displaced
from pdr_core.eskf.settings import Settings
from pdr_core.eskf.state import FilterState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.kalman import (
    Innovation,
    correct,
    correct_cross,
    estimated_error,
    gain,
    innovation,
    normalised_squared,
)
from pdr_core.maths.quaternion import from_rotation_vector, multiply, normalised
from pdr_core.maths.vector import Vector, difference, norm, product
from pdr_core.records import Floats

SHORTEST_SWING_S = 0.1  # in a shorter time a wrong tilt cannot be told from a shock


@compiled
def apply(y: Innovation, H: Floats, K: Floats, state: FilterState) -> None:
    """Correct the estimate, its covariance and its covariance with the ends of the last stances and the floor."""
    inject(state, estimated_error(K, y))
    correct_cross(state.cross, K, product(H, state.cross))
    if floor.known(state):
        correct_cross(state.floor_cross, K, product(H, state.floor_cross))
    if field_heading.known(state):
        correct_cross(state.north_cross, K, product(H, state.north_cross))
    correct(state.P, K, y)


@compiled
def learn(y: Innovation, H: Floats, state: FilterState) -> None:
    """Correct all that is known by the optimal gain, where the foot stood last too."""
    K = correct_ends(y, product(H, state.cross), state)
    if floor.known(state):
        state.floor_ends[:] -= product(product(H, state.floor_cross).T, K.T)
    if field_heading.known(state):
        state.north_ends[:] -= product(product(H, state.north_cross).T, K.T)
    apply(y, H, gain(y), state)


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
    if state.places > 0:
        state.place_azimuth_rad[:] += error[ATTITUDE + 2]


@compiled
def zero_velocity(stamp_ns: int, rate_radps: Vector, sd_mps: float, s: Settings, state: FilterState) -> bool:
    """Tell the filter that the foot stands, at a measured rate (3,) and with a velocity noise; return if they agree.

    A verdict may be wrong, and so may the estimate. An innovation beyond `huber` counts less the larger it is (Huber's
    weight): R grows by sd^2 (d2 / huber - 1). Beyond the gate it contradicts the estimate, but is never rejected: a dip
    in mid-swing hardly counts, and where the contradiction goes on, it is the estimate that is wrong, and its
    covariance is raised until it agrees with the stance. So nothing locks the filter out.
    """
    rolling = zupt.rolling_velocity(state.quat_xyzw, difference(rate_radps, state.gyro_bias_radps), s.contact_height_m)
    residual = zupt.residual(rolling, state.velocity_mps)
    y, given = weighed(residual, sd_mps, state)
    d2 = normalised_squared(given)
    state.normalised_innovation = d2
    agrees = d2 <= s.gate
    if proven_wrong(stamp_ns, d2, s, state):
        doubt(stamp_ns, norm(residual), state)
        y, given = weighed(residual, sd_mps, state)
        d2 = normalised_squared(given)
    if d2 > s.huber:
        y, given = weighed(residual, sd_mps * np.sqrt(d2 / s.huber), state)
    K = gain(given)
    if not state.bias_is_rare:
        zupt.without_gyro_bias(K)
    apply(y, zupt.H, K, state)
    if agrees:
        state.accepted += 1
        state.last_accepted_ns = stamp_ns
    else:
        state.contradicted += 1
    return agrees


@compiled
def weighed(residual: Floats, sd_mps: float, state: FilterState) -> tuple[Innovation, Innovation]:
    """Return the innovation of a velocity residual (3,), and what it would be if the yaw were known."""
    y = innovation(state.P, zupt.H, np.eye(3) * sd_mps**2, residual)
    HP = displaced(y.HP, product(zupt.H, state.cross))
    yaw = displaced(state.P[YAW : YAW + 1], state.cross[YAW : YAW + 1])
    return y, given_yaw(yaw[0], Innovation(y.residual, HP, y.S, y.S_inverse))


@compiled
def proven_wrong(stamp_ns: int, d2: float, s: Settings, state: FilterState) -> bool:
    """Return whether stances have contradicted the estimate for longer than the release time, or two in a row did.

    In a sprint a stance is shorter than the release time. Only one with its full weight ends the contradiction: where a
    stance begins and ends, its noise is so large that any estimate would pass the gate.
    """
    contradicted_s, contradicted_ns = float(state.contradicted_s), int(state.contradicted_ns)
    if d2 <= s.gate:
        state.contradicted_s = 0.0 if d2 <= s.huber else contradicted_s
        return False
    second = contradicted_s > 0.0 and stamp_ns - contradicted_ns > s.merge_ns
    contradicted_s += min(stamp_ns - state.last_ns, GAP_NS) * 1e-9
    state.contradicted_s, state.contradicted_ns = contradicted_s, stamp_ns
    return second or contradicted_s > s.release_s


@compiled
def doubt(stamp_ns: int, speed_mps: float, state: FilterState) -> None:
    """Admit that the velocity is wrong by as much as it shows, and that a wrong tilt may have made it so."""
    state.doubted += 1
    swing_s = max(SHORTEST_SWING_S, (stamp_ns - state.last_accepted_ns) * 1e-9)
    tilt_rad = min(np.pi, speed_mps / (state.gravity_mps2 * swing_s))
    state.doubt[VELOCITY : VELOCITY + 3] = speed_mps**2
    state.doubt[ATTITUDE : ATTITUDE + 2] = tilt_rad**2
    for i in range(SIZE):
        state.P[i, i] += state.doubt[i]


@compiled
def zero_rate(rest_rate_radps: Vector, rest_sd_radps: float, state: FilterState) -> None:
    """Tell the filter the gyro bias that a rest has shown."""
    R = np.eye(3) * rest_sd_radps**2
    y = innovation(state.P, zaru.H, R, zaru.residual(rest_rate_radps, state.gyro_bias_radps))
    learn(y, zaru.H, state)


@compiled
def correct_heading(yaw_error_rad: float, sd_rad: float, state: FilterState) -> None:
    """Tell the filter by how much its track is turned too far."""
    R = np.eye(1) * sd_rad**2
    y = innovation(state.P, heading.H, R, heading.residual(yaw_error_rad))
    learn(y, heading.H, state)


@compiled
def correct_position(position_error_m: Floats, covariance_m2: Floats, state: FilterState) -> None:
    """Tell the filter by how much its place is off, (3,), with the covariance (3, 3) of that."""
    y = innovation(state.P, position.H, covariance_m2, position.residual(position_error_m))
    learn(y, position.H, state)


@compiled
def level(force_mps2: Vector, sd_mps: float, state: FilterState) -> None:
    """Tell the filter where up is; the foot stands, with a velocity noise.

    It says nothing of the gyro bias. By the linear model it would, where the tilt is correlated with it through a yaw
    that is lost; and the next rest, which tells the bias, would then turn the track by what it corrects.
    """
    force = difference(force_mps2, state.accel_bias_mps2)
    R = gravity.noise(sd_mps, state.gravity_mps2)
    y = innovation(state.P, gravity.H, R, gravity.residual(state.quat_xyzw, force))
    apply(y, gravity.H, zupt.without_gyro_bias(gain(given_yaw(state.P[YAW], y))), state)


@compiled
def stand_on_floor(sd_mps: float, s: Settings, state: FilterState) -> None:
    """Tell the filter that a foot that stands, with a velocity noise, does so on the floor, if it is near enough."""
    told = floor.information(sd_mps, s.floor_sd_m)
    if not floor.known(state) or told <= state.floor_told:
        return
    y = floor.innovation(1.0 / (told - state.floor_told), state)
    on_floor = abs(y.residual[0]) <= s.floor_limit_m
    state.floor_told = told if on_floor else 0.0
    if on_floor:
        K = floor.gain(y)
        state.position_m[2] += estimated_error(K, y)[floor.HEIGHT]
        correct_cross(state.cross, K, floor.with_ends(state))
        correct_cross(state.floor_cross, K, floor.with_itself(state))
        correct(state.P, K, y)
