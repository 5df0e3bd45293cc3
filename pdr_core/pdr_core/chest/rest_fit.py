"""What a rest tells of a person who sways: bias and attitude by rate and force together.

Eq. 2 takes the mean rate for the bias, and eq. 3 the mean force for the attitude. But a person who stands sways by some
tenths of a degree. The mean rate is off by the change of tilt from end to end, and the walk begins from the tilt of its
last moment, not from the mean. Yet both sensors see the sway. With q the integral of the rate since the rest began,

    q = tilt change + b t,    and    f x f' / |f|^2 = -rate across f,                                (a)

since a vector that stands in the world moves by f' = -w x f in the chest's axes. So with the slopes of q and f over the
rest, by least squares, their sway cancels:

    b = slope q + f x slope f / |f|^2                                                                (b)

Along f, about the vertical, the force tells nothing and b is the slope of q alone. The attitude at the end is that of
the mean force, turned by what q has turned since its own mean, without the bias:

    R = R_mean exp(q - mean q - b (t - mean t))                                                      (c)

The angles are so small that rotation vectors add. What is left is that a body which sways about its ankles is pushed
sideways too, by h w^2 / g of its tilt, and the force takes that for tilt.
"""

from pdr_core.chest.state import ChestState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import Four, from_rotation_vector
from pdr_core.maths.vector import Triple, Vector, added, cross, scaled

COUNT, RATE, FORCE, FORCE_NORM, RATE_NORM = 0, 1, 4, 7, 8  # in a bucket: sums of 1, w, f, |f|, |w|
TIME, TIME_SQUARE, ANGLE, TIME_ANGLE, TIME_FORCE = 9, 10, 11, 14, 17
SHORTEST_S2 = 0.01  # variance of the times: about a third of a second; before that there is no slope


@compiled
def take_in(stamp_ns: int, force_mps2: Triple, rate_radps: Triple, state: ChestState) -> None:
    """Take a sample into the open bucket, if there is a rest."""
    if not state.resting:
        return
    t = (stamp_ns - state.rest_start_ns) * 1e-9
    dt_s = (stamp_ns - state.last_ns) * 1e-9
    b = state.bucket
    b[TIME] += t
    b[TIME_SQUARE] += t**2
    for i in range(3):
        state.rest_angle_rad[i] += 0.5 * (rate_radps[i] + state.last_rate_radps[i]) * dt_s
        b[ANGLE + i] += state.rest_angle_rad[i]
        b[TIME_ANGLE + i] += t * state.rest_angle_rad[i]
        b[TIME_FORCE + i] += t * force_mps2[i]


@compiled
def mean_of(sums: Vector, first: int) -> Triple:
    """Return the mean of three sums."""
    return scaled(1.0 / sums[COUNT], (sums[first], sums[first + 1], sums[first + 2]))


@compiled
def time_variance_s2(sums: Vector) -> float:
    """Return the variance of the times of all samples."""
    return sums[TIME_SQUARE] / sums[COUNT] - (sums[TIME] / sums[COUNT]) ** 2


@compiled
def slope(sums: Vector, of: int, times: int) -> Triple:
    """Return the slope of a vector over time by least squares."""
    mean, product, t = mean_of(sums, of), mean_of(sums, times), sums[TIME] / sums[COUNT]
    return scaled(1.0 / time_variance_s2(sums), added(product, scaled(-t, mean)))


@compiled
def fitted_bias(state: ChestState) -> Triple:
    """Return the bias of eq. (b); while there is no slope yet, the mean rate."""
    sums = state.rest_sums
    if time_variance_s2(sums) < SHORTEST_S2:
        return mean_of(sums, RATE)
    force = mean_of(sums, FORCE)
    square = force[0] ** 2 + force[1] ** 2 + force[2] ** 2
    seen = scaled(1.0 / square, cross(force, slope(sums, FORCE, TIME_FORCE)))
    return added(slope(sums, ANGLE, TIME_ANGLE), seen)


@compiled
def fitted_turn(state: ChestState) -> Four:
    """Return the turn of eq. (c), from the attitude of the mean force to that of now."""
    sums, b = state.rest_sums, state.gyro_bias_radps
    t = (state.last_ns - state.rest_start_ns) * 1e-9 - sums[TIME] / sums[COUNT]
    mean = mean_of(sums, ANGLE)
    q = state.rest_angle_rad
    return from_rotation_vector((q[0] - mean[0] - b[0] * t, q[1] - mean[1] - b[1] * t, q[2] - mean[2] - b[2] * t))
