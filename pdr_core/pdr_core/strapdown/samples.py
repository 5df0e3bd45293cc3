"""What two samples say of the interval between them, by what kind of sensor they come from.

points: the value at the stamp. The mean of the ends is all that is needed of the force: the sum of the trapezia of a
motion between two rests is off by the change of the derivative from rest to rest alone (Euler and Maclaurin), which is
none. Of the rate, `mean_rate` takes what a turning frame adds to that.

means: what a sensor gives that integrates inside, at a high rate: the turn and the speed of the interval, over its
length. Nothing is left to be added.

averages: what a sensor gives that only averages, or filters. The turn is not the average rate times the interval, since
the axis moves (coning), nor the speed the average force times it, since the force turns (sculling). With rate and force
that change evenly, at the pace from one average to the next, Savage 1998 (Strapdown inertial navigation integration
algorithm design, parts 1 and 2) finds from the increments a, v of the interval and a', v' of the one before

    turn = a + a' x a / 12        speed = v + a x v / 2 + (a' x v + v' x a) / 12

of which a x v / 2 is in `advance` already: it turns the force by the mean of both attitudes.
"""

from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import Triple, Vector, added, cross, scaled
from pdr_core.strapdown.mechanisation import mean_rate

POINTS, MEANS, AVERAGES = 0, 1, 2
KINDS = {"points": POINTS, "means": MEANS, "averages": AVERAGES}


@compiled
def between(
    kind: int, last_rate: Vector, rate: Vector, last_force: Vector, force: Vector, dt_s: float
) -> tuple[Triple, Triple, Triple]:
    """Return the rate [rad/s] that turns the foot over the interval, and the force [m/s^2] at its start and its end.

    Samples of one kind, without bias, in the foot frame. Averages are taken over intervals of equal length.
    """
    if kind == POINTS:
        return mean_rate(last_rate, rate, dt_s), triple(last_force), triple(force)
    if kind == MEANS:
        return triple(rate), triple(force), triple(force)
    sculling = added(cross(last_rate, force), cross(last_force, rate))
    sculled = added(force, scaled(dt_s / 12.0, sculling))
    return added(rate, scaled(dt_s / 12.0, cross(last_rate, rate))), sculled, sculled


@compiled
def triple(v: Vector) -> Triple:
    """Return three numbers."""
    return v[0], v[1], v[2]
