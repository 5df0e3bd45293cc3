"""Node `imu_ingestion`: any driver's samples in (`imu/data_raw`), trustworthy ones with orientation out (`imu/data`).

With a magnetometer its field comes in too (`imu/mag`), and goes out with its sample in one message (`imu/marg`).
"""

from sensor_msgs.msg import Imu

from pdr_core.params import Params
from pdr_core.pipeline import OrientedIntake
from pdr_core.records import AttitudeBlock, ImuBlock, Notice, length
from pdr_core.warmup import warm_up
from pdr_msgs.msg import MargSample
from pdr_nodes.convert import imu_block, imu_message, marg_message
from pdr_nodes.field_input import FieldInput
from pdr_nodes.managed import ManagedNode
from pdr_nodes.notice_board import ORIENTATION
from pdr_nodes.qos import driver_input
from pdr_nodes.run import run


class ImuIngestionNode(ManagedNode):
    """Hosts the intake of one sensor. The orientation is for others: our own filter has a better one."""

    NAME = "imu_ingestion"
    GROUPS = ("intake", "place", "attitude", "node")

    def set_up(self, params: Params) -> None:
        """Take the samples of any driver, give trustworthy ones."""
        warm_up()
        node = params.node
        self._intake = OrientedIntake(params)
        self._frame_id = node.foot_frame
        self._samples = self.output(Imu, "imu/data")
        self._margs = self.output(MargSample, "imu/marg") if node.magnetometer else None
        self._fields = FieldInput(self, node, self._take) if node.magnetometer else None
        take = self._fields.take if self._fields else self._take
        self.input(Imu, "imu/data_raw", imu_block, take, driver_input(node.input_reliable), restarts_anew=True)
        # half the time: what waits here must reach the stance detector before that gives out what waits there
        self.when_idle(node.idle_s / 2.0, self._finish)
        self.tell("samples", self._notices)
        self.tell(ORIENTATION, lambda: self._intake.orientation_notices)

    def _take(self, raw: ImuBlock) -> None:
        self._publish(*self._intake.run(raw))

    def _finish(self) -> None:
        if self._fields:
            self._fields.finish()
        self._publish(*self._intake.finish())

    def _publish(self, block: ImuBlock, attitude: AttitudeBlock) -> None:
        for i in range(length(block)):
            if self._margs:
                sample = marg_message(block, i, self._frame_id, attitude)
                self._samples.publish(sample.imu)
                self._margs.publish(sample)
            else:
                self._samples.publish(imu_message(block, i, self._frame_id, attitude))

    def _notices(self) -> list[Notice]:
        return [*(self._fields.notices if self._fields else []), *self._intake.notices]


def main() -> None:
    """Run the node."""
    run(ImuIngestionNode)


if __name__ == "__main__":
    main()
