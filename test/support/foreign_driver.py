"""Somebody else's driver: `python -m support.foreign_driver RECORDING TOPIC RELIABILITY SPEED [mag]`.

Publishes the samples once somebody listens, `SPEED` times as fast as their stamps say, says so and goes on living. It
knows nothing of the suite but how to open the recording, and offers no service. Its robot has an `/odom` and
`/diagnostics` of its own. With `mag` it has a magnetometer, for which it waits too.
"""

import sys
import time
from pathlib import Path

import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from nav_msgs.msg import Odometry
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Imu, MagneticField

from pdr_core.recording import open_recording


def message_of(stamp_ns: int, gyro, accel) -> Imu:
    message = Imu()
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp_ns, 10**9)
    message.header.frame_id = "somebodys_imu"
    message.orientation_covariance[0] = -1.0
    rate, force = message.angular_velocity, message.linear_acceleration
    rate.x, rate.y, rate.z = gyro.tolist()
    force.x, force.y, force.z = accel.tolist()
    return message


def field_of(message: Imu, tesla: float) -> MagneticField:
    field = MagneticField(header=message.header)
    field.magnetic_field.x, field.magnetic_field.y, field.magnetic_field.z = 2e-5, tesla, -4e-5
    return field


def main() -> None:
    recording, topic, reliability, speed, *mag_too = sys.argv[1:]
    (sensor,) = open_recording(Path(recording)).sensors.values()
    rclpy.init()
    node = rclpy.create_node("somebodys_driver")
    qos = QoSProfile(depth=50, reliability=ReliabilityPolicy[reliability])
    publisher = node.create_publisher(Imu, topic, qos)
    mag = node.create_publisher(MagneticField, f"{topic}_mag", qos)
    kept = QoSProfile(depth=50, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    odometry = node.create_publisher(Odometry, "/odom", kept)
    diagnostics = node.create_publisher(DiagnosticArray, "/diagnostics", 10)
    wheels = DiagnosticStatus(name="robot: wheels", values=[KeyValue(key="supply", value="24.1 V")])
    awaited = [publisher, mag] if mag_too else [publisher]
    while not all(each.get_subscription_count() for each in awaited):
        time.sleep(0.05)
    begin_s, begin_ns = time.monotonic(), None
    for piece in sensor.pieces():
        for stamp_ns, gyro, accel in zip(piece.stamp_ns.tolist(), piece.gyro_radps, piece.accel_mps2, strict=True):
            begin_ns = stamp_ns if begin_ns is None else begin_ns
            time.sleep(max(0.0, begin_s + (stamp_ns - begin_ns) / 1e9 / float(speed) - time.monotonic()))
            message = message_of(stamp_ns, gyro, accel)
            publisher.publish(message)
            if mag_too:
                mag.publish(field_of(message, (stamp_ns - begin_ns) * 1e-18))  # tells the stamps apart
            odometry.publish(Odometry(header=message.header))
        diagnostics.publish(DiagnosticArray(status=[wheels]))
    print("done", flush=True)
    while True:
        time.sleep(0.1)


if __name__ == "__main__":
    main()
