"""Node `imu_driver`: a device's samples out (`imu/data_raw`), with the truth beside them where the device knows it."""

import time

import numpy as np
from geometry_msgs.msg import PoseStamped
from rclpy.duration import Duration
from rclpy.node import Node
from sensor_msgs.msg import Imu

from pdr_core.conventions import NANOSECONDS
from pdr_core.records import Truth, TruthKind
from pdr_msgs.srv import SetGyroPower, SetSampleRate
from pdr_nodes.convert import imu_message, point_message, time_message
from pdr_nodes.declare import read_params
from pdr_nodes.devices import open_device
from pdr_nodes.devices.player import Player
from pdr_nodes.qos import OWN
from pdr_nodes.run import run
from pdr_nodes.throttle import Throttle

LOOK_S = 0.05  # how often to look for subscribers, and for calls while nothing is due
BURST = 100  # samples published before services are served again


class ImuDriverNode(Node):
    """Plays a device at its own pace, or at another. Begins when somebody listens; ends when the device ends."""

    def __init__(self) -> None:
        super().__init__("imu_driver", automatically_declare_parameters_from_overrides=True)
        params = read_params(self, ("driver", "simulation", "place", "node"))
        self._rate_factor = params.driver.rate_factor
        self._settling_s = params.driver.settling_s
        self._frame_id = params.node.sensor_frame
        source = open_device(params, self.get_clock().now().nanoseconds)
        self._player = Player(source, self._settling_s)
        self._publisher = self.create_publisher(Imu, "imu/data_raw", OWN)
        self._truth = TruthPublisher(self, source.truth)
        self._throttle = Throttle(self, params.driver.acknowledge_topic) if self._rate_factor == 0.0 else None
        self._begin: tuple[float, int] | None = None  # wall clock [s] and stamp [ns] of the first sample
        self._gyro_service = self.create_service(SetGyroPower, "set_gyro_power", self._set_gyro_power)
        self._rate_service = self.create_service(SetSampleRate, "set_sample_rate", self._set_sample_rate)
        self.get_logger().info(f"{source.name}: waiting for a subscriber of {self._publisher.topic_name}")

    def work(self) -> float | None:
        """Publish what is due; return the time [s] until the next sample is, or None when all is delivered."""
        if self._begin is None:
            if not self._publisher.get_subscription_count() or self._player.next is None:
                return LOOK_S if self._player.next is not None else None
            self._begin = time.monotonic(), self._player.next_ns
        for _ in range(BURST):
            if self._player.next is None:
                self._publisher.wait_for_all_acked(Duration(seconds=10))
                return None
            wait_s = self._until_next_s()
            if wait_s > 0.0:
                return min(wait_s, LOOK_S)
            self._publish_next()
        return 0.0

    def _until_next_s(self) -> float:
        if self._throttle:
            return 0.0 if self._throttle.open else LOOK_S
        if self._begin is None:
            return LOOK_S
        begin_s, begin_ns = self._begin
        due_s = begin_s + (self._player.next_ns - begin_ns) / NANOSECONDS / self._rate_factor
        return due_s - time.monotonic()

    def _publish_next(self) -> None:
        sample = self._player.take()
        self._publisher.publish(imu_message(sample, 0, self._frame_id))
        self._truth.publish_until(int(sample.stamp_ns[0]))
        if self._throttle:
            self._throttle.sent(int(sample.stamp_ns[0]))

    def _set_gyro_power(self, request: SetGyroPower.Request, response: SetGyroPower.Response) -> SetGyroPower.Response:
        if self._player.next is None:
            response.success, response.message = False, "the device has no more samples"
            return response
        self._player.set_gyro_power(request.powered)
        response.success = True
        response.effective = time_message(self._player.next_ns)
        response.settling_time = self._settling_s if request.powered else 0.0
        return response

    def _set_sample_rate(
        self, request: SetSampleRate.Request, response: SetSampleRate.Response
    ) -> SetSampleRate.Response:
        if self._player.next is None or self._player.interval_s <= 0.0:
            response.success, response.message = False, "the device has not begun, or has no more samples"
        elif not (np.isfinite(request.rate) and request.rate > 0.0):
            response.success, response.message = False, f"rate = {request.rate}: must be positive [Hz]"
        else:
            response.rate = self._player.set_sample_rate(request.rate)
            response.success = True
            response.effective = time_message(self._player.next_ns)
        return response


class TruthPublisher:
    """Publishes where the sensor really was, for those who record or judge the run."""

    def __init__(self, node: Node, truth: Truth | None) -> None:
        self._truth = truth if truth and truth.kind is TruthKind.POSITION else None
        self._next = 0
        self._publisher = node.create_publisher(PoseStamped, "ground_truth", OWN) if self._truth else None

    def publish_until(self, stamp_ns: int) -> None:
        """Publish the rows up to a stamp."""
        if not self._truth or not self._publisher:
            return
        while self._next < len(self._truth.stamp_ns) and self._truth.stamp_ns[self._next] <= stamp_ns:
            row = self._next
            message = point_message(int(self._truth.stamp_ns[row]), self._truth.position_m[row], "ground_truth")
            self._publisher.publish(message)
            self._next += 1


def main() -> None:
    """Run the node."""
    run(ImuDriverNode)


if __name__ == "__main__":
    main()
