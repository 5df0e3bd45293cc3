"""The messages of an exported bag are those that ROS would write."""

import numpy as np
from export_cases import check_same, noise, with_field
from rosbags.typesys import Stores, get_typestore
from small_bags import IMU, MAG

from pdr_core.recording.imu_cdr import cdr_from_imu_block, imu_block_from_cdr
from pdr_core.recording.mag_cdr import FieldBlock, cdr_from_field_block, field_block_from_cdr

ROS2 = get_typestore(Stores.ROS2_JAZZY)


def test_what_was_not_measured_is_still_not_measured():
    samples = noise(4)._replace(gyro_sd_radps=np.array([0.0, -1.0, 0.2, 0.0]))
    read = imu_block_from_cdr(cdr_from_imu_block(samples, "foot"))
    assert read.gyro_sd_radps.tolist() == [0.0, -1.0, 0.0, 0.0]
    np.testing.assert_array_equal(read.accel_mps2, samples.accel_mps2)


def test_what_is_written_is_what_ros_would_write():
    samples = noise(2)._replace(accel_sd_mps2=np.array([0.0, 0.5]))
    written = cdr_from_imu_block(samples, "a frame")
    assert len(written) == 2
    for i, cdr in enumerate(written):
        message = ROS2.deserialize_cdr(cdr, IMU)
        assert (message.header.frame_id, message.orientation_covariance[0]) == ("a frame", -1.0)
        assert message.linear_acceleration.y == samples.accel_mps2[i, 1]
        assert (
            message.linear_acceleration_covariance.tolist()
            == (np.eye(3) * samples.accel_sd_mps2[i] ** 2).ravel().tolist()
        )
        assert bytes(ROS2.serialize_cdr(message, IMU)) == cdr


def test_the_field_is_written_as_ros_would_write_it():
    samples = with_field(noise(3), np.array([True, True, False]), np.array([0.0, 2e-7, 0.0]))
    fields = FieldBlock(samples.stamp_ns, samples.field_tesla, samples.field_sd_tesla)
    written = cdr_from_field_block(fields, "a frame")
    assert len(written) == 3
    for i, cdr in enumerate(written):
        message = ROS2.deserialize_cdr(cdr, MAG)
        assert (message.header.frame_id, message.magnetic_field.z) == ("a frame", samples.field_tesla[i, 2])
        diagonal = message.magnetic_field_covariance[[0, 4, 8]].tolist()
        assert diagonal == [[0.0] * 3, [2e-7**2] * 3, [-1.0, 0.0, 0.0]][i]
        assert bytes(ROS2.serialize_cdr(message, MAG)) == cdr
        check_same(field_block_from_cdr([cdr]), [column[i : i + 1] for column in fields])
