"""Between messages and records: the only place where the two meet. Stamps are int64 nanoseconds on our side."""

import math
import struct
import sys
from typing import NamedTuple

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Point, PoseStamped, PoseWithCovariance, Quaternion, TransformStamped, Vector3
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, MagneticField
from std_msgs.msg import Header

from pdr_core import records
from pdr_core.conventions import NANOSECONDS, NO_STAMP
from pdr_core.records import AttitudeBlock, Floats, ImuBlock, NavBlock, Stamps, StanceBlock, inertial_block
from pdr_msgs.msg import MargSample, StanceImu, StepEvent
from pdr_nodes.covariance import LARGEST_POSE, LARGEST_TWIST, bounded

NOT_MEASURED = -1.0  # first element of a covariance (REP-145)


def time_message(stamp_ns: int) -> Time:
    """Return a stamp as a message."""
    return Time(sec=stamp_ns // NANOSECONDS, nanosec=stamp_ns % NANOSECONDS)


def stamp_ns(time: Time) -> int:
    """Return a stamp [ns]."""
    return time.sec * NANOSECONDS + time.nanosec


def header_stamp_ns(cdr: bytes) -> int:
    """Return the stamp [ns] of a serialised message that begins with a header, after 4 bytes of encapsulation."""
    seconds, nanoseconds = struct.unpack_from("<iI", cdr, 4)
    return seconds * NANOSECONDS + nanoseconds


def vector(v: Floats) -> Vector3:
    """Return three numbers as a message."""
    x, y, z = v.tolist()
    return Vector3(x=x, y=y, z=z)


def numbers(v: Vector3 | Point) -> list[float]:
    """Return a message as three numbers."""
    return [v.x, v.y, v.z]


def isotropic(sd: float) -> Floats:
    """Return a covariance, (9,) row major, of equal deviations; -1 first where there is no measurement."""
    covariance = np.zeros(9)
    if sd < 0.0:
        covariance[0] = NOT_MEASURED
    else:
        covariance[::4] = sd**2
    return covariance


def deviation(covariance: Floats) -> float:
    """Return the standard deviation of one axis, -1 where there is no measurement."""
    variance = float(covariance[0])
    return -1.0 if variance == NOT_MEASURED else math.sqrt(max(variance, 0.0))


def imu_message(block: ImuBlock, i: int, frame_id: str, attitude: AttitudeBlock | None = None) -> Imu:
    """Return sample i of a block, with the orientation there, if that is known."""
    return with_sample(Imu(), block, i, frame_id, attitude)


def with_sample(message: Imu, block: ImuBlock, i: int, frame_id: str, attitude: AttitudeBlock | None = None) -> Imu:
    """Fill a message with sample i of a block, and with the orientation of its frame in the world, if that is known."""
    message.header.stamp = time_message(int(block.stamp_ns[i]))
    message.header.frame_id = frame_id
    if attitude is None:
        message.orientation_covariance = isotropic(NOT_MEASURED)
    else:
        message.orientation = quaternion_message(attitude.quat_xyzw[i])
        message.orientation_covariance = attitude.attitude_covariance[i].ravel()
    message.angular_velocity = vector(block.gyro_radps[i])
    message.angular_velocity_covariance = isotropic(float(block.gyro_sd_radps[i]))
    message.linear_acceleration = vector(block.accel_mps2[i])
    message.linear_acceleration_covariance = isotropic(float(block.accel_sd_mps2[i]))
    return message


def imu_block(message: Imu) -> ImuBlock:
    """Return a message as a block of one sample; rates that were not measured are zero."""
    gyro_sd = deviation(message.angular_velocity_covariance)
    return inertial_block(
        np.array([stamp_ns(message.header.stamp)]),
        np.array([numbers(message.angular_velocity)]) if gyro_sd >= 0.0 else np.zeros((1, 3)),
        np.array([numbers(message.linear_acceleration)]),
        np.array([gyro_sd]),
        np.array([deviation(message.linear_acceleration_covariance)]),
    )


class FieldBlock(NamedTuple):
    """m measurements of the magnetic field, with stamps of their own."""

    stamp_ns: Stamps  # (m,)
    field_tesla: Floats  # (m, 3)
    field_sd_tesla: Floats  # (m,) -1: none at this stamp


def field_message(block: ImuBlock, i: int, frame_id: str) -> MagneticField:
    """Return the magnetic field of sample i of a block; where it has none the message says so."""
    message = MagneticField()
    message.header.stamp = time_message(int(block.stamp_ns[i]))
    message.header.frame_id = frame_id
    return with_field(message, block, i, message.header)


def with_field(message: MagneticField, block: ImuBlock, i: int, header: Header) -> MagneticField:
    """Fill a message with the magnetic field of sample i of a block; where it has none the message only says so."""
    message.magnetic_field_covariance = isotropic(float(block.field_sd_tesla[i]))
    if block.field_sd_tesla[i] >= 0.0:
        message.header = header
        message.magnetic_field = vector(block.field_tesla[i])
    return message


def field_block(message: MagneticField) -> FieldBlock:
    """Return a message as a block of one measurement; a covariance that is no number is one that is unknown."""
    sd = deviation(message.magnetic_field_covariance)
    sd = sd if math.isfinite(sd) else 0.0
    stamps, field = np.array([stamp_ns(message.header.stamp)]), np.array([numbers(message.magnetic_field)])
    return FieldBlock(stamps, field, np.array([sd]))


def marg_message(block: ImuBlock, i: int, frame_id: str, attitude: AttitudeBlock | None = None) -> MargSample:
    """Return sample i of a block with its magnetic field, and with the orientation there, if that is known."""
    message = MargSample()
    with_sample(message.imu, block, i, frame_id, attitude)
    with_field(message.magnetic_field, block, i, message.imu.header)
    return message


def marg_block(message: MargSample | StanceImu) -> ImuBlock:
    """Return a message as a block of one sample with its magnetic field, if it has one."""
    block = imu_block(message.imu)
    if message.magnetic_field.magnetic_field_covariance[0] == NOT_MEASURED:
        return block
    _, field, sd = field_block(message.magnetic_field)
    return block._replace(field_tesla=field, field_sd_tesla=sd)


def stance_message(block: StanceBlock, i: int, frame_id: str) -> StanceImu:
    """Return sample i of a block with its verdict."""
    message = StanceImu()
    with_sample(message.imu, block.imu, i, frame_id)  # a second Imu would cost as much as all the rest
    with_field(message.magnetic_field, block.imu, i, message.imu.header)
    message.stance = bool(block.stance[i])
    message.statistic = finite(block.statistic[i])
    message.threshold = float(block.threshold[i])
    message.zero_velocity_stddev = finite(block.zero_velocity_sd_mps[i])
    message.rest_ended = bool(block.rest_sd_radps[i] > 0.0)
    message.rest_rate = vector(block.rest_rate_radps[i])
    message.rest_rate_stddev = float(block.rest_sd_radps[i])
    return message


def finite(value: float) -> float:
    """Return the value, or the largest number in place of infinity."""
    return min(float(value), sys.float_info.max)


def stance_block(message: StanceImu) -> StanceBlock:
    """Return a message as a block of one sample."""
    return StanceBlock(
        marg_block(message),
        np.array([message.stance]),
        np.array([message.statistic]),
        np.array([message.threshold]),
        np.array([message.zero_velocity_stddev]),
        np.array([numbers(message.rest_rate)]),
        np.array([message.rest_rate_stddev]),
    )


def odometry_message(nav: NavBlock, i: int, world_frame: str, foot_frame: str) -> Odometry:
    """Return estimate i: the pose in the world frame, the twist in the foot frame (REP-103, REP-105)."""
    message = Odometry()
    message.header.stamp = time_message(int(nav.stamp_ns[i]))
    message.header.frame_id = world_frame
    message.child_frame_id = foot_frame
    position = message.pose.pose.position
    position.x, position.y, position.z = nav.position_m[i].tolist()
    message.pose.pose.orientation = quaternion_message(nav.quat_xyzw[i])
    message.pose.covariance = bounded(nav.pose_covariance[i], LARGEST_POSE).ravel()
    message.twist.twist.linear = vector(nav.velocity_mps[i])
    message.twist.twist.angular = vector(nav.rate_radps[i])
    message.twist.covariance = bounded(nav.twist_covariance[i], LARGEST_TWIST).ravel()
    return message


def nav_block(message: Odometry) -> NavBlock:
    """Return an estimate as a block of one."""
    p, q, twist = message.pose.pose.position, message.pose.pose.orientation, message.twist.twist
    return NavBlock(
        np.array([stamp_ns(message.header.stamp)]),
        np.array([numbers(p)]),
        np.array([[q.x, q.y, q.z, q.w]]),
        np.array([numbers(twist.linear)]),
        np.array([numbers(twist.angular)]),
        np.array(message.pose.covariance).reshape(1, 6, 6),
        np.array(message.twist.covariance).reshape(1, 6, 6),
    )


def quaternion_message(xyzw: Floats) -> Quaternion:
    """Return a quaternion as a message."""
    x, y, z, w = xyzw.tolist()
    return Quaternion(x=x, y=y, z=z, w=w)


def step_message(step: records.StepEvent, world_frame: str, foot_frame: str) -> StepEvent:
    """Return a step as a message."""
    message = StepEvent()
    message.header.stamp = time_message(step.stamp_ns)
    message.header.frame_id = world_frame
    message.child_frame_id = foot_frame
    message.index = step.index
    if step.answer_due_ns != NO_STAMP:
        message.answer_due = time_message(step.answer_due_ns)
    message.start = time_message(step.start_ns)
    message.position.x, message.position.y, message.position.z = step.position_m.tolist()
    if step.position_covariance_m2 is not None:
        message.position_covariance = step.position_covariance_m2.ravel()
    message.displacement = vector(step.displacement_m)
    message.displacement_covariance = step.displacement_covariance_m2.ravel()
    message.length = step.length_m
    message.heading = step.heading_rad
    message.heading_stddev = step.heading_sd_rad
    message.yaw = step.yaw_rad
    message.yaw_stddev = step.yaw_sd_rad
    return message


def step_event(message: StepEvent) -> records.StepEvent:
    """Return a message as a step."""
    return records.StepEvent(
        index=message.index,
        start_ns=stamp_ns(message.start),
        stamp_ns=stamp_ns(message.header.stamp),
        position_m=np.array(numbers(message.position)),
        displacement_m=np.array(numbers(message.displacement)),
        displacement_covariance_m2=np.array(message.displacement_covariance).reshape(3, 3),
        yaw_rad=message.yaw,
        yaw_sd_rad=message.yaw_stddev,
        answer_due_ns=stamp_ns(message.answer_due) or NO_STAMP,
        position_covariance_m2=known_covariance(message.position_covariance),
    )


def known_covariance(row_major: Floats) -> Floats | None:
    """Return nine numbers as a covariance (3, 3); zeros say that it is unknown."""
    covariance = np.array(row_major).reshape(3, 3)
    return covariance if covariance.any() else None


def transform_message(odometry: Odometry) -> TransformStamped:
    """Return the pose of an odometry message as a transform."""
    message = TransformStamped(header=odometry.header, child_frame_id=odometry.child_frame_id)
    pose = odometry.pose.pose
    message.transform.translation.x = pose.position.x
    message.transform.translation.y = pose.position.y
    message.transform.translation.z = pose.position.z
    message.transform.rotation = pose.orientation
    return message


def pose_estimate(message: PoseWithCovariance) -> records.PoseEstimate:
    """Return a message as a pose, without attitude where its quaternion is zero; ValueError if it is no pose."""
    position, q = message.pose.position, message.pose.orientation
    position_m = np.array([position.x, position.y, position.z])
    xyzw = np.array([q.x, q.y, q.z, q.w])
    covariance = np.array(message.covariance).reshape(6, 6)
    if not (np.isfinite(position_m).all() and np.isfinite(xyzw).all() and np.isfinite(covariance).all()):
        raise ValueError("the pose holds NaN or infinity")
    if (np.diag(covariance) < 0.0).any():
        raise ValueError("the covariance has a negative diagonal")
    length = float(np.linalg.norm(xyzw))
    return records.PoseEstimate(position_m, xyzw / length if length > 0.0 else None, covariance)


def point_message(stamp_ns: int, position_m: Floats, frame_id: str) -> PoseStamped:
    """Return a position as a pose without rotation."""
    message = PoseStamped()
    message.header.stamp = time_message(stamp_ns)
    message.header.frame_id = frame_id
    message.pose.position.x, message.pose.position.y, message.pose.position.z = position_m.tolist()
    message.pose.orientation.w = 1.0
    return message
