"""What of the filter's health still holds while strides are reckoned without the gyro."""

from dataclasses import replace

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.records import FilterHealth, FilterMode, PoseEstimate


def reckoned_health(known: FilterHealth, stamp_ns: int, pose: PoseEstimate) -> FilterHealth:
    """Return the filter's last health at a later stamp, with the deviations of the pose that was reckoned."""
    sd = np.sqrt(np.diag(pose.covariance))
    return replace(
        known,
        mode=FilterMode.COASTING,
        stamp_ns=stamp_ns,
        since_zero_velocity_s=known.since_zero_velocity_s + max(0, stamp_ns - known.stamp_ns) / NANOSECONDS,
        position_sd_m=float(np.sqrt(np.linalg.eigvalsh(pose.covariance[:2, :2])[-1])),
        height_sd_m=float(sd[2]),
        tilt_sd_rad=float(sd[3:5].max()),
        yaw_sd_rad=float(sd[5]),
    )
