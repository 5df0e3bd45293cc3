"""Node `imu_ingestion`: any driver's samples in (`imu/data_raw`), trustworthy samples out (`imu/data`)."""

from sensor_msgs.msg import Imu

from pdr_core.intake import Ingestion
from pdr_core.params import Params
from pdr_core.records import ImuBlock, length
from pdr_core.warmup import warm_up
from pdr_nodes.convert import imu_block, imu_message
from pdr_nodes.managed import ManagedNode
from pdr_nodes.qos import driver_input
from pdr_nodes.run import run


class ImuIngestionNode(ManagedNode):
    """Hosts the intake of one sensor."""

    NAME = "imu_ingestion"
    GROUPS = ("intake", "node")

    def set_up(self, params: Params) -> None:
        """Take the samples of any driver, give trustworthy ones."""
        warm_up()
        self._intake = Ingestion(params.intake)
        self._frame_id = params.node.foot_frame
        self._samples = self.output(Imu, "imu/data")
        self.input(
            Imu, "imu/data_raw", imu_block, self._take, driver_input(params.node.input_reliable), restarts_anew=True
        )
        # half the time: what waits here must reach the stance detector before that gives out what waits there
        self.when_idle(params.node.idle_s / 2.0, lambda: self._publish(self._intake.finish()))
        self.tell("samples", lambda: self._intake.notices)

    def _take(self, raw: ImuBlock) -> None:
        self._publish(self._intake.run(raw))

    def _publish(self, block: ImuBlock) -> None:
        for i in range(length(block)):
            self._samples.publish(imu_message(block, i, self._frame_id))


def main() -> None:
    """Run the node."""
    run(ImuIngestionNode)


if __name__ == "__main__":
    main()
