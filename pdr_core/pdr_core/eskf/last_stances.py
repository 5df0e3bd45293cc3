"""What a measurement tells of the places where the foot stood last, beside the place where it is.

A zero velocity tells of the swing that it ends, nothing of the track before. By the linear model it would: a residual
of some mm/s that in truth is a crooked axis or a slow filter in the sensor speaks for a turn, so for the whole track
turned about its start by millimetres a stride that grow with the distance. So the place moves by what the velocity
tells of the *displacement* since the last stance: in the gain the covariance with it stands in for that with the
position. Heights do not turn, and stay as the linear model has them. (Measured: Qiu's track of 423 m .38 -> .09 % of
its length. Joseph's form holds for any gain.)

What does tell of the track, a heading or a bias, moves the last stance ends too: they are states of the filter
(stochastic cloning), and so the displacement of a step has no jump in it.
"""

from pdr_core.eskf.error_state import POSITION
from pdr_core.eskf.state import FilterState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.kalman import Innovation, estimated_error
from pdr_core.maths.vector import product
from pdr_core.records import Floats


@compiled
def displaced(with_errors: Floats, with_ends: Floats) -> Floats:
    """Return covariances (m, 15) with the errors, x and y being of the displacement since the last stance.

    `with_ends` (m, 6) are those with the positions at both stance ends.
    """
    out = with_errors.copy()
    for i in range(out.shape[0]):
        for j in range(2):
            out[i, POSITION + j] -= with_ends[i, j]
    return out


@compiled
def correct_ends(y: Innovation, HC: Floats, state: FilterState) -> Floats:
    """Correct both stance ends, whose positions have the covariances HC (m, 6) with what is told; return the gain."""
    K = product(y.S_inverse, HC).T
    moved_m, shrunk = estimated_error(K, y), product(K, HC)
    for end in range(2):
        for i in range(3):
            state.end_position_m[end, i] += moved_m[3 * end + i]
            for j in range(3):
                state.end_covariance[end, i, j] -= shrunk[3 * end + i, 3 * end + j]
    return K
