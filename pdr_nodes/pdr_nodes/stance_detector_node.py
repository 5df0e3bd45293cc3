"""Node `stance_detector`: samples in (`imu/data`), samples with their verdict out (`stance`)."""

from rclpy.node import Node
from sensor_msgs.msg import Imu

from pdr_core.records import StanceBlock, length
from pdr_core.stance import StanceDetection
from pdr_core.warmup import warm_up
from pdr_msgs.msg import StanceImu
from pdr_nodes.convert import imu_block, stance_message
from pdr_nodes.declare import read_params
from pdr_nodes.idle import IdleWatch
from pdr_nodes.qos import OWN
from pdr_nodes.run import run


class StanceDetectorNode(Node):
    """Hosts the stance stage. A verdict follows its sample by at most the latency that the node logs."""

    def __init__(self) -> None:
        super().__init__("stance_detector", automatically_declare_parameters_from_overrides=True)
        params = read_params(self, ("stance", "place", "node"))
        warm_up()
        self._stance = StanceDetection(params.stance, params.place)
        self._frame_id = params.node.foot_frame
        self._publisher = self.create_publisher(StanceImu, "stance", OWN)
        self._idle = IdleWatch(self, params.node.idle_s, lambda: self._publish(self._stance.finish()))
        self.create_subscription(Imu, "imu/data", self._take, OWN)
        self.get_logger().info(f"verdicts follow within {self._stance.latency_s:.3f} s")

    def _take(self, message: Imu) -> None:
        self._idle.fed()
        self._publish(self._stance.run(imu_block(message)))

    def _publish(self, block: StanceBlock) -> None:
        for i in range(length(block)):
            self._publisher.publish(stance_message(block, i, self._frame_id))


def main() -> None:
    """Run the node."""
    run(StanceDetectorNode)


if __name__ == "__main__":
    main()
