"""Node `imu_ingestion`: any driver's samples in (`imu/data_raw`), trustworthy samples out (`imu/data`)."""

from rclpy.node import Node
from sensor_msgs.msg import Imu

from pdr_core.intake import Ingestion
from pdr_core.records import ImuBlock, length
from pdr_core.warmup import warm_up
from pdr_nodes.convert import imu_block, imu_message
from pdr_nodes.declare import read_params
from pdr_nodes.idle import IdleWatch
from pdr_nodes.notice_board import NoticeBoard
from pdr_nodes.qos import OWN, driver_input
from pdr_nodes.run import run


class ImuIngestionNode(Node):
    """Hosts the intake of one sensor."""

    def __init__(self) -> None:
        super().__init__("imu_ingestion", automatically_declare_parameters_from_overrides=True)
        params = read_params(self, ("intake", "node"))
        warm_up()
        self._intake = Ingestion(params.intake)
        self._frame_id = params.node.foot_frame
        self._publisher = self.create_publisher(Imu, "imu/data", OWN)
        self._board = NoticeBoard(self, "samples", lambda: self._intake.notices)
        # half the time after which the stance detector gives out its last samples, so that none comes after them
        self._idle = IdleWatch(self, 0.5 * params.node.idle_s, lambda: self._publish(self._intake.finish()))
        self.create_subscription(Imu, "imu/data_raw", self._take, driver_input(params.node.input_reliable))

    def _take(self, message: Imu) -> None:
        self._idle.fed()
        self._publish(self._intake.run(imu_block(message)))

    def _publish(self, block: ImuBlock) -> None:
        for i in range(length(block)):
            self._publisher.publish(imu_message(block, i, self._frame_id))


def main() -> None:
    """Run the node."""
    run(ImuIngestionNode)


if __name__ == "__main__":
    main()
