"""Their frame from one world of ours and from another: each foot has one, and so has the body between them."""

from collections.abc import Sequence

import numpy as np

from pdr_core.maths.circular import circular_mean_rad
from pdr_core.records import Floats
from pdr_core.records_external import ExternalFrame, about_up

ORIGIN_AND_X = np.eye(3)[[2, 0]] * [1.0, 1.0, 0.0]  # of a world, (2, 3)


def from_another(frame: ExternalFrame, placed_m: Floats) -> ExternalFrame:
    """Return their frame from another world of ours, by where origin and x axis of this one lie in it, (2, 3)."""
    turn_rad = turned_rad(placed_m)
    yaw_rad = frame.yaw_rad - turn_rad
    about_m = about_up(turn_rad)[:2, :2] @ frame.about_m + placed_m[0, :2]
    shift_m = frame.shift_m - about_up(yaw_rad) @ placed_m[0]
    return ExternalFrame(yaw_rad, shift_m, frame.clock_ns, frame.covariance, about_m)


def midway(frames: Sequence[ExternalFrame]) -> ExternalFrame:
    """Return the mean of frames from one world of ours; of the same fixes, so it is no surer than they are."""
    about_m = np.mean([frame.about_m for frame in frames], axis=0)
    there_m = np.mean([frame.theirs_m(np.append(about_m, 0.0)) for frame in frames], axis=0)
    yaw_rad = circular_mean_rad([frame.yaw_rad for frame in frames])
    shift_m = there_m - about_up(yaw_rad) @ np.append(about_m, 0.0)
    covariance = np.mean([covariance_at(frame, about_m) for frame in frames], axis=0)
    return ExternalFrame(yaw_rad, shift_m, round(np.mean([f.clock_ns for f in frames])), covariance, about_m)


def covariance_at(frame: ExternalFrame, about_m: Floats) -> Floats:
    """Return the covariance (4, 4) of a frame with x and y at another place (2,) of ours."""
    T = np.eye(4)
    T[:3, :3] = frame.lever_to(about_m)
    return T @ frame.covariance @ T.T


def seen_back(placed_m: Floats) -> Floats:
    """Return where origin and x axis of a world lie in one that lies in it so, (2, 3)."""
    return (ORIGIN_AND_X - placed_m[0]) @ about_up(turned_rad(placed_m))


def turned_rad(placed_m: Floats) -> float:
    """Return by how much a world is turned whose origin and x axis lie there, (2, 3)."""
    ahead = placed_m[1] - placed_m[0]
    return float(np.arctan2(ahead[1], ahead[0]))
