"""Steps: from the end of one stance to the end of the next, with the covariance of the displacement.

A stance goes on while the zero-velocity updates are accepted; interruptions shorter than the merge time belong to it.
"""

import numpy as np

from pdr_core.eskf.error_state import ATTITUDE, POSITION, SIZE
from pdr_core.eskf.state import Ends, FilterState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import yaw_rad
from pdr_core.records import StepEvent


@compiled
def stand(stamp_ns: int, state: FilterState) -> None:
    """Note that the stance lasts until now."""
    e, P = state.ends, state.P
    e.stamp_ns[1] = stamp_ns
    e.yaw_rad[1] = yaw_rad(state.nominal.quat_xyzw)
    e.yaw_sd_rad[1] = np.sqrt(P[ATTITUDE + 2, ATTITUDE + 2])
    for i in range(3):
        e.position_m[1, i] = state.nominal.position_m[i]
        for j in range(3):
            now = P[POSITION + i, POSITION + j]
            e.covariance[1, i, j] = now
            e.displacement_covariance[i, j] = (
                now + e.covariance[0, i, j] - e.cross[POSITION + i, j] - e.cross[POSITION + j, i]
            )
    for i in range(SIZE):
        for j in range(3):
            e.cross[i, 3 + j] = P[i, POSITION + j]


@compiled
def stance_is_over(stamp_ns: int, merge_ns: int, ends: Ends) -> bool:
    """Return whether the stance noted last has been over for longer than the merge time."""
    return ends.stamp_ns[1] >= 0 and abs(stamp_ns - ends.stamp_ns[1]) > merge_ns


def step_taken(ends: Ends) -> StepEvent | None:
    """Return the step to the end of the stance noted last, from which the next one begins.

    The first stance has no step before it: it is where the walk starts, and None is returned.
    """
    step = None
    if ends.stamp_ns[0] >= 0:
        step = StepEvent(
            index=int(ends.number[0]),
            start_ns=int(ends.stamp_ns[0]),
            stamp_ns=int(ends.stamp_ns[1]),
            position_m=ends.position_m[1].copy(),
            displacement_m=ends.position_m[1] - ends.position_m[0],
            displacement_covariance_m2=ends.displacement_covariance.copy(),
            yaw_rad=float(ends.yaw_rad[1]),
            yaw_sd_rad=float(ends.yaw_sd_rad[1]),
        )
    begin_next(ends)
    return step


def begin_next(ends: Ends) -> None:
    """Make the end of the stance noted last the one from which the next step begins."""
    ends.number[0] += 1
    ends.cross[:, :3] = ends.cross[:, 3:]
    for column in (ends.stamp_ns, ends.position_m, ends.covariance, ends.yaw_rad, ends.yaw_sd_rad):
        column[0] = column[1]
    ends.stamp_ns[1] = -1
