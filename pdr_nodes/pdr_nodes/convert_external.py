"""Between messages and records of what somebody else says of the person's place."""

import math
from typing import TypeAlias

import numpy as np
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import PointStamped, PoseWithCovarianceStamped, TransformStamped
from nav_msgs.msg import Odometry

from pdr_core.records_external import (
    ExternalComparison,
    ExternalFrame,
    FixBlock,
    known_variances,
    unknown_yaws,
    yaw_or_none,
)
from pdr_nodes.convert import numbers, quaternion_message, stamp_ns, time_message, vector

LEVEL_VARIANCE = 1e-6  # of roll and pitch between two level frames
HEIGHT_VARIANCE = 1.0  # a median of heights that both may hold for zero
NOT_ALIGNED = "not aligned yet: that takes a walk of some 20 m and fixes that agree, or two known points"


External: TypeAlias = Odometry | PoseWithCovarianceStamped | PointStamped


def fix_block(message: External) -> FixBlock:
    """Return a message as a block of one fix; variances that are none are unknown."""
    stamps = np.array([stamp_ns(message.header.stamp)])
    if isinstance(message, PointStamped):
        return FixBlock(stamps, np.array([numbers(message.point)]), np.zeros((1, 3)), unknown_yaws(1))
    covariance = message.pose.covariance
    variances = [float(covariance[7 * axis]) for axis in range(3)]
    place_m, turn = np.array([numbers(message.pose.pose.position)]), message.pose.pose.orientation
    yaw_rad = yaw_or_none((turn.x, turn.y, turn.z, turn.w))
    return FixBlock(stamps, place_m, np.array([known_variances(variances)]), np.array([yaw_rad]))


def frame_message(frame: ExternalFrame, at_ns: int, their_frame: str) -> PoseWithCovarianceStamped:
    """Return our frame as a pose in theirs."""
    message = PoseWithCovarianceStamped()
    message.header.stamp, message.header.frame_id = time_message(at_ns), their_frame
    position = message.pose.pose.position
    position.x, position.y, position.z = frame.shift_m.tolist()
    message.pose.pose.orientation = quaternion_message(frame.quat_xyzw)
    covariance = np.diag([0.0, 0.0, HEIGHT_VARIANCE, LEVEL_VARIANCE, LEVEL_VARIANCE, 0.0])
    axes = [0, 1, 5]
    covariance[np.ix_(axes, axes)] = frame.origin_covariance
    message.pose.covariance = covariance.ravel()
    return message


def frame_transform(frame: ExternalFrame, at_ns: int, their_frame: str, world_frame: str) -> TransformStamped:
    """Return our frame in theirs as a transform."""
    message = TransformStamped(child_frame_id=world_frame)
    message.header.stamp, message.header.frame_id = time_message(at_ns), their_frame
    message.transform.translation = vector(frame.shift_m)
    message.transform.rotation = quaternion_message(frame.quat_xyzw)
    return message


def comparison_message(found: ExternalComparison, at_ns: int, name: str) -> DiagnosticArray:
    """Return a comparison as values with their units in the names; what is not known is left out."""
    said: dict[str, float] = {"pairs": found.pairs}
    if found.frame:
        x_sd, y_sd, yaw_sd, clock_sd = np.sqrt(np.diag(found.frame.covariance)).tolist()
        x, y, z = found.frame.shift_m.tolist()
        said |= {"ate_m": found.ate_m, "x_m": x, "y_m": y, "z_m": z, "x_sd_m": x_sd, "y_sd_m": y_sd}
        said |= {"yaw_rad": found.frame.yaw_rad, "yaw_sd_rad": yaw_sd}
        said |= {"clock_s": found.frame.clock_ns * 1e-9, "clock_sd_s": clock_sd}
    values = [KeyValue(key=key, value=f"{value:.9g}") for key, value in said.items() if not math.isnan(value)]
    text = "aligned" if found.frame else NOT_ALIGNED
    message = DiagnosticArray(status=[DiagnosticStatus(name=name, message=text, values=values)])
    message.header.stamp = time_message(at_ns)
    return message
