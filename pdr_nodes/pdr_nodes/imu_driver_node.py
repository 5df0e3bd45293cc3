"""Node `imu_driver`: a device's samples out (`imu/data_raw`), with the truth beside them where the device knows it.

Where `node.magnetometer` says so, the magnetic field goes out too (`imu/mag`), with the stamp of its sample.
"""

from builtin_interfaces.msg import Time
from rclpy.duration import Duration
from sensor_msgs.msg import Imu, MagneticField

from pdr_core.conventions import NANOSECONDS, NO_STAMP
from pdr_core.params import DriverParams, Params
from pdr_core.power.motion_rule import motion_rule
from pdr_core.records import Level, Notice
from pdr_msgs.srv import SetGyroPower, SetSampleRate
from pdr_nodes.convert import field_message, imu_message, stamp_ns, time_message
from pdr_nodes.devices import open_device
from pdr_nodes.devices.player import Player
from pdr_nodes.managed import ManagedNode
from pdr_nodes.pace import Pace
from pdr_nodes.run import run
from pdr_nodes.throttle import Limited, Throttle
from pdr_nodes.truth_publisher import TruthPublisher

LOOK_S = 0.05  # how often to look for subscribers, and for calls while nothing is due
BURST = 100  # samples published before services are served again


class ImuDriverNode(ManagedNode):
    """Plays a device at its own pace, or at another. Begins when all listeners are there; ends when the device ends."""

    NAME = "imu_driver"
    GROUPS = ("driver", "simulation", "place", "power", "node")

    def set_up(self, params: Params) -> None:
        """Open the device: give its samples, and its switches as services."""
        driver = params.driver
        source = open_device(params, self.get_clock().now().nanoseconds)
        self._player, self._motion_rule = Player(source, driver.settling_s), motion_rule(params.power)
        self._frame_id = params.node.sensor_frame
        self._listeners, self._others = driver.subscribers, driver.begins_after.split()
        self._begun = False
        self._pace = self._paced(driver)
        self.part(self._pace)
        self._samples = self.output(Imu, "imu/data_raw")
        self._fields = self.output(MagneticField, "imu/mag") if params.node.magnetometer else None
        self._outputs = [topic for topic in (self._samples, self._fields) if topic]
        self._truth = TruthPublisher(self, source.truth)
        self.service(SetGyroPower, "set_gyro_power", self._set_gyro_power)
        self.service(SetSampleRate, "set_sample_rate", self._set_sample_rate)
        self.tell("device", self._notices)
        self.get_logger().info(
            f"{source.name}: waiting for {self._listeners} subscribers of {self._samples.topic_name}"
        )

    def _paced(self, driver: DriverParams) -> Pace | Throttle | Limited:
        if not driver.rate_factor:
            return Throttle(self, driver.acknowledge_topic)
        pace, lead = Pace(driver.rate_factor), driver.lead_samples
        return Limited(pace, Throttle(self, driver.acknowledge_topic, lead)) if lead else pace

    def work(self) -> float | None:
        """Publish what is due; return the time [s] until the next sample is, or None when all is delivered."""
        if self.state != "active":
            return LOOK_S
        self._begun = self._begun or self._all_are_there()
        for _ in range(BURST):
            if self._player.next is None:
                for topic in self._outputs:
                    topic.wait_for_all_acked(Duration(seconds=10))
                return None
            wait_s = self._pace.wait_s(self._player.next_ns) if self._begun else LOOK_S
            if wait_s > 0.0:
                return min(wait_s, LOOK_S)
            self._publish_next()
        return 0.0

    def _all_are_there(self) -> bool:
        return self._fewest_listeners()[0] >= self._listeners and self._pace.ready and not self._missing()

    def _fewest_listeners(self) -> tuple[int, str]:
        """Return how many subscribe to the topic that has the fewest subscribers, and its name."""
        return min((topic.get_subscription_count(), topic.topic_name) for topic in self._outputs)

    def _missing(self) -> list[str]:
        """Return the topics that are to be published before the first sample is, and are not."""
        return [topic for topic in self._others if not self.count_publishers(topic)]

    def _publish_next(self) -> None:
        sample = self._player.take()
        if self._fields:  # before its sample, and also where there is none: so no sample waits
            self._fields.publish(field_message(sample, 0, self._frame_id))
        self._samples.publish(imu_message(sample, 0, self._frame_id))
        self._truth.publish_until(int(sample.stamp_ns[0]))
        self._pace.sent(int(sample.stamp_ns[0]))

    def _notices(self) -> list[Notice]:
        if self._begun:
            return list(self._pace.notices)
        there, topic = self._fewest_listeners()
        text = f"waits for subscribers of {topic}: {there} of {self._listeners} are there (driver.subscribers)"
        if not self._pace.ready:
            text += "; and for one who acknowledges (driver.acknowledge_topic)"
        if missing := self._missing():
            text += f"; and for publishers of {', '.join(missing)} (driver.begins_after)"
        return [Notice(Level.WARN, "waiting", text, 1, 0)]

    def _set_gyro_power(self, request: SetGyroPower.Request, response: SetGyroPower.Response) -> SetGyroPower.Response:
        if self._player.next is None:
            response.success, response.message = False, "the device has no more samples"
            return response
        not_before_ns = moment_ns(request.not_before)
        if request.on_motion:
            effective_ns = self._player.set_gyro_on_motion(self._motion_rule, not_before_ns)
            response.settling_time = self._motion_rule.settle_ns / NANOSECONDS
        else:
            effective_ns = self._player.set_gyro_power(request.powered, not_before_ns)
            response.settling_time = self._player.settling_s if request.powered else 0.0
        response.success, response.effective = True, time_message(effective_ns)
        return response

    def _set_sample_rate(
        self, request: SetSampleRate.Request, response: SetSampleRate.Response
    ) -> SetSampleRate.Response:
        if self._player.next is None or self._player.interval_s <= 0.0:
            response.success, response.message = False, "the device has not begun, or has no more samples"
        elif not 0.0 < request.rate < float("inf"):
            response.success, response.message = False, f"rate = {request.rate}: must be positive [Hz]"
        else:
            response.success = True
            response.rate, effective_ns = self._player.set_sample_rate(request.rate, moment_ns(request.not_before))
            response.effective = time_message(effective_ns)
        return response


def moment_ns(not_before: Time) -> int:
    """Return the moment of a request [ns]; zero says as soon as possible."""
    return stamp_ns(not_before) or NO_STAMP


def main() -> None:
    """Run the node."""
    run(ImuDriverNode)


if __name__ == "__main__":
    main()
