"""Node `stance_detector`: samples in (`imu/data`), samples with their verdict out (`stance`).

With a magnetometer the samples come with their field (`imu/marg`).
"""

from sensor_msgs.msg import Imu

from pdr_core.params import Params
from pdr_core.records import ImuBlock, StanceBlock, length
from pdr_core.stance import StanceDetection
from pdr_core.warmup import warm_up
from pdr_msgs.msg import MargSample, StanceImu
from pdr_nodes.convert import imu_block, marg_block, stance_message
from pdr_nodes.managed import ManagedNode
from pdr_nodes.run import run


class StanceDetectorNode(ManagedNode):
    """Hosts the stance stage. A verdict follows its sample by at most what the node logs."""

    NAME = "stance_detector"
    GROUPS = ("stance", "detectors", "place", "node")

    def set_up(self, params: Params) -> None:
        """Take samples, give verdicts; the last ones when no sample comes."""
        warm_up(params)
        self._stance = StanceDetection(params.stance, params.place, params.detectors)
        self._frame_id = params.node.foot_frame
        self._verdicts = self.output(StanceImu, "stance")
        if params.node.magnetometer:
            self.input(MargSample, "imu/marg", marg_block, self._take)
        else:
            self.input(Imu, "imu/data", imu_block, self._take)
        self.when_idle(params.node.idle_s, lambda: self._publish(self._stance.finish()))
        intervals = "one sample interval" if params.stance.time_gate == "none" else "two sample intervals"
        self.get_logger().info(f"verdicts follow within {self._stance.latency_s:.4f} s and {intervals}")

    def _take(self, block: ImuBlock) -> None:
        self._publish(self._stance.run(block))

    def _publish(self, block: StanceBlock) -> None:
        for i in range(length(block)):
            self._verdicts.publish(stance_message(block, i, self._frame_id))


def main() -> None:
    """Run the node."""
    run(StanceDetectorNode)


if __name__ == "__main__":
    main()
