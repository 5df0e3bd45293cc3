"""How far a walk gets with the gyro off: the first half teaches, the second is dead reckoned by several headings.

The filter with the gyro on tells the first half: heading deviation, north, how the person turns. From its pose there
the second half is dead reckoned with the true stride lengths, so that only the heading counts. Stands and impulses come
from the accelerometer alone. The end error is against the truth, laid on the filter's track over the first half.
"""

from dataclasses import dataclass, replace

import numpy as np

from pdr_core.bench.gyro_off_methods import METHODS, taught
from pdr_core.bench.gyro_off_walk import GyroOffWalk
from pdr_core.evaluation.metrics import closure_2d_m, path_length_m, percent
from pdr_core.gait.dead_reckoning import GaitDeadReckoning, Length
from pdr_core.params import Params
from pdr_core.records import Handover, PoseEstimate
from pdr_core.records_gait import Behaviour, GaitStep

LENGTH_SD_M = 0.03  # of true stride lengths: feet do not come down where tiles say to the millimetre


@dataclass(frozen=True)
class HalfWalk:
    """What became of the second half by one method."""

    walk: str
    method: str
    end_error_percent: float
    end_sd_percent: float  # what the covariance says of it
    gyro_share: float  # of the time


def half_walk(walk: GyroOffWalk, method: str, params: Params) -> HalfWalk:
    """Dead reckon the second half by a method of METHODS."""
    lesson = taught(walk, params)
    strides = METHODS[method](lesson)
    track = GaitDeadReckoning(params.dead_reckoning)
    pose = PoseEstimate(
        walk.nav.position_m[walk.half], walk.nav.quat_xyzw[walk.half], walk.nav.pose_covariance[walk.half]
    )
    track.begin(Handover(walk.stands[walk.half].stamp_ns, pose, None))
    for i, stride in enumerate(strides, walk.half):
        length = Length(float(walk.lengths_m[i]), LENGTH_SD_M)
        track.step(gait_step(walk, i), length, stride.turn, stride.deviation, stride.heading)
    end, whole_m = track.handover.pose, path_length_m(walk.truth_m[walk.half :])
    duration_s = np.diff([stand.stamp_ns for stand in walk.stands[walk.half :]]) * 1e-9
    on = np.array([stride.gyro_on for stride in strides])
    return HalfWalk(
        walk.name,
        method,
        percent(closure_2d_m(end.position_m[:2], walk.truth_m[-1]), whole_m),
        percent(float(np.sqrt(np.trace(end.covariance[:2, :2]))), whole_m),
        float(duration_s[on].sum() / duration_s.sum()),
    )


def gait_step(walk: GyroOffWalk, i: int) -> GaitStep:
    """Return the stride between two stands; dead reckoning needs its stamps alone."""
    stamps = walk.stands[i].stamp_ns, walk.stands[i + 1].stamp_ns
    return GaitStep(i + 1, *stamps, Behaviour.WALKING, 1e9 / (stamps[1] - stamps[0]), 0.0, 0.0, 0.0, 0.0)


def with_suspicion(params: Params, suspicion_rad: float) -> Params:
    """Return the parameters with another turn that wakes the gyro."""
    return replace(params, dead_reckoning=replace(params.dead_reckoning, suspicion_rad=suspicion_rad))
