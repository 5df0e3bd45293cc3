"""How far a track is from the truth. Pure functions; rows of estimate and truth belong together, (n, 2) or (n, 3) [m].

Two tracks with fewer than two common rows cannot be compared: NaN. Each metric is a true root mean square.
"""

import math
from collections.abc import Sequence

import numpy as np

from pdr_core.evaluation import alignment
from pdr_core.records import Floats, StepEvent

START_PATH_M = 3.0  # of true path that fix the yaw for the end error
START_PATH_OF_STRIDES_M = 10.0


def ate2_m(estimate_m: Floats, truth_m: Floats) -> float:
    """Return the RMSE of the horizontal position [m] after the least-squares yaw and shift over all rows (ATE2)."""
    return _aligned_rmse_m(estimate_m[:, :2], truth_m[:, :2])


def ate3_m(estimate_m: Floats, truth_m: Floats) -> float:
    """Return the RMSE of the position, (n, 3) [m], after the alignment of ATE2 and without the mean z offset (ATE3)."""
    return _aligned_rmse_m(estimate_m, truth_m)


def end_error_m(estimate_m: Floats, truth_m: Floats, start_path_m: float = START_PATH_M) -> float:
    """Return the horizontal error [m] at the last row, aligned at the start only."""
    if len(truth_m) < 2:
        return math.nan
    aligned_m = alignment.at_start(estimate_m, truth_m, start_path_m).apply(estimate_m)
    return closure_2d_m(aligned_m[-1], truth_m[-1])


def end_error_percent(estimate_m: Floats, truth_m: Floats, start_path_m: float = START_PATH_M) -> float:
    """Return the end error in percent of the true horizontal path; NaN where the truth does not move."""
    return percent(end_error_m(estimate_m, truth_m, start_path_m), path_length_m(truth_m))


def path_length_m(position_m: Floats) -> float:
    """Return the length of the horizontal path [m]."""
    return float(np.sum(np.linalg.norm(np.diff(position_m[:, :2], axis=0), axis=1)))


def stride_distance_m(steps: Sequence[StepEvent]) -> float:
    """Return the sum of the horizontal stride lengths [m]: the distance walked."""
    return float(sum(step.length_m for step in steps))


def closure_2d_m(first_m: Floats, last_m: Floats) -> float:
    """Return the horizontal distance [m] between two positions, (2,) or (3,)."""
    return float(np.hypot(*(last_m - first_m)[:2]))


def closure_3d_m(first_m: Floats, last_m: Floats) -> float:
    """Return the distance [m] between two positions, (3,)."""
    return float(np.linalg.norm(last_m - first_m))


def percent(part_m: float, whole_m: float) -> float:
    """Return the part in percent of the whole; NaN of nothing."""
    return 100.0 * part_m / whole_m if whole_m > 0.0 else math.nan


def _aligned_rmse_m(estimate_m: Floats, truth_m: Floats) -> float:
    """Return the root of the mean squared distance [m] after the alignment over all rows."""
    if len(truth_m) < 2:
        return math.nan
    error_m = alignment.over_whole(estimate_m, truth_m).apply(estimate_m) - truth_m
    return float(np.sqrt(np.mean(np.sum(error_m**2, axis=1))))
