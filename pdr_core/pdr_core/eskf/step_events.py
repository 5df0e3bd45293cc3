"""Steps: from the end of one stance to the end of the next, with the covariance of the displacement.

A stance goes on while the zero-velocity updates are believed; interruptions shorter than the merge time belong to it,
and longer ones in which the foot neither goes away nor turns: a person who fidgets takes no step. What counts is how
far the foot was, not where it came down, so a step on the spot is one.
"""

import numpy as np

from pdr_core.conventions import NO_STAMP
from pdr_core.eskf.error_state import ATTITUDE, POSITION, SIZE
from pdr_core.eskf.floor import settle
from pdr_core.eskf.settings import Settings
from pdr_core.eskf.state import FilterState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import turn_about_up_rad, yaw_rad
from pdr_core.maths.vector import norm
from pdr_core.records import StepEvent

ENDS = ("end_ns", "end_sample", "end_position_m", "end_covariance", "end_quat_xyzw", "end_yaw_rad", "end_yaw_sd_rad")


@compiled
def stand(stamp_ns: int, state: FilterState) -> None:
    """Note that the stance lasts until now."""
    state.excursion_m = max(state.excursion_m, state.away_m)
    state.away_m = 0.0
    state.end_ns[1], state.end_sample[1] = stamp_ns, state.samples
    note_end(state)
    for i in range(SIZE):
        for j in range(3):
            state.cross[i, 3 + j] = state.P[i, POSITION + j]
    for j in range(3):
        state.floor_ends[0, 3 + j] = state.floor_cross[POSITION + j, 0]
        state.north_ends[0, 3 + j] = state.north_cross[POSITION + j, 0]


@compiled
def note_end(state: FilterState) -> None:
    """Note the foot as it stands now: pose, and covariance of the displacement between here and the other end."""
    P = state.P
    state.end_quat_xyzw[1] = state.quat_xyzw
    state.end_yaw_rad[1] = yaw_rad(state.quat_xyzw)
    state.end_yaw_sd_rad[1] = np.sqrt(P[ATTITUDE + 2, ATTITUDE + 2])
    for i in range(3):
        state.end_position_m[1, i] = state.position_m[i]
        for j in range(3):
            now = P[POSITION + i, POSITION + j]
            state.end_covariance[1, i, j] = now
            state.displacement_covariance[i, j] = (
                now + state.end_covariance[0, i, j] - state.cross[POSITION + i, j] - state.cross[POSITION + j, i]
            )


@compiled
def roam(state: FilterState) -> None:
    """Note how far the foot is from where it stood last."""
    state.away_m = max(state.away_m, norm(state.position_m - state.end_position_m[1]))


@compiled
def stance_is_over(stamp_ns: int, merge_ns: int, state: FilterState) -> bool:
    """Return whether the stance noted last has been over for longer than the merge time at a stamp."""
    return state.end_ns[1] != NO_STAMP and abs(stamp_ns - state.end_ns[1]) > merge_ns


def step_taken(state: FilterState, s: Settings, answer_due_ns: int) -> StepEvent | None:
    """Return the step to the end of the stance noted last, from which the next one begins.

    None is returned for the first stance, which is where the walk starts, and where the foot was never as far away as
    `step_min_m` and has not turned by `step_turn_min_rad`: then it is still the same stance. `answer_due_ns` is the
    stamp at which the filter will wait for the heading observation, or NO_STAMP.
    """
    first, step = state.end_ns[0] == NO_STAMP, None
    turn_rad = abs(turn_about_up_rad(state.end_quat_xyzw[0], state.end_quat_xyzw[1]))
    if not first and (state.excursion_m >= s.step_min_m or turn_rad >= s.step_turn_min_rad):
        step = StepEvent(
            index=int(state.step_number),
            start_ns=int(state.end_ns[0]),
            stamp_ns=int(state.end_ns[1]),
            position_m=state.end_position_m[1].copy(),
            displacement_m=state.end_position_m[1] - state.end_position_m[0],
            displacement_covariance_m2=state.displacement_covariance.copy(),
            yaw_rad=float(state.end_yaw_rad[1]),
            yaw_sd_rad=float(state.end_yaw_sd_rad[1]),
            answer_due_ns=answer_due_ns,
            sample_numbers=(int(state.end_sample[0]), int(state.end_sample[1])),
            position_covariance_m2=state.end_covariance[1].copy(),
        )
    state.step_number += first or step is not None
    begin_next(state)
    if s.level_ground:
        settle(s.floor_sd_m, state)
    return step


def begin_next(state: FilterState) -> None:
    """Make the end of the stance noted last the one from which the next step begins."""
    state.excursion_m = 0.0
    state.cross[:, :3] = state.cross[:, 3:]
    state.floor_ends[:, :3] = state.floor_ends[:, 3:]
    state.north_ends[:, :3] = state.north_ends[:, 3:]
    for name in ENDS:
        state[name][0] = state[name][1]
    state.end_ns[1] = NO_STAMP
