"""Two known points fix where a track lies in a map: "I am at A", later "I am at B".

With a and b the places on our track, A and B those on the map, the yaw of the map from ours is the direction of B - A
minus that of b - a, and the shift is that which lays the middle of a and b on the middle of A and B: so both points
count alike. With the deviation s of each known point and of our way from a to b (covariance P, its part along and
across the way), the length l of the way, and u across it,

    var yaw = (2 s^2 + u' P u) / l^2,      var middle = s^2 / 2 I + P / 4.

A later point C at c of ours corrects both. At c the frame says that we are at m, with a covariance F of m and yaw: that
of the frame moved to c, and what our track has lost since the point before (G, of place and yaw). C measures m alone,
so with S = F_mm + s^2 I and the gain K = F_:m S^-1

    (m, yaw) += K (C - m),      F -= K S K'.
"""

import numpy as np

from pdr_core.maths.circular import wrapped_rad
from pdr_core.records import Floats
from pdr_core.records_external import ExternalFrame, about_up, lever

PLANE = np.ix_([0, 1, 5], [0, 1, 5])  # x, y and yaw of a pose covariance
FARTHEST_SD = 4.0  # deviations by which both ways may differ in length


def between_known_points(ours_m: Floats, way_covariance_m2: Floats, map_m: Floats, point_sd_m: float) -> ExternalFrame:
    """Return the map's frame from ours by two places on both, (2, 3) each.

    `way_covariance_m2` (2, 2) is that of our way from one to the other, `point_sd_m` how well each point is known.
    ValueError where they are too near to each other, or their distances do not agree.
    """
    ours, theirs = (places_m[1, :2] - places_m[0, :2] for places_m in (ours_m, map_m))
    length_m, map_length_m = float(np.hypot(*ours)), float(np.hypot(*theirs))
    along = ours / max(length_m, 1e-9)
    across = np.array([-along[1], along[0]])
    spread_m = np.sqrt(2.0 * point_sd_m**2 + along @ way_covariance_m2 @ along)
    side_m2 = 2.0 * point_sd_m**2 + float(across @ way_covariance_m2 @ across)
    if length_m <= FARTHEST_SD * np.sqrt(side_m2) or map_length_m == 0.0:
        raise ValueError(f"the two points are {length_m:.1f} m apart: too near to each other to tell a direction")
    if abs(length_m - map_length_m) > FARTHEST_SD * spread_m:
        text = f"the two points are {length_m:.1f} m apart on the track, {map_length_m:.1f} m on the map"
        raise ValueError(f"{text}: is it the right point?")
    yaw_rad = wrapped_rad(float(np.arctan2(theirs[1], theirs[0]) - np.arctan2(ours[1], ours[0])))
    R = about_up(yaw_rad)
    middle_m = ours_m.mean(axis=0)
    P = R[:2, :2] @ way_covariance_m2 @ R[:2, :2].T
    covariance = np.diag([0.0, 0.0, side_m2 / length_m**2, 0.0])
    covariance[:2, :2] = 0.5 * point_sd_m**2 * np.eye(2) + 0.25 * P
    return ExternalFrame(yaw_rad, map_m.mean(axis=0) - R @ middle_m, 0, covariance, middle_m[:2])


def corrected(
    frame: ExternalFrame, ours_m: Floats, grown: Floats, map_m: Floats, sd_m: float, gate: float
) -> ExternalFrame:
    """Return the map's frame by one more place (3,) on both.

    `grown` (3, 3) of x, y and yaw is what our track has lost since the point before, in our frame; `gate` is that of
    the normalised square. ValueError where the place is too far from where the frame has us.
    """
    R = about_up(frame.yaw_rad)
    F = frame.pose_covariance(ours_m) + R @ grown @ R.T
    off_m, S = (map_m - frame.theirs_m(ours_m))[:2], F[:2, :2] + sd_m**2 * np.eye(2)
    if off_m @ np.linalg.solve(S, off_m) > gate:
        raise ValueError(f"it is {np.hypot(*off_m):.1f} m from where the points before have us: is it the right point?")
    K = np.linalg.solve(S, F[:2]).T
    moved = K @ off_m
    yaw_rad = wrapped_rad(frame.yaw_rad + float(moved[2]))
    covariance = np.zeros((4, 4))
    covariance[:3, :3] = F - K @ S @ K.T
    place_m = frame.theirs_m(ours_m) + np.append(moved[:2], 0.0)
    return ExternalFrame(yaw_rad, place_m - about_up(yaw_rad) @ ours_m, 0, covariance, ours_m[:2])


def grown_since(before: Floats, now: Floats, way_m: Floats) -> Floats:
    """Return what a track has lost on a way (2,), by the covariances (3, 3) of x, y and yaw before and after it.

    A yaw that was off before turns the way: T moves that covariance along, and now = T before T' + grown.
    """
    T = lever(way_m)
    values, vectors = np.linalg.eigh(now - T @ before @ T.T)
    return np.asarray((vectors * np.maximum(values, 0.0)) @ vectors.T)
