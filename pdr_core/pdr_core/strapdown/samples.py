"""What two samples say of the interval between them, by what kind of sensor they come from.

points: the value at the stamp. Over a motion from rest to rest trapezia add up to nearly the true integral: they are
off by dt^2 / 12 times the change of the derivative from end to end (Euler and Maclaurin). To take rate and force for
straight lines between the samples, sculling and all, is worse. But in the midst of the motion the attitude by
trapezia is ahead of the true one by dt^2 / 12 w', in the foot frame. So the force is turned back by that. With both,
and `mean_rate`, the errors of attitude and speed from rest to rest are of fourth order.

means: what a sensor gives that integrates inside, at a high rate: the turn and the speed of the interval, over its
length. Nothing is left to be added.

averages: what a sensor gives that only averages, or filters. The turn is not the average rate times the interval, since
the axis moves (coning), nor the speed the average force times it, since the force turns (sculling). With rate and force
that change evenly, at the pace from one average to the next, Savage 1998 (Strapdown inertial navigation integration
algorithm design, parts 1 and 2) finds from the increments a, v of the interval and a', v' of the one before

    turn = a + a' x a / 12        speed = v + a x v / 2 + a x (a x v) / 6 + (a' x v + v' x a) / 12

of which a x v / 2 + a x (a x v) / 4 is in `advance` already: it turns the force by the mean of both attitudes.
"""

from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import Triple, added, cross, difference, scaled
from pdr_core.strapdown.mechanisation import mean_rate

POINTS, MEANS, AVERAGES = 0, 1, 2
KINDS = {"points": POINTS, "means": MEANS, "averages": AVERAGES}


@compiled
def between(
    kind: int, last_rate: Triple, rate: Triple, last_force: Triple, force: Triple, dt_s: float
) -> tuple[Triple, Triple, Triple]:
    """Return the rate [rad/s] that turns the foot over the interval, and the force [m/s^2] at its start and its end.

    Samples of one kind, without bias, in the foot frame. Averages are taken over intervals of equal length.
    """
    if kind == MEANS:
        return rate, force, force
    if kind == AVERAGES:
        sculling = added(cross(last_rate, force), cross(last_force, rate))
        bending = scaled(dt_s, cross(rate, cross(rate, force)))
        felt = added(force, scaled(dt_s / 12.0, difference(sculling, bending)))
        return added(rate, scaled(dt_s / 12.0, cross(last_rate, rate))), felt, felt
    ahead_rad = scaled(dt_s / 12.0, difference(rate, last_rate))
    before = difference(last_force, cross(ahead_rad, last_force))
    return mean_rate(last_rate, rate, dt_s), before, difference(force, cross(ahead_rad, force))
