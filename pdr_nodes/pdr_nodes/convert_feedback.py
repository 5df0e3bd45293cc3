"""Between messages and records of what estimators ask, answer and hand to each other."""

import numpy as np

from pdr_core import records
from pdr_core.records import Biases, HeadingSource, PositionError
from pdr_msgs.msg import Handover, HeadingObservation
from pdr_nodes.convert import (
    known_covariance,
    numbers,
    pose_estimate,
    quaternion_message,
    stamp_ns,
    time_message,
    vector,
)

SOURCES = {source.value: source for source in HeadingSource}


def heading_message(observation: records.HeadingObservation, foot_frame: str) -> HeadingObservation:
    """Return the answer to a step as a message."""
    message = HeadingObservation(child_frame_id=foot_frame, step_index=observation.step_index)
    message.header.stamp = time_message(observation.step_ns)
    message.applies_from = time_message(observation.applies_from_ns)
    message.source = observation.source.value
    message.yaw_error = observation.yaw_error_rad
    message.yaw_error_stddev = observation.yaw_error_sd_rad
    if observation.position:
        message.position_error = vector(observation.position.error_m)
        message.position_error_covariance = observation.position.covariance_m2.ravel()
    return message


def heading_observation(message: HeadingObservation) -> records.HeadingObservation:
    """Return a message as the answer to a step; a source that we do not know is somebody else."""
    covariance_m2 = known_covariance(message.position_error_covariance)
    off = None if covariance_m2 is None else PositionError(np.array(numbers(message.position_error)), covariance_m2)
    return records.HeadingObservation(
        step_index=message.step_index,
        step_ns=stamp_ns(message.header.stamp),
        applies_from_ns=stamp_ns(message.applies_from),
        source=SOURCES.get(message.source, HeadingSource.EXTERNAL),
        yaw_error_rad=message.yaw_error,
        yaw_error_sd_rad=message.yaw_error_stddev,
        position=off,
    )


def handover_message(handover: records.Handover, world_frame: str, foot_frame: str) -> Handover:
    """Return an estimate that is handed over as a message."""
    message = Handover(child_frame_id=foot_frame)
    message.header.stamp = time_message(handover.stamp_ns)
    message.header.frame_id = world_frame
    pose, position = handover.pose, message.pose.pose.position
    position.x, position.y, position.z = pose.position_m.tolist()
    unknown = np.zeros(4)  # a message says so by a quaternion of zeros; w = 1 is its default
    message.pose.pose.orientation = quaternion_message(unknown if pose.quat_xyzw is None else pose.quat_xyzw)
    message.pose.covariance = pose.covariance.ravel()
    message.biases_known = handover.biases is not None
    if handover.biases:
        message.accel_bias = vector(handover.biases.accel_mps2)
        message.gyro_bias = vector(handover.biases.gyro_radps)
        message.bias_covariance = handover.biases.covariance.ravel()
    return message


def handover_record(message: Handover) -> records.Handover:
    """Return a message as an estimate that is handed over; ValueError if its pose is none."""
    biases = None
    if message.biases_known:
        covariance = np.array(message.bias_covariance).reshape(6, 6)
        biases = Biases(np.array(numbers(message.accel_bias)), np.array(numbers(message.gyro_bias)), covariance)
    return records.Handover(stamp_ns(message.header.stamp), pose_estimate(message.pose), biases)
