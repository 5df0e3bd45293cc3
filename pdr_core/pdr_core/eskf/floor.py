"""Level ground: a foot that stands at nearly the height of the floor stands on the floor.

Heights drift by one to two centimetres a stride, and nothing bounds it. But where a foot stands, its sensor is about
as high above the floor as it was when it stood there before. So the height z of a stance and that of the floor l give
the pseudo-measurement

    z - l = 0 with the noise R,    residual = (l - z) of the estimate.

A stance that is higher or lower than the floor by more than half a riser is on another floor, whose height is then that
of the end of this stance. So stairs keep their steps, no update moves the foot by more than this limit, and no wrong
floor is held on to. Ramps are not told from drift: one that is too gentle is taken for level.

The floor is as uncertain as the end of the stance that showed it, by stochastic cloning as in `step_events.py`, and by
R, since that stance was as far off the floor as any other may be. It is never corrected (Schmidt's consider state):

    HP = P_z - C_l,    S = P_zz - 2 C_zl + P_ll + R,    H C = C_z - C_l of each clone,

with C the covariances of the errors with the clones. Only the height is corrected, by its row HP_z / S of the optimal
gain. By the linear model a height that is off also speaks for a tilt and a turned track; but what is off is mostly what
the model does not know, and so the horizontal track stays the same to the last bit (measured with all rows but those of
yaw and gyro bias: tile walks .163 -> .165 m, xio loop .033 -> .040 m, motion capture room .0545 -> .0537 m).

Samples of one stance are not independent. All of them together tell what the calmest one does: a foot that moves at the
velocity noise s is off by SHIFT_S s, and the information 1/R of a calmer sample counts by what it has more than the
sample before. So the result does not depend on the rate, nor on how long the foot stands.
"""

import numpy as np

from pdr_core.eskf.error_state import POSITION, SIZE
from pdr_core.eskf.state import FilterState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.kalman import Innovation
from pdr_core.records import Floats

HEIGHT = POSITION + 2
SHIFT_S = 0.2  # half a stance: from any moment of it to the calmest


@compiled
def known(state: FilterState) -> bool:
    """Return whether there is a floor to stand on."""
    return not np.isnan(state.floor_m)


@compiled
def information(velocity_sd_mps: float, floor_sd_m: float) -> float:
    """Return what a foot that stands so still tells of the height of its floor, 1/R [1/m^2]."""
    return 1.0 / (floor_sd_m**2 + (SHIFT_S * velocity_sd_mps) ** 2)


@compiled
def innovation(variance_m2: float, state: FilterState) -> Innovation:
    """Return the innovation of standing on the floor."""
    HP = (state.P[HEIGHT] - state.floor_cross[:, 0]).reshape(1, SIZE)
    S = HP[:, HEIGHT : HEIGHT + 1] - with_itself(state) + variance_m2
    return Innovation(np.array([state.floor_m - state.position_m[2]]), HP, S, 1.0 / S)


@compiled
def with_ends(state: FilterState) -> Floats:
    """Return H C, (1, 6): the covariance of what is measured with the ends of the last stances."""
    return state.cross[HEIGHT : HEIGHT + 1] - state.floor_ends


@compiled
def with_itself(state: FilterState) -> Floats:
    """Return H C, (1, 1): the covariance of what is measured with the height of the floor."""
    return state.floor_cross[HEIGHT : HEIGHT + 1] - state.floor_variance_m2


@compiled
def gain(y: Innovation) -> Floats:
    """Return the gain (15, 1) that corrects the height alone."""
    K = np.zeros((SIZE, 1))
    K[HEIGHT, 0] = y.HP[0, HEIGHT] * y.S_inverse[0, 0]
    return K


def settle(floor_sd_m: float, state: FilterState) -> None:
    """Close the stance that has just become the confirmed one: if it told nothing of the floor, it shows a new one."""
    if state.floor_told == 0.0:
        state.floor_m = state.end_position_m[0, 2]
        state.floor_cross[:, 0] = state.cross[:, 2]
        state.floor_ends[0, :3] = state.end_covariance[0, 2]
        state.floor_variance_m2 = state.end_covariance[0, 2, 2] + floor_sd_m**2
    state.floor_told = 0.0


@compiled
def forget(state: FilterState) -> None:
    """Make the next stance show its floor."""
    state.floor_m = np.nan
    state.floor_told = 0.0
