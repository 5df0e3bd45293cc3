"""Steps of two feet and estimates of one, made up: nothing here comes from a filter."""

from dataclasses import replace

import numpy as np

from pdr_core.fusion.foot_rows import room
from pdr_core.records import StepEvent

STRIDE_S, STRIDE_M = 1.1, 1.4


def step(index, heading_rad, length_m=STRIDE_M, late_s=0.0, yaw_rad=None, yaw_sd_rad=0.02):
    """Return step `index` of a foot that strides since the stamp `late_s`."""
    stamps = [round((late_s + (index - 1 + i) * STRIDE_S) * 1e9) for i in (0, 1)]
    displacement_m = length_m * np.array([np.cos(heading_rad), np.sin(heading_rad), 0.0])
    yaw_rad = heading_rad if yaw_rad is None else yaw_rad
    return StepEvent(
        index, *stamps, np.zeros(3), displacement_m, 1e-4 * np.eye(3), yaw_rad, yaw_sd_rad, stamps[1] + 400_000_000
    )


def in_turn(lefts, rights):
    """Yield the steps of both feet in the order of their stamps."""
    named = [("left", s) for s in lefts] + [("right", s) for s in rights]
    yield from sorted(named, key=lambda item: item[1].stamp_ns)


def walk(left_rad, right_rad):
    """Return the steps of a left and a right foot with these headings, the right one half a stride later."""
    lefts = [step(i, heading) for i, heading in enumerate(left_rad, 1)]
    return lefts, [step(i, heading, late_s=STRIDE_S / 2) for i, heading in enumerate(right_rad, 1)]


def turned_back(event, angle_rad):
    """Return a step of a track that has been turned back."""
    c, s = np.cos(angle_rad), np.sin(angle_rad)
    x, y, z = event.displacement_m
    return replace(event, displacement_m=np.array([c * x + s * y, c * y - s * x, z]), yaw_rad=event.yaw_rad - angle_rad)


def rows(stamp_s, position_m=(0.0, 0.0, 0.0), velocity_mps=(0.0, 0.0, 0.0), yaw_rad=0.0, sd_m=0.01, yaw_sd_rad=0.01):
    """Return estimates of a foot at stamps [s], (n,)."""
    nav = room(len(stamp_s))
    nav.stamp_ns[:] = np.round(np.asarray(stamp_s) * 1e9).astype(np.int64)
    nav.position_m[:], nav.velocity_mps[:] = position_m, velocity_mps
    nav.quat_xyzw[:, 2], nav.quat_xyzw[:, 3] = np.sin(np.asarray(yaw_rad) / 2), np.cos(np.asarray(yaw_rad) / 2)
    nav.pose_covariance[:] = np.diag([sd_m**2] * 3 + [1e-4, 1e-4, yaw_sd_rad**2])
    nav.twist_covariance[:] = 1e-4 * np.eye(6)
    return nav
